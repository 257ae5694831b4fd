//! Transform of a bone.

use strut_core::math::{Quat, Vec3};

/// Position, metres, and rotation, relative to the parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Place {
    pub position: Vec3,
    pub rotation: Quat,
}

impl Place {
    /// Composes two transforms: `self * place`, where `place` is relative to this one.
    pub fn compose(&self, place: &Self) -> Self {
        let position = self.position + self.rotation * place.position;
        Self { position, rotation: (self.rotation * place.rotation).normalized() }
    }

    /// The inverse of [`Place::compose`].
    pub fn relative(&self, place: &Self) -> Self {
        let position = self.rotation.inv_mul_vec3(place.position - self.position);
        Self { position, rotation: self.rotation.inv_mul(place.rotation).normalized() }
    }
}

/// Position and rotation of the model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootPlace {
    /// World transform.
    pub place: Place,
    /// Received scale and offset for mixed reality, if any; Strut does not use them.
    pub scale_and_offset: Option<[f32; 6]>,
}
