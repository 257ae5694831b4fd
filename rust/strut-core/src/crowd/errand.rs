//! Start place and goals of an agent.

use super::field::Field;
use super::route::Route;
use super::steering::facing;
use crate::math::Vec2;
use crate::math::random::SplitMix64;
use std::f32::consts::{PI, TAU};

/// Area of the ground per agent, m².
pub(super) const ROOM: f32 = 4.0;
/// Area per agent at the start, m²: less, so that agents start away from the edge.
const STARTING_ROOM: f32 = 3.0;
/// The golden angle, radians: places along a spiral by it are evenly spread (Vogel, "A better way to construct the sunflower
/// head", 1979).
const GOLDEN_ANGLE: f32 = 2.399_963_2;
/// Largest random offset from that place along either axis, metres.
const SCATTER: f32 = 0.3;
/// Agents that start farther than this from the centre start walking inward, metres.
const RETURN_RADIUS: f32 = 4.0;

/// Share of a wandering turn that remains a step later, and the largest random turn that is added, radians.
const WANDER_REMAINS: f32 = 0.8;
const WANDER: f32 = 0.16;
/// Range of a goal's distance from the centre, in radii of the ground: paths between goals all over it would lead through the
/// centre more often than not.
const GOALS: [f32; 2] = [0.6, 1.0];
/// A goal is reached within this distance, metres, and abandoned after this many steps: an agent that turns as much as a foot
/// can may circle round it.
const REACHED: f32 = 2.5;
const PATIENCE: u32 = 40;

/// The ground, its field and its route.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'a> {
    /// Radius, metres.
    pub(super) radius: f32,
    /// Number of agents on it.
    pub(super) count: usize,
    pub(super) field: &'a Field,
    pub(super) route: &'a Route,
}

/// Start place of an agent, and its random state.
#[derive(Clone, Debug)]
pub(super) struct Start {
    pub(super) at: Vec2,
    /// Distance of the place along the spiral from the centre, metres.
    from_middle: f32,
    pub(super) random: SplitMix64,
}

impl Start {
    /// Start of agent number `index` of the crowd of a seed.
    pub(super) fn new(seed: u32, index: usize) -> Self {
        let mut random = SplitMix64::new(u64::from(seed) << 32 ^ index as u64);
        let turned = TAU * SplitMix64::new(u64::from(seed)).share();
        let from_middle = (STARTING_ROOM / PI * (index as f32 + 0.5)).sqrt();
        let scatter = [(); 2].map(|()| SCATTER * (2.0 * random.share() - 1.0));
        let at = from_middle * facing(turned + index as f32 * GOLDEN_ANGLE) + Vec2::from(scatter);
        Self { at, from_middle, random }
    }

    /// Returns a random heading, radians: inward if the place is far out.
    pub(super) fn heading(&mut self) -> f32 {
        let heading = PI * (2.0 * self.random.share() - 1.0);
        let leaves = facing(heading).dot(self.at) > 0.0 && self.from_middle > RETURN_RADIUS;
        if leaves { heading + PI } else { heading }
    }
}

/// Random goals, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Errand {
    /// Wandering turn of a step, radians.
    wander: f32,
    /// Current goal, in radii of the ground from its centre, and the steps since it was set.
    goal: Vec2,
    gone: u32,
    /// Lane beside a route, 0 to 1.
    lane: f32,
}

impl Errand {
    pub(super) fn new(random: &mut SplitMix64) -> Self {
        Self { lane: random.share(), goal: goal(random), wander: 0.0, gone: 0 }
    }

    /// Returns the wandering turn, radians, and the place to go to, for the step that begins at a place.
    pub(super) fn next(&mut self, at: Vec2, facing: Vec2, ground: &Ground, random: &mut SplitMix64) -> (f32, Vec2) {
        self.wander = WANDER_REMAINS * self.wander + WANDER * (2.0 * random.share() - 1.0);
        self.gone += 1;
        if self.gone > PATIENCE || at.distance(ground.radius * self.goal) < REACHED {
            (self.goal, self.gone) = (goal(random), 0);
        }
        let on_route = ground.route.target(at, facing, self.lane, ground.count);
        (self.wander, on_route.unwrap_or(ground.radius * self.goal))
    }
}

/// A random goal, evenly distributed over a ring, in radii of the ground from its centre.
fn goal(random: &mut SplitMix64) -> Vec2 {
    let [least, greatest] = GOALS.map(|radius| radius * radius);
    (least + (greatest - least) * random.share()).sqrt() * facing(TAU * random.share())
}
