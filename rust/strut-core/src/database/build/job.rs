//! A build as an incremental job: preparation, then the registration of each action.

use super::assemble::{self, Kept};
use super::error::BuildError;
use super::options::{BuildOptions, RATES_HZ};
use super::prepare::{Labels, Preparation, Prepared};
use super::report::{ActionReport, BuildReport, ClipReport};
use super::source::SourceClip;
use crate::database::{Database, MAX_FRAMES, bimodal_styles};
use crate::incremental::IncrementalJob;
use crate::parallel::ParallelMap;
use crate::pose_vector::PoseChart;
use crate::registration::{self, Example, Registration};
use std::borrow::Borrow;
use std::ops::ControlFlow;

/// Progress of a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Current stage.
    pub stage: Stage,
    /// Clips done in this stage.
    pub done: usize,
    /// Clips to do in this stage.
    pub total: usize,
}

/// A stage of a build.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Resampling, contacts and degrees of freedom are computed.
    Preparing,
    /// The clips' correspondence is computed.
    Registering,
}

impl Stage {
    /// Name of the stage in progress messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Preparing => "preparing",
            Self::Registering => "registering",
        }
    }
}

/// Builds a database: runs [`Build`] from start to end.
///
/// `progress` is called after every batch of clips and may cancel.
///
/// # Errors
/// See [`BuildError`].
pub fn build(
    clips: &[SourceClip],
    options: &BuildOptions,
    executor: &impl ParallelMap,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<(Database, BuildReport), BuildError> {
    Build::new(clips.iter().collect(), options)?.run(executor, progress)?.ok_or(BuildError::Cancelled)
}

/// A build in steps. The result does not depend on when they are executed. `C` is a [`SourceClip`] or a reference to one.
///
/// Clips are sorted by action, style, take and name. An invalid clip is rejected and reported with a reason, and the
/// database is built without it.
pub struct Build<C> {
    options: BuildOptions,
    report: BuildReport,
    phase: Phase<C>,
}

/// Phase of a build.
enum Phase<C> {
    Preparing(Preparation<C>),
    Registering(Box<Registering<C>>),
    /// The build has failed.
    Failed,
}

/// The registration of all actions.
struct Registering<C> {
    clips: Vec<C>,
    labels: Labels,
    chart: PoseChart,
    kept: Vec<Kept>,
    /// Action that is being registered: the indices of its examples among the clips, and its registration.
    current: Option<(Vec<usize>, Registration)>,
    /// Remaining actions; the next one is the last.
    rest: Vec<ActionExamples>,
    /// Number of examples of the finished actions.
    done: usize,
    total: usize,
}

/// Examples of an action, and their indices among the clips.
struct ActionExamples {
    indices: Vec<usize>,
    examples: Vec<Example>,
}

impl<C: Borrow<SourceClip> + Sync> Build<C> {
    /// Creates a build of these clips.
    ///
    /// # Errors
    /// If there are none, they are too long, or the rate is out of range.
    pub fn new(mut clips: Vec<C>, options: &BuildOptions) -> Result<Self, BuildError> {
        if clips.is_empty() {
            return Err(BuildError::NoClips);
        }
        if !RATES_HZ.contains(&options.rate_hz) {
            return Err(BuildError::Rate(options.rate_hz));
        }
        // A single clip that is too long is rejected later, with a reason.
        let frames = clips.iter().filter_map(|c| c.borrow().motion.frames_at(options.rate_hz).ok()).sum();
        if frames > MAX_FRAMES {
            return Err(BuildError::TooManyFrames(frames));
        }
        clips.sort_by(|a, b| {
            let [a, b] = [a.borrow(), b.borrow()];
            (&a.action, &a.style, a.take, &a.name).cmp(&(&b.action, &b.style, b.take, &b.name))
        });
        let entries = clips.iter().map(|c| empty_report(c.borrow())).collect();
        let report = BuildReport { clips: entries, ..BuildReport::default() };
        let phase = Phase::Preparing(Preparation::new(clips, options.clone()));
        Ok(Self { options: options.clone(), report, phase })
    }

    /// Clips in the order of the database; empty after an error.
    pub fn clips(&self) -> &[C] {
        match &self.phase {
            Phase::Preparing(preparation) => preparation.clips(),
            Phase::Registering(registering) => &registering.clips,
            Phase::Failed => &[],
        }
    }

    /// Usable examples, grouped by action.
    fn registering(&mut self, prepared: Prepared<C>) -> Registering<C> {
        let Prepared { clips, labels, chart, examples } = prepared;
        let mut total = 0;
        let mut rest: Vec<ActionExamples> = Vec::new();
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
            total += 1;
            let action = |i: usize| &clips[i].borrow().action;
            let known = rest.last_mut().filter(|last| last.indices.first().is_some_and(|&j| action(i) == action(j)));
            match known {
                Some(last) => {
                    last.indices.push(i);
                    last.examples.push(example);
                }
                None => rest.push(ActionExamples { indices: vec![i], examples: vec![example] }),
            }
        }
        rest.reverse();
        Registering { clips, labels, chart, kept: Vec::new(), current: None, rest, done: 0, total }
    }
}

