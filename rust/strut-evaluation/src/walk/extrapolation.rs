//! Robustness of styles to weakening, exaggeration and negation (`docs/methods/hsmm.md` §10).

use std::sync::Arc;
use strut_core::hsmm::parts::row_of;
use strut_core::hsmm::{ROTATION_DIMS, RotationRow};
use strut_core::hsmm::{RuntimeWalkModel, Walker, WeightsError};
use strut_core::hsmm::{SIDES, STATES, WalkModel};
use strut_core::humanoid::Role;
use strut_core::math::{Vec3, exp_map};

/// Number of steps evaluated.
const STEPS: u64 = 8;
/// The walk fails if more than a share of the degrees of freedom exceeds the recorded range by more than this, radians.
const BEYOND: f64 = 10.0 * std::f64::consts::PI / 180.0;
const MOST_BEYOND: f64 = 0.01;
/// Least angle of a knee, degrees: below it the knee is hyperextended.
const LEAST_KNEE: f64 = -8.0;
/// Shortest valid state, frames. Walkers clamp states to one frame, so this applies only without limits.
const SHORTEST: f64 = 0.5;
/// Share of the frames in which the wrong foot may support the body.
const MOST_WRONG_FOOT: f64 = 0.15;

/// Plausibility of a style at an intensity.
#[derive(Clone, Copy, Debug)]
pub struct ExtrapolationReport {
    /// Whether the walk fails by any of the four criteria of `docs/methods/hsmm.md` §10.
    pub fails: bool,
    /// Least angle of a knee, degrees; negative is hyperextended.
    pub knee: f64,
}

/// Evaluates a walk of a style at an intensity relative to the average, with or without the joints' limits.
///
/// # Errors
/// See [`WeightsError`].
pub fn extrapolation(
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    style: usize,
    intensity: f32,
    limits: bool,
) -> Result<ExtrapolationReport, WeightsError> {
    let mut walker = walker(runtime, style, intensity)?;
    walker.set_limits(limits);
    walker.reset(Vec3::ZERO, 0.0);
    let (mut frames, mut beyond, mut wrong_foot, mut knee) = (0_usize, 0_usize, 0_usize, f64::INFINITY);
    while walker.next_step() < STEPS {
        let pose = *walker.advance();
        let row = row_of(&model.reference, &pose.rotations);
        frames += 1;
        let outside = |d: &usize| row[*d] < model.range[0][*d] - BEYOND || row[*d] > model.range[1][*d] + BEYOND;
        beyond += (0..ROTATION_DIMS).filter(outside).count();
        for role in [Role::LeftLowerLeg, Role::RightLowerLeg] {
            knee = knee.min(f64::from(exp_map::log(pose.rotations[role.index()]).x.to_degrees()));
        }
        let supporting = walker.step().1.other() as usize;
        wrong_foot += usize::from(walker.contact().is_some_and(|(foot, ..)| foot != supporting));
    }
    let mut weights = vec![0.0; runtime.styles()];
    weights[style] = f64::from(intensity);
    let durations = model.mix(&model.average(), &weights).durations;
    let shortest = durations.as_flattened().iter().copied().fold(f64::INFINITY, f64::min);
    let share = |count: usize, of: usize| count as f64 / of as f64;
    let fails = share(beyond, frames * ROTATION_DIMS) > MOST_BEYOND
        || knee < LEAST_KNEE
        || (!limits && shortest < SHORTEST)
        || share(wrong_foot, frames) > MOST_WRONG_FOOT;
    Ok(ExtrapolationReport { fails, knee })
}

/// Strength of a style in walks at some intensities: the projection of the states' mean poses on the change from intensity 0
/// to 1, as a share.
///
/// # Errors
/// See [`WeightsError`].
pub fn strengths(
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    style: usize,
    intensities: &[f32],
    steps: u64,
) -> Result<Vec<f64>, WeightsError> {
    let at = |intensity: f32| mean_poses(model, runtime, style, intensity, steps);
    let (average, whole) = (at(0.0)?, at(1.0)?);
    let along = |poses: &[RotationRow]| -> f64 {
        let all = poses.as_flattened().iter().zip(average.as_flattened()).zip(whole.as_flattened());
        all.map(|((pose, average), whole)| (pose - average) * (whole - average)).sum()
    };
    intensities.iter().map(|intensity| Ok(along(&at(*intensity)?) / along(&whole))).collect()
}

/// Mean pose of every state of a walk.
fn mean_poses(
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    style: usize,
    intensity: f32,
    steps: u64,
) -> Result<Vec<RotationRow>, WeightsError> {
    let mut walker = walker(runtime, style, intensity)?;
    let (mut sums, mut frames) = ([[0.0; ROTATION_DIMS]; SIDES * STATES], [0.0; SIDES * STATES]);
    while walker.next_step() < steps {
        let row = row_of(&model.reference, &walker.advance().rotations);
        let state = walker.step().1 as usize * STATES + walker.state();
        frames[state] += 1.0;
        sums[state].iter_mut().zip(row).for_each(|(sum, v)| *sum += v);
    }
    Ok(sums.iter().zip(frames).map(|(sum, frames)| sum.map(|v| v / f64::max(frames, 1.0))).collect())
}

/// A walker in a style at an intensity relative to the average.
fn walker(runtime: &Arc<RuntimeWalkModel>, style: usize, intensity: f32) -> Result<Walker, WeightsError> {
    let mut weights = vec![0.0; runtime.styles()];
    weights[style] = intensity;
    let mut walker = Walker::new(Arc::clone(runtime));
    walker.set_styles(&weights)?;
    walker.reset(Vec3::ZERO, 0.0);
    Ok(walker)
}
