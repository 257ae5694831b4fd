//! Styling a whole clip: the online engine, with contacts and footplant that may look both ways.

use super::contact_likelihood::smoothed;
use super::footplant::Footplant;
use super::frame::{StageClock, StyledFrame, Trace};
use super::stylizer::Stylizer;
use crate::humanoid::{HumanoidMotion, Pose, Proportions};
use std::ops::ControlFlow;

/// A styled clip: frames at uneven output times.
#[derive(Clone, Debug, PartialEq)]
pub struct StyledMotion {
    /// Bone offsets: the database's.
    pub proportions: Proportions,
    /// One frame for each frame of the input.
    pub frames: Vec<StyledFrame>,
}

/// A styled clip at an even rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Resampled {
    /// The clip.
    pub motion: HumanoidMotion,
    /// For each of its frames the fractional frame of the input that it comes from.
    pub input_frame: Vec<f64>,
}

/// A clip on its way through the engine, frame by frame: for callers that have other things to do in
/// between. [`stylize_clip`] is the same in one call.
#[derive(Clone, Debug)]
pub struct ClipJob {
    stylizer: Stylizer,
    /// Frames so far, before contacts are smoothed and feet planted.
    frames: Vec<StyledFrame>,
}

impl ClipJob {
    /// Begins a clip with the stylizer's styles and options; its past is forgotten.
    pub fn new(mut stylizer: Stylizer) -> Self {
        stylizer.reset(None);
        Self { stylizer, frames: Vec::new() }
    }

    /// Styles the next frame of the clip, which is at the database's rate.
    pub fn push(&mut self, pose: &Pose, clock: &mut impl StageClock) -> Trace<'_> {
        self.frames.push(*self.stylizer.predict_frame(pose, clock));
        self.stylizer.trace()
    }

    /// The frames so far, before contacts are smoothed and feet planted.
    pub fn frames(&self) -> &[StyledFrame] {
        &self.frames
    }

    /// Ends the clip: contacts are smoothed and feet planted with a view of what comes after.
    pub fn finish(self) -> StyledMotion {
        let Self { stylizer, mut frames } = self;
        let votes: Vec<[f32; 2]> = frames.iter().map(|f| f.contact).collect();
        let db = stylizer.model().database();
        let mut footplant = Footplant::new(db.proportions);
        for (frame, contact) in frames.iter_mut().zip(smoothed(&votes)) {
            frame.contact = contact;
            if stylizer.options().footplant {
                frame.planted = footplant.apply(&mut frame.pose, contact, 1.0 / db.rate_hz);
            }
        }
        StyledMotion { proportions: db.proportions, frames }
    }
}

/// Styles a clip at the database's rate with the styles and options of a stylizer, whose own stream is not
/// touched.
///
/// `observe` sees every frame before contacts are smoothed and feet planted, with its number; it may stop
/// the work, which then gives `None`.
pub fn stylize_clip(
    stylizer: &Stylizer,
    poses: &[Pose],
    clock: &mut impl StageClock,
    mut observe: impl FnMut(usize, Trace<'_>) -> ControlFlow<()>,
) -> Option<StyledMotion> {
    let mut job = ClipJob::new(stylizer.clone());
    for (i, pose) in poses.iter().enumerate() {
        if observe(i, job.push(pose, clock)).is_break() {
            return None;
        }
    }
    Some(job.finish())
}

impl StyledMotion {
    /// Length of the output time axis, seconds: each frame counts with the time to the next, the last one
    /// with its own.
    pub fn duration_secs(&self) -> f64 {
        self.frames.last().map_or(0.0, |f| f.time_out_secs + f64::from(f.dt_secs))
    }

    /// The clip at an even rate on the output time axis, from the first frame to the last.
    pub fn resampled(&self, rate_hz: f32) -> Resampled {
        let mut motion = HumanoidMotion { proportions: self.proportions, rate_hz, poses: Vec::new() };
        let mut input_frame = Vec::new();
        if let Some(last) = self.frames.last() {
            let step = 1.0 / f64::from(rate_hz);
            let count = (last.time_out_secs / step + 1e-6).floor() as usize + 1;
            let mut i = 0;
            for n in 0..count {
                let time = n as f64 * step;
                while i + 1 < self.frames.len() && self.frames[i + 1].time_out_secs <= time {
                    i += 1;
                }
                let (pose, at) = self.between(i, time);
                motion.poses.push(pose);
                input_frame.push(at);
            }
        }
        Resampled { motion, input_frame }
    }

    /// Pose and fractional frame at a time from frame `i` on.
    fn between(&self, i: usize, time: f64) -> (Pose, f64) {
        let a = &self.frames[i];
        let Some(b) = self.frames.get(i + 1) else { return (a.pose, i as f64) };
        let share = ((time - a.time_out_secs) / (b.time_out_secs - a.time_out_secs)).clamp(0.0, 1.0);
        (a.pose.lerp(&b.pose, share as f32), i as f64 + share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::sine_walk::{NEUTRAL, database, walk};
    use crate::transfer::{Model, NoClock, Options};
    use std::sync::Arc;

    fn styled() -> StyledMotion {
        let mut s = Stylizer::new(Arc::new(Model::new(Arc::new(database()))), Options::DEFAULT).unwrap();
        s.set_styles(&[0.0, 1.0]).unwrap();
        let input = walk(&NEUTRAL, 120, 0.0);
        stylize_clip(&s, &input.poses, &mut NoClock, |_, _| ControlFlow::Continue(())).unwrap()
    }

    #[test]
    fn resampling_follows_the_output_time() {
        let clip = styled();
        assert_eq!(clip.frames.len(), 120);
        let out = clip.resampled(60.0);
        assert_eq!(out.motion.poses.len(), out.input_frame.len());
        assert!(out.motion.poses.len() > 130, "the style is slower: {}", out.motion.poses.len());
        assert!(out.input_frame.windows(2).all(|w| w[1] > w[0]));
        assert!((out.motion.poses.len() as f64 / 60.0 - clip.duration_secs()).abs() < 0.05);
        for (n, at) in out.input_frame.iter().enumerate() {
            let i = (at.floor() as usize).min(118);
            let time = n as f64 / 60.0;
            assert!(clip.frames[i].time_out_secs <= time + 1e-9 && time <= clip.frames[i + 1].time_out_secs + 1e-3);
        }
    }

    #[test]
    fn the_observer_sees_every_frame_and_may_stop() {
        let s = Stylizer::new(Arc::new(Model::new(Arc::new(database()))), Options::DEFAULT).unwrap();
        let input = walk(&NEUTRAL, 10, 0.0);
        let mut seen = 0;
        let stopped = stylize_clip(&s, &input.poses, &mut NoClock, |i, trace| {
            assert_eq!(i, seen);
            assert!(trace.neighbours().count() > 0);
            seen += 1;
            if i == 4 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert!(stopped.is_none() && seen == 5);
        assert!(stylize_clip(&s, &[], &mut NoClock, |_, _| ControlFlow::Continue(())).unwrap().frames.is_empty());
    }
}
