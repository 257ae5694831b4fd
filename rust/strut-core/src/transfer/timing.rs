//! How long an output frame lasts (specification, §9).

use super::regression::Samples;
use crate::math::float_funcs::exp;
use crate::pose_vector::{PoseRow, ROW};

/// What a neighbour's duration is weighed by: pose and step of the input and of the output.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment<'a> {
    pub(super) input: &'a PoseRow,
    pub(super) previous_input: &'a PoseRow,
    pub(super) output: &'a PoseRow,
    pub(super) previous_output: &'a PoseRow,
}

/// The four features' scales: inverse variances of poses and of steps from one frame to the next.
#[derive(Clone, Debug)]
pub(super) struct Scales {
    pose: PoseRow,
    step: PoseRow,
}

impl Scales {
    /// From the database's global deviations and the deviations of its steps.
    pub(super) fn new(sigma: &PoseRow, step_sigma: &PoseRow) -> Self {
        let inverse = |row: &PoseRow| row.map(|s| 1.0 / (s * s));
        Self { pose: inverse(sigma), step: inverse(step_sigma) }
    }

    fn squared_distance(&self, a: Moment<'_>, b: Moment<'_>) -> f32 {
        let mut sums = [0.0; 4];
        for d in 0..ROW {
            let input = a.input[d] - b.input[d];
            let output = a.output[d] - b.output[d];
            let input_step = input - (a.previous_input[d] - b.previous_input[d]);
            let output_step = output - (a.previous_output[d] - b.previous_output[d]);
            sums[0] += self.pose[d] * input * input;
            sums[1] += self.step[d] * input_step * input_step;
            sums[2] += self.pose[d] * output * output;
            sums[3] += self.step[d] * output_step * output_step;
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3])
    }
}

/// Gaussian-kernel mean of the neighbours' durations in seconds; the bandwidth is the mean distance.
/// `distances` is working memory. `None` without neighbours.
pub(super) fn duration(
    scales: &Scales,
    now: Moment<'_>,
    samples: Samples<'_>,
    step_secs: &[f32],
    distances: &mut Vec<f32>,
) -> Option<f32> {
    let Samples { inputs, targets, neighbours, weights } = samples;
    distances.clear();
    distances.extend(neighbours.iter().map(|n| {
        let at = n.row as usize;
        let then = Moment {
            input: &inputs[at],
            previous_input: &inputs[at - 1],
            output: &targets[at],
            previous_output: &targets[at - 1],
        };
        scales.squared_distance(now, then).sqrt()
    }));
    let bandwidth = distances.iter().sum::<f32>() / distances.len().max(1) as f32;
    let scale = 0.5 / (bandwidth * bandwidth).max(1e-12);
    let nearest = distances.iter().copied().fold(f32::INFINITY, f32::min);
    let (mut sum, mut total) = (0.0, 0.0);
    for ((n, d), &weight) in neighbours.iter().zip(distances.iter()).zip(weights) {
        // Relative to the nearest, so that far-off input cannot underflow every weight.
        let w = weight * exp((nearest * nearest - d * d) * scale);
        sum += w * step_secs[n.row as usize];
        total += w;
    }
    (total > 0.0).then(|| sum / total)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::Neighbour;

    /// Rows 1 … 9 with poses 0.1·row; the target lasts 0.01·row.
    fn duration_at(pose: f32) -> f32 {
        let rows: Vec<PoseRow> = (0..10).map(|i| [0.1 * i as f32; ROW]).collect();
        let secs: Vec<f32> = (0..10).map(|i| 0.01 * i as f32).collect();
        let list: Vec<Neighbour> = (1..10).map(|row| Neighbour { distance: 0.0, row }).collect();
        let (x, x0) = ([pose; ROW], [pose - 0.1; ROW]);
        let now = Moment { input: &x, previous_input: &x0, output: &x, previous_output: &x0 };
        let scales = Scales::new(&[1.0; ROW], &[1.0; ROW]);
        let samples = Samples { inputs: &rows, targets: &rows, neighbours: &list, weights: &[1.0; 9] };
        duration(&scales, now, samples, &secs, &mut Vec::new()).unwrap()
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
        let x = [0.0; ROW];
        let now = Moment { input: &x, previous_input: &x, output: &x, previous_output: &x };
        let scales = Scales::new(&[1.0; ROW], &[1.0; ROW]);
        assert_eq!(
            duration(
                &scales,
                now,
                Samples { inputs: &[], targets: &[], neighbours: &[], weights: &[] },
                &[],
                &mut Vec::new()
            ),
            None
        );
    }
}
