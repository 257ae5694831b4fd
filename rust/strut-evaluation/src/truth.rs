//! Ground truth of a performance: the target style's take, registered to it.

use super::off_database::heading_free_points;
use std::ops::Range;
use strut_core::database::build::{encode, headings};
use strut_core::humanoid::{HumanoidMotion, JOINTS};
use strut_core::math::Vec3;
use strut_core::metrics::Points;
use strut_core::parallel::Sequential;
use strut_core::pose_vector::PoseChart;
use strut_core::registration::{Example, Job, Options};

/// Greatest slope of a warp in frames per frame (its limit, with a margin for smoothing). A larger step is a change to
/// another cycle.
const GREATEST_PACE: f64 = 4.0;

/// Another performance of the same action, aligned with a source frame by frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Aligned {
    /// Joint positions at every frame of the source, without root and heading, metres.
    pub points: Vec<Points>,
    /// The performance's own time at every frame of the source, seconds; it is continuous within a segment only.
    pub time_secs: Vec<f64>,
}

/// Other performances, aligned with a source.
#[derive(Clone, Debug, PartialEq)]
pub struct Alignment {
    /// Ranges of the source that are compared: whole gait cycles, or all of a clip without cycles.
    pub segments: Vec<Range<usize>>,
    /// The other performances in order; `None` if one cannot be registered.
    pub others: Vec<Option<Aligned>>,
}

/// Errors of a prediction relative to an [`Aligned`] truth, means over the frames of the segments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Errors {
    /// Mean joint distance, without root and heading, metres.
    pub pose: f64,
    /// Mean difference of the time since the segment's first frame, seconds.
    pub timing: f64,
    /// Mean distance of the joints' velocities, without root and heading, per second of input; m/s.
    pub velocity: f64,
    /// Number of frames compared.
    pub frames: usize,
}

/// Root-free joint positions of every frame.
pub(super) fn points_of(motion: &HumanoidMotion) -> Vec<Points> {
    heading_free_points(motion).iter().map(root_free).collect()
}

/// Positions relative to the hips.
pub(super) fn root_free(points: &Points) -> Points {
    points.map(|p| p - points[0])
}

/// Registers each other performance to the source separately: the cycle (or clip) of least cost is its counterpart. All
/// motions have one frame rate and one body.
///
/// `None` if the source cannot be registered.
pub fn align(source: &HumanoidMotion, others: &[&HumanoidMotion]) -> Option<Alignment> {
    let chart = PoseChart::from_poses(source.poses.iter().zip(headings(source)));
    let motions: Vec<&HumanoidMotion> = std::iter::once(source).chain(others.iter().copied()).collect();
    // Each performance is treated as a separate style, so that each gets its own counterparts.
    let examples: Vec<Example> =
        motions.iter().enumerate().map(|(i, m)| encode(m, &headings(m), i as u16, &chart)).collect();
    let options = Options { counterparts: 1, ..Options::default() };
    let job =
        Job { examples: &examples, styles: motions.len(), neutral: 0, rate_hz: source.rate_hz, options: &options };
    let outcome = job.run(&Sequential);
    let of_source = outcome.clips.first()?.as_ref().ok()?;
    let whole = || std::iter::once(0..examples[0].frames()).collect();
    let segments = if of_source.cycles.is_empty() { whole() } else { of_source.cycles.clone() };
    let others = (1..motions.len())
        .map(|style| {
            let points = points_of(motions[style]);
            let counterpart = |frame: usize| of_source.counterparts[frame * motions.len() + style][0].map(|c| c.frame);
            let frames: Vec<f32> = (0..examples[0].frames()).map(counterpart).collect::<Option<_>>()?;
            Some(Aligned {
                points: frames.iter().map(|&at| between(&points, at)).collect(),
                time_secs: running_time(&frames, source.rate_hz),
            })
        })
        .collect();
    Some(Alignment { segments, others })
}

