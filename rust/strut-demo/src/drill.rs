//! What is done on the spot: jumps, punches and kicks, from key poses that every style performs in its own way.

use crate::feet::{FootGeometry, FootPose, pitched};
use crate::keys::{Arm, Flight, Foot, Key, Timeline};
use crate::noise::{Channel, Noise};
use crate::path::Side;
use crate::pelvis::{Legs, soft_min};
use crate::perform::{Performance, place_leg};
use crate::periodic::smooth_step;
use crate::style::{STYLES, Style};
use crate::upper_body::{ArmTarget, Posture, Turn, UpperBody};
use std::f32::consts::TAU;
use strut_core::humanoid::{HumanoidMotion, Pose, Proportions, Role};
use strut_core::math::float_funcs::sin;
use strut_core::math::{Quat, Vec3};

/// One jump, punch or kick of a drill.
#[derive(Clone, Copy, Debug)]
pub struct Move {
    /// Its keys, performed with the right side.
    pub(crate) keys: &'static [Key],
    /// Which side performs it.
    pub(crate) side: Side,
    /// Its amplitude, 1 as in the keys.
    pub(crate) size: f32,
    /// Metres that it leads forward.
    pub(crate) ahead: f32,
}

/// A take of an action on the spot. Its phase counts keys: whole numbers are the key poses.
#[derive(Clone, Copy, Debug)]
pub struct Drill {
    /// Name, part of the clips' names.
    pub name: &'static str,
    /// Name of the action in a database.
    pub action: &'static str,
    /// The pose that it begins in.
    pub(crate) rest: Key,
    /// What is done, one after the other.
    pub(crate) moves: &'static [Move],
    /// Seed of all irregularities.
    pub(crate) seed: u64,
}

/// How far the ankles of someone who stands are behind the hips, metres.
const ANKLE_BEHIND: f32 = 0.045;
/// Half the distance of the feet of a neutral stance, metres.
const HALF_STANCE: f32 = 0.095;
/// Seconds over which the feet come to follow a body that has left the ground.
const SLACK_SECS: f32 = 0.11;
/// Height in metres from which a foot may miss its way, and from which its toes are stretched.
const FREE_ABOVE: f32 = 0.1;
/// See `FREE_ABOVE`.
const TOES_FREE_ABOVE: f32 = 0.3;
/// Seconds a breath.
const BREATH_SECS: f32 = 3.2;
/// Flexion that no arm exceeds, degrees.
const HIGHEST_ARM: f32 = 118.0;
/// Metres over which a planted leg's reach limits the height of the pelvis.
const REACH_SOFTNESS: f32 = 0.004;
/// Seconds before the first frame in which the springs of the arms settle.
const WARM_UP_SECS: f32 = 1.0;

/// Performs `drill` in `style` at a rate on a body. It begins in the origin, facing +Z. The same arguments give the same
/// bits.
pub fn perform_drill(drill: &Drill, style: &Style, proportions: &Proportions, rate_hz: f32) -> Performance {
    let stage = Stage::new(drill, style, proportions);
    let dt = 1.0 / rate_hz;
    let mut upper_body = UpperBody::new(style);
    for i in 0..(WARM_UP_SECS * rate_hz) as usize {
        stage.frame((i as f32 * dt) - WARM_UP_SECS, &mut upper_body, dt);
    }
    let frames = (0..).map(|i| i as f32 * dt).take_while(|&secs| secs < stage.timeline.secs());
    let (mut poses, mut phase, mut planted) = (vec![], vec![], vec![]);
    for secs in frames {
        let (pose, key, stands) = stage.frame(secs, &mut upper_body, dt);
        poses.push(pose);
        phase.push(key);
        planted.push(stands);
    }
    Performance { motion: HumanoidMotion { proportions: *proportions, rate_hz, poses }, phase, planted }
}

/// The time that all styles share at a phase of a drill: seconds of a neutral performer.
pub(crate) fn script_secs(drill: &Drill) -> impl Fn(f32) -> f32 {
    let neutral = timeline(drill, &STYLES[0]);
    move |phase| neutral.secs_at(phase)
}

/// Length of a drill in keys.
pub fn keys_of(drill: &Drill) -> f32 {
    drill.moves.iter().map(|m| m.keys.len() as f32).sum()
}

