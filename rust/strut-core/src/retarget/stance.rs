//! How a character stands: its soles where the body's are, although its feet have other proportions.
//!
//! Ankles that are scaled like the legs put the feet right only where feet and legs have the same ratio. A longer foot that
//! rolls over heel and ball would sink into the ground and skate: its ankle has to move as the foot turns.

use super::Binding;
use crate::humanoid::{Proportions, Role};
use crate::kinematics::{Sole, Soles, WorldPose};
use crate::math::float_funcs::atan2;
use crate::math::{Quat, Vec3};

/// Deepest that a sole may lie under the ground and still be lifted, metres on a body of legs like the mannequin's: recorded
/// feet sink by millimetres. Whatever lies deeper stands on other ground.
const SINKING: f32 = 0.02;

/// How deep soles are left under the ground, metres: nobody sees it. `shared/spec/embedding.md` section 7 allows twice as
/// much, as the points of a sole are a sample of its vertices.
const UNSEEN: f32 = 0.0025;

/// How far the toes reach beyond the toe joint, as a share of the distance from ankle to toe joint on the ground. The
/// mannequin's touch the ground up to there.
const TIP_SHARE: f32 = 0.4;

/// A point of a character's foot that can touch the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolePoint {
    /// 0 left, 1 right.
    pub side: usize,
    /// Whether it moves with the toes rather than with the foot.
    pub on_toes: bool,
    /// From the joint that it moves with to the point in the file's zero pose, along the file's axes and in its unit.
    pub at: Vec3,
}

/// The feet of two bodies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stance {
    body: Foot,
    character: Foot,
    /// Length of the character's legs over that of the body's.
    ratio: f32,
    /// How much farther to +X the hip joints of the character lie than those of the body, scaled like the legs, left first:
    /// its feet stand as much farther apart. Metres.
    widths: [f32; 2],
    /// The character's points of each foot in the frames of foot and toes, metres; whether they are the toes'.
    points: [Vec<(bool, Vec3)>; 2],
}

/// The feet of one body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Foot {
    soles: Soles,
    /// Where the toe joints lie in the feet's frames, left first.
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
    /// From a body to a character whose legs are `ratio` times as long.
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

    /// The ankle of the left (0) or right (1) foot, metres of the character, given where it lies when it is scaled like the
    /// legs: moved so that the point on which the foot turns stays, at its height.
    pub(super) fn ankle(&self, side: usize, world: &WorldPose, scaled: Vec3) -> Vec3 {
        let rotations = Soles::JOINTS[side].map(|joint: Role| world.rotations[joint.index()]);
        let ahead = rotations[0] * Vec3::Z;
        let level = [Quat::from_rotation_y(atan2(ahead.x, ahead.z)); 2];
        let [body, character] = [self.body, self.character].map(|foot| {
            let (turned, flat) = (foot.sole(side, rotations), foot.sole(side, level));
            // The pivot that has moved is the same mixture of heel and ball on the flat foot.
            let share = turned.heel_share();
            let moved = turned.pivot() - (flat.heel * share + flat.ball * (1.0 - share));
            Vec3::new(moved.x, foot.lowest(side, rotations) - foot.lowest(side, level), moved.z)
        });
        // Across the foot rather than the pelvis, which turns while the foot stands.
        let apart = level[0] * Vec3::X * self.widths[side];
        let mut ankle = scaled + apart + body * self.ratio - character;
        let depth = -UNSEEN - (ankle.y + self.lowest_point(side, rotations));
        ankle.y += depth.clamp(0.0, SINKING * self.ratio);
        ankle
    }

    /// Height of the lowest of the character's points above its ankle; of its heel, ball and tip where no points are known.
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
