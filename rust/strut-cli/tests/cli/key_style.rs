//! Key-styling: the commands on the built-in walk, and held-out errors on real motion capture, if it is present
//! (`STRUT_MOCAP`).

use crate::common::{assert_refused, body_of, demo_walk, mocap, read_bvh, strut_ok};
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;
use std::sync::Arc;
use strut_core::contact::label;
use strut_core::humanoid::HumanoidMotion;
use strut_core::math::Vec3;
use strut_core::math::float_funcs::double;
use strut_core::metrics::foot_skate;
use strut_core::retarget::to_humanoid;
use strut_core::somn::{
    DragCharacter, Interpolation, Key, KeyStyleModel, KeyStyling, Measure, Method, Mode, Options, RATE_HZ, Recording,
    Synthesis, train,
};
use strut_evaluation::key_style::{Observed, pose_error};
use strut_formats::corpus::Clip;
use strut_formats::key_style_model;

const AXES: &str = "foot_separation,foot_height_difference";

/// Creates a folder with the built-in walk as `walk.bvh` and a circle of steps as `keys.csv`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("walk.bvh"), demo_walk()).unwrap();
    fs::write(folder.path().join("keys.csv"), circle(40)).unwrap();
    folder
}

/// Returns keys on a circle of foot styles: 5 per turn of 35 frames.
fn circle(keys: usize) -> String {
    let key = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / 5.0;
        format!("{:.4},{:.2},{:.2}\n", i as f64 * 7.0 / 30.0, 45.0 * double::cos(angle), -10.0 * double::sin(angle))
    };
    format!("time,{AXES}\n{}", (0..keys).map(key).collect::<String>())
}

#[test]
fn a_few_numbers_walk() {
    let folder = folder();
    let at = folder.path();
    let train = ["train-key-style", "walk.bvh", "--axes", AXES, "--seed", "3", "--json", "report.json"];
    let out = strut_ok(at, &[&train[..], &["-o", "m.strutkeys"]].concat());
    assert!(out.starts_with("m.strutkeys: 4 components from 60 frames of 1 clip in "), "{out}");
    strut_ok(at, &[&train[..6], &["-o", "again.strutkeys"]].concat());
    assert_eq!(fs::read(at.join("m.strutkeys")).unwrap(), fs::read(at.join("again.strutkeys")).unwrap());
    let model = key_style_model::read(&fs::read(at.join("m.strutkeys")).unwrap()).unwrap();
    assert!(model.travels);

    for more in [&[][..], &["--interpolation", "monotone"], &["--mode", "hard"]] {
        let out = strut_ok(
            at,
            &[&["key-style", "--model", "m.strutkeys", "--keys", "keys.csv", "-o", "out.bvh"], more].concat(),
        );
        assert!(out.starts_with("out.bvh: 40 keys, 274 frames, 9.1 s"), "{out}");
        let body = body_of(&read_bvh(&at.join("out.bvh")).to_motion().unwrap());
        assert_eq!(body.poses.len(), 274);
        let way = body.poses[273].root.z - body.poses[0].root.z;
        assert!(way > 4.0, "{way}");
    }
    // Every saved model can be used, with expectation maximisation too.
    strut_ok(
        at,
        &["train-key-style", "walk.bvh", "--axes", "hips.y - foot_l.y", "--method", "em", "-o", "em.strutkeys"],
    );
    fs::write(at.join("one.csv"), "time,hips.y-foot_l.y\n0,80\n1,84\n").unwrap();
    strut_ok(at, &["key-style", "--model", "em.strutkeys", "--keys", "one.csv", "-o", "out.bvh"]);
}

