//! How a style jumps, punches and kicks: the part of its row that walking does not show.
//!
//! A form says what a performer chooses; what everybody does in the same way is in the [drills](crate::drill).

/// How an arm is, degrees, seen from the trunk.
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

/// How a leg is swung, degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// Thigh ahead of hanging down.
    pub hip: f32,
    /// Leg out of the other's way.
    pub out: f32,
    /// Flexion of the knee.
    pub knee: f32,
    /// Dorsiflexion; negative points the toes.
    pub ankle: f32,
}

/// How a style jumps. Lengths in metres, angles in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jump {
    /// Height by which the body is lifted.
    pub rise: f32,
    /// Speed of what is done on the ground, 1 for neutral: Laban's time, sudden or sustained.
    pub speed: f32,
    /// Depth of the crouch before.
    pub dip: f32,
    /// Forward bend of the trunk in it.
    pub dip_bend: f32,
    /// Forward bend of the trunk in the air.
    pub air_bend: f32,
    /// Depth in which the landing is caught.
    pub landing: f32,
    /// Forward bend of the trunk in it.
    pub landing_bend: f32,
    /// The arms before the push.
    pub wind_up: Arm,
    /// The left and the right arm at the top.
    pub aloft: [Arm; 2],
    /// The arms as the landing is caught.
    pub catch: Arm,
    /// The left and the right leg at the top.
    pub legs: [Swing; 2],
}

/// How a style punches. Lengths in metres, angles in degrees, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Punch {
    /// Speed, 1 for neutral.
    pub speed: f32,
    /// Half the distance between the leading and the rear foot.
    pub stance: f32,
    /// Both arms on guard.
    pub guard: Arm,
    /// The striking arm before the strike.
    pub wind_up: Arm,
    /// The striking arm at full reach; its spread from straight ahead.
    pub reach: Arm,
    /// The other arm meanwhile.
    pub other: Arm,
    /// Turn of the chest into the strike.
    pub turn: f32,
    /// Forward lean of the trunk at full reach; negative leans back.
    pub lean: f32,
    /// Way of the weight forward.
    pub shift: f32,
    /// Time at full reach.
    pub hold: f32,
    /// Time of the wind-up as a multiple of a neutral one's: an arm that is thrown overhead needs more.
    pub wind_up_time: f32,
}

/// How a style kicks. Lengths in metres, angles in degrees, times in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kick {
    /// Speed, 1 for neutral.
    pub speed: f32,
    /// The leg before the strike.
    pub chamber: Swing,
    /// The leg at full reach.
    pub strike: Swing,
    /// Forward lean of the trunk at full reach; negative leans back.
    pub lean: f32,
    /// Time at full reach.
    pub hold: f32,
    /// How far the standing leg gives in to the weight: it bends the knee.
    pub sink: f32,
    /// The arm of the standing side and that of the kicking side at full reach.
    pub arms: [Arm; 2],
}

pub(crate) const fn arm(flexion: f32, spread: f32, twist: f32, elbow: f32) -> Arm {
    Arm { flexion, spread, twist, elbow }
}

pub(crate) const fn swing(hip: f32, knee: f32, ankle: f32) -> Swing {
    Swing { hip, out: 0.0, knee, ankle }
}

/// Both arms alike.
pub(crate) const fn arms(flexion: f32, spread: f32, twist: f32, elbow: f32) -> [Arm; 2] {
    [arm(flexion, spread, twist, elbow); 2]
}

/// Both legs alike.
pub(crate) const fn legs(hip: f32, out: f32, knee: f32, ankle: f32) -> [Swing; 2] {
    [Swing { hip, out, knee, ankle }; 2]
}
