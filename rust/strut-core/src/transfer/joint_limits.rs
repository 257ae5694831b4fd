//! Joint limits: ranges observed in the database, and anatomy (`docs/methods/mar.md` §10).
//!
//! The ranges limit each degree of freedom of an extrapolation. Anatomy limits every output: how far a bone swings from
//! its direction in the T-pose, how far it twists about itself, and how far knees and elbows bend backwards. Neither
//! clips the input's own motion. The anatomical limits are widened to the database's range, because its skeletons may
//! have been captured with bent joints.

use crate::humanoid::{Pose, Role};
use crate::math::float_funcs::{atan2, wrap_angle};
use crate::math::{Quat, Vec3, exp_map};
use crate::pose_vector::{PoseChart, PoseRow, ROW};
use std::f32::consts::PI;

/// Share of the observed range by which the limits are widened on either side.
const WIDENING: f32 = 0.1;

/// Limits or measurements of one joint, radians: swing of the bone, twist about itself, bend backwards.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Angles {
    swing: f32,
    twist: f32,
    backwards: f32,
}

/// The bone's direction in the T-pose, about which the joint's rotation is split into swing and twist.
fn bone(role: Role) -> Vec3 {
    use Role as R;
    match role {
        R::Hips | R::Spine | R::Chest | R::Neck | R::Head => Vec3::Y,
        R::LeftShoulder | R::LeftUpperArm | R::LeftLowerArm | R::LeftHand => Vec3::X,
        R::RightShoulder | R::RightUpperArm | R::RightLowerArm | R::RightHand => Vec3::NEG_X,
        R::LeftUpperLeg | R::LeftLowerLeg | R::RightUpperLeg | R::RightLowerLeg => Vec3::NEG_Y,
        R::LeftFoot | R::RightFoot | R::LeftToes | R::RightToes => Vec3::Z,
    }
}

/// Axis about which a hinge bends forwards.
fn hinge(role: Role) -> Option<Vec3> {
    match role {
        Role::LeftLowerLeg | Role::RightLowerLeg => Some(Vec3::X),
        Role::LeftLowerArm => Some(Vec3::NEG_Y),
        Role::RightLowerArm => Some(Vec3::Y),
        _ => None,
    }
}

/// Anatomical limits. They are generous: no clip of the four data sets comes near them, except where a skeleton's
/// T-pose has bent joints. `None` for the hips, which may have any orientation in the world.
fn anatomical(role: Role) -> Option<Angles> {
    use Role as R;
    let [swing, twist] = match role {
        R::Hips => return None,
        R::Spine | R::Chest => [60.0, 45.0],
        R::Neck => [70.0, 70.0],
        R::Head => [70.0, 80.0],
        R::LeftShoulder | R::RightShoulder => [60.0, 40.0],
        R::LeftUpperArm | R::RightUpperArm => [150.0, 130.0],
        R::LeftLowerArm | R::RightLowerArm => [160.0, 115.0],
        R::LeftHand | R::RightHand => [100.0, 75.0],
        R::LeftUpperLeg | R::RightUpperLeg => [150.0, 100.0],
        R::LeftLowerLeg | R::RightLowerLeg => [160.0, 90.0],
        R::LeftFoot | R::RightFoot => [90.0, 60.0],
        R::LeftToes | R::RightToes => [110.0, 40.0],
    };
    Some(Angles { swing: f32::to_radians(swing), twist: f32::to_radians(twist), backwards: f32::to_radians(12.0) })
}

/// Swing as a rotation vector, and the twist angle.
fn split(role: Role, rotation: Quat) -> (Vec3, f32) {
    let (swing, twist) = rotation.swing_twist(bone(role));
    let about = Vec3::new(twist.x, twist.y, twist.z).dot(bone(role));
    (exp_map::log(swing), wrap_angle(2.0 * atan2(about, twist.w)))
}

fn measure(role: Role, rotation: Quat) -> Angles {
    let (swing, twist) = split(role, rotation);
    let backwards = hinge(role).map_or(0.0, |axis| -swing.dot(axis));
    Angles { swing: swing.length(), twist: twist.abs(), backwards }
}

/// Angle by which a joint exceeds the anatomical limits, radians; 0 within them and for the hips.
pub fn beyond_anatomy(role: Role, rotation: Quat) -> f32 {
    let Some(limit) = anatomical(role) else { return 0.0 };
    // No angle exceeds the total rotation angle, which is at most π sin(angle / 2): a cheap test that passes most joints.
    let backwards = if hinge(role).is_some() { limit.backwards } else { PI };
    let least = limit.swing.min(limit.twist).min(backwards);
    let sine = Vec3::new(rotation.x, rotation.y, rotation.z);
    if PI * PI * sine.length_squared() < least * least {
        return 0.0;
    }
    let is = measure(role, rotation);
    (is.swing - limit.swing).max(is.twist - limit.twist).max(is.backwards - limit.backwards).max(0.0)
}

