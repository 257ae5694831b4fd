//! Movement parameters of a style. The rows are in [`crate::styles`].

use crate::forms::{Jump, Kick, Punch};

/// How a style walks; [`Action::style`](crate::Action::style) derives how it runs. Angles in degrees, lengths in metres on the default proportions; "half range" is half
/// the way from one extreme to the other within a stride.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Name of the style.
    pub name: &'static str,

    /// Steps a minute.
    pub cadence: f32,
    /// Length of a step.
    pub step_length: f32,
    /// Sideways distance between the feet; negative crosses the line of walking.
    pub step_width: f32,
    /// Share of the stride that a foot is planted.
    pub duty: f32,
    /// Outward turn of the feet.
    pub toe_out: f32,
    /// Size of the irregularities from stride to stride, 1 for an adult at ease.
    pub irregularity: f32,

    /// Pitch of the foot at heel strike, toes up.
    pub strike_pitch: f32,
    /// Phase at which the heel leaves the ground.
    pub heel_off: f32,
    /// Pitch of the foot when the toes leave, heel up: the vigour of push-off.
    pub push_off_pitch: f32,
    /// Height that the ankle is lifted in mid swing beyond the shortest smooth way.
    pub foot_lift: f32,
    /// How far the feet land ahead of where balance of an upright trunk puts them.
    pub foot_lead: f32,

    /// Knee flexion added in stance: a crouch.
    pub crouch: f32,
    /// Share of the loading wave of the knee: how much the knee gives in to the weight.
    pub knee_give: f32,
    /// Dip of the body while both feet are down, beyond what the legs' geometry gives; half range.
    pub bounce: f32,
    /// Sideways travel of the pelvis towards the supporting leg; half range.
    pub sway: f32,
    /// Forward and backward travel of the pelvis relative to steady progression; half range.
    pub surge: f32,
    /// Forward tilt of the pelvis.
    pub pelvis_tilt: f32,
    /// Turn of the pelvis about the vertical; half range.
    pub pelvis_yaw: f32,
    /// Obliquity of the pelvis; half range.
    pub pelvis_roll: f32,

    /// Forward bend of the lower spine relative to the pelvis.
    pub spine_pitch: f32,
    /// Forward bend of the upper spine relative to the lower.
    pub chest_pitch: f32,
    /// Counter-rotation of the chest about the vertical; half range.
    pub chest_yaw: f32,
    /// Lean of the chest towards the supporting leg; half range.
    pub chest_roll: f32,
    /// Nod of the trunk at each heel strike; half range.
    pub trunk_nod: f32,
    /// Forward bend of the neck relative to the chest.
    pub neck_pitch: f32,
    /// Pitch of the head in the world, chin down.
    pub gaze_pitch: f32,
    /// How much the head goes along with the chest instead of being held still, 0 to 1.
    pub head_follow: f32,
    /// Sideways tilt of the head with each step; half range.
    pub head_roll: f32,

    /// Elevation of the shoulders.
    pub shoulder_raise: f32,
    /// Shoulders drawn forward; negative is back.
    pub shoulder_forward: f32,
    /// Mean flexion of the upper arm, forward of hanging.
    pub arm_forward: f32,
    /// Arm swing; half range.
    pub arm_swing: f32,
    /// Distance of the upper arm from the body.
    pub arm_spread: f32,
    /// Spread added at both ends of the swing: arms that swing round the body.
    pub arm_round: f32,
    /// Spread added to the arm ahead and taken from the one behind: arms that come out in turn.
    pub arm_out: f32,
    /// Inward twist added to the arm ahead and taken from the one behind: arms that cross in front of the body.
    pub arm_cross: f32,
    /// Inward twist of the upper arm.
    pub arm_twist: f32,
    /// Delay of the arms behind the legs, half-life in seconds of the following spring: heaviness.
    pub arm_drag: f32,
    /// Mean flexion of the elbow.
    pub elbow: f32,
    /// Elbow flexion; half range. Negative bends the arm behind and straightens the one ahead.
    pub elbow_swing: f32,
    /// Turn of the palm to the back.
    pub pronation: f32,
    /// Mean flexion of the wrist; negative bends it up.
    pub wrist: f32,

    /// How the style jumps.
    pub jump: Jump,
    /// How it punches.
    pub punch: Punch,
    /// How it kicks.
    pub kick: Kick,
}
