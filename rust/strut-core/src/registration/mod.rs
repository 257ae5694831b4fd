//! Finds which frames of differently styled clips of an action show the same instant (specification §4).
//!
//! Every example becomes a sequence of feature vectors ([`features`]) and is cut into segments: gait cycles
//! for actions that walk or run ([`gait`]), else the clip from its first motion to its last ([`rest`]). Segments
//! are matched by a slope-limited time warp ([`dtw`], [`imw`] or linear time; what one clip shows of an action
//! and the other does not is left out, at a cost), once to the action's reference cycle, which gives canonical
//! time ([`timeline`]), and once to the segments of every style that fit best, which gives counterparts
//! ([`pairing`]). Known correspondence ([`script`]) replaces all of this.

mod addition;
pub mod dtw;
mod features;
pub mod gait;
mod imw;
mod matching;
mod pairing;
mod rest;
mod script;
mod smooth;
mod timeline;
pub mod warp;

pub use addition::Addition;

use crate::database::MAX_COUNTERPARTS;
use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::parallel::ParallelMap;
use crate::pose_vector::{HEADING_RATE, PoseRow};
use features::Feature;
use gait::{Segment, SegmentKind};
use matching::Warper;
use pairing::Paired;
use std::ops::Range;
use thiserror::Error;
pub(crate) use timeline::time_steps;
use timeline::{CanonicalTime, Reference};

/// One clip of an action, as registration sees it. All arrays have one entry a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Example {
    /// Number of the style.
    pub style: u16,
    /// Degrees of freedom.
    pub pose: Vec<PoseRow>,
    /// Heading-free joint positions, metres.
    pub point_cloud: Vec<[Vec3; JOINTS]>,
    /// Planted feet, left and right.
    pub contact: Vec<[bool; 2]>,
    /// Known correspondence: number of the script and the strictly increasing script time in seconds.
    pub script: Option<(u32, Vec<f32>)>,
}

impl Example {
    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.pose.len()
    }

    /// Change of heading over the clip, radians, positive to the left; whole turns count.
    pub fn turn(&self, rate_hz: f32) -> f32 {
        self.pose.iter().skip(1).map(|row| row[HEADING_RATE]).sum::<f32>() / rate_hz
    }
}

/// How segments are warped onto each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum WarpMethod {
    /// Dynamic time warping of style-normalised features: the best measured (specification §4).
    #[default]
    Dtw,
    /// Iterative motion warping (Hsu et al. 2005), the paper's choice.
    Imw,
    /// Linear time between the segment's ends: the baseline.
    Linear,
}

/// Settings of registration. The defaults were measured (specification §4).
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// How segments are warped.
    pub warp: WarpMethod,
    /// Counterparts of a frame in each style, 1 to 8; the target is their average. Best 1: 1.84 cm of
    /// error, best 3: 1.77, best 8: 1.75.
    pub counterparts: usize,
    /// Segments of each style that are warped, chosen by their distance in linear time; those of least cost
    /// become counterparts.
    pub candidates: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { warp: WarpMethod::Dtw, counterparts: MAX_COUNTERPARTS, candidates: 20 }
    }
}

impl Options {
    /// [`Options::counterparts`] within its range.
    pub fn counterparts(&self) -> usize {
        self.counterparts.clamp(1, MAX_COUNTERPARTS)
    }
}

/// A frame of another example, possibly between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counterpart {
    /// Number of the example.
    pub example: u32,
    /// Frame in it, 0 to its last.
    pub frame: f32,
}

/// A frame's counterparts in one style; `None`s come last.
pub type Counterparts = [Option<Counterpart>; MAX_COUNTERPARTS];

