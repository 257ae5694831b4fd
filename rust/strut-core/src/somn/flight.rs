//! Flight phases: height of the feet above the ground while neither is planted (`docs/methods/somn.md` §7).

use super::model::KeyStyleModel;
use super::pose_space::{DIMS, PoseSpace, Row};
use crate::humanoid::Pose;

/// Number of recorded frames that are sampled, evenly spread.
const SAMPLES: usize = 256;
/// Share of the recorded frames, those with the lowest feet, that is assumed to stand; the highest of them defines the
/// ground.
const STANDING_SHARE: f32 = 0.1;
/// A foot higher than this above the ground is in flight, metres, …
const FLYING: f32 = 0.02;
/// … and a model has flight phases if at least this share of the recorded frames is in flight: at most 0.03 in recorded
/// walks, at least 0.15 in runs with flight phases.
const LEAST_SHARE: f32 = 0.1;
/// A model's clearance of a standing pose is off by up to this, metres: up to it the height is 0, from twice this on it is
/// the clearance.
const UNCERTAIN: f32 = 0.02;

/// Ground level of recordings with flight phases.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flight {
    /// Height of the lowest foot while it is planted, by the hips' heights in the rows, metres.
    ground: f32,
}

impl Flight {
    /// Estimates the ground of a model's recordings; `None` if they have no flight phases.
    pub(super) fn of(model: &KeyStyleModel) -> Option<Self> {
        let step = model.rows.len().div_ceil(SAMPLES).max(1);
        let clearance = |row: &[f32; DIMS]| {
            let row = row.map(f64::from);
            clearance(&row, &model.space.pose(&row))
        };
        let mut heights: Vec<f32> = model.rows.iter().step_by(step).map(clearance).collect();
        heights.sort_unstable_by(f32::total_cmp);
        let ground = *heights.get((heights.len() as f32 * STANDING_SHARE) as usize)?;
        let flying = heights.iter().filter(|height| **height - ground > FLYING).count();
        (flying as f32 >= LEAST_SHARE * heights.len() as f32).then_some(Self { ground })
    }

    /// Height of the lowest foot above the ground in a row, metres, by the row's pose on the floor; 0 if it is planted.
    pub(super) fn height(self, row: &Row, standing: &Pose) -> f32 {
        let height = clearance(row, standing) - self.ground;
        (2.0 * (height - UNCERTAIN)).min(height).max(0.0)
    }
}

/// Height of the lowest foot if the hips are at the row's height, metres.
fn clearance(row: &Row, standing: &Pose) -> f32 {
    PoseSpace::height(row) - standing.root.y
}
