//! Stance of a character: its soles are placed like the body's, although its feet have other proportions.
//!
//! Ankles scaled like the legs place the feet correctly only if feet and legs have the same ratio. A longer foot that rolls
//! over heel and ball would penetrate the ground and skate: its ankle must move as the foot rotates.

use super::Binding;
use crate::humanoid::{Proportions, Role};
use crate::kinematics::{Sole, Soles, WorldPose};
use crate::math::float_funcs::atan2;
use crate::math::{Quat, Vec3};

/// Greatest depth of a sole under the ground from which it is lifted, metres for legs like the mannequin's: recorded feet
/// sink by millimetres. A deeper sole stands on other ground.
const SINKING: f32 = 0.02;

/// Depth at which soles are left under the ground, metres: it is not visible. Twice this depth is acceptable, because the
/// points of a sole are a sample of its vertices.
const UNSEEN: f32 = 0.0025;

/// Length of the toes beyond the toe joint, as a share of the distance from ankle to toe joint on the ground. The mannequin's
/// toes touch the ground up to there.
const TIP_SHARE: f32 = 0.4;

/// A point of a character's foot that can touch the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolePoint {
    /// 0 left, 1 right.
    pub side: usize,
    /// Whether it moves with the toes rather than with the foot.
    pub on_toes: bool,
    /// Vector from that joint to the point in the file's zero pose, along the file's axes and in its unit.
    pub at: Vec3,
}

/// The feet of two bodies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stance {
    body: Foot,
    character: Foot,
    /// Ratio of the length of the character's legs to that of the body's.
    ratio: f32,
    /// Offset to +X of the character's hip joints from the body's, scaled like the legs, left first, metres: its feet are
    /// moved apart by the same offset.
    widths: [f32; 2],
    /// The character's sole points of each foot in the frame of the foot or the toes, metres; `true` for points of the toes.
    points: [Vec<(bool, Vec3)>; 2],
}

/// The feet of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Foot {
    soles: Soles,
    /// Positions of the toe joints in the feet's frames, left first.
    toes: [Vec3; 2],
}

impl Foot {
    fn of(body: &Proportions) -> Self {
        Self { soles: Soles::new(body), toes: Soles::JOINTS.map(|[_, toes]| body.offsets[toes.index()]) }
    }

    fn sole(&self, side: usize, rotations: [Quat; 2]) -> Sole {
        self.soles.from_ankle(side, rotations, self.toes[side])
    }

    /// Height of the lowest of heel, ball and tip of the toes above the ankle.
    fn lowest(&self, side: usize, rotations: [Quat; 2]) -> f32 {
        let sole = self.sole(side, rotations);
        let reach = TIP_SHARE * (self.toes[side] * Vec3::new(1.0, 0.0, 1.0)).length();
        sole.lowest().min(sole.ball.y + (rotations[1] * Vec3::Z).y * reach)
    }
}

impl Stance {
    /// Computes the stance for a body and a character whose legs are `ratio` times as long.
    pub(super) fn between(body: &Proportions, character: &Binding, ratio: f32, points: &[SolePoint]) -> Self {
        let own = |side: usize| {
            let of_side = points.iter().filter(move |point| point.side == side);
            let placed = of_side.filter_map(|point| {
                let role = Soles::JOINTS[side][usize::from(point.on_toes)];
                let joint = character.joint_of_role[role.index()]?;
                let turned = character.rest_world_rotations[joint] * point.at;
                Some((point.on_toes, turned * character.metres_per_unit))
            });
            placed.collect()
        };
        let points = [own(0), own(1)];
        let hip = |p: &Proportions, role: Role| p.offsets[role.index()].x;
        let widths = [Role::LeftUpperLeg, Role::RightUpperLeg]
            .map(|role| hip(&character.proportions, role) - ratio * hip(body, role));
        Self { body: Foot::of(body), character: Foot::of(&character.proportions), ratio, widths, points }
    }

    /// Returns the position of the left (0) or right (1) ankle, metres of the character, given the position scaled like the
    /// legs: moved so that the pivot of the foot stays in place, at its height.
    pub(super) fn ankle(&self, side: usize, world: &WorldPose, scaled: Vec3) -> Vec3 {
        let rotations = Soles::JOINTS[side].map(|joint: Role| world.rotations[joint.index()]);
        let ahead = rotations[0] * Vec3::Z;
        let level = [Quat::from_rotation_y(atan2(ahead.x, ahead.z)); 2];
        let [body, character] = [self.body, self.character].map(|foot| {
            let (turned, flat) = (foot.sole(side, rotations), foot.sole(side, level));
            // The displacement of the pivot from the same mixture of heel and ball on the flat foot.
            let share = turned.heel_share();
            let moved = turned.pivot() - (flat.heel * share + flat.ball * (1.0 - share));
            Vec3::new(moved.x, foot.lowest(side, rotations) - foot.lowest(side, level), moved.z)
        });
        // Across the foot rather than the pelvis, which rotates while the foot is planted.
        let apart = level[0] * Vec3::X * self.widths[side];
        let mut ankle = scaled + apart + body * self.ratio - character;
        let depth = -UNSEEN - (ankle.y + self.lowest_point(side, rotations));
        ankle.y += depth.clamp(0.0, SINKING * self.ratio);
        ankle
    }

    /// Height of the lowest of the character's sole points above its ankle; of its heel, ball and tip if no points are known.
    fn lowest_point(&self, side: usize, [foot, toes]: [Quat; 2]) -> f32 {
        let toe_joint = foot * self.character.toes[side];
        let heights = self.points[side].iter().map(
            |&(on_toes, at)| {
                if on_toes { (toe_joint + toes * at).y } else { (foot * at).y }
            },
        );
        heights.reduce(f32::min).unwrap_or_else(|| self.character.lowest(side, [foot, toes]))
    }
}
