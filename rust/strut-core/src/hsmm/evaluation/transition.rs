//! How abruptly the joints move while one style gives way to another.

use crate::hsmm::features::row_of;
use crate::hsmm::model::{DIMS, WalkModel};
use crate::hsmm::walker::{WalkVoices, Walker, WeightsError};
use crate::math::Vec3;
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
    let mut walker = Walker::new(Arc::clone(voices));
    walker.set_styles(from)?;
    walker.reset(Vec3::ZERO, 0.0);
    let begin = SETTLING + STEADY;
    let end = begin + u64::from(between) + 1;
    walker.plan_transition(begin, between, to)?;
    let (mut rows, mut numbers) = (Vec::new(), Vec::new());
    while walker.next_step() < end + SETTLING + STEADY {
        rows.push(row_of(&model.reference, &walker.advance().rotations));
        numbers.push(walker.step().0);
    }
    let peak = |d: usize, steps: std::ops::Range<u64>| {
        let inner = (1..rows.len() - 1).filter(|&t| steps.contains(&numbers[t]));
        inner.map(|t| (rows[t + 1][d] - 2.0 * rows[t][d] + rows[t - 1][d]).abs()).fold(0.0, f64::max)
    };
    let steady: Vec<f64> =
        (0..DIMS).map(|d| peak(d, SETTLING..begin - 1).max(peak(d, end + SETTLING..end + SETTLING + STEADY))).collect();
    let changing: Vec<f64> = (0..DIMS).map(|d| peak(d, begin - 1..end + 1)).collect();
    let greatest = |of: &[f64]| of.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let shares: Vec<f64> = changing.iter().zip(&steady).map(|(c, s)| c / s.max(f64::MIN_POSITIVE)).collect();
    Ok([greatest(&shares), greatest(&changing) / greatest(&steady)])
}
