//! A walk that halts for drills and continues.
//!
//! A halt is a closing step: one foot stays planted while the other comes beside it; walking continues with a step out
//! of the stance. During these steps every quantity follows a quintic that continues the motions before and after
//! (Flash & Hogan 1985), the planted foot rolls in place, and the legs are solved between pelvis and feet, so that no
//! foot slides.

use crate::drill::{Drill, perform_drill};
use crate::feet::{FootGeometry, FootPose, pitched};
use crate::keys::quintic;
use crate::path::Side;
use crate::pelvis::{Legs, soft_min};
use crate::perform::{Excursion, Performance, perform_excursion, place_leg};
use crate::style::Style;
use crate::styles::STYLES;
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose, Proportions, Role};
use strut_core::math::float_funcs::{asin, atan2};
use strut_core::math::interpolation::smooth_step;
use strut_core::math::{Quat, Vec3, exp_map};

/// A gait with drills in the middle. It ends as it begins, so that it can be looped.
#[derive(Clone, Copy, Debug)]
pub struct Interlude {
    /// The gait; around the halt it is a slow walk.
    pub(crate) gait: Excursion,
    /// Stride of the gait in which the halt occurs.
    pub(crate) halt: u32,
    /// The drills, in order.
    pub(crate) drills: &'static [Drill],
}

impl Interlude {
    /// Name of the take.
    pub fn name(&self) -> &'static str {
        self.gait.script.name
    }
}

/// Phases of the stride at which the gait is interrupted and resumed: the left foot is planted, the right one moves
/// away from it.
const LEFT_AT: f32 = 0.22;
/// See `LEFT_AT`.
const TAKEN_UP_AT: f32 = 0.42;
/// Duration of a closing or opening step in the neutral style, and of the step between two drills, seconds.
const STEP_SECS: f32 = 0.48;
/// Height by which a foot is lifted on a step of `ARCH_WAY` or more, metres.
const ARCH: f32 = 0.05;
/// See `ARCH`.
const ARCH_WAY: f32 = 0.1;
/// Scales t³(1 − t)³ to a height of 1.
const ARCH_SCALE: f32 = 64.0;
/// Height above which a foot may deviate from its path, metres.
const FREE_ABOVE: f32 = 0.1;
/// Softness of the limit of the pelvis height by the reach of the planted leg, metres.
const REACH_SOFTNESS: f32 = 0.004;

/// Performs an interlude as [`perform_excursion`] does an excursion. A step between two parts counts as a unit of phase.
pub fn perform_interlude(interlude: &Interlude, style: &Style, body: &Proportions, rate_hz: f32) -> Performance {
    let gait = perform_excursion(&interlude.gait, style, body, rate_hz);
    let frame_at = |within: f32| gait.phase.partition_point(|p| *p < interlude.halt as f32 + within);
    let (left, taken_up) = (frame_at(LEFT_AT), frame_at(TAKEN_UP_AT));
    let joiner = Joiner::new(body, style, rate_hz);
    let mut whole = part(&gait, 0..left);
    // The guard position has the left foot ahead. A step from or to walking therefore keeps the left foot planted.
    let mut planted = Side::Left;
    for drill in interlude.drills {
        joiner.append(&mut whole, perform_drill(drill, style, body, rate_hz), planted);
        planted = Side::Right;
    }
    joiner.append(&mut whole, part(&gait, taken_up..gait.phase.len()), Side::Left);
    whole
}

fn part(of: &Performance, frames: std::ops::Range<usize>) -> Performance {
    Performance {
        motion: HumanoidMotion { poses: of.motion.poses[frames.clone()].to_vec(), ..of.motion },
        phase: of.phase[frames.clone()].to_vec(),
        planted: of.planted[frames].to_vec(),
    }
}

/// A foot on or above the ground, described by its stance.
#[derive(Clone, Copy, Debug)]
struct Stand {
    /// The ankle's projection in the flat foot.
    print: Vec3,
    heading: f32,
    /// Pitch of foot and toes, toes up.
    pitches: [f32; 2],
}

