//! Rolling of a foot over the ground and its swing to the next footprint.
//!
//! In stance the foot rotates about its contact point: the heel until the foot is flat, then the ball, at last the tip
//! of the toes (Perry's heel, forefoot and toe rockers; her ankle rocker is the shin over the flat foot). The contact
//! point is fixed, so that a planted foot cannot slide. In swing the ankle follows a quintic that continues position,
//! velocity and acceleration of the stances before and after.

use crate::action::{Action, Mechanics};
use crate::jet::Jet;
use crate::noise::Noise;
use crate::path::{Footprint, Path, Side, stretch};
use crate::periodic::PeriodicCurve;
use crate::script::Script;
use crate::style::Style;
use strut_core::humanoid::{Proportions, Role};
use strut_core::math::interpolation::smooth_step;
use strut_core::math::{Quat, Vec3};

/// Distance behind the ankle of the point of the sole that strikes the ground.
const HEEL_BEHIND_ANKLE: f32 = 0.058;
/// Distance ahead of the toe joint of the point of the sole that leaves the ground last.
const TIP_AHEAD_OF_TOES: f32 = 0.060;

/// Phase after its strike at which a stance's blend of the two actions is evaluated.
const WEIGHED_AT: f32 = 0.25;
/// Greatest deceleration of a foot before it strikes, m/s².
const HARDEST_BRAKING: f32 = 75.0;
/// Scales t³(1 − t)⁸, whose maximum is a little after a quarter of the swing, to a height of 1.
const EARLY_ARCH: f32 = 629.848;
/// Scales t³(1 − t)³ to a height of 1.
const MIDDLE_ARCH: f32 = 64.0;

/// A foot at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FootPose {
    /// Position of the ankle.
    pub(crate) ankle: Vec3,
    /// Rotation of the foot in the world.
    pub(crate) foot: Quat,
    /// Rotation of the toes relative to the foot.
    pub(crate) toes: Quat,
    /// Whether the foot is planted.
    pub(crate) planted: bool,
    /// Phase since the foot's last strike, in [0, 1).
    pub(crate) cycle: f32,
    /// Direction of the foot, radians about +Y.
    pub(crate) heading: f32,
    /// Freedom of the foot to deviate from its path: 0 on the ground and at the ends of the swing, otherwise up to 1.
    pub(crate) freedom: f32,
}

/// Rolling of the feet of an action in a style.
#[derive(Clone, Debug)]
struct Row<'a> {
    style: &'a Style,
    mechanics: &'static Mechanics,
    foot_pitch: PeriodicCurve,
    toe_pitch: PeriodicCurve,
}

impl<'a> Row<'a> {
    fn new(action: Action, style: &'a Style) -> Self {
        let mechanics = action.mechanics();
        let (foot_pitch, toe_pitch) = (foot_pitch_curve(style, mechanics), toe_pitch_curve(style, mechanics));
        Self { style, mechanics, foot_pitch, toe_pitch }
    }
}

/// Plans both feet of a performance. Each stance belongs to one action or the other, or is a blend of both.
#[derive(Clone, Debug)]
pub(crate) struct Feet<'a, W> {
    script: &'a Script,
    path: &'a Path,
    noise: Noise,
    geometry: FootGeometry,
    rows: [Row<'a>; 2],
    weight: W,
}

/// Position of a foot in its cycle.
#[derive(Clone, Copy, Debug)]
enum Part {
    /// Share of the stance.
    Stance(f32),
    /// Share of the swing.
    Swing(f32),
}

/// Points of the foot in its own frame, relative to the ankle, for a flat foot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FootGeometry {
    ankle_height: f32,
    heel: Vec3,
    ball: Vec3,
    tip_from_ball: Vec3,
}

impl FootGeometry {
    pub(crate) fn of(proportions: &Proportions) -> Self {
        let at = |r: Role| proportions.offsets[r.index()];
        let leg =
            [Role::Hips, Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot].iter().map(|&r| at(r).y).sum::<f32>();
        let ball = at(Role::LeftToes);
        Self {
            ankle_height: leg,
            heel: Vec3::new(0.0, -leg, -HEEL_BEHIND_ANKLE),
            ball,
            tip_from_ball: Vec3::new(0.0, -(leg + ball.y), TIP_AHEAD_OF_TOES),
        }
    }

    /// Points of the sole that can carry the foot: the heel in the foot's frame, ball and tip in the toes' frame.
    pub(crate) fn sole(&self) -> [Vec3; 3] {
        [self.heel, self.tip_from_ball.with_z(0.0), self.tip_from_ball]
    }