/// What was found for one example.
#[derive(Clone, Debug, PartialEq)]
pub struct Registered {
    /// Time on the action's canonical timeline of every frame, in canonical frames.
    pub canonical_time: Vec<f32>,
    /// Seconds of the clip per canonical frame at every frame; positive.
    pub time_step: Vec<f32>,
    /// Counterparts: frames × styles.
    pub counterparts: Vec<Counterparts>,
    /// Whole gait cycles.
    pub cycles: Vec<Range<usize>>,
    /// Stretches between heel strikes that are no gait cycle.
    pub faulty_cycles: Vec<FaultyCycle>,
    /// Mean cost of the counterparts' warps (squared feature distance a frame); `None` for known correspondence.
    pub cost: Option<f32>,
}

/// A stretch between two left heel strikes that is no gait cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultyCycle {
    /// Its frames.
    pub frames: Range<usize>,
    /// What is wrong with it.
    pub fault: CycleFault,
}

/// What is wrong with a stretch between two left heel strikes.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum CycleFault {
    /// Not exactly one right heel strike.
    #[error("{0} right heel strikes; 1 was expected")]
    RightStrikes(usize),
    /// A duration far from the usual one.
    #[error("it lasts {found_secs:.2} s; about {usual_secs:.2} s is usual")]
    Duration {
        /// Its duration, seconds.
        found_secs: f32,
        /// Median over the clip's cycles, or the style's if the clip has few; seconds.
        usual_secs: f32,
    },
}

/// Why an example does not fit the others of its action.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Refusal {
    /// The action walks or runs, and this clip has no left heel strike to cut it at.
    #[error("no left heel strike was found in it, though the action walks or runs")]
    NoHeelStrikes,
    /// A clip that is to be a style of a walk or a run has no whole cycle of steps.
    #[error("no left, right and left step in a row were found in it; a walk of three seconds or more was expected")]
    NoGait,
    /// A walk or a run that is to be a style of an action that is neither.
    #[error("it walks or runs, which the action does not")]
    Gait,
    /// It turns against the action's usual direction; radians, positive to the left.
    #[error("it turns the other way: {:.0}°, where {:.0}° is usual for the action", turn.to_degrees(), usual.to_degrees())]
    TurnsTheOtherWay {
        /// Turn of the clip.
        turn: f32,
        /// Median turn of the action's clips.
        usual: f32,
    },
    /// No time warp within the slope limit leads to the action's reference.
    #[error("no time warp leads to the action's reference clip: it is more than three times longer or shorter")]
    NoWarp,
}

/// How an action's correspondence was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Gait cycle by gait cycle.
    Cycles,
    /// Each clip as a whole.
    WholeClips,
    /// It was known.
    Scripts,
}

impl Method {
    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cycles => "cycles",
            Self::WholeClips => "whole clips",
            Self::Scripts => "scripts",
        }
    }
}

/// What was found for the examples of an action.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// How the correspondence was found.
    pub method: Method,
    /// The example that the canonical timeline comes from; `None` if all were refused.
    pub reference: Option<usize>,
    /// Length of the canonical timeline in frames.
    pub canonical_frames: f32,
    /// One entry an example.
    pub clips: Vec<Result<Registered, Refusal>>,
}

/// The registration of one action.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// All clips of the action, sorted by style.
    pub examples: &'a [Example],
    /// Number of styles in the database; every example's style is below.
    pub styles: usize,
    /// The neutral style, whose cycles set the canonical timeline.
    pub neutral: u16,
    /// Frames per second of all examples.
    pub rate_hz: f32,
    /// Settings.
    pub options: &'a Options,
}

/// Examples handed to the executor at a time: between two batches other things can be done.
const BATCH: usize = 8;
/// A clip turns the other way if it turns by more than the first angle against the action's usual turn of
/// more than the second, which is usual if this share of the clips turns so; radians.
const OPPOSITE_TURN: f32 = 0.6;
const USUAL_TURN: f32 = 0.9;
const USUAL_TURN_SHARE: f32 = 0.7;