impl Stand {
    fn mix(&self, to: &Self, mix: impl Fn(f32, f32) -> f32) -> [f32; 2] {
        [0, 1].map(|i| mix(self.pitches[i], to.pitches[i]))
    }
}

/// Joins performances of a body in a style.
struct Joiner {
    legs: Legs,
    geometry: FootGeometry,
    proportions: Proportions,
    /// Number of frames of a step.
    frames: usize,
}

impl Joiner {
    fn new(body: &Proportions, style: &Style, rate_hz: f32) -> Self {
        let secs = STEP_SECS * STYLES[0].cadence / style.cadence;
        Self {
            legs: Legs::of(body),
            geometry: FootGeometry::of(body),
            proportions: *body,
            frames: (secs * rate_hz).round().max(2.0) as usize,
        }
    }

    /// Appends a performance after a step of the other foot, placed such that the planted foot does not move.
    fn append(&self, whole: &mut Performance, mut next: Performance, planted: Side) {
        let poses = &whole.motion.poses;
        let from = [poses[poses.len() - 2], poses[poses.len() - 1]];
        let (here, there) = (self.stand(&from[1], planted), self.stand(&next.motion.poses[0], planted));
        let turn = Quat::from_rotation_y(here.heading - there.heading);
        for pose in &mut next.motion.poses {
            pose.root = turn * (pose.root - there.print).with_y(pose.root.y) + here.print.with_y(0.0);
            let hips = &mut pose.rotations[Role::Hips.index()];
            *hips = turn * *hips;
        }
        let to = [next.motion.poses[0], next.motion.poses[1]];
        let begin = whole.phase[whole.phase.len() - 1];
        for i in 1..self.frames {
            let t = i as f32 / self.frames as f32;
            whole.motion.poses.push(self.between(&from, &to, planted, t));
            whole.phase.push(begin + t);
            whole.planted.push([planted == Side::Left, planted == Side::Right]);
        }
        let later = begin + 1.0 - next.phase[0];
        whole.phase.extend(next.phase.iter().map(|p| p + later));
        whole.motion.poses.append(&mut next.motion.poses);
        whole.planted.append(&mut next.planted);
    }

