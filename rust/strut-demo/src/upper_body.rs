//! Trunk, head and arms above a walking pelvis.
//!
//! Rotations are first planned in the world (for gaze, balance and gravity), then made relative to the parent joints.
//! The arms follow their planned swing through springs: heavy or loose arms lag.

use crate::noise::{Channel, Noise};
use crate::normative::{ARM_SWING, ELBOW_SWING};
use crate::path::Side;
use crate::periodic::PeriodicCurve;
use crate::style::Style;
use std::f32::consts::TAU;
use strut_core::humanoid::{Pose, Role};
use strut_core::math::Quat;
use strut_core::math::float_funcs::{cos, exp, sin};

/// Share of the trunk's bend that hanging arms follow; gravity keeps the rest.
const ARMS_FOLLOW_TRUNK: f32 = 0.25;
/// Strides per breath: 16 breaths per minute at 56 strides per minute.
const STRIDES_PER_BREATH: f32 = 3.5;

/// Inputs of the upper body from pelvis and path at a frame; radians.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Support {
    /// Phase of the script.
    pub(crate) phase: f32,
    /// Strides of the script, the period of periodic quantities.
    pub(crate) strides: u32,
    /// Direction of walking.
    pub(crate) heading: f32,
    /// Turn of the chest and of the head (`head_lead`) towards the direction of the path.
    pub(crate) chest_lead: f32,
    /// See `chest_lead`.
    pub(crate) head_lead: f32,
    /// Lean into the curve, positive to the right.
    pub(crate) lean: f32,
    /// Stride length relative to the preferred one; 1 at preferred speed.
    pub(crate) stretch: f32,
    /// Angles of the pelvis in the world.
    pub(crate) turn: Turn,
    /// Rotation made of these angles.
    pub(crate) pelvis: Quat,
}

/// A critically damped spring that follows a target.
#[derive(Clone, Copy, Debug, Default)]
struct Spring {
    value: f32,
    velocity: f32,
}

impl Spring {
    /// Advances one time step towards `target`; the distance halves about every `half_life_secs`. Exact for a constant
    /// target.
    fn follow(&mut self, target: f32, half_life_secs: f32, dt_secs: f32) -> f32 {
        // A critically damped spring of decay rate y has covered half its distance after 1.68 / y.
        let y = 1.68 / half_life_secs.max(1e-3);
        let offset = self.value - target;
        let slope = self.velocity + offset * y;
        let decay = exp(-y * dt_secs);
        self.value = target + decay * (offset + slope * dt_secs);
        self.velocity = decay * (self.velocity - slope * y * dt_secs);
        self.value
    }
}

/// Target of an arm, degrees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ArmTarget {
    /// Flexion of the upper arm: 0 hanging, 90 forward.
    pub(crate) flexion: f32,
    /// Flexion of the elbow.
    pub(crate) elbow: f32,
    /// Distance of the upper arm from the body.
    pub(crate) spread: f32,
    /// Inward twist of the upper arm.
    pub(crate) twist: f32,
    /// Forward shift of the shoulder.
    pub(crate) protraction: f32,
    /// Elevation of the shoulder.
    pub(crate) raise: f32,
    /// Stiffness of the hand in line with the forearm, 0 to 1: a fist.
    pub(crate) firm: f32,
}

/// State of an arm that follows its target.
#[derive(Clone, Copy, Debug, Default)]
struct ArmState {
    flexion: Spring,
    elbow: Spring,
    spread: Spring,
    twist: Spring,
    wrist: Spring,
}

/// Moves the upper body frame by frame; contains the state of the springs.
#[derive(Clone, Debug)]
pub(crate) struct UpperBody<'a> {
    style: &'a Style,
    /// Half-life in seconds of the springs of the arms.
    drag: f32,
    arms: [ArmState; 2],
}

/// Motion of the upper body in walking and running.
#[derive(Clone, Debug)]
pub(crate) struct Gait<'a> {
    style: &'a Style,
    noise: Noise,
    arm_swing: PeriodicCurve,
    elbow_swing: PeriodicCurve,
}

/// Angles about the vertical, the side axis and the forward axis.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turn {
    pub(crate) yaw: f32,
    pub(crate) pitch: f32,
    pub(crate) roll: f32,
}

impl Turn {
    /// Rotation: heading, then forward tilt, then obliquity.
    pub(crate) fn quat(self) -> Quat {
        Quat::from_rotation_y(self.yaw) * Quat::from_rotation_x(self.pitch) * Quat::from_rotation_z(self.roll)
    }

    pub(crate) fn mix(self, o: Self, t: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * t;
        Self { yaw: mix(self.yaw, o.yaw), pitch: mix(self.pitch, o.pitch), roll: mix(self.roll, o.roll) }
    }
}

