//! Evaluation of key-styling: held-out prediction error of poses, and baselines (`docs/methods/somn.md` §7 to §9).

use strut_core::hsmm::ROTATION_DIMS;
use strut_core::humanoid::{JOINTS, Pose};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::math::float_funcs::double;
use strut_core::somn::parts::{Gate, angles, log_likelihood};
use strut_core::somn::{DIMS, KeyStyleModel, MAX_AXES, PoseSpace, Recording, Row, Style};

/// Recorded poses and their styles, in a model's space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observed {
    /// The poses.
    pub rows: Vec<Row>,
    /// Their styles, in the axes' units.
    pub styles: Vec<Style>,
}

impl Observed {
    /// Poses and styles of a recording.
    pub fn new(model: &KeyStyleModel, recording: &Recording) -> Self {
        let style = |frame| {
            let mut style = [0.0; MAX_AXES];
            style.iter_mut().zip(&model.axes).for_each(|(u, axis)| *u = axis.measure(frame));
            style
        };
        Self {
            rows: recording.poses.iter().map(|pose| model.space.row(pose)).collect(),
            styles: recording.frames.iter().map(style).collect(),
        }
    }

    /// Mean logarithm of the density of a pose given its style, nats.
    pub fn log_likelihood(&self, model: &KeyStyleModel) -> f64 {
        let gates = Gate::all(&model.components, model.axis_count()).unwrap_or_default();
        let of = |(x, u): (&Row, &Style)| {
            log_likelihood((&model.components, &gates), model.variance, x, &model.standardised(u))
        };
        self.rows.iter().zip(&self.styles).map(of).sum::<f64>() / self.rows.len() as f64
    }
}

/// Mean angle between the joints of two poses, degrees, and mean distance with the hips at one place, centimetres.
pub fn pose_error(space: &PoseSpace, a: &Row, b: &Row) -> [f64; 2] {
    let [a, b] = [a, b].map(|row| space.rotations(row));
    let angles: f64 = angles(&a, &b).sum();
    let [a, b] =
        [a, b].map(|rotations| world_from_local(&space.proportions, &Pose { root: Vec3::ZERO, rotations }).positions);
    let distances: f64 = a.iter().zip(&b).map(|(a, b)| 100.0 * f64::from((*a - *b).length())).sum();
    [angles / JOINTS as f64, distances / JOINTS as f64]
}

/// Greatest angle by which any joint moves from one pose to the next, degrees.
pub fn largest_change(space: &PoseSpace, rows: &[Row]) -> f64 {
    let rotations: Vec<_> = rows.iter().map(|row| space.rotations(row)).collect();
    rotations.windows(2).flat_map(|w| angles(&w[0], &w[1])).fold(0.0, f64::max)
}

/// Mean magnitude of the third difference of the joints' degrees of freedom, radians; `None` for fewer than four poses.
pub fn third_difference(rows: &[Row]) -> Option<f64> {
    let of = |w: &[Row], d: usize| (w[3][d] - 3.0 * w[2][d] + 3.0 * w[1][d] - w[0][d]).abs();
    let sum: f64 = rows.windows(4).map(|w| (0..ROTATION_DIMS).map(|d| of(w, d)).sum::<f64>()).sum();
    (rows.len() > 3).then(|| sum / ((rows.len() - 3) * ROTATION_DIMS) as f64)
}

/// Baseline predictors of the pose of a style.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Baseline {
    /// The mean of all recorded poses.
    Mean,
    /// The recorded pose of the nearest style.
    Nearest,
    /// The recorded poses, weighted by a Gaussian of the distances of their styles, of this many standard deviations.
    Kernel(f64),
}

impl Baseline {
    /// The pose of a style in the axes' units.
    pub fn row(self, model: &KeyStyleModel, style: &Style) -> Row {
        let u = model.standardised(style);
        let square = |v: &Style| -> f64 { u.iter().zip(v).map(|(u, v)| (u - v) * (u - v)).sum() };
        if self == Self::Nearest {
            let nearest = model.styles.iter().map(square).enumerate().reduce(|a, b| if b.1 < a.1 { b } else { a });
            return model.recorded_row(nearest.map_or(0, |(i, _)| i));
        }
        let (mut sum, mut row) = (0.0, [0.0; DIMS]);
        for (i, v) in model.styles.iter().enumerate() {
            let weight = match self {
                Self::Kernel(width) => double::exp(-0.5 * square(v) / (width * width)).max(1e-300),
                _ => 1.0,
            };
            sum += weight;
            row.iter_mut().zip(&model.rows[i]).for_each(|(x, of)| *x += weight * f64::from(*of));
        }
        row.map(|x| x / sum)
    }
}
