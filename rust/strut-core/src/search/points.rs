//! Points of a frame: the joints that the [metric](super::metric) compares, with their weights.

use super::lanes::{FloatLane, inner_product};
use crate::humanoid::{JOINTS, Role};
use crate::math::Vec3;
use crate::math::float_funcs::sin_cos;
use crate::pose_vector::Placement;
use std::sync::LazyLock;

/// Number of joints of the metric.
pub(super) const POINTS: usize = JOINT_WEIGHTS.len();
/// Number of joints of the lower-body metric: the first of [`POINTS`].
pub(super) const LEG_POINTS: usize = 4 * LEG_LANES;
/// 4-float lanes of a frame's heights (and of x, and of z).
pub(super) const LANES: usize = POINTS / 4;
/// Number of these lanes in the lower-body metric.
pub(super) const LEG_LANES: usize = 2;

/// Relative weight of each joint, by size and visibility. The spine joint is omitted because it follows from hips and
/// chest; so there are five whole lanes. Legs come first.
pub const JOINT_WEIGHTS: [(Role, f32); 20] = [
    (Role::LeftUpperLeg, 1.0),
    (Role::RightUpperLeg, 1.0),
    (Role::LeftLowerLeg, 1.5),
    (Role::RightLowerLeg, 1.5),
    (Role::LeftFoot, 1.5),
    (Role::RightFoot, 1.5),
    (Role::LeftToes, 0.5),
    (Role::RightToes, 0.5),
    (Role::Hips, 1.0),
    (Role::Chest, 1.5),
    (Role::Neck, 0.5),
    (Role::Head, 1.5),
    (Role::LeftShoulder, 0.25),
    (Role::RightShoulder, 0.25),
    (Role::LeftUpperArm, 1.0),
    (Role::RightUpperArm, 1.0),
    (Role::LeftLowerArm, 1.0),
    (Role::RightLowerArm, 1.0),
    (Role::LeftHand, 1.0),
    (Role::RightHand, 1.0),
];

/// Weights of the points of one frame; they sum to 1 over the whole body.
pub(super) fn point_weights() -> [f32; POINTS] {
    let sum: f32 = JOINT_WEIGHTS.iter().map(|(_, w)| w).sum();
    JOINT_WEIGHTS.map(|(_, w)| w / sum)
}

/// Square roots of [`point_weights`].
pub(super) fn point_roots() -> &'static [f32; POINTS] {
    static ROOTS: LazyLock<[f32; POINTS]> = LazyLock::new(|| point_weights().map(f32::sqrt));
    &ROOTS
}

/// Heights of one frame's points.
pub(super) type HeightRow = [FloatLane; LANES];
/// x and z of one frame's points: four x, four z, and so on.
pub(super) type GroundRow = [FloatLane; 2 * LANES];
/// Both: four heights, four x, four z, and so on.
pub(super) type PointRow = [FloatLane; 3 * LANES];

/// Index of the lane that contains the feet.
const FEET: usize = 1;
/// Joints in that lane.
pub(crate) const FEET_ROLES: [Role; 4] = [Role::LeftFoot, Role::RightFoot, Role::LeftToes, Role::RightToes];
/// x, y and z of [`FEET_ROLES`], metres.
pub(crate) type Feet = [FloatLane; 3];

/// Points of one frame, multiplied by √w.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct FramePoints(pub(super) PointRow);

impl FramePoints {
    /// Points of a heading-free point cloud (hips above the origin) at a placement on the ground.
    pub(super) fn new(cloud: &[Vec3; JOINTS], at: Placement) -> Self {
        let (sin, cos) = sin_cos(at.heading);
        let mut points = Self::default();
        for (i, (w, (role, _))) in point_roots().iter().zip(&JOINT_WEIGHTS).enumerate() {
            let p = cloud[role.index()];
            points.set(i, w * p.y, w * (at.x + cos * p.x + sin * p.z), w * (at.z - sin * p.x + cos * p.z));
        }
        points
    }

    /// Squared length of all points.
    pub(super) fn norm(&self) -> f32 {
        inner_product::<{ 3 * LANES }, { 3 * LANES }, LANES>(&[self.0], &[self.0])
    }

    /// Heights only.
    #[inline]
    pub(super) fn heights(&self) -> HeightRow {
        std::array::from_fn(|l| self.0[3 * l])
    }

    /// Height, x and z of a point.
    pub(super) fn get(&self, point: usize) -> [f32; 3] {
        let (lane, i) = (point / 4, point % 4);
        std::array::from_fn(|c| self.0[3 * lane + c][i])
    }

    fn set(&mut self, point: usize, height: f32, x: f32, z: f32) {
        let (lane, i) = (point / 4, point % 4);
        for (c, v) in [height, x, z].into_iter().enumerate() {
            self.0[3 * lane + c][i] = v;
        }
    }

    /// Points `steps` frames before these, extrapolated from their motion to the `next` frame.
    pub(super) fn extrapolated_back(&self, next: &Self, steps: f32) -> Self {
        let mut out = Self::default();
        for i in 0..POINTS {
            let (a, b) = (self.get(i), next.get(i));
            let [y, x, z]: [f32; 3] = std::array::from_fn(|c| a[c] - (b[c] - a[c]) * steps);
            out.set(i, y, x, z);
        }
        out
    }

    /// Positions of the feet.
    pub(super) fn feet(&self) -> Feet {
        let roots = &point_roots()[4 * FEET..][..4];
        [1, 0, 2].map(|c| std::array::from_fn(|i| self.0[3 * FEET + c][i] / roots[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn feet_come_back_from_the_points_of_a_frame() {
        let cloud = std::array::from_fn(|j| Vec3::new(0.1 * j as f32, 1.0 - 0.05 * j as f32, 0.02 * j as f32));
        let points = FramePoints::new(&cloud, Placement { x: 2.0, z: -1.0, heading: 0.0 });
        let [x, y, z] = points.feet();
        for (i, role) in FEET_ROLES.iter().enumerate() {
            let expected = cloud[role.index()] + Vec3::new(2.0, 0.0, -1.0);
            assert!((Vec3::new(x[i], y[i], z[i]) - expected).length() < 1e-5);
        }
    }

    #[test]
    fn weights_sum_to_one() {
        assert!((point_weights().iter().sum::<f32>() - 1.0).abs() < 1e-6);
    }
}