/// Nearest rotation within the limits.
fn limited(role: Role, rotation: Quat, limit: Angles) -> Quat {
    let (mut swing, twist) = split(role, rotation);
    if let Some(axis) = hinge(role) {
        swing += axis * (-limit.backwards - swing.dot(axis)).max(0.0);
    }
    let twist = twist.clamp(-limit.twist, limit.twist);
    exp_map::exp(swing.clamp_length_max(limit.swing)) * exp_map::exp(bone(role) * twist)
}

/// Joint limits of a database.
#[derive(Clone, Debug)]
pub(super) struct JointLimits {
    /// Least and greatest value of each degree of freedom that was observed, widened.
    pub(super) range: [PoseRow; 2],
    /// The same, not widened.
    observed: [PoseRow; 2],
}

impl JointLimits {
    /// From the least and greatest values observed.
    pub(super) fn new(observed: &[PoseRow; 2]) -> Self {
        let mut range = *observed;
        for d in 0..ROW {
            let margin = WIDENING * (observed[1][d] - observed[0][d]);
            range[0][d] -= margin;
            range[1][d] += margin;
        }
        Self { range, observed: *observed }
    }

    /// Limits the joints of a pose, which `row` encodes, to the ranges of anatomy, the database and the input.
    pub(super) fn apply(&self, chart: &PoseChart, row: &PoseRow, input: &PoseRow, pose: &mut Pose) {
        for role in Role::ALL {
            let rotation = &mut pose.rotations[role.index()];
            let Some(mut limit) = anatomical(role) else { continue };
            if beyond_anatomy(role, *rotation) == 0.0 {
                continue;
            }
            let mut observed = *row;
            for (d, v) in observed.iter_mut().enumerate().skip(3 * role.index()).take(3) {
                *v = v.clamp(self.observed[0][d], self.observed[1][d]);
            }
            for allowed in [&observed, input] {
                let is = measure(role, chart.rotation(role, allowed));
                limit.swing = limit.swing.max(is.swing);
                limit.twist = limit.twist.max(is.twist);
                limit.backwards = limit.backwards.max(is.backwards);
            }
            *rotation = limited(role, *rotation, limit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn pose_of(role: Role, rotation: Quat) -> (Pose, PoseRow) {
        let mut pose = Pose::default();
        pose.rotations[role.index()] = rotation;
        (pose, PoseChart::default().encode(&pose, 0.0, None, 0.1))
    }

    fn applied(role: Role, rotation: Quat, input: Quat) -> Quat {
        let (mut pose, row) = pose_of(role, rotation);
        let (_, input) = pose_of(role, input);
        JointLimits::new(&[[-0.05; ROW], [0.05; ROW]]).apply(&PoseChart::default(), &row, &input, &mut pose);
        pose.rotations[role.index()]
    }

    proptest! {
        #[test]
        fn whatever_comes_in_anatomy_comes_out(v in prop::array::uniform3(-3.0f32..3.0), role in 1usize..21) {
            let role = Role::ALL[role];
            let out = applied(role, exp_map::exp(Vec3::from_array(v)), Quat::IDENTITY);
            prop_assert!(beyond_anatomy(role, out) < 1e-3);
        }

        #[test]
        fn motion_of_the_input_is_not_clipped(v in prop::array::uniform3(-1.7f32..1.7), role in 1usize..21) {
            let rotation = exp_map::exp(Vec3::from_array(v));
            let out = applied(Role::ALL[role], rotation, rotation);
            prop_assert!(out.inv_mul(rotation).angle() < 2e-3);
        }
    }

    #[test]
    fn knees_and_elbows_bend_one_way() {
        for (role, forwards) in [
            (Role::LeftLowerLeg, Quat::from_rotation_x(2.0)),
            (Role::RightLowerLeg, Quat::from_rotation_x(2.0)),
            (Role::LeftLowerArm, Quat::from_rotation_y(-2.0)),
            (Role::RightLowerArm, Quat::from_rotation_y(2.0)),
        ] {
            assert_eq!(beyond_anatomy(role, forwards), 0.0, "{role:?}");
            let back = applied(role, forwards.inverse(), Quat::IDENTITY);
            assert!(back.angle() < 0.22, "{role:?} {}", back.angle());
        }
    }
}
