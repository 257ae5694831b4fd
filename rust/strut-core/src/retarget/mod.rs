//! From a file's skeleton to the canonical humanoid and back (specification §2).
//!
//! A [`Binding`] says once per skeleton which joint plays which role, how every joint is turned in the
//! T-pose, and how long the body is. World rotations by role then carry over exactly; limb inverse
//! kinematics keeps feet where they stood and hands where they reached, as the paper does through
//! Monzani et al. 2000. [`ToHumanoid`] and [`FromHumanoid`] work frame by frame without allocation;
//! [`to_humanoid`] and [`from_humanoid`] convert whole clips.

mod between_bodies;
mod binding;
mod find_roles;
mod from_humanoid;
mod names;
mod rest_pose;
mod sample;
mod scale;
mod to_humanoid;

pub use between_bodies::between_bodies;
pub use binding::{BindError, Binding};
pub use from_humanoid::{FromHumanoid, from_humanoid};
pub use to_humanoid::{ToHumanoid, to_humanoid};

#[cfg(test)]
mod tests;
