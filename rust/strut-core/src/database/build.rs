//! Builds a database from labelled clips: preparation, registration, assembly (specification §2–§4).
//!
//! Offline and deterministic: the result is a function of the clips and options alone, whatever executor
//! computes it and in whatever order the clips are given.

mod add_style;
mod assemble;
pub(crate) mod prepare;
mod report;

pub use add_style::{AddStyleError, AddedStyle, add_style};
pub use report::{ActionReport, BuildReport, ClipReport, Refusal};

use super::{Database, DatabaseError, MAX_FRAMES};
use crate::humanoid::HumanoidMotion;
use crate::parallel::ParallelMap;
use crate::pose_vector::PoseChart;
use crate::registration::{self, Begun, Example};
use assemble::Kept;
use prepare::{Labels, Preparation, Prepared};
use std::borrow::Borrow;
use std::ops::{ControlFlow, RangeInclusive};
use thiserror::Error;

/// Fewest frames of a clip at the database's rate: a search window and its neighbours.
pub const MIN_CLIP_FRAMES: usize = 8;
/// Rates that a database may have, frames per second.
pub const RATES_HZ: RangeInclusive<f32> = 10.0..=480.0;

/// A labelled clip, retargeted to the database's proportions.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceClip {
    /// File stem or other name, for people.
    pub name: String,
    /// Name of the action, e.g. "walk".
    pub action: String,
    /// Name of the style, e.g. "old".
    pub style: String,
    /// Number of the take: orders the clips of a class.
    pub take: u32,
    /// The motion, at any rate; every clip of a build has the same proportions.
    pub motion: HumanoidMotion,
    /// Where the clip comes from.
    pub source: String,
    /// Its licence, empty if unknown.
    pub licence: String,
    /// Known correspondence with other clips of the action, where there is one.
    pub script: Option<Script>,
}

/// Known correspondence: performances of one script (a procedural motion rendered in every style, or clips
/// annotated by hand) show the same instant where their script times are equal. Used instead of
/// registration when every clip of an action has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Script {
    /// Clips of an action correspond only if they perform the same script; a style's counterparts of a
    /// frame come from all its performances of that script (the first 8).
    pub id: u32,
    /// Script time of every frame of the clip, at the clip's own rate: finite, strictly increasing, in
    /// seconds of a neutral performance. How fast it runs is how fast the style performs (`time_step`).
    pub time: Vec<f32>,
}

/// How a database is built.
#[derive(Clone, Debug, PartialEq)]
pub struct BuildOptions {
    /// Frames per second of the database, within [`RATES_HZ`]. The default, 60, is what every threshold of the
    /// specification was measured at.
    pub rate_hz: f32,
    /// Name of the neutral style; `None` takes "neutral" or "normal", else the first style.
    pub neutral: Option<String>,
    /// How clips are registered.
    pub registration: registration::Options,
}

impl Default for BuildOptions {
    fn default() -> Self {
        Self { rate_hz: 60.0, neutral: None, registration: registration::Options::default() }
    }
}

/// How far a build has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// What is being done.
    pub stage: Stage,
    /// Clips done in this stage.
    pub done: usize,
    /// Clips to do in this stage.
    pub total: usize,
}

/// A stage of a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Resampling, contacts, degrees of freedom.
    Preparing,
    /// Finding the clips' correspondence.
    Registering,
}

impl Stage {
    /// What is said to people while it lasts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Preparing => "preparing",
            Self::Registering => "registering",
        }
    }
}

/// Why nothing could be built.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BuildError {
    /// No clip was given.
    #[error("no clips were given; at least one is needed")]
    NoClips,
    /// The rate is out of range.
    #[error("the database's rate is {0} Hz; 10 to 480 was expected")]
    Rate(f32),
    /// No clip has the neutral style asked for.
    #[error("no usable clip has the neutral style '{wanted}'; the styles are {styles}")]
    Neutral {
        /// Name asked for.
        wanted: String,
        /// Names there are.
        styles: String,
    },
    /// Every clip was refused.
    #[error("every clip was refused; '{name}' because {reason}")]
    NothingLeft {
        /// Name of the first clip.
        name: String,
        /// Why it was refused.
        reason: Refusal,
    },
    /// More labels than an index can tell apart.
    #[error("{0} styles or actions; at most 65535 are supported")]
    TooManyLabels(usize),
    /// More frames than a database may have.
    #[error("the clips have {0} frames; at most {MAX_FRAMES} are supported")]
    TooManyFrames(usize),
    /// The progress function asked to stop.
    #[error("cancelled")]
    Cancelled,
    /// A clip holds values outside every reasonable range.
    #[error("the clips make no valid database: {0}")]
    Database(#[from] DatabaseError),
}

