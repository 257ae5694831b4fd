//! Actions in place: jumps, punches and kicks, from key poses that depend on the style.

use crate::feet::{FootGeometry, FootPose, pitched};
use crate::forms::{Arm, Swing};
use crate::keys::{Flight, Foot, Key, Timeline};
use crate::noise::{Channel, Noise};
use crate::path::Side;
use crate::pelvis::{Legs, soft_min};
use crate::perform::{Performance, place_leg};
use crate::style::Style;
use crate::styles::STYLES;
use crate::upper_body::{ArmTarget, Posture, Turn, UpperBody};
use std::f32::consts::TAU;
use strut_core::humanoid::{HumanoidMotion, Pose, Proportions, Role};
use strut_core::math::float_funcs::sin;
use strut_core::math::interpolation::smooth_step;
use strut_core::math::{Quat, Vec3};

/// A jump, punch or kick of a drill.
#[derive(Clone, Copy, Debug)]
pub struct Move {
    /// Its keys in a style and of an amplitude, performed with the right side. The number of keys is the same in every
    /// style.
    pub(crate) keys: fn(&Style, f32) -> Vec<Key>,
    /// Side that performs it.
    pub(crate) side: Side,
    /// Amplitude; 1 is the value of the style.
    pub(crate) size: f32,
    /// Forward travel, metres.
    pub(crate) ahead: f32,
}

/// A take of an action in place. Its phase counts keys: whole numbers are the key poses.
#[derive(Clone, Copy, Debug)]
pub struct Drill {
    /// Name, part of the clips' names.
    pub name: &'static str,
    /// Name of the action in a database.
    pub action: &'static str,
    /// Initial pose.
    pub(crate) rest: fn(&Style) -> Key,
    /// Speed of the style, 1 for neutral.
    pub(crate) speed: fn(&Style) -> f32,
    /// Height in metres of the style's flights.
    pub(crate) rise: fn(&Style) -> f32,
    /// Stiffness of the hands, 0 to 1.
    pub(crate) firm: f32,
    /// The moves, in order.
    pub(crate) moves: &'static [Move],
    /// Seed of all irregularities.
    pub(crate) seed: u64,
}

/// Distance of the ankles behind the hips while standing, metres.
const ANKLE_BEHIND: f32 = 0.045;
/// Half the distance of the feet of a neutral stance, metres.
const HALF_STANCE: f32 = 0.095;
/// Time over which the feet start to follow a body that has left the ground, seconds.
const SLACK_SECS: f32 = 0.11;
/// Height above which a foot may deviate from its path, and above which its toes are stretched (`TOES_FREE_ABOVE`), metres.
const FREE_ABOVE: f32 = 0.1;
/// See `FREE_ABOVE`.
const TOES_FREE_ABOVE: f32 = 0.4;
/// Duration of a breath, seconds.
const BREATH_SECS: f32 = 3.2;
/// Share of the arm drag in gaits: strikes hold the arms tight.
const TIGHT_ARMS: f32 = 0.3;
/// Softness of the limit of the pelvis height by the reach of a planted leg, metres.
const REACH_SOFTNESS: f32 = 0.004;
/// Time before the first frame in which the springs of the arms settle, seconds.
const WARM_UP_SECS: f32 = 1.0;

