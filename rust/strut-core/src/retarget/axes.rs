//! Detection of a file's up axis and of mirrored files from the body, because files do not specify them.

use super::rest_pose::RestPose;
use super::sample::Sample;
use crate::humanoid::{JOINTS, Role};
use crate::math::float_funcs::asin;
use crate::math::{Quat, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};
use std::fmt;

/// A body stands along an axis if the cosine of its direction from feet to head is above this: 45°.
const STANDS: f32 = 0.7;
/// A body travels over the ground if its hips move this far across its up axis, in leg lengths, and at most a third of that
/// along the axis.
const TRAVEL: f32 = 0.7;
/// Least cosine between a standing body's thighs and the axis from its feet to its head, if the zero pose is inconclusive.
const THIGHS_ALONG: f32 = 0.5;
/// Height of the hip joints above the origin of a body that stands still, in leg lengths.
const HIPS_OVER_ORIGIN: std::ops::Range<f32> = 0.8..1.3;
/// Feet are flat on the ground if their pitch differs from that in the zero pose by less than this, radians.
const FLAT_SOLE: f32 = 0.26;
/// Toes point and knees bend backwards if the mean sum of their cosines with the forward direction is below this; in
/// recordings it is above 0.6.
const BACKWARDS: f32 = -0.3;
/// A leg is clearly bent if twice the distance of the knee from the straight leg exceeds this, in leg lengths.
const PLAINLY_BENT: f32 = 0.2;

/// An up axis of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum UpAxis {
    X,
    NegX,
    Y,
    NegY,
    Z,
    NegZ,
}

impl UpAxis {
    /// All axes with their names on command lines and in JSON.
    pub const ALL: [(UpAxis, &'static str); 6] = [
        (UpAxis::X, "x"),
        (UpAxis::NegX, "-x"),
        (UpAxis::Y, "y"),
        (UpAxis::NegY, "-y"),
        (UpAxis::Z, "z"),
        (UpAxis::NegZ, "-z"),
    ];

    /// Returns the axis of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().find(|(_, n)| n.eq_ignore_ascii_case(name)).map(|(axis, _)| *axis)
    }

    /// Name on command lines and in JSON.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(axis, _)| *axis == self).map_or("y", |(_, name)| *name)
    }

    /// The direction in the file's axes.
    pub fn direction(self) -> Vec3 {
        match self {
            UpAxis::X => Vec3::X,
            UpAxis::NegX => Vec3::NEG_X,
            UpAxis::Y => Vec3::Y,
            UpAxis::NegY => Vec3::NEG_Y,
            UpAxis::Z => Vec3::Z,
            UpAxis::NegZ => Vec3::NEG_Z,
        }
    }

    /// Rotation from the file's axes to ours: the shortest one that takes this axis to +Y.
    pub fn to_y(self) -> Quat {
        match self {
            UpAxis::X => Quat::from_rotation_z(FRAC_PI_2),
            UpAxis::NegX => Quat::from_rotation_z(-FRAC_PI_2),
            UpAxis::Y => Quat::IDENTITY,
            UpAxis::NegY => Quat::from_rotation_x(PI),
            UpAxis::Z => Quat::from_rotation_x(-FRAC_PI_2),
            UpAxis::NegZ => Quat::from_rotation_x(FRAC_PI_2),
        }
    }

    fn of(direction: Vec3) -> Option<Self> {
        Self::ALL.into_iter().map(|(axis, _)| axis).find(|axis| axis.direction().dot(direction) > STANDS)
    }
}

impl fmt::Display for UpAxis {
    /// Formats the axis for messages: `+Z`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (sign, letter) = match self.name().strip_prefix('-') {
            Some(letter) => ('−', letter),
            None => ('+', self.name()),
        };
        write!(f, "{sign}{}", letter.to_ascii_uppercase())
    }
}