/// Builds a database from beginning to end: [`Build`] without a pause.
///
/// `progress` is told of every batch of clips and may cancel.
///
/// # Errors
/// See [`BuildError`].
pub fn build(
    clips: &[SourceClip],
    options: &BuildOptions,
    executor: &impl ParallelMap,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Database, BuildReport), BuildError> {
    let mut build = Build::new(clips.iter().collect(), options)?;
    while let Some(come) = build.step(executor)? {
        if progress(come).is_break() {
            return Err(BuildError::Cancelled);
        }
    }
    build.finish()
}

/// A build in steps: between two of them whoever runs it may do other things, and stop and go on as they like. The
/// result does not depend on it. `C` is a [`SourceClip`] or a reference to one.
///
/// Clips are sorted by action, style, take and name. A clip that cannot be used is refused with a reason
/// and reported, and the others are built without it.
pub struct Build<C> {
    clips: Vec<C>,
    options: BuildOptions,
    report: BuildReport,
    work: Work,
}

/// What a build is at.
enum Work {
    Preparing(Preparation),
    Registering(Box<Registering>),
}

/// Actions that were registered, the one that is, and those that are not yet.
struct Registering {
    labels: Labels,
    chart: PoseChart,
    kept: Vec<Kept>,
    begun: Option<(OfAction, Begun)>,
    /// The next one is the last.
    rest: Vec<OfAction>,
    done: usize,
    total: usize,
}

/// The examples of an action, and their numbers among the clips.
struct OfAction {
    indices: Vec<usize>,
    examples: Vec<Example>,
}

impl OfAction {
    fn job<'a>(&'a self, labels: &Labels, options: &'a BuildOptions) -> registration::Job<'a> {
        registration::Job {
            examples: &self.examples,
            styles: labels.styles.len(),
            neutral: labels.neutral,
            rate_hz: options.rate_hz,
            options: &options.registration,
        }
    }
}

impl<C: Borrow<SourceClip> + Sync> Build<C> {
    /// A build of these clips.
    ///
    /// # Errors
    /// If there are none, or the rate is out of range.
    pub fn new(mut clips: Vec<C>, options: &BuildOptions) -> Result<Self, BuildError> {
        if clips.is_empty() {
            return Err(BuildError::NoClips);
        }
        if !RATES_HZ.contains(&options.rate_hz) {
            return Err(BuildError::Rate(options.rate_hz));
        }
        clips.sort_by(|a, b| {
            let [a, b] = [a.borrow(), b.borrow()];
            (&a.action, &a.style, a.take, &a.name).cmp(&(&b.action, &b.style, b.take, &b.name))
        });
        let entries = clips.iter().map(|c| empty_report(c.borrow())).collect();
        let report = BuildReport { actions: Vec::new(), clips: entries };
        let work = Work::Preparing(Preparation::default());
        Ok(Self { clips, options: options.clone(), report, work })
    }

    /// The clips in the order of the database.
    pub fn clips(&self) -> &[C] {
        &self.clips
    }

    /// Goes on by a batch of clips, and says how far it has come; `None` when nothing is left but to
    /// [`finish`](Build::finish).
    ///
    /// # Errors
    /// See [`BuildError`]; the build cannot go on afterwards.
    pub fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<Progress>, BuildError> {
        match &mut self.work {
            Work::Preparing(preparation) => {
                if preparation.step(&self.clips, &self.options, executor) {
                    let (done, total) = (preparation.done(), self.clips.len());
                    return Ok(Some(Progress { stage: Stage::Preparing, done, total }));
                }
                let prepared = std::mem::take(preparation).finish(&self.clips, &self.options, executor)?;
                let registering = self.registering(prepared)?;
                let total = registering.total;
                self.work = Work::Registering(Box::new(registering));
                Ok(Some(Progress { stage: Stage::Registering, done: 0, total }))
            }
            Work::Registering(registering) => {
                let going_on = registering.step(&self.options, &mut self.report, executor);
                let (done, total) = (registering.done(), registering.total);
                Ok(going_on.then_some(Progress { stage: Stage::Registering, done, total }))
            }
        }
    }

