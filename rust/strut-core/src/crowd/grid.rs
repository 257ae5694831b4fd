//! Who is near whom: places sorted into the cells of a grid.

use crate::math::Vec2;

/// Side of a cell, metres.
const CELL: f32 = 4.0;
/// Cells a side: as many as the largest crowd needs, and those who are beyond are in the outermost.
const SIDE: usize = 24;

/// Places by cell; keeps its memory.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// Where every cell begins in `sorted`, and the end.
    begins: [u16; SIDE * SIDE + 1],
    /// Numbers of places, cell by cell, in order within each.
    sorted: Vec<u16>,
}

impl Default for Grid {
    fn default() -> Self {
        Self { begins: [0; SIDE * SIDE + 1], sorted: Vec::new() }
    }
}

impl Grid {
    /// Sorts places anew: at most as many as a `u16` counts.
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

    /// Numbers of all places within a cell's side of one, and some more, in an order that depends on places alone.
    pub(super) fn near(&self, place: Vec2) -> impl Iterator<Item = usize> + Clone {
        let [x, z] = cells_of(place);
        let rows = z.saturating_sub(1)..(z + 2).min(SIDE);
        rows.flat_map(move |row| {
            let (first, last) = (row * SIDE + x.saturating_sub(1), row * SIDE + (x + 1).min(SIDE - 1));
            &self.sorted[usize::from(self.begins[first])..usize::from(self.begins[last + 1])]
        })
        .map(|number| usize::from(*number))
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
        fn nobody_near_is_missed(places in prop::collection::vec((-60.0f32..60.0, -60.0f32..60.0), 1..200)) {
            let places: Vec<Vec2> = places.iter().map(|(x, z)| Vec2::new(*x, *z)).collect();
            let mut grid = Grid::default();
            grid.sort(places.iter().copied());
            for place in &places {
                let found: Vec<usize> = grid.near(*place).collect();
                let near = (0..places.len()).filter(|i| places[*i].distance(*place) < CELL);
                for i in near {
                    prop_assert_eq!(found.iter().filter(|n| **n == i).count(), 1);
                }
            }
        }
    }
}
