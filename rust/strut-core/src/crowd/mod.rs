//! A crowd on open ground. Each agent moves in the styles of its place and avoids others. [`Walkers`] walk by the model of walk
//! styles ([`crate::hsmm`]); [`Performers`] perform a motion.
//!
//! [`Crowd::tick`] advances by one frame of [`TICK_HZ`] and allocates nothing. Agents decide by the state before the tick, and
//! each has its own random sequence: the same seed and the same calls give the same bits.

mod agent;
mod errand;
mod field;
mod grid;
mod limits;
mod performing;
mod route;
mod seen;
mod steering;
mod walking;

pub use agent::Agent;
pub use field::Vertex;
pub use limits::{CrowdError, FARTHEST, INTENSITY, LONGEST_BONE, MAX_COUNT, MAX_ROUTE_POINTS, MAX_VERTICES, REACH};
pub use performing::{Performing, TICK_HZ};
pub use seen::{JOINT_FLOATS, WALKER_FLOATS};
pub use walking::Walking;

use crate::hsmm::RuntimeWalkModel;
use crate::humanoid::{Pose, Proportions};
use crate::transfer::Predictions;
use errand::{Ground, ROOM};
use field::Field;
use grid::{Grid, Others};
use performing::PerformedMotion;
use route::Route;
use seen::{check_bones, write_shares, write_world};
use std::f32::consts::PI;
use std::sync::Arc;
use steering::AgentState;

/// Least radius of the ground, metres: a walker that turns as much as a foot can walks a circle of four to six metres.
const LEAST_RADIUS: f32 = 8.0;

/// Initial parameters of a crowd.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Number of agents: 1 to [`MAX_COUNT`].
    pub count: usize,
    /// Random seed; agent number i depends on it and on i, not on the count.
    pub seed: u32,
}

/// A crowd of agents of one kind: [`Walkers`] or [`Performers`].
#[derive(Clone, Debug)]
pub struct Crowd<A: Agent> {
    shared: A::Shared,
    seed: u32,
    field: Field,
    route: Route,
    agents: Vec<A>,
    /// State of every agent before the tick.
    states: Vec<AgentState>,
    grid: Grid,
    /// Buffer for the neighbours of one agent.
    near: Vec<AgentState>,
    /// One per agent and style: the weights, and the same as bytes (see [`Crowd::weights`]).
    weights: Vec<f32>,
    shares: Vec<u8>,
    /// Bones of the joints of `world`.
    bones: Proportions,
    world: Vec<f32>,
}

/// A crowd of walkers. Each walks by the model of walk styles.
pub type Walkers = Crowd<Walking>;

impl Walkers {
    /// Creates walkers in the average of all styles, evenly spread over the ground, each at a random phase of its stride.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn new(model: Arc<RuntimeWalkModel>, options: Options) -> Result<Self, CrowdError> {
        Self::of_agents(model, options)
    }
}

/// A crowd that performs one motion, for which styles are predicted by [`transfer`](crate::transfer). Each performer begins at
/// a different frame of the motion, has the tempo of its styles, and loops. If the motion travels, the performer is turned on
/// the planted foot, by no more than walkers are: towards its own goals, away from others and from the edge.
pub type Performers = Crowd<Performing>;

impl Performers {
    /// Creates performers in the neutral style, evenly spread over the ground, each at a different frame of the motion.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn new(predictions: Arc<Predictions>, options: Options) -> Result<Self, CrowdError> {
        Self::of_agents(PerformedMotion::new(predictions), options)
    }

    /// Predictions of the motion that they perform.
    pub fn predictions(&self) -> &Predictions {
        &self.shared.predictions
    }
}

impl<A: Agent> Crowd<A> {
    fn of_agents(shared: A::Shared, options: Options) -> Result<Self, CrowdError> {
        let mut crowd = Self {
            bones: *A::proportions(&shared),
            shared,
            seed: options.seed,
            field: Field::default(),
            route: Route::default(),
            agents: Vec::new(),
            states: Vec::new(),
            grid: Grid::default(),
            near: Vec::with_capacity(MAX_COUNT),
            weights: Vec::new(),
            shares: Vec::new(),
            world: Vec::new(),
        };
        crowd.set_count(options.count)?;
        Ok(crowd)
    }

    /// Number of agents.
    pub fn count(&self) -> usize {
        self.agents.len()
    }

    /// Radius of the ground about the origin, metres: no agent goes farther than 1.2 times this. It grows with the count.
    pub fn radius(&self) -> f32 {
        radius_of(self.count())
    }