    /// Pose at `t` in [0, 1] of the transition from the last of two poses to the first of two others.
    fn between(&self, from: &[Pose; 2], to: &[Pose; 2], planted: Side, t: f32) -> Pose {
        let n = self.frames as f32;
        let vector = |of: &dyn Fn(&Pose) -> Vec3| {
            let ([a, b], [c, d]) = (from.each_ref().map(of), to.each_ref().map(of));
            let axis = |i: usize| {
                let [a, b, c, d] = [a, b, c, d].map(|v| v.to_array()[i]);
                quintic([b, n * (b - a), 0.0], [c, n * (d - c), 0.0], t)
            };
            Vec3::new(axis(0), axis(1), axis(2))
        };
        let rotation = |of: &dyn Fn(&Pose) -> Quat| {
            let ([a, b], [c, d]) = (from.each_ref().map(of), to.each_ref().map(of));
            let way = exp_map::log(b.inv_mul(c)).to_array();
            let begins = (exp_map::log(a.inv_mul(b)) * n).to_array();
            let ends = (exp_map::log(c.inv_mul(d)) * n).to_array();
            let axis = |i: usize| quintic([0.0, begins[i], 0.0], [way[i], ends[i], 0.0], t);
            b * exp_map::exp(Vec3::new(axis(0), axis(1), axis(2)))
        };

        let mut pose = Pose { root: vector(&|p| p.root), ..Pose::default() };
        for joint in 0..JOINTS {
            pose.rotations[joint] = rotation(&|p| p.rotations[joint]);
        }
        let feet = Side::BOTH.map(|side| {
            let (begins, ends) = (self.stand(&from[1], side), self.stand(&to[0], side));
            let toes = rotation(&|p| p.rotations[toes_of(side).index()]);
            if side == planted {
                let before = self.stand(&from[0], side);
                let after = self.stand(&to[1], side);
                let [first, last] = [before.mix(&begins, |a, b| n * (b - a)), ends.mix(&after, |a, b| n * (b - a))];
                let [foot_pitch, toe_pitch] =
                    [0, 1].map(|i| quintic([begins.pitches[i], first[i], 0.0], [ends.pitches[i], last[i], 0.0], t));
                return self.on_print(&begins, foot_pitch, toe_pitch);
            }
            let ankle = vector(&|p| self.foot(p, side).0);
            let foot = rotation(&|p| self.foot(p, side).1);
            let way = (ends.print - begins.print).with_y(0.0).length();
            let arch =
                ARCH * smooth_step(0.0, ARCH_WAY, way) * ARCH_SCALE * t * t * t * (1.0 - t) * (1.0 - t) * (1.0 - t);
            let ankle = ankle + Vec3::Y * arch;
            let heading = begins.heading + (ends.heading - begins.heading) * t;
            let freedom = smooth_step(0.0, FREE_ABOVE, ankle.y - self.geometry.ankle_on_ground(0.0, 0.0).y);
            FootPose { ankle, foot, toes, planted: false, cycle: 0.0, heading, freedom }
        });
        let pelvis = pose.rotations[Role::Hips.index()];
        let ahead = pelvis * Vec3::Z;
        for (side, foot) in Side::BOTH.into_iter().zip(&feet) {
            if foot.planted {
                let highest = self.legs.highest(side, pose.root, pelvis, foot.ankle);
                pose.root.y = soft_min(pose.root.y, highest, REACH_SOFTNESS);
            }
        }
        for (side, foot) in Side::BOTH.into_iter().zip(&feet) {
            place_leg(&self.legs, side, foot, atan2(ahead.x, ahead.z), &mut pose);
        }
        pose
    }

    /// A planted foot that rolls in place.
    fn on_print(&self, stand: &Stand, foot_pitch: f32, toe_pitch: f32) -> FootPose {
        let turned = Quat::from_rotation_y(stand.heading);
        FootPose {
            ankle: stand.print + turned * self.geometry.ankle_on_ground(foot_pitch, toe_pitch),
            foot: turned * pitched(foot_pitch),
            toes: pitched(toe_pitch - foot_pitch),
            planted: true,
            cycle: 0.0,
            heading: stand.heading,
            freedom: 0.0,
        }
    }

    /// Position and rotation of a foot in the world.
    fn foot(&self, pose: &Pose, side: Side) -> (Vec3, Quat) {
        let world = strut_core::kinematics::world_from_local(&self.proportions, pose);
        let foot = foot_of(side).index();
        (world.positions[foot], world.rotations[foot])
    }

    fn stand(&self, pose: &Pose, side: Side) -> Stand {
        let (ankle, foot) = self.foot(pose, side);
        let ahead = foot * Vec3::Z;
        let pitch = |ahead: Vec3| asin(ahead.y.clamp(-1.0, 1.0));
        let toes = foot * pose.rotations[toes_of(side).index()] * Vec3::Z;
        let (heading, pitches) = (atan2(ahead.x, ahead.z), [pitch(ahead), pitch(toes)]);
        let rolled = self.geometry.ankle_on_ground(pitches[0], pitches[1]);
        Stand { print: ankle - Quat::from_rotation_y(heading) * rolled, heading, pitches }
    }
}

const fn foot_of(side: Side) -> Role {
    match side {
        Side::Left => Role::LeftFoot,
        Side::Right => Role::RightFoot,
    }
}

const fn toes_of(side: Side) -> Role {
    match side {
        Side::Left => Role::LeftToes,
        Side::Right => Role::RightToes,
    }
}