/// The up axis of a clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Up {
    pub(super) axis: UpAxis,
    /// The axis along which the body is most of the time, if it was not accepted as up with certainty.
    pub(super) doubt: Option<UpAxis>,
}

/// Detects the up axis from the body.
///
/// The axis along which the body stands in most frames is up if the zero pose stands along it too: then the whole file is
/// rotated. If the zero pose stands along another axis, either only the root is rotated, or the body lies down. It stands if
/// it travels over the ground across that axis, or stands still on the soles of its feet. If the zero pose is inconclusive,
/// the frames decide, by those in which the thighs are parallel to the trunk, because on all fours the trunk is horizontal.
/// If the frames are inconclusive, as in crawling, the zero pose's axis is up if the body travels over the ground across it
/// and not across +Y.
pub(super) fn up_axis(roles: &[Option<usize>; JOINTS], sample: &Sample, rest: &RestPose) -> Up {
    let at = |r: Role| roles[r.index()].unwrap_or(0);
    let top = [Role::Head, Role::Neck, Role::Chest, Role::Spine].iter().find_map(|r| roles[r.index()]).unwrap_or(0);
    let [left, right] = [Role::LeftFoot, Role::RightFoot].map(at);
    let thighs = [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::RightUpperLeg, Role::RightLowerLeg].map(at);
    let zero = rest.zero_up.and_then(UpAxis::of);
    let axes: Vec<Option<UpAxis>> = sample
        .each(|w| {
            let axis = UpAxis::of((w[top].0 - 0.5 * (w[left].0 + w[right].0)).normalize_or_zero())?;
            let [left_hip, left_knee, right_hip, right_knee] = thighs.map(|j| w[j].0);
            let thighs = (left_hip - left_knee + right_hip - right_knee).normalize_or_zero();
            (zero.is_some() || thighs.dot(axis.direction()) > THIGHS_ALONG).then_some(axis)
        })
        .collect();
    let votes = |axis: UpAxis| axes.iter().filter(|vote| **vote == Some(axis)).count();
    let most = UpAxis::ALL.into_iter().map(|(axis, _)| axis).find(|axis| 2 * votes(*axis) > axes.len());
    let known = |axis: UpAxis| Up { axis, doubt: None };
    let unsure = |axis: UpAxis, lies_along: UpAxis| Up { axis, doubt: Some(lies_along) };
    let travels = |axis: UpAxis| travels_across(axis, roles, sample);
    match (most, zero) {
        (Some(UpAxis::Y), _) | (None, None | Some(UpAxis::Y)) => known(UpAxis::Y),
        (None, Some(zero)) if travels(zero) == travels(UpAxis::Y) => unsure(UpAxis::Y, zero),
        (None, Some(zero)) => known(if travels(zero) { zero } else { UpAxis::Y }),
        (Some(axis), None) => known(axis),
        (Some(axis), Some(zero)) if zero == axis || travels(axis) => known(axis),
        (Some(axis), Some(_)) if stands_still(axis, roles, sample, rest) => unsure(axis, axis),
        (Some(axis), Some(_)) => unsure(UpAxis::Y, axis),
    }
}

/// Whether the body stands along an axis in place: its hips are as high above the origin as its legs are long, and its feet
/// are pitched as in the zero pose, which is standing. The feet of a lying body point away.
fn stands_still(axis: UpAxis, roles: &[Option<usize>; JOINTS], sample: &Sample, rest: &RestPose) -> bool {
    let at = |r: Role| roles[r.index()];
    let up = axis.direction();
    let legs = [
        [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot],
        [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot],
    ];
    let feet = [(Role::LeftFoot, Role::LeftToes), (Role::RightFoot, Role::RightToes)];
    let stands = sample.each(|w| {
        let high = legs.iter().all(|leg| {
            let [Some(hip), Some(knee), Some(ankle)] = leg.map(at) else { return false };
            let leg = (w[knee].0 - w[hip].0).length() + (w[ankle].0 - w[knee].0).length();
            HIPS_OVER_ORIGIN.contains(&(w[hip].0.dot(up) / leg))
        });
        let flat = feet.iter().zip(rest.zero_foot_pitch).all(|((foot, toes), zero)| {
            let (Some(foot), Some(toes), Some(zero)) = (at(*foot), at(*toes), zero) else { return true };
            let bone = (w[toes].0 - w[foot].0).normalize_or_zero();
            (asin(bone.dot(up).clamp(-1.0, 1.0)) - zero).abs() < FLAT_SOLE
        });
        high && flat
    });
    let stands: Vec<bool> = stands.collect();
    10 * stands.iter().filter(|stands| **stands).count() >= 9 * stands.len()
}

