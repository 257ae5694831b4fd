//! Where one of the crowd begins, and where they go.

use super::field::Field;
use super::route::Route;
use super::steering::facing;
use crate::math::Vec2;
use crate::math::random::SplitMix64;
use std::f32::consts::{PI, TAU};

/// Ground for everybody, m².
pub(super) const ROOM: f32 = 4.0;
/// The same where they begin: away from the edge.
const STARTING_ROOM: f32 = 3.0;
/// The golden angle, radians: places along a spiral by it are evenly spread (Vogel, "A better way to construct the sunflower
/// head", 1979).
const GOLDEN_ANGLE: f32 = 2.399_963_2;
/// How far from there somebody begins at most along either axis, metres.
const SCATTER: f32 = 0.3;
/// Farther from the middle everybody begins on a way back, metres.
const HOME: f32 = 4.0;

/// Share of a wandering turn that remains a step later, and the greatest that is added, radians.
const WANDER_REMAINS: f32 = 0.8;
const WANDER: f32 = 0.16;
/// Goals are so far from the middle, in radii of the ground: ways between places all over it would lead through the middle more
/// often than not.
const GOALS: [f32; 2] = [0.6, 1.0];
/// A goal is reached within this, metres, and given up after so many steps: who turns as much as a foot can may walk round it.
const REACHED: f32 = 2.5;
const PATIENCE: u32 = 40;

/// What there is beside the others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'a> {
    /// Metres.
    pub(super) radius: f32,
    /// People on it.
    pub(super) count: usize,
    pub(super) field: &'a Field,
    pub(super) route: &'a Route,
}

/// Where somebody begins, and what they draw by lot from then on.
#[derive(Clone, Debug)]
pub(super) struct Start {
    pub(super) at: Vec2,
    /// Distance of the place along the spiral from the middle, metres.
    from_middle: f32,
    pub(super) random: SplitMix64,
}

impl Start {
    /// Number `index` of the crowd of a seed.
    pub(super) fn new(seed: u32, index: usize) -> Self {
        let mut random = SplitMix64::new(u64::from(seed) << 32 ^ index as u64);
        let turned = TAU * SplitMix64::new(u64::from(seed)).share();
        let from_middle = (STARTING_ROOM / PI * (index as f32 + 0.5)).sqrt();
        let scatter = [(); 2].map(|()| SCATTER * (2.0 * random.share() - 1.0));
        let at = from_middle * facing(turned + index as f32 * GOLDEN_ANGLE) + Vec2::from(scatter);
        Self { at, from_middle, random }
    }

    /// Draws where they face, radians: inward where they are far out.
    pub(super) fn heading(&mut self) -> f32 {
        let heading = PI * (2.0 * self.random.share() - 1.0);
        let leaves = facing(heading).dot(self.at) > 0.0 && self.from_middle > HOME;
        if leaves { heading + PI } else { heading }
    }
}

/// Places to go to, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Errand {
    /// Turn of a step by which they wander, radians.
    wander: f32,
    /// Where they go, in radii of the ground from its middle, and the steps that they have gone there.
    goal: Vec2,
    gone: u32,
    /// Where they walk beside a route, 0 to 1.
    lane: f32,
}

impl Errand {
    pub(super) fn new(random: &mut SplitMix64) -> Self {
        Self { lane: random.share(), goal: goal(random), wander: 0.0, gone: 0 }
    }

    /// For the step that begins at a place: the turn by which they wander, radians, and where they should go.
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

/// A place to go to, evenly distributed over a ring, in radii of the ground from its middle.
fn goal(random: &mut SplitMix64) -> Vec2 {
    let [least, greatest] = GOALS.map(|radius| radius * radius);
    (least + (greatest - least) * random.share()).sqrt() * facing(TAU * random.share())
}
