//! Every window of a class, one after the other: the definition that faster searches must equal.

use super::metric::{Metric, QueryWindow};
use super::neighbours::{Neighbour, Neighbours};
use super::{Index, windows_of_clip};

/// Adds the windows of a class to `out`, which keeps the nearest.
pub(super) fn offer_class(index: &Index, query: &QueryWindow, metric: Metric, class: usize, out: &mut Neighbours) {
    let norms = index.norms(metric);
    for clip in &index.clips[index.classes[class].clone()] {
        for last in windows_of_clip(clip) {
            let (height, ground) = index.window(last);
            let distance = query.distance(metric, height, ground, norms[last]);
            out.offer(Neighbour { distance, row: last as u32 });
        }
    }
}
