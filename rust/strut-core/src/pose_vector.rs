//! Pose ↔ degrees of freedom: the vector that search-free modelling works on (`docs/methods/mar.md` §2).
//!
//! A row holds, in this order: the root's tilt (3: exponential map of the root rotation after removing
//! the heading), the 20 other joints (3 each), hip height (m), planar velocity in the heading frame
//! (vx, vz in m/s) and heading rate (rad/s). Exponential maps are taken relative to each joint's mean
//! rotation over the neutral clips ([`PoseChart`]): the raw logarithm wraps for bones that sit near π.

use crate::humanoid::{JOINTS, Pose, Proportions, Role};
use crate::kinematics::{WorldPose, world_from_local};
use crate::math::float_funcs::{atan2, half_life_share, wrap_angle};
use crate::math::lanes::WIDTH;
use crate::math::{Quat, Vec3, exp_map};

/// Degrees of freedom of a pose.
pub const DOFS: usize = 3 * JOINTS + 4;
/// Floats of a row in memory: [`DOFS`] padded to whole 4-float lanes; the padding is zero.
pub const ROW: usize = DOFS.next_multiple_of(WIDTH);
/// Lanes of a row.
pub(crate) const LANES: usize = ROW / WIDTH;
/// Index of the hip height.
pub const HIP_HEIGHT: usize = 3 * JOINTS;
/// Index of the sideways (leftward) velocity.
pub const VELOCITY_X: usize = HIP_HEIGHT + 1;
/// Index of the forward velocity.
pub const VELOCITY_Z: usize = HIP_HEIGHT + 2;
/// Index of the heading rate.
pub const HEADING_RATE: usize = HIP_HEIGHT + 3;

/// One pose as degrees of freedom.
pub type PoseRow = [f32; ROW];

/// Half-life of the heading filter in seconds. The filter is causal, so that a live input and a
/// database clip get the same heading for the same motion; its lag is small against a step.
pub const HEADING_HALF_LIFE_SECS: f32 = 0.05;

/// Heading of a pose in radians about +Y, 0 facing +Z: perpendicular to the mean of the across-vectors
/// of the hips and of the shoulders, projected on the ground. `None` if that projection vanishes.
pub fn heading_of(world: &WorldPose) -> Option<f32> {
    let at = |r: Role| world.positions[r.index()];
    let across = at(Role::LeftUpperLeg) - at(Role::RightUpperLeg) + at(Role::LeftUpperArm) - at(Role::RightUpperArm);
    let forward = across.cross(Vec3::Y);
    (forward.x * forward.x + forward.z * forward.z > 1e-8).then(|| atan2(forward.x, forward.z))
}

/// Causal smoothing of the heading.
#[derive(Clone, Copy, Debug, Default)]
pub struct HeadingFilter {
    heading: Option<f32>,
}

impl HeadingFilter {
    /// Returns the smoothed heading after a further frame. The first frame's heading is not smoothed; a pose without a
    /// heading keeps the last one.
    pub fn update(&mut self, world: &WorldPose, dt_secs: f32) -> f32 {
        let last = self.heading;
        let raw = heading_of(world).or(last).unwrap_or(0.0);
        let next = match last {
            None => raw,
            Some(h) => wrap_angle(h + wrap_angle(raw - h) * half_life_share(dt_secs, HEADING_HALF_LIFE_SECS)),
        };
        self.heading = Some(next);
        next
    }
}

/// Place and heading of a frame's root on the ground, which a row does not contain.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placement {
    /// World x of the hips, metres.
    pub x: f32,
    /// World z of the hips, metres.
    pub z: f32,
    /// Heading, radians about +Y.
    pub heading: f32,
}

impl Placement {
    /// Returns the placement one step later, given the row's velocities and the step's duration and turn: the heading changes
    /// by `turn`, then the velocity is applied in the new heading frame.
    pub fn advanced(self, row: &PoseRow, dt_secs: f32, turn: f32) -> Self {
        let heading = wrap_angle(self.heading + turn);
        let step =
            Quat::from_rotation_y(heading) * Vec3::new(row[VELOCITY_X] * dt_secs, 0.0, row[VELOCITY_Z] * dt_secs);
        Self { x: self.x + step.x, z: self.z + step.z, heading }
    }
}

/// The mean rotation of every joint: the centres of the exponential maps. Entry 0 is the mean of the
/// root's rotation after removing the heading.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseChart {
    /// Mean rotations by role, unit quaternions.
    pub means: [Quat; JOINTS],
}

impl Default for PoseChart {
    fn default() -> Self {
        Self { means: [Quat::IDENTITY; JOINTS] }
    }
}

