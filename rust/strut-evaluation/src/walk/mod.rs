//! Evaluation of walk synthesis: held-out likelihood, and robustness of walks to controls (`docs/methods/hsmm.md` §12).

mod context;
mod extrapolation;
mod gait_statistics;
mod horizon;
mod reconstruction;
mod recursion;
mod transition;

pub use context::{ContextTree, Split};
pub use extrapolation::{ExtrapolationReport, extrapolation, strengths};
pub use gait_statistics::GaitStatistics;
pub use horizon::horizon_error;
pub use reconstruction::{Reconstruction, recognise};
pub use recursion::recursion_error;
pub use transition::{Peaks, stopping_peaks, transition_peaks};

use strut_core::hsmm::WalkModel;
use strut_core::hsmm::parts::{Banded, FrameState, SharedVariances, Stream, Term};
use strut_core::hsmm::{ROTATION_DIMS, RotationRow, StyleMeans};

fn shared_of(model: &WalkModel) -> SharedVariances {
    SharedVariances { variances: model.variances.clone(), duration_variances: model.duration_variances }
}

/// The trajectory of a style for a sequence of states.
fn generate(states: &[FrameState], means: &StyleMeans, shared: &SharedVariances) -> Vec<RotationRow> {
    let (mut rows, mut system) = (vec![[0.0; ROTATION_DIMS]; states.len()], Banded::default());
    for d in 0..ROTATION_DIMS {
        let term = |side: usize, state: usize, part: Stream| Term {
            mean: means.means[side][state][part as usize][d],
            weight: 1.0 / shared.variances[side][state][part as usize][d],
        };
        let values = system.through(states, term);
        rows.iter_mut().zip(values).for_each(|(row, v)| row[d] = *v);
    }
    rows
}

#[cfg(test)]
mod tests;