/// Performs `drill` in `style` at a frame rate on a body. The motion starts at the origin, facing +Z. The same
/// arguments give the same bits.
pub fn perform_drill(drill: &Drill, style: &Style, proportions: &Proportions, rate_hz: f32) -> Performance {
    let stage = Stage::new(drill, style, proportions);
    let dt = 1.0 / rate_hz;
    let mut upper_body = UpperBody::new(style, TIGHT_ARMS);
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

/// Common time of all styles at a phase of a drill: seconds of a neutral performance.
pub(crate) fn script_secs(drill: &Drill) -> impl Fn(f32) -> f32 {
    let neutral = timeline(drill, &STYLES[0], &Stance::new(&STYLES[0], &Proportions::default()));
    move |phase| neutral.secs_at(phase)
}

/// Length of a drill in keys.
pub fn keys_of(drill: &Drill) -> f32 {
    drill.moves.iter().map(|m| (m.keys)(&STYLES[0], 1.0).len() as f32).sum()
}

fn timeline(drill: &Drill, style: &Style, stance: &Stance) -> Timeline {
    let noise = Noise::new(drill.seed, drill.moves.len() as u32);
    let mut keys = vec![(drill.rest)(style)];
    let mut rises = vec![0.0];
    let mut travelled = 0.0;
    for (number, m) in drill.moves.iter().enumerate() {
        let irregular = |channel| style.irregularity * noise.step(channel, number as i64);
        let size = m.size * (1.0 + 0.05 * irregular(Channel::StepLength));
        let mut landed = false;
        for mut key in (m.keys)(style, size) {
            if m.side == Side::Left {
                key = key.mirrored();
            }
            for (i, side) in Side::BOTH.into_iter().enumerate() {
                if let Some(swing) = key.swings[i] {
                    key.feet[i] = stance.swung(side, style, &key, swing);
                }
            }
            key.secs *= (1.0 + 0.06 * irregular(Channel::Tempo)) / (drill.speed)(style);
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
            rises.push((drill.rise)(style) * size);
        }
        travelled += if landed { m.ahead } else { 0.0 };
    }
    Timeline::new(keys, |i| rises[i])
}

/// Standing posture of a style on a body.
struct Stance {
    legs: Legs,
    geometry: FootGeometry,
    /// Height of the pelvis.
    height: f32,
    /// Half the distance between the feet.
    half_width: f32,
}

impl Stance {
    fn new(style: &Style, proportions: &Proportions) -> Self {
        let legs = Legs::of(proportions);
        Self {
            geometry: FootGeometry::of(proportions),
            height: legs.standing_with(5.0 + style.crouch) - 0.006,
            half_width: HALF_STANCE + 0.5 * (style.step_width - STYLES[0].step_width),
            legs,
        }
    }

    /// Footprint of the ankle for a foot of a side.
    fn print(&self, side: Side, foot: &Foot, above: f32) -> Vec3 {
        let ahead = Vec3::new(side.sign() * (self.half_width + foot.out), above, foot.ahead - ANKLE_BEHIND);
        Quat::from_rotation_y(foot.turn.to_radians()) * ahead
    }

    /// Foot of a swung leg.
    fn swung(&self, side: Side, style: &Style, key: &Key, swing: Swing) -> Foot {
        let b = &key.body;
        let pelvis = Turn { yaw: b.yaw.to_radians(), pitch: (style.pelvis_tilt + b.pitch).to_radians(), roll: 0.0 };
        let root = Vec3::new(b.aside, self.height - b.drop, b.ahead);
        let ankle = self.legs.swung(side, root, pelvis.quat(), swing);
        let pitch = swing.hip - swing.knee + swing.ankle;
        let turned = Quat::from_rotation_y(side.sign() * style.toe_out.to_radians());
        let rolled = self.geometry.ankle_on_ground(pitch.to_radians(), pitch.to_radians());
        let at_rest = Foot { out: 0.0, ahead: 0.0, lift: 0.0, pitch, turn: 0.0 };
        let moved = ankle - turned * rolled - self.print(side, &at_rest, 0.0);
        Foot { out: side.sign() * moved.x, ahead: moved.z, lift: moved.y, pitch, turn: 0.0 }
    }
}

/// Data from which a frame is computed.
struct Stage<'a> {
    style: &'a Style,
    firm: f32,
    timeline: Timeline,
    noise: Noise,
    stance: Stance,
}

impl<'a> Stage<'a> {
    fn new(drill: &Drill, style: &'a Style, proportions: &Proportions) -> Self {
        let stance = Stance::new(style, proportions);
        Self {
            style,
            firm: drill.firm,
            timeline: timeline(drill, style, &stance),
            noise: Noise::new(drill.seed, keys_of(drill) as u32),
            stance,
        }
    }

    /// Pose, phase and planted feet at a time. Before the start the first pose is held.
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
        let mut root = Vec3::new(b.aside + sway, self.stance.height - b.drop, b.ahead);
        for (side, foot) in Side::BOTH.into_iter().zip(&feet) {
            if foot.planted {
                root.y = soft_min(root.y, self.stance.legs.highest(side, root, pelvis, foot.ankle), REACH_SOFTNESS);
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
        let faced = 0.5 * (key.feet[0].turn + key.feet[1].turn).to_radians();
        let head = Turn {
            yaw: faced + 0.15 * (chest.yaw - faced) + wobble(Channel::HeadYaw, 3.0),
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
                raise: s.shoulder_raise + 0.8 * breath + 0.12 * (flexion.max(spread) - 60.0).max(0.0),
                firm: self.firm,
            }
        });
        let spine_pitch = turn.pitch + (s.spine_pitch + 0.45 * b.bend).to_radians();
        upper_body.pose(&Posture { chest, head, spine_pitch, arms }, turn, pelvis, dt_secs, &mut pose);
        for (side, foot) in Side::BOTH.into_iter().zip(&feet) {
            place_leg(&self.stance.legs, side, foot, turn.yaw, &mut pose);
        }
        (pose, phase, planted)
    }

    fn foot(&self, side: Side, foot: &Foot, flight: Option<Flight>, planted: bool) -> FootPose {
        let s = self.style;
        let heading = side.sign() * s.toe_out.to_radians() + foot.turn.to_radians();
        let above = (foot.lift + flight.map_or(0.0, |f| hanging_height(&f))).max(0.0);
        let foot_pitch = foot.pitch.to_radians();
        let toe_pitch = foot_pitch * smooth_step(0.0, TOES_FREE_ABOVE, above);
        let print = self.stance.print(side, foot, above);
        let turned = Quat::from_rotation_y(heading);
        FootPose {
            ankle: print + turned * self.stance.geometry.ankle_on_ground(foot_pitch, toe_pitch),
            foot: turned * pitched(foot_pitch),
            toes: pitched(toe_pitch - foot_pitch),
            planted,
            cycle: 0.0,
            heading,
            freedom: smooth_step(0.0, FREE_ABOVE, above),
        }
    }
}

/// Height of feet that hang from a body in flight. They leave the ground and touch it again at zero speed.
fn hanging_height(flight: &Flight) -> f32 {
    let slack = |speed: f32, secs: f32| {
        let left = (1.0 - secs / SLACK_SECS).max(0.0);
        speed * secs * left * left * left
    };
    (flight.height() - slack(flight.take_off, flight.since) - slack(flight.landing, flight.left)).max(0.0)
}
