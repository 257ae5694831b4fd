//! Feet and joints of styled files on real motion capture, where it is present (`STRUT_MOCAP`): a sample of all
//! pairs of clip and style, or all of them with `STRUT_ALL_CLIPS=1`.

mod common;

use common::{all_clips, body_of, mocap_folder, read_bvh, strut_ok};
use rayon::prelude::*;
use std::fs;
use std::path::{Path, PathBuf};
use strut_core::database::Database;
use strut_core::humanoid::{HumanoidMotion, JOINTS, Role};
use strut_core::kinematics::world_from_local;
use strut_core::transfer::{beyond_anatomy, ground_clearance};
use strut_core::{contact, metrics};
use strut_formats::strutdb;

/// The clips of a folder whose names contain a text, sorted.
fn clips(mocap: &Path, set: &str, containing: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(mocap.join(set)).into_iter().flatten();
    let mut clips: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    clips.retain(|p| p.extension().is_some_and(|e| e == "bvh") && p.to_str().unwrap().contains(containing));
    clips.sort();
    clips
}

fn build(folder: &Path, inputs: &[PathBuf], name: &str, neutral: &str, pattern: &str) -> Database {
    let mut args = vec!["build-db", "-o", name, "--neutral", neutral, "--pattern", pattern];
    args.extend(inputs.iter().map(|p| p.to_str().unwrap()));
    strut_ok(folder, &args);
    strutdb::read(&fs::read(folder.join(name)).unwrap()).unwrap()
}

const BANDAI_NAMCO: [&str; 2] = ["normal", "{set}_{action}_{style}_{take}.bvh"];
const XIA: [&str; 2] = ["neutral", "{style}_{action}_{take}.bvh"];

/// A clip before and after.
struct Styled {
    name: String,
    input: HumanoidMotion,
    output: HumanoidMotion,
    trace: PathBuf,
}

/// Styles clips with a database, each in the styles that `wanted` says for its number, and reads what was written.
fn styled(folder: &Path, db: &str, clips: &[PathBuf], wanted: impl Fn(usize) -> Vec<String> + Sync) -> Vec<Styled> {
    let pairs: Vec<(usize, String)> =
        (0..clips.len()).flat_map(|i| wanted(i).into_iter().map(move |s| (i, s))).collect();
    let style = |(i, style): &(usize, String)| {
        let input = &clips[*i];
        let stem = input.file_stem().unwrap().to_str().unwrap();
        let (output, trace) = (format!("{db}-{stem}-{style}.bvh"), format!("{db}-{stem}-{style}.jsonl"));
        let args = ["stylize", "--db", db, "--input", input.to_str().unwrap(), "--style", style, "-o", &output];
        strut_ok(folder, &[&args[..], &["--trace", &trace]].concat());
        let bodies = [input, &folder.join(&output)].map(|path| body_of(&read_bvh(path)));
        let [input, output] = bodies;
        Styled { name: format!("{db} {stem} → {style}"), input, output, trace: folder.join(trace) }
    };
    pairs.par_iter().map(style).collect()
}

/// One of `styles` for each number, in turn; all of them if all are asked for.
fn in_turn(styles: &[String]) -> impl Fn(usize) -> Vec<String> + Sync {
    move |i| if all_clips() { styles.to_vec() } else { vec![styles[i % styles.len()].clone()] }
}

/// By the rule of the specification, §3, applied to the motion itself.
fn skate_cm_s(motion: &HumanoidMotion) -> f32 {
    100.0 * metrics::foot_skate(motion, &contact::label(motion))
}

/// Height of the lowest point of any sole, cm.
fn lowest_sole_cm(motion: &HumanoidMotion) -> f32 {
    100.0 * motion.poses.iter().map(|p| ground_clearance(&motion.proportions, p)).fold(f32::INFINITY, f32::min)
}

/// Greatest acceleration of any joint at 60 Hz, m/s².
fn peak_acceleration(motion: &HumanoidMotion) -> f32 {
    let poses = motion.resampled(60.0).poses;
    let at: Vec<_> = poses.iter().map(|p| world_from_local(&motion.proportions, p).positions).collect();
    let peak =
        |w: &[metrics::Points]| (0..JOINTS).map(|j| (w[2][j] - 2.0 * w[1][j] + w[0][j]).length()).fold(0.0, f32::max);
    at.windows(3).map(peak).fold(0.0, f32::max) * 3600.0
}

#[test]
fn no_style_skates_more_than_its_input_or_sinks() {
    let Some(mocap) = mocap_folder() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut inputs = clips(&mocap, "cmu", "");
    inputs.extend(clips(&mocap, "xia", "").into_iter().step_by(if all_clips() { 1 } else { 3 }));
    for (name, set, [neutral, pattern]) in
        [("bn2.strutdb", "bandai-namco-2", BANDAI_NAMCO), ("xia.strutdb", "xia", XIA)]
    {
        let db = build(folder.path(), &clips(&mocap, set, ""), name, neutral, pattern);
        for s in styled(folder.path(), name, &inputs, in_turn(&db.styles)) {
            let (before, after) = (skate_cm_s(&s.input), skate_cm_s(&s.output));
            let lowest = lowest_sole_cm(&s.output);
            let peaks = [&s.input, &s.output].map(peak_acceleration);
            println!(
                "{:<50} skate {before:5.2} → {after:5.2} cm/s, sole {lowest:5.2} cm, peak {:4.0} → {:4.0} m/s²",
                s.name, peaks[0], peaks[1]
            );
            assert!(after <= before, "{}: {after} cm/s, input {before}", s.name);
            assert!(lowest >= -1.0, "{}: {lowest} cm", s.name);
        }
    }
}

