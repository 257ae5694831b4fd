//! The search finds the same as brute force on real motion capture outside the database, if it is present
//! (`STRUT_MOCAP`): for a sample of frames, or with `STRUT_ALL_CLIPS=1` and half an hour for 10 000 of them at three
//! sizes and 1 000 at a fourth.

#[path = "../../../strut-core/benches/grown/mod.rs"]
mod grown;

use crate::common::{all_clips, mocap, strut_ok};
use rayon::prelude::*;
use std::fs;
use strut_core::search::{Index, Metric, Neighbours, Scratch};
use strut_formats::strutdb;

/// Number of frames of a run: the neighbours of one frame help to find those of the next.
const RUN: usize = 20;

#[test]
fn neighbours_of_unseen_motion_are_those_of_brute_force_at_every_size() {
    let Some(mocap) = mocap::folder() else { return };
    let sizes = if all_clips() {
        vec![(5_000, 10_000), (20_000, 10_000), (80_000, 10_000), (400_000, 1_000)]
    } else {
        vec![(5_000, 200), (20_000, 200), (80_000, 200)]
    };
    let folder = tempfile::tempdir().unwrap();
    let clips = mocap::clips_of(&mocap, "bandai-namco-2");
    let mut args =
        vec!["build-db", "-o", "db", "--neutral", "normal", "--pattern", "{set}_{action}_{style}_{take}.bvh"];
    args.extend(clips.iter().map(|p| p.to_str().unwrap()));
    strut_ok(folder.path(), &args);
    let db = strutdb::read(&fs::read(folder.path().join("db")).unwrap()).unwrap().database;

    let windows = grown::held_out(&db);
    for (size, frames) in sizes {
        let step = (windows.len() * RUN / frames).max(RUN);
        let runs: Vec<_> = windows.chunks(step).map(|run| &run[..RUN.min(run.len())]).collect();
        let index = Index::build(&grown::grown(&db, size, 48));
        let differing: usize = runs.par_iter().map(|run| differing(&index, run)).sum();
        let compared: usize = runs.iter().map(|run| run.len()).sum();
        println!("{size} frames: {differing} differing neighbour sets of 48 classes in {compared} frames");
        assert_eq!(differing, 0);
    }
}

/// Returns the number of neighbour sets of a run that differ from brute force.
fn differing(index: &Index, run: &[strut_core::search::QueryWindow]) -> usize {
    let (mut scratch, mut expected, mut differing) = (Scratch::default(), Neighbours::default(), 0);
    for metric in [Metric::FullBody, Metric::LowerBody] {
        let mut found = vec![Neighbours::default(); index.classes()];
        for window in run {
            let query = index.prepare(window, metric);
            for (class, out) in found.iter_mut().enumerate() {
                index.nearest(&query, &[class], 40, &mut scratch, out);
                index.nearest_by_brute_force(&query, &[class], 40, &mut expected);
                differing += usize::from(out.as_slice() != expected.as_slice());
            }
        }
    }
    differing
}
