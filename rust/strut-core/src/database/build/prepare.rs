//! Computes from labelled clips the data for registration and for the database.

use super::error::BuildError;
use super::options::BuildOptions;
use super::report::Refusal;
use super::source::{MIN_CLIP_FRAMES, SourceClip};
use crate::contact;
use crate::humanoid::HumanoidMotion;
use crate::incremental::IncrementalJob;
use crate::kinematics::world_from_local;
use crate::parallel::ParallelMap;
use crate::pose_vector::{
    HEADING_RATE, HeadingFilter, Placement, PoseChart, PoseRow, VELOCITY_X, VELOCITY_Z, point_cloud,
};
use crate::registration::Example;
use std::borrow::Borrow;
use std::collections::BTreeSet;

/// Clips per batch. A step of the job processes one batch.
const BATCH: usize = 24;
/// The chart's means are computed from at most about this many neutral poses; more would change nothing.
const CHART_POSES: usize = 4096;

/// Sorted names of styles and actions, and the neutral style.
pub(super) struct Labels {
    pub(super) actions: Vec<String>,
    pub(super) styles: Vec<String>,
    pub(super) neutral: u16,
}

/// The output of a [`Preparation`].
pub(super) struct Prepared<C> {
    pub(super) clips: Vec<C>,
    pub(super) labels: Labels,
    pub(super) chart: PoseChart,
    /// One entry for each clip, in the clips' order.
    pub(super) examples: Vec<Result<Example, Refusal>>,
}

struct Resampled {
    motion: HumanoidMotion,
    headings: Vec<f32>,
    script: Option<(u32, Vec<f32>)>,
}

/// Checks, resamples and encodes clips.
pub(super) struct Preparation<C> {
    clips: Vec<C>,
    options: BuildOptions,
    /// Index of a clip with the most common proportions.
    usual: usize,
    /// Results for the clips so far.
    resampled: Vec<Result<Resampled, Refusal>>,
}

impl<C: Borrow<SourceClip>> Preparation<C> {
    /// Prepares these clips.
    pub(super) fn new(clips: Vec<C>, options: BuildOptions) -> Self {
        let usual = most_common(clips.iter().map(|clip| &clip.borrow().motion.proportions));
        Self { clips, options, usual, resampled: Vec::new() }
    }

    /// The clips.
    pub(super) fn clips(&self) -> &[C] {
        &self.clips
    }
}

impl<C: Borrow<SourceClip> + Sync> IncrementalJob for Preparation<C> {
    /// Number of clips resampled so far.
    type Progress = usize;
    type Output = Prepared<C>;
    type Error = BuildError;

    /// Checks and resamples a batch of clips.
    fn step(&mut self, executor: &impl ParallelMap) -> Result<Option<usize>, BuildError> {
        let from = self.resampled.len().min(self.clips.len());
        let batch = &self.clips[from..self.clips.len().min(from + BATCH)];
        let one = |i: usize| resample(batch[i].borrow(), self.clips[self.usual].borrow(), self.options.rate_hz);
        let resampled = executor.map(batch.len(), &one);
        let any = !resampled.is_empty();
        self.resampled.extend(resampled);
        Ok(any.then_some(self.resampled.len()))
    }

    /// Encodes all clips.
    fn conclude(self, executor: &impl ParallelMap) -> Result<Prepared<C>, BuildError> {
        let Self { clips, options, resampled, .. } = self;
        let labels = labels(&clips, &resampled, &options)?;
        let neutral_clips = || {
            clips.iter().zip(&resampled).filter_map(|(c, r)| {
                let r = r.as_ref().ok()?;
                (c.borrow().style == labels.styles[usize::from(labels.neutral)]).then_some(r)
            })
        };
        let stride = neutral_clips().map(|r| r.motion.poses.len()).sum::<usize>().div_ceil(CHART_POSES).max(1);
        let chart = PoseChart::from_poses(
            neutral_clips().flat_map(|r| r.motion.poses.iter().zip(r.headings.iter().copied())).step_by(stride),
        );
        let examples = executor.map(clips.len(), &|i| {
            let style = labels.styles.binary_search(&clips[i].borrow().style).unwrap_or(0) as u16;
            let encoded =
                |r: &Resampled| Example { script: r.script.clone(), ..encode(&r.motion, &r.headings, style, &chart) };
            resampled[i].as_ref().map(encoded).map_err(Clone::clone)
        });
        Ok(Prepared { clips, labels, chart, examples })
    }
}

/// Index of the first occurrence of the most common value. Of equally common values the first one counts. 0 if there
/// are none.
fn most_common<T: PartialEq>(all: impl Iterator<Item = T>) -> usize {
    let mut counts: Vec<(T, usize, usize)> = Vec::new();
    for (i, value) in all.enumerate() {
        match counts.iter_mut().find(|(of, ..)| *of == value) {
            Some((_, _, count)) => *count += 1,
            None => counts.push((value, i, 1)),
        }
    }
    counts.iter().rev().max_by_key(|(.., count)| *count).map_or(0, |(_, first, _)| *first)
}

