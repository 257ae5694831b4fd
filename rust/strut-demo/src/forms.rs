//! Jumps, punches and kicks of a style: the parameters that do not appear in walking.
//!
//! A form contains what depends on the style; the common part is in the drills (`drill`).

/// Arm posture relative to the trunk, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// Flexion of the upper arm: 0 hanging, 90 forward.
    pub flexion: f32,
    /// Distance of the upper arm from the body: 90 to the side.
    pub spread: f32,
    /// Inward twist of the upper arm.
    pub twist: f32,
    /// Flexion of the elbow.
    pub elbow: f32,
}

/// Posture of a swung leg, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Angle of the thigh ahead of vertical.
    pub hip: f32,
    /// Outward angle of the leg.
    pub out: f32,
    /// Flexion of the knee.
    pub knee: f32,
    /// Dorsiflexion; negative points the toes.
    pub ankle: f32,
}

/// Jump of a style. Lengths in metres, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Height by which the body is lifted.
    pub rise: f32,
    /// Speed on the ground, 1 for neutral: Laban's time, sudden or sustained.
    pub speed: f32,
    /// Depth of the crouch before the jump.
    pub dip: f32,
    /// Forward bend of the trunk in the crouch.
    pub dip_bend: f32,
    /// Forward bend of the trunk in the air.
    pub air_bend: f32,
    /// Depth of the crouch on landing.
    pub landing: f32,
    /// Forward bend of the trunk on landing.
    pub landing_bend: f32,
    /// Arms before the push.
    pub wind_up: Arm,
    /// Left and right arm at the top.
    pub aloft: [Arm; 2],
    /// Arms on landing.
    pub catch: Arm,
    /// Left and right leg at the top.
    pub legs: [Swing; 2],
}

/// Punch of a style. Lengths in metres, angles in degrees, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Punch {
    /// Speed, 1 for neutral.
    pub speed: f32,
    /// Half the distance between the leading and the rear foot.
    pub stance: f32,
    /// Both arms on guard.
    pub guard: Arm,
    /// Striking arm before the strike.
    pub wind_up: Arm,
    /// Striking arm at full reach; its spread is measured from straight ahead.
    pub reach: Arm,
    /// Other arm during the strike.
    pub other: Arm,
    /// Turn of the chest in the strike.
    pub turn: f32,
    /// Forward lean of the trunk at full reach; negative leans back.
    pub lean: f32,
    /// Forward shift of the weight.
    pub shift: f32,
    /// Time at full reach.
    pub hold: f32,
    /// Duration of the wind-up as a multiple of the neutral one: an overhead swing needs more.
    pub wind_up_time: f32,
}

/// Kick of a style. Lengths in metres, angles in degrees, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kick {
    /// Speed, 1 for neutral.
    pub speed: f32,
    /// Leg before the strike.
    pub chamber: Swing,
    /// Leg at full reach.
    pub strike: Swing,
    /// Forward lean of the trunk at full reach; negative leans back.
    pub lean: f32,
    /// Time at full reach.
    pub hold: f32,
    /// Bend of the supporting knee under the weight.
    pub sink: f32,
    /// Arms of the supporting side and of the kicking side at full reach.
    pub arms: [Arm; 2],
}

pub(crate) const fn arm(flexion: f32, spread: f32, twist: f32, elbow: f32) -> Arm {
    Arm { flexion, spread, twist, elbow }
}

pub(crate) const fn swing(hip: f32, knee: f32, ankle: f32) -> Swing {
    Swing { hip, out: 0.0, knee, ankle }
}

/// Equal arms.
pub(crate) const fn arms(flexion: f32, spread: f32, twist: f32, elbow: f32) -> [Arm; 2] {
    [arm(flexion, spread, twist, elbow); 2]
}

/// Equal legs.
pub(crate) const fn legs(hip: f32, out: f32, knee: f32, ankle: f32) -> [Swing; 2] {
    [Swing { hip, out, knee, ankle }; 2]
}
