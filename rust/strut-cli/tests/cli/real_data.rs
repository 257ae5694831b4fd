//! Acceptance criteria on real motion capture, if it is present (`STRUT_MOCAP`).

use crate::common::{all_clips, body_of, mocap, read_bvh, strut_ok};
use rayon::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use strut_core::{contact, metrics};
use strut_formats::bvh::Bvh;

/// Returns the mean horizontal speed of planted feet, cm/s, with contacts detected in the file's own motion.
fn skate_cm_s(file: &Bvh) -> f32 {
    let body = body_of(&file.to_motion().unwrap());
    100.0 * metrics::foot_skate(&body, &contact::label(&body))
}

/// A folder with a database of all 245 clips of `bandai-namco-2` as `bn2.strutdb`.
struct Built {
    folder: tempfile::TempDir,
    report: Value,
}

/// Builds the folder once for all tests.
fn bandai_namco_2(folder_of_sets: &Path) -> &'static Built {
    static BUILT: OnceLock<Built> = OnceLock::new();
    BUILT.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let clips = mocap::clips_of(folder_of_sets, "bandai-namco-2");
        let clips: Vec<&str> = clips.iter().map(|clip| clip.to_str().unwrap()).collect();
        let args = ["build-db", "-o", "bn2.strutdb", "--neutral", "normal", "--json", "build.json"];
        let pattern = ["--pattern", "{set}_{action}_{style}_{take}.bvh"];
        strut_ok(folder.path(), &[&args[..], &pattern, &clips].concat());
        let report = serde_json::from_slice(&fs::read(folder.path().join("build.json")).unwrap()).unwrap();
        Built { folder, report }
    })
}

/// Styles a clip into a file of the folder.
fn stylize(folder: &Path, input: &Path, style: &str, output: &str, more: &[&str]) -> Bvh {
    let input = input.to_str().unwrap();
    let args = ["stylize", "--db", "bn2.strutdb", "--input", input, "--style", style, "-o", output];
    strut_ok(folder, &[&args[..], more].concat());
    read_bvh(&folder.join(output))
}

#[test]
fn a_neutral_walk_becomes_elderly_active_and_exhausted() {
    let Some(mocap) = mocap::folder() else { return };
    let Built { folder, report } = bandai_namco_2(&mocap);
    let totals = &report["totals"];
    assert_eq!(totals["clips"].as_u64().unwrap() + totals["refused"].as_u64().unwrap(), 245);
    // The clips that turn in the opposite direction are label errors of the data set.
    let refused: Vec<&str> =
        report["refused"].as_array().unwrap().iter().map(|r| r["file"].as_str().unwrap()).collect();
    let wrong =
        ["left_masculine_006", "left_masculine_007", "right_masculine_006", "right_masculine_007", "right_normal_004"];
    assert_eq!(refused.len(), wrong.len(), "{refused:?}");
    assert!(wrong.iter().all(|w| refused.iter().any(|r| r.ends_with(&format!("walk-turn-{w}.bvh")))), "{refused:?}");

    let path = mocap.join("bandai-namco-2/dataset-2_walk_normal_001.bvh");
    let input = read_bvh(&path);
    let input_skate = skate_cm_s(&input);
    for (style, expected_ratio) in [("elderly", 0.92), ("active", 0.83), ("exhausted", 0.97)] {
        let output = stylize(folder.path(), &path, style, "styled.bvh", &["--trace", "trace.jsonl"]);
        strut_ok(folder.path(), &["inspect", "styled.bvh"]);
        assert_eq!(output.joints, input.joints, "{style}");
        let ratio = output.frames as f64 / input.frames as f64;
        let skate = skate_cm_s(&output);
        let walking = mean_walking_weight(&folder.path().join("trace.jsonl"));
        println!("{style}: ratio {ratio:.3}, skate {skate:.2} cm/s (input {input_skate:.2}), walking {walking:.3}");
        assert!((ratio - expected_ratio).abs() <= 0.04, "{style}: {ratio}");
        assert!(skate <= 1.4 && skate <= input_skate, "{style}: {skate} cm/s, input {input_skate}");
        assert!(walking >= 0.85, "{style}: {walking}");
    }
}

#[test]
fn exhausted_turns_are_named_with_the_clips_of_their_two_manners() {
    let Some(mocap) = mocap::folder() else { return };
    let Built { folder, report } = bandai_namco_2(&mocap);
    strut_ok(folder.path(), &["inspect", "bn2.strutdb", "--json", "inspect.json"]);
    let inspected: Value = serde_json::from_slice(&fs::read(folder.path().join("inspect.json")).unwrap()).unwrap();
    assert_eq!(inspected["two_manners"], report["two_manners"]);
    let found = report["two_manners"].as_array().unwrap();
    assert_eq!(found.len(), 2, "{found:?}");
    for (entry, action) in found.iter().zip(["walk-turn-left", "walk-turn-right"]) {
        assert_eq!((&entry["action"], &entry["style"]), (&action.into(), &"exhausted".into()));
        let clips = |takes: [u32; 4]| takes.map(|take| format!("dataset-2_{action}_exhausted_{take:03}"));
        assert_eq!(entry["clips"], serde_json::json!([clips([1, 2, 3, 4]), clips([5, 6, 7, 8])]));
    }
}

