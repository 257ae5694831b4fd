//! Database and inputs of the page.

use crate::drill::{Drill, perform_drill, script_secs};
use crate::drills::PAGE_DRILLS;
use crate::interlude::perform_interlude;
use crate::perform::{Performance, perform, perform_excursion};
use crate::script::Script;
use crate::style::Style;
use crate::styles::STYLES;
use crate::takes::{INPUT_EXCURSION, INPUT_TAKES, INTERLUDES, RUN_TAKES, WALK_TAKES};
use std::ops::ControlFlow;
use strut_core::database::Database;
use strut_core::database::build::{self, BuildError, BuildOptions, SourceClip};
use strut_core::humanoid::{HumanoidMotion, Pose, Proportions};
use strut_core::parallel::Sequential;
use strut_core::registration;

/// Rate of the built-in motions, frames per second.
pub const RATE_HZ: f32 = 60.0;

/// Length of the clips of [`first_walk_database`], in seconds of the neutral style.
const FIRST_SECS: f32 = 5.0;

/// A motion with a display name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMotion {
    /// For example "neutral walk".
    pub name: &'static str,
    /// The motion.
    pub motion: HumanoidMotion,
}

/// Every take of the page's database in every style, with its exact correspondence: input of [`build::build`], or clips
/// to be written to files.
pub fn clips() -> Vec<SourceClip> {
    let gaits = || (1..).zip(&WALK_TAKES).chain((1..).zip(&RUN_TAKES));
    let gaits = STYLES.iter().flat_map(|style| gaits().map(move |(take, script)| gait_clip(style, take, script)));
    gaits.chain(STYLES.iter().flat_map(|style| PAGE_DRILLS.iter().map(move |drill| drill_clip(style, drill)))).collect()
}

/// A script performed in a style.
fn gait_clip(style: &Style, take: u32, script: &Script) -> SourceClip {
    let performance = perform(script, style, &Proportions::default(), RATE_HZ);
    source_clip([script.action.name(), script.name, style.name], take, performance, neutral_secs(script))
}

/// A drill performed in a style.
fn drill_clip(style: &Style, drill: &Drill) -> SourceClip {
    let performance = perform_drill(drill, style, &Proportions::default(), RATE_HZ);
    source_clip([drill.action, drill.name, style.name], 1, performance, script_secs(drill))
}

/// Common time of all styles at a phase of a script: seconds of the neutral style at its preferred speed, with two
/// steps per stride.
pub(crate) fn neutral_secs(script: &Script) -> impl Fn(f32) -> f32 + use<> {
    let secs_per_stride = 120.0 / script.action.style(&STYLES[0]).cadence;
    move |phase| phase * secs_per_stride
}

/// A performance as input of a database, with the common time of all styles at its phases. The names are those of
/// action, take and style.
pub(crate) fn source_clip(
    [action, name, style]: [&str; 3],
    take: u32,
    performance: Performance,
    script_secs: impl Fn(f32) -> f32,
) -> SourceClip {
    let Performance { motion, phase, .. } = performance;
    SourceClip {
        name: format!("{action}-{name}_{style}"),
        action: action.into(),
        style: style.into(),
        take,
        motion,
        source: "procedural, strut-demo".into(),
        licence: env!("CARGO_PKG_LICENSE").into(),
        script: Some(build::Script { id: take, time: phase.into_iter().map(script_secs).collect() }),
    }
}

/// Page's database: every style of [`STYLES`], including neutral, with one counterpart per style.
///
/// # Errors
/// Never for the clips of this crate; the error is returned so that the caller need not panic.
pub fn database() -> Result<Database, BuildError> {
    build(&clips(), RATE_HZ)
}

/// [`database`] without some takes, in all styles, by their names such as "walk-pace".
///
/// # Errors
/// If no take of the neutral style is left.
pub fn database_without(takes: &[String]) -> Result<Database, BuildError> {
    let is_held_out = |clip: &SourceClip| {
        let take = clip.name.rsplit_once('_').map_or(clip.name.as_str(), |(take, _)| take);
        takes.iter().any(|held_out| held_out == take)
    };
    let clips: Vec<SourceClip> = clips().into_iter().filter(|clip| !is_held_out(clip)).collect();
    build(&clips, RATE_HZ)
}

