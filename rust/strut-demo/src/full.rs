//! Full-size database with the composition of Table 1 of Xia et al. 2015, which counts 79,829 frames at 120 Hz.

use crate::database::{build, neutral_secs, source_clip};
use crate::drill::{Drill, perform_drill, script_secs};
use crate::drills::{JUMPS, KICKS, PUNCHES};
use crate::perform::{Performance, Transition, perform, perform_transition};
use crate::script::Script;
use crate::style::Style;
use crate::styles::STYLES;
use crate::takes::{LONG_WALK, RUN_TAKES, TRANSITIONS, WALK_TAKES};
use strut_core::database::Database;
use strut_core::database::build::{BuildError, SourceClip};
use strut_core::humanoid::Proportions;

/// Frame rate of the full-size motions, frames per second.
pub const FULL_RATE_HZ: f32 = 120.0;

/// Frames of every action over all styles: Table 1 of the paper.
pub const TABLE_1: [(&str, usize); 6] =
    [("walk", 49_461), ("run", 7_835), ("jump", 6_293), ("punch", 7_125), ("kick", 6_970), ("transition", 2_145)];

/// A planned performance.
enum Take {
    Gait(&'static Script),
    Drill(&'static Drill),
    Transition(&'static Transition),
}

/// A clip of the full-size database with data of its plan.
#[derive(Clone, Debug)]
pub struct PlannedClip {
    /// The clip as input of a database.
    pub clip: SourceClip,
    /// For each frame whether the left and the right foot is planted.
    pub planted: Vec<[bool; 2]>,
}

/// Takes of an action with the maximum number of frames of each; together more than the action needs.
fn takes(action: &str) -> Vec<(Take, usize)> {
    let gait = |script| (Take::Gait(script), usize::MAX);
    match action {
        "walk" => WALK_TAKES.iter().chain(&LONG_WALK).map(gait).collect(),
        "run" => RUN_TAKES.iter().map(gait).collect(),
        "jump" => vec![(Take::Drill(&JUMPS), usize::MAX)],
        "punch" => vec![(Take::Drill(&PUNCHES), usize::MAX)],
        "kick" => vec![(Take::Drill(&KICKS), usize::MAX)],
        // Both directions get the same share.
        _ => TRANSITIONS.iter().map(|t| (Take::Transition(t), 1_073)).collect(),
    }
}

fn clip(take: &Take, number: u32, style: &Style) -> PlannedClip {
    let body = Proportions::default();
    let planned = |performance: Performance, action: &str, name: &str, secs: &dyn Fn(f32) -> f32| {
        let planted = performance.planted.clone();
        PlannedClip { clip: source_clip([action, name, style.name], number, performance, secs), planted }
    };
    match take {
        Take::Gait(script) => {
            let performance = perform(script, style, &body, FULL_RATE_HZ);
            planned(performance, script.action.name(), script.name, &neutral_secs(script))
        }
        Take::Drill(drill) => {
            let performance = perform_drill(drill, style, &body, FULL_RATE_HZ);
            planned(performance, drill.action, drill.name, &script_secs(drill))
        }
        Take::Transition(transition) => {
            let performance = perform_transition(transition, style, &body, FULL_RATE_HZ);
            planned(performance, "transition", transition.script.name, &neutral_secs(&transition.script))
        }
    }
}

/// Every take of the full-size database in every style, with its exact correspondence. The last take of an action ends
/// in every style at the same moment of its script, such that the action has the number of frames in [`TABLE_1`].
pub fn full_clips() -> Vec<PlannedClip> {
    TABLE_1.iter().flat_map(|&(action, frames)| action_clips(action, frames)).collect()
}

fn action_clips(action: &str, mut frames: usize) -> Vec<PlannedClip> {
    let mut clips = Vec::new();
    for (number, (take, most)) in (1..).zip(takes(action)) {
        let mut performed: Vec<PlannedClip> = STYLES.iter().map(|style| clip(&take, number, style)).collect();
        cut(&mut performed, frames.min(most));
        frames -= performed.iter().map(|c| c.planted.len()).sum::<usize>();
        clips.append(&mut performed);
        if frames == 0 {
            break;
        }
    }
    clips
}

/// Ends all clips at one moment of their script, such that they have at most `frames` frames in total.
fn cut(clips: &mut [PlannedClip], frames: usize) {
    let times = |c: &PlannedClip| c.clip.script.as_ref().map_or(vec![], |s| s.time.clone());
    let mut moments: Vec<(f32, usize)> =
        clips.iter().enumerate().flat_map(|(i, clip)| times(clip).into_iter().map(move |t| (t, i))).collect();
    moments.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    moments.truncate(frames);
    for (i, PlannedClip { clip, planted }) in clips.iter_mut().enumerate() {
        let kept = moments.iter().filter(|m| m.1 == i).count();
        planted.truncate(kept);
        clip.motion.poses.truncate(kept);
        if let Some(script) = &mut clip.script {
            script.time.truncate(kept);
        }
    }
}

/// Full-size database: every style of [`STYLES`], with one counterpart per style.
///
/// # Errors
/// Never for the clips of this crate; the error is returned so that the caller need not panic.
pub fn full_database() -> Result<Database, BuildError> {
    let clips: Vec<SourceClip> = full_clips().into_iter().map(|c| c.clip).collect();
    build(&clips, FULL_RATE_HZ)
}
