//! `strut stylize-batch`: every job is done once, even after interruptions.

use crate::common::{assert_refused, demo_database, demo_walk, strut, strut_ok};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const ALL: [&str; 5] = ["clips", "--db", "demo.strutdb", "-o", "out"];

/// Creates a folder with `demo.strutdb` and `clips/`, which has copies of a walk and subfolders with copies.
fn folder(clips: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("demo.strutdb"), demo_database()).unwrap();
    fs::create_dir_all(folder.path().join("clips/more")).unwrap();
    for clip in 0..clips {
        let place = if clip % 2 == 0 { "clips" } else { "clips/more" };
        // White space at the end makes another file of the same motion.
        let text = demo_walk() + &"\n".repeat(clip);
        fs::write(folder.path().join(format!("{place}/{clip}.bvh")), text).unwrap();
    }
    folder
}

fn batch<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["stylize-batch"], &ALL[..], more].concat()
}

/// Runs a batch to its end and returns its report.
fn report(folder: &Path, more: &[&str]) -> Value {
    strut_ok(folder, &[&batch(more)[..], &["--json", "report.json"]].concat());
    serde_json::from_slice(&fs::read(folder.join("report.json")).unwrap()).unwrap()
}

fn counts(report: &Value) -> [u64; 5] {
    ["jobs", "done", "styled", "skipped", "failed"].map(|name| report[name].as_u64().unwrap())
}

/// Returns all files below a folder by relative path, except those of the batch itself.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fn walk(root: &Path, at: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
        for entry in fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            let below = path.strip_prefix(root).unwrap().to_owned();
            if path.is_dir() {
                walk(root, &path, found);
            } else if !below.to_string_lossy().contains("manifest") || below.to_string_lossy().ends_with(".tmp") {
                found.insert(below, fs::read(&path).unwrap());
            }
        }
    }
    let mut found = BTreeMap::new();
    walk(folder, folder, &mut found);
    found
}

/// Returns the records of the manifest.
fn records(folder: &Path) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("out/manifest.jsonl")).unwrap_or_default();
    text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

#[test]
fn outputs_are_those_of_stylize_in_a_folder_for_each_variant() {
    let folder = folder(3);
    let at = folder.path();
    fs::write(at.join("variants.csv"), "variant,style,k,timing\nold,old,,\nmixed,\"proud=0.4,old=-0.2\",20,off\n")
        .unwrap();
    let first = report(at, &["--variants", "variants.csv", "--threads", "2"]);
    assert_eq!(counts(&first), [6, 6, 6, 0, 0]);
    let outputs = files(&at.join("out"));
    assert_eq!(outputs.len(), 6);
    for (variant, options) in
        [("old", &["--style", "old"][..]), ("mixed", &["--style", "proud=0.4,old=-0.2", "-k", "20", "--timing", "off"])]
    {
        for clip in ["0.bvh", "more/1.bvh", "2.bvh"] {
            let input = format!("clips/{clip}");
            let args = ["stylize", "--db", "demo.strutdb", "--input", &input, "-o", "alone.bvh"];
            strut_ok(at, &[&args[..], options].concat());
            let alone = fs::read(at.join("alone.bvh")).unwrap();
            assert!(outputs[&Path::new(variant).join(clip)] == alone, "{variant}/{clip}");
        }
    }
    let record = &records(at)[0];
    for name in ["job", "key", "input", "input_sha256", "variant", "output", "output_sha256", "version"] {
        assert!(record[name].is_string(), "{name}: {record}");
    }
    for name in ["bytes", "frames", "repaired", "time_ms"] {
        assert!(record[name].is_u64(), "{name}: {record}");
    }
    assert_eq!(record["status"], "done");
}

#[test]
fn only_what_is_not_done_is_done() {
    let folder = folder(3);
    let at = folder.path();
    assert_eq!(counts(&report(at, &["--style", "old"])), [3, 3, 3, 0, 0]);
    let outputs = files(&at.join("out"));
    assert_eq!(counts(&report(at, &["--style", "old"])), [3, 3, 0, 0, 0]);
    assert_eq!(records(at).len(), 3, "what is done is not recorded again");

    fs::remove_file(at.join("out/old/0.bvh")).unwrap();
    fs::write(at.join("clips/2.bvh"), demo_walk() + "\n\n\n\n").unwrap();
    fs::write(at.join("clips/new.bvh"), demo_walk()).unwrap();
    let damaged = vec![b' '; outputs[Path::new("old/more/1.bvh")].len()];
    fs::write(at.join("out/old/more/1.bvh"), damaged).unwrap();
    let second = report(at, &["--style", "old"]);
    assert_eq!(counts(&second), [4, 4, 3, 0, 0], "without an output, with another input, and new");
    let third = report(at, &["--style", "old", "--verify"]);
    assert_eq!(counts(&third), [4, 4, 1, 0, 0], "another content of the same size");
    let now = files(&at.join("out"));
    assert!(outputs.iter().all(|(path, bytes)| now[path] == *bytes));
    // Other options change the output at the same path.
    assert_eq!(counts(&report(at, &["--style", "old", "-k", "20"])), [4, 4, 4, 0, 0]);
}