#[test]
fn whatever_is_wrong_is_said_in_a_sentence() {
    let folder = folder();
    let at = folder.path();
    let refuse = |input: &str, axes: &str, expected: &str| {
        assert_refused(at, &["train-key-style", input, "--axes", axes, "-o", "new.strutkeys"], expected);
    };
    refuse(
        "walk.bvh",
        "foot_separation,hand_l.y - sholder_l.y",
        "column 28: there is no joint, measure or function 'sholder_l'",
    );
    refuse("walk.bvh", "hips_heigth", "did you mean 'hips_height'?");
    refuse("walk.bvh", "(hips.y", "column 8: the end; an operator or ')' was expected");
    refuse("walk.bvh", "hips.x", "the style variable 'hips.x' is 0.0 cm in every frame");
    refuse("walk.bvh", "1/hips.x", "'1/hips.x' has no value in frame 1 of 'walk'");
    refuse("walk.bvh", "foot_l.x,foot_l.y,foot_l.z,hips.y", "4 style variables were given; 1 to 3 were expected");
    refuse("nothing.bvh", "hips.y", "nothing.bvh: there is no such file or folder");

    let walk = demo_walk();
    let lines: Vec<&str> = walk.lines().collect();
    let motion = lines.iter().position(|l| *l == "MOTION").unwrap();
    let cut = |frames: usize, change: &dyn Fn(usize, &str) -> String| {
        let frame = |i: usize| change(i, lines[motion + 3 + i]) + "\n";
        let (hierarchy, time) = (lines[..=motion].join("\n"), lines[motion + 2]);
        format!("{hierarchy}\nFrames: {frames}\n{time}\n{}", (0..frames).map(frame).collect::<String>())
    };
    fs::write(at.join("short.bvh"), cut(20, &|_, line| line.to_owned())).unwrap();
    refuse("short.bvh", "hips.y", "10 frames together at 30 frames per second; at least 48 were expected");
    fs::write(at.join("two.bvh"), cut(2, &|_, _| lines[motion + 3].to_owned())).unwrap();
    refuse("two.bvh", "hips.y", "at least 48 were expected");
    fs::write(at.join("still.bvh"), cut(110, &|_, _| lines[motion + 3].to_owned())).unwrap();
    refuse("still.bvh", "hips.y", "'hips.y' is ");
    let nan =
        |i: usize, line: &str| if i == 9 { format!("nan {}", line.split_once(' ').unwrap().1) } else { line.into() };
    fs::write(at.join("nan.bvh"), cut(60, &nan)).unwrap();
    refuse("nan.bvh", "hips.y", "nan.bvh: line ");

    strut_ok(at, &["train-key-style", "walk.bvh", "--axes", AXES, "-o", "m.strutkeys"]);
    let refuse = |keys: &str, expected: &str| {
        fs::write(at.join("bad.csv"), keys).unwrap();
        assert_refused(at, &["key-style", "--model", "m.strutkeys", "--keys", "bad.csv", "-o", "out.bvh"], expected);
    };
    refuse(
        &format!("time,{AXES}\n0,1,2\n1,nan,2\n"),
        "bad.csv: line 3: foot_separation is 'nan'; a number was expected",
    );
    refuse("time,foot_separation\n0,1\n", &format!("'time,{AXES}' was expected"));
    refuse(&format!("time,{AXES}\n1,1,2\n0,1,2\n"), "line 3: the time 0 s does not come after the one before");
    refuse(&format!("time,{AXES}\n0,1,2\n90000,1,2\n"), "bad.csv: the keys span 90000 s; at most 3600 s are supported");
    let model = fs::read(at.join("m.strutkeys")).unwrap();
    fs::write(at.join("cut.strutkeys"), &model[..model.len() / 2]).unwrap();
    let with = |model: &str, expected: &str| {
        assert_refused(at, &["key-style", "--model", model, "--keys", "keys.csv", "-o", "out.bvh"], expected);
    };
    with("cut.strutkeys", "cut.strutkeys: the file is cut short or damaged");
    with("walk.bvh", "walk.bvh: this is not a key-style model");
}

/// Reads recordings onto the body of the first.
fn recordings(mocap: &Path, names: impl Iterator<Item = String>) -> Vec<Recording> {
    let mut body = None;
    names
        .map(|name| {
            let clip = Clip::parse(&fs::read(mocap.join(&name)).unwrap()).unwrap();
            let body = *body.get_or_insert(clip.binding.proportions);
            Recording::new(name, &to_humanoid(&clip.motion, &clip.binding, &body)).unwrap()
        })
        .collect()
}

fn walks(mocap: &Path) -> Vec<Recording> {
    recordings(mocap, (1..=8).map(|take| format!("bandai-namco-2/dataset-2_walk_normal_{take:03}.bvh")))
}

/// Trains a model of sixteen components. Returns it with the mean error of its predictions for other recordings,
/// degrees.
fn learnt(training: &[&Recording], test: &[&Recording], axes: &str) -> (Arc<KeyStyleModel>, f64) {
    let options = Options { components: Some(16), ..Options::default() };
    let model = Arc::new(train(training, &Measure::parse_list(axes).unwrap(), options).unwrap());
    let mut synthesis = Synthesis::new(Arc::clone(&model));
    let mut errors = Vec::new();
    for of in test.iter().map(|recording| Observed::new(&model, recording)) {
        for (x, style) in of.rows.iter().zip(&of.styles) {
            errors.push(pose_error(&model.space, &synthesis.row(style, Mode::default()), x)[0]);
        }
    }
    (model, errors.iter().sum::<f64>() / errors.len() as f64)
}

