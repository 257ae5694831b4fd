//! `strut drive` on the built-in motions.

use crate::common::{assert_refused, demo_database, strut_ok};
use std::fmt::Write;
use std::fs;
use strut_core::math::float_funcs::sin_cos;
use strut_formats::bvh;
use tempfile::TempDir;

fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("db.strutdb"), demo_database()).unwrap();
    folder
}

/// One turn around a circle of 2 m radius, from the origin towards +Z.
fn circle() -> String {
    let mut csv = String::from("x,z\n");
    for i in 0..320 {
        let (sine, cosine) = sin_cos(i as f32 * 0.02);
        writeln!(csv, "{:.4},{:.4}", 2.0 - 2.0 * cosine, 2.0 * sine).unwrap();
    }
    csv
}

#[test]
fn the_styled_character_follows_a_path() {
    let folder = folder();
    fs::write(folder.path().join("path.csv"), circle()).unwrap();
    for style in ["neutral", "old", "proud=0.5,childlike=0.5"] {
        let args = ["drive", "--db", "db.strutdb", "--path", "path.csv", "--style", style, "-o", "out.bvh"];
        let said = strut_ok(folder.path(), &[&args[..], &["--input-out", "in.bvh", "--json", "drive.json"]].concat());
        assert!(said.contains("cm off the path"), "{said}");
        let report: serde_json::Value =
            serde_json::from_slice(&fs::read(folder.path().join("drive.json")).unwrap()).unwrap();
        let off = |of: &str| report["path_error_m"][of].as_f64().unwrap();
        assert!(off("mean") < 0.06 && off("p95") < 0.12, "{style}: {report}");
        assert!(report["transitions_per_sec"].as_f64().unwrap() < 3.5, "{report}");
        for file in ["in.bvh", "out.bvh"] {
            let bytes = fs::read(folder.path().join(file)).unwrap();
            assert!(bvh::parse(&bytes).unwrap().frames > 600, "{file}");
        }
    }
}

#[test]
fn the_shortest_drive_has_a_frame() {
    let folder = folder();
    fs::write(folder.path().join("path.csv"), circle()).unwrap();
    let args = ["drive", "--db", "db.strutdb", "--path", "path.csv", "--secs", "0.001", "-o", "out.bvh"];
    let said = strut_ok(folder.path(), &[&args[..], &["--input-out", "in.bvh"]].concat());
    assert!(!said.contains("NaN"), "{said}");
    for file in ["in.bvh", "out.bvh"] {
        let bytes = fs::read(folder.path().join(file)).unwrap();
        assert_eq!(bvh::parse(&bytes).map(|file| file.frames), Ok(1), "{file}");
    }
}

#[test]
fn controls_stop_turn_and_jump() {
    let folder = folder();
    let log = "time,gait,heading,face,action\n0,1,0,,\n4,0,0,,\n8,0,0,90,\n11,0,0,-90,\n14,0,0,-90,jump\n18,1,-90,,\n\
               20,1,-90,,kick\n24,0,-90,,\n36,0,-90,,\n";
    fs::write(folder.path().join("log.csv"), log).unwrap();
    let args = ["drive", "--db", "db.strutdb", "--controls", "log.csv", "-o", "out.bvh", "--json", "drive.json"];
    strut_ok(folder.path(), &args);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("drive.json")).unwrap()).unwrap();
    let order = |i: usize, of: &str| report["orders"][i][of].as_f64();
    assert!(order(1, "stop_secs").unwrap() < 1.6 && order(1, "stop_m").unwrap() < 1.0, "{report}");
    for turn in [2, 3] {
        assert!(order(turn, "heading_secs").unwrap() < 1.6, "{report}");
        assert!(order(turn, "moved_m").unwrap() < 0.25, "{report}");
        assert!(order(turn, "first_degree_frames").unwrap() < 12.0, "{report}");
    }
    assert!(order(4, "action_secs").unwrap() < 0.1 && order(4, "acted_secs").unwrap() > 1.0, "{report}");
    assert!(order(6, "action_secs").unwrap() < 1.1, "{report}");
    assert!(order(7, "moved_m").unwrap() < 1.5, "{report}");
    let skate = |of: &str| report["skate"][of].as_f64().unwrap();
    assert!(skate("planted") < 0.01 && skate("styled") < 0.02, "{report}");
}

