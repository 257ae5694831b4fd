//! Many who perform one motion on open ground, each in the styles of the place where they are.
//!
//! What is predicted for each style comes from [`transfer`](crate::transfer), so that the styles are those of a database; each
//! begins elsewhere in the motion, keeps the tempo of their styles, and begins it anew at its end. Whoever goes somewhere by it
//! is turned on the foot that stands, by no more than walkers are: towards places of their own, away from others and from the
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

/// A crowd who perform.
#[derive(Clone, Debug)]
pub struct Performers {
    predictions: Arc<Predictions>,
    soles: Soles,
    seed: u32,
    field: Field,
    route: Route,
    members: Vec<Performing>,
    /// Everybody as they were before the tick.
    figures: Vec<Figure>,
    grid: Grid,
    /// Buffer for the neighbours of one member.
    near: Vec<Figure>,
    /// One a performer and style: the weights, and their part from 0 to 1 in 255ths.
    weights: Vec<f32>,
    shares: Vec<u8>,
    /// What the joints of `world` lie on.
    bones: Proportions,
    world: Vec<f32>,
}

impl Performers {
    /// People in the neutral style, evenly spread over the ground, each somewhere else in the motion.
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

    /// People.
    pub fn count(&self) -> usize {
        self.members.len()
    }

    /// Radius of the ground, metres, about the origin; see [`Crowd::radius`](super::Crowd::radius).
    pub fn radius(&self) -> f32 {
        radius_of(self.count())
    }

    /// What they perform.
    pub fn predictions(&self) -> &Predictions {
        &self.predictions
    }

    /// Everybody's joints after the last tick: [`WALKER_FLOATS`] numbers each.
    pub fn world(&self) -> &[f32] {
        &self.world
    }

    /// How much of every style everybody performs in, 0 to 255: one number a performer and style of the database. Weights beyond
    /// 0 and 1 are taken for these; what is missing to 255 is the neutral style.
    pub fn weights(&self) -> &[u8] {
        &self.shares
    }

    /// More people, who begin at the edge of the ground, or fewer: the last ones go.
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

    /// Styles by place, from the next tick on: everybody goes over to them within half a second. Who is still to come begins
    /// with them.
    ///
    /// # Errors
    /// If there are too many vertices, or one is none.
    pub fn set_field(&mut self, vertices: &[Vertex]) -> Result<(), CrowdError> {
        self.field = Field::new(vertices, self.predictions.styles())?;
        Ok(())
    }

    /// A way that everybody follows who goes somewhere; see [`Crowd::set_route`](super::Crowd::set_route).
    ///
    /// # Errors
    /// If there is one point, or too many, or one is none.
    pub fn set_route(&mut self, points: &[[f32; 2]]) -> Result<(), CrowdError> {
        self.route = Route::new(points)?;
        Ok(())
    }

    /// Bones that the joints of [`Performers::world`] lie on, in place of the database's; see
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

    /// Goes on by 1 / [`TICK_HZ`](super::TICK_HZ). Allocates nothing.
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

    /// The next ticks of somebody as if nobody else were there; none if there is nobody of this number.
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

    /// Takes down what is seen of everybody.
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