/// Time along counterparts, seconds. Where the counterpart changes to another cycle, the last pace is kept.
fn running_time(frames: &[f32], rate_hz: f32) -> Vec<f64> {
    let (mut time, mut pace) = (0.0, 1.0);
    let mut elapsed = vec![0.0; frames.len().min(1)];
    for pair in frames.windows(2) {
        let step = f64::from(pair[1] - pair[0]);
        pace = if (0.0..=GREATEST_PACE).contains(&step) { step } else { pace };
        time += pace;
        elapsed.push(time / f64::from(rate_hz));
    }
    elapsed
}

fn between(points: &[Points], at: f32) -> Points {
    let i = (at as usize).min(points.len() - 1);
    let j = (i + 1).min(points.len() - 1);
    std::array::from_fn(|k| points[i][k].lerp(points[j][k], at - i as f32))
}

impl Aligned {
    /// The unchanged source as a prediction.
    pub fn unchanged(source: &HumanoidMotion) -> Self {
        let rate = f64::from(source.rate_hz);
        Self { points: points_of(source), time_secs: (0..source.poses.len()).map(|i| i as f64 / rate).collect() }
    }

    /// Frame-by-frame mean of some performances; `None` without any.
    pub fn mean(of: &[&Self]) -> Option<Self> {
        let first = of.first()?;
        let share = 1.0 / of.len() as f32;
        let points = (0..first.points.len())
            .map(|f| std::array::from_fn(|j| of.iter().map(|a| a.points[f][j]).sum::<Vec3>() * share))
            .collect();
        let time_secs = (0..first.time_secs.len())
            .map(|f| of.iter().map(|a| a.time_secs[f]).sum::<f64>() * f64::from(share))
            .collect();
        Some(Self { points, time_secs })
    }

    /// Errors relative to the truth over the segments of the source. Both have one entry for each source frame.
    pub fn errors(&self, truth: &Self, segments: &[Range<usize>], rate_hz: f32) -> Errors {
        let (mut pose, mut timing, mut velocity, mut frames) = (0.0, 0.0, 0.0, 0_usize);
        for segment in segments {
            let start = segment.start;
            for f in segment.clone() {
                frames += 1;
                let elapsed = |a: &Self| a.time_secs[f] - a.time_secs[start];
                timing += (elapsed(self) - elapsed(truth)).abs();
                pose += distance(&self.points[f], &truth.points[f]);
                if f > start {
                    let step = |a: &Self| std::array::from_fn(|j| a.points[f][j] - a.points[f - 1][j]);
                    velocity += distance(&step(self), &step(truth)) * f64::from(rate_hz);
                }
            }
        }
        let n = frames.max(1) as f64;
        Errors { pose: pose / n, timing: timing / n, velocity: velocity / n, frames }
    }
}

/// Mean distance of corresponding joints except the hips, which are the removed root.
fn distance(a: &Points, b: &Points) -> f64 {
    a.iter().zip(b).map(|(p, q)| f64::from((*p - *q).length())).sum::<f64>() / (JOINTS - 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_runs_on_where_another_cycle_takes_over() {
        // Half pace, then the same phase of a cycle 60 frames earlier, at half pace again.
        let frames = [100.0, 100.5, 101.0, 41.5, 42.0];
        assert_eq!(running_time(&frames, 50.0), [0.0, 0.01, 0.02, 0.03, 0.04]);
        assert!(running_time(&[], 50.0).is_empty());
    }

    #[test]
    fn errors_are_means_over_the_segments() {
        let still = |x: f32, pace: f64| Aligned {
            points: vec![std::array::from_fn(|j| if j == 0 { Vec3::ZERO } else { Vec3::new(x, 0.0, 0.0) }); 10],
            time_secs: (0..10).map(|i| f64::from(i) * pace).collect(),
        };
        let errors = still(0.03, 0.02).errors(&still(0.0, 0.01), &[2..5, 7..9], 60.0);
        assert!((errors.pose - 0.03).abs() < 1e-6 && errors.velocity == 0.0, "{errors:?}");
        // 0, 10 and 20 ms, then 0 and 10 ms: time counts from the start of each segment.
        assert!((errors.timing - 0.008).abs() < 1e-9 && errors.frames == 5, "{errors:?}");
        assert_eq!(Aligned::mean(&[&still(1.0, 0.25), &still(3.0, 0.75)]), Some(still(2.0, 0.5)));
        assert_eq!(Aligned::mean(&[]), None);
    }
}