    /// The ankle of a foot on the ground, relative to the ankle's projection in the flat foot, in the frame of the
    /// footprint. Pitches in radians, toes up. The point that carries the foot does not move.
    pub(crate) fn ankle_on_ground(&self, foot_pitch: f32, toe_pitch: f32) -> Vec3 {
        let flat = Vec3::new(0.0, self.ankle_height, 0.0);
        if foot_pitch >= 0.0 {
            return flat + self.heel - pitched(foot_pitch) * self.heel;
        }
        let tip = flat + self.ball + self.tip_from_ball;
        let ball = tip - pitched(toe_pitch.min(0.0)) * self.tip_from_ball;
        ball - pitched(foot_pitch) * self.ball
    }
}

/// Rotation that lifts the toes by an angle.
pub(crate) fn pitched(angle: f32) -> Quat {
    Quat::from_rotation_x(-angle)
}

impl<'a, W: Fn(f32) -> f32> Feet<'a, W> {
    /// Feet of a script on its path. `gaits` are two actions with their parameters; `weight` is the share of the second
    /// by phase.
    pub(crate) fn new(
        proportions: &Proportions,
        script: &'a Script,
        gaits: [(Action, &'a Style); 2],
        path: &'a Path,
        noise: Noise,
        weight: W,
    ) -> Self {
        let rows = gaits.map(|(action, style)| Row::new(action, style));
        Self { script, path, noise, geometry: FootGeometry::of(proportions), rows, weight }
    }

    /// The foot of a side at a phase of the script.
    pub(crate) fn at(&self, side: Side, phase: f32) -> FootPose {
        let since_first = phase - side.strike_phase();
        let stride = since_first.floor();
        let cycle = since_first - stride;
        let weights = [0.0, 1.0].map(|later| (self.weight)(stride + later + side.strike_phase() + WEIGHED_AT));
        let duty = self.mixed(weights[0], |row| row.style.duty);
        let swung = (cycle - duty) / (1.0 - duty);
        let planted = cycle < duty;
        let here = self.footprint(weights[0], side, stride as i64);
        let ((foot_pitch, toe_pitch), ankle, heading) = if planted {
            let pitches = self.pitches(weights[0], Part::Stance(cycle / duty), phase);
            (pitches, on_print(&here, self.geometry.ankle_on_ground(pitches.0, pitches.1)), here.heading)
        } else {
            let turned = smooth_step(0.0, 1.0, swung);
            let weight = weights[0] + (weights[1] - weights[0]) * turned;
            let next = self.footprint(weights[1], side, stride as i64 + 1);
            let ankle = self.swing([&here, &next], weights, swung, phase);
            let heading = here.heading + (next.heading - here.heading) * turned;
            (self.pitches(weight, Part::Swing(swung), phase), ankle, heading)
        };
        let foot = Quat::from_rotation_y(heading) * pitched(foot_pitch);
        let freedom = smooth_step(0.0, 0.3, swung) - smooth_step(0.75, 1.0, swung);
        FootPose { ankle, foot, toes: pitched(toe_pitch - foot_pitch), planted, cycle, heading, freedom }
    }

    fn mixed(&self, weight: f32, of: impl Fn(&Row) -> f32) -> f32 {
        let first = of(&self.rows[0]);
        if weight == 0.0 { first } else { first + (of(&self.rows[1]) - first) * weight }
    }

    fn footprint(&self, weight: f32, side: Side, stride: i64) -> Footprint {
        let of = |row: &Row| self.path.footprint(row.style, row.mechanics, self.noise, side, stride);
        let first = of(&self.rows[0]);
        if weight == 0.0 {
            return first;
        }
        let second = of(&self.rows[1]);
        Footprint {
            position: first.position.lerp(second.position, weight),
            heading: first.heading + (second.heading - first.heading) * weight,
        }
    }

    /// Pitch of foot and toes relative to the ground in radians, toes up. Both increase with the stride length.
    fn pitches(&self, weight: f32, part: Part, phase: f32) -> (f32, f32) {
        let scale = stretch(self.script.speed(phase)).to_radians();
        let cycle = |row: &Row| match part {
            Part::Stance(share) => share * row.style.duty,
            Part::Swing(share) => row.style.duty + share * (1.0 - row.style.duty),
        };
        let foot = self.mixed(weight, |row| row.foot_pitch.at(cycle(row)));
        let toes = self.mixed(weight, |row| row.toe_pitch.at(cycle(row)));
        (foot * scale, toes * scale)
    }

    /// Position of the ankle in swing between two footprints, for actions blended with these weights.
    fn swing(&self, prints: [&Footprint; 2], weights: [f32; 2], t: f32, phase: f32) -> Vec3 {
        let [from, to] = prints;
        let duties = weights.map(|weight| self.mixed(weight, |row| row.style.duty));
        let length = 1.0 - duties[0];
        let lift_off = phase - t * length;
        let strike = lift_off + length;
        let ground = |print: &Footprint, weight: f32, share: f32, phase: f32| {
            let (foot_pitch, toe_pitch) = self.pitches(weight, Part::Stance(share), phase);
            Quat::from_rotation_y(print.heading) * self.geometry.ankle_on_ground(foot_pitch, toe_pitch)
        };
        let mut start = Jet::backward(|d| ground(from, weights[0], 1.0 - d / duties[0], lift_off - d))
            .shifted(from.position)
            .over(length);
        let mut end =
            Jet::forward(|d| ground(to, weights[1], d / duties[1], strike + d)).shifted(to.position).over(length);
        let impulse = |print: &Footprint, strides: f32| {
            Quat::from_rotation_y(print.heading)
                * Vec3::Z
                * (strides * self.path.stride_length(phase) * length * length)
        };
        let weight = 0.5 * (weights[0] + weights[1]);
        let strides_per_sec = self.mixed(weight, |row| row.style.cadence) / 120.0 * stretch(self.script.speed(phase));
        let hardest = HARDEST_BRAKING / (self.path.stride_length(phase) * strides_per_sec * strides_per_sec);
        let push_off = self.mixed(weights[0], |row| row.mechanics.push_off_acceleration).min(0.55 * hardest);
        let braking = self.mixed(weights[1], |row| row.mechanics.strike_deceleration).min(hardest);
        start.acceleration += impulse(from, push_off);
        end.acceleration -= impulse(to, braking);

        let mut ankle = Jet::quintic(&start, &end, t);
        let rest = 1.0 - t;
        let early = t * t * t * (rest * rest) * (rest * rest) * (rest * rest) * (rest * rest) * EARLY_ARCH;
        let middle = t * t * t * rest * rest * rest * MIDDLE_ARCH;
        let fold = |row: &Row| {
            let push_off = row.style.push_off_pitch / 60.0;
            row.mechanics.fold * push_off * push_off
        };
        ankle.y += self.mixed(weight, fold) * early
            + self.mixed(weight, |row| row.mechanics.clearance + row.style.foot_lift) * middle;
        ankle
    }
}

fn on_print(print: &Footprint, local: Vec3) -> Vec3 {
    print.position + Quat::from_rotation_y(print.heading) * local
}

/// Pitch of the foot over its cycle: toes up at the strike, flat after a sixth of the stance, heel up until the toes
/// leave the ground, and trailing in swing.
fn foot_pitch_curve(s: &Style, m: &Mechanics) -> PeriodicCurve {
    let swing = |share: f32| s.duty + share * (1.0 - s.duty);
    let flat = m.flat_after * s.duty;
    let rise = |share: f32| s.heel_off + share * (s.duty - s.heel_off);
    let [a, b, c] = m.trailing_foot.map(|(share, pitch)| (swing(share), pitch * s.push_off_pitch));
    PeriodicCurve::through(
        &[
            (0.0, s.strike_pitch),
            (0.5 * flat, m.landing * s.strike_pitch),
            (flat, 0.0),
            (s.heel_off, 0.0),
            (rise(0.35), -m.heel_rise[0] * s.push_off_pitch),
            (rise(0.62), -m.heel_rise[1] * s.push_off_pitch),
            (s.duty, -s.push_off_pitch),
            a,
            b,
            c,
            (swing(0.90), m.poise * s.strike_pitch),
        ],
        0.010,
    )
}

/// Pitch of the toes over the cycle: flat until they roll off, then trailing the foot, slightly raised before the
/// strike. The toe joint bends most at push-off (Perry & Burnfield 2010).
fn toe_pitch_curve(s: &Style, m: &Mechanics) -> PeriodicCurve {
    let swing = |share: f32| s.duty + share * (1.0 - s.duty);
    let flat = 0.9 * m.flat_after * s.duty;
    let bends = [0.42 * s.push_off_pitch, 0.16 * s.push_off_pitch, 4.0 + 0.05 * s.push_off_pitch];
    let trailing = |i: usize| (swing(m.trailing_foot[i].0), m.trailing_foot[i].1 * s.push_off_pitch + bends[i]);
    PeriodicCurve::through(
        &[
            (0.0, s.strike_pitch + 10.0),
            (0.5 * flat, 0.45 * s.strike_pitch + 6.0),
            (flat, 0.0),
            (s.duty - 0.07, 0.0),
            (s.duty, -0.32 * s.push_off_pitch),
            trailing(0),
            trailing(1),
            trailing(2),
            (swing(0.90), 1.08 * s.strike_pitch + 9.0),
        ],
        0.010,
    )
}
