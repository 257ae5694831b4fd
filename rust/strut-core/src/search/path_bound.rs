//! Exact search that passes over stretches of a clip without looking at them.
//!
//! √D is a metric on windows modulo motions over the ground plane, so the triangle inequality holds. Let
//! a window be at distance √D from the query: one that lies s further along the clip's path through the
//! space of windows is at least √D − s away. As long as that exceeds the distance of the K-th nearest,
//! windows need not be evaluated. Successive windows of a clip are about a centimetre apart, distances
//! to the query mostly ten times that, so that most windows are passed over.

use super::Index;
use super::metric::{Metric, QueryWindow};
use super::neighbours::{Neighbour, Neighbours};

/// Bound on the rounding error of a computed D, m². Its terms are of the order of 1 m² (heights above
/// the ground), of which single precision keeps seven digits; on real windows no error exceeded 2e-6.
const ROUNDING: f32 = 1e-5;

/// Length of the step from one window to the next, D apart, along a clip's path, rounded up, metres.
pub(super) fn step_length(distance: f32) -> f32 {
    (distance + ROUNDING).sqrt()
}

/// Adds to `out` every window of a class that can be among the nearest. `limit` is a D that the K-th
/// nearest is known not to exceed; infinity if nothing is known.
pub(super) fn offer_class<const S: usize>(
    index: &Index,
    query: &QueryWindow,
    metric: Metric,
    class: usize,
    limit: f32,
    out: &mut Neighbours,
) {
    let path = index.path(metric);
    for clip in &index.clips[index.classes[class].clone()] {
        let windows = index.windows_of_clip(clip);
        let mut last = windows.start;
        while last < windows.end {
            let distance = index.distance::<S>(query, metric, last);
            out.offer(Neighbour { distance, row: last as u32 });
            let nearest = (distance - ROUNDING).max(0.0).sqrt();
            let passed = path[last] + nearest - (out.threshold().min(limit) + ROUNDING).sqrt();
            last += 1;
            while last < windows.end && path[last] < passed {
                last += 1;
            }
        }
    }
}

/// A D that the K-th nearest window of these classes does not exceed, from K windows that are likely to be
/// near: the successors of the last query's neighbours. Infinity if there are fewer than K of them.
pub(super) fn limit_from_last<const S: usize>(
    index: &Index,
    query: &QueryWindow,
    metric: Metric,
    classes: &[usize],
    last: &Neighbours,
    scratch: &mut Neighbours,
) -> f32 {
    let last = last.as_slice();
    for n in last {
        let row = n.row as usize;
        let clip = index.clips.partition_point(|c| c.end <= row);
        let class = index.classes.partition_point(|c| c.end <= clip);
        if clip == index.clips.len() || !classes.contains(&class) {
            continue;
        }
        // At the end of a clip the neighbour itself stands in, unless it is another one's successor.
        let ends = row + 1 == index.clips[clip].end;
        if ends && last.iter().any(|p| p.row + 1 == n.row) {
            continue;
        }
        let next = if ends { row } else { row + 1 };
        scratch.offer(Neighbour { distance: index.distance::<S>(query, metric, next), row: next as u32 });
    }
    scratch.threshold()
}