/// Target posture of the upper body at a frame. Turns are in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Posture {
    pub(crate) chest: Turn,
    pub(crate) head: Turn,
    /// Pitch of the lower spine.
    pub(crate) spine_pitch: f32,
    /// Left and right arm.
    pub(crate) arms: [ArmTarget; 2],
}

impl Posture {
    /// Interpolates to another posture, `t` in [0, 1].
    pub(crate) fn mix(self, o: &Self, t: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * t;
        let arm = |i: usize| {
            let (a, b) = (&self.arms[i], &o.arms[i]);
            ArmTarget {
                flexion: mix(a.flexion, b.flexion),
                elbow: mix(a.elbow, b.elbow),
                spread: mix(a.spread, b.spread),
                twist: mix(a.twist, b.twist),
                protraction: mix(a.protraction, b.protraction),
                raise: mix(a.raise, b.raise),
                firm: mix(a.firm, b.firm),
            }
        };
        Self {
            chest: self.chest.mix(o.chest, t),
            head: self.head.mix(o.head, t),
            spine_pitch: mix(self.spine_pitch, o.spine_pitch),
            arms: [arm(0), arm(1)],
        }
    }
}

impl<'a> Gait<'a> {
    pub(crate) fn new(style: &'a Style, noise: Noise) -> Self {
        Self {
            style,
            noise,
            arm_swing: PeriodicCurve::through(ARM_SWING, 0.04),
            elbow_swing: PeriodicCurve::through(ELBOW_SWING, 0.04),
        }
    }

    pub(crate) fn posture(&self, support: &Support) -> Posture {
        let s = self.style;
        let wobble = |channel, degrees| self.wobble(channel, degrees, support.phase).to_radians();
        let strides = support.strides as f32;
        let breaths = (strides / STRIDES_PER_BREATH).round().max(1.0);
        let breath = sin(TAU * support.phase * breaths / strides);
        let stride_wave = |lag: f32| cos(TAU * (support.phase - lag));

        let pelvis_pitch = s.pelvis_tilt.to_radians();
        // The trunk bends forward most just after each heel strike, when the legs brake it.
        let nod = s.trunk_nod.to_radians() * cos(2.0 * TAU * (support.phase - 0.06));
        let bend = s.spine_pitch.to_radians();
        let chest = Turn {
            yaw: support.heading
                + support.chest_lead
                + support.stretch * s.chest_yaw.to_radians() * stride_wave(0.03)
                + wobble(Channel::TrunkYaw, 1.5),
            pitch: pelvis_pitch + bend + s.chest_pitch.to_radians() + nod + wobble(Channel::TrunkPitch, 1.2)
                - 0.5_f32.to_radians() * breath,
            roll: -s.chest_roll.to_radians() * stride_wave(0.27) + 1.4 * support.lean + wobble(Channel::TrunkRoll, 1.0),
        };
        let head = Turn {
            yaw: support.heading
                + support.head_lead
                + s.head_follow * (chest.yaw - support.heading - support.chest_lead)
                + wobble(Channel::HeadYaw, 3.0),
            pitch: s.gaze_pitch.to_radians() + s.head_follow * nod + wobble(Channel::HeadPitch, 2.0),
            roll: s.head_follow * chest.roll + s.head_roll.to_radians() * stride_wave(0.30) + 0.4 * support.lean,
        };
        let arms = Side::BOTH.map(|side| self.arm(side, support, breath));
        Posture { chest, head, spine_pitch: pelvis_pitch + bend + 0.4 * nod, arms }
    }

    fn wobble(&self, channel: Channel, degrees: f32, phase: f32) -> f32 {
        degrees * self.style.irregularity * self.noise.smooth(channel, phase)
    }

    fn arm(&self, side: Side, support: &Support, breath: f32) -> ArmTarget {
        let s = self.style;
        let [arm_channel, elbow_channel, spread_channel] = match side {
            Side::Left => [Channel::LeftArm, Channel::LeftElbow, Channel::LeftSpread],
            Side::Right => [Channel::RightArm, Channel::RightElbow, Channel::RightSpread],
        };
        let wobble = |channel, degrees| self.wobble(channel, degrees, support.phase);
        let cycle = support.phase - side.strike_phase();
        // Arms swing further at higher walking speed (Murray 1967).
        let vigour = support.stretch * support.stretch;
        let swing = vigour * s.arm_swing * self.arm_swing.at(cycle) + wobble(arm_channel, 2.5);
        let elbow = vigour * s.elbow_swing * self.elbow_swing.at(cycle) + wobble(elbow_channel, 2.5);
        let forward_share = swing / s.arm_swing.max(1.0);
        ArmTarget {
            flexion: s.arm_forward + swing,
            elbow: s.elbow + elbow,
            spread: s.arm_spread
                + (s.arm_round * forward_share + s.arm_out) * forward_share
                + wobble(spread_channel, 1.5),
            twist: s.arm_twist + s.arm_cross * forward_share,
            protraction: s.shoulder_forward + 0.15 * swing,
            raise: s.shoulder_raise + 0.8 * breath,
            firm: 0.0,
        }
    }
}

