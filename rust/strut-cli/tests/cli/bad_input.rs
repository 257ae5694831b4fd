//! Invalid files: the command prints one sentence, exits with 1 and writes nothing.

use crate::common::{assert_refused, demo_database, demo_walk, strut};
use std::fs::{self, File};
use std::path::Path;

/// Creates a folder with the built-in database as `demo.strutdb`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("demo.strutdb"), demo_database()).unwrap();
    folder
}

const STYLIZE: [&str; 9] = ["stylize", "--db", "demo.strutdb", "--input", "in.bvh", "--style", "old", "-o", "out.bvh"];

#[cfg(not(feature = "gpu"))]
#[test]
fn a_command_without_the_graphics_processor_says_how_to_build_it() {
    let folder = tempfile::tempdir().unwrap();
    assert_refused(
        folder.path(),
        &["bench", "--gpu", "--frames", "4800", "--json", "out.json"],
        "npm run bench -- --gpu",
    );
}

/// Checks that every command that reads `in.bvh` refuses it.
fn assert_bvh_refused(folder: &Path, content: impl AsRef<[u8]>, expected: &str) {
    fs::write(folder.join("in.bvh"), content).unwrap();
    assert_refused(folder, &["inspect", "in.bvh", "--json", "in.json"], expected);
    assert_refused(folder, &[&STYLIZE[..], &["--trace", "trace.jsonl"]].concat(), expected);
    let table = "file,action,style\nin.bvh,walk,old\n";
    fs::write(folder.join("labels.csv"), table).unwrap();
    assert_refused(folder, &["build-db", "in.bvh", "-o", "new.strutdb", "--labels", "labels.csv"], expected);
}

/// Returns the walk with changed lines after `MOTION`, the line of frames first.
fn walk_with(change: impl Fn(usize, &str) -> String) -> String {
    let walk = demo_walk();
    let motion = walk.lines().position(|l| l == "MOTION").unwrap();
    let lines = walk.lines().enumerate();
    lines.map(|(i, line)| if i < motion { line.to_owned() } else { change(i - motion, line) } + "\n").collect()
}

/// Returns the walk with another first value in its tenth frame.
fn walk_with_value(value: &str) -> String {
    walk_with(|i, line| if i == 12 { format!("{value} {}", line.split_once(' ').unwrap().1) } else { line.to_owned() })
}

/// Returns the walk cut to a number of frames, with a matching frame count.
fn walk_of(frames: usize) -> String {
    let text = walk_with(|i, line| match i {
        1 => format!("Frames: {frames}"),
        i if i >= 3 + frames => String::new(),
        _ => line.to_owned(),
    });
    text.trim_end().to_owned() + "\n"
}

#[test]
fn files_that_are_no_bvh() {
    let folder = folder();
    let at = folder.path();
    assert_bvh_refused(at, "", "in.bvh: the file is empty; a BVH file begins with HIERARCHY");
    assert_bvh_refused(at, "Dear all,\n", "in.bvh: line 1, column 1 has 'Dear'; HIERARCHY was expected");
    assert_bvh_refused(at, [0xFF, 0xD8, 0xFF, 0xE0, 0, 16], "in.bvh: line 1, column 1 has ");
    fs::remove_file(at.join("in.bvh")).unwrap();
    assert_refused(at, &STYLIZE, "in.bvh: there is no such file or folder");
    fs::create_dir(at.join("in.bvh")).unwrap();
    assert_refused(at, &["inspect", "in.bvh"], "in.bvh: this is a folder; a file was expected");
    assert_refused(at, &STYLIZE, "in.bvh: no .bvh file was found there");
}

#[test]
fn truncated_files() {
    let folder = folder();
    let walk = demo_walk();
    let (neck, hierarchy) = (walk.find("JOINT Neck").unwrap(), walk.find("MOTION").unwrap());
    assert_bvh_refused(folder.path(), &walk[..neck], "has the end of the file; JOINT, End Site or '}' was expected");
    assert_bvh_refused(folder.path(), &walk[..hierarchy], "has the end of the file; MOTION was expected");
    let lines: Vec<&str> = walk.lines().collect();
    let frames = |count: usize| lines[..lines.len() - 120 + count].join("\n");
    assert_bvh_refused(folder.path(), frames(0), "after 0 frames; 120 were declared");
    assert_bvh_refused(
        folder.path(),
        frames(10),
        "in.bvh: the file declares 120 frames; the rest of the file can hold at most ",
    );
    let cut_off = frames(1).rsplit_once(' ').unwrap().0.to_owned();
    assert_bvh_refused(folder.path(), cut_off, "has 65 numbers; this skeleton needs 66");
}

