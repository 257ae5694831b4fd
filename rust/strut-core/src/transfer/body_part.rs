//! Parts of the body that can have different styles: every degree of freedom has its own model.

use crate::humanoid::Role;
use crate::pose_vector::{HIP_HEIGHT, ROW};

/// A part of the body, as a set of degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyPart {
    /// Neck and head.
    Head,
    /// Spine and chest.
    Torso,
    /// Left shoulder to hand.
    LeftArm,
    /// Right shoulder to hand.
    RightArm,
    /// Both legs with the pelvis, its height and velocity, and the timing: together they are the gait.
    Legs,
}

/// Number of body parts.
pub const PARTS: usize = 5;

impl BodyPart {
    /// All parts, in the order of their numbers.
    pub const ALL: [Self; PARTS] = [Self::Head, Self::Torso, Self::LeftArm, Self::RightArm, Self::Legs];

    /// Name of the part. [`BodyPart::from_name`] maps it to this part only.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Head => "head",
            Self::Torso => "torso",
            Self::LeftArm => "left_arm",
            Self::RightArm => "right_arm",
            Self::Legs => "legs",
        }
    }

    /// Parts of a name: `head`, `torso`, `left_arm`, `right_arm`, `arms`, `legs`.
    pub fn from_name(name: &str) -> Option<&'static [Self]> {
        match name {
            "head" => Some(&[Self::Head]),
            "torso" => Some(&[Self::Torso]),
            "left_arm" => Some(&[Self::LeftArm]),
            "right_arm" => Some(&[Self::RightArm]),
            "arms" => Some(&[Self::LeftArm, Self::RightArm]),
            "legs" => Some(&[Self::Legs]),
            _ => None,
        }
    }

    /// Part to which a joint belongs.
    pub const fn of(role: Role) -> Self {
        match role {
            Role::Neck | Role::Head => Self::Head,
            Role::Spine | Role::Chest => Self::Torso,
            Role::LeftShoulder | Role::LeftUpperArm | Role::LeftLowerArm | Role::LeftHand => Self::LeftArm,
            Role::RightShoulder | Role::RightUpperArm | Role::RightLowerArm | Role::RightHand => Self::RightArm,
            _ => Self::Legs,
        }
    }

    /// Part of each degree of freedom of a row. Root motion belongs to the legs.
    pub fn of_row() -> [Self; ROW] {
        std::array::from_fn(|d| if d < HIP_HEIGHT { Self::of(Role::ALL[d / 3]) } else { Self::Legs })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_has_degrees_of_freedom_and_its_number() {
        for (i, part) in BodyPart::ALL.into_iter().enumerate() {
            assert_eq!(part as usize, i);
            assert_eq!(BodyPart::from_name(part.name()), Some(&[part][..]));
            assert!(BodyPart::of_row().contains(&part));
        }
    }
}
