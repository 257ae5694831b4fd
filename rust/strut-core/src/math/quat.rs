//! Unit quaternions.
//!
//! A separate type instead of glam's, whose SIMD layout and trigonometry give different bits in scalar WebAssembly (see
//! `docs/methods/mar.md` §5).

use super::Vec3;
use super::float_funcs::{acos, atan2, sin, sin_cos};
use std::ops::{Mul, Neg};

/// A rotation as a unit quaternion x·i + y·j + z·k + w.
///
/// `a * b` applies `b` first. Methods whose name begins with `inv` use the inverse of `self`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Quat {
    /// i component.
    pub x: f32,
    /// j component.
    pub y: f32,
    /// k component.
    pub z: f32,
    /// Real component.
    pub w: f32,
}

impl Default for Quat {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Quat {
    /// The identity rotation.
    pub const IDENTITY: Self = Self { x: 0.0, y: 0.0, z: 0.0, w: 1.0 };

    /// Creates a quaternion from components, without normalising.
    pub const fn from_xyzw(x: f32, y: f32, z: f32, w: f32) -> Self {
        Self { x, y, z, w }
    }

    /// Creates a quaternion from [x, y, z, w], without normalising.
    pub const fn from_array(a: [f32; 4]) -> Self {
        Self { x: a[0], y: a[1], z: a[2], w: a[3] }
    }

    /// Returns [x, y, z, w].
    pub const fn to_array(self) -> [f32; 4] {
        [self.x, self.y, self.z, self.w]
    }

    /// Rotation by `angle` radians about the unit vector `axis`.
    pub fn from_axis_angle(axis: Vec3, angle: f32) -> Self {
        let (s, c) = sin_cos(0.5 * angle);
        Self { x: axis.x * s, y: axis.y * s, z: axis.z * s, w: c }
    }

    /// Rotation about +X by `angle` radians.
    pub fn from_rotation_x(angle: f32) -> Self {
        Self::from_axis_angle(Vec3::X, angle)
    }

    /// Rotation about +Y by `angle` radians; heading 0 faces +Z.
    pub fn from_rotation_y(angle: f32) -> Self {
        Self::from_axis_angle(Vec3::Y, angle)
    }

    /// Rotation about +Z by `angle` radians.
    pub fn from_rotation_z(angle: f32) -> Self {
        Self::from_axis_angle(Vec3::Z, angle)
    }

    /// The rotation whose matrix has these orthonormal, right-handed columns.
    pub fn from_basis(x: Vec3, y: Vec3, z: Vec3) -> Self {
        let trace = x.x + y.y + z.z;
        let q = if trace > 0.0 {
            let s = (trace + 1.0).sqrt() * 2.0;
            Self { x: (y.z - z.y) / s, y: (z.x - x.z) / s, z: (x.y - y.x) / s, w: 0.25 * s }
        } else if x.x > y.y && x.x > z.z {
            let s = (1.0 + x.x - y.y - z.z).sqrt() * 2.0;
            Self { x: 0.25 * s, y: (y.x + x.y) / s, z: (z.x + x.z) / s, w: (y.z - z.y) / s }
        } else if y.y > z.z {
            let s = (1.0 + y.y - x.x - z.z).sqrt() * 2.0;
            Self { x: (y.x + x.y) / s, y: 0.25 * s, z: (z.y + y.z) / s, w: (z.x - x.z) / s }
        } else {
            let s = (1.0 + z.z - x.x - y.y).sqrt() * 2.0;
            Self { x: (z.x + x.z) / s, y: (z.y + y.z) / s, z: 0.25 * s, w: (x.y - y.x) / s }
        };
        q.normalized()
    }

    /// The shortest rotation that takes the direction `from` to the direction `to` (any lengths;
    /// identity if either is zero; a half turn about some perpendicular axis if they are opposite).
    pub fn from_rotation_arc(from: Vec3, to: Vec3) -> Self {
        let (from, to) = (from.normalize_or_zero(), to.normalize_or_zero());
        if from == Vec3::ZERO || to == Vec3::ZERO {
            return Self::IDENTITY;
        }
        let d = from.dot(to);
        if d < -0.999_999 {
            let helper = if from.x.abs() < 0.6 { Vec3::X } else { Vec3::Y };
            let axis = from.cross(helper).normalize_or_zero();
            return Self { x: axis.x, y: axis.y, z: axis.z, w: 0.0 };
        }
        let c = from.cross(to);
        Self { x: c.x, y: c.y, z: c.z, w: 1.0 + d }.normalized()
    }

    /// Inner product of the components; its absolute value is the cosine of half the angle between.
    pub fn dot(self, o: Self) -> f32 {
        self.x * o.x + self.y * o.y + self.z * o.z + self.w * o.w
    }

    /// Scaled to unit length; identity if the length is zero or not finite.
    pub fn normalized(self) -> Self {
        let n = self.dot(self).sqrt();
        if n > 1e-20 && n.is_finite() {
            Self { x: self.x / n, y: self.y / n, z: self.z / n, w: self.w / n }
        } else {
            Self::IDENTITY
        }
    }

    /// The mirror image of the rotation at the plane x = 0.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self::from_xyzw(self.x, -self.y, -self.z, self.w)
    }

