//! Phases of flight: how high the feet are above the ground where neither of them stands (`docs/methods/somn.md` §7).

use super::model::KeyStyleModel;
use super::pose_space::{DIMS, PoseSpace, Row};
use crate::humanoid::Pose;

/// So many recorded frames are looked at, evenly spread.
const SAMPLES: usize = 256;
/// Of the recorded frames this share, those with the lowest feet, certainly stands: the last of them says where the ground is.
const STANDING_SHARE: f32 = 0.1;
/// A foot this high above the ground flies, metres, …
const FLYING: f32 = 0.02;
/// … and a model takes off if so large a share of the recorded frames does: in recorded walks at most 0.03, in runs with
/// phases of flight at least 0.15.
const LEAST_SHARE: f32 = 0.1;
/// What a model says of a pose that stands is off by up to this, metres: so low nobody flies, and from twice as high on as
/// high as it says.
const UNCERTAIN: f32 = 0.02;

/// Where the ground was in recordings with phases of flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flight {
    /// Height of the lowest foot while it stands, by the hips' heights in the rows, metres.
    ground: f32,
}

impl Flight {
    /// Of a model's recordings; `None` where a foot always stands.
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

    /// Height of the lowest foot above the ground in a row, metres, by the row's pose on the floor; 0 where it stands.
    pub(super) fn height(self, row: &Row, standing: &Pose) -> f32 {
        let height = clearance(row, standing) - self.ground;
        (2.0 * (height - UNCERTAIN)).min(height).max(0.0)
    }
}

/// Height of the lowest foot where the hips are as high as a row says, metres.
fn clearance(row: &Row, standing: &Pose) -> f32 {
    PoseSpace::height(row) - standing.root.y
}
