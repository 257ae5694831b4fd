//! The commands on valid input: the built-in motions.

use crate::common::{assert_refused, demo_database, demo_walk, names, strut, strut_ok};
use serde_json::Value;
use std::fs;
use std::path::Path;
use strut_formats::bvh;

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// Creates a folder with `demo.strutdb` and `in.bvh`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("demo.strutdb"), demo_database()).unwrap();
    fs::write(folder.path().join("in.bvh"), demo_walk()).unwrap();
    folder
}

fn stylize(folder: &Path, style: &str, more: &[&str]) -> bvh::Bvh {
    let args = ["stylize", "--db", "demo.strutdb", "--input", "in.bvh", "--style", style, "-o", "out.bvh"];
    strut_ok(folder, &[&args[..], more].concat());
    bvh::parse(&fs::read(folder.join("out.bvh")).unwrap()).unwrap()
}

/// Clips that stand half a metre above the ground are lowered to it, with a note, or with an explicit floor without a
/// note.
#[test]
fn clips_of_a_database_are_read_as_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    strut_ok(at, &["demo-db", "--page", "-o", "demo.strutdb", "--bvh", "demo"]);
    fs::create_dir(at.join("clips")).unwrap();
    for name in names(&at.join("demo")).iter().filter(|name| name.contains("walk_old")) {
        let mut file = bvh::parse(&fs::read(at.join("demo").join(name)).unwrap()).unwrap();
        let channels = file.channels();
        let up = file.joints[0].channels.iter().position(|c| *c == bvh::Channel::Position(bvh::Axis::Y)).unwrap();
        file.values.iter_mut().skip(up).step_by(channels).for_each(|y| *y += 50.0);
        fs::write(at.join("clips").join(name), bvh::write(&file)).unwrap();
    }
    let build = ["build-db", "clips", "-o", "built.strutdb", "--json", "build.json"];
    let codes = |more: &[&str]| {
        strut_ok(at, &[&build[..], more].concat());
        let report = json(&at.join("build.json"));
        let notes = |clip: &Value| clip["notes"].as_array().unwrap().iter().map(|note| note["code"].clone()).collect();
        report["clips"].as_array().unwrap().iter().flat_map(|clip| -> Vec<Value> { notes(clip) }).collect::<Vec<_>>()
    };
    assert!(!codes(&[]).is_empty() && codes(&[]).iter().all(|code| code == "floor"), "{:?}", codes(&[]));
    assert!(codes(&["--floor", "0.5"]).is_empty());
}

#[test]
fn the_built_in_database_is_written_and_can_be_built_from_its_own_files() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    assert!(
        strut_ok(at, &["demo-db", "--page", "-o", "demo.strutdb", "--bvh", "clips"])
            .contains("styles angry, childlike")
    );
    let clips = names(&at.join("clips")).len();
    assert_eq!(clips, strut_demo::clips().len());
    // Two styles are sufficient.
    for name in names(&at.join("clips")) {
        if !(name.starts_with("walk_neutral") || name.starts_with("walk_old")) {
            fs::remove_file(at.join("clips").join(name)).unwrap();
        }
    }
    fs::write(at.join("clips/notes_of_1.bvh"), "no motion").unwrap();
    let outputs = ["-o", "built.strutdb", "--json", "build.json", "--report", "build.md"];
    let out = strut_ok(at, &[&["build-db", "clips"], &outputs[..]].concat());
    assert!(out.starts_with("built.strutdb: 4 clips (1 refused), "), "{out}");
    let report = json(&at.join("build.json"));
    assert_eq!(report["totals"]["clips"], 4);
    assert_eq!(report["neutral"], "neutral");
    assert_eq!(report["refused"][0]["file"], "clips/notes_of_1.bvh");
    assert!(report["clips"][0]["cycles"].as_u64().unwrap() > 5, "{}", report["clips"][0]);
    assert!(report["clips"][0]["registration_cost"].as_f64().unwrap() > 0.0);

    // A cycle begins at a strike of the left foot; the right foot strikes half a cycle later.
    let contact = &report["actions"][0]["canonical_contact"];
    let planted = |side: &str, part: f64| {
        let shares = contact[side].as_array().unwrap();
        shares[(part * shares.len() as f64) as usize].as_f64().unwrap()
    };
    for (left, right, part) in [(1.0, 0.0, 0.25), (0.0, 1.0, 0.75)] {
        assert!(
            (planted("left", part) - left).abs() < 0.2 && (planted("right", part) - right).abs() < 0.2,
            "{contact}"
        );
    }
    for clip in report["clips"].as_array().unwrap() {
        assert!(clip["contact_agreement_percent"].as_f64().unwrap() > 85.0, "{clip}");
        assert!(
            clip["residual_cm"].as_f64().unwrap() > 0.0 && clip["residual_ratio"].as_f64().unwrap() > 0.0,
            "{clip}"
        );
    }
    let table = fs::read_to_string(at.join("build.md")).unwrap();
    assert!(table.contains("- `clips/notes_of_1.bvh`: ") && table.contains("\n| walk | cycles | "), "{table}");
    assert_eq!(table.lines().filter(|l| l.starts_with("| walk_")).count(), 4, "{table}");

    strut_ok(at, &["inspect", "built.strutdb", "--json", "inspect.json"]);
    let inspected = json(&at.join("inspect.json"));
    assert_eq!((&inspected["kind"], &inspected["rate_hz"]), (&"database".into(), &60.0.into()));
    assert_eq!(inspected["frames"], report["totals"]["frames"]);
    assert_eq!(inspected["classes"].as_array().unwrap().len(), 2);
}

