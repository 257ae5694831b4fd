//! Mechanics of walking and running that do not depend on the style.

use crate::normative::{Knots, NATURAL_DUTY, RUNNING_STANCE_KNEE, STANCE_KNEE};
use crate::style::Style;
use crate::styles::STYLES;

/// Gait.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// At least one foot is on the ground.
    Walk,
    /// Both feet are in the air between two steps.
    Run,
}

/// Motion of the limbs in an action.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mechanics {
    /// Share of the cycle in which a foot is on the ground, in the curves below.
    pub(crate) duty: f32,
    /// Knee flexion of the supporting leg.
    pub(crate) stance_knee: Knots,
    /// Distance of the ankle of a stance behind the point that the pelvis passes in the middle of the stance, metres.
    /// The load travels from heel to toes, which are ahead of the ankle, and the trunk is carried ahead of the feet.
    pub(crate) ankle_behind_stance: f32,
    /// Share of the stance after which the foot is flat.
    pub(crate) flat_after: f32,
    /// Share of the pitch at the strike that remains half way to the flat foot.
    pub(crate) landing: f32,
    /// Shares of the pitch at push-off that the foot has reached at 35 and 62 % of the time from heel-off to toe-off.
    pub(crate) heel_rise: [f32; 2],
    /// Share of the pitch at the strike that the swinging foot has reached at 90 % of the swing.
    pub(crate) poise: f32,
    /// Pitch of the foot in swing as a share of that at push-off: (share of the swing, share of the pitch).
    pub(crate) trailing_foot: [(f32, f32); 3],
    /// Height of an early arch that lifts the ankle while the knee folds after push-off, metres.
    pub(crate) fold: f32,
    /// Height by which the ankle is lifted in mid swing, metres.
    pub(crate) clearance: f32,
    /// Forward acceleration of the leg as the foot leaves the ground, in stride lengths per cycle squared.
    pub(crate) push_off_acceleration: f32,
    /// Deceleration of the foot just before it strikes, in stride lengths per cycle squared.
    pub(crate) strike_deceleration: f32,
}

impl Action {
    /// Name of the action in a database.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Walk => "walk",
            Self::Run => "run",
        }
    }

    /// Parameters of a style for this action.
    pub fn style(self, style: &Style) -> Style {
        match self {
            Self::Walk => *style,
            Self::Run => running(style),
        }
    }

    pub(crate) const fn mechanics(self) -> &'static Mechanics {
        match self {
            Self::Walk => &WALKING,
            Self::Run => &RUNNING,
        }
    }
}

/// Found by a random search such that hip, knee and ankle of the neutral style follow
/// [`WALKING_BANDS`](crate::WALKING_BANDS) while the pelvis rises and falls by 3 cm and no joint moves abruptly. Toes
/// clear the ground by 1 to 2 cm (Winter 1992, "Foot trajectory in human gait").
const WALKING: Mechanics = Mechanics {
    duty: NATURAL_DUTY,
    stance_knee: STANCE_KNEE,
    ankle_behind_stance: 0.093,
    flat_after: 0.148,
    landing: 0.39,
    heel_rise: [0.21, 0.28],
    poise: 0.94,
    trailing_foot: [(0.143, -1.084), (0.257, -1.03), (0.61, -0.222)],
    fold: 0.063,
    clearance: 0.014,
    push_off_acceleration: 34.0,
    strike_deceleration: 65.4,
};

/// Novacheck 1998, "The biomechanics of running": stance under 40 % of the cycle, the knee bent by about 45° in mid
/// stance and 90° in swing.
const RUNNING: Mechanics = Mechanics {
    duty: 0.36,
    stance_knee: RUNNING_STANCE_KNEE,
    ankle_behind_stance: 0.155,
    flat_after: 0.164,
    landing: 0.38,
    heel_rise: [0.16, 0.45],
    poise: 1.08,
    trailing_foot: [(0.20, -1.42), (0.46, -0.95), (0.72, -0.25)],
    fold: 0.17,
    clearance: 0.10,
    push_off_acceleration: 10.0,
    strike_deceleration: 22.0,
};

/// Running parameters of a style: those of a neutral runner (160–170 steps/min, trunk leaning forward, elbows near
/// 90°), changed in the direction in which the style's walk differs from a neutral walk.
fn running(style: &Style) -> Style {
    let walk = &STYLES[0];
    let ratio = |of: fn(&Style) -> f32| of(style) / of(walk);
    let difference = |of: fn(&Style) -> f32| of(style) - of(walk);
    Style {
        cadence: 164.0 * ratio(|s| s.cadence).sqrt(),
        step_length: 0.98 * ratio(|s| s.step_length),
        step_width: 0.04 + 0.7 * difference(|s| s.step_width),
        duty: RUNNING.duty + 0.7 * difference(|s| s.duty),
        toe_out: 4.0 + difference(|s| s.toe_out),
        strike_pitch: 9.0 + 0.4 * difference(|s| s.strike_pitch),
        heel_off: 0.17 + 0.4 * difference(|s| s.heel_off),
        push_off_pitch: 60.0 + 0.5 * difference(|s| s.push_off_pitch),
        foot_lift: 0.03 + difference(|s| s.foot_lift),
        foot_lead: 0.5 * difference(|s| s.foot_lead),
        crouch: 0.5 * difference(|s| s.crouch),
        knee_give: 1.0 + 0.3 * difference(|s| s.knee_give),
        bounce: 0.0,
        sway: 0.010 + 0.5 * difference(|s| s.sway),
        pelvis_tilt: 9.0 + 0.6 * difference(|s| s.pelvis_tilt),
        pelvis_yaw: 7.0 + 0.6 * difference(|s| s.pelvis_yaw),
        pelvis_roll: 5.0 + 0.6 * difference(|s| s.pelvis_roll),
        spine_pitch: 1.0 + 0.8 * difference(|s| s.spine_pitch),
        chest_pitch: 2.0 + 0.8 * difference(|s| s.chest_pitch),
        chest_yaw: 10.0 + difference(|s| s.chest_yaw),
        trunk_nod: 1.6 + difference(|s| s.trunk_nod),
        neck_pitch: 4.0 + difference(|s| s.neck_pitch),
        gaze_pitch: 6.0 + difference(|s| s.gaze_pitch),
        arm_forward: -12.0 + difference(|s| s.arm_forward),
        arm_swing: 27.0 * (0.4 + 0.6 * ratio(|s| s.arm_swing)),
        arm_spread: 15.0 + difference(|s| s.arm_spread),
        arm_twist: 20.0 + 0.6 * difference(|s| s.arm_twist),
        arm_drag: 0.6 * style.arm_drag,
        elbow: 88.0 + 0.4 * difference(|s| s.elbow),
        elbow_swing: 10.0 * (0.4 + 0.6 * ratio(|s| s.elbow_swing)),
        pronation: 20.0 + 0.5 * difference(|s| s.pronation),
        ..*style
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn running_has_a_flight_phase_and_walking_double_support_in_every_style() {
        for style in &STYLES {
            let run = Action::Run.style(style);
            assert!(run.duty < 0.45 && style.duty > 0.55, "{}", style.name);
            assert!(run.heel_off > 0.1 && run.heel_off < run.duty - 0.1, "{}", style.name);
            let speed = |s: &Style| s.step_length * s.cadence / 60.0;
            assert!((1.3..4.0).contains(&speed(&run)), "{}: {} m/s", style.name, speed(&run));
            assert!(speed(&run) > 1.5 * speed(style), "{}", style.name);
        }
    }
}