impl<'a> UpperBody<'a> {
    /// Creates the state. The arms follow their targets with `drag_share` of the style's delay.
    pub(crate) fn new(style: &'a Style, drag_share: f32) -> Self {
        Self { style, drag: drag_share * style.arm_drag, arms: [ArmState::default(); 2] }
    }

    /// Sets the joints of the upper body in the next frame, `dt_secs` after the last, above the pelvis. `turn` are the
    /// angles of the pelvis, `pelvis` the same as a rotation.
    pub(crate) fn pose(&mut self, posture: &Posture, turn: Turn, pelvis: Quat, dt_secs: f32, pose: &mut Pose) {
        let Posture { chest, head, spine_pitch, arms } = *posture;
        let spine = Turn { pitch: spine_pitch, ..turn.mix(chest, 0.45) };
        let neck = Turn { pitch: chest.pitch + self.style.neck_pitch.to_radians(), ..chest.mix(head, 0.5) };
        let [spine, chest_world, neck, head] = [spine, chest, neck, head].map(Turn::quat);
        let mut set = |role: Role, q: Quat| pose.rotations[role.index()] = q;
        set(Role::Spine, pelvis.inv_mul(spine));
        set(Role::Chest, spine.inv_mul(chest_world));
        set(Role::Neck, chest_world.inv_mul(neck));
        set(Role::Head, neck.inv_mul(head));

        let frame =
            Turn { yaw: chest.yaw, pitch: ARMS_FOLLOW_TRUNK * chest.pitch, roll: ARMS_FOLLOW_TRUNK * chest.roll };
        for (side, target) in Side::BOTH.into_iter().zip(arms) {
            self.arm(side, target, frame.quat(), chest_world, dt_secs, pose);
        }
    }

    fn arm(&mut self, side: Side, target: ArmTarget, frame: Quat, chest: Quat, dt_secs: f32, pose: &mut Pose) {
        let s = self.style;
        let state = &mut self.arms[usize::from(side == Side::Right)];
        let flexion = state.flexion.follow(target.flexion, self.drag, dt_secs);
        let elbow = state.elbow.follow(target.elbow, 1.5 * self.drag, dt_secs);
        let spread = state.spread.follow(target.spread, self.drag, dt_secs);
        let twist = state.twist.follow(target.twist, self.drag, dt_secs);
        // The hand trails the forearm: it bends back while the elbow bends, and swings through afterwards.
        let trail = state.wrist.follow(-0.035 * (state.elbow.velocity + state.flexion.velocity), 0.05, dt_secs);

        let wrist = (1.0 - target.firm) * (s.wrist + trail);

        let out = side.sign();
        let shoulder = Quat::from_rotation_y(-out * target.protraction.to_radians())
            * Quat::from_rotation_z(out * target.raise.to_radians());
        let hanging = Quat::from_rotation_x(-flexion.to_radians())
            * Quat::from_rotation_z(-out * (90.0 - spread).to_radians())
            * Quat::from_rotation_x(twist.to_radians());
        let upper = frame * hanging;
        let pronation = 0.5 * s.pronation.to_radians();
        let lower = Quat::from_rotation_y(-out * elbow.max(4.0).to_radians()) * Quat::from_rotation_x(pronation);
        let hand = Quat::from_rotation_x(pronation) * Quat::from_rotation_z(-out * wrist.to_radians());

        let roles = match side {
            Side::Left => [Role::LeftShoulder, Role::LeftUpperArm, Role::LeftLowerArm, Role::LeftHand],
            Side::Right => [Role::RightShoulder, Role::RightUpperArm, Role::RightLowerArm, Role::RightHand],
        };
        let rotations = [shoulder, (chest * shoulder).inv_mul(upper), lower, hand];
        for (role, q) in roles.into_iter().zip(rotations) {
            pose.rotations[role.index()] = q;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_covers_half_its_way_in_its_half_life_without_overshoot() {
        let mut spring = Spring::default();
        let values: Vec<f32> = (0..200).map(|_| spring.follow(1.0, 0.1, 0.01)).collect();
        assert!((values[9] - 0.5).abs() < 0.01, "{}", values[9]);
        assert!(values.windows(2).all(|w| w[1] >= w[0] - 1e-6) && values[199] <= 1.0);
    }
}
