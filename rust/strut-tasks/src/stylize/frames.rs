//! Styling of the frames of a clip on several threads.

use crate::error::Outcome;
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
use strut_core::transfer::{ClipJob, ClipSearch, Found, Trace};

/// Number of portions per thread that are searched ahead of the styling.
const PORTIONS_A_THREAD: usize = 4;

/// Styles all frames of a clip, with the same bits as [`ClipJob::push`] of every pose. Styling is sequential; meanwhile
/// the neighbours of later frames are searched. An error of `on_frame` ends it.
pub(super) fn style_frames(
    job: &mut ClipJob,
    search: &ClipSearch<'_>,
    mut on_frame: impl FnMut(&Trace<'_>) -> Outcome + Send,
) -> Outcome {
    let batch = PORTIONS_A_THREAD * rayon::current_num_threads();
    let find = |first: usize| -> Vec<Found> {
        let portions = first..search.portions().min(first + batch);
        portions.into_par_iter().with_max_len(1).map(|portion| search.find(portion)).collect()
    };
    let (mut first, mut found) = (0, find(0));
    while !found.is_empty() {
        let style = || {
            for (portion, found) in (first..).zip(&found) {
                for (pose, frame) in search.poses(portion).iter().zip(found.frames()) {
                    on_frame(&job.push_found(pose, &frame))?;
                }
            }
            Ok(())
        };
        let next = first + found.len();
        let (styled, later) = rayon::join(style, || find(next));
        styled?;
        (first, found) = (next, later);
    }
    Ok(())
}
