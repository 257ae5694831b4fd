//! A crowd that performs one motion on open ground, each performer in the styles of its place.
//!
//! The predictions for each style come from [`transfer`](crate::transfer), so the styles are those of a database. Each
//! performer begins at a different frame of the motion, has the tempo of its styles, and loops. If the motion travels, the
//! performer is turned on the planted foot, by no more than walkers are: towards its own goals, away from others and from the
//! edge.

use super::errand::Ground;
use super::field::{Field, Vertex};
use super::grid::{Grid, Others};
use super::limits::{CrowdError, MAX_COUNT};
use super::performing::Performing;
use super::route::Route;
use super::seen::{WALKER_FLOATS, check_bones, write_shares, write_world};
use super::steering::Figure;
use super::{Options, radius_of};
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::Soles;
use crate::transfer::Predictions;
use std::sync::Arc;

/// A crowd of performers.
#[derive(Clone, Debug)]
pub struct Performers {
    predictions: Arc<Predictions>,
    soles: Soles,
    seed: u32,
    field: Field,
    route: Route,
    members: Vec<Performing>,
    /// State of every performer before the tick.
    figures: Vec<Figure>,
    grid: Grid,
    /// Buffer for the neighbours of one member.
    near: Vec<Figure>,
    /// One per performer and style: the weights, and the same as bytes (see [`Performers::weights`]).
    weights: Vec<f32>,
    shares: Vec<u8>,
    /// Bones of the joints of `world`.
    bones: Proportions,
    world: Vec<f32>,
}

impl Performers {
    /// Creates performers in the neutral style, evenly spread over the ground, each at a different frame of the motion.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn new(predictions: Arc<Predictions>, options: Options) -> Result<Self, CrowdError> {
        let mut performers = Self {
            soles: Soles::new(predictions.proportions()),
            bones: *predictions.proportions(),
            predictions,
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
        performers.set_count(options.count)?;
        Ok(performers)
    }

    /// Number of performers.
    pub fn count(&self) -> usize {
        self.members.len()
    }

    /// Radius of the ground, metres, about the origin; see [`Crowd::radius`](super::Crowd::radius).
    pub fn radius(&self) -> f32 {
        radius_of(self.count())
    }

    /// Predictions of the motion that they perform.
    pub fn predictions(&self) -> &Predictions {
        &self.predictions
    }

    /// Joints of all performers after the last tick: [`WALKER_FLOATS`] numbers each.
    pub fn world(&self) -> &[f32] {
        &self.world
    }

    /// Weights of the styles, 0 to 255: one number per performer and style of the database. Weights outside 0 to 1 are
    /// clamped; the remainder to 255 is the neutral style.
    pub fn weights(&self) -> &[u8] {
        &self.shares
    }

    /// Sets the number of performers: new ones begin at the edge of the ground, and the last ones are removed.
    ///
    /// # Errors
    /// See [`CrowdError::Count`].
    pub fn set_count(&mut self, count: usize) -> Result<(), CrowdError> {
        if !(1..=MAX_COUNT).contains(&count) {
            return Err(CrowdError::Count(count));
        }
        let styles = self.predictions.styles();
        self.weights.resize(count * styles, 0.0);
        self.members.truncate(count);
        let ground = Ground { radius: radius_of(count), count, field: &self.field, route: &self.route };
        for index in self.members.len()..count {
            let weights = &mut self.weights[index * styles..][..styles];
            self.members.push(Performing::new(&self.predictions, self.seed, index, &ground, weights));
        }
        self.shares.resize(count * styles, 0);
        self.world.resize(count * WALKER_FLOATS, 0.0);
        self.show();
        Ok(())
    }

    /// Sets the styles by place, from the next tick on: performers reach them within half a second, and new ones begin with
    /// them.
    ///
    /// # Errors
    /// If there are too many vertices, or one is invalid.
    pub fn set_field(&mut self, vertices: &[Vertex]) -> Result<(), CrowdError> {
        self.field = Field::new(vertices, self.predictions.styles())?;
        Ok(())
    }

    /// Sets a route that performers of a travelling motion follow; see [`Crowd::set_route`](super::Crowd::set_route).
    ///
    /// # Errors
    /// If there is one point, or too many, or one is invalid.
    pub fn set_route(&mut self, points: &[[f32; 2]]) -> Result<(), CrowdError> {
        self.route = Route::new(points)?;
        Ok(())
    }

    /// Sets the bones of the joints of [`Performers::world`], in place of the database's; see
    /// [`Crowd::set_bones`](super::Crowd::set_bones).
    ///
    /// # Errors
    /// See [`CrowdError::Bone`].
    pub fn set_bones(&mut self, bones: Proportions) -> Result<(), CrowdError> {
        check_bones(&bones)?;
        self.bones = bones;
        self.show();
        Ok(())
    }

    /// Advances by 1 / [`TICK_HZ`](super::TICK_HZ). Allocates nothing.
    pub fn tick(&mut self) {
        let Self { predictions, soles, field, route, members, figures, grid, near, weights, .. } = self;
        let ground = Ground { radius: radius_of(members.len()), count: members.len(), field, route };
        grid.sort(figures.iter().map(|figure| figure.at));
        let styles = predictions.styles();
        for (index, member) in members.iter_mut().enumerate() {
            let weights = &mut weights[index * styles..][..styles];
            let mut others = Others { grid, figures, of: index, found: near };
            member.tick(soles, predictions.proportions(), &ground, &mut others, weights);
        }
        self.show();
    }

    /// Returns the next ticks of a performer as if it were alone; `None` if the index is out of range.
    pub fn ahead(&self, index: usize, ticks: usize) -> Option<Vec<Pose>> {
        let mut member = self.members.get(index)?.clone();
        let styles = self.predictions.styles();
        let mut weights = self.weights[index * styles..][..styles].to_vec();
        let ground = Ground { radius: self.radius(), count: self.count(), field: &self.field, route: &self.route };
        let (grid, mut found) = (Grid::default(), Vec::new());
        let mut others = Others { grid: &grid, figures: &[], of: 0, found: &mut found };
        let next = (0..ticks).map(|_| {
            member.tick(&self.soles, self.predictions.proportions(), &ground, &mut others, &mut weights);
            *member.pose()
        });
        Some(next.collect())
    }

    /// Updates the published state of every performer.
    fn show(&mut self) {
        self.figures.clear();
        self.figures.extend(self.members.iter().map(Performing::figure));
        write_shares(&self.weights, &mut self.shares);
        for (member, floats) in self.members.iter().zip(self.world.as_chunks_mut::<WALKER_FLOATS>().0) {
            write_world(*member.world(), &self.bones, floats);
        }
    }
}

#[cfg(test)]
mod tests;
