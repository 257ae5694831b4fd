//! A crowd of walkers on open ground. Each walks by the model of walk styles ([`crate::hsmm`]) in the styles of its place,
//! and avoids others. [`Performers`] perform a motion there instead.
//!
//! [`Crowd::tick`] advances by one frame of [`RATE_HZ`](crate::hsmm::RATE_HZ) and allocates nothing. Walkers decide by the
//! state before the tick, and each has its own random sequence: the same seed and the same calls give the same bits.

mod errand;
mod field;
mod grid;
mod limits;
mod member;
mod performers;
mod performing;
mod route;
mod seen;
mod steering;

pub use field::Vertex;
pub use limits::{CrowdError, FARTHEST, INTENSITY, LONGEST_BONE, MAX_COUNT, MAX_ROUTE_POINTS, MAX_VERTICES, REACH};
pub use performers::Performers;
pub use performing::TICK_HZ;
pub use seen::{JOINT_FLOATS, WALKER_FLOATS};

use crate::hsmm::RuntimeWalkModel;
use crate::humanoid::{Pose, Proportions};
use errand::{Ground, ROOM};
use field::Field;
use grid::{Grid, Others};
use member::Member;
use route::Route;
use seen::{check_bones, write_shares, write_world};
use std::f32::consts::PI;
use std::sync::Arc;
use steering::Figure;

/// Least radius of the ground, metres: a walker that turns as much as a foot can walks a circle of four to six metres.
const LEAST_RADIUS: f32 = 8.0;

/// Initial parameters of a crowd.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Number of walkers: 1 to [`MAX_COUNT`].
    pub count: usize,
    /// Random seed; walker number i depends on it and on i, not on the count.
    pub seed: u32,
}

/// A crowd of walkers.
#[derive(Clone, Debug)]
pub struct Crowd {
    model: Arc<RuntimeWalkModel>,
    seed: u32,
    field: Field,
    route: Route,
    members: Vec<Member>,
    /// State of every walker before the tick.
    figures: Vec<Figure>,
    grid: Grid,
    /// Buffer for the neighbours of one member.
    near: Vec<Figure>,
    /// One per walker and style: the weights, and the same as bytes (see [`Crowd::weights`]).
    weights: Vec<f32>,
    shares: Vec<u8>,
    /// Bones of the joints of `world`.
    bones: Proportions,
    world: Vec<f32>,
}

impl Crowd {
    /// Creates walkers in the average of all styles, evenly spread over the ground, each at a random phase of its stride.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn new(model: Arc<RuntimeWalkModel>, options: Options) -> Result<Self, CrowdError> {
        let mut crowd = Self {
            bones: *model.proportions(),
            model,
            seed: options.seed,
            field: Field::default(),
            route: Route::default(),
            members: Vec::new(),
            figures: Vec::new(),
            grid: Grid::default(),
            near: Vec::with_capacity(MAX_COUNT),
            weights: Vec::new(),
            shares: Vec::new(),
            world: Vec::new(),
        };
        crowd.set_count(options.count)?;
        Ok(crowd)
    }

    /// Number of walkers.
    pub fn count(&self) -> usize {
        self.members.len()
    }

    /// Radius of the ground about the origin, metres: no walker goes farther than 1.2 times this. It grows with the count.
    pub fn radius(&self) -> f32 {
        radius_of(self.count())
    }

    /// Joints of all walkers after the last tick: [`WALKER_FLOATS`] numbers a walker.
    pub fn world(&self) -> &[f32] {
        &self.world
    }

    /// Weights of the styles, 0 to 255: one number per walker and style of the model. Weights outside 0 to 1 are clamped; the
    /// remainder to 255 is the average walk.
    pub fn weights(&self) -> &[u8] {
        &self.shares
    }

    /// Sets the number of walkers: new ones begin at the edge of the ground, and the last ones are removed.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn set_count(&mut self, count: usize) -> Result<(), CrowdError> {
        if !(1..=MAX_COUNT).contains(&count) {
            return Err(CrowdError::Count(count));
        }
        let styles = self.model.styles();
        self.weights.resize(count * styles, 0.0);
        self.members.truncate(count);
        for index in self.members.len()..count {
            let weights = &mut self.weights[index * styles..][..styles];
            self.members.push(Member::new(&self.model, self.seed, index, &self.field, weights));
        }
        self.shares.resize(count * styles, 0);
        self.world.resize(count * WALKER_FLOATS, 0.0);
        self.show();
        Ok(())
    }

    /// Sets the styles by place, from each walker's next step on; new walkers begin with them.
    ///
    /// # Errors
    /// If there are too many vertices, or one is invalid.
    pub fn set_field(&mut self, vertices: &[Vertex]) -> Result<(), CrowdError> {
        self.field = Field::new(vertices, self.model.styles())?;
        Ok(())
    }

    /// Sets a route through points [x, z] that all walkers follow from their next step on: a loop if its ends meet, else back
    /// and forth. An empty route releases them.
    ///
    /// # Errors
    /// If there is one point, or too many, or one is invalid.
    pub fn set_route(&mut self, points: &[[f32; 2]]) -> Result<(), CrowdError> {
        self.route = Route::new(points)?;
        Ok(())
    }

    /// Sets the bones of the joints of [`Crowd::world`], in place of the model's own. A different body's feet stay planted if
    /// its bones from the hips down are the model's. The bones do not change how walkers move.
    ///
    /// # Errors
    /// See [`CrowdError::Bone`].
    pub fn set_bones(&mut self, bones: Proportions) -> Result<(), CrowdError> {
        check_bones(&bones)?;
        self.bones = bones;
        self.show();
        Ok(())
    }

    /// Advances by a frame.
    pub fn tick(&mut self) {
        let Self { model, field, route, members, figures, grid, near, weights, .. } = self;
        let ground = Ground { radius: radius_of(members.len()), count: members.len(), field, route };
        grid.sort(figures.iter().map(|figure| figure.at));
        let styles = model.styles();
        for (index, member) in members.iter_mut().enumerate() {
            let weights = &mut weights[index * styles..][..styles];
            let mut others = Others { grid, figures, of: index, found: near };
            member.tick(&ground, &mut others, weights);
        }
        self.show();
    }

    /// Returns the next frames of a walker as if it were alone; `None` if the index is out of range.
    pub fn ahead(&self, index: usize, frames: usize) -> Option<Vec<Pose>> {
        let mut member = self.members.get(index)?.clone();
        let styles = self.model.styles();
        let mut weights = self.weights[index * styles..][..styles].to_vec();
        let ground = Ground { radius: self.radius(), count: self.count(), field: &self.field, route: &self.route };
        let (grid, mut found) = (Grid::default(), Vec::new());
        let mut others = Others { grid: &grid, figures: &[], of: 0, found: &mut found };
        let next = (0..frames).map(|_| {
            member.tick(&ground, &mut others, &mut weights);
            *member.walker.pose()
        });
        Some(next.collect())
    }

    /// Updates the published state of every walker.
    fn show(&mut self) {
        self.figures.clear();
        self.figures.extend(self.members.iter().map(Member::figure));
        write_shares(&self.weights, &mut self.shares);
        for (member, floats) in self.members.iter().zip(self.world.as_chunks_mut::<WALKER_FLOATS>().0) {
            write_world(member.walker.world(), &self.bones, floats);
        }
    }
}

/// Radius of the ground for a number of walkers, metres.
fn radius_of(count: usize) -> f32 {
    (ROOM * count as f32 / PI).sqrt().max(LEAST_RADIUS)
}

#[cfg(test)]
mod tests;