    /// Joints of all agents after the last tick: [`WALKER_FLOATS`] numbers an agent.
    pub fn world(&self) -> &[f32] {
        &self.world
    }

    /// Weights of the styles, 0 to 255: one number per agent and style. Weights outside 0 to 1 are clamped; the remainder to
    /// 255 is the average walk, or the neutral style of performers.
    pub fn weights(&self) -> &[u8] {
        &self.shares
    }

    /// Sets the number of agents: new ones begin at the edge of the ground, and the last ones are removed.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn set_count(&mut self, count: usize) -> Result<(), CrowdError> {
        if !(1..=MAX_COUNT).contains(&count) {
            return Err(CrowdError::Count(count));
        }
        let styles = A::styles(&self.shared);
        self.weights.resize(count * styles, 0.0);
        self.agents.truncate(count);
        let ground = Ground { radius: radius_of(count), count, field: &self.field, route: &self.route };
        for index in self.agents.len()..count {
            let weights = &mut self.weights[index * styles..][..styles];
            self.agents.push(A::new(&self.shared, self.seed, index, &ground, weights));
        }
        self.shares.resize(count * styles, 0);
        self.world.resize(count * WALKER_FLOATS, 0.0);
        self.publish();
        Ok(())
    }

    /// Sets the styles by place. Walkers take them from their next step on, performers within half a second; new agents begin
    /// with them.
    ///
    /// # Errors
    /// If there are too many vertices, or one is invalid.
    pub fn set_field(&mut self, vertices: &[Vertex]) -> Result<(), CrowdError> {
        self.field = Field::new(vertices, A::styles(&self.shared))?;
        Ok(())
    }

    /// Sets a route through points [x, z] that all agents follow from their next step on, unless they perform a motion in
    /// place: a loop if its ends meet, else back and forth. An empty route releases them.
    ///
    /// # Errors
    /// If there is one point, or too many, or one is invalid.
    pub fn set_route(&mut self, points: &[[f32; 2]]) -> Result<(), CrowdError> {
        self.route = Route::new(points)?;
        Ok(())
    }

    /// Sets the bones of the joints of [`Crowd::world`], in place of the agents' own. A different body's feet stay planted if
    /// its bones from the hips down are the agents'. The bones do not change how agents move.
    ///
    /// # Errors
    /// See [`CrowdError::Bone`].
    pub fn set_bones(&mut self, bones: Proportions) -> Result<(), CrowdError> {
        check_bones(&bones)?;
        self.bones = bones;
        self.publish();
        Ok(())
    }

    /// Advances by a frame. Allocates nothing.
    pub fn tick(&mut self) {
        let Self { shared, field, route, agents, states, grid, near, weights, .. } = self;
        let ground = Ground { radius: radius_of(agents.len()), count: agents.len(), field, route };
        grid.sort(states.iter().map(|state| state.at));
        let styles = A::styles(shared);
        for (index, agent) in agents.iter_mut().enumerate() {
            let weights = &mut weights[index * styles..][..styles];
            let mut others = Others { grid, states, of: index, found: near };
            agent.tick(shared, &ground, &mut others, weights);
        }
        self.publish();
    }

    /// Returns the next frames of an agent as if it were alone; `None` if the index is out of range.
    pub fn ahead(&self, index: usize, frames: usize) -> Option<Vec<Pose>> {
        let mut agent = self.agents.get(index)?.clone();
        let styles = A::styles(&self.shared);
        let mut weights = self.weights[index * styles..][..styles].to_vec();
        let ground = Ground { radius: self.radius(), count: self.count(), field: &self.field, route: &self.route };
        let (grid, mut found) = (Grid::default(), Vec::new());
        let mut others = Others { grid: &grid, states: &[], of: 0, found: &mut found };
        let next = (0..frames).map(|_| {
            agent.tick(&self.shared, &ground, &mut others, &mut weights);
            *agent.pose()
        });
        Some(next.collect())
    }

    /// Updates the published state of every agent.
    fn publish(&mut self) {
        self.states.clear();
        self.states.extend(self.agents.iter().map(A::state));
        write_shares(&self.weights, &mut self.shares);
        for (agent, floats) in self.agents.iter().zip(self.world.as_chunks_mut::<WALKER_FLOATS>().0) {
            write_world(agent.world(), &self.bones, floats);
        }
    }
}

/// Radius of the ground for a number of agents, metres.
fn radius_of(count: usize) -> f32 {
    (ROOM * count as f32 / PI).sqrt().max(LEAST_RADIUS)
}

#[cfg(test)]
mod tests;