fn timeline(drill: &Drill, style: &Style) -> Timeline {
    let noise = Noise::new(drill.seed, drill.moves.len() as u32);
    let mut keys = vec![styled(&drill.rest, &drill.rest, style, 1.0)];
    let mut rises = vec![0.0];
    let mut travelled = 0.0;
    for (number, m) in drill.moves.iter().enumerate() {
        let irregular = |channel| style.irregularity * noise.step(channel, number as i64);
        let size = m.size * (1.0 + 0.05 * irregular(Channel::StepLength));
        let mut landed = false;
        for key in m.keys {
            let mut key = styled(key, &drill.rest, style, size);
            if m.side == Side::Left {
                key = key.mirrored();
            }
            key.secs *= (1.0 + 0.06 * irregular(Channel::Tempo)) / style.strike_speed;
            let in_flight = keys.last().is_some_and(|k| k.airborne);
            landed |= in_flight && !key.airborne;
            let share = if landed {
                1.0
            } else if in_flight {
                0.5
            } else {
                0.0
            };
            key.body.ahead += travelled + share * m.ahead;
            for foot in &mut key.feet {
                foot.ahead += travelled + share * m.ahead;
            }
            keys.push(key);
            rises.push(style.jump_rise * size);
        }
        travelled += if landed { m.ahead } else { 0.0 };
    }
    Timeline::new(keys, |i| rises[i])
}

/// A key as a style performs it: more or less far from the pose at rest, with the style's arms.
fn styled(key: &Key, rest: &Key, style: &Style, size: f32) -> Key {
    let neutral = &STYLES[0];
    let size = size * style.strike_size;
    let (mut values, at_rest) = (key.channels(), rest.channels());
    for (value, rest) in values.iter_mut().zip(at_rest) {
        *value = rest + size * (*value - rest);
    }
    let mut styled = key.with_channels(&values);
    let height = style.kick_height / neutral.kick_height;
    for (foot, plain) in styled.feet.iter_mut().zip(&key.feet) {
        // A foot on the ground rolls as it must; one that kicks goes as high as the style does.
        let kicks = plain.lift > 0.0;
        foot.pitch = plain.pitch * if kicks { height } else { 1.0 };
        foot.lift = plain.lift * if kicks { height } else { 1.0 };
        // No leg is longer for a larger kick.
        foot.ahead = if kicks { foot.ahead.min(plain.ahead) } else { foot.ahead };
    }
    if key.airborne || key.body.drop < rest.body.drop {
        styled.body.drop = key.body.drop;
    }
    for arm in &mut styled.arms {
        let difference = |of: fn(&Style) -> f32| of(style) - of(neutral);
        arm.flexion = (arm.flexion + difference(|s| s.arm_forward)).min(HIGHEST_ARM);
        arm.spread += 0.5 * difference(|s| s.arm_spread);
        arm.twist += 0.3 * difference(|s| s.arm_twist);
        arm.elbow = (arm.elbow + 0.3 * difference(|s| s.elbow)).clamp(4.0, 145.0);
    }
    styled
}

/// Everything that a frame is made from.
struct Stage<'a> {
    style: &'a Style,
    timeline: Timeline,
    noise: Noise,
    legs: Legs,
    geometry: FootGeometry,
    /// Height of the pelvis in the style's stance.
    standing: f32,
}

impl<'a> Stage<'a> {
    fn new(drill: &Drill, style: &'a Style, proportions: &Proportions) -> Self {
        let legs = Legs::of(proportions);
        Self {
            style,
            timeline: timeline(drill, style),
            noise: Noise::new(drill.seed, keys_of(drill) as u32),
            geometry: FootGeometry::of(proportions),
            standing: legs.standing_with(5.0 + style.crouch) - 0.006,
            legs,
        }
    }

