//! How abruptly the joints move while one style gives way to another.

use crate::hsmm::features::row_of;
use crate::hsmm::model::{DIMS, Row, SIDES, WalkModel};
use crate::hsmm::walker::{WalkVoices, Walker, WeightsError};
use crate::math::Vec3;
use std::ops::Range;
use std::sync::Arc;

/// Steps before and after the change that are not watched, and of either style that are: states last whole frames, and no
/// two steps round alike.
const SETTLING: u64 = 8;
const STEADY: u64 = 40;

/// Greatest accelerations while a style gives way to another over so many steps in between, as shares of the greatest while
/// either is walked: the largest share of any degree of freedom, and that of all of them together.
///
/// # Errors
/// See [`WeightsError`].
pub fn transition_peak(
    model: &WalkModel,
    voices: &Arc<WalkVoices>,
    [from, to]: [&[f32]; 2],
    between: u32,
) -> Result<[f64; 2], WeightsError> {
    let begin = SETTLING + STEADY;
    let end = begin + u64::from(between) + 1;
    let mut walker = walker(voices, from)?;
    walker.plan_transition(begin, between, [to; SIDES])?;
    let mut watched = Watched::default();
    watched.walk(model, &mut walker, end + SETTLING + STEADY);
    Ok(watched.shares(begin - 1..end + 1, &[SETTLING..begin - 1, end + SETTLING..end + SETTLING + STEADY]))
}

/// [`transition_peak`] of one who stops, stands and goes again.
///
/// # Errors
/// See [`WeightsError`].
pub fn stopping_peak(model: &WalkModel, voices: &Arc<WalkVoices>, weights: &[f32]) -> Result<[f64; 2], WeightsError> {
    let begin = SETTLING + STEADY;
    let mut walker = walker(voices, weights)?;
    let mut watched = Watched::default();
    watched.walk(model, &mut walker, begin);
    walker.set_walking(false);
    watched.walk(model, &mut walker, begin + SETTLING);
    walker.set_walking(true);
    watched.walk(model, &mut walker, begin + 2 * SETTLING);
    let steady = SETTLING..begin - 1;
    Ok(watched.shares(begin - 1..begin + 2 * SETTLING, &[steady]))
}

fn walker(voices: &Arc<WalkVoices>, weights: &[f32]) -> Result<Walker, WeightsError> {
    let mut walker = Walker::new(Arc::clone(voices));
    walker.set_styles(weights)?;
    walker.reset(Vec3::ZERO, 0.0);
    Ok(walker)
}

/// The frames of a walk with the numbers of their steps.
#[derive(Default)]
struct Watched {
    rows: Vec<Row>,
    steps: Vec<u64>,
}

impl Watched {
    /// Walks until a step begins.
    fn walk(&mut self, model: &WalkModel, walker: &mut Walker, until: u64) {
        while walker.next_step() < until {
            self.rows.push(row_of(&model.reference, &walker.advance().rotations));
            self.steps.push(walker.step().0);
        }
    }

    /// Greatest acceleration of a degree of freedom in some steps.
    fn peak(&self, d: usize, steps: &Range<u64>) -> f64 {
        let rows = &self.rows;
        let inner = (1..rows.len() - 1).filter(|&t| steps.contains(&self.steps[t]));
        inner.map(|t| (rows[t + 1][d] - 2.0 * rows[t][d] + rows[t - 1][d]).abs()).fold(0.0, f64::max)
    }

    /// Accelerations of some steps as shares of those of steady ones: the largest share, and that of the largest.
    fn shares(&self, changing: Range<u64>, steady: &[Range<u64>]) -> [f64; 2] {
        let greatest = |of: &mut dyn Iterator<Item = f64>| of.fold(f64::MIN_POSITIVE, f64::max);
        let peaks: Vec<[f64; 2]> = (0..DIMS)
            .map(|d| [self.peak(d, &changing), greatest(&mut steady.iter().map(|steps| self.peak(d, steps)))])
            .collect();
        [
            greatest(&mut peaks.iter().map(|[changing, steady]| changing / steady)),
            greatest(&mut peaks.iter().map(|p| p[0])) / greatest(&mut peaks.iter().map(|p| p[1])),
        ]
    }
}
