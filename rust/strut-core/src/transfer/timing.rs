//! Durations of output frames (`docs/methods/mar.md` §9).

use crate::catalogue::Rows;
use crate::math::float_funcs::exp;
use crate::math::lanes::Lane;
use crate::pose_vector::{LANES, PoseRow};
use crate::search::Neighbour;

/// A pose and the one before it, of the input or of the output. Neighbours' durations are weighted by their distances
/// from both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<'a> {
    pub(super) pose: &'a PoseRow,
    pub(super) previous: &'a PoseRow,
}

/// Scales of the features: inverse variances of poses and of steps from one frame to the next.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    pose: PoseRow,
    step: PoseRow,
}

impl Scales {
    /// Computes the scales from the database's global deviations and the deviations of its steps.
    pub(super) fn new(sigma: &PoseRow, step_sigma: &PoseRow) -> Self {
        let inverse = |row: &PoseRow| row.map(|s| 1.0 / (s * s));
        Self { pose: inverse(sigma), step: inverse(step_sigma) }
    }

    /// Squared distances of pose and step between a moment and each of these rows. Processing several rows at once
    /// shares the memory accesses.
    #[inline]
    fn squared_distances_of<const N: usize>(
        &self,
        now: Moment<'_>,
        rows: &(impl Rows + ?Sized),
        numbers: [usize; N],
    ) -> [f32; N] {
        let pairs = numbers.map(|row| rows.pair(row));
        let (mut poses, mut steps) = ([Lane::default(); N], [Lane::default(); N]);
        for l in 0..LANES {
            let at = |row: &PoseRow| Lane::of(row, l);
            for (i, pair) in pairs.iter().enumerate() {
                let [before, row] = pair(l);
                let pose = at(now.pose) - row;
                let step = pose - (at(now.previous) - before);
                poses[i] += at(&self.pose) * pose * pose;
                steps[i] += at(&self.step) * step * step;
            }
        }
        std::array::from_fn(|i| poses[i].sum() + steps[i].sum())
    }

    /// Fills `out` with the squared distances between a moment and those of the neighbours in `rows`.
    pub(super) fn squared_distances(
        &self,
        now: Moment<'_>,
        rows: &(impl Rows + ?Sized),
        neighbours: &[Neighbour],
        out: &mut Vec<f32>,
    ) {
        out.clear();
        let (twos, last) = neighbours.as_chunks::<2>();
        for two in twos {
            out.extend(self.squared_distances_of(now, rows, two.map(|n| n.row as usize)));
        }
        out.extend(last.iter().flat_map(|n| self.squared_distances_of(now, rows, [n.row as usize])));
    }
}

/// Gaussian kernel over neighbours; the bandwidth is their mean distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kernel {
    pub(super) bandwidth: f32,
    /// ½ / bandwidth².
    scale: f32,
    /// The least squared distance.
    nearest: f32,
}

impl Kernel {
    /// Kernel for neighbours at these squared distances from the [`Moment`]s of the input and of the output.
    pub(super) fn new(of_inputs: &[f32], of_outputs: &[f32]) -> Self {
        let squares = || of_inputs.iter().zip(of_outputs).map(|(x, y)| x + y);
        let bandwidth = squares().map(f32::sqrt).sum::<f32>() / of_inputs.len().max(1) as f32;
        // `f32::min` would be a function call in WebAssembly.
        let nearest = squares().fold(f32::INFINITY, |least, square| if square < least { square } else { least });
        let scale = 0.5 / (bandwidth * bandwidth).max(1e-12);
        Self { bandwidth, scale, nearest }
    }

    /// Weight at a squared distance, relative to that of the nearest neighbour, so that the weights of distant input do
    /// not all underflow.
    pub(super) fn weight(self, square: f32) -> f32 {
        exp((self.nearest - square) * self.scale)
    }
}

/// Gaussian-kernel mean of the neighbours' durations in seconds, given the squared distances of their inputs and
/// of their outputs. `None` without neighbours.
pub(super) fn duration(
    of_inputs: &[f32],
    of_outputs: &[f32],
    neighbours: &[Neighbour],
    weights: &[f32],
    step_secs: impl Fn(usize) -> f32,
) -> Option<f32> {
    let kernel = Kernel::new(of_inputs, of_outputs);
    let squares = of_inputs.iter().zip(of_outputs).map(|(x, y)| x + y);
    let (mut sum, mut total) = (0.0, 0.0);
    for ((n, square), &weight) in neighbours.iter().zip(squares).zip(weights) {
        let w = weight * kernel.weight(square);
        sum += w * step_secs(n.row as usize);
        total += w;
    }
    (total > 0.0).then(|| sum / total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pose_vector::ROW;

    /// Rows 1 … 9 with poses 0.1·row; the target lasts 0.01·row.
    fn duration_at(pose: f32) -> f32 {
        let rows: Vec<PoseRow> = (0..10).map(|i| [0.1 * i as f32; ROW]).collect();
        let secs: Vec<f32> = (0..10).map(|i| 0.01 * i as f32).collect();
        let list: Vec<Neighbour> = (1..10).map(|row| Neighbour { distance: 0.0, row }).collect();
        let (x, x0) = ([pose; ROW], [pose - 0.1; ROW]);
        let mut distances = Vec::new();
        let scales = Scales::new(&[1.0; ROW], &[1.0; ROW]);
        scales.squared_distances(Moment { pose: &x, previous: &x0 }, &rows[..], &list, &mut distances);
        duration(&distances, &distances, &list, &[1.0; 9], |row| secs[row]).unwrap()
    }

    #[test]
    fn nearer_neighbours_count_more() {
        assert!((duration_at(0.5) - 0.05).abs() < 1e-6);
        assert!(duration_at(0.2) < 0.045);
        assert!(duration_at(0.8) > 0.055);
    }

    #[test]
    fn input_far_from_all_neighbours_still_gets_a_duration_between_theirs() {
        let d = duration_at(1e6);
        assert!((0.01..=0.09).contains(&d), "{d}");
    }

    #[test]
    fn there_is_none_without_neighbours() {
        assert_eq!(duration(&[], &[], &[], &[], |_| 1.0), None);
    }
}
