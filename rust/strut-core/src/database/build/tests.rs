use super::*;
use crate::catalogue::{Catalogue, TargetTable};
use crate::database::Database;
use crate::humanoid::{HumanoidMotion, Pose, Proportions, Role};
use crate::incremental::IncrementalJob;
use crate::math::Quat;
use crate::math::float_funcs::{cos, sin};
use crate::parallel::{ParallelMap, Sequential};
use crate::registration;
use std::ops::ControlFlow;
use std::sync::Arc;

fn clip(action: &str, style: &str, take: u32, motion: HumanoidMotion) -> SourceClip {
    SourceClip {
        name: format!("{action}_{style}_{take}"),
        action: action.into(),
        style: style.into(),
        take,
        motion,
        source: "test".into(),
        licence: String::new(),
        script: None,
    }
}

/// The left arm rises and falls once per second of script time, performed at `pace` script seconds per second.
fn waving(style: &str, pace: f32, secs: f32) -> SourceClip {
    let frames = (secs / pace * 30.0) as usize + 1;
    let time: Vec<f32> = (0..frames).map(|f| f as f32 / 30.0 * pace).collect();
    let poses = time
        .iter()
        .map(|t| {
            let mut pose = Pose::default();
            let angle = 0.8 * sin(t * std::f32::consts::TAU);
            pose.rotations[Role::LeftUpperArm.index()] = Quat::from_rotation_z(angle);
            pose
        })
        .collect();
    let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 30.0, poses };
    SourceClip { script: Some(Script { id: 1, time }), ..clip("wave", style, 1, motion) }
}

/// Walk left, right, left: legs swing in antiphase, knees bend in the swing, the hips travel, and the path turns by
/// `turn` radians in total. `bend` leans the trunk, as a style.
fn walking(style: &str, take: u32, cycle_secs: f32, bend: f32, turn: f32) -> SourceClip {
    let frames = 300_u16;
    let mut root = crate::math::Vec3::new(0.0, 0.94, 0.0);
    let poses = (0..frames)
        .map(|f| {
            let secs = f32::from(f) / 60.0;
            let phase = (secs / cycle_secs + 0.1 * f32::from(take as u16)) * std::f32::consts::TAU;
            let heading = turn * f32::from(f) / f32::from(frames);
            root += Quat::from_rotation_y(heading) * crate::math::Vec3::new(0.0, 0.0, 1.0 / cycle_secs / 60.0);
            let mut pose = Pose { root, ..Pose::default() };
            pose.rotations[0] = Quat::from_rotation_y(heading);
            pose.rotations[Role::Chest.index()] = Quat::from_rotation_x(bend);
            for (upper, lower, arm, phase) in [
                (Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftUpperArm, phase),
                (Role::RightUpperLeg, Role::RightLowerLeg, Role::RightUpperArm, phase + std::f32::consts::PI),
            ] {
                pose.rotations[upper.index()] = Quat::from_rotation_x(-0.25 * sin(phase));
                pose.rotations[lower.index()] = Quat::from_rotation_x(0.9 * cos(phase).max(0.0));
                pose.rotations[arm.index()] = Quat::from_rotation_x(0.3 * sin(phase));
            }
            pose
        })
        .collect();
    let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses };
    clip("walk", style, take, motion)
}

/// Two styles, three takes each; the old walk takes 1.2 times as long and is bent.
fn two_styles() -> Vec<SourceClip> {
    (1..=3).flat_map(|take| [walking("neutral", take, 1.0, 0.0, 0.0), walking("old", take, 1.2, 0.5, 0.0)]).collect()
}

