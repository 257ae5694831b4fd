//! Registration of real motion capture: contacts, gait cycles, label errors and pace are found.

mod mocap;

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use strut_core::database::build::{BuildOptions, BuildReport, Refusal, SourceClip, build};
use strut_core::database::{Database, TargetTable};
use strut_core::humanoid::Proportions;
use strut_core::parallel::ParallelMap;
use strut_core::registration::{self, Method};
use strut_core::retarget::{Binding, to_humanoid};
use strut_formats::bvh;

/// Two threads that take the next piece when they are done with one.
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

/// A clip named `{set}_{action}_{style}_{take}.bvh`.
fn load(path: &PathBuf) -> SourceClip {
    let name = path.file_stem().unwrap().to_string_lossy().into_owned();
    let labels: Vec<&str> = name.split('_').collect();
    let motion = bvh::parse(&std::fs::read(path).unwrap()).unwrap().to_motion().unwrap();
    let binding = Binding::detect(&motion).unwrap();
    SourceClip {
        action: labels[1].into(),
        style: labels[2].into(),
        take: labels[3].parse().unwrap(),
        motion: to_humanoid(&motion, &binding, &Proportions::default()),
        source: String::new(),
        licence: String::new(),
        script: None,
        name,
    }
}

/// The walking of the second Bandai Namco set, straight and turning.
fn walks() -> Option<(Database, BuildReport)> {
    let paths: Vec<PathBuf> =
        mocap::clips()?.into_iter().filter(|p| p.to_string_lossy().contains("dataset-2_walk")).collect();
    if paths.is_empty() {
        println!("skipped: no bandai-namco-2");
        return None;
    }
    let clips = TwoThreads.map(paths.len(), &|i| load(&paths[i]));
    let options = BuildOptions { neutral: Some("normal".into()), ..BuildOptions::default() };
    Some(build(&clips, &options, &TwoThreads, &mut |_| ControlFlow::Continue(())).unwrap())
}

#[test]
fn walking_is_registered_and_its_label_errors_are_found() {
    let Some((db, report)) = walks() else { return };

    // The clips that turn the other way are the set's known label errors.
    let mut refused: Vec<&str> = report.refused().map(|c| c.name.trim_start_matches("dataset-2_walk-turn-")).collect();
    refused.sort_unstable();
    let known = ["left_masculine_006", "left_masculine_007", "right_masculine_006", "right_masculine_007"];
    assert_eq!(refused, [known.as_slice(), &["right_normal_004"]].concat());
    assert!(
        report.refused().all(|c| {
            matches!(c.refused, Some(Refusal::Registration(registration::Refusal::TurnsTheOtherWay { .. })))
        })
    );

    // Contacts cut every clip into cycles of plausible length.
    assert!(report.actions.iter().all(|a| a.method == Method::Cycles));
    for clip in report.accepted() {
        assert!(clip.cycles >= 1 && clip.faulty_cycles.is_empty(), "{clip:?}");
        let secs = clip.mean_cycle_secs.unwrap();
        assert!((0.85..1.35).contains(&secs), "{}: {secs} s a cycle", clip.name);
    }

    // Counterparts stand on the same foot.
    for style in 0..db.styles.len() {
        let targets = TargetTable::build(&db, style as u16);
        let agreeing: usize = (0..db.frames())
            .map(|row| {
                let planted = |side: usize| db.contact[row][side] == 1;
                (0..2).filter(|&side| (targets.contact[row][side] > 0.5) == planted(side)).count()
            })
            .sum();
        let share = agreeing as f32 / (2 * db.frames()) as f32;
        assert!(share > 0.93, "{}: contacts agree in {share} of the frames", db.styles[style]);
    }

    // The pace of each style against normal walking, as a reference prototype found it.
    let walk = db.action_index("walk").unwrap();
    let class = db.classes().iter().find(|c| (c.action, c.style) == (walk, db.neutral)).unwrap();
    for (style, expected) in [("elderly", 0.92), ("active", 0.83), ("exhausted", 0.97), ("normal", 1.0)] {
        let targets = TargetTable::build(&db, db.style_index(style).unwrap());
        let secs: f32 = targets.step_secs[class.rows.clone()].iter().sum();
        let ratio = secs * db.rate_hz / class.rows.len() as f32;
        assert!((ratio - expected).abs() <= 0.04, "{style}: {ratio} times as long; about {expected} was expected");
    }
}
