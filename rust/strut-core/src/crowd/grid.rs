//! Neighbour search: places sorted into the cells of a grid.

use super::steering::AgentState;
use crate::math::Vec2;

/// Side of a cell, metres. Smaller cells hold fewer states beyond the reach; of larger cells fewer are searched.
const CELL: f32 = 2.0;
/// Cells per side: enough for the largest crowd; places beyond are in the outermost cells.
const SIDE: usize = 48;

/// Places by cell; keeps its memory.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// Start index of every cell in `sorted`, and the end.
    begins: [u16; SIDE * SIDE + 1],
    /// Indices of places, cell by cell, in order within each.
    sorted: Vec<u16>,
}

impl Default for Grid {
    fn default() -> Self {
        Self { begins: [0; SIDE * SIDE + 1], sorted: Vec::new() }
    }
}

impl Grid {
    /// Sorts places into the cells; there are at most as many as a `u16` counts.
    pub(super) fn sort(&mut self, places: impl Iterator<Item = Vec2> + Clone) {
        self.begins.fill(0);
        for place in places.clone() {
            self.begins[cell_of(place) + 1] += 1;
        }
        for cell in 0..SIDE * SIDE {
            self.begins[cell + 1] += self.begins[cell];
        }
        let count = usize::from(self.begins[SIDE * SIDE]);
        self.sorted.resize(count, 0);
        let mut ends = self.begins;
        for (number, place) in places.enumerate() {
            let at = &mut ends[cell_of(place)];
            self.sorted[usize::from(*at)] = number as u16;
            *at += 1;
        }
    }

    /// Indices of all places within a reach of one along either axis, and some more, in an order that depends on the places
    /// only.
    fn near(&self, place: Vec2, reach: f32) -> impl Iterator<Item = usize> + Clone {
        let [least, greatest] = [-reach, reach].map(|by| cells_of(place + Vec2::splat(by)));
        let rows = least[1]..=greatest[1];
        rows.flat_map(move |row| {
            let (first, last) = (row * SIDE + least[0], row * SIDE + greatest[0]);
            &self.sorted[usize::from(self.begins[first])..usize::from(self.begins[last + 1])]
        })
        .map(|number| usize::from(*number))
    }
}

/// Searches the neighbours of one agent of a crowd.
#[derive(Debug)]
pub struct Others<'a> {
    pub(super) grid: &'a Grid,
    /// All states, as `grid` was sorted by their places.
    pub(super) states: &'a [AgentState],
    /// Index of the agent whose neighbours are searched.
    pub(super) of: usize,
    /// Buffer for the result.
    pub(super) found: &'a mut Vec<AgentState>,
}

impl Others<'_> {
    /// The other states nearer than a reach, metres.
    pub(super) fn within(&mut self, reach: f32) -> &[AgentState] {
        self.found.clear();
        if let Some(me) = self.states.get(self.of) {
            let others = self.grid.near(me.at, reach).filter(|other| *other != self.of);
            let states = others.map(|other| self.states[other]);
            self.found.extend(states.filter(|other| other.at.distance_squared(me.at) < reach * reach));
        }
        self.found
    }
}

fn cells_of(place: Vec2) -> [usize; 2] {
    let middle = (SIDE / 2) as f32;
    [place.x, place.y].map(|v| (v / CELL + middle).clamp(0.0, (SIDE - 1) as f32) as usize)
}

fn cell_of(place: Vec2) -> usize {
    let [x, z] = cells_of(place);
    z * SIDE + x
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn neighbours_depend_on_the_distance_alone(
            places in prop::collection::vec((-60.0f32..60.0, -60.0f32..60.0), 1..200), reach in 0.1f32..12.0,
        ) {
            let at = |(x, z): &(f32, f32)| AgentState { at: Vec2::new(*x, *z), ..AgentState::default() };
            let states: Vec<AgentState> = places.iter().map(at).collect();
            let mut grid = Grid::default();
            grid.sort(states.iter().map(|state| state.at));
            let mut found = Vec::new();
            for (of, me) in states.iter().enumerate() {
                let mut others = Others { grid: &grid, states: &states, of, found: &mut found };
                let near = |i: &usize| *i != of && states[*i].at.distance_squared(me.at) < reach * reach;
                let by_x = |a: &Vec2, b: &Vec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
                let mut expected: Vec<Vec2> = (0..states.len()).filter(near).map(|i| states[i].at).collect();
                let mut found: Vec<Vec2> = others.within(reach).iter().map(|state| state.at).collect();
                expected.sort_by(by_x);
                found.sort_by(by_x);
                prop_assert_eq!(found, expected);
            }
        }
    }
}
