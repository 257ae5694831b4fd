//! Registration of real motion capture: contacts, gait cycles, label errors, pace and the moments of an action are found.

use crate::labelled;
use crate::mocap;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use strut_core::catalogue::{Catalogue, TargetTable};
use strut_core::database::Database;
use strut_core::database::build::{BuildOptions, BuildReport, Refusal, build};
use strut_core::humanoid::Role;
use strut_core::math::Vec3;
use strut_core::parallel::ParallelMap;
use strut_core::registration::{self, Method};

/// Two threads that fetch the next task when they finish one.
struct TwoThreads;

impl ParallelMap for TwoThreads {
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
        let next = AtomicUsize::new(0);
        let take = || std::iter::from_fn(|| Some(next.fetch_add(1, Ordering::Relaxed)).filter(|&i| i < n));
        let work = || take().map(|i| (i, f(i))).collect::<Vec<_>>();
        let mut done: Vec<(usize, R)> = std::thread::scope(|scope| {
            let threads = [scope.spawn(work), scope.spawn(work)];
            threads.into_iter().flat_map(|t| t.join().unwrap()).collect()
        });
        done.sort_by_key(|(i, _)| *i);
        done.into_iter().map(|(_, r)| r).collect()
    }
}

/// A database of the clips whose paths contain one of these texts.
fn database(wanted: &[&str]) -> Option<(Database, BuildReport)> {
    let is_wanted = |p: &PathBuf| wanted.iter().any(|w| p.to_string_lossy().contains(w));
    let paths: Vec<PathBuf> = mocap::clips()?.into_iter().filter(is_wanted).collect();
    if paths.is_empty() {
        mocap::skip(&format!("no clips named {wanted:?}"));
        return None;
    }
    let clips = TwoThreads.map(paths.len(), &|i| labelled::load(&paths[i]));
    Some(build(&clips, &BuildOptions::default(), &TwoThreads, &mut |_| ControlFlow::Continue(())).unwrap())
}

#[test]
fn walking_is_registered_and_its_label_errors_are_found() {
    // Straight and turning walks.
    let Some((db, report)) = database(&["dataset-2_walk"]) else { return };

    // The clips that turn in the opposite direction are the set's known label errors.
    let mut refused: Vec<&str> = report.refused().map(|c| c.name.trim_start_matches("dataset-2_walk-turn-")).collect();
    refused.sort_unstable();
    let known = ["left_masculine_006", "left_masculine_007", "right_masculine_006", "right_masculine_007"];
    assert_eq!(refused, [known.as_slice(), &["right_normal_004"]].concat());
    assert!(
        report.refused().all(|c| {
            matches!(c.refused, Some(Refusal::Registration(registration::Refusal::TurnsTheOtherWay { .. })))
        })
    );

    // Contacts divide every clip into cycles of plausible length.
    assert!(report.actions.iter().all(|a| a.method == Method::Cycles));
    for clip in report.accepted() {
        assert!(clip.cycles >= 1 && clip.faulty_cycles.is_empty(), "{clip:?}");
        let secs = clip.mean_cycle_secs.unwrap();
        assert!((0.85..1.35).contains(&secs), "{}: {secs} s a cycle", clip.name);
    }

    let catalogue = Arc::new(Catalogue::new(db.clone()));
    // Counterparts have contact with the same foot.
    for style in 0..db.styles.len() {
        let targets = TargetTable::new(Arc::clone(&catalogue), style as u16);
        let agreeing: usize = (0..db.frames())
            .map(|row| {
                let planted = |side: usize| db.contact[row][side] == 1;
                (0..2).filter(|&side| (targets.contact(row)[side] > 0.5) == planted(side)).count()
            })
            .sum();
        let share = agreeing as f32 / (2 * db.frames()) as f32;
        assert!(share > 0.93, "{}: contacts agree in {share} of the frames", db.styles[style]);
    }

    // Pace of each style relative to normal walking, as measured with a reference prototype.
    let walk = db.action_index("walk").unwrap();
    let class = db.classes().iter().find(|c| (c.action, c.style) == (walk, db.neutral)).unwrap();
    for (style, expected) in [("elderly", 0.92), ("active", 0.83), ("exhausted", 0.97), ("normal", 1.0)] {
        let targets = TargetTable::new(Arc::clone(&catalogue), db.style_index(style).unwrap());
        let secs: f32 = class.rows.clone().map(|row| targets.step_secs(row)).sum();
        let ratio = secs * db.rate_hz / class.rows.len() as f32;
        assert!((ratio - expected).abs() <= 0.04, "{style}: {ratio} times as long; about {expected} was expected");
    }
}

/// Time differences between the first counterpart of the frame in which `role` moves fastest in a direction and the
/// frame in which it moves fastest in the other clip, milliseconds, for all pairs of clips of an action in different
/// styles.
fn offsets(db: &Database, action: &str, role: Role, direction: Vec3) -> Vec<f32> {
    let action = db.action_index(action).unwrap();
    let fastest = |rows: std::ops::Range<usize>| {
        let along = |row: usize| db.point_cloud[row][role.index()].dot(direction);
        let speed = |&row: &usize| along((row + 2).min(rows.end - 1)) - along(row.max(rows.start + 2) - 2);
        rows.clone().max_by(|a, b| speed(a).total_cmp(&speed(b))).unwrap()
    };
    let of_action = || db.clips.iter().filter(|c| c.action == action);
    of_action()
        .flat_map(|a| of_action().filter(|b| b.style != a.style).map(move |b| (a, b)))
        .map(|(a, b)| {
            let slot = fastest(a.rows()) * db.styles.len() + usize::from(b.style);
            let found = db.counterpart[slot * db.counterparts_per_style];
            (found - fastest(b.rows()) as f32).abs() * 1000.0 / db.rate_hz
        })
        .collect()
}

/// With contacts as the only events it would be 222 ms on average for bowing and 55 ms for the others.
#[test]
fn the_moments_of_actions_that_do_not_repeat_correspond() {
    let sets = [
        (&["dataset-1_bow"][..], 185.0, &[("bow", "head down", Role::Head, Vec3::NEG_Y)][..]),
        (
            &["_16_000", "_18_000", "_22_000"],
            52.0,
            &[
                ("16", "jump: hips up", Role::Hips, Vec3::Y),
                ("16", "jump: hand up", Role::LeftHand, Vec3::Y),
                ("18", "punch: hand forward", Role::LeftHand, Vec3::Z),
                ("22", "kick: foot forward", Role::LeftFoot, Vec3::Z),
            ],
        ),
    ];
    for (clips, bound, moments) in sets {
        let Some((db, report)) = database(clips) else { return };
        assert!(report.actions.iter().all(|a| a.method == Method::WholeClips));
        let mut all = Vec::new();
        for &(action, moment, role, direction) in moments {
            let mut found = offsets(&db, action, role, direction);
            found.sort_by(f32::total_cmp);
            let [low, median, high] = [1, 2, 3].map(|quarter| found[quarter * found.len() / 4]);
            println!("{moment}: quartiles {low:.0}, {median:.0} and {high:.0} ms of {}", found.len());
            all.extend(found);
        }
        let mean = all.iter().sum::<f32>() / all.len() as f32;
        println!("mean {mean:.1} ms");
        assert!(mean < bound, "corresponding moments are {mean} ms apart");
    }
}
