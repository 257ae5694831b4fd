//! Retargeting from a file's skeleton to the canonical humanoid and back (`docs/methods/mar.md` §2).
//!
//! A [`Binding`] holds, once per skeleton, the joint of each role, every joint's rotation in the T-pose, and the body's
//! size. World rotations by role then transfer exactly; limb inverse kinematics keeps feet and hands at their places, as
//! in Monzani et al. 2000, which the paper uses. [`ToHumanoid`] and [`FromHumanoid`] work frame by frame without allocation;
//! [`to_humanoid()`] and [`from_humanoid()`] convert whole clips.

mod anatomy;
mod axes;
mod between_bodies;
mod binding;
mod body_tree;
mod find_roles;
mod floor;
mod from_humanoid;
mod loose_feet;
mod names;
mod read;
mod read_as;
mod rest_pose;
mod sample;
mod scale;
mod stance;
mod to_humanoid;

pub use anatomy::FourLegs;
pub use axes::UpAxis;
pub use between_bodies::{BetweenBodies, between_bodies};
pub use binding::{BindError, Binding, CharacterFacts};
pub use from_humanoid::{FromHumanoid, from_humanoid};
pub use loose_feet::{LooseFoot, loose_feet};
pub use read_as::ReadAs;
pub use stance::SolePoint;
pub use to_humanoid::{ToHumanoid, to_humanoid};

#[cfg(test)]
mod tests;