    /// The database of what was registered.
    ///
    /// # Errors
    /// If nothing was.
    pub fn finish(self) -> Result<(Database, BuildReport), BuildError> {
        let Self { clips, options, report, work } = self;
        let Work::Registering(registering) = work else { return Err(BuildError::NoClips) };
        let Registering { labels, chart, kept, .. } = *registering;
        if kept.is_empty() {
            let first = report.refused().next().and_then(|c| Some((c.name.clone(), c.refused.clone()?)));
            return Err(first.map_or(BuildError::NoClips, |(name, reason)| BuildError::NothingLeft { name, reason }));
        }
        let parts = assemble::parts(&clips, &kept, labels, &chart, &options);
        Ok((Database::new(parts)?, report))
    }

    /// What there is to register: the examples that can be used, action by action.
    fn registering(&mut self, prepared: Prepared) -> Result<Registering, BuildError> {
        let Prepared { labels, chart, examples } = prepared;
        let (mut frames, mut total) = (0, 0);
        let mut rest: Vec<OfAction> = Vec::new();
        for (i, (example, entry)) in examples.into_iter().zip(&mut self.report.clips).enumerate() {
            let example = match example {
                Ok(example) => example,
                Err(refusal) => {
                    entry.refused = Some(refusal);
                    continue;
                }
            };
            entry.frames = example.frames();
            entry.turn = example.turn(self.options.rate_hz);
            frames += example.frames();
            total += 1;
            let action = |i: usize| &self.clips[i].borrow().action;
            let known = rest.last_mut().filter(|last| last.indices.first().is_some_and(|&j| action(i) == action(j)));
            match known {
                Some(last) => {
                    last.indices.push(i);
                    last.examples.push(example);
                }
                None => rest.push(OfAction { indices: vec![i], examples: vec![example] }),
            }
        }
        if frames > MAX_FRAMES {
            return Err(BuildError::TooManyFrames(frames));
        }
        rest.reverse();
        Ok(Registering { labels, chart, kept: Vec::new(), begun: None, rest, done: 0, total })
    }
}

impl Registering {
    /// Examples of the actions that are finished, and those of the present one that are done.
    fn done(&self) -> usize {
        self.done + self.begun.as_ref().map_or(0, |(_, begun)| begun.done())
    }

    /// Begins an action, goes on with it, or finishes it; whether there was anything to do.
    fn step(&mut self, options: &BuildOptions, report: &mut BuildReport, executor: &impl ParallelMap) -> bool {
        let Some((of, mut begun)) = self.begun.take() else {
            let Some(of) = self.rest.pop() else { return false };
            let begun = of.job(&self.labels, options).begin(executor);
            self.begun = Some((of, begun));
            return true;
        };
        if of.job(&self.labels, options).step(&mut begun, executor) {
            self.begun = Some((of, begun));
            return true;
        }
        let outcome = of.job(&self.labels, options).finish(begun);
        let OfAction { indices, examples } = of;
        self.done += examples.len();
        describe(report, &indices, &outcome, options.rate_hz);
        assemble::keep(&mut self.kept, indices, examples, outcome.clips);
        true
    }
}

fn empty_report(clip: &SourceClip) -> ClipReport {
    ClipReport {
        name: clip.name.clone(),
        action: clip.action.clone(),
        style: clip.style.clone(),
        take: clip.take,
        frames: 0,
        cycles: 0,
        mean_cycle_secs: None,
        turn: 0.0,
        registration_cost: None,
        faulty_cycles: Vec::new(),
        refused: None,
    }
}

/// Enters what registration found on one action; `indices` are the action's clips in the report.
fn describe(report: &mut BuildReport, indices: &[usize], outcome: &registration::Outcome, rate_hz: f32) {
    for (&i, found) in indices.iter().zip(&outcome.clips) {
        let entry = &mut report.clips[i];
        match found {
            Ok(registered) => {
                let cycles = &registered.cycles;
                let frames: usize = cycles.iter().map(std::ops::Range::len).sum();
                entry.cycles = cycles.len();
                entry.mean_cycle_secs = (!cycles.is_empty()).then(|| frames as f32 / cycles.len() as f32 / rate_hz);
                entry.registration_cost = registered.cost;
                entry.faulty_cycles.clone_from(&registered.faulty_cycles);
            }
            Err(refusal) => entry.refused = Some(refusal.clone().into()),
        }
    }
    if let Some(reference) = outcome.reference {
        let clip = &report.clips[indices[reference]];
        report.actions.push(ActionReport {
            action: clip.action.clone(),
            method: outcome.method,
            reference_clip: clip.name.clone(),
            canonical_frames: outcome.canonical_frames,
        });
    }
}

#[cfg(test)]
mod tests;
