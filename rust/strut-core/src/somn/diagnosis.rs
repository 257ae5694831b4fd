//! Share of the pose's variance that the style explains (`docs/methods/somn.md` §6).

use super::mixture::{Style, squared_distance};
use super::model::KeyStyleModel;
use super::pose_space::DIMS;
use crate::math::float_funcs::double;

/// Width of the kernel over styles, standard deviations.
const WIDTH: f64 = 0.3;
/// Frames closer in time than this are excluded as correlated: one second.
const SAME_MOMENT: usize = 30;
/// Most frames that are predicted, and most frames that each prediction uses.
const MAX_QUERIES: usize = 200;
const MAX_REFERENCES: usize = 2000;

impl KeyStyleModel {
    /// Returns the share of the poses' variation that the styles do not explain: the error of predicting a recorded pose from
    /// those of similar styles at other moments, relative to the error of the mean pose. It is about 0.3 for a walk by its
    /// feet and 0.5 for punches. Above [`KeyStyleModel::MAX_UNEXPLAINED_SHARE`] poses of one style have little in common, and
    /// synthesis returns a mean of different poses.
    pub fn unexplained_share(&self) -> f64 {
        let frames = self.rows.len();
        let every = |most: usize| (0..frames).step_by(frames.div_ceil(most).max(1));
        let mut mean = [0.0; DIMS];
        for row in &self.rows {
            mean.iter_mut().zip(row).for_each(|(m, x)| *m += f64::from(*x) / frames as f64);
        }
        let (mut left, mut all) = (0.0, 0.0);
        for t in every(MAX_QUERIES) {
            let (mut sum, mut predicted) = (0.0, [0.0; DIMS]);
            for i in every(MAX_REFERENCES).filter(|i| i.abs_diff(t) > SAME_MOMENT) {
                let weight = double::exp(-0.5 * squared(&self.styles[t], &self.styles[i]) / (WIDTH * WIDTH));
                sum += weight;
                predicted.iter_mut().zip(&self.rows[i]).for_each(|(x, of)| *x += weight * f64::from(*of));
            }
            let row = self.recorded_row(t);
            // An isolated style has no neighbours: the mean is predicted.
            let predicted = if sum > 1e-6 { predicted.map(|x| x / sum) } else { mean };
            left += squared_distance(&row, &predicted);
            all += squared_distance(&row, &mean);
        }
        (left / all.max(f64::MIN_POSITIVE)).sqrt()
    }

    /// [`KeyStyleModel::unexplained_share`] above which another style should be chosen, or one more axis.
    pub const MAX_UNEXPLAINED_SHARE: f64 = 0.6;
}

fn squared(u: &Style, v: &Style) -> f64 {
    u.iter().zip(v).map(|(u, v)| (u - v) * (u - v)).sum()
}