/// Styles of a gait, the last of which has one clip; and the database without that style.
fn with_and_without_the_last() -> (Vec<SourceClip>, Database) {
    let mut clips = two_styles();
    clips.extend((1..=2).map(|take| walking("sad", take, 1.1, 0.2, 0.0)));
    clips.push(walking("weary", 1, 1.3, 0.35, 0.0));
    let (db, _) = build(&clips[..clips.len() - 1], &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    (clips, db)
}

#[test]
fn a_style_added_later_has_nearly_the_counterparts_that_a_build_gives_it() {
    let (clips, db) = with_and_without_the_last();
    let added = add_style(&db, &clips[clips.len() - 1], &registration::Options::default(), &Sequential).unwrap();
    let (whole, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    let found = &added.database;
    assert_eq!((&found.styles, &found.pose.len()), (&whole.styles, &whole.pose.len()));
    assert_eq!(
        found.clips.iter().map(|c| &c.name).collect::<Vec<_>>(),
        whole.clips.iter().map(|c| &c.name).collect::<Vec<_>>()
    );
    // Compares the targets of every row in the new style, and the targets of the new style's rows in every other.
    let style = found.style_index("weary").unwrap();
    let new_rows = found.clips[found.clips.len() - 1].rows();
    let catalogues = [found, &whole].map(|db| Arc::new(Catalogue::new(db.clone())));
    for to in 0..found.styles.len() as u16 {
        let [a, b] = catalogues.each_ref().map(|catalogue| TargetTable::new(Arc::clone(catalogue), to));
        for row in 0..found.frames() {
            if to != style && !new_rows.contains(&row) {
                continue;
            }
            let apart = a.pose(row).iter().zip(&b.pose(row)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(apart < 0.1, "row {row} in style {to}: {apart}");
            let pace = a.step_secs(row) / b.step_secs(row);
            assert!((pace - 1.0).abs() < 0.15, "row {row} in style {to}: {pace}");
        }
    }
}

#[test]
fn adding_a_style_leaves_all_others_as_they_were() {
    let (clips, db) = with_and_without_the_last();
    let mut other = vec![waving("neutral", 1.0, 2.0), waving("old", 0.8, 2.0)];
    other.extend(clips[..clips.len() - 1].iter().cloned());
    let (two, _) = build(&other, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    for db in [db, two] {
        let added = add_style(&db, &clips[clips.len() - 1], &registration::Options::default(), &Sequential).unwrap();
        let (found, new) = (&added.database, added.database.clips.iter().position(|c| c.style == 3).unwrap());
        let new_rows = found.clips[new].rows();
        let row_now = |row: f32| if row >= new_rows.start as f32 { row + new_rows.len() as f32 } else { row };
        for row in 0..db.frames() {
            let now = row_now(row as f32) as usize;
            assert_eq!((db.pose[row], db.time_step[row]), (found.pose[now], found.time_step[now]));
            for style in 0..3 {
                let before: Vec<f32> = db.counterparts(row, style).map(row_now).collect();
                assert_eq!(before, found.counterparts(now, style).collect::<Vec<_>>());
            }
            let walks = db.actions[usize::from(db.clips[db.clip_of_row(row)].action)] == "walk";
            let of_new: Vec<f32> = found.counterparts(now, 3).collect();
            assert_eq!(!of_new.is_empty(), walks);
            assert!(of_new.iter().all(|at| new_rows.contains(&(at.round() as usize))));
        }
    }
}

#[test]
fn a_clip_that_is_no_style_is_refused_with_a_sentence() {
    let (clips, db) = with_and_without_the_last();
    let add = |clip: &SourceClip| {
        add_style(&db, clip, &registration::Options::default(), &Sequential).map(|_| ()).unwrap_err().to_string()
    };
    let walk = &clips[clips.len() - 1];
    let cut = |frames: usize| {
        let mut clip = walk.clone();
        clip.motion.poses.truncate(frames);
        clip
    };
    assert_eq!(
        add(&SourceClip { style: "old".into(), ..walk.clone() }),
        "the database already has a style 'old'; another name was expected"
    );
    assert_eq!(add(&cut(3)), "it has only 3 frames; at least 8 are needed");
    let no_gait = "it fits none of the database's actions (walk): it has no three steps in a row (left, right, \
                   left); a walk of at least three seconds was expected";
    assert_eq!(add(&cut(60)), no_gait);
    assert_eq!(add(&SourceClip { script: None, ..waving("wave", 1.0, 3.0) }), no_gait);
    let mut broken = walk.clone();
    broken.motion.poses[5].root.x = f32::NAN;
    assert_eq!(add(&broken), "frame 5 holds a value that is not a finite number");
}

#[test]
fn a_clip_that_fits_no_action_is_told_the_reason_of_the_one_that_it_comes_nearest_to() {
    let whirling = |style: &str, pace: f32, turn: f32| {
        let mut clip = waving(style, pace, 2.0);
        let frames = clip.motion.poses.len() as f32;
        for (pose, frame) in clip.motion.poses.iter_mut().zip(0_u16..) {
            pose.rotations[0] = Quat::from_rotation_y(turn * f32::from(frame) / frames);
        }
        SourceClip { action: "whirl".into(), script: None, ..clip }
    };
    let mut clips = two_styles();
    clips.extend([1.0, 1.1].map(|pace| whirling("neutral", pace, 1.6)));
    clips.extend([0.8, 0.9].map(|pace| whirling("old", pace, 1.6)));
    let (db, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.actions, ["walk", "whirl"]);
    // The clip turns too, but in the opposite direction.
    let other = whirling("weary", 0.9, -1.6);
    let refused = add_style(&db, &other, &registration::Options::default(), &Sequential);
    let reason = refused.map(|_| ()).unwrap_err().to_string();
    assert!(reason.contains("it turns against the action's usual direction"), "{reason}");
}

#[test]
fn an_action_that_a_person_gives_is_the_one_that_is_tried() {
    let mut clips = vec![waving("neutral", 1.0, 2.0), waving("old", 0.8, 2.0)];
    clips.extend(two_styles());
    let (db, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.actions, ["walk", "wave"]);
    let add = |action: Option<u16>| {
        let clip = SourceClip { script: None, ..waving("weary", 0.9, 2.0) };
        add_style_of(&db, &clip, action, &registration::Options::default(), &Sequential)
    };
    for action in [None, Some(1)] {
        let added = add(action).unwrap();
        assert_eq!((added.action, added.doubt), (1, None));
    }
    let refused = add(Some(0)).map(|_| ()).unwrap_err().to_string();
    assert!(refused.starts_with("it does not fit 'walk': it has no three steps"), "{refused}");
    assert!(refused.ends_with("; it fits 'wave'"), "{refused}");
}

/// Runs tasks in reverse order on one thread per task.
struct Backwards;

impl ParallelMap for Backwards {
    fn map<R: Send>(&self, n: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
        std::thread::scope(|scope| {
            let mut threads: Vec<_> = (0..n).rev().map(|i| scope.spawn(move || f(i))).collect();
            threads.reverse();
            threads.into_iter().map(|t| t.join().unwrap()).collect()
        })
    }
}

fn quiet(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn known_correspondence_gives_counterparts_at_equal_script_time() {
    let clips = [waving("slow", 0.5, 2.0), waving("neutral", 1.0, 2.0)];
    let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.styles, ["neutral", "slow"]);
    assert_eq!((db.neutral, db.clips[0].frames, db.clips[1].frames), (0, 121, 241));
    assert_eq!(report.actions[0].method, registration::Method::Scripts);
    for row in 2..119 {
        let there = db.counterparts(row, 1).next().unwrap();
        assert!((there - (121.0 + 2.0 * row as f32)).abs() < 1e-2, "row {row}: {there}");
        assert!((db.time_step[row] * 60.0 - 1.0).abs() < 1e-3);
        assert!((db.time_step[there as usize] * 60.0 - 2.0).abs() < 1e-2);
    }
}

#[test]
fn unusable_clips_are_refused_with_a_reason_and_the_rest_is_built() {
    let mut broken = waving("broken", 1.0, 2.0);
    broken.motion.poses[7].root.x = f32::NAN;
    let mut other_bones = waving("tall", 1.0, 2.0);
    other_bones.motion.proportions.offsets[1].y += 0.1;
    let mut backwards = waving("backwards", 1.0, 2.0);
    if let Some(script) = &mut backwards.script {
        script.time[5] = script.time[4];
    }
    let clips = [waving("neutral", 1.0, 2.0), broken, other_bones, backwards, waving("short", 1.0, 0.05)];
    let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.styles, ["neutral"]);
    let refused: Vec<_> = report.refused().map(|c| (c.style.as_str(), c.refused.clone().unwrap())).collect();
    assert_eq!(
        refused,
        [
            ("backwards", Refusal::Script(5)),
            ("broken", Refusal::NotFinite(7)),
            ("short", Refusal::TooShort(3)),
            ("tall", Refusal::Proportions),
        ]
    );
}

#[test]
fn one_clip_of_other_proportions_does_not_refuse_all_others_wherever_it_stands() {
    let mut tall = waving("alpha", 1.0, 2.0);
    tall.motion.proportions.offsets[1].y += 0.1;
    let clips = [tall.clone(), waving("slow", 0.5, 2.0), waving("fast", 1.5, 2.0)];
    for at in 0..3 {
        let mut clips = clips.clone();
        clips.swap(0, at);
        let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
        assert_eq!(db.styles, ["fast", "slow"]);
        let refused: Vec<_> = report.refused().map(|c| (c.style.as_str(), c.refused.clone().unwrap())).collect();
        assert_eq!(refused, [("alpha", Refusal::Proportions)]);
    }
    // If both proportions are equally common, the first clip by action, style and take decides.
    let (db, _) = build(&clips[..2], &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.styles, ["alpha"]);
}

#[test]
fn errors_say_what_was_expected() {
    let options = BuildOptions { neutral: Some("calm".into()), ..BuildOptions::default() };
    let error = build(&[waving("neutral", 1.0, 2.0)], &options, &Sequential, &mut quiet).unwrap_err();
    assert_eq!(error.to_string(), "no usable clip has the neutral style 'calm'; the styles are neutral");
    assert_eq!(build(&[], &options, &Sequential, &mut quiet).unwrap_err(), BuildError::NoClips);
    let cancelled =
        build(&[waving("a", 1.0, 2.0)], &BuildOptions::default(), &Sequential, &mut |_| ControlFlow::Break(()));
    assert_eq!(cancelled.unwrap_err(), BuildError::Cancelled);
}

#[test]
fn a_build_that_is_not_at_its_end_gives_no_database() {
    let clips = [waving("neutral", 1.0, 2.0), SourceClip { action: "beckon".into(), ..waving("neutral", 1.0, 2.0) }];
    let begun = || Build::new(clips.iter().collect(), &BuildOptions::default()).unwrap();
    let mut steps = 0;
    let mut whole = begun();
    while whole.step(&Sequential).unwrap().is_some() {
        steps += 1;
    }
    assert_eq!(whole.conclude(&Sequential).unwrap().0.actions, ["beckon", "wave"]);
    for taken in 0..steps {
        let mut build = begun();
        (0..taken).for_each(|_| _ = build.step(&Sequential).unwrap());
        let refused = build.conclude(&Sequential).map(|_| ()).unwrap_err().to_string();
        assert_eq!(refused, "the build failed earlier or is not finished", "after {taken} of {steps} steps");
    }
    let options = BuildOptions { neutral: Some("calm".into()), ..BuildOptions::default() };
    let mut failed = Build::new(clips.iter().collect(), &options).unwrap();
    let first = std::iter::from_fn(|| Some(failed.step(&Sequential))).find_map(Result::err).unwrap();
    assert!(matches!(first, BuildError::Neutral { .. }));
    let again = failed.step(&Sequential).unwrap_err().to_string();
    assert_eq!(again, "the build failed earlier or is not finished");
}

#[test]
fn a_gait_is_registered_cycle_by_cycle() {
    let (db, report) = build(&two_styles(), &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(report.actions[0].method, registration::Method::Cycles);
    assert!((report.actions[0].canonical_frames - 60.0).abs() < 1.5);
    for clip in &report.clips {
        let secs = if clip.style == "old" { 1.2 } else { 1.0 };
        assert!(clip.cycles >= 3 && clip.faulty_cycles.is_empty(), "{clip:?}");
        assert!((clip.mean_cycle_secs.unwrap() - secs).abs() < 0.02, "{clip:?}");
    }
    // Registered frames show the same phase of the gait: the angles of the legs, which no style changes, agree.
    let leg = 3 * Role::LeftUpperLeg.index();
    for row in 0..db.frames() {
        for style in 0..2 {
            for at in db.counterparts(row, style) {
                let other = &db.pose[at.round() as usize];
                assert!((db.pose[row][leg] - other[leg]).abs() < 0.06, "row {row} at {at}");
            }
        }
    }
    // A step of a neutral frame takes 1.2 times as long in the old style.
    let old = TargetTable::new(Arc::new(Catalogue::new(db.clone())), 1);
    let neutral_rows = db.classes()[0].rows.clone();
    let mean = neutral_rows.clone().map(|row| old.step_secs(row)).sum::<f32>() / neutral_rows.len() as f32;
    assert!((mean * 60.0 - 1.2).abs() < 0.02, "{mean}");
}

#[test]
fn counterparts_are_of_the_same_action_and_the_wanted_style_and_advance_with_time() {
    let mut clips = two_styles();
    clips.extend(two_styles().into_iter().map(|c| SourceClip { action: "stroll".into(), ..c }));
    let (db, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    for clip in &db.clips {
        for row in clip.rows() {
            for style in 0..2 {
                let found: Vec<f32> = db.counterparts(row, style).collect();
                assert!(!found.is_empty());
                for at in found {
                    let there = &db.clips[db.clip_of_row(at as usize)];
                    assert_eq!((there.action, there.style), (clip.action, style));
                    assert!(at <= (there.rows().end - 1) as f32);
                }
            }
        }
        // Within a cycle the counterparts come from the same segments and advance.
        for row in clip.rows().skip(1) {
            let (before, after) = (db.canonical_time[row - 1], db.canonical_time[row]);
            assert!(after > before || before - after > 30.0, "row {row}: {before} to {after}");
        }
    }
}

#[test]
fn the_result_does_not_depend_on_the_executor_or_the_order_of_clips() {
    let clips = two_styles();
    let mut reversed = clips.clone();
    reversed.reverse();
    let options = BuildOptions::default();
    let (a, report_a) = build(&clips, &options, &Sequential, &mut quiet).unwrap();
    let (b, report_b) = build(&reversed, &options, &Backwards, &mut quiet).unwrap();
    assert_eq!(*a, *b);
    assert_eq!(report_a, report_b);
}

#[test]
fn a_clip_that_turns_the_other_way_is_found() {
    let mut clips: Vec<_> = (1..=4).map(|take| walking("neutral", take, 1.0, 0.0, 1.6)).collect();
    clips.push(walking("old", 1, 1.2, 0.5, 1.5));
    clips.push(walking("old", 2, 1.2, 0.5, -1.5));
    let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(db.clips.len(), 5);
    let refused: Vec<_> = report.refused().collect();
    assert_eq!(refused.len(), 1);
    assert_eq!((refused[0].style.as_str(), refused[0].take), ("old", 2));
    let reason = refused[0].refused.as_ref().unwrap().to_string();
    assert!(reason.starts_with("it turns against the action's usual direction: -8"), "{reason}");
}

#[test]
fn every_warp_method_registers_a_gait() {
    for warp in [registration::WarpMethod::Dtw, registration::WarpMethod::Imw, registration::WarpMethod::Linear] {
        let options = BuildOptions {
            registration: registration::Options { warp, ..registration::Options::default() },
            ..BuildOptions::default()
        };
        let (db, _) = build(&two_styles(), &options, &Sequential, &mut quiet).unwrap();
        let old = TargetTable::new(Arc::new(Catalogue::new(db.clone())), 1);
        // Whole cycles only: those at the ends of a clip are not warped if time is linear.
        let rows = || db.clips.iter().filter(|c| c.style == 0).flat_map(|c| c.rows().skip(60).take(180));
        let mean = rows().map(|row| old.step_secs(row)).sum::<f32>() / rows().count() as f32;
        assert!((mean * 60.0 - 1.2).abs() < 0.03, "{warp:?}: {mean}");
    }
}

/// Time must not be gained or lost, even if no neutral cycle is whole and the canonical one belongs to another style.
#[test]
fn a_stretch_lasts_as_long_as_its_counterparts_advance() {
    let mut short = walking("neutral", 1, 1.0, 0.0, 0.0);
    short.motion.poses.truncate(50);
    let mut clips = vec![short];
    clips.extend((1..=3).map(|take| walking("old", take, 1.2, 0.5, 0.0)));
    for clips in [clips, two_styles()] {
        let (db, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
        let rows = db.clips.iter().find(|c| c.style == 0).unwrap().rows();
        let counterparts: Vec<Vec<f32>> = rows.clone().map(|row| db.counterparts(row, 1).collect()).collect();
        // Longest range in which every counterpart advances.
        let goes_on = |i: usize| {
            let [from, to] = [&counterparts[i], &counterparts[i + 1]];
            from.len() == to.len() && from.iter().zip(to).all(|(a, b)| (0.0..4.0).contains(&(b - a)))
        };
        let (mut stretch, mut first) = (0..0, 0);
        for i in 0..counterparts.len() - 1 {
            if !goes_on(i) {
                first = i + 1;
            } else if i + 1 - first > stretch.len() {
                stretch = first..i + 1;
            }
        }
        assert!(stretch.len() > 30, "{stretch:?}");
        let ends = [stretch.start, stretch.end].map(|i| &counterparts[i]);
        let advance = ends[0].iter().zip(ends[1]).map(|(a, b)| b - a).sum::<f32>() / ends[0].len() as f32;
        let old = TargetTable::new(Arc::new(Catalogue::new(db.clone())), 1);
        let secs: f32 = stretch.map(|i| old.step_secs(rows.start + i)).sum();
        assert!((secs * db.rate_hz / advance - 1.0).abs() < 0.02, "{secs} s for {advance} frames");
    }
}

#[test]
fn actions_without_steps_are_registered_as_whole_clips() {
    let mut clips = [waving("neutral", 1.0, 2.0), waving("slow", 0.6, 2.0)];
    for clip in &mut clips {
        clip.script = None;
    }
    let (db, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert_eq!(report.actions[0].method, registration::Method::WholeClips);
    let arm = 3 * Role::LeftUpperArm.index() + 2;
    for row in db.classes()[0].rows.clone() {
        let at = db.counterparts(row, 1).next().unwrap();
        assert!((db.pose[row][arm] - db.pose[at.round() as usize][arm]).abs() < 0.15, "row {row} at {at}");
    }
}

/// Stands, raises the arm along an individual curve without shared instants, and stands.
fn raising(style: &str, still_before: f32, raise_secs: f32, still_after: f32) -> SourceClip {
    let frames = ((still_before + raise_secs + still_after) * 60.0) as usize;
    let poses = (0..frames)
        .map(|f| {
            let part = ((f as f32 / 60.0 - still_before) / raise_secs).clamp(0.0, 1.0);
            let mut pose = Pose::default();
            pose.rotations[Role::LeftUpperArm.index()] = Quat::from_rotation_z(1.5 * part);
            pose.rotations[Role::RightUpperArm.index()] = Quat::from_rotation_z(-0.8 * sin(3.0 * part));
            pose
        })
        .collect();
    let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses };
    clip("raise", style, 1, motion)
}

#[test]
fn standing_of_different_length_is_not_stretched_onto_the_motion() {
    let (pause, secs, pace) = (0.2, 1.5, 1.2);
    let clips = [raising("neutral", pause, secs, 0.2), raising("slow", 2.5, secs * pace, 1.5)];
    let (db, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    let (neutral, slow) = (&db.clips[0], &db.clips[1]);
    for row in neutral.rows() {
        let part = ((row - neutral.first_frame) as f32 / 60.0 - pause) / secs;
        if (0.1..0.9).contains(&part) {
            let planted = slow.first_frame as f32 + (2.5 + part * secs * pace) * 60.0;
            let at = db.counterparts(row, slow.style).next().unwrap();
            assert!((at - planted).abs() <= 4.0, "{part} of the motion: {at}, planted {planted}");
        }
    }
}

#[test]
fn a_clip_unlike_the_others_has_the_greatest_residual() {
    let mut clips = two_styles();
    for (f, pose) in clips[0].motion.poses.iter_mut().enumerate() {
        pose.rotations[Role::RightUpperArm.index()] = Quat::from_rotation_z(-1.5 * sin(f as f32 * 0.05));
    }
    let odd = clips[0].name.clone();
    let (db, _) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    let residuals = crate::database::residuals(&db);
    let worst = (0..residuals.len()).max_by(|&a, &b| residuals[a].total_cmp(&residuals[b])).unwrap();
    assert_eq!(db.clips[worst].name, odd, "{residuals:?}");
    // The leaning trunk of the old walk is constant, so it does not count as residual.
    let (even, _) = build(&two_styles(), &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    assert!(crate::database::residuals(&even).iter().all(|r| *r < 0.02));
}

#[test]
fn bimodal_styles_are_reported_with_the_clips_of_each_cluster() {
    let neutral = (1..=4).map(|take| walking("neutral", take, 1.0, 0.01 * take as f32, 0.0));
    let bends = [0.4, 0.41, 0.6, 0.62, 0.61];
    let old = (1..).zip(bends).map(|(take, bend)| walking("old", take, 1.2, bend, 0.0));
    let clips: Vec<SourceClip> = neutral.chain(old).collect();
    let (_, report) = build(&clips, &BuildOptions::default(), &Sequential, &mut quiet).unwrap();
    let [found] = report.bimodal_styles.as_slice() else { panic!("{:?}", report.bimodal_styles) };
    assert_eq!((found.action.as_str(), found.style.as_str()), ("walk", "old"));
    assert_eq!(found.clips[0], ["walk_old_1", "walk_old_2"]);
    assert_eq!(found.clips[1], ["walk_old_3", "walk_old_4", "walk_old_5"]);
    assert!(found.separation > 1.4 && found.separation < 10.0, "{}", found.separation);
}