impl<C: Borrow<SourceClip> + Sync> IncrementalJob for Build<C> {
    type Progress = Progress;
    type Output = (Database, BuildReport);
    type Error = BuildError;

    /// Processes a batch of clips. After an error it returns the error `Unfinished`.
    fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<Progress>, BuildError> {
        match std::mem::replace(&mut self.phase, Phase::Failed) {
            Phase::Preparing(mut preparation) => {
                if let Some(done) = preparation.step(executor)? {
                    let total = preparation.clips().len();
                    self.phase = Phase::Preparing(preparation);
                    return Ok(Some(Progress { stage: Stage::Preparing, done, total }));
                }
                let prepared = preparation.conclude(executor)?;
                let registering = self.registering(prepared);
                let total = registering.total;
                self.phase = Phase::Registering(Box::new(registering));
                Ok(Some(Progress { stage: Stage::Registering, done: 0, total }))
            }
            Phase::Registering(mut registering) => {
                let going_on = registering.step(&self.options, &mut self.report, executor);
                let (done, total) = (registering.done(), registering.total);
                self.phase = Phase::Registering(registering);
                Ok(going_on.then_some(Progress { stage: Stage::Registering, done, total }))
            }
            Phase::Failed => Err(BuildError::Unfinished),
        }
    }

    fn conclude(self, _executor: &impl ParallelMap) -> Result<Self::Output, BuildError> {
        let Self { options, mut report, phase } = self;
        let Phase::Registering(registering) = phase else { return Err(BuildError::Unfinished) };
        let Registering { clips, labels, chart, kept, current, rest, .. } = *registering;
        if current.is_some() || !rest.is_empty() {
            return Err(BuildError::Unfinished);
        }
        if kept.is_empty() {
            let first = report.refused().next().and_then(|c| Some((c.name.clone(), c.refused.clone()?)));
            return Err(first.map_or(BuildError::NoClips, |(name, reason)| BuildError::NothingLeft { name, reason }));
        }
        let parts = assemble::parts(&clips, &kept, labels, &chart, &options);
        let database = Database::new(parts)?;
        report.bimodal_styles = bimodal_styles(&database);
        Ok((database, report))
    }
}

impl<C> Registering<C> {
    /// Number of examples of the finished actions and of the current one that are done.
    fn done(&self) -> usize {
        self.done + self.current.as_ref().map_or(0, |(_, registration)| registration.done())
    }

    /// Starts, continues or finishes the registration of an action. Returns whether there was work left.
    fn step(&mut self, options: &BuildOptions, report: &mut BuildReport, executor: &impl ParallelMap) -> bool {
        let Some((indices, mut registration)) = self.current.take() else {
            let Some(ActionExamples { indices, examples }) = self.rest.pop() else { return false };
            let (styles, neutral) = (self.labels.styles.len(), self.labels.neutral);
            let settings = options.registration.clone();
            let registration = Registration::new(examples, styles, neutral, options.rate_hz, settings, executor);
            self.current = Some((indices, registration));
            return true;
        };
        let Ok(progress) = registration.step(executor);
        if progress.is_some() {
            self.current = Some((indices, registration));
            return true;
        }
        let Ok((examples, outcome)) = registration.conclude(executor);
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

/// Adds the registration results of one action to the report; `indices` are the action's clips in the report.
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