#[test]
fn what_cannot_be_styled_or_written_stops_nothing_else() {
    let folder = folder(2);
    let at = folder.path();
    fs::write(at.join("clips/broken.bvh"), "HIERARCHY\nnothing").unwrap();
    let skipped = report(at, &["--style", "old"]);
    assert_eq!(counts(&skipped), [3, 2, 2, 1, 0]);
    let problem = &skipped["problems"][0];
    assert_eq!((&problem["status"], &problem["code"]), (&"skipped".into(), &"bad-file".into()));
    assert!(problem["message"].as_str().unwrap().starts_with("clips/broken.bvh: line 2"), "{problem}");
    let strict = strut(at, &batch(&["--style", "old", "--strict"]));
    assert_eq!(strict.status.code(), Some(1));
    fs::write(at.join("clips/broken.bvh"), demo_walk()).unwrap();
    assert_eq!(counts(&report(at, &["--style", "old"])), [3, 3, 1, 0, 0], "its input is another");

    // A folder is at the path of an output.
    fs::create_dir_all(at.join("out/proud/0.bvh")).unwrap();
    let failed = strut(at, &batch(&["--style", "proud"]));
    let stderr = String::from_utf8(failed.stderr).unwrap();
    assert_eq!(failed.status.code(), Some(1), "{stderr}");
    assert!(stderr.contains("warning: failed proud/0.bvh: out/proud/0.bvh: "), "{stderr}");
    assert!(stderr.ends_with("error: out: 1 of 3 jobs failed; repeat them with --retry failed\n"), "{stderr}");
    fs::remove_dir(at.join("out/proud/0.bvh")).unwrap();
    assert_eq!(strut(at, &batch(&["--style", "proud"])).status.code(), Some(1), "it is not done again unasked");
    assert_eq!(counts(&report(at, &["--style", "proud", "--retry", "failed"])), [3, 3, 1, 0, 0]);
}

#[test]
fn shares_are_disjoint_and_together_all() {
    let folder = folder(8);
    let at = folder.path();
    let shares = ["1/3", "2/3", "3/3"].map(|shard| counts(&report(at, &["--style", "old", "--shard", shard])));
    assert_eq!(shares.iter().map(|[jobs, ..]| jobs).sum::<u64>(), 8);
    assert!(shares.iter().all(|[jobs, done, styled, ..]| jobs == done && done == styled));
    assert_eq!(counts(&report(at, &["--style", "old"])), [8, 8, 0, 0, 0], "the manifests are read together");
}

#[test]
fn impossible_batches_are_refused_with_a_sentence() {
    let folder = folder(2);
    let at = folder.path();
    fs::create_dir(at.join("other")).unwrap();
    fs::write(at.join("other/0.bvh"), demo_walk()).unwrap();
    let collision = ["stylize-batch", "clips", "other", "--db", "demo.strutdb", "--style", "old", "-o", "out"];
    assert_refused(at, &collision, "other/0.bvh: its output would have the same name as that of clips/0.bvh");
    assert_refused(at, &batch(&["--style", "odl"])[..], "there is no style 'odl'; did you mean 'old'?");
    let inside = ["stylize-batch", "clips", "--db", "demo.strutdb", "--style", "old", "-o", "clips/out"];
    assert_refused(at, &inside, "the output folder is inside the input clips");
    for usage in [
        &[][..],
        &["--style", "old", "--variants", "v.csv"],
        &["--style", "old", "--shard", "3/2"],
        &["--style", "../old"],
    ] {
        assert_eq!(strut(at, &batch(usage)).status.code(), Some(2), "{usage:?}");
    }
}

