//! Path of the body, and the footprints beside it.

use crate::action::Mechanics;
use crate::noise::{Channel, Noise};
use crate::script::Script;
use crate::style::Style;
use strut_core::math::float_funcs::sin_cos;
use strut_core::math::interpolation::hermite_weights;
use strut_core::math::{Quat, Vec3};

/// Points of the path per stride.
const SAMPLES_PER_STRIDE: usize = 64;

/// Strides planned before the start and after the end of a script.
pub(crate) const MARGIN_STRIDES: u32 = 3;

/// Side of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
}

impl Side {
    pub(crate) const BOTH: [Side; 2] = [Side::Left, Side::Right];

    /// Sign of the side's x coordinate.
    pub(crate) fn sign(self) -> f32 {
        match self {
            Side::Left => 1.0,
            Side::Right => -1.0,
        }
    }

    /// Phase of the stride at which this foot strikes.
    pub(crate) fn strike_phase(self) -> f32 {
        match self {
            Side::Left => 0.0,
            Side::Right => 0.5,
        }
    }
}

/// Footprint of a flat foot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint {
    /// The ankle's projection on the ground.
    pub(crate) position: Vec3,
    /// Direction of the foot.
    pub(crate) heading: f32,
}

/// Path of the middle of the body without sway, by phase.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    positions: Vec<Vec3>,
    headings: Vec<f32>,
    velocities: Vec<Vec3>,
}

/// Factor of a stride's amplitudes at a speed: steps become longer and quicker in equal proportion, because the ratio
/// of step length to cadence stays constant (Sekiya et al. 1996, "The invariant relationship between step length and
/// step rate").
pub(crate) fn stretch(speed: f32) -> f32 {
    speed.max(0.0).sqrt()
}

impl Path {
    /// Path of a script with this step length, a function of the phase. At phase 0 it passes the origin, heading +Z.
    pub(crate) fn plan(script: &Script, step_length: impl Fn(f32) -> f32) -> Self {
        let step = 1.0 / SAMPLES_PER_STRIDE as f32;
        let margin = MARGIN_STRIDES as usize * SAMPLES_PER_STRIDE;
        let count = script.strides() as usize * SAMPLES_PER_STRIDE + 2 * margin + 1;
        let phase = |i: usize| i as f32 * step - MARGIN_STRIDES as f32;
        let velocity = |phase: f32, heading: f32| {
            let (s, c) = sin_cos(heading);
            Vec3::new(s, 0.0, c) * (2.0 * step_length(phase) * stretch(script.speed(phase)))
        };
        let mut path = Self { positions: vec![Vec3::ZERO], headings: vec![0.0], velocities: vec![] };
        path.velocities.push(velocity(phase(0), 0.0));
        for i in 1..count {
            let (position, heading) = (path.positions[i - 1], path.headings[i - 1]);
            let middle = phase(i) - 0.5 * step;
            let turn = script.turn_rate(middle) * step;
            path.positions.push(position + velocity(middle, heading + 0.5 * turn) * step);
            path.headings.push(heading + turn);
            path.velocities.push(velocity(phase(i), heading + turn));
        }
        path.place_at_origin(margin);
        path
    }

    /// Moves and turns the path such that sample `i` is at the origin, heading +Z.
    fn place_at_origin(&mut self, i: usize) {
        let (origin, heading) = (self.positions[i], self.headings[i]);
        let turn = Quat::from_rotation_y(-heading);
        for p in &mut self.positions {
            *p = turn * (*p - origin);
        }
        for v in &mut self.velocities {
            *v = turn * *v;
        }
        for h in &mut self.headings {
            *h -= heading;
        }
    }

    /// Position on the ground.
    pub(crate) fn position(&self, phase: f32) -> Vec3 {
        let (i, t) = self.locate(phase);
        let h = 1.0 / SAMPLES_PER_STRIDE as f32;
        let [from, leaving, to, arriving] = hermite_weights(t);
        self.positions[i] * from
            + self.velocities[i] * (h * leaving)
            + self.positions[i + 1] * to
            + self.velocities[i + 1] * (h * arriving)
    }

    /// Direction of walking in radians about +Y, not wrapped.
    pub(crate) fn heading(&self, phase: f32) -> f32 {
        let (i, t) = self.locate(phase);
        self.headings[i] + (self.headings[i + 1] - self.headings[i]) * t
    }

    /// Length of a stride, metres.
    pub(crate) fn stride_length(&self, phase: f32) -> f32 {
        self.velocities[self.locate(phase).0].length()
    }

    fn locate(&self, phase: f32) -> (usize, f32) {
        let x = ((phase + MARGIN_STRIDES as f32) * SAMPLES_PER_STRIDE as f32).max(0.0);
        let i = (x as usize).min(self.positions.len() - 2);
        (i, (x - i as f32).min(1.0))
    }

    /// Footprint of `side` in its stance of stride number `stride`: beside the point of the path that the body passes
    /// in the middle of that stance.
    pub(crate) fn footprint(
        &self,
        style: &Style,
        mechanics: &Mechanics,
        noise: Noise,
        side: Side,
        stride: i64,
    ) -> Footprint {
        let strike = stride as f32 + side.strike_phase();
        let passed = strike + 0.5 * style.duty;
        let heading = self.heading(passed);
        let index = 2 * stride + i64::from(side == Side::Right);
        let jitter = |channel, size: f32| size * style.irregularity * noise.step(channel, index);
        let aside = side.sign() * (0.5 * style.step_width + jitter(Channel::StepWidth, 0.008));
        let ahead = style.foot_lead - mechanics.ankle_behind_stance + jitter(Channel::StepLength, 0.009);
        let toe_out = side.sign() * (style.toe_out + jitter(Channel::ToeOut, 1.5)).to_radians();
        let position = self.position(passed) + Quat::from_rotation_y(heading) * Vec3::new(aside, 0.0, ahead);
        Footprint { position, heading: heading + toe_out }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::action::Action;
    use crate::styles::STYLES;
    use crate::takes::WALK_TAKES;

    #[test]
    fn a_straight_stride_is_two_steps_long() {
        let path = Path::plan(&WALK_TAKES[0], |_| STYLES[0].step_length);
        let step = path.position(2.5) - path.position(2.0);
        assert!((step - Vec3::new(0.0, 0.0, STYLES[0].step_length)).length() < 1e-4, "{step}");
        assert!(path.position(0.0).length() < 1e-6);
    }

    #[test]
    fn footprints_lie_on_their_side_and_one_step_apart() {
        let path = Path::plan(&WALK_TAKES[0], |_| STYLES[0].step_length);
        let noise = Noise::new(1, 13);
        let left = path.footprint(&STYLES[0], Action::Walk.mechanics(), noise, Side::Left, 2);
        let right = path.footprint(&STYLES[0], Action::Walk.mechanics(), noise, Side::Right, 2);
        assert!(left.position.x > 0.0 && right.position.x < 0.0);
        assert!((right.position.z - left.position.z - STYLES[0].step_length).abs() < 0.03);
    }
}