    /// Pose, phase and planted feet at a time; before the beginning the first pose is held.
    fn frame(&self, secs: f32, upper_body: &mut UpperBody, dt_secs: f32) -> (Pose, f32, [bool; 2]) {
        let (key, phase, flight, planted) = self.timeline.at(secs.max(0.0));
        let s = self.style;
        let b = &key.body;
        let wobble =
            |channel, degrees: f32| (degrees * s.irregularity * self.noise.smooth(channel, 0.5 * phase)).to_radians();
        let breath = sin(TAU * secs / BREATH_SECS);
        let turn = Turn { yaw: b.yaw.to_radians(), pitch: (s.pelvis_tilt + b.pitch).to_radians(), roll: 0.0 };
        let pelvis = turn.quat();
        let feet = [Side::Left, Side::Right].map(|side| {
            let i = usize::from(side == Side::Right);
            self.foot(side, &key.feet[i], flight, planted[i])
        });

        let sway = 0.006 * s.irregularity * self.noise.smooth(Channel::Sway, 0.5 * phase);
        let mut root = Vec3::new(b.aside + sway, self.standing - b.drop, b.ahead);
        for (side, foot) in Side::BOTH.into_iter().zip(&feet) {
            if foot.planted {
                root.y = soft_min(root.y, self.legs.highest(side, root, pelvis, foot.ankle), REACH_SOFTNESS);
            }
        }
        let mut pose = Pose { root, ..Pose::default() };
        pose.rotations[Role::Hips.index()] = pelvis;

        let bend = s.spine_pitch + s.chest_pitch + b.bend;
        let chest = Turn {
            yaw: turn.yaw + b.chest_yaw.to_radians() + wobble(Channel::TrunkYaw, 1.5),
            pitch: turn.pitch + bend.to_radians() + wobble(Channel::TrunkPitch, 1.2) - 0.5_f32.to_radians() * breath,
            roll: wobble(Channel::TrunkRoll, 1.0),
        };
        let head = Turn {
            yaw: 0.15 * chest.yaw + wobble(Channel::HeadYaw, 3.0),
            pitch: (s.gaze_pitch + (0.25 + 0.3 * s.head_follow) * (b.bend + b.pitch)).to_radians()
                + wobble(Channel::HeadPitch, 2.0),
            roll: 0.0,
        };
        let channels = [[Channel::LeftArm, Channel::LeftElbow], [Channel::RightArm, Channel::RightElbow]];
        let arms = [0, 1].map(|i| {
            let Arm { flexion, spread, twist, elbow } = key.arms[i];
            ArmTarget {
                flexion: flexion + wobble(channels[i][0], 2.5).to_degrees(),
                elbow: elbow + wobble(channels[i][1], 2.5).to_degrees(),
                spread,
                twist,
                protraction: s.shoulder_forward + 0.15 * flexion.clamp(-60.0, 100.0),
                raise: s.shoulder_raise + 0.8 * breath + 0.12 * (flexion - 60.0).max(0.0),
            }
        });
        let spine_pitch = turn.pitch + (s.spine_pitch + 0.45 * b.bend).to_radians();
        upper_body.pose(&Posture { chest, head, spine_pitch, arms }, turn, pelvis, dt_secs, &mut pose);
        for (side, foot) in Side::BOTH.into_iter().zip(&feet) {
            place_leg(&self.legs, side, foot, turn.yaw, &mut pose);
        }
        (pose, phase, planted)
    }

    fn foot(&self, side: Side, foot: &Foot, flight: Option<Flight>, planted: bool) -> FootPose {
        let s = self.style;
        let half_stance = HALF_STANCE + 0.5 * (s.step_width - STYLES[0].step_width);
        let heading = side.sign() * s.toe_out.to_radians();
        let above = (foot.lift + flight.map_or(0.0, |f| hanging_height(&f))).max(0.0);
        let foot_pitch = foot.pitch.to_radians();
        let toe_pitch = foot_pitch * smooth_step(0.0, TOES_FREE_ABOVE, above);
        let print = Vec3::new(side.sign() * (half_stance + foot.out), above, foot.ahead - ANKLE_BEHIND);
        let turned = Quat::from_rotation_y(heading);
        FootPose {
            ankle: print + turned * self.geometry.ankle_on_ground(foot_pitch, toe_pitch),
            foot: turned * pitched(foot_pitch),
            toes: pitched(toe_pitch - foot_pitch),
            planted,
            cycle: 0.0,
            heading,
            freedom: smooth_step(0.0, FREE_ABOVE, above),
        }
    }
}

/// Height of feet that hang from a body in flight: they leave the ground and meet it again at rest.
fn hanging_height(flight: &Flight) -> f32 {
    let slack = |speed: f32, secs: f32| {
        let left = (1.0 - secs / SLACK_SECS).max(0.0);
        speed * secs * left * left * left
    };
    (flight.height() - slack(flight.take_off, flight.since) - slack(flight.landing, flight.left)).max(0.0)
}
