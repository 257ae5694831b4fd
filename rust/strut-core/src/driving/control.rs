//! What a user asks of a driven character.

use super::moves::Move;
use crate::math::Vec2;

/// What is asked now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Control {
    /// Direction over the ground (x, z), of length 0 (stand) to 1.
    pub wish: Vec2,
    /// 0 stands, 1 walks, 2 runs, with all that is between.
    pub gait: f32,
    /// Heading to face, radians about +Y; the direction of the wish where it is left out.
    pub face: Option<f32>,
    /// A move; it begins when it is asked for anew.
    pub action: Option<Move>,
}

impl Control {
    /// The same within its ranges; `None` where a number is not finite.
    pub(super) fn checked(self) -> Option<Self> {
        let finite = self.wish.is_finite() && self.gait.is_finite() && self.face.is_none_or(f32::is_finite);
        let wish = self.wish.clamp_length_max(1.0);
        finite.then(|| Self { wish, gait: self.gait.clamp(0.0, 2.0), ..self })
    }
}
