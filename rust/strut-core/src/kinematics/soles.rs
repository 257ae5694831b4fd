//! Heel and ball of a foot, the points that touch the ground.

use super::forward::{WorldPose, world_from_local};
use crate::humanoid::{Pose, Proportions, Role};
use crate::math::{Quat, Vec3};

/// Distance of the heel behind the ankle, as a share of the distance from ankle to toes on the ground.
const HEEL_SHARE: f32 = 0.35;
/// Height difference of heel and ball over which the pivot changes from one to the other, metres.
const PIVOT_BLEND: f32 = 0.04;

/// Positions of the soles on the feet: below ankle and toes, by the heights that these have in the T-pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Soles {
    heel_in_foot: [Vec3; 2],
    ball_in_toes: [Vec3; 2],
}

/// The ground points of one foot in the world, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// Back of the heel.
    pub heel: Vec3,
    /// Ball of the foot, below the toe joint.
    pub ball: Vec3,
}

impl Soles {
    /// Ankle and toe joints, left first.
    pub const JOINTS: [[Role; 2]; 2] = [[Role::LeftFoot, Role::LeftToes], [Role::RightFoot, Role::RightToes]];

    /// The soles of a humanoid.
    pub fn new(proportions: &Proportions) -> Self {
        let rest = Pose { root: proportions.offsets[0], ..Pose::default() };
        let world = world_from_local(proportions, &rest);
        let height = |role: Role| world.positions[role.index()].y.max(0.0);
        Self {
            heel_in_foot: Self::JOINTS.map(|[foot, toes]| {
                let forward = proportions.offsets[toes.index()] * Vec3::new(1.0, 0.0, 1.0);
                -Vec3::Y * height(foot) - forward * HEEL_SHARE
            }),
            ball_in_toes: Self::JOINTS.map(|[_, toes]| -Vec3::Y * height(toes)),
        }
    }

    /// Ground points of the left (0) or right (1) foot.
    pub fn of(&self, world: &WorldPose, side: usize) -> Sole {
        let [foot, toes] = Self::JOINTS[side].map(Role::index);
        Sole {
            heel: world.positions[foot] + world.rotations[foot] * self.heel_in_foot[side],
            ball: world.positions[toes] + world.rotations[toes] * self.ball_in_toes[side],
        }
    }
}

impl Soles {
    /// Ground points of a foot relative to its ankle, given the world rotations of foot and toes.
    ///
    /// `toes_in_foot` is the position of the toe joint in the foot's frame, metres.
    pub fn from_ankle(&self, side: usize, [foot, toes]: [Quat; 2], toes_in_foot: Vec3) -> Sole {
        Sole { heel: foot * self.heel_in_foot[side], ball: foot * toes_in_foot + toes * self.ball_in_toes[side] }
    }
}

impl Sole {
    /// The pivot of the foot: heel or ball, whichever is lower, blended in between.
    pub fn pivot(&self) -> Vec3 {
        let heel_share = self.heel_share();
        self.heel * heel_share + self.ball * (1.0 - heel_share)
    }

    /// Weight of the heel in the pivot, 0–1.
    pub fn heel_share(&self) -> f32 {
        (0.5 + (self.ball.y - self.heel.y) / PIVOT_BLEND).clamp(0.0, 1.0)
    }

    /// Height of the lower point.
    pub fn lowest(&self) -> f32 {
        self.heel.y.min(self.ball.y)
    }

    /// Horizontal displacement of the pivot, heel or ball by which is lower, since an earlier frame.
    pub fn pivot_travel(&self, earlier: &Self) -> Vec3 {
        let heel_share = self.heel_share();
        let travel = (self.heel - earlier.heel) * heel_share + (self.ball - earlier.ball) * (1.0 - heel_share);
        Vec3::new(travel.x, 0.0, travel.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn soles_are_on_the_ground_in_the_t_pose() {
        let p = Proportions::default();
        let world = world_from_local(&p, &Pose::default());
        for side in 0..2 {
            let sole = Soles::new(&p).of(&world, side);
            assert!(sole.heel.y.abs() < 1e-5 && sole.ball.y.abs() < 1e-5);
            assert!(sole.heel.z < world.positions[Soles::JOINTS[side][0].index()].z);
        }
    }

    #[test]
    fn the_pivot_is_the_lower_point() {
        let before = Sole { heel: Vec3::new(0.0, 0.1, 0.0), ball: Vec3::ZERO };
        let after = Sole { heel: Vec3::new(0.3, 0.1, 0.0), ball: Vec3::new(0.01, 0.0, 0.0) };
        assert_eq!(after.pivot_travel(&before), Vec3::new(0.01, 0.0, 0.0));
    }
}