impl PoseChart {
    /// The chart of a set of poses with their headings (Karcher means).
    pub fn from_poses<'a>(poses: impl Iterator<Item = (&'a Pose, f32)> + Clone) -> Self {
        let mut chart = Self::default();
        for j in 0..JOINTS {
            let rotations: Vec<Quat> = poses
                .clone()
                .map(|(p, heading)| if j == 0 { heading_free(p, heading) } else { p.rotations[j] })
                .collect();
            chart.means[j] = exp_map::karcher_mean(&rotations);
        }
        chart
    }

    /// Encodes a pose as a row. `previous` is the placement of the frame before, `dt_secs` (> 0) earlier; without it the
    /// velocities are zero.
    pub fn encode(&self, pose: &Pose, heading: f32, previous: Option<Placement>, dt_secs: f32) -> PoseRow {
        let mut row = [0.0; ROW];
        for j in 0..JOINTS {
            let q = if j == 0 { heading_free(pose, heading) } else { pose.rotations[j] };
            let v = exp_map::log(self.means[j].inv_mul(q));
            row[3 * j..3 * j + 3].copy_from_slice(&v.to_array());
        }
        row[HIP_HEIGHT] = pose.root.y;
        if let Some(p) = previous {
            let travel = Vec3::new(pose.root.x - p.x, 0.0, pose.root.z - p.z) / dt_secs;
            let v = Quat::from_rotation_y(heading).inv_mul_vec3(travel);
            row[VELOCITY_X] = v.x;
            row[VELOCITY_Z] = v.z;
            row[HEADING_RATE] = wrap_angle(heading - p.heading) / dt_secs;
        }
        row
    }

    /// Rotation of one joint in a row; the hips' without the heading.
    pub fn rotation(&self, role: Role, row: &PoseRow) -> Quat {
        let j = role.index();
        self.means[j] * exp_map::exp(Vec3::new(row[3 * j], row[3 * j + 1], row[3 * j + 2]))
    }

    /// Decodes a row to the pose at a placement.
    pub fn decode(&self, row: &PoseRow, at: Placement) -> Pose {
        let mut pose = Pose { root: Vec3::new(at.x, row[HIP_HEIGHT], at.z), rotations: [Quat::IDENTITY; JOINTS] };
        for role in Role::ALL {
            pose.rotations[role.index()] = self.rotation(role, row);
        }
        pose.rotations[0] = Quat::from_rotation_y(at.heading) * pose.rotations[0];
        pose
    }

    /// Decodes successive rows, `dt_secs` apart, beginning above the origin towards +Z.
    pub fn decode_clip(&self, rows: impl Iterator<Item = PoseRow>, dt_secs: f32) -> Vec<Pose> {
        let mut at: Option<Placement> = None;
        rows.map(|row| {
            let place = at.map_or(Placement::default(), |at| at.advanced(&row, dt_secs, row[HEADING_RATE] * dt_secs));
            at = Some(place);
            self.decode(&row, place)
        })
        .collect()
    }
}

fn heading_free(pose: &Pose, heading: f32) -> Quat {
    Quat::from_rotation_y(-heading) * pose.rotations[0]
}

/// Joint positions with the heading removed and the hips above the origin, metres (`point_cloud` of
/// the database file).
pub fn point_cloud(proportions: &Proportions, pose: &Pose, heading: f32) -> [Vec3; JOINTS] {
    heading_free_positions(&world_from_local(proportions, pose), heading)
}

/// [`point_cloud`] of a pose whose world positions are known.
pub fn heading_free_positions(world: &WorldPose, heading: f32) -> [Vec3; JOINTS] {
    let hips = world.positions[0] * Vec3::new(1.0, 0.0, 1.0);
    let facing = Quat::from_rotation_y(-heading);
    world.positions.map(|p| facing * (p - hips))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn pose() -> impl Strategy<Value = Pose> {
        (prop::array::uniform3(-3.0f32..3.0), prop::collection::vec(prop::array::uniform3(-1.0f32..1.0), JOINTS))
            .prop_map(|(root, rotations)| {
                let mut pose = Pose { root: Vec3::from_array(root), ..Pose::default() };
                for (q, v) in pose.rotations.iter_mut().zip(rotations) {
                    *q = exp_map::exp(Vec3::from_array(v));
                }
                pose
            })
    }

    proptest! {
        #[test]
        fn decoding_gives_the_encoded_pose_back(p in pose(), heading in -3.0f32..3.0) {
            let chart = PoseChart { means: [exp_map::exp(Vec3::new(0.2, -0.4, 0.3)); JOINTS] };
            let before = Placement { x: 0.5, z: -0.2, heading: heading - 0.1 };
            let row = chart.encode(&p, heading, Some(before), 0.02);
            let at = before.advanced(&row, 0.02, row[HEADING_RATE] * 0.02);
            let back = chart.decode(&row, at);
            prop_assert!((back.root - p.root).length() < 1e-4);
            for (a, b) in back.rotations.iter().zip(&p.rotations) {
                prop_assert!(a.dot(*b).abs() > 1.0 - 1e-5);
            }
        }

        #[test]
        fn heading_turns_with_the_body(turn in -3.0f32..3.0) {
            let mut p = Pose::default();
            p.rotations[0] = Quat::from_rotation_y(turn);
            let heading = heading_of(&world_from_local(&Proportions::default(), &p)).unwrap();
            prop_assert!(wrap_angle(heading - turn).abs() < 1e-4);
        }
    }
}
