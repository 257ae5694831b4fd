//! `strut evaluate` on the built-in motions, which need no data.

use crate::common::{strut, strut_ok};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Creates a folder with the built-in motions as BVH files in `bvh`.
fn demo() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    strut_ok(folder.path(), &["demo-db", "--page", "-o", "demo.strutdb", "--bvh", "bvh"]);
    folder
}

const WALK: [&str; 7] = ["evaluate", "--data", "bvh", "--source", "neutral", "--actions", "walk"];

fn json(folder: &Path, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.join(name)).unwrap()).unwrap()
}

#[test]
fn held_out_takes_are_predicted_better_than_by_doing_nothing() {
    let folder = demo();
    let args = ["--targets", "proud,old", "--methods", "knn,mar", "--json", "out.json", "--curves", "curves.json"];
    strut_ok(folder.path(), &[&WALK[..], &args].concat());
    let out = json(folder.path(), "out.json");
    assert_eq!((out["protocol"].as_str(), out["rate"].as_f64()), (Some("loo"), Some(60.0)));
    let results = out["results"].as_array().unwrap();
    assert_eq!(results.len(), 4, "two targets, two methods");
    for row in results {
        let value = |name: &str| row[name].as_f64().unwrap_or_else(|| panic!("no {name} in {row}"));
        assert_eq!((row["action"].as_str(), row["source"].as_str()), (Some("walk"), Some("neutral")));
        assert_eq!((value("samples"), row["labels"].as_str()), (2.0, Some("none")));
        assert!(value("pose_error_cm") < 0.7 * value("input_cm"), "{row}");
        for name in ["timing_error_ms", "floor_cm", "skate_cm_s_in", "skate_cm_s_out", "jerk_ratio", "ms_per_frame"] {
            assert!(value(name) >= 0.0);
        }
        assert!(value("frames") > 100.0);
    }
    let curves = json(folder.path(), "curves.json");
    let first = &curves[0];
    let names: Vec<&str> = first["curves"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["input", "truth", "knn", "mar"]);
    let lengths = |name: &str| -> Vec<usize> {
        first["curves"].as_array().unwrap().iter().map(|c| c[name].as_array().unwrap().len()).collect()
    };
    assert!(lengths("left_knee_degrees").windows(2).all(|w| w[0] == w[1]));
    assert_eq!(lengths("left_knee_degrees"), lengths("time_secs"));
}

#[test]
fn every_combination_is_measured_and_named() {
    let folder = demo();
    let args = ["--targets", "proud", "--methods", "mar", "--labels", "none,both", "--rho", "0,1", "--kappa", "inf"];
    let table = strut_ok(folder.path(), &[&WALK[..], &args, &["--json", "out.json"]].concat());
    assert_eq!(json(folder.path(), "out.json")["results"].as_array().unwrap().len(), 4);
    assert!(table.starts_with("| method | labels | ρ | pose cm |"), "{table}");
    assert!(table.contains("\n| mar | both | 1 | "), "{table}");
}

#[test]
fn progress_has_a_line_for_every_action_and_style() {
    let folder = demo();
    let args =
        ["--actions", "walk,run", "--targets", "proud,old", "--methods", "mar", "--labels", "both", "--progress"];
    let table = strut_ok(folder.path(), &[&WALK[..5], &args].concat());
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "| action | style | output | real takes | output ÷ takes | pose cm |");
    let classes = lines[2..].iter().map(|line| line.split(" | ").take(2).collect::<Vec<_>>().join(" "));
    let classes: std::collections::BTreeSet<String> = classes.collect();
    assert_eq!(Vec::from_iter(classes), ["| run old", "| run proud", "| walk old", "| walk proud"]);
}

#[test]
fn foreign_motion_is_compared_with_itself() {
    let folder = demo();
    let args = ["--protocol", "off-database", "--inputs", "bvh/run_neutral_001.bvh", "--targets", "old"];
    strut_ok(folder.path(), &[&WALK[..], &args, &["--methods", "mar", "--json", "out.json"]].concat());
    let row = &json(folder.path(), "out.json")["results"][0];
    assert!(row["distance_cm"].as_f64().unwrap() > 1.0, "{row}");
    assert!(row["content_correlation"].as_f64().unwrap() > 0.2, "{row}");
}

#[test]
fn a_part_of_the_body_takes_the_style_alone_and_more_of_it_goes_farther() {
    let folder = demo();
    let args = ["--protocol", "off-database", "--inputs", "bvh/walk_neutral_001.bvh", "--targets", "old"];
    let vary = ["--methods", "mar", "--intensity", "0,1,1.5", "--part", "whole,arms", "--json", "out.json"];
    let table = strut_ok(folder.path(), &[&WALK[..], &args, &vary].concat());
    assert!(table.starts_with("| method | intensity | part | acceleration × |"), "{table}");
    let results = json(folder.path(), "out.json")["results"].clone();
    let value = |intensity: f64, part: &str, name: &str| {
        let is = |row: &&Value| row["intensity"].as_f64() == Some(intensity) && row["part"].as_str() == Some(part);
        results.as_array().unwrap().iter().find(is).unwrap()[name].as_f64().unwrap()
    };
    for joints in ["head_turned_deg", "torso_turned_deg", "legs_turned_deg"] {
        assert_eq!(value(1.0, "arms", joints), value(0.0, "whole", joints), "{joints}");
    }
    assert_eq!(value(1.0, "arms", "arms_turned_deg"), value(1.0, "whole", "arms_turned_deg"));
    let distances = [0.0, 1.0, 1.5].map(|intensity| value(intensity, "whole", "distance_cm"));
    assert!(distances.is_sorted(), "{distances:?}");
    assert!(value(1.5, "whole", "beyond_anatomy_deg") < 1.0);
}

#[test]
fn wrong_questions_get_a_sentence() {
    let folder = demo();
    for (args, code, expected) in [
        (vec!["--methods", "magic"], 2, "there is no method 'magic'"),
        (vec!["--rho", "2"], 2, "rho is 2"),
        (vec!["--intensity", "99"], 2, "the intensity is 99"),
        (vec!["--targets", "prod"], 1, "proud"),
        (vec!["--protocol", "off-database"], 2, "needs --inputs"),
        (vec!["--inputs", "bvh"], 2, "--inputs needs --protocol off-database"),
        (vec!["--protocol", "off-database", "--inputs", "bvh", "--progress"], 2, "--progress needs --protocol loo"),
    ] {
        let output = strut(folder.path(), &[&WALK[..], &args].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{said}");
        assert!(said.starts_with("error: ") && said.contains(expected), "{said}");
    }
    let output = strut(folder.path(), &["evaluate", "--data", "bvh", "--source", "normal"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("no clip has the style 'normal'"));
}
