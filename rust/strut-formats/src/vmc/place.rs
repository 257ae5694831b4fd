//! Where a bone is.

use strut_core::math::{Quat, Vec3};

/// Position, metres, and rotation, relative to the parent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[allow(missing_docs)]
pub struct Place {
    pub position: Vec3,
    pub rotation: Quat,
}

impl Place {
    /// A place that is relative to this one, relative to what this one is.
    pub fn then(&self, place: &Self) -> Self {
        let position = self.position + self.rotation * place.position;
        Self { position, rotation: (self.rotation * place.rotation).normalized() }
    }

    /// The inverse of [`Place::then`].
    pub fn relative(&self, place: &Self) -> Self {
        let position = self.rotation.inv_mul_vec3(place.position - self.position);
        Self { position, rotation: self.rotation.inv_mul(place.rotation).normalized() }
    }
}

/// Where the model stands.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootPlace {
    /// In the world.
    pub place: Place,
    /// Scale and offset for mixed reality as they came, if they did; Strut does not use them.
    pub scale_and_offset: Option<[f32; 6]>,
}
