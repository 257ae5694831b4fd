//! Control of a driven character.

use super::moves::Move;
use crate::math::Vec2;

/// The current input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Control {
    /// Direction over the ground (x, z), of length 0 (stand) to 1.
    pub wish: Vec2,
    /// 0 stands, 1 walks, 2 runs; values between are interpolated.
    pub gait: f32,
    /// Heading to face, radians about +Y; by default the direction of `wish`.
    pub face: Option<f32>,
    /// A move; it begins when the value changes.
    pub action: Option<Move>,
}

impl Control {
    /// Clamps the values to their ranges; `None` if a number is not finite.
    pub(super) fn checked(self) -> Option<Self> {
        let finite = self.wish.is_finite() && self.gait.is_finite() && self.face.is_none_or(f32::is_finite);
        let wish = self.wish.clamp_length_max(1.0);
        finite.then(|| Self { wish, gait: self.gait.clamp(0.0, 2.0), ..self })
    }
}
