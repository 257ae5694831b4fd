//! The database in full size: composed as Table 1 of Xia et al. 2015, which counts 79,829 frames at 120 Hz.

use crate::database::{build, gait_clip, source_clip};
use crate::drill::{Drill, perform_drill, script_secs};
use crate::drills::{JUMPS, KICKS, PUNCHES};
use crate::script::{LONG_WALK, RUN_TAKES, Script, WALK_TAKES};
use crate::style::{STYLES, Style};
use strut_core::database::Database;
use strut_core::database::build::{BuildError, SourceClip};
use strut_core::humanoid::Proportions;

/// Rate of the motions in full size, frames per second.
pub const FULL_RATE_HZ: f32 = 120.0;

/// Frames of every action over all styles: Table 1 of the paper.
pub const TABLE_1: [(&str, usize); 6] =
    [("walk", 49_461), ("run", 7_835), ("jump", 6_293), ("punch", 7_125), ("kick", 6_970), ("transition", 2_145)];

/// What is performed.
enum Take {
    Gait(&'static Script),
    Drill(&'static Drill),
}

/// The takes of an action, more than its frames need.
fn takes(action: &str) -> Vec<Take> {
    match action {
        "walk" => WALK_TAKES.iter().chain(&LONG_WALK).map(Take::Gait).collect(),
        "run" => RUN_TAKES.iter().map(Take::Gait).collect(),
        "jump" => vec![Take::Drill(&JUMPS)],
        "punch" => vec![Take::Drill(&PUNCHES)],
        "kick" => vec![Take::Drill(&KICKS)],
        _ => vec![],
    }
}

fn clip(take: &Take, number: u32, style: &Style) -> SourceClip {
    match take {
        Take::Gait(script) => gait_clip(style, number, script, FULL_RATE_HZ),
        Take::Drill(drill) => {
            let performance = perform_drill(drill, style, &Proportions::default(), FULL_RATE_HZ);
            source_clip([drill.action, drill.name, style.name], number, performance, script_secs(drill))
        }
    }
}

/// Every take of the full database in every style, with its exact correspondence. The last take of an action ends, in
/// every style at the same moment of its script, where the action has the frames that [`TABLE_1`] counts.
pub fn full_clips() -> Vec<SourceClip> {
    TABLE_1.iter().flat_map(|&(action, frames)| action_clips(action, frames)).collect()
}

fn action_clips(action: &str, mut frames: usize) -> Vec<SourceClip> {
    let mut clips = Vec::new();
    for (number, take) in (1..).zip(takes(action)) {
        let mut performed: Vec<SourceClip> = STYLES.iter().map(|style| clip(&take, number, style)).collect();
        cut(&mut performed, frames);
        frames -= performed.iter().map(|c| c.motion.poses.len()).sum::<usize>();
        clips.append(&mut performed);
        if frames == 0 {
            break;
        }
    }
    clips
}

/// Ends all clips at one moment of their script so that they have at most so many frames together.
fn cut(clips: &mut [SourceClip], frames: usize) {
    let times = |clip: &SourceClip| clip.script.as_ref().map_or(vec![], |s| s.time.clone());
    let mut moments: Vec<(f32, usize)> =
        clips.iter().enumerate().flat_map(|(i, clip)| times(clip).into_iter().map(move |t| (t, i))).collect();
    moments.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    moments.truncate(frames);
    for (i, clip) in clips.iter_mut().enumerate() {
        let kept = moments.iter().filter(|m| m.1 == i).count();
        clip.motion.poses.truncate(kept);
        if let Some(script) = &mut clip.script {
            script.time.truncate(kept);
        }
    }
}

/// The full database: every style of [`STYLES`], with one counterpart a style.
///
/// # Errors
/// Never for the clips that this crate makes; the error is passed on so that the caller need not panic.
pub fn full_database() -> Result<Database, BuildError> {
    build(&full_clips(), FULL_RATE_HZ)
}
