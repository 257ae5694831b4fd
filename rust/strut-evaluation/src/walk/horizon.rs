//! Error caused by the finite look-ahead.

use super::generate;
use super::shared_of;
use std::sync::Arc;
use strut_core::hsmm::WalkModel;
use strut_core::hsmm::{RuntimeWalkModel, Walker, WeightsError};
use strut_core::humanoid::JOINTS;
use strut_core::math::Vec3;

/// Frames that are walked, and those excluded at either end, where the trajectory of the whole walk has no past or no future.
const FRAMES: usize = 240;
const ENDS: usize = 30;

/// Returns the mean and the greatest angle between a walker's joints and those of the trajectory of the whole walk, degrees.
///
/// # Errors
/// See [`WeightsError`].
pub fn horizon_error(
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    style: usize,
) -> Result<[f64; 2], WeightsError> {
    let mut weights = vec![0.0; runtime.styles()];
    weights[style] = 1.0;
    let mut walker = Walker::new(Arc::clone(runtime));
    walker.set_styles(&weights)?;
    walker.set_limits(false);
    walker.reset(Vec3::ZERO, 0.0);
    let (mut states, mut poses) = (Vec::new(), Vec::new());
    for _ in 0..FRAMES {
        let pose = *walker.advance();
        states.push((walker.step().1 as usize, walker.state()));
        poses.push(pose);
    }
    let rows = generate(&states, &model.means[style], &shared_of(model));
    let angles: Vec<f64> = (ENDS..FRAMES - ENDS)
        .flat_map(|t| {
            let whole = model.rotations(&rows[t]);
            let walked = poses[t].rotations;
            (0..JOINTS).map(move |j| f64::from(whole[j].inv_mul(walked[j]).angle().to_degrees()))
        })
        .collect();
    Ok([angles.iter().sum::<f64>() / angles.len() as f64, angles.iter().copied().fold(0.0, f64::max)])
}
