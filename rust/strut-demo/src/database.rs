//! The built-in database and the page's inputs.

use crate::perform::{Performance, perform};
use crate::script::{INPUT_TAKES, RUN_TAKES, Script, WALK_TAKES};
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

/// Every take of the built-in database in every style, with its exact correspondence: as input of
/// [`build::build`], or to be written to files.
pub fn clips() -> Vec<SourceClip> {
    let takes = || (1..).zip(&WALK_TAKES).chain((1..).zip(&RUN_TAKES));
    STYLES.iter().flat_map(|style| takes().map(move |(take, script)| clip(style, take, script))).collect()
}

fn clip(style: &Style, take: u32, script: &Script) -> SourceClip {
    let Performance { motion, phase, .. } = perform(script, style, &Proportions::default(), RATE_HZ);
    // Script time counts seconds of the neutral style at its preferred speed: two steps a stride.
    let secs_per_stride = 120.0 / script.action.style(&STYLES[0]).cadence;
    let time = phase.iter().map(|p| p * secs_per_stride).collect();
    SourceClip {
        name: format!("{}-{}_{}", script.action.name(), script.name, style.name),
        action: script.action.name().into(),
        style: style.name.into(),
        take,
        motion,
        source: "procedural, strut-demo".into(),
        licence: env!("CARGO_PKG_LICENSE").into(),
        script: Some(build::Script { id: take, time }),
    }
}

/// The built-in database: every style of [`STYLES`], neutral among them, with one counterpart a style.
///
/// # Errors
/// Never for the clips that this crate makes; the error is passed on so that the caller need not panic.
pub fn database() -> Result<Database, BuildError> {
    let options = BuildOptions {
        rate_hz: RATE_HZ,
        neutral: Some(STYLES[0].name.into()),
        registration: registration::Options { counterparts: 1, ..registration::Options::default() },
    };
    let (database, _) = build::build(&clips(), &options, &Sequential, &mut |_| ControlFlow::Continue(()))?;
    Ok(database)
}

/// What the page offers as input: neutral motions of other scripts than the database's, so that nothing is
/// transferred by finding itself. Each can be repeated: after its last frame comes its first one's pose.
pub fn input_clips() -> Vec<NamedMotion> {
    INPUT_TAKES
        .iter()
        .map(|script| NamedMotion {
            name: script.name,
            motion: perform(script, &STYLES[0], &Proportions::default(), RATE_HZ).motion,
        })
        .collect()
}
