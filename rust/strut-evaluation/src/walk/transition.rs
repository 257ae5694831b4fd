//! Peak joint accelerations during style transitions.

use std::ops::Range;
use std::sync::Arc;
use strut_core::hsmm::parts::row_of;
use strut_core::hsmm::{ROTATION_DIMS, RotationRow};
use strut_core::hsmm::{RuntimeWalkModel, Walker, WeightsError};
use strut_core::hsmm::{SIDES, WalkModel};
use strut_core::humanoid::JOINTS;
use strut_core::math::Vec3;

/// Steps that are skipped before and after the change, and steady steps that are measured in either style: many, because
/// states last whole frames and every step is rounded differently.
const SETTLING: u64 = 8;
const STEADY: u64 = 40;

/// Peak accelerations during a change of style, relative to the peaks of steady walking in either style.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Largest ratio over the joints.
    pub joint: f64,
    /// Largest ratio over the degrees of freedom; some of them hardly move at all.
    pub freedom: f64,
    /// Ratio of the greatest accelerations over all joints.
    pub greatest: f64,
}

/// Measures [`Peaks`] of a transition between styles over `between` steps.
///
/// # Errors
/// See [`WeightsError`].
pub fn transition_peaks(
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    [from, to]: [&[f32]; 2],
    between: u32,
) -> Result<Peaks, WeightsError> {
    let begin = SETTLING + STEADY;
    let end = begin + u64::from(between) + 1;
    let mut walker = walker(runtime, from)?;
    walker.plan_transition(begin, between, [to; SIDES])?;
    let mut watched = Watched::default();
    watched.walk(model, &mut walker, end + SETTLING + STEADY);
    Ok(watched.peaks(&(begin - 1..end + 1), &[SETTLING..begin - 1, end + SETTLING..end + SETTLING + STEADY]))
}

/// Measures [`Peaks`] of a walk that stops, stands and starts again.
///
/// # Errors
/// See [`WeightsError`].
pub fn stopping_peaks(
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    weights: &[f32],
) -> Result<Peaks, WeightsError> {
    let begin = SETTLING + STEADY;
    let mut walker = walker(runtime, weights)?;
    let mut watched = Watched::default();
    watched.walk(model, &mut walker, begin);
    walker.set_walking(false);
    watched.walk(model, &mut walker, begin + SETTLING);
    walker.set_walking(true);
    watched.walk(model, &mut walker, begin + 2 * SETTLING);
    let steady = SETTLING..begin - 1;
    Ok(watched.peaks(&(begin - 1..begin + 2 * SETTLING), &[steady]))
}

fn walker(runtime: &Arc<RuntimeWalkModel>, weights: &[f32]) -> Result<Walker, WeightsError> {
    let mut walker = Walker::new(Arc::clone(runtime));
    walker.set_styles(weights)?;
    walker.reset(Vec3::ZERO, 0.0);
    Ok(walker)
}

/// The frames of a walk with the numbers of their steps.
#[derive(Default)]
struct Watched {
    rows: Vec<RotationRow>,
    steps: Vec<u64>,
}

impl Watched {
    /// Walks until step `until` begins.
    fn walk(&mut self, model: &WalkModel, walker: &mut Walker, until: u64) {
        while walker.next_step() < until {
            self.rows.push(row_of(&model.reference, &walker.advance().rotations));
            self.steps.push(walker.step().0);
        }
    }

    /// Greatest norm of the acceleration of some degrees of freedom in some steps.
    fn greatest(&self, dims: Range<usize>, steps: &Range<u64>) -> f64 {
        let rows = &self.rows;
        let of = |t: usize, d: usize| rows[t + 1][d] - 2.0 * rows[t][d] + rows[t - 1][d];
        let inner = (1..rows.len() - 1).filter(|&t| steps.contains(&self.steps[t]));
        inner.map(|t| dims.clone().map(|d| of(t, d) * of(t, d)).sum::<f64>().sqrt()).fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Accelerations of some steps relative to those of steady ones.
    fn peaks(&self, changing: &Range<u64>, steady: &[Range<u64>]) -> Peaks {
        let both = |dims: Range<usize>| {
            let steady = steady.iter().map(|steps| self.greatest(dims.clone(), steps)).fold(0.0, f64::max);
            [self.greatest(dims, changing), steady]
        };
        let joints: Vec<[f64; 2]> = (0..JOINTS).map(|j| both(3 * j..3 * j + 3)).collect();
        let most = |shares: &mut dyn Iterator<Item = f64>| shares.fold(0.0, f64::max);
        let of_all = |i: usize| most(&mut joints.iter().map(|peaks| peaks[i]));
        Peaks {
            joint: most(&mut joints.iter().map(|[changing, steady]| changing / steady)),
            freedom: most(&mut (0..ROTATION_DIMS).map(|d| both(d..d + 1)).map(|[changing, steady]| changing / steady)),
            greatest: of_all(0) / of_all(1),
        }
    }
}