#[test]
fn a_file_that_ends_early_is_styled_with_a_note() {
    let folder = folder();
    let walk = demo_walk();
    let lines: Vec<&str> = walk.lines().collect();
    let cut = lines[..lines.len() - 20].join("\n");
    fs::write(folder.path().join("in.bvh"), cut.rsplit_once(' ').unwrap().0).unwrap();
    let output = strut(folder.path(), &[&STYLIZE[..], &["--json", "out.json"]].concat());
    assert!(output.status.success());
    let note = "The file declares 120 frames and has 99. Its last row is incomplete and was left out.";
    assert!(String::from_utf8_lossy(&output.stderr).contains(note), "{}", String::from_utf8_lossy(&output.stderr));
    let report: serde_json::Value = serde_json::from_slice(&fs::read(folder.path().join("out.json")).unwrap()).unwrap();
    assert_eq!(report["notes"][0]["code"], "frame-count");
    assert_eq!(report["notes"][0]["text"], note);
}

#[test]
fn impossible_numbers() {
    let folder = folder();
    for (value, expected) in [
        ("NaN", "column 1 has 'NaN'; a number was expected"),
        ("1e30", "column 1 has '1e30'; a number within ±10000000 was expected"),
        ("-1e999", "column 1 has '-1e999'; a number within ±10000000 was expected"),
        ("0,5", "column 1 has '0,5', a decimal comma; decimal points were expected"),
    ] {
        assert_bvh_refused(folder.path(), walk_with_value(value), expected);
    }
    let frame_time = |secs: &str| walk_with(|i, l| if i == 2 { format!("Frame Time: {secs}") } else { l.to_owned() });
    assert_bvh_refused(folder.path(), frame_time("-0.03"), "has a frame time of -0.03 s");
    assert_bvh_refused(folder.path(), frame_time("0"), "has a frame time of 0 s");
    assert_bvh_refused(folder.path(), frame_time("nan"), "has 'nan'; the frame time in seconds was expected");
}

#[test]
fn too_few_frames() {
    let folder = folder();
    let at = folder.path();
    assert_bvh_refused(at, walk_of(0), "declares 0 frames; 1 to 1000000 were expected");
    for (frames, expected) in [
        (1, "in.bvh: the motion lasts 0.00 s from its first frame to its last; at least "),
        (2, "lasts 0.02 s from its first frame to its last; at least "),
    ] {
        fs::write(at.join("in.bvh"), walk_of(frames)).unwrap();
        assert_refused(at, &STYLIZE, expected);
        fs::write(at.join("labels.csv"), "file,action,style\nin.bvh,walk,old\n").unwrap();
        assert_refused(at, &["build-db", "in.bvh", "-o", "new.strutdb", "--labels", "labels.csv"], "it has only ");
    }
}

#[test]
fn motions_that_would_become_too_long_at_the_database_s_rate() {
    let folder = folder();
    let at = folder.path();
    let frame = demo_walk().lines().last().unwrap().to_owned();
    let frames = 20_000;
    let long = walk_with(|i, line| match i {
        1 => format!("Frames: {frames}"),
        // Short enough not to be interpreted as milliseconds.
        2 => "Frame Time: 3".to_owned(),
        3 => vec![frame.as_str(); frames].join("\n"),
        i if i > 3 => String::new(),
        _ => line.to_owned(),
    });
    fs::write(at.join("in.bvh"), long.trim_end().to_owned() + "\n").unwrap();
    let expected = "in.bvh: the motion has 3599820 frames at 60 Hz; at most 1000000 are supported";
    assert_refused(at, &STYLIZE, expected);
    fs::write(at.join("labels.csv"), "file,action,style\nin.bvh,walk,old\n").unwrap();
    let build = ["build-db", "in.bvh", "-o", "new.strutdb", "--labels", "labels.csv"];
    assert_refused(at, &build, "the motion has 3599820 frames at 60 Hz; at most 1000000 are supported");
}

#[test]
fn skeletons_that_cannot_be_used() {
    let folder = folder();
    let at = folder.path();
    let joint = " j\n{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n";
    let many = ["HIERARCHY\nROOT", &vec![joint; 10_000].join("JOINT")].concat();
    assert_bvh_refused(at, many, "in.bvh: line 2050 begins joint 513; at most 512 are supported");
    let two_roots = demo_walk().replace("MOTION", "ROOT Other\n{\nOFFSET 0 0 0\n}\nMOTION");
    assert_bvh_refused(at, two_roots, "begins a second ROOT; one skeleton per file is supported");
    let chain =
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\nMOTION\nFrames: 2\nFrame Time: 0.1\n1\n2\n";
    fs::write(at.join("in.bvh"), chain).unwrap();
    assert_refused(at, &STYLIZE, "in.bvh: No ");
}

