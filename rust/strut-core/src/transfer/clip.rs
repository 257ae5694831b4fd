//! Styles a whole clip: the online engine, with contacts and a footplant that use past and future frames.

use super::blend::StyleError;
use super::clip_footplant::plant_feet;
use super::clip_input::ClipInput;
use super::contact_likelihood::{smoothed, stands};
use super::familiarity::Familiarity;
use super::found::FoundFrame;
use super::frame::{NoClock, StageClock, StyledFrame, Trace};
use super::stylizer::Stylizer;
use super::travel::{PathLength, travel_note};
use crate::humanoid::{HumanoidMotion, Pose, Proportions};
use crate::motion::Motion;
use crate::note::{Note, NoteCode};
use crate::retarget::{Binding, between_bodies, from_humanoid};
use std::ops::{ControlFlow, Range};

/// A styled clip, whose frames are not evenly spaced in output time.
#[derive(Clone, Debug, PartialEq)]
pub struct StyledMotion {
    /// Bone offsets of the database.
    pub proportions: Proportions,
    /// One frame for each frame of the input.
    pub frames: Vec<StyledFrame>,
    /// Frames that follow a cut, ascending. No frame is interpolated between one of them and the frame before it.
    pub cuts: Vec<usize>,
    /// Number of first frames that are a calibration pose. They are copied from the input.
    pub calibration: usize,
    /// How similar the input is to the database.
    pub familiarity: Familiarity,
    /// Length of the input's path over the ground, metres.
    pub input_travel_metres: f32,
}

/// A styled clip at a constant frame rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Resampled {
    /// The clip.
    pub motion: HumanoidMotion,
    /// Fractional input frame that each frame shows.
    pub input_frame: Vec<f64>,
}

/// Styles a clip frame by frame, for callers that do other work in between. [`stylize_clip`] does the same in one call.
#[derive(Clone, Debug)]
pub struct ClipJob {
    stylizer: Stylizer,
    /// Frames so far, before contacts are smoothed and feet are planted.
    frames: Vec<StyledFrame>,
    /// As in [`StyledMotion`].
    cuts: Vec<usize>,
    calibration: usize,
    familiarity: Familiarity,
    /// Path of the input.
    way: PathLength,
    /// Last frame before the last cut. Times and the count of repaired frames continue from it.
    before_cut: StyledFrame,
}

impl ClipJob {
    /// Starts a clip with the stylizer's styles and options; the stylizer's past is discarded.
    pub fn new(mut stylizer: Stylizer) -> Self {
        stylizer.reset(None);
        Self {
            stylizer,
            frames: Vec::new(),
            cuts: Vec::new(),
            calibration: 0,
            familiarity: Familiarity::default(),
            way: PathLength::default(),
            before_cut: StyledFrame::default(),
        }
    }

    /// Starts a clip whose cuts and calibration pose are known. After a cut the output restarts at the input's position.
    pub fn of_input(stylizer: Stylizer, input: &ClipInput) -> Self {
        let frames = Vec::with_capacity(input.motion.poses.len());
        Self { frames, cuts: input.cuts.clone(), calibration: input.calibration, ..Self::new(stylizer) }
    }