#[test]
fn inspect_describes_a_clip() {
    let folder = folder();
    let text = strut_ok(folder.path(), &["inspect", "in.bvh", "--json", "in.json"]);
    assert!(text.contains("21 joints, 66 channels") && text.contains("120 frames at 60.0"), "{text}");
    let report = json(&folder.path().join("in.json"));
    assert_eq!((&report["kind"], &report["frames"]), (&"bvh".into(), &120.into()));
    assert_eq!(report["joints"][15]["role"], "left_foot");
    assert_eq!(report["contacts"].as_array().unwrap().len(), 120);
    assert!((report["humanoid"]["metres_per_unit"].as_f64().unwrap() - 0.01).abs() < 1e-6);
}

#[test]
fn styling_keeps_the_hierarchy_and_rate_and_changes_the_motion() {
    let folder = folder();
    let input = bvh::parse(demo_walk().as_bytes()).unwrap();
    let old = stylize(folder.path(), "old", &[]);
    assert_eq!((&old.joints, old.frame_time_secs), (&input.joints, input.frame_time_secs));
    assert!(old.values.iter().all(|v| v.is_finite()));
    let untimed = stylize(folder.path(), "old", &["--timing", "off"]);
    assert!(untimed.frames.abs_diff(input.frames) <= 1, "{} frames of {}", untimed.frames, input.frames);
    assert_ne!(untimed.values, stylize(folder.path(), "old=0.5", &["--timing", "off"]).values);
    assert_ne!(untimed.values, stylize(folder.path(), "old", &["--timing", "off", "--part", "arms:proud"]).values);
    assert_eq!(names(folder.path()), ["demo.strutdb", "in.bvh", "out.bvh"]);
}

#[test]
fn the_trace_has_a_line_a_frame() {
    let folder = folder();
    stylize(
        folder.path(),
        "old=0.5,proud=0.5",
        &["--trace", "t.jsonl", "--action", "walk", "--input-style", "neutral"],
    );
    let text = fs::read_to_string(folder.path().join("t.jsonl")).unwrap();
    let lines: Vec<Value> = text.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!(lines.len(), 120);
    let line = &lines[60];
    assert_eq!(line["frame"], 60);
    assert!((line["time_in"].as_f64().unwrap() - 1.0).abs() < 1e-6);
    assert!(line["time_out"].as_f64().unwrap() > 0.5 && line["dt"].as_f64().unwrap() > 0.0);
    let weights = line["class_weights"].as_object().unwrap();
    assert!(weights.len() == 1 && (weights["walk/neutral"].as_f64().unwrap() - 1.0).abs() < 1e-5, "{weights:?}");
    assert!(line["neighbours"][0][0].as_str().unwrap().contains("neutral"));
    assert!(line["neighbours"][0][2].as_f64().unwrap() >= 0.0 && line["bias"].as_f64().unwrap() >= 0.0);
    assert_eq!(line["contact"].as_array().unwrap().len(), 2);
    assert!(line["cost_us"]["search"].as_f64().unwrap() > 0.0);
}

#[test]
fn the_same_command_gives_the_same_bytes() {
    let folder = folder();
    let first = stylize(folder.path(), "old", &[]);
    assert_eq!(first, stylize(folder.path(), "old", &[]));
}