fn resample(clip: &SourceClip, usual: &SourceClip, rate_hz: f32) -> Result<Resampled, Refusal> {
    let motion = &clip.motion;
    if !(motion.rate_hz.is_finite() && motion.rate_hz > 0.0) {
        return Err(Refusal::Rate(motion.rate_hz));
    }
    if motion.proportions != usual.motion.proportions {
        return Err(Refusal::Proportions);
    }
    if let Some(frame) = motion.poses.iter().position(|p| !p.is_finite()) {
        return Err(Refusal::NotFinite(frame));
    }
    motion.frames_at(rate_hz)?;
    let script = match &clip.script {
        None => None,
        Some(script) => {
            let times = &script.time;
            let increases = |f: usize| times.get(f).is_some_and(|t| t.is_finite() && (f == 0 || *t > times[f - 1]));
            if let Some(frame) =
                (0..motion.poses.len().max(times.len())).find(|&f| !increases(f) || f >= motion.poses.len())
            {
                return Err(Refusal::Script(frame));
            }
            Some((script.id, resampled_times(times, motion.rate_hz, rate_hz)))
        }
    };
    let motion = motion.resampled(rate_hz)?;
    if motion.poses.len() < MIN_CLIP_FRAMES {
        return Err(Refusal::TooShort(motion.poses.len()));
    }
    let headings = headings(&motion);
    Ok(Resampled { motion, headings, script })
}

/// Smoothed heading of every frame.
pub fn headings(motion: &HumanoidMotion) -> Vec<f32> {
    let mut filter = HeadingFilter::default();
    let dt = 1.0 / motion.rate_hz;
    motion.poses.iter().map(|p| filter.update(&world_from_local(&motion.proportions, p), dt)).collect()
}

/// Values per frame at another rate, as [`HumanoidMotion::resampled`] does for poses.
fn resampled_times(times: &[f32], from_hz: f32, to_hz: f32) -> Vec<f32> {
    let step = f64::from(from_hz) / f64::from(to_hz);
    let last = times.len() - 1;
    let frames = (last as f64 / step + 1e-6).floor() as usize + 1;
    (0..frames)
        .map(|f| {
            let at = (f as f64 * step).min(last as f64);
            let i = (at.floor() as usize).min(last.saturating_sub(1));
            let next = times[(i + 1).min(last)];
            times[i] + (next - times[i]) * (at - i as f64) as f32
        })
        .collect()
}

/// A clip at the database's rate in the form that registration reads, without a script. `headings` has one entry for
/// each frame.
pub fn encode(motion: &HumanoidMotion, headings: &[f32], style: u16, chart: &PoseChart) -> Example {
    let mut previous = None;
    let mut pose: Vec<PoseRow> = Vec::with_capacity(motion.poses.len());
    for (p, &heading) in motion.poses.iter().zip(headings) {
        pose.push(chart.encode(p, heading, previous, 1.0 / motion.rate_hz));
        previous = Some(Placement { x: p.root.x, z: p.root.z, heading });
    }
    if pose.len() > 1 {
        // The first frame has no predecessor; zero velocity would be a false observation.
        for d in [VELOCITY_X, VELOCITY_Z, HEADING_RATE] {
            pose[0][d] = pose[1][d];
        }
    }
    let clouds =
        motion.poses.iter().zip(headings).map(|(p, &heading)| point_cloud(&motion.proportions, p, heading)).collect();
    Example { style, pose, point_cloud: clouds, contact: contact::label(motion), script: None }
}

/// Labels of the usable clips.
fn labels<C: Borrow<SourceClip>>(
    clips: &[C],
    resampled: &[Result<Resampled, Refusal>],
    options: &BuildOptions,
) -> Result<Labels, BuildError> {
    let usable = || clips.iter().zip(resampled).filter(|(_, r)| r.is_ok()).map(|(c, _)| c.borrow());
    let names = |name: fn(&SourceClip) -> &String| -> Vec<String> {
        usable().map(|c| name(c).clone()).collect::<BTreeSet<_>>().into_iter().collect()
    };
    let (actions, styles) = (names(|c| &c.action), names(|c| &c.style));
    if let Some(Err(reason)) = resampled.first()
        && styles.is_empty()
    {
        return Err(BuildError::NothingLeft { name: clips[0].borrow().name.clone(), reason: reason.clone() });
    }
    let most = actions.len().max(styles.len());
    if most > usize::from(u16::MAX) {
        return Err(BuildError::TooManyLabels(most));
    }
    let find = |name: &str| styles.iter().position(|s| s == name);
    let neutral = match &options.neutral {
        Some(wanted) => {
            find(wanted).ok_or_else(|| BuildError::Neutral { wanted: wanted.clone(), styles: styles.join(", ") })?
        }
        None => find("neutral").or_else(|| find("normal")).unwrap_or(0),
    };
    Ok(Labels { actions, styles, neutral: neutral as u16 })
}