/// Starts a batch and waits until it has recorded `more` new jobs, or has ended.
fn start(folder: &Path, more: usize) -> Child {
    let before = records(folder).len();
    let mut child = Command::new(env!("CARGO_BIN_EXE_strut"))
        .current_dir(folder)
        .args(batch(&["--style", "old", "--threads", "2"]))
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while records(folder).len() < before + more && child.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    child
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

/// Kills a batch repeatedly at random times while it works, and finally lets it end. Every job then has one output, the
/// same as without the kills. `STRUT_KILLS` is the number of kills.
#[cfg(unix)]
#[test]
fn a_batch_that_is_killed_goes_on_as_if_it_had_not_been() {
    let kills: usize = std::env::var("STRUT_KILLS").map_or(5, |number| number.parse().unwrap());
    // A start ends about three jobs and has two more in progress, which come last in the next start. With this number
    // of jobs none is in progress three times.
    let jobs = 8 * (kills + 1);
    let folder = folder(jobs);
    let at = folder.path();
    let mut state = std::process::id();
    for kill in 0..kills {
        let mut child = start(at, 1);
        // Wait up to a tenth of a second more, several times the duration of a job, but at most for two more jobs.
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let (begin, before) = (Instant::now(), records(at).len());
        let wait = Duration::from_micros(u64::from(state >> 8) % 100_000);
        while begin.elapsed() < wait && records(at).len() < before + 2 {
            std::thread::sleep(Duration::from_micros(100));
        }
        if kill == 0 {
            signal(&child, "-STOP");
            assert_refused(at, &batch(&["--style", "old"]), "out/manifest.jsonl: another process writes this manifest");
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    // Simulates a truncated last line.
    let manifest = at.join("out/manifest.jsonl");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, &text[..text.len() - 20]).unwrap();
    let [all, done, styled, skipped, failed] = counts(&report(at, &["--style", "old"]));
    assert_eq!([all, done, skipped, failed], [jobs as u64, jobs as u64, 0, 0]);
    println!("{kills} kills, {styled} of {jobs} jobs were left");

    let outputs = files(&at.join("out"));
    let last: BTreeMap<String, Value> =
        records(at).into_iter().map(|record| (record["job"].as_str().unwrap().to_owned(), record)).collect();
    assert_eq!(last.len(), jobs);
    assert!(last.values().all(|record| record["status"] == "done"));
    // All inputs are the same motion.
    strut_ok(at, &["stylize", "--db", "demo.strutdb", "--input", "clips/0.bvh", "--style", "old", "-o", "alone.bvh"]);
    let alone = fs::read(at.join("alone.bvh")).unwrap();
    assert_eq!(outputs.len(), jobs, "no temporary file: {:?}", outputs.keys());
    assert!(outputs.values().all(|bytes| *bytes == alone));
}

#[cfg(unix)]
#[test]
fn after_ctrl_c_nothing_is_half_done() {
    let folder = folder(12);
    let at = folder.path();
    let child = start(at, 1);
    signal(&child, "-INT");
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{stderr}");
    assert!(
        stderr.starts_with("error: it was cancelled; ") && stderr.contains(" of 12 jobs are done; run the same"),
        "{stderr}"
    );
    let recorded: BTreeSet<String> = records(at).iter().map(|r| r["output"].as_str().unwrap().to_owned()).collect();
    let written: BTreeSet<String> =
        files(&at.join("out")).into_keys().map(|p| p.to_str().unwrap().to_owned()).collect();
    assert_eq!(recorded, written);
    let [_, done, styled, ..] = counts(&report(at, &["--style", "old"]));
    assert_eq!((done, styled), (12, 12 - recorded.len() as u64));
}

/// Requires a system that can create a small disk.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_in_a_sentence_and_blames_no_job() {
    let folder = folder(8);
    let at = folder.path();
    let out = at.join("out");
    fs::create_dir(&out).unwrap();
    let size = format!("size={}k", 4 * demo_walk().len() / 1024);
    let mounted =
        Command::new("mount").args(["-t", "tmpfs", "-o", &size, "tmpfs"]).arg(&out).stderr(Stdio::null()).status();
    if !mounted.is_ok_and(|status| status.success()) {
        eprintln!("skipped: only root may make a small disk");
        return;
    }
    let full = strut(at, &batch(&["--style", "old", "--threads", "1"]));
    let [records, files] = [records(at).len(), files(&out).len()];
    assert!(Command::new("umount").arg(&out).status().unwrap().success());
    let stderr = String::from_utf8(full.stderr).unwrap();
    assert_eq!(full.status.code(), Some(1), "{stderr}");
    assert!(stderr.starts_with("error: out/") && stderr.contains(": the disk is full; "), "{stderr}");
    assert!(stderr.trim_end().ends_with("of 8 jobs are done; run the same command again to continue"), "{stderr}");
    assert!(records > 0 && records == files, "{records} records, {files} files");
}