#[test]
fn threads_change_nothing_about_a_clip() {
    let folder = folder();
    let at = folder.path();
    // Long enough for several portions per thread, and of several classes.
    let motions = ["run", "kick", "jump"].map(|action| {
        let clips = strut_demo::clips();
        clips.into_iter().find(|clip| clip.action == action && clip.style == "proud").unwrap().motion
    });
    let mut motion = motions[0].clone();
    motion.poses.extend(motions[1..].iter().flat_map(|m| m.poses.iter().copied()));
    assert!(motion.poses.len() > 1000);
    fs::write(at.join("in.bvh"), bvh::write(&bvh::Bvh::from_humanoid(&motion).unwrap())).unwrap();
    for more in [&[][..], &["--action", "run"], &["--method", "knn", "--part", "arms:childlike"]] {
        let styled = |threads| {
            stylize(at, "old=0.8,angry=0.4", &[more, &["--threads", threads]].concat());
            fs::read(at.join("out.bvh")).unwrap()
        };
        let serial = styled("1");
        for threads in ["2", "5"] {
            assert!(styled(threads) == serial, "{threads} threads, {more:?}");
        }
    }
    // With a trace the frames are searched and timed one after the other.
    let serial = stylize(at, "old", &["--threads", "2"]);
    assert!(stylize(at, "old", &["--threads", "2", "--trace", "t.jsonl"]) == serial);
}

#[test]
fn many_clips_are_styled_as_one_by_one() {
    let folder = folder();
    let at = folder.path();
    fs::create_dir_all(at.join("clips/below")).unwrap();
    for (i, name) in ["a", "b", "c", "below/d"].iter().enumerate() {
        let mut motion = strut_demo::input_clips().remove(0).motion;
        motion.poses.drain(..10 * i);
        motion.poses.truncate(60 + 40 * i);
        let text = bvh::write_text(&bvh::Bvh::from_humanoid(&motion).unwrap());
        fs::write(at.join(format!("clips/{name}.bvh")), text).unwrap();
    }
    let db = ["stylize", "--db", "demo.strutdb", "--style", "old"];
    let many = |inputs: &[&str], output: &str, threads: &str| {
        strut_ok(at, &[&db[..], &["--threads", threads, "-o", output, "--input"], inputs].concat())
    };
    let said = many(&["clips"], "serial", "1");
    assert_eq!(names(&at.join("serial")), ["a.bvh", "b.bvh", "c.bvh", "d.bvh"]);
    assert_eq!(said.lines().count(), 4);
    // Fewer clips than threads, and more.
    for threads in ["2", "8"] {
        let output = format!("with_{threads}");
        assert_eq!(many(&["clips"], &output, threads).replace(&output, "serial"), said);
        for name in names(&at.join("serial")) {
            let [a, b] = ["serial", &output].map(|folder| fs::read(at.join(folder).join(&name)).unwrap());
            assert!(a == b, "{name} with {threads} threads");
        }
    }
    strut_ok(at, &[&db[..], &["--input", "clips/c.bvh", "-o", "c.bvh"]].concat());
    assert!(fs::read(at.join("c.bvh")).unwrap() == fs::read(at.join("serial/c.bvh")).unwrap());
    many(&["clips/a.bvh", "clips/b.bvh"], "two", "2");
    assert_eq!(names(&at.join("two")), ["a.bvh", "b.bvh"]);

    fs::write(at.join("clips/b.bvh"), "no motion").unwrap();
    let refused = |output: &str, expected: &str| {
        assert_refused(at, &[&db[..], &["--input", "clips", "-o", output]].concat(), expected);
    };
    refused("new", "clips/b.bvh: line 1, column 1 has 'no'");
    refused("two", "clips/b.bvh: line 1, column 1 has 'no'");
    assert_eq!(names(&at.join("two")), ["a.bvh", "b.bvh"]);
    refused("in.bvh", "in.bvh: a folder for the outputs of several inputs was expected");
    refused("nowhere/new", "nowhere/new: there is no such file or folder");
    refused("clips", "clips/a.bvh: this is an input; another folder was expected");
    fs::write(at.join("clips/below/a.bvh"), "").unwrap();
    refused("new", "a.bvh: two outputs have this name");
    assert_eq!(strut(at, &[&db[..], &["--input", "clips", "-o", "x", "--trace", "t"]].concat()).status.code(), Some(2));
}

#[test]
fn every_method_styles_and_none_gives_the_same_as_another() {
    let folder = folder();
    let mut outputs: Vec<(&str, bvh::Bvh)> = Vec::new();
    for method in ["mar", "lar", "nn", "knn", "gar", "lti", "lti-dof", "gp"] {
        let output = stylize(folder.path(), "old", &["--method", method, "--action", "walk"]);
        assert!(output.frames > 60 && output.frames < 240, "{method}: {} frames", output.frames);
        if let Some((other, _)) = outputs.iter().find(|(_, o)| *o == output) {
            panic!("{method} gives what {other} gives");
        }
        outputs.push((method, output));
    }
}

