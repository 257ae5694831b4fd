//! Registration of an action in steps.

use super::example::Example;
use super::features::Feature;
use super::gait::{self, Segment, SegmentKind};
use super::job::Job;
use super::matching::Warper;
use super::options::Options;
use super::outcome::{FaultyCycle, Method, Outcome, Refusal, Registered};
use super::pairing::{self, Paired};
use super::script;
use super::timeline::{self, CanonicalTime, Reference};
use crate::incremental::IncrementalJob;
use crate::parallel::ParallelMap;
use std::convert::Infallible;

/// Examples per batch. A step of the job processes one batch.
const BATCH: usize = 8;
/// Registration of an action: an [`IncrementalJob`] that owns its examples and returns them.
#[derive(Clone, Debug)]
pub struct Registration {
    examples: Vec<Example>,
    styles: usize,
    neutral: u16,
    rate_hz: f32,
    options: Options,
    state: RegistrationState,
}

impl Registration {
    /// Divides the examples into segments, and computes their features and canonical times: a small part of a
    /// registration's time. See [`Job`] for the parameters.
    pub fn new(
        examples: Vec<Example>,
        styles: usize,
        neutral: u16,
        rate_hz: f32,
        options: Options,
        executor: &impl ParallelMap,
    ) -> Self {
        let job = Job { examples: &examples, styles, neutral, rate_hz, options: &options };
        let state = job.begin(executor);
        Self { examples, styles, neutral, rate_hz, options, state }
    }

    /// Number of examples.
    pub fn total(&self) -> usize {
        self.examples.len()
    }

    /// Number of examples whose counterparts are known.
    pub fn done(&self) -> usize {
        self.state.paired.len()
    }
}

impl IncrementalJob for Registration {
    /// Number of examples whose counterparts are known.
    type Progress = usize;
    type Output = (Vec<Example>, Outcome);
    type Error = Infallible;

    fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<usize>, Infallible> {
        let Self { examples, styles, neutral, rate_hz, options, state } = self;
        let job = Job { examples, styles: *styles, neutral: *neutral, rate_hz: *rate_hz, options };
        Ok(job.step(state, executor).then_some(state.paired.len()))
    }

    fn conclude(self, _executor: &impl ParallelMap) -> Result<Self::Output, Infallible> {
        let Self { examples, styles, neutral, rate_hz, options, state } = self;
        let outcome = Job { examples: &examples, styles, neutral, rate_hz, options: &options }.finish(state);
        Ok((examples, outcome))
    }
}

/// Intermediate results of a registration.
#[derive(Clone, Debug, Default)]
struct RegistrationState {
    locomotion: bool,
    /// Reasons why examples are rejected.
    refusals: Vec<Option<Refusal>>,
    cuts: Vec<(Vec<Segment>, Vec<FaultyCycle>)>,
    features: Vec<Vec<Feature>>,
    reference: Option<Reference>,
    times: Vec<Option<CanonicalTime>>,
    /// Counterparts of the accepted examples that are done.
    paired: Vec<Paired>,
    /// The outcome, if it is known from scripts.
    outcome: Option<Outcome>,
}

impl Job<'_> {
    /// Registers the action completely.
    pub fn run(&self, executor: &impl ParallelMap) -> Outcome {
        let mut state = self.begin(executor);
        while self.step(&mut state, executor) {}
        self.finish(state)
    }

    /// Divides the examples into segments, and computes their features and canonical times: a small part of a
    /// registration's time.
    fn begin(&self, executor: &impl ParallelMap) -> RegistrationState {
        if self.examples.iter().all(|e| e.script.is_some()) {
            return RegistrationState { outcome: Some(script::register(self)), ..RegistrationState::default() };
        }
        let mut refusals = self.wrong_turns();
        let locomotion = gait::is_locomotion(self.examples, self.rate_hz);
        let cuts = if locomotion { gait::cut(self.examples, self.styles, self.rate_hz) } else { self.uncut() };
        for (refusal, (segments, _)) in refusals.iter_mut().zip(&cuts) {
            if segments.is_empty() && refusal.is_none() {
                *refusal = Some(Refusal::NoHeelStrikes);
            }
        }
        let features = self.features(&refusals, &cuts, locomotion, executor);
        let reference = self.reference(&refusals, &cuts, &features, locomotion);
        let times = self.canonical_times(&mut refusals, &cuts, &features, reference.as_ref(), executor);
        RegistrationState { locomotion, refusals, cuts, features, reference, times, paired: Vec::new(), outcome: None }
    }

    /// Finds the counterparts of a few more examples. Returns whether there were any left.
    fn step(&self, state: &mut RegistrationState, executor: &impl ParallelMap) -> bool {
        let parts = self.parts(state);
        let from = state.paired.len().min(parts.len());
        let batch = &parts[from..parts.len().min(from + BATCH)];
        let paired = executor.map(batch.len(), &|i| {
            let mut warper = Warper::new(self.options, self.rate_hz);
            pairing::pair(&batch[i], &parts, 0..self.styles, self.options, &mut warper)
        });
        let any = !paired.is_empty();
        state.paired.extend(paired);
        any
    }

    /// Outcome, after [`Job::step`] has nothing left to do.
    fn finish(&self, state: RegistrationState) -> Outcome {
        if let Some(outcome) = state.outcome {
            return outcome;
        }
        let agreed = self.agreed_times(&state);
        let RegistrationState { locomotion, refusals, cuts, reference, paired, .. } = state;
        let mut paired = paired.into_iter();
        let clips = refusals
            .into_iter()
            .zip(agreed)
            .zip(cuts)
            .map(|((refusal, time), (segments, faulty_cycles))| match (refusal, time) {
                (None, Some(time)) => {
                    let paired = paired.next().unwrap_or_default();
                    let whole = segments.into_iter().filter(|s| s.kind == SegmentKind::Cycle);
                    Ok(Registered {
                        canonical_time: time.time,
                        time_step: time.time_step,
                        counterparts: paired.counterparts,
                        cycles: whole.map(|s| s.frames).collect(),
                        faulty_cycles,
                        cost: paired.cost,
                    })
                }
                (refusal, _) => Err(refusal.unwrap_or(Refusal::NoWarp)),
            })
            .collect();
        Outcome {
            method: if locomotion { Method::Cycles } else { Method::WholeClips },
            reference: reference.as_ref().map(|r| r.example),
            canonical_frames: reference.as_ref().map_or(0.0, Reference::canonical_frames),
            clips,
        }
    }

    /// Parts of the accepted examples.
    fn parts<'b>(&'b self, state: &'b RegistrationState) -> Vec<pairing::Part<'b>> {
        let RegistrationState { refusals, features, cuts, .. } = state;
        (0..refusals.len()).filter(|&i| refusals[i].is_none()).map(|i| self.part(i, &features[i], &cuts[i].0)).collect()
    }

    /// Mean canonical times according to the counterparts; `None` for rejected examples.
    fn agreed_times(&self, state: &RegistrationState) -> Vec<Option<CanonicalTime>> {
        let RegistrationState { refusals, reference, times, paired, .. } = state;
        let mut paired = paired.iter();
        let agreed = |(refusal, time): (&Option<Refusal>, &Option<CanonicalTime>)| {
            let counterparts = if refusal.is_none() { &paired.next()?.counterparts } else { return None };
            let neutral = counterparts.iter().skip(usize::from(self.neutral)).step_by(self.styles);
            Some(timeline::agreed(time.as_ref()?, neutral, times, reference.as_ref()?, self.rate_hz))
        };
        refusals.iter().zip(times).map(agreed).collect()
    }
}