/// What a registration has found so far; see [`Job::begin`].
#[derive(Clone, Debug, Default)]
pub struct Begun {
    locomotion: bool,
    /// Why an example takes no part.
    refusals: Vec<Option<Refusal>>,
    cuts: Vec<(Vec<Segment>, Vec<FaultyCycle>)>,
    features: Vec<Vec<Feature>>,
    reference: Option<Reference>,
    times: Vec<Option<CanonicalTime>>,
    /// Of the examples that take part, as far as they are done.
    paired: Vec<Paired>,
    /// Where all of it is known beforehand.
    outcome: Option<Outcome>,
}

impl Begun {
    /// Examples whose counterparts are known.
    pub fn done(&self) -> usize {
        self.paired.len()
    }
}

impl Job<'_> {
    /// Registers the action from beginning to end.
    pub fn run(&self, executor: &impl ParallelMap) -> Outcome {
        let mut begun = self.begin(executor);
        while self.step(&mut begun, executor) {}
        self.finish(begun)
    }

    /// Cuts, describes and times the examples, which takes little of a registration's time.
    pub fn begin(&self, executor: &impl ParallelMap) -> Begun {
        if self.examples.iter().all(|e| e.script.is_some()) {
            return Begun { outcome: Some(script::register(self)), ..Begun::default() };
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
        Begun { locomotion, refusals, cuts, features, reference, times, paired: Vec::new(), outcome: None }
    }

    /// Finds the counterparts of a few more examples; whether there were any left.
    pub fn step(&self, begun: &mut Begun, executor: &impl ParallelMap) -> bool {
        let parts = self.parts(begun);
        let from = begun.paired.len().min(parts.len());
        let batch = &parts[from..parts.len().min(from + BATCH)];
        let paired = executor.map(batch.len(), &|i| {
            let mut warper = Warper::new(self.options, self.rate_hz);
            pairing::pair(&batch[i], &parts, 0..self.styles, self.options, &mut warper)
        });
        let any = !paired.is_empty();
        begun.paired.extend(paired);
        any
    }

    /// What was found, once [`Job::step`] has nothing left.
    pub fn finish(&self, begun: Begun) -> Outcome {
        if let Some(outcome) = begun.outcome {
            return outcome;
        }
        let agreed = self.agreed_times(&begun);
        let Begun { locomotion, refusals, cuts, reference, paired, .. } = begun;
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

    /// The examples that take part.
    fn parts<'b>(&'b self, begun: &'b Begun) -> Vec<pairing::Part<'b>> {
        let Begun { refusals, features, cuts, .. } = begun;
        (0..refusals.len()).filter(|&i| refusals[i].is_none()).map(|i| self.part(i, &features[i], &cuts[i].0)).collect()
    }

    /// The canonical times that the counterparts agree on; `None` for examples that take no part.
    fn agreed_times(&self, begun: &Begun) -> Vec<Option<CanonicalTime>> {
        let Begun { refusals, reference, times, paired, .. } = begun;
        let mut paired = paired.iter();
        let agreed = |(refusal, time): (&Option<Refusal>, &Option<CanonicalTime>)| {
            let counterparts = if refusal.is_none() { &paired.next()?.counterparts } else { return None };
            let neutral = counterparts.iter().skip(usize::from(self.neutral)).step_by(self.styles);
            Some(timeline::agreed(time.as_ref()?, neutral, times, reference.as_ref()?, self.rate_hz))
        };
        refusals.iter().zip(times).map(agreed).collect()
    }

    /// Clips that turn against the direction in which most clips of the action turn.
    fn wrong_turns(&self) -> Vec<Option<Refusal>> {
        let turns: Vec<f32> = self.examples.iter().map(|e| e.turn(self.rate_hz)).collect();
        let mut sorted = turns.clone();
        sorted.sort_by(f32::total_cmp);
        let usual = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let agreeing = turns.iter().filter(|t| **t * usual > 0.0 && t.abs() > USUAL_TURN).count();
        let has_usual = usual.abs() > USUAL_TURN && agreeing as f32 >= USUAL_TURN_SHARE * turns.len() as f32;
        turns
            .iter()
            .map(|&turn| {
                let opposite = has_usual && turn * usual < 0.0 && turn.abs() > OPPOSITE_TURN;
                opposite.then_some(Refusal::TurnsTheOtherWay { turn, usual })
            })
            .collect()
    }

    /// What moves of every clip as one segment.
    fn uncut(&self) -> Vec<(Vec<Segment>, Vec<FaultyCycle>)> {
        let whole =
            |e: &Example| vec![Segment { frames: rest::moving(&e.point_cloud, self.rate_hz), kind: SegmentKind::Clip }];
        self.examples.iter().map(|e| (whole(e), Vec::new())).collect()
    }

    /// What is paired of an example.
    fn part<'b>(&'b self, example: usize, features: &'b [Feature], segments: &'b [Segment]) -> pairing::Part<'b> {
        let Example { style, point_cloud, .. } = &self.examples[example];
        pairing::Part { example, style: *style, features, point_cloud, segments }
    }

    /// Features of the examples not refused, empty for the others.
    fn features(
        &self,
        refusals: &[Option<Refusal>],
        cuts: &[(Vec<Segment>, Vec<FaultyCycle>)],
        cyclic: bool,
        executor: &impl ParallelMap,
    ) -> Vec<Vec<Feature>> {
        let used: Vec<&Example> =
            self.examples.iter().zip(refusals).filter(|(_, r)| r.is_none()).map(|(e, _)| e).collect();
        let whole = |(segments, _): &(Vec<Segment>, _)| {
            segments.first().map_or(0, |s| s.frames.start)..segments.last().map_or(0, |s| s.frames.end)
        };
        let compared: Vec<Range<usize>> =
            cuts.iter().zip(refusals).filter(|(_, r)| r.is_none()).map(|(cut, _)| whole(cut)).collect();
        let mut features =
            features::of_examples(&used, &compared, self.styles, self.rate_hz, cyclic, executor).into_iter();
        let mut next = |r: &Option<Refusal>| if r.is_none() { features.next() } else { None };
        refusals.iter().map(|r| next(r).unwrap_or_default()).collect()
    }

    /// The most typical cycle (or clip) of the neutral style, or of all if the neutral style has none.
    fn reference(
        &self,
        refusals: &[Option<Refusal>],
        cuts: &[(Vec<Segment>, Vec<FaultyCycle>)],
        features: &[Vec<Feature>],
        cyclic: bool,
    ) -> Option<Reference> {
        let candidates = |style: Option<u16>| -> Vec<(usize, Range<usize>)> {
            (0..self.examples.len())
                .filter(|&i| refusals[i].is_none() && style.is_none_or(|s| s == self.examples[i].style))
                .flat_map(|i| cuts[i].0.iter().map(move |s| (i, s)))
                .filter(|(_, s)| matches!(s.kind, SegmentKind::Cycle | SegmentKind::Clip))
                .map(|(i, s)| (i, s.frames.clone()))
                .collect()
        };
        Reference::choose(&candidates(Some(self.neutral)), features, cyclic)
            .or_else(|| Reference::choose(&candidates(None), features, cyclic))
    }

    /// Canonical time of the examples not refused; refuses those that have none.
    fn canonical_times(
        &self,
        refusals: &mut [Option<Refusal>],
        cuts: &[(Vec<Segment>, Vec<FaultyCycle>)],
        features: &[Vec<Feature>],
        reference: Option<&Reference>,
        executor: &impl ParallelMap,
    ) -> Vec<Option<CanonicalTime>> {
        let accepted: Vec<bool> = refusals.iter().map(Option::is_none).collect();
        let times = executor.map(self.examples.len(), &|i| {
            let reference = reference.filter(|_| accepted[i])?;
            let mut warper = Warper::new(self.options, self.rate_hz);
            timeline::canonical_time(&cuts[i].0, &features[i], reference, features, self.rate_hz, &mut warper)
        });
        for (refusal, time) in refusals.iter_mut().zip(&times) {
            if refusal.is_none() && time.is_none() {
                *refusal = Some(Refusal::NoWarp);
            }
        }
        times
    }
}

#[cfg(test)]
mod tests;