/// Returns the mean weight of the classes whose action is a walk.
fn mean_walking_weight(trace: &Path) -> f64 {
    let text = fs::read_to_string(trace).unwrap();
    let weight = |line: &str| -> f64 {
        let line: Value = serde_json::from_str(line).unwrap();
        let weights = line["class_weights"].as_object().unwrap();
        weights.iter().filter(|(class, _)| class.starts_with("walk")).map(|(_, w)| w.as_f64().unwrap()).sum()
    };
    text.lines().map(weight).sum::<f64>() / text.lines().count() as f64
}

/// Returns clips of all data sets. All 460 take twenty minutes: every ninth, or all with `STRUT_ALL_CLIPS=1`.
fn clips(mocap: &Path) -> Vec<PathBuf> {
    let step = if all_clips() { 1 } else { 9 };
    mocap::clips_of(mocap, "").into_iter().step_by(step).collect()
}

#[test]
fn clips_of_every_kind_are_styled() {
    let Some(mocap) = mocap::folder() else { return };
    let folder = &bandai_namco_2(&mocap).folder;
    clips(&mocap).par_iter().enumerate().for_each(|(i, path)| {
        let input = read_bvh(path);
        // Reading refuses numbers that are not finite.
        let output = stylize(folder.path(), path, "elderly", &format!("out-{i}.bvh"), &[]);
        assert_eq!(output.joints, input.joints, "{}", path.display());
        assert_eq!(output.frame_time_secs, input.frame_time_secs, "{}", path.display());
    });
}

#[test]
fn the_built_in_motions_are_as_smooth_as_recorded_ones() {
    let Some(mocap) = mocap::folder() else { return };
    let folder = tempfile::tempdir().unwrap();
    let recordings = mocap.to_str().unwrap();
    let args = ["demo-db", "-o", "demo.strutdb", "--report", "report.md", "--recordings", recordings];
    strut_ok(folder.path(), &args);
    let report = fs::read_to_string(folder.path().join("report.md")).unwrap();
    println!("{report}");
    let jerk = report.split("## Skate, anatomy, jerk").nth(1).unwrap();
    // Measured values; both the motions and the recordings are fixed.
    for (action, measured) in [("walk", 1.39), ("run", 1.47), ("jump", 1.02), ("punch", 1.52), ("kick", 0.61)] {
        let row = jerk.lines().find(|l| l.starts_with(&format!("| {action} |"))).unwrap();
        let ratio: f32 = row.split('|').nth_back(1).unwrap().trim().parse().unwrap();
        assert!((ratio / measured - 1.0_f32).abs() < 0.1, "{row}");
    }
}

/// Returns the codes of the notes on clips that are styled with the built-in database, by clip.
fn noted(folder: &Path, more: &[&str]) -> Vec<(String, Vec<String>)> {
    let args =
        ["stylize", "--db", "demo.strutdb", "--input", "in", "--style", "old", "-o", "out", "--json", "out.json"];
    strut_ok(folder, &[&args[..], more].concat());
    let report: Value = serde_json::from_slice(&fs::read(folder.join("out.json")).unwrap()).unwrap();
    let codes = |clip: &Value| {
        let notes = clip["notes"].as_array().unwrap().iter();
        notes.map(|note| note["code"].as_str().unwrap().to_owned()).collect()
    };
    report.as_array().unwrap().iter().map(|clip| (clip["input"].as_str().unwrap().to_owned(), codes(clip))).collect()
}

/// Recordings are far from the database if it lacks their action, as for half of them, but not as far as misread files.
#[test]
fn what_is_read_wrongly_is_noted_and_no_recording_is() {
    let Some(mocap) = mocap::folder() else { return };
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    fs::write(at.join("demo.strutdb"), crate::common::demo_database()).unwrap();
    fs::create_dir(at.join("in")).unwrap();
    for set in ["bandai-namco-1", "bandai-namco-2", "xia", "cmu"] {
        for clip in mocap::clips_of(&mocap, set).iter().step_by(41) {
            fs::copy(clip, at.join("in").join(clip.file_name().unwrap())).unwrap();
        }
    }
    for (clip, codes) in noted(at, &[]) {
        assert!(codes.is_empty(), "{clip}: {codes:?}");
    }
    for wrong in [["--up", "x"], ["--floor", "-0.93"]] {
        for (clip, codes) in noted(at, &wrong) {
            assert!(codes.iter().any(|code| code == "unfamiliar"), "{clip} with {wrong:?}: {codes:?}");
        }
    }
}