    /// Changes the styles of the whole body from the next frame on, for example from a style track.
    ///
    /// # Errors
    /// As [`Stylizer::set_styles`].
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), StyleError> {
        self.stylizer.set_styles(weights)
    }

    /// Styles the next frame of the clip, which has the database's frame rate.
    pub fn push(&mut self, pose: &Pose, clock: &mut impl StageClock) -> Trace<'_> {
        self.push_searched(pose, None, clock)
    }

    /// Same as [`ClipJob::push`] without the search: uses the result `found` earlier for the same stylizer.
    pub fn push_found(&mut self, pose: &Pose, found: &FoundFrame<'_>) -> Trace<'_> {
        self.push_searched(pose, Some(found), &mut NoClock)
    }

    fn push_searched(&mut self, pose: &Pose, found: Option<&FoundFrame<'_>>, clock: &mut impl StageClock) -> Trace<'_> {
        let index = self.frames.len();
        let is_cut = self.cuts.binary_search(&index).is_ok();
        if let (true, Some(last)) = (is_cut, self.frames.last()) {
            self.before_cut = *last;
            self.stylizer.reset(None);
        }
        let mut frame = *self.stylizer.predict_frame(pose, found, clock);
        if self.cuts.first().is_some_and(|first| *first <= index) {
            self.go_on_after_cut(&mut frame, is_cut);
        }
        if index < self.calibration {
            frame.pose = *pose;
        }
        self.way.add(pose, self.stylizer.model().catalogue().rate_hz, is_cut);
        self.frames.push(frame);
        if let ([.., before, _], false) = (self.frames.as_mut_slice(), is_cut) {
            let contact = self.stylizer.contact_before();
            // The input contributes half of the output's likelihood.
            let gained = contact.iter().zip(before.contact).map(|(c, was)| c - was);
            before.contact_out.iter_mut().zip(gained).for_each(|(out, gained)| *out += 0.5 * gained);
            before.contact = contact;
        }
        let trace = self.stylizer.trace();
        if index >= self.calibration {
            self.familiarity.add(&trace);
        }
        trace
    }

    /// Shifts the times of a frame, which count from the last cut, so that they count from the start of the clip.
    fn go_on_after_cut(&self, frame: &mut StyledFrame, is_cut: bool) {
        let frame_secs = 1.0 / self.stylizer.model().catalogue().rate_hz;
        if is_cut {
            frame.dt_secs = frame_secs;
        }
        frame.time_in_secs += self.before_cut.time_in_secs + f64::from(frame_secs);
        frame.time_out_secs += self.before_cut.time_out_secs + f64::from(frame_secs);
        frame.repaired_total += self.before_cut.repaired_total;
    }

    /// Frames so far, before contacts are smoothed and feet are planted.
    pub fn frames(&self) -> &[StyledFrame] {
        &self.frames
    }

    /// Ends the clip: smooths contacts and plants feet, using future frames for both.
    pub fn finish(self) -> StyledMotion {
        let Self { stylizer, frames, cuts, calibration, familiarity, way, .. } = self;
        let db = stylizer.model().catalogue();
        let mut styled = StyledMotion {
            proportions: db.proportions,
            frames,
            cuts,
            calibration,
            familiarity,
            input_travel_metres: way.metres(),
        };
        for part in styled.parts() {
            let frames = &mut styled.frames[part];
            let of_input = smoothed(&frames.iter().map(|f| f.contact).collect::<Vec<_>>());
            let of_output = smoothed(&frames.iter().map(|f| f.contact_out).collect::<Vec<_>>());
            for (frame, (input, output)) in frames.iter_mut().zip(of_input.into_iter().zip(of_output)) {
                (frame.contact, frame.contact_out) = (input, output);
            }
        }
        if stylizer.options().footplant {
            styled.plant_feet(db.rate_hz);
        }
        styled
    }
}

/// Styles a clip at the database's frame rate with the styles and options of a stylizer, whose own stream is not changed.
///
/// `observe` receives every frame and its number before contacts are smoothed and feet are planted. It may stop the
/// work; the result is then `None`.
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
    /// Motion of frames without a cut.
    pub fn new(proportions: Proportions, frames: Vec<StyledFrame>) -> Self {
        Self {
            proportions,
            frames,
            cuts: Vec::new(),
            calibration: 0,
            familiarity: Familiarity::default(),
            input_travel_metres: 0.0,
        }
    }

    /// Length of the output's path over the ground, in as many frames of this rate as the input has, metres.
    pub fn travel_metres(&self, rate_hz: f32) -> f32 {
        let mut way = PathLength::default();
        for (i, frame) in self.frames.iter().enumerate() {
            way.add(&frame.pose, rate_hz, self.cuts.binary_search(&i).is_ok());
        }
        way.metres()
    }

    /// Notes about the output, in addition to the input's own notes. `rate_hz` is the frame rate of styling.
    pub fn notes(&self, rate_hz: f32) -> Vec<Note> {
        let repaired = match self.frames.last().map_or(0, |frame| frame.repaired_total) {
            0 => None,
            1 => Some("1 input frame was unusable and was replaced.".to_owned()),
            n => Some(format!("{n} input frames were unusable and were replaced.")),
        };
        let repaired = repaired.map(|text| Note::new(NoteCode::Repaired, text));
        let travel = travel_note(self.input_travel_metres, self.travel_metres(rate_hz));
        [repaired, self.familiarity.note(), travel].into_iter().flatten().collect()
    }

    /// Length of the output time axis, seconds. Each frame counts with the time to the next, the last one with its own
    /// duration.
    pub fn duration_secs(&self) -> f64 {
        self.frames.last().map_or(0.0, |f| f.time_out_secs + f64::from(f.dt_secs))
    }

    /// Ranges of frames between cuts.
    fn parts(&self) -> Vec<Range<usize>> {
        let starts = std::iter::once(0).chain(self.cuts.iter().copied());
        let ends = self.cuts.iter().copied().chain(std::iter::once(self.frames.len()));
        starts.zip(ends).map(|(start, end)| start.min(self.frames.len())..end.min(self.frames.len())).collect()
    }

    /// The clip on another body and at a constant frame rate, as it is written to a file. Feet that are held here are
    /// held there too; otherwise they would slide on legs and soles of another size.
    pub fn on_body(&self, body: &Proportions, rate_hz: f32) -> Resampled {
        self.placed_on(body, self.resampled(rate_hz))
    }

    fn placed_on(&self, body: &Proportions, mut even: Resampled) -> Resampled {
        if *body != self.proportions {
            even.motion = between_bodies(&even.motion, body);
        }
        let held: Vec<[bool; 2]> = even.input_frame.iter().map(|&f| self.frames[f.round() as usize].planted).collect();
        for part in self.parts() {
            let first = even.input_frame.partition_point(|&f| f < part.start as f64);
            let end = even.input_frame.partition_point(|&f| f < part.end as f64);
            if held[first..end].iter().flatten().any(|&held| held) {
                plant_part(&mut even.motion, first..end, &held[first..end]);
            }
        }
        even
    }

    /// The clip on the skeleton and at the frame rate of its source file, up to the file's last frame. `rate_hz` is the
    /// frame rate of styling. Joints without a role keep the file's motion.
    pub fn on_skeleton(&self, rate_hz: f32, file: &Motion, binding: &Binding) -> Motion {
        let file_rate_hz = 1.0 / file.frame_time_secs;
        let file_frames_per_frame = file_rate_hz / f64::from(rate_hz);
        let end = file.frames().saturating_sub(1) as f64 / file_frames_per_frame;
        let even = self.placed_on(&binding.proportions, self.resampled_to(file_rate_hz, end));
        let file_frames: Vec<f64> = even.input_frame.iter().map(|f| f * file_frames_per_frame).collect();
        // The exact frame time of the file, which f32 cannot represent.
        Motion { frame_time_secs: file.frame_time_secs, ..from_humanoid(&even.motion, file, binding, &file_frames) }
    }

    /// Holds feet where the contact likelihood indicates a contact. Frames are treated as evenly spaced on the output
    /// time axis. `rate_hz` is their rate if that axis has length zero.
    fn plant_feet(&mut self, rate_hz: f32) {
        let mut state = [false; 2];
        let stands: Vec<[bool; 2]> = self
            .frames
            .iter()
            .map(|f| {
                state = std::array::from_fn(|side| stands(state[side], f.contact_out[side]));
                state
            })
            .collect();
        for part in self.parts().into_iter().filter(|part| part.start >= self.calibration) {
            let frames = &mut self.frames[part.clone()];
            let [Some(first), Some(last)] = [frames.first(), frames.last()] else { continue };
            let span = last.time_out_secs - first.time_out_secs;
            let rate_hz = if span > 0.0 { ((frames.len() - 1) as f64 / span) as f32 } else { rate_hz };
            let poses = frames.iter().map(|f| f.pose).collect();
            let mut motion = HumanoidMotion { proportions: self.proportions, rate_hz, poses };
            let held = plant_feet(&mut motion, &stands[part]);
            for (frame, (pose, held)) in frames.iter_mut().zip(motion.poses.into_iter().zip(held)) {
                (frame.pose, frame.planted) = (pose, held);
            }
        }
    }

    /// The clip at a constant frame rate on the output time axis, from the first frame to the last.
    pub fn resampled(&self, rate_hz: f32) -> Resampled {
        let end_secs = self.frames.last().map_or(0.0, |last| last.time_out_secs);
        let count = (end_secs * f64::from(rate_hz) + 1e-6).floor() as usize + 1;
        self.at_times(rate_hz, (0..count).map(|n| n as f64 / f64::from(rate_hz)))
    }

    /// Same as [`Self::resampled`], up to the fractional input frame `end`, which the last frame shows. The number of
    /// frames is the one that fits best.
    fn resampled_to(&self, rate_hz: f64, end: f64) -> Resampled {
        let Some(last) = self.frames.len().checked_sub(1) else { return self.resampled(rate_hz as f32) };
        let whole = (end.floor() as usize).min(last);
        let [before, after] = [whole, (whole + 1).min(last)].map(|i| self.frames[i].time_out_secs);
        let end_secs = before + (after - before) * (end - whole as f64).clamp(0.0, 1.0);
        let count = (end_secs * rate_hz).round() as usize;
        let times = (0..count).map(|n| n as f64 / rate_hz).chain(std::iter::once(end_secs));
        self.at_times(rate_hz as f32, times)
    }

    /// The clip at ascending times on the output time axis.
    fn at_times(&self, rate_hz: f32, times: impl Iterator<Item = f64>) -> Resampled {
        let (count, _) = times.size_hint();
        let poses = Vec::with_capacity(count);
        let mut motion = HumanoidMotion { proportions: self.proportions, rate_hz, poses };
        let mut input_frame = Vec::with_capacity(count);
        let mut i = 0;
        for time in times.filter(|_| !self.frames.is_empty()) {
            while i + 1 < self.frames.len() && self.frames[i + 1].time_out_secs <= time {
                i += 1;
            }
            let (pose, at) = self.between(i, time);
            motion.poses.push(pose);
            input_frame.push(at);
        }
        Resampled { motion, input_frame }
    }

    /// Pose and fractional input frame at a time after frame `i`.
    fn between(&self, i: usize, time: f64) -> (Pose, f64) {
        let a = &self.frames[i];
        let after = self.frames.get(i + 1).filter(|_| self.cuts.binary_search(&(i + 1)).is_err());
        let Some(b) = after else { return (a.pose, i as f64) };
        let share = ((time - a.time_out_secs) / (b.time_out_secs - a.time_out_secs)).clamp(0.0, 1.0);
        (a.pose.lerp(&b.pose, share as f32), i as f64 + share)
    }
}

