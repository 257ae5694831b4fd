//! Predictions as numbers. An engine computes them in one thread, and performers use them in another.
//!
//! Order: number of frames, number of styles, the neutral style, rate (Hz), whether frames last as long as predicted,
//! whether feet are planted; the means of the chart (x y z w), bone offsets (x y z), the least and the greatest row
//! observed; for each frame its row, position (x, z, heading), turn and the two contact likelihoods; for each frame and
//! style its row, duration and the two contact likelihoods.

use super::{FADE_FRAMES, Predictions};
use crate::humanoid::{JOINTS, Proportions};
use crate::math::{Quat, Vec3};
use crate::pose_vector::{Placement, PoseChart, PoseRow, ROW};
use crate::transfer::output::{OutputInput, Predicted};
use thiserror::Error;

/// Sizes of the header, of a frame, and of a style in a frame, in numbers.
const HEAD: usize = 6;
const FIXED: usize = HEAD + 4 * JOINTS + 3 * JOINTS + 2 * ROW;
const OF_FRAME: usize = ROW + 6;
const OF_STYLE: usize = ROW + 3;

/// Tolerance of the squared length of a rotation, about 1.
const UNIT: f32 = 1e-3;

/// The numbers are not valid predictions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("these {0} numbers are not predictions of a motion in several styles")]
pub struct PredictionsError(usize);

impl Predictions {
    /// Encodes the predictions as numbers, which [`Predictions::from_floats`] reads.
    pub fn to_floats(&self) -> Vec<f32> {
        let flags = [self.timing, self.footplant].map(|flag| f32::from(u8::from(flag)));
        let counts = [self.frames(), self.styles, self.neutral].map(|count| count as f32);
        let mut floats = Vec::with_capacity(FIXED + self.frames() * (OF_FRAME + self.styles * OF_STYLE));
        floats.extend(counts.into_iter().chain([self.rate_hz]).chain(flags));
        floats.extend(self.chart.means.iter().flat_map(|mean| mean.to_array()));
        floats.extend(self.proportions.offsets.iter().flat_map(Vec3::to_array));
        floats.extend(self.observed_range.iter().flatten());
        for (OutputInput { row, at, turn }, contact) in &self.output_inputs {
            floats.extend(row.iter().chain(&[at.x, at.z, at.heading, *turn]).chain(contact));
        }
        for Predicted { row, step_secs, contact } in &self.predicted {
            floats.extend(row.iter().chain([step_secs]).chain(contact));
        }
        floats
    }

    /// Decodes the numbers of [`Predictions::to_floats`].
    ///
    /// # Errors
    /// If the numbers are invalid: wrong count, not finite, no style, a body without limbs, means that are not
    /// rotations, or least values above greatest ones.
    pub fn from_floats(floats: &[f32]) -> Result<Self, PredictionsError> {
        read(floats).ok_or(PredictionsError(floats.len()))
    }
}

fn read(floats: &[f32]) -> Option<Predictions> {
    let (head, rest) = floats.split_first_chunk::<HEAD>()?;
    let [frames, styles, neutral] = [head[0], head[1], head[2]].map(|count| count as usize);
    let [rate_hz, timing, footplant] = [head[3], head[4], head[5]];
    let of_styles = styles.checked_mul(OF_STYLE)?;
    let expected = frames.checked_mul(of_styles.checked_add(OF_FRAME)?)?.checked_add(FIXED)?;
    let is_valid = floats.len() == expected && floats.iter().all(|v| v.is_finite());
    if !is_valid || frames < 2 * FADE_FRAMES || neutral >= styles || !(1.0..=1000.0).contains(&rate_hz) {
        return None;
    }
    let (means, rest) = rest.split_at(4 * JOINTS);
    let (offsets, rest) = rest.split_at(3 * JOINTS);
    let (range, rest) = rest.split_at(2 * ROW);
    let (of_frames, of_styles) = rest.split_at(frames * OF_FRAME);
    let proportions = Proportions { offsets: chunks(offsets, Vec3::from_array)? };
    let observed_range: [PoseRow; 2] = chunks(range, |row: [f32; ROW]| row)?;
    let output_inputs = of_frames.as_chunks::<OF_FRAME>().0.iter().map(|of| {
        let (row, &[x, z, heading, turn, left, right]) = split(of);
        (OutputInput { row, at: Placement { x, z, heading }, turn }, [left, right])
    });
    let predicted = of_styles.as_chunks::<OF_STYLE>().0.iter().map(|of| {
        let (row, &[step_secs, left, right]) = split(of);
        Predicted { row, step_secs, contact: [left, right] }
    });
    let chart = PoseChart { means: chunks(means, Quat::from_array)? };
    let are_rotations = chart.means.iter().all(|q| (q.dot(*q) - 1.0).abs() <= UNIT);
    let is_range = observed_range[0].iter().zip(&observed_range[1]).all(|(least, greatest)| least <= greatest);
    (are_rotations && is_range && proportions.is_valid()).then(|| Predictions {
        chart,
        proportions,
        rate_hz,
        observed_range: Box::new(observed_range),
        neutral,
        styles,
        timing: timing != 0.0,
        footplant: footplant != 0.0,
        output_inputs: output_inputs.collect(),
        predicted: predicted.collect(),
    })
}

/// Values of `N` numbers each; `None` if there are not `M` of them.
fn chunks<T, const N: usize, const M: usize>(floats: &[f32], of: impl Fn([f32; N]) -> T) -> Option<[T; M]> {
    let values: Vec<T> = floats.as_chunks::<N>().0.iter().map(|chunk| of(*chunk)).collect();
    values.try_into().ok()
}

/// Splits numbers into their first row and the `N` numbers after it.
fn split<const M: usize, const N: usize>(floats: &[f32; M]) -> (PoseRow, &[f32; N]) {
    const { assert!(M == ROW + N) };
    let (row, rest) = floats.split_at(ROW);
    let both = row.try_into().ok().zip(rest.try_into().ok());
    both.unwrap_or(([0.0; ROW], &[0.0; N]))
}