#[test]
fn a_jump_from_a_run_keeps_its_speed() {
    let folder = folder();
    fs::write(folder.path().join("log.csv"), "time,gait,heading,action\n0,2,0,\n4,2,0,jump\n5,2,0,\n7,2,0,\n").unwrap();
    let args = ["drive", "--db", "db.strutdb", "--controls", "log.csv", "-o", "out.bvh", "--json", "drive.json"];
    strut_ok(folder.path(), &args);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("drive.json")).unwrap()).unwrap();
    let jump = |of: &str| report["orders"][1][of].as_f64().unwrap();
    // The character takes off at the next step, flies, and continues to run. Braking before the jump took a second.
    assert!(jump("action_secs") < 0.5 && (0.25..0.7).contains(&jump("acted_secs")), "{report}");
    assert!(jump("moved_m") > 2.0, "{report}");
}

#[test]
fn stopping_takes_at_most_a_step_and_a_half() {
    let folder = folder();
    let mut log = String::from("time,gait,heading\n");
    let mut time = 0.0;
    for i in 0..20 {
        // A stride takes about 1.1 s.
        let (walked, heading) = (2.0 + 0.055 * f64::from(i), 40 * i);
        writeln!(log, "{time:.2},1,{heading}\n{:.2},0,{heading}", time + walked).unwrap();
        time += walked + 3.0;
    }
    writeln!(log, "{time:.2},0,0").unwrap();
    fs::write(folder.path().join("log.csv"), log).unwrap();
    let args = ["drive", "--db", "db.strutdb", "--controls", "log.csv", "-o", "out.bvh", "--json", "drive.json"];
    strut_ok(folder.path(), &args);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("drive.json")).unwrap()).unwrap();
    for stop in (1..40).step_by(2).map(|i| &report["orders"][i]) {
        assert!(stop["stop_secs"].as_f64().unwrap() <= 1.3 && stop["stop_m"].as_f64().unwrap() <= 0.8, "{stop}");
    }
}

#[test]
fn the_same_drive_is_the_same_file() {
    let folder = folder();
    fs::write(folder.path().join("log.csv"), "time,gait,heading\n0,1,0\n1.5,1,90\n3,2,90\n5,0.5,-45\n").unwrap();
    for out in ["one.bvh", "two.bvh"] {
        strut_ok(folder.path(), &["drive", "--db", "db.strutdb", "--controls", "log.csv", "--secs", "6", "-o", out]);
    }
    let read = |file: &str| fs::read(folder.path().join(file)).unwrap();
    assert!(read("one.bvh") == read("two.bvh"));
}

#[test]
fn what_cannot_be_followed_gets_a_sentence() {
    let folder = folder();
    let refused = |path: &str, expected: &str| {
        fs::write(folder.path().join("path.csv"), path).unwrap();
        assert_refused(
            folder.path(),
            &["drive", "--db", "db.strutdb", "--path", "path.csv", "-o", "out.bvh"],
            expected,
        );
    };
    refused("x,z\n0,0\nNaN,1\n", "path.csv: line 3: the x is 'NaN'; a number was expected");
    refused("x,z\n0,0\n", "the path has fewer than two distinct points; two or more were expected");
    refused("x,y\n0,0\n", "line 1: there is a column 'y'; the columns x,z[,gait] were expected");
    refused("x\n0\n", "line 1: the columns x,z[,gait] were expected");
    refused("x,z\n0,0,0\n", "line 2: the number of fields differs from line 1");
    fs::write(folder.path().join("log.csv"), "time,gait,heading\n2,1,0\n1,1,0\n").unwrap();
    let args = ["drive", "--db", "db.strutdb", "--controls", "log.csv", "-o", "out.bvh"];
    assert_refused(folder.path(), &args, "the times do not increase from line to line");
    fs::write(folder.path().join("log.csv"), "time,gait,heading,action\n0,1,0,\n2,1,0,dance\n").unwrap();
    assert_refused(folder.path(), &args, "line 3: the action is 'dance'; one of jump, punch, kick was expected");
}