    /// The inverse rotation.
    pub fn inverse(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z, w: self.w }
    }

    /// `self⁻¹ · o`: the rotation that leads from `self` to `o`, in the frame of `self`.
    pub fn inv_mul(self, o: Self) -> Self {
        self.inverse() * o
    }

    /// `self⁻¹` applied to a vector.
    pub fn inv_mul_vec3(self, v: Vec3) -> Vec3 {
        self.inverse() * v
    }

    /// Returns the one of ±`self` that is nearer to `o`; both are the same rotation.
    pub fn nearest_to(self, o: Self) -> Self {
        if self.dot(o) < 0.0 { -self } else { self }
    }

    /// Rotation angle in [0, π].
    pub fn angle(self) -> f32 {
        let v = (self.x * self.x + self.y * self.y + self.z * self.z).sqrt();
        2.0 * atan2(v, self.w.abs())
    }

    /// Spherical interpolation along the shortest arc; `t` in [0, 1].
    pub fn slerp(self, to: Self, t: f32) -> Self {
        let to = to.nearest_to(self);
        let cos_half = self.dot(to);
        let (a, b) = if cos_half > 0.9995 {
            (1.0 - t, t)
        } else {
            let half = acos(cos_half);
            let inv = 1.0 / sin(half);
            (sin((1.0 - t) * half) * inv, sin(t * half) * inv)
        };
        Self { x: a * self.x + b * to.x, y: a * self.y + b * to.y, z: a * self.z + b * to.z, w: a * self.w + b * to.w }
            .normalized()
    }

    /// Splits the rotation into `swing * twist`; the twist is the part about the unit vector `axis`.
    pub fn swing_twist(self, axis: Vec3) -> (Self, Self) {
        let p = axis.dot(Vec3::new(self.x, self.y, self.z));
        let twist = Self { x: axis.x * p, y: axis.y * p, z: axis.z * p, w: self.w }.normalized();
        (self * twist.inverse(), twist)
    }

    /// Whether all components are finite numbers.
    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite() && self.w.is_finite()
    }
}

impl From<glam::Quat> for Quat {
    fn from(q: glam::Quat) -> Self {
        Self::from_array(q.to_array())
    }
}

impl From<Quat> for glam::Quat {
    fn from(q: Quat) -> Self {
        Self::from_array(q.to_array())
    }
}

impl Mul for Quat {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self {
            x: self.w * o.x + self.x * o.w + self.y * o.z - self.z * o.y,
            y: self.w * o.y - self.x * o.z + self.y * o.w + self.z * o.x,
            z: self.w * o.z + self.x * o.y - self.y * o.x + self.z * o.w,
            w: self.w * o.w - self.x * o.x - self.y * o.y - self.z * o.z,
        }
    }
}

impl Mul<Vec3> for Quat {
    type Output = Vec3;
    fn mul(self, v: Vec3) -> Vec3 {
        let u = Vec3::new(self.x, self.y, self.z);
        let t = 2.0 * u.cross(v);
        v + self.w * t + u.cross(t)
    }
}

impl Neg for Quat {
    type Output = Self;
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z, w: -self.w }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f32::consts::PI;

    #[test]
    fn conversions_to_and_from_glam_keep_the_components() {
        let q = Quat::from_xyzw(0.1, -0.2, 0.3, 0.9);
        assert_eq!(glam::Quat::from(q).to_array(), q.to_array());
        assert_eq!(Quat::from(glam::Quat::from(q)), q);
    }

    fn unit_quat() -> impl Strategy<Value = Quat> {
        prop::array::uniform4(-1.0f32..1.0)
            .prop_filter("not too short", |a| a.iter().map(|x| x * x).sum::<f32>() > 0.01)
            .prop_map(|a| Quat::from_array(a).normalized())
    }

    fn vec3() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-2.0f32..2.0).prop_map(Vec3::from_array)
    }

    proptest! {
        #[test]
        fn product_applies_the_right_factor_first(a in unit_quat(), b in unit_quat(), v in vec3()) {
            prop_assert!(((a * b) * v - a * (b * v)).length() < 1e-5);
        }

        #[test]
        fn basis_columns_give_the_rotation_back(q in unit_quat()) {
            let r = Quat::from_basis(q * Vec3::X, q * Vec3::Y, q * Vec3::Z);
            prop_assert!(q.dot(r).abs() > 1.0 - 1e-5);
        }

        #[test]
        fn arc_takes_one_direction_to_the_other(a in vec3(), b in vec3()) {
            prop_assume!(a.length() > 0.1 && b.length() > 0.1);
            let r = Quat::from_rotation_arc(a, b) * a.normalize();
            prop_assert!((r - b.normalize()).length() < 2e-3);
        }

        #[test]
        fn swing_times_twist_is_the_rotation(q in unit_quat(), axis in vec3()) {
            prop_assume!(axis.length() > 0.1);
            let (swing, twist) = q.swing_twist(axis.normalize());
            prop_assert!((swing * twist).dot(q).abs() > 1.0 - 1e-4);
        }
    }

    #[test]
    fn slerp_runs_the_short_way_at_constant_speed() {
        let a = Quat::from_rotation_y(0.2);
        let b = -Quat::from_rotation_y(1.2);
        let m = a.slerp(b, 0.25);
        assert!(m.dot(Quat::from_rotation_y(0.45)).abs() > 1.0 - 1e-6);
        assert!((Quat::from_rotation_x(PI).angle() - PI).abs() < 1e-6);
    }
}