/// Holds feet in a part of a clip.
fn plant_part(motion: &mut HumanoidMotion, frames: Range<usize>, held: &[[bool; 2]]) {
    let poses = motion.poses[frames.clone()].to_vec();
    let mut part = HumanoidMotion { proportions: motion.proportions, rate_hz: motion.rate_hz, poses };
    plant_feet(&mut part, held);
    motion.poses[frames].copy_from_slice(&part.poses);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{NEUTRAL, database, walk};
    use crate::humanoid::Role;
    use crate::metrics::foot_skate;
    use crate::transfer::{Model, NoClock, Options};
    use std::sync::Arc;

    fn styled() -> StyledMotion {
        let mut s = Stylizer::new(Arc::new(Model::new(database())), Options::DEFAULT).unwrap();
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
    fn feet_stay_on_a_body_with_other_feet_and_at_another_rate() {
        let clip = styled();
        let mut body = clip.proportions;
        for role in [Role::LeftToes, Role::RightToes] {
            body.offsets[role.index()] *= 1.3;
        }
        body.offsets[Role::LeftFoot.index()] *= 1.04;
        let skate = |motion: &HumanoidMotion| foot_skate(motion, &crate::contact::label(motion));
        let out = clip.on_body(&body, 30.0);
        assert_eq!(out.motion.proportions, body);
        assert_eq!(out.input_frame, clip.resampled(30.0).input_frame);
        let unplanted = between_bodies(&clip.resampled(30.0).motion, &body);
        assert!(skate(&out.motion) < 0.02, "{} m/s", skate(&out.motion));
        assert!(skate(&out.motion) < 0.5 * skate(&unplanted), "{} m/s", skate(&unplanted));
    }

    /// A clip whose styles are set before every frame.
    fn tracked(options: Options, weight: impl Fn(usize) -> f32) -> StyledMotion {
        let s = Stylizer::new(Arc::new(Model::new(database())), options).unwrap();
        let mut job = ClipJob::new(s);
        for (i, pose) in walk(&NEUTRAL, 120, 0.0).poses.iter().enumerate() {
            job.set_styles(&[0.0, weight(i)]).unwrap();
            job.push(pose, &mut NoClock);
        }
        job.finish()
    }

    #[test]
    fn a_track_that_stands_still_is_the_style_itself() {
        assert_eq!(tracked(Options::DEFAULT, |_| 1.0), styled());
    }

    /// Largest turn of a joint between two frames, radians.
    fn turn(a: &StyledFrame, b: &StyledFrame) -> f32 {
        let joints = a.pose.rotations.iter().zip(&b.pose.rotations);
        joints.map(|(a, b)| a.inv_mul(*b).angle()).fold(0.0, f32::max)
    }

    #[test]
    fn a_track_acts_from_its_frame_on_and_without_a_jump() {
        // The footplant looks ahead and would hold feet before the change.
        let options = Options { footplant: false, ..Options::DEFAULT };
        let still = tracked(options, |_| 0.0);
        let turned = tracked(options, |i| ((i as f32 - 30.0) / 60.0).clamp(0.0, 1.0));
        let apart = |i: usize| turn(&still.frames[i], &turned.frames[i]);
        assert!((0..=30).all(|i| still.frames[i].pose == turned.frames[i].pose));
        assert!((100..120).any(|i| apart(i) > 0.05));
        let fastest = |m: &StyledMotion| m.frames.windows(2).map(|w| turn(&w[0], &w[1])).fold(0.0, f32::max);
        assert!(fastest(&turned) < 1.5 * fastest(&styled()).max(fastest(&still)));
    }

    #[test]
    fn the_observer_sees_every_frame_and_may_stop() {
        let s = Stylizer::new(Arc::new(Model::new(database())), Options::DEFAULT).unwrap();
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