#[test]
fn a_clip_becomes_a_style_that_others_can_be_given() {
    let folder = folder();
    let at = folder.path();
    let walk = bvh::Bvh::from_humanoid(&strut_demo::input_clips().remove(0).motion).unwrap();
    fs::write(at.join("long.bvh"), bvh::write(&walk)).unwrap();
    let args = ["add-style", "--db", "demo.strutdb", "--input", "long.bvh", "--style"];
    let said = strut_ok(at, &[&args[..], &["weary", "-o", "more.strutdb"]].concat());
    assert!(said.starts_with("more.strutdb: added style 'weary' to action 'walk'"), "{said}");
    strut_ok(at, &["stylize", "--db", "more.strutdb", "--input", "in.bvh", "--style", "weary", "-o", "out.bvh"]);
    assert_refused(at, &[&args[..], &["old", "-o", "x.strutdb"]].concat(), "already has a style 'old'");
}

#[test]
fn an_action_that_is_given_is_taken_with_a_note_where_the_clip_fits_it_badly() {
    let folder = folder();
    let at = folder.path();
    let clips = strut_demo::clips();
    let walk = clips.iter().find(|clip| (clip.action.as_str(), clip.style.as_str()) == ("walk", "old")).unwrap();
    fs::write(at.join("walk.bvh"), bvh::write(&bvh::Bvh::from_humanoid(&walk.motion).unwrap())).unwrap();
    let args = ["add-style", "--db", "demo.strutdb", "--input", "walk.bvh", "--style", "weary", "--action"];
    let output = strut(at, &[&args[..], &["run", "-o", "more.strutdb"]].concat());
    let [said, noted] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(said.starts_with("more.strutdb: added style 'weary' to action 'run'"), "{said} {noted}");
    let doubt = "its motion differs so much from the clips of 'run' that the style may look wrong; it fits 'walk'";
    assert_eq!(noted.trim_end(), format!("note: walk.bvh: {doubt}"));
    let refused = "it does not fit 'jump': it contains walking or running, unlike the other clips of the action; it \
                   fits 'walk'";
    assert_refused(at, &[&args[..], &["jump", "-o", "x.strutdb"]].concat(), refused);
    assert_refused(at, &[&args[..], &["rnu", "-o", "x.strutdb"]].concat(), "'run'");
}

#[test]
fn walks_are_learnt_and_walked_in_any_mixture() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    strut_ok(at, &["demo-db", "--page", "-o", "demo.strutdb", "--bvh", "clips"]);
    fs::write(at.join("clips/walk_sad_001.bvh"), "no motion").unwrap();
    let out = strut_ok(at, &["train-walk", "clips", "-o", "walks.strutwalk", "--json", "train.json"]);
    assert!(out.starts_with("walks.strutwalk: 8 styles (angry, childlike, "), "{out}");
    let report = json(&at.join("train.json"));
    assert!(report["refused"][0]["file"].as_str().unwrap().ends_with("walk_sad_001.bvh"));
    assert!(report["styles"].as_array().unwrap().iter().all(|s| s["steps"].as_u64().unwrap() > 10));

    let walk = |more: &[&str]| {
        let args = ["walk", "--model", "walks.strutwalk", "-o", "walk.bvh"];
        strut_ok(at, &[&args[..], more].concat());
        bvh::parse(&fs::read(at.join("walk.bvh")).unwrap()).unwrap().to_motion().unwrap()
    };
    let steps = ["--style", "proud=0.5,old=-0.5", "--steps", "10", "--cadence", "120"];
    assert!(walk(&steps).frames().abs_diff(150) <= 4);
    let transition = ["--style", "old", "--transition", "proud@4:2", "--turn", "5"];
    assert_ne!(walk(&transition).rotations, walk(&["--style", "old", "--turn", "5"]).rotations);

    let refused = |args: &[&str], expected: &str| {
        assert_refused(at, &[&["walk", "-o", "new.bvh", "--model"], args].concat(), expected);
    };
    refused(&["walks.strutwalk", "--style", "prod"], "there is no style 'prod'; did you mean 'proud'?");
    refused(&["demo.strutdb", "--style", "old"], "it has no 'strut-walk' metadata");
    refused(&["clips/walk_old_001.bvh", "--style", "old"], "this is not a walk model");
    let standing = ["train-walk", "clips/walk_sad_001.bvh", "-o", "new.strutwalk"];
    assert_refused(at, &standing, "walk_sad_001.bvh");
}
