//! Walk synthesis on real motion capture, if it is present (`STRUT_MOCAP`).

use crate::common::{assert_refused, mocap, strut, strut_ok};
use std::path::Path;
use std::sync::Arc;
use strut_core::hsmm::{LabelledClip, Options, RuntimeWalkModel, Track, WalkModel, Walker, train};
use strut_core::humanoid::{HumanoidMotion, Proportions, Role};
use strut_core::kinematics::world_from_local;
use strut_core::math::Vec3;
use strut_core::parallel::Sequential;
use strut_core::retarget::to_humanoid;
use strut_evaluation::walk::{GaitStatistics, Reconstruction, recognise, recursion_error};
use strut_formats::bvh::{self, Bvh};
use strut_formats::corpus::Clip;

const STYLES: [&str; 7] = ["active", "elderly", "exhausted", "feminine", "masculine", "normal", "youthful"];

/// File names of the walks of `bandai-namco-1`.
const ACTED: &str =
    "active angry childish chimpira feminine giant happy masculinity musical normal not-confident old proud sad tired";

/// Reads the walks of `bandai-namco-2`: style, take and track, on the body of the first.
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
    let Some(mocap) = mocap::folder() else { return };
    let (body, walks) = walks(&mocap);
    let of = |takes: std::ops::RangeInclusive<usize>| walks.iter().filter(move |w| takes.contains(&w.1));
    let training: Vec<LabelledClip> =
        of(3..=8).map(|(style, _, track)| LabelledClip { style: STYLES[*style], track }).collect();
    // Degrees, centimetres and amplitude of `docs/methods/hsmm.md` §15.
    #[allow(clippy::approx_constant)] // 3.14 degrees
    for (refined, expected) in [(false, [3.38, 1.75, 0.861]), (true, [3.14, 1.65, 0.924])] {
        let model = train(&body, &training, Options { refined }, &Sequential).unwrap();
        let mut all = Reconstruction::default();
        let (mut right, mut count) = (0, 0);
        let mut walked = 0.0_f64;
        for (style, _, track) in of(1..=2) {
            all.add(&model, *style, track);
            walked = walked.max(recursion_error(&model, *style, track).unwrap());
            let found = recognise(&model, track);
            right += found.iter().filter(|s| *s == style).count();
            count += found.len();
        }
        let found = [all.degrees(), all.centimetres(), all.amplitude()];
        println!("refined {refined}: {found:.3?} against {expected:?}; {right} of {count} steps recognised");
        println!("refined {refined}: walked to {walked:.1e} rad");
        assert!(walked < 2e-5, "{walked} rad");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 0.05, "{found} against {expected}");
        }
        assert!(refined || right as f64 >= 0.95 * count as f64);
    }
}

