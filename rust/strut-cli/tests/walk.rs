//! Walk synthesis on real motion capture, where it is present (`STRUT_MOCAP`).

mod common;

use common::mocap_folder;
use std::path::Path;
use std::sync::Arc;
use strut_core::hsmm::evaluation::{Reconstruction, recognise};
use strut_core::hsmm::{Options, Track, Training, WalkVoices, Walker, train};
use strut_core::humanoid::{Proportions, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::parallel::Sequential;
use strut_core::retarget::to_humanoid;
use strut_formats::corpus::Clip;

const STYLES: [&str; 7] = ["active", "elderly", "exhausted", "feminine", "masculine", "normal", "youthful"];

/// The walks of `bandai-namco-2`: style, take and track, on the body of the first.
fn walks(mocap: &Path) -> (Proportions, Vec<(usize, usize, Track)>) {
    let (mut body, mut walks) = (None, Vec::new());
    for (style, name) in STYLES.iter().enumerate() {
        for take in 1..=8 {
            let path = mocap.join(format!("bandai-namco-2/dataset-2_walk_{name}_{take:03}.bvh"));
            let clip = Clip::parse(&std::fs::read(path).unwrap()).unwrap();
            let body = *body.get_or_insert(clip.binding.proportions);
            let motion = to_humanoid(&clip.motion, &clip.binding, &body);
            walks.push((style, take, Track::new(&motion).unwrap()));
        }
    }
    (body.unwrap(), walks)
}

#[test]
fn held_out_walks_are_reconstructed_and_recognised() {
    let Some(mocap) = mocap_folder() else { return };
    let (body, walks) = walks(&mocap);
    let of = |takes: std::ops::RangeInclusive<usize>| walks.iter().filter(move |w| takes.contains(&w.1));
    let training: Vec<Training> =
        of(3..=8).map(|(style, _, track)| Training { style: STYLES[*style], track }).collect();
    // Degrees, centimetres and amplitude of the specification, §15.
    #[allow(clippy::approx_constant)] // 3.14 degrees
    for (refined, expected) in [(false, [3.38, 1.75, 0.861]), (true, [3.14, 1.65, 0.924])] {
        let model = train(&body, &training, Options { refined }, &Sequential).unwrap();
        let mut all = Reconstruction::default();
        let (mut right, mut count) = (0, 0);
        for (style, _, track) in of(1..=2) {
            all.add(&model, *style, track);
            let found = recognise(&model, track);
            right += found.iter().filter(|s| *s == style).count();
            count += found.len();
        }
        let found = [all.degrees(), all.centimetres(), all.amplitude()];
        println!("refined {refined}: {found:.3?} against {expected:?}; {right} of {count} steps recognised");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 0.05, "{found} against {expected}");
        }
        assert!(refined || right as f64 >= 0.95 * count as f64);
    }
}

#[test]
fn strides_are_as_long_as_asked_for_and_who_stops_stands_on_both_feet() {
    let Some(mocap) = mocap_folder() else { return };
    let (body, walks) = walks(&mocap);
    let training: Vec<Training> =
        walks.iter().map(|(style, _, track)| Training { style: STYLES[*style], track }).collect();
    let model = train(&body, &training, Options { refined: false }, &Sequential).unwrap();
    let voices = Arc::new(WalkVoices::new(&model));
    for (style, name) in STYLES.iter().enumerate() {
        let walker = || {
            let mut walker = Walker::new(Arc::clone(&voices));
            let weights: Vec<f32> = (0..STYLES.len()).map(|s| if s == style { 1.0 } else { 0.0 }).collect();
            walker.set_styles(&weights).unwrap();
            walker.reset(Vec3::ZERO, 0.0);
            walker
        };
        let way = |share: f32| {
            let mut walker = walker();
            walker.set_stride(share);
            (0..600).for_each(|_| _ = walker.advance());
            walker.pose().root.z
        };
        for share in [0.75, 1.2] {
            let found = way(share) / way(1.0);
            assert!((found / share - 1.0).abs() < 0.15, "{name}: {found} for {share}");
        }

        let mut walker = walker();
        (0..100).for_each(|_| _ = walker.advance());
        walker.set_walking(false);
        (0..90).for_each(|_| _ = walker.advance());
        let world = world_from_local(&body, walker.pose());
        let [left, right] = [Role::LeftFoot, Role::RightFoot].map(|foot| world.positions[foot.index()]);
        let centre = world.positions.iter().map(|p| p.z).sum::<f32>() / world.positions.len() as f32;
        assert!((left.y - right.y).abs() < 0.04, "{name}: {left} {right}");
        for foot in [left, right] {
            assert!((centre - foot.z).abs() < 0.12, "{name}: {foot} below {centre}");
        }
    }
}