/// Smallest useful database: the first walking take in every style of [`STYLES`]. Its clips and rows are those of
/// `whole`, which is [`database`].
///
/// # Errors
/// As for [`database`].
pub fn walk_database(whole: &Database) -> Result<Database, BuildError> {
    walks(whole, f32::INFINITY)
}

/// First parts of the clips of [`walk_database`], with which a page can start: the strides of medium length, and one
/// that is longer.
///
/// # Errors
/// As for [`database`].
pub fn first_walk_database(whole: &Database) -> Result<Database, BuildError> {
    walks(whole, FIRST_SECS)
}

/// First walking take in every style, with the length at which the neutral style takes `secs` seconds.
fn walks(whole: &Database, secs: f32) -> Result<Database, BuildError> {
    let clip = |style| {
        let mut clip = gait_clip(style, 1, &WALK_TAKES[0]);
        if let Some(script) = &mut clip.script {
            let frames = script.time.partition_point(|&time| time <= secs);
            script.time.truncate(frames);
            clip.motion.poses.truncate(frames);
        }
        clip
    };
    let clips: Vec<SourceClip> = STYLES.iter().map(clip).collect();
    let mut parts = (*build(&clips, RATE_HZ)?).clone();
    parts.chart = whole.chart;
    for clip in &parts.clips {
        if let Some(same) = whole.clips.iter().find(|c| c.name == clip.name) {
            parts.pose[clip.rows()].copy_from_slice(&whole.pose[same.rows()][..clip.frames]);
        }
    }
    Ok(Database::new(parts)?)
}

/// Input for [`walk_database`]: the first of [`input_clips`].
pub fn walk_input() -> NamedMotion {
    let script = &INPUT_TAKES[0];
    let motion = perform(script, &STYLES[0], &Proportions::default(), RATE_HZ).motion;
    NamedMotion { name: script.name, motion }
}

pub(crate) fn build(clips: &[SourceClip], rate_hz: f32) -> Result<Database, BuildError> {
    let options = BuildOptions {
        rate_hz,
        neutral: Some(STYLES[0].name.into()),
        registration: registration::Options { counterparts: 1, ..registration::Options::default() },
    };
    let (database, _) = build::build(clips, &options, &Sequential, &mut |_| ControlFlow::Continue(()))?;
    Ok(database)
}

/// Inputs of the page: neutral motions of other scripts than the database's, so that the transfer does not find the
/// input itself. Each can be looped: the last frame is followed by the pose of the first.
pub fn input_clips() -> Vec<NamedMotion> {
    let interludes = INTERLUDES.iter().map(|interlude| &interlude.gait.script);
    let names = INPUT_TAKES.iter().chain([&INPUT_EXCURSION.script]).chain(interludes).map(|script| script.name);
    names.filter_map(|name| Some(NamedMotion { name, motion: perform_input(name, &STYLES[0])?.motion })).collect()
}

/// An input of [`input_clips`], or a walk or run of [`database`] such as "walk-pace", in a style; `None` if the name is
/// unknown.
fn perform_input(name: &str, style: &Style) -> Option<Performance> {
    let body = Proportions::default();
    if name == INPUT_EXCURSION.script.name {
        return Some(perform_excursion(&INPUT_EXCURSION, style, &body, RATE_HZ));
    }
    if let Some(interlude) = INTERLUDES.iter().find(|i| i.gait.script.name == name) {
        return Some(perform_interlude(interlude, style, &body, RATE_HZ));
    }
    let mut takes = WALK_TAKES.iter().chain(&RUN_TAKES);
    let input = INPUT_TAKES.iter().find(|script| script.name == name);
    let script = input.or_else(|| takes.find(|take| name == format!("{}-{}", take.action.name(), take.name)))?;
    Some(perform(script, style, &body, RATE_HZ))
}