/// Whether the hips travel across an axis, and not along it.
fn travels_across(axis: UpAxis, roles: &[Option<usize>; JOINTS], sample: &Sample) -> bool {
    let at = |r: Role| roles[r.index()].unwrap_or(0);
    let [hips, hip, knee, ankle] = [Role::Hips, Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot].map(at);
    let leg = sample.mean(|w| Vec3::splat((w[knee].0 - w[hip].0).length() + (w[ankle].0 - w[knee].0).length())).x;
    let places: Vec<Vec3> = sample.each(|w| w[hips].0).collect();
    let Some(first) = places.first() else { return false };
    let up = axis.direction();
    let along = places.iter().map(|p| (*p - *first).dot(up).abs()).fold(0.0, f32::max);
    let across = places.iter().map(|p| (*p - *first) - up * (*p - *first).dot(up)).map(Vec3::length);
    let across = across.fold(0.0, f32::max);
    across > TRAVEL * leg && along < across / 3.0
}

/// Whether toes point and knees bend backwards for the named sides: the file is then a mirror image, as left-handed programs
/// write it.
pub(super) fn is_mirrored(roles: &[Option<usize>; JOINTS], sample: &Sample) -> bool {
    let at = |r: Role| roles[r.index()];
    let Some(top) = [Role::Neck, Role::Head, Role::Chest, Role::Spine].into_iter().find_map(at) else { return false };
    let legs = [
        [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot],
        [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot],
    ];
    let [Some(left), Some(right)] = legs.map(|leg| Some([at(leg[0])?, at(leg[1])?, at(leg[2])?])) else { return false };
    let toes = [Role::LeftToes, Role::RightToes].map(at);
    let turned = sample.mean(|w| {
        let hips = 0.5 * (w[left[0]].0 + w[right[0]].0);
        let ahead = (w[left[0]].0 - w[right[0]].0).cross(w[top].0 - hips).normalize_or_zero();
        let foot = |leg: [usize; 3], toes: Option<usize>| toes.map_or(Vec3::ZERO, |t| w[t].0 - w[leg[2]].0);
        let toes = (foot(left, toes[0]) + foot(right, toes[1])).normalize_or_zero();
        // Almost straight legs have little weight.
        let bend = |[hip, knee, ankle]: [usize; 3]| {
            let leg = (w[knee].0 - w[hip].0).length() + (w[ankle].0 - w[knee].0).length();
            let bend = (2.0 * w[knee].0 - w[hip].0 - w[ankle].0) / (PLAINLY_BENT * leg.max(f32::MIN_POSITIVE));
            bend / bend.length().max(1.0)
        };
        Vec3::splat((toes + 0.5 * (bend(left) + bend(right))).dot(ahead))
    });
    turned.x < BACKWARDS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_axis_is_taken_to_y_and_has_a_name() {
        for (axis, name) in UpAxis::ALL {
            assert!((axis.to_y() * axis.direction() - Vec3::Y).length() < 1e-6, "{axis}");
            assert_eq!((UpAxis::from_name(name), axis.name()), (Some(axis), name));
        }
        assert_eq!(UpAxis::NegZ.to_string(), "−Z");
    }
}
