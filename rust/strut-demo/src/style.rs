//! The styles: named rows of movement parameters. Adding a style is adding a row.
//!
//! Values are ours, chosen to lie in the directions (and where given near the sizes) that the movement
//! analyses cited with each style report, on a body 1.68 m tall.

use crate::normative::NATURAL_DUTY;

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
    /// Spread added at the ends of the swing: arms that swing round the body.
    pub arm_round: f32,
    /// Inward twist of the upper arm.
    pub arm_twist: f32,
    /// Delay of the arms behind the legs, half-life in seconds of the following spring: heaviness.
    pub arm_drag: f32,
    /// Mean flexion of the elbow.
    pub elbow: f32,
    /// Elbow flexion; half range.
    pub elbow_swing: f32,
    /// Turn of the palm to the back.
    pub pronation: f32,
    /// Mean flexion of the wrist; negative bends it up.
    pub wrist: f32,

    /// Height by which a jump lifts the body.
    pub jump_rise: f32,
    /// Speed of jumps, punches and kicks, 1 for neutral: Laban's time, sudden or sustained.
    pub strike_speed: f32,
    /// Amplitude of jumps, punches and kicks, 1 for neutral: Laban's weight, strong or light.
    pub strike_size: f32,
    /// Height that a kick lifts the ankle.
    pub kick_height: f32,
}

/// Natural walking of adults: Perry & Burnfield 2010 (62 % stance, 8 cm base), Winter 1991 (105–115 steps/min,
/// foot pitch 20° at strike), Murray 1967 (shoulder 32° in all, mean 8° behind the trunk; elbow 20–40°).
const NEUTRAL: Style = Style {
    name: "neutral",
    cadence: 114.0,
    step_length: 0.635,
    step_width: 0.095,
    duty: NATURAL_DUTY,
    toe_out: 7.0,
    irregularity: 1.0,
    strike_pitch: 17.0,
    heel_off: 0.30,
    push_off_pitch: 61.6,
    foot_lift: 0.0,
    foot_lead: 0.0,
    crouch: 0.0,
    knee_give: 1.0,
    bounce: 0.0,
    sway: 0.020,
    surge: 0.007,
    pelvis_tilt: 5.0,
    pelvis_yaw: 5.0,
    pelvis_roll: 4.0,
    spine_pitch: -4.0,
    chest_pitch: 2.0,
    chest_yaw: 4.0,
    chest_roll: 1.2,
    trunk_nod: 0.8,
    neck_pitch: 8.0,
    gaze_pitch: 3.0,
    head_follow: 0.15,
    head_roll: 0.5,
    shoulder_raise: 0.0,
    shoulder_forward: 0.0,
    arm_forward: -3.0,
    arm_swing: 17.0,
    arm_spread: 9.0,
    arm_round: 1.0,
    arm_twist: 18.0,
    arm_drag: 0.02,
    elbow: 27.0,
    elbow_swing: 9.0,
    pronation: 16.0,
    wrist: 5.0,
    jump_rise: 0.30,
    strike_speed: 1.00,
    strike_size: 1.00,
    kick_height: 0.75,
};

