use super::*;
use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, noise, walk};
use std::sync::{Arc, LazyLock};
use strut_core::hsmm::{LabelledClip, Options, RuntimeWalkModel, Track, train};
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::math::{Vec3, exp_map};
use strut_core::parallel::Sequential;

/// Thirty seconds of a gait with a slight tremor, so that no variance is zero.
fn track(gait: &Gait) -> Track {
    let (proportions, mut poses) = (Proportions::default(), walk(gait, 1800, 0.1).poses);
    let mut noise = noise(1).map(|v| 0.015 * v as f32);
    let mut random = || noise.next().unwrap();
    for rotation in poses.iter_mut().flat_map(|pose| &mut pose.rotations) {
        *rotation = *rotation * exp_map::exp(Vec3::new(random(), random(), random()));
    }
    Track::new(&HumanoidMotion { proportions, rate_hz: RATE_HZ, poses }).unwrap()
}

/// Upright and bent walking, with steps of two durations.
static MODEL: LazyLock<WalkModel> = LazyLock::new(|| {
    let tracks: Vec<(&str, Track)> = [("upright", NEUTRAL), ("bent", BENT)]
        .iter()
        .flat_map(|(name, gait)| [0.0, 3.0].map(|more| (*name, track(&Gait { period: gait.period + more, ..*gait }))))
        .collect();
    let clips: Vec<LabelledClip> = tracks.iter().map(|(style, track)| LabelledClip { style, track }).collect();
    train(&Proportions::default(), &clips, Options::default(), &Sequential).unwrap()
});

#[test]
fn looking_ahead_gives_the_trajectory_of_the_whole_walk() {
    let [mean, greatest] = horizon_error(&MODEL, &Arc::new(RuntimeWalkModel::new(&MODEL)), 0).unwrap();
    assert!(mean < 0.1 && greatest < 1.0, "{mean} {greatest}");
}

#[test]
fn the_statistics_of_no_step_are_those_of_one() {
    let runtime = Arc::new(RuntimeWalkModel::new(&MODEL));
    let of = |steps: u64| GaitStatistics::of(&MODEL, &runtime, &[1.0, 0.0], steps).unwrap();
    assert_eq!(of(0), of(1));
}
