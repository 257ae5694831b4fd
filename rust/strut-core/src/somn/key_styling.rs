//! Motion from styles at key times (`docs/methods/somn.md` §8).

use super::RATE_HZ;
use super::mixture::{MAX_AXES, Style};
use super::pose_space::{DIMS, Row};
use super::spline::{Interpolation, Spline};
use super::synthesis::{Mode, Synthesis};
use crate::humanoid::HumanoidMotion;
use crate::kinematics::root_path::{RootPath, Support};
use thiserror::Error;

/// Longest motion, seconds.
pub const MAX_SECS: f64 = 3600.0;

/// A style at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// The time, seconds.
    pub secs: f64,
    /// The style, in the axes' units.
    pub style: Style,
    /// Optional key pose, for the methods that interpolate key poses; by default the pose of the style.
    pub row: Option<Row>,
}

/// Method of generating the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The pose of the interpolated style.
    #[default]
    KeyStyle,
    /// The same, plus the interpolated difference of key poses from the poses of their styles.
    Hybrid,
    /// Key-frame interpolation of key poses: the baseline.
    KeyFrame,
}

/// Error of keys that give no motion.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum KeysError {
    /// No key was given.
    #[error("there is no key; at least one was expected")]
    Empty,
    /// A number is not finite.
    #[error("key {0} holds a number that is not finite")]
    NotFinite(usize),
    /// The times do not ascend.
    #[error("key {key} is at {} s, not after the one before; ascending times were expected", number(*.secs))]
    Order {
        /// The key; the first is 1.
        key: usize,
        /// Its time.
        secs: f64,
    },
    /// The keys span too long a time.
    #[error("the keys span {} s; at most {MAX_SECS} s are supported", number(*.0))]
    TooLong(f64),
}

/// Formats a number for a message, with an exponent if it has too many digits.
fn number(value: f64) -> String {
    if value.abs() < 1e9 { value.to_string() } else { format!("{value:e}") }
}

/// Keys and the curves between them.
#[derive(Clone, Debug)]
pub struct KeyStyling {
    begin: f64,
    end: f64,
    mode: Mode,
    styles: Spline<MAX_AXES>,
    poses: Spline<DIMS>,
    residuals: Spline<DIMS>,
}

impl KeyStyling {
    /// Creates the curves through keys in the order of their times.
    ///
    /// # Errors
    /// See [`KeysError`].
    pub fn new(
        keys: &[Key],
        interpolation: Interpolation,
        synthesis: &mut Synthesis,
        mode: Mode,
    ) -> Result<Self, KeysError> {
        let (Some(first), Some(last)) = (keys.first(), keys.last()) else { return Err(KeysError::Empty) };
        let is_finite = |key: &Key| {
            let row = key.row.iter().flatten();
            key.style.iter().chain(row).chain([&key.secs]).all(|number| number.is_finite())
        };
        if let Some(i) = keys.iter().position(|key| !is_finite(key)) {
            return Err(KeysError::NotFinite(i + 1));
        }
        if let Some(i) = (1..keys.len()).find(|&i| keys[i].secs <= keys[i - 1].secs) {
            return Err(KeysError::Order { key: i + 1, secs: keys[i].secs });
        }
        let (begin, end) = (first.secs, last.secs);
        if end - begin > MAX_SECS {
            return Err(KeysError::TooLong(end - begin));
        }
        let knots: Vec<f64> = keys.iter().map(|key| key.secs).collect();
        let own = keys.iter().map(|key| row_within_reach(synthesis, &key.style, mode)).collect::<Vec<_>>();
        let poses: Vec<Row> = keys.iter().zip(&own).map(|(key, own)| key.row.unwrap_or(*own)).collect();
        let residuals = poses.iter().zip(&own).map(|(pose, own)| std::array::from_fn(|d| pose[d] - own[d])).collect();
        Ok(Self {
            begin,
            end,
            mode,
            styles: Spline::new(&knots, keys.iter().map(|key| key.style).collect(), interpolation),
            poses: Spline::new(&knots, poses, interpolation),
            residuals: Spline::new(&knots, residuals, interpolation),
        })
    }

    /// Returns the style at a time, in the axes' units.
    pub fn style(&self, secs: f64) -> Style {
        self.styles.at(secs)
    }

    /// Returns the pose at a time.
    pub fn row(&self, synthesis: &mut Synthesis, secs: f64, method: Method) -> Row {
        if method == Method::KeyFrame {
            return self.poses.at(secs);
        }
        let mut row = row_within_reach(synthesis, &self.style(secs), self.mode);
        if method == Method::Hybrid {
            row.iter_mut().zip(self.residuals.at(secs)).for_each(|(x, residual)| *x += residual);
        }
        row
    }

    /// Returns the whole motion at [`RATE_HZ`], on the floor.
    pub fn motion(&self, synthesis: &mut Synthesis, method: Method) -> HumanoidMotion {
        let model = std::sync::Arc::clone(synthesis.model());
        let mut path = RootPath::new(&model.space.proportions);
        let rate = f64::from(RATE_HZ);
        // A last key on a frame belongs to the motion, whatever the rounding.
        let frames = ((self.end - self.begin) * rate + 1e-6).floor() as usize + 1;
        let mut at = |frame: usize| {
            let row = self.row(synthesis, self.begin + frame as f64 / rate, method);
            let mut pose = model.space.pose(&row);
            let above = synthesis.flight_of(&row, &pose);
            if model.travels {
                path.place_above(&mut pose, Support::Auto, 0.0, 1.0 / RATE_HZ, above);
            } else {
                pose.root.y += above;
            }
            pose
        };
        let poses = (0..frames).map(&mut at).collect();
        HumanoidMotion { proportions: model.space.proportions, rate_hz: RATE_HZ, poses }
    }
}

fn row_within_reach(synthesis: &mut Synthesis, style: &Style, mode: Mode) -> Row {
    let style = synthesis.within_reach(style);
    synthesis.row(&style, mode)
}
