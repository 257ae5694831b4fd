//! Movement parameters of a style. The values are in [`crate::styles`].

use crate::forms::{Jump, Kick, Punch};

/// Walk of a style; [`Action::style`](crate::Action::style) derives its run. Angles in degrees, lengths in metres on
/// the default proportions. "Half range" is half the difference between the extremes within a stride.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Name of the style.
    pub name: &'static str,

    /// Steps per minute.
    pub cadence: f32,
    /// Length of a step.
    pub step_length: f32,
    /// Lateral distance between the feet; negative crosses the line of walking.
    pub step_width: f32,
    /// Share of the stride in which a foot is planted.
    pub duty: f32,
    /// Outward turn of the feet.
    pub toe_out: f32,
    /// Amplitude of the irregularities from stride to stride, 1 for an adult at ease.
    pub irregularity: f32,

    /// Pitch of the foot at heel strike, toes up.
    pub strike_pitch: f32,
    /// Phase at which the heel leaves the ground.
    pub heel_off: f32,
    /// Pitch of the foot at toe-off, heel up: the vigour of push-off.
    pub push_off_pitch: f32,
    /// Additional height of the ankle in mid swing above the shortest smooth path.
    pub foot_lift: f32,
    /// Distance of the footprints ahead of their position in balance with an upright trunk.
    pub foot_lead: f32,

    /// Additional knee flexion in stance: a crouch.
    pub crouch: f32,
    /// Share of the loading wave of the knee: flexion of the knee under the weight.
    pub knee_give: f32,
    /// Additional dip of the body in double support, beyond that of the legs' geometry; half range.
    pub bounce: f32,
    /// Lateral travel of the pelvis towards the supporting leg; half range.
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
    /// Share of the chest's rotation that the head follows instead of being held still, 0 to 1.
    pub head_follow: f32,
    /// Lateral tilt of the head with each step; half range.
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
    /// Spread added at both ends of the swing: arms that swing around the body.
    pub arm_round: f32,
    /// Spread added to the arm ahead and subtracted from the one behind: arms that move outward in turn.
    pub arm_out: f32,
    /// Inward twist added to the arm ahead and subtracted from the one behind: arms that cross in front of the body.
    pub arm_cross: f32,
    /// Inward twist of the upper arm.
    pub arm_twist: f32,
    /// Delay of the arms behind the legs, as the half-life of the following spring in seconds: heaviness.
    pub arm_drag: f32,
    /// Mean flexion of the elbow.
    pub elbow: f32,
    /// Elbow flexion; half range. Negative bends the arm behind and straightens the one ahead.
    pub elbow_swing: f32,
    /// Turn of the palm to the back.
    pub pronation: f32,
    /// Mean flexion of the wrist; negative bends it up.
    pub wrist: f32,

    /// Jump of the style.
    pub jump: Jump,
    /// Punch of the style.
    pub punch: Punch,
    /// Kick of the style.
    pub kick: Kick,
}