/// Performance of an input in another style, frame for frame with the input: the ideal result of a transfer.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterpart {
    /// Pose at the content of each input frame.
    pub poses: Vec<Pose>,
    /// Time at which the style has performed the content of each input frame, seconds.
    pub time_secs: Vec<f32>,
    /// For each input frame whether the left and the right foot is planted.
    pub planted: Vec<[bool; 2]>,
}

/// Counterpart of an input of [`input_clips`] in a style of [`STYLES`], by their names; `None` if a name is unknown.
/// Walks and runs of [`database`] also have one, by the name of their take such as "walk-pace".
pub fn counterpart(input: &str, style: &str) -> Option<Counterpart> {
    let style = STYLES.iter().find(|s| s.name == style)?;
    let neutral = perform_input(input, &STYLES[0])?;
    let styled = perform_input(input, style)?;
    let mut counterpart = Counterpart { poses: vec![], time_secs: vec![], planted: vec![] };
    let last = styled.phase.len() - 1;
    for phase in neutral.phase {
        let next = styled.phase.partition_point(|p| *p <= phase);
        let (a, b) = (next.saturating_sub(1), next.min(last));
        let span = styled.phase[b] - styled.phase[a];
        let share = if span > 0.0 { (phase - styled.phase[a]) / span } else { 0.0 };
        let poses = &styled.motion.poses;
        counterpart.poses.push(poses[a].lerp(&poses[b], share));
        counterpart.time_secs.push((a as f32 + share) / RATE_HZ);
        counterpart.planted.push(styled.planted[a]);
    }
    Some(counterpart)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_counterpart_of_an_input_in_its_own_style_is_itself() {
        for input in input_clips() {
            let same = counterpart(input.name, STYLES[0].name).unwrap();
            for (a, b) in same.poses.iter().zip(&input.motion.poses) {
                let turned = a.rotations.iter().zip(&b.rotations).map(|(a, b)| a.inv_mul(*b).angle());
                assert!((a.root - b.root).length() < 1e-6 && turned.fold(0.0, f32::max) < 1e-3, "{}", input.name);
            }
            assert!(same.time_secs.iter().enumerate().all(|(i, t)| (t - i as f32 / RATE_HZ).abs() < 1e-6));
        }
    }

    #[test]
    fn a_slower_style_takes_longer_for_the_same_content() {
        let input = &input_clips()[0];
        let neutral = perform_input(input.name, &STYLES[0]).unwrap();
        for style in &STYLES {
            let counterpart = counterpart(input.name, style.name).unwrap();
            assert_eq!(counterpart.poses.len(), input.motion.poses.len());
            assert!(counterpart.time_secs.windows(2).all(|t| t[0] < t[1]), "{}", style.name);
            let tempo = counterpart.time_secs.last().unwrap() * RATE_HZ / neutral.phase.len() as f32;
            assert!((tempo - STYLES[0].cadence / style.cadence).abs() < 0.1, "{}: {tempo}", style.name);
        }
    }

    #[test]
    fn a_take_can_be_held_out_and_is_performed_as_in_the_database() {
        let whole = database().unwrap();
        let rest = database_without(&["walk-pace".into(), "run-nothing".into()]).unwrap();
        let held_out: Vec<_> = whole.clips.iter().filter(|c| c.name.starts_with("walk-pace_")).collect();
        assert_eq!((held_out.len(), rest.clips.len()), (STYLES.len(), whole.clips.len() - STYLES.len()));
        assert!(rest.clips.iter().all(|c| !c.name.starts_with("walk-pace_")));
        let clip = clips().into_iter().find(|c| c.name == "walk-pace_old").unwrap();
        let neutral = clips().into_iter().find(|c| c.name == "walk-pace_neutral").unwrap();
        assert_eq!(counterpart("walk-pace", "neutral").unwrap().poses.len(), neutral.motion.poses.len());
        assert_eq!(counterpart("walk-pace", "old").unwrap().poses[0].root.y, clip.motion.poses[0].root.y);
    }

    #[test]
    fn what_is_not_built_in_has_no_counterpart() {
        assert_eq!(counterpart("walk.bvh", STYLES[0].name), None);
        assert_eq!(counterpart(input_clips()[0].name, "of a stranger"), None);
    }
}