#[test]
fn contacts_of_unseen_takes_are_recognised_and_their_feet_held() {
    let Some(mocap) = mocap_folder() else { return };
    let folder = tempfile::tempdir().unwrap();
    let (held_out, known): (Vec<PathBuf>, Vec<PathBuf>) =
        clips(&mocap, "bandai-namco-2", "").into_iter().partition(|p| p.to_str().unwrap().ends_with("_001.bvh"));
    let [neutral, pattern] = BANDAI_NAMCO;
    let db = build(folder.path(), &known, "known.strutdb", neutral, pattern);
    let is = |p: &&PathBuf, what: &str| p.to_str().unwrap().contains(what);

    let walks: Vec<PathBuf> = held_out.iter().filter(|p| is(p, "_walk_")).cloned().collect();
    let (mut alike, mut all) = (0, 0);
    for s in styled(folder.path(), "known.strutdb", &walks, in_turn(&db.styles)) {
        let labels = contact::label(&s.input.resampled(db.rate_hz));
        let trace = fs::read_to_string(&s.trace).unwrap();
        let (mut own, mut frames) = (0, 0);
        for (line, label) in trace.lines().zip(&labels) {
            let line: serde_json::Value = serde_json::from_str(line).unwrap();
            own += (0..2).filter(|&side| (line["contact"][side].as_f64().unwrap() > 0.5) == label[side]).count();
            frames += 2;
        }
        println!("{}: contacts agree in {:.2} %", s.name, 100.0 * own as f32 / frames as f32);
        (alike, all) = (alike + own, all + frames);
    }
    let agreement = alike as f32 / all as f32;
    println!("contacts of held-out walks agree in {:.2} %", 100.0 * agreement);
    assert!(agreement >= 0.99, "{agreement}");

    let normal: Vec<PathBuf> = held_out.iter().filter(|p| is(p, "_normal_") && !is(p, "wave")).cloned().collect();
    assert_eq!(normal.len(), 4, "walk, run and two turns");
    let others: Vec<String> = db.styles.iter().filter(|s| *s != "normal").cloned().collect();
    let two = |i: usize| if all_clips() { others.clone() } else { others[i % 3 * 2..][..2].to_vec() };
    for s in styled(folder.path(), "known.strutdb", &normal, two) {
        let skate = skate_cm_s(&s.output);
        println!("{}: skate {:.2} → {skate:.2} cm/s", s.name, skate_cm_s(&s.input));
        assert!(skate <= 1.4, "{}: {skate} cm/s", s.name);
    }
}

/// For each joint how far a motion goes beyond what anatomy allows, radians.
fn beyond(rotations: impl Iterator<Item = [strut_core::math::Quat; JOINTS]>) -> [f32; JOINTS] {
    let mut most = [0.0_f32; JOINTS];
    for rotations in rotations {
        for role in Role::ALL {
            most[role.index()] = most[role.index()].max(beyond_anatomy(role, rotations[role.index()]));
        }
    }
    most
}

#[test]
fn one_take_a_class_is_enough_to_stay_within_limits() {
    let Some(mocap) = mocap_folder() else { return };
    let folder = tempfile::tempdir().unwrap();
    let sets = ["cmu", "xia", "bandai-namco-1"];
    let inputs: Vec<PathBuf> = sets.iter().flat_map(|set| clips(&mocap, set, "")).collect();
    let inputs: Vec<PathBuf> = inputs.into_iter().step_by(if all_clips() { 1 } else { 13 }).collect();
    for (name, set, [neutral, pattern]) in
        [("xia.strutdb", "xia", XIA), ("bn1.strutdb", "bandai-namco-1", BANDAI_NAMCO)]
    {
        let db = build(folder.path(), &clips(&mocap, set, ""), name, neutral, pattern);
        let known = beyond(db.pose.iter().map(|row| Role::ALL.map(|role| db.chart.rotation(role, row))));
        for s in styled(folder.path(), name, &inputs, in_turn(&db.styles)) {
            // Reading has refused numbers that are not finite.
            let (before, after) =
                (beyond(s.input.poses.iter().map(|p| p.rotations)), beyond(s.output.poses.iter().map(|p| p.rotations)));
            for role in Role::ALL {
                let allowed = before[role.index()].max(known[role.index()]);
                // Legs bend a little more where feet are held.
                let excess = after[role.index()] - allowed;
                assert!(excess < 0.1, "{}: {} is {excess} rad beyond its limits", s.name, role.name());
            }
            let (hips, legs) = (Role::Hips.index(), s.output.proportions.leg_length());
            for pose in &s.output.poses {
                let height = world_from_local(&s.output.proportions, pose).positions[hips].y;
                assert!((0.0..3.0 * legs).contains(&height), "{}: hips at {height} m", s.name);
            }
        }
    }
}
