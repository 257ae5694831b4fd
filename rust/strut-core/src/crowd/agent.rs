//! What the agents of a crowd have in common.

use super::errand::Ground;
use super::grid::Others;
use super::steering::AgentState;
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::WorldPose;
use std::fmt::Debug;

/// An agent of a [`Crowd`](super::Crowd).
pub trait Agent: Clone + Debug {
    /// What all agents of a crowd share.
    type Shared: Clone + Debug;

    /// Number of styles.
    fn styles(shared: &Self::Shared) -> usize;

    /// Bones of the agents.
    fn proportions(shared: &Self::Shared) -> &Proportions;

    /// Creates agent number `index` of the crowd of a seed; writes its weights.
    fn new(shared: &Self::Shared, seed: u32, index: usize, ground: &Ground, weights: &mut [f32]) -> Self;

    /// Advances by a frame among others; updates the agent's weights.
    fn tick(&mut self, shared: &Self::Shared, ground: &Ground, others: &mut Others, weights: &mut [f32]);

    /// State as seen by other agents.
    fn state(&self) -> AgentState;

    /// Pose on the ground.
    fn pose(&self) -> &Pose;

    /// World transforms of the joints.
    fn world(&self) -> WorldPose;
}
