//! The memory for opening a database is known before it is opened.

use crate::common::{mocap, strut_ok};
use allocation_counter::measure;
use std::path::PathBuf;
use strut_core::catalogue::CatalogueSize;
use strut_core::database::Database;
use strut_core::search::Index;
use strut_demo::benchmark;
use strut_formats::strutdb;

/// Compares the peak memory of opening with the expected bytes, with a plan of the search index and without.
fn assert_known(name: &str, db: &Database) {
    let size = CatalogueSize::of_clips(&db.clips, db.styles.len(), db.counterparts_per_style);
    let planned = Index::build(db).plan();
    let mut unplanned = planned.clone();
    unplanned.order.clear();
    unplanned.points = Default::default();
    for (plan, has_plan) in [(planned, true), (unplanned, false)] {
        let file = strutdb::write(db, &plan, "test");
        let expected = size.bytes(has_plan);
        let taken = measure(|| drop(strutdb::read_catalogue(&file, None).unwrap())).bytes_max;
        println!("{name}: {taken} bytes, {expected} expected");
        assert!(
            (taken..=taken + taken / 5).contains(&expected),
            "{name}, {has_plan}: {taken} bytes, {expected} expected"
        );
    }
}

#[test]
fn the_memory_that_opening_takes_is_known_to_a_fifth() {
    assert_known("built-in", &strut_demo::database().unwrap());
    for frames in [4_800, 9_000, 20_000] {
        assert_known("procedural", &benchmark::database(frames).unwrap());
    }
}

#[test]
fn it_is_known_of_recorded_motion() {
    let Some(mocap) = mocap::folder() else { return };
    for (set, neutral, pattern) in [
        ("xia", "neutral", "{style}_{action}_{take}.bvh"),
        ("bandai-namco-1", "normal", "{set}_{action}_{style}_{take}.bvh"),
    ] {
        assert_known(set, &built(&mocap::clips_of(&mocap, set), neutral, pattern));
    }
}

fn built(clips: &[PathBuf], neutral: &str, pattern: &str) -> Database {
    let folder = tempfile::tempdir().unwrap();
    let mut args = vec!["build-db", "-o", "db", "--neutral", neutral, "--pattern", pattern];
    args.extend(clips.iter().map(|clip| clip.to_str().unwrap()));
    strut_ok(folder.path(), &args);
    strutdb::read(&std::fs::read(folder.path().join("db")).unwrap()).unwrap().database
}
