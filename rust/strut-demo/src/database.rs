//! The page's database and its inputs.

use crate::perform::{Performance, perform, perform_excursion};
use crate::script::{INPUT_EXCURSION, INPUT_TAKES, RUN_TAKES, Script, WALK_TAKES};
use crate::style::{STYLES, Style};
use std::ops::ControlFlow;
use strut_core::database::Database;
use strut_core::database::build::{self, BuildError, BuildOptions, SourceClip};
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::parallel::Sequential;
use strut_core::registration;

/// Rate of the built-in motions, frames per second.
pub const RATE_HZ: f32 = 60.0;

/// A motion with a name for people.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMotion {
    /// For example "neutral walk".
    pub name: &'static str,
    /// The motion.
    pub motion: HumanoidMotion,
}

/// Every take of the page's database in every style, with its exact correspondence: as input of
/// [`build::build`], or to be written to files.
pub fn clips() -> Vec<SourceClip> {
    let takes = || (1..).zip(&WALK_TAKES).chain((1..).zip(&RUN_TAKES));
    STYLES.iter().flat_map(|style| takes().map(move |(take, script)| gait_clip(style, take, script))).collect()
}

/// A script performed in a style.
fn gait_clip(style: &Style, take: u32, script: &Script) -> SourceClip {
    let performance = perform(script, style, &Proportions::default(), RATE_HZ);
    source_clip([script.action.name(), script.name, style.name], take, performance, neutral_secs(script))
}

/// The time that all styles share at a phase of a script: seconds of the neutral style at its preferred speed, which
/// takes two steps a stride.
pub(crate) fn neutral_secs(script: &Script) -> impl Fn(f32) -> f32 + use<> {
    let secs_per_stride = 120.0 / script.action.style(&STYLES[0]).cadence;
    move |phase| phase * secs_per_stride
}

/// A performance as input of a database, with the time that all styles share at its phases. The names are those of
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

/// The page's database: every style of [`STYLES`], neutral among them, with one counterpart a style.
///
/// # Errors
/// Never for the clips that this crate makes; the error is passed on so that the caller need not panic.
pub fn database() -> Result<Database, BuildError> {
    build(&clips(), RATE_HZ)
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

/// What the page offers as input: neutral motions of other scripts than the database's, so that nothing is
/// transferred by finding itself. Each can be repeated: after its last frame comes its first one's pose.
pub fn input_clips() -> Vec<NamedMotion> {
    let (neutral, body) = (&STYLES[0], Proportions::default());
    let takes = INPUT_TAKES.iter().map(|script| (script.name, perform(script, neutral, &body, RATE_HZ)));
    let excursion = perform_excursion(&INPUT_EXCURSION, neutral, &body, RATE_HZ);
    let all = takes.chain([(INPUT_EXCURSION.script.name, excursion)]);
    all.map(|(name, performance)| NamedMotion { name, motion: performance.motion }).collect()
}