#[test]
fn strides_have_the_requested_length_and_a_stop_ends_on_both_feet() {
    let Some(mocap) = mocap::folder() else { return };
    let (body, walks) = walks(&mocap);
    let training: Vec<LabelledClip> =
        walks.iter().map(|(style, _, track)| LabelledClip { style: STYLES[*style], track }).collect();
    let model = train(&body, &training, Options { refined: false }, &Sequential).unwrap();
    let runtime = Arc::new(RuntimeWalkModel::new(&model));
    for (style, name) in STYLES.iter().enumerate() {
        let walker = || {
            let mut walker = Walker::new(Arc::clone(&runtime));
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

#[test]
fn steps_and_speed_go_one_way_from_the_opposite_of_a_style_to_twice_of_it() {
    let Some(mocap) = mocap::folder() else { return };
    let (body, walks) = walks(&mocap);
    let mut training: Vec<LabelledClip> = walks
        .iter()
        .filter(|(_, take, _)| *take > 2)
        .map(|(style, _, track)| LabelledClip { style: STYLES[*style], track })
        .collect();
    all_go_one_way(&train(&body, &training, Options { refined: true }, &Sequential).unwrap(), 60);

    let acted = ACTED.split(' ').map(|name| {
        let path = mocap.join(format!("bandai-namco-1/dataset-1_walk_{name}_001.bvh"));
        let clip = Clip::parse(&std::fs::read(path).unwrap()).unwrap();
        (format!("{name} 1"), Track::new(&to_humanoid(&clip.motion, &clip.binding, &body)).unwrap())
    });
    let acted: Vec<(String, Track)> = acted.collect();
    training.extend(acted.iter().map(|(style, track)| LabelledClip { style, track }));
    all_go_one_way(&train(&body, &training, Options { refined: true }, &Sequential).unwrap(), 100);
}

/// Checks that length and speed of a number of steps of every style are monotonic in its weight. The initial transient
/// has little effect on the mean: it is greatest where a style's legs are at their limit.
fn all_go_one_way(model: &WalkModel, steps: u64) {
    let runtime = Arc::new(RuntimeWalkModel::new(model));
    for (style, name) in model.styles.iter().enumerate() {
        let at = |quarter: i16| {
            let mut weights = vec![0.0; model.styles.len()];
            weights[style] = 0.25 * f32::from(quarter);
            GaitStatistics::of(model, &runtime, &weights, steps).unwrap()
        };
        let gaits: Vec<GaitStatistics> = (-4..=8).map(at).collect();
        for (measure, of) in [("length", (|g| g.step_length) as fn(&GaitStatistics) -> f64), ("speed", |g| g.speed)] {
            let way: Vec<f64> = gaits.iter().map(of).collect();
            let rises = way.is_sorted();
            assert!(rises || way.iter().rev().is_sorted(), "{name}, {measure}: {way:.4?}");
        }
    }
}

/// Returns the built-in walk straight ahead.
fn demo_walk() -> HumanoidMotion {
    strut_demo::input_clips().remove(0).motion
}

fn bvh_of(motion: &HumanoidMotion) -> String {
    bvh::write_text(&Bvh::from_humanoid(motion).unwrap())
}

#[test]
fn walks_of_one_style_are_not_compared_with_each_other() {
    let folder = tempfile::tempdir().unwrap();
    for take in 1..=4 {
        let name = format!("walk_old_{take}.bvh");
        std::fs::write(folder.path().join(name), bvh_of(&demo_walk())).unwrap();
    }
    assert_refused(folder.path(), &["evaluate-walk", "."], "walks of at least two styles were expected");
}

/// Removes the joints of the toes from BVH text: their parents end at the toes' positions.
fn without_toes(text: &str) -> String {
    let (mut lines, mut columns, mut skipped) = (Vec::new(), Vec::new(), None);
    let (mut count, mut depth) = (0, 0);
    let (hierarchy, motion) = text.split_once("MOTION").unwrap();
    for line in hierarchy.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.first() == Some(&"JOINT") && words[1].to_lowercase().contains("toe") {
            skipped = Some(depth);
            lines.push("End Site".to_owned());
        }
        let keeps = skipped.is_none_or(|_| words[0] == "{" || words[0] == "}" || words[0] == "OFFSET");
        match words[0] {
            "CHANNELS" => {
                let channels: usize = words[1].parse().unwrap();
                columns.extend(std::iter::repeat_n(skipped.is_none(), channels));
                count += channels;
            }
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        // The first offset of the skipped part is kept, in separate braces.
        let inner = skipped.is_some_and(|begin| depth > begin + 1 || (depth == begin + 1 && words[0] == "}"));
        if keeps && !inner {
            lines.push(line.to_owned());
        }
        if skipped == Some(depth) && words[0] == "}" {
            skipped = None;
        }
    }
    assert_eq!(columns.len(), count);
    let mut rows = motion.trim().lines();
    let head = [rows.next().unwrap(), rows.next().unwrap()].join("\n");
    let kept = |row: &str| {
        let values = row.split_whitespace().zip(&columns).filter(|(_, keeps)| **keeps).map(|(value, _)| value);
        values.collect::<Vec<_>>().join(" ")
    };
    format!("{}\nMOTION\n{head}\n{}\n", lines.join("\n"), rows.map(kept).collect::<Vec<_>>().join("\n"))
}

/// Returns the step duration of the only style that `train-walk` finds in a file, seconds.
fn step_secs(folder: &Path, text: &str) -> f64 {
    std::fs::write(folder.join("walk_own_1.bvh"), text).unwrap();
    strut_ok(folder, &["train-walk", "walk_own_1.bvh", "-o", "m.strutwalk", "--json", "r.json"]);
    strut_ok(folder, &["walk", "--model", "m.strutwalk", "--style", "own", "-o", "out.bvh"]);
    let report: serde_json::Value = serde_json::from_slice(&std::fs::read(folder.join("r.json")).unwrap()).unwrap();
    report["styles"][0]["step_secs"].as_f64().unwrap()
}

#[test]
fn one_clip_is_enough_at_any_rate_and_without_toes() {
    let folder = tempfile::tempdir().unwrap();
    let walk = demo_walk();
    let expected = step_secs(folder.path(), &bvh_of(&walk));
    for (name, text) in [("25 fps", bvh_of(&walk.resampled(25.0).unwrap())), ("no toes", without_toes(&bvh_of(&walk)))]
    {
        let found = step_secs(folder.path(), &text);
        assert!((found / expected - 1.0).abs() < 0.02, "{name}: {found} s for {expected} s");
    }
}

#[test]
fn what_holds_no_walk_is_left_out_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let walk = demo_walk();
    let standing = HumanoidMotion { poses: vec![walk.poses[0]; 90], ..walk.clone() };
    std::fs::write(path.join("walk_still_1.bvh"), bvh_of(&standing)).unwrap();
    assert_refused(path, &["train-walk", "walk_still_1.bvh", "-o", "m.strutwalk"], "walk_still_1.bvh");
    assert_refused(path, &["train-walk", "walk_still_1.bvh", "-o", "m.strutwalk"], "a walk of at least");

    // With other clips it is a warning.
    std::fs::write(path.join("walk_own_1.bvh"), bvh_of(&walk)).unwrap();
    let output = strut(path, &["train-walk", "walk_still_1.bvh", "walk_own_1.bvh", "-o", "m.strutwalk"]);
    let warning = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && warning.contains("walk_still_1.bvh"), "{warning}");
    assert_refused(path, &["walk", "--model", "m.strutwalk", "--style", "still", "-o", "x.bvh"], "no style 'still'");
}

#[test]
fn takes_that_differ_much_are_styles_of_their_own() {
    let Some(mocap) = mocap::folder() else { return };
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("m.strutwalk").display().to_string();
    let clips = mocap::clips_of(&mocap, "bandai-namco-1");
    let mut args = vec!["train-walk", "--pattern", "{set}_{action}_{style}_{take}.bvh", "-o", &model];
    args.extend(clips.iter().map(|clip| clip.to_str().unwrap()));
    let printed = strut_ok(folder.path(), &args);
    // The prototype considers the takes of these four styles similar, and those of proud the farthest apart.
    for style in ["active,", "giant,", "masculinity,", "proud A, proud B", "tired)"] {
        assert!(printed.contains(style), "{style} in {printed}");
    }
    strut_ok(folder.path(), &["walk", "--model", &model, "--style", "proud=0.5,proud B=0.5", "-o", "out.bvh"]);
}