#[test]
fn held_out_poses_are_said_by_a_few_numbers() {
    let Some(mocap) = mocap::folder() else { return };
    let walks = walks(&mocap);
    let (test, training): (Vec<_>, Vec<_>) = walks.iter().enumerate().partition(|(i, _)| *i < 2);
    let [test, training] = [test, training].map(|of| of.into_iter().map(|(_, r)| r).collect::<Vec<_>>());
    let (model, error) = learnt(&training, &test, AXES);
    assert!(model.travels && error < 2.7, "{error}");

    let punches =
        recordings(&mocap, (1..=2).map(|take| format!("bandai-namco-1/dataset-1_punch_normal_{take:03}.bvh")));
    // Every fourth block of twenty frames is held out.
    let blocks = |held: bool| {
        let of = |clip: &Recording| -> Vec<Recording> {
            let blocks = (0..clip.poses.len() / 20).filter(|block| (block % 4 == 3) == held);
            blocks.map(|block| clip.part(20 * block..20 * (block + 1))).collect()
        };
        punches.iter().flat_map(of).collect::<Vec<_>>()
    };
    let (training, test) = (blocks(false), blocks(true));
    let [training, test] = [&training, &test].map(|of| of.iter().collect::<Vec<_>>());
    let (model, error) = learnt(&training, &test, "hips_height, reach_left, reach_right");
    assert!(!model.travels && error < 5.8, "{error}");
}

#[test]
fn a_circle_on_the_pad_walks() {
    let Some(mocap) = mocap::folder() else { return };
    let walks = walks(&mocap);
    let (model, _) = learnt(&walks.iter().collect::<Vec<_>>(), &[], AXES);
    let mut character = DragCharacter::new(Arc::clone(&model));
    let style = |frame: i32| {
        let angle = -TAU * f64::from(frame) / 35.0;
        model.in_units(&[1.35 * double::cos(angle), 1.35 * double::sin(angle), 0.0])
    };
    character.reset(&style(0));
    let poses = (0..350).map(|frame| *character.drag(&style(frame), 1.0 / f64::from(RATE_HZ))).collect();
    let motion = HumanoidMotion { proportions: model.space.proportions, rate_hz: RATE_HZ, poses };
    let way = (motion.poses[349].root - motion.poses[34].root).z / 9.0;
    let skate = foot_skate(&motion, &label(&motion));
    assert!((0.8..1.3).contains(&way) && skate < 0.1, "{way} m a turn, {skate} m/s");
}

#[test]
fn a_run_by_keys_flies_as_far_as_the_recorded_one() {
    let Some(mocap) = mocap::folder() else { return };
    let names: Vec<_> = (1..=8).map(|take| format!("bandai-namco-2/dataset-2_run_normal_{take:03}.bvh")).collect();
    let runs = recordings(&mocap, names.iter().cloned());
    let (model, _) = learnt(&runs.iter().collect::<Vec<_>>(), &[], AXES);
    let way = |motion: &HumanoidMotion| {
        let [first, last] = [motion.poses.first(), motion.poses.last()].map(|pose| pose.unwrap().root);
        ((last - first) * Vec3::new(1.0, 0.0, 1.0)).length()
    };
    for (name, run) in names.iter().zip(&runs).take(3) {
        let clip = Clip::parse(&fs::read(mocap.join(name)).unwrap()).unwrap();
        let recorded = to_humanoid(&clip.motion, &clip.binding, &run.proportions).resampled(RATE_HZ).unwrap();
        // With a key per frame the style is fixed everywhere; only the root is synthesised.
        let styles = Observed::new(&model, run).styles;
        let keys: Vec<_> = styles
            .iter()
            .enumerate()
            .map(|(frame, style)| Key { secs: frame as f64 / f64::from(RATE_HZ), style: *style, row: None })
            .collect();
        let mut synthesis = Synthesis::new(Arc::clone(&model));
        let styling = KeyStyling::new(&keys, Interpolation::default(), &mut synthesis, Mode::KEYED).unwrap();
        let made = styling.motion(&mut synthesis, Method::KeyStyle);
        // With its supporting feet alone the body travels half of the distance.
        let share = way(&made) / way(&recorded);
        assert!((0.85..1.1).contains(&share), "{name}: {share} of the way");
        let highest = |motion: &HumanoidMotion| motion.poses.iter().map(|p| p.root.y).fold(0.0, f32::max);
        assert!((highest(&made) - highest(&recorded)).abs() < 0.03, "{name}: {} m", highest(&made));
    }
}

#[test]
fn a_walk_never_flies() {
    let Some(mocap) = mocap::folder() else { return };
    let walks = walks(&mocap);
    let (model, _) = learnt(&walks.iter().collect::<Vec<_>>(), &[], AXES);
    let synthesis = Synthesis::new(Arc::clone(&model));
    for frame in 0..model.rows.len() {
        let row = model.recorded_row(frame);
        assert_eq!(synthesis.pose_of(&row), model.space.pose(&row));
    }
}