#[test]
fn large_files_are_refused() {
    let folder = folder();
    for (megabytes, expected) in
        [(200, "in.bvh: line 1, column 1 has "), (300, "in.bvh: the file is larger than 256 MiB")]
    {
        // A sparse file takes no space on the disk.
        File::create(folder.path().join("in.bvh")).unwrap().set_len(megabytes << 20).unwrap();
        assert_refused(folder.path(), &STYLIZE, expected);
    }
    File::create(folder.path().join("demo.strutdb")).unwrap().set_len(5 << 30).unwrap();
    fs::write(folder.path().join("in.bvh"), demo_walk()).unwrap();
    assert_refused(folder.path(), &STYLIZE, "demo.strutdb: the file is larger than 4095 MiB");
}

#[test]
fn damaged_databases() {
    let folder = folder();
    let at = folder.path();
    fs::write(at.join("in.bvh"), demo_walk()).unwrap();
    let good = demo_database();
    let mut flipped = good.to_vec();
    flipped[good.len() / 2] ^= 0x10;
    for (bytes, expected) in [
        (&good[..good.len() / 2], "demo.strutdb: the file is cut short or damaged"),
        (&flipped, "demo.strutdb: the Strut database is damaged: its checksum is "),
        (b"", "demo.strutdb: this is not a Strut database"),
        (demo_walk().as_bytes(), "demo.strutdb: this is not a Strut database"),
    ] {
        fs::write(at.join("demo.strutdb"), bytes).unwrap();
        assert_refused(at, &STYLIZE, expected);
        assert_refused(at, &["inspect", "demo.strutdb", "--json", "in.json"], expected);
    }
}

#[test]
fn labels_and_outputs_that_do_not_fit() {
    let folder = folder();
    let at = folder.path();
    fs::write(at.join("in.bvh"), demo_walk()).unwrap();
    let with = |from: &str, to: &'static str| {
        STYLIZE.map(|a| if a == from { to } else { "" }.to_owned() + if a == from { "" } else { a })
    };
    let refused = |args: &[String], more: &[&str], expected: &str| {
        let args: Vec<&str> = args.iter().map(String::as_str).chain(more.iter().copied()).collect();
        assert_refused(at, &args, expected);
    };
    refused(&with("old", "odl"), &[], "demo.strutdb: there is no style 'odl'; did you mean 'old'?");
    refused(&with("old", "zombie=1"), &[], "there is no style 'zombie'; there are angry, childlike, ");
    refused(&with("", ""), &["--action", "wlak"], "there is no action 'wlak'; did you mean 'walk'?");
    refused(&with("", ""), &["--part", "legs:prod"], "there is no style 'prod'; did you mean 'proud'?");
    refused(&with("out.bvh", "no/out.bvh"), &[], "no/out.bvh: its folder does not exist");
    refused(&with("", ""), &["--trace", "out.bvh"], "out.bvh: two outputs have this name");
    assert_refused(
        at,
        &["build-db", "in.bvh", "-o", "new.strutdb"],
        "in.bvh: its name does not match '{action}_{style}_{take}.bvh'; give the labels with --pattern or --labels",
    );
}

#[test]
fn an_older_output_survives_a_failure() {
    let folder = folder();
    let at = folder.path();
    fs::write(at.join("in.bvh"), walk_with_value("NaN")).unwrap();
    fs::write(at.join("out.bvh"), "older").unwrap();
    assert_refused(at, &STYLIZE, "a number was expected");
    assert_eq!(fs::read(at.join("out.bvh")).unwrap(), b"older");
}

#[test]
fn wrong_usage_has_its_own_exit_code() {
    let folder = folder();
    for more in
        [&["-k", "0"][..], &["--rho", "2"], &["--style", "old=much"], &["--timing", "maybe"], &["--method", "x"]]
    {
        let args: Vec<&str> =
            STYLIZE.iter().filter(|a| !(more[0] == "--style" && ["--style", "old"].contains(a))).copied().collect();
        let output = strut(folder.path(), &[&args[..], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}");
        assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: "), "{more:?}");
    }
    for more in [&["--rate", "5"][..], &["--rate", "x"], &["--pattern", "{action}"]] {
        let output = strut(folder.path(), &[&["build-db", "in.bvh", "-o", "new.strutdb"][..], more].concat());
        assert_eq!(output.status.code(), Some(2), "{more:?}");
    }
    assert_eq!(strut(folder.path(), &[]).status.code(), Some(2));
    assert_eq!(strut(folder.path(), &["evaluate"]).status.code(), Some(2));
}