/// All styles; the first is the neutral one.
pub const STYLES: [Style; 8] = [
    NEUTRAL,
    // Expanded posture, chest out, head tilted back (Tracy & Robins 2004, "Show your pride");
    // long, strong strides and wide arm swing (Montepare et al. 1987; Gross et al. 2012, Effort-Shape: strong, direct).
    Style {
        name: "proud",
        cadence: 104.0,
        step_length: 0.70,
        step_width: 0.10,
        toe_out: 10.0,
        strike_pitch: 24.0,
        push_off_pitch: 69.0,
        foot_lift: 0.02,
        bounce: 0.002,
        pelvis_tilt: 6.0,
        pelvis_yaw: 8.0,
        spine_pitch: -9.0,
        chest_pitch: -9.0,
        chest_yaw: 7.0,
        neck_pitch: 6.0,
        gaze_pitch: -9.0,
        shoulder_raise: 2.0,
        shoulder_forward: -13.0,
        arm_forward: 6.0,
        arm_swing: 33.0,
        arm_spread: 14.0,
        arm_twist: 24.0,
        elbow: 30.0,
        elbow_swing: 20.0,
        wrist: 0.0,
        jump_rise: 0.40,
        strike_speed: 0.95,
        strike_size: 1.15,
        kick_height: 0.84,
        ..NEUTRAL
    },
    // Fast, heavy-footed, long strides, forward lean, elbows bent, jerky (Montepare et al. 1987; Roether et al.
    // 2009: trunk and elbow flexion, amplitude; Laban: strong, sudden, direct).
    Style {
        name: "angry",
        cadence: 121.0,
        step_length: 0.70,
        step_width: 0.13,
        duty: 0.60,
        toe_out: 9.0,
        strike_pitch: 15.0,
        push_off_pitch: 64.0,
        heel_off: 0.36,
        foot_lift: 0.02,
        foot_lead: 0.03,
        crouch: 2.0,
        knee_give: 1.1,
        bounce: 0.005,
        sway: 0.026,
        pelvis_tilt: 8.0,
        pelvis_yaw: 7.0,
        spine_pitch: 5.0,
        chest_pitch: 7.0,
        chest_yaw: 10.0,
        chest_roll: 2.5,
        trunk_nod: 2.2,
        neck_pitch: 16.0,
        gaze_pitch: 12.0,
        head_follow: 0.35,
        shoulder_raise: 9.0,
        shoulder_forward: 9.0,
        arm_forward: 2.0,
        arm_swing: 25.0,
        arm_spread: 22.0,
        arm_twist: 38.0,
        arm_drag: 0.01,
        elbow: 58.0,
        elbow_swing: 12.0,
        pronation: 45.0,
        wrist: 12.0,
        jump_rise: 0.38,
        strike_speed: 1.18,
        strike_size: 1.15,
        kick_height: 0.84,
        ..NEUTRAL
    },
    // Slow, little arm swing and vertical movement, more sideways sway, slumped with head down (Michalak et al.
    // 2009; Roether et al. 2009; Laban: light, sustained, indirect, bound).
    Style {
        name: "depressed",
        cadence: 84.0,
        step_length: 0.50,
        step_width: 0.11,
        duty: 0.66,
        toe_out: 8.0,
        irregularity: 1.2,
        strike_pitch: 9.0,
        heel_off: 0.40,
        push_off_pitch: 48.0,
        foot_lift: -0.006,
        foot_lead: 0.035,
        crouch: 5.0,
        knee_give: 0.7,
        bounce: 0.0,
        sway: 0.032,
        surge: 0.006,
        pelvis_tilt: 1.0,
        pelvis_yaw: 3.0,
        pelvis_roll: 3.0,
        spine_pitch: 9.0,
        chest_pitch: 20.0,
        chest_yaw: 2.5,
        chest_roll: 3.0,
        trunk_nod: 1.2,
        neck_pitch: 22.0,
        gaze_pitch: 46.0,
        head_follow: 0.8,
        head_roll: 1.5,
        shoulder_raise: -6.0,
        shoulder_forward: 16.0,
        arm_forward: 4.0,
        arm_swing: 7.0,
        arm_spread: 4.0,
        arm_round: 0.0,
        arm_twist: 30.0,
        arm_drag: 0.08,
        elbow: 16.0,
        elbow_swing: 4.0,
        pronation: 55.0,
        wrist: 10.0,
        jump_rise: 0.16,
        strike_speed: 0.70,
        strike_size: 0.65,
        kick_height: 0.45,
    },
    // A swagger: shoulders roll against the hips, arms swing wide round the body, weight is thrown from leg to
    // leg (Johnson & Tassinary 2005: shoulder swagger; Mather & Murdoch 1994: lateral body sway of men).
    Style {
        name: "strutting",
        cadence: 102.0,
        step_length: 0.69,
        step_width: 0.15,
        toe_out: 15.0,
        strike_pitch: 23.0,
        foot_lift: 0.015,
        foot_lead: 0.0,
        bounce: 0.010,
        sway: 0.036,
        pelvis_tilt: -4.0,
        pelvis_yaw: 8.0,
        pelvis_roll: 3.0,
        spine_pitch: -6.0,
        chest_pitch: -2.0,
        chest_yaw: 15.0,
        chest_roll: 8.0,
        trunk_nod: 1.5,
        neck_pitch: 12.0,
        gaze_pitch: -5.0,
        head_follow: 0.3,
        head_roll: 4.0,
        shoulder_raise: 3.0,
        shoulder_forward: -4.0,
        arm_forward: -2.0,
        arm_swing: 27.0,
        arm_spread: 27.0,
        arm_round: 9.0,
        arm_twist: 48.0,
        arm_drag: 0.045,
        elbow: 26.0,
        elbow_swing: 12.0,
        pronation: 60.0,
        wrist: 8.0,
        jump_rise: 0.28,
        strike_speed: 0.92,
        strike_size: 1.05,
        kick_height: 0.80,
        ..NEUTRAL
    },
    // Quick short steps on a wide base, bouncing high on the toes, arms held up and swinging freely (Sutherland
    // et al. 1988, "The development of mature walking": cadence, base, guard position of the arms).
    Style {
        name: "childlike",
        cadence: 130.0,
        step_length: 0.53,
        step_width: 0.14,
        duty: 0.58,
        toe_out: 4.0,
        irregularity: 1.8,
        strike_pitch: 12.0,
        heel_off: 0.24,
        push_off_pitch: 60.0,
        foot_lift: 0.045,
        foot_lead: 0.02,
        crouch: 2.0,
        knee_give: 1.1,
        bounce: 0.014,
        sway: 0.022,
        pelvis_tilt: 7.0,
        pelvis_yaw: 7.0,
        spine_pitch: -5.0,
        chest_pitch: -3.0,
        chest_yaw: 11.0,
        chest_roll: 4.0,
        trunk_nod: 2.0,
        neck_pitch: 4.0,
        gaze_pitch: -6.0,
        head_follow: 0.4,
        head_roll: 7.0,
        shoulder_raise: 6.0,
        shoulder_forward: 3.0,
        arm_forward: 2.0,
        arm_swing: 24.0,
        arm_spread: 26.0,
        arm_twist: 12.0,
        arm_drag: 0.03,
        elbow: 76.0,
        elbow_swing: 20.0,
        pronation: 70.0,
        wrist: -12.0,
        jump_rise: 0.26,
        strike_speed: 1.12,
        strike_size: 0.90,
        kick_height: 0.50,
        ..NEUTRAL
    },
    // Short flat-footed steps with weak push-off, wide base, long double support, flexed hips, knees and elbows,
    // stooped with the head raised to look ahead (Murray et al. 1969, "Walking patterns in healthy old men";
    // Winter et al. 1990; Judge et al. 1996).
    Style {
        name: "old",
        cadence: 96.0,
        step_length: 0.42,
        step_width: 0.13,
        duty: 0.67,
        toe_out: 14.0,
        irregularity: 1.8,
        strike_pitch: 6.0,
        heel_off: 0.44,
        push_off_pitch: 40.0,
        foot_lift: -0.004,
        foot_lead: 0.06,
        crouch: 26.0,
        knee_give: 0.5,
        bounce: 0.0,
        sway: 0.030,
        surge: 0.005,
        pelvis_tilt: 10.0,
        pelvis_yaw: 2.5,
        pelvis_roll: 2.0,
        spine_pitch: 16.0,
        chest_pitch: 22.0,
        chest_yaw: 3.0,
        chest_roll: 3.5,
        trunk_nod: 1.6,
        neck_pitch: 8.0,
        gaze_pitch: 14.0,
        head_follow: 0.5,
        head_roll: 1.5,
        shoulder_raise: 4.0,
        shoulder_forward: 12.0,
        arm_forward: -14.0,
        arm_swing: 8.0,
        arm_spread: 14.0,
        arm_round: 0.0,
        arm_twist: 22.0,
        arm_drag: 0.05,
        elbow: 66.0,
        elbow_swing: 5.0,
        pronation: 45.0,
        wrist: 14.0,
        jump_rise: 0.06,
        strike_speed: 0.70,
        strike_size: 0.60,
        kick_height: 0.35,
    },
    // Feet on one line, large roll and turn of the pelvis with the hips carried over the supporting leg, quiet
    // chest, arms close and behind (Cutting, Proffitt & Kozlowski 1978; Troje 2002; Johnson & Tassinary 2005).
    Style {
        name: "sexy",
        cadence: 104.0,
        step_length: 0.66,
        step_width: -0.015,
        toe_out: 3.0,
        strike_pitch: 16.0,
        push_off_pitch: 66.0,
        foot_lift: 0.015,
        foot_lead: -0.005,
        knee_give: 0.7,
        sway: 0.040,
        pelvis_tilt: 9.0,
        pelvis_yaw: 10.0,
        pelvis_roll: 10.0,
        spine_pitch: -10.0,
        chest_pitch: -4.0,
        chest_yaw: 8.0,
        chest_roll: -4.0,
        neck_pitch: 6.0,
        gaze_pitch: -3.0,
        head_roll: 3.5,
        shoulder_raise: -2.0,
        shoulder_forward: -10.0,
        arm_forward: -7.0,
        arm_swing: 17.0,
        arm_spread: 13.0,
        arm_round: 3.0,
        arm_twist: -8.0,
        arm_drag: 0.05,
        elbow: 26.0,
        elbow_swing: 12.0,
        pronation: 10.0,
        wrist: -28.0,
        jump_rise: 0.27,
        strike_speed: 0.88,
        strike_size: 0.90,
        kick_height: 0.70,
        ..NEUTRAL
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_style_walks_at_a_human_speed_and_has_double_support() {
        for s in &STYLES {
            let speed = s.step_length * s.cadence / 60.0;
            assert!((0.5..1.7).contains(&speed), "{}: {speed} m/s", s.name);
            assert!((0.55..0.75).contains(&s.duty), "{}", s.name);
            assert!(s.heel_off > 0.15 && s.heel_off < s.duty - 0.12, "{}", s.name);
        }
    }

    #[test]
    fn names_differ_and_the_first_is_neutral() {
        assert_eq!(STYLES[0].name, "neutral");
        for (i, s) in STYLES.iter().enumerate() {
            assert!(STYLES[..i].iter().all(|t| t.name != s.name));
        }
    }
}
