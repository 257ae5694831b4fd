//! Styling of one clip, from its file to the output file.

use super::frames::style_frames;
use super::summary::Summary;
use super::trace::{StageTimer, TraceLog, class_names};
use super::track::StyleTrack;
use crate::error::{Outcome, TaskError};
use crate::progress::{Counter, OnProgress};
use std::path::Path;
use strut_core::catalogue::Catalogue;
use strut_core::database::build::MIN_CLIP_FRAMES;
use strut_core::note::Note;
use strut_core::retarget::to_humanoid;
use strut_core::transfer::{ClipInput, ClipJob, ClipSearch, NoClock, StyledMotion, Stylizer, Trace};
use strut_formats::bvh;
use strut_formats::corpus::Clip;
use strut_formats::joints::Reading;

/// Unit of parallel work; the result does not depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spread {
    /// The frames of a clip.
    Frames,
    /// Clips: each clip stays on one thread.
    Clips,
}

/// A styled clip.
pub struct Styled {
    /// The motion on the database's body, at the output times.
    pub motion: StyledMotion,
    /// The motion on the input's skeleton and at its rate.
    pub file: bvh::Bvh,
    /// Summary of the styling.
    pub summary: Summary,
    /// Warnings; empty for a clean clip.
    pub notes: Vec<Note>,
}

/// Styles clips with the same settings.
pub struct Styling {
    stylizer: Stylizer,
    /// Names of the database's classes.
    classes: Vec<String>,
    track: Option<StyleTrack>,
    reading: Reading,
}

impl Styling {
    /// Uses the styles and options of a stylizer.
    pub fn new(stylizer: Stylizer) -> Self {
        let classes = class_names(stylizer.model().catalogue());
        Self { stylizer, classes, track: None, reading: Reading::default() }
    }

    /// Uses styles that change over time instead of the stylizer's.
    pub fn with_track(self, track: StyleTrack) -> Self {
        Self { track: Some(track), ..self }
    }

    /// Uses explicit reading options for the inputs.
    pub fn with_reading(self, reading: &Reading) -> Self {
        Self { reading: reading.clone(), ..self }
    }

    /// Reads the clip with this name from these bytes.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn read(&self, name: &str, bytes: &[u8]) -> Outcome<Clip> {
        Clip::read(bytes, &self.reading).map_err(|reason| TaskError::in_file(Path::new(name), reason))
    }

    /// Returns the names of the database's classes.
    pub fn classes(&self) -> &[String] {
        &self.classes
    }

    /// Returns the database.
    pub fn catalogue(&self) -> &Catalogue {
        self.stylizer.model().catalogue()
    }

    /// Styles the clip with this name, and traces it into a log if there is one.
    ///
    /// # Errors
    /// If the clip cannot be styled, or the caller cancels.
    pub fn style(
        &self,
        name: &str,
        clip: &Clip,
        log: Option<&mut TraceLog<'_>>,
        spread: Spread,
        on_progress: &OnProgress<'_>,
    ) -> Outcome<Styled> {
        let db = self.catalogue();
        let input = input_of(clip, db).map_err(|reason| TaskError::in_file(Path::new(name), reason))?;
        let mut summary = Summary::new(self.classes.len());
        let mut job = ClipJob::of_input(self.stylizer.clone(), &input);
        let poses = &input.motion.poses;
        let counter = Counter::new("styling", poses.len(), on_progress);
        counter.check()?;
        let mut on_frame = |trace: &Trace<'_>| {
            summary.add(trace.class_weights);
            counter.step()
        };
        let follow = |job: &mut ClipJob, frame: usize| match &self.track {
            Some(track) => job.set_styles(&track.weights(frame)).map_err(TaskError::new),
            None => Ok(()),
        };
        if let Some(log) = log {
            let mut timer = StageTimer::default();
            for (frame, pose) in poses.iter().enumerate() {
                follow(&mut job, frame)?;
                let trace = job.push(pose, &mut timer);
                on_frame(&trace)?;
                log.push(&trace, &timer.take()).map_err(TaskError::new)?;
            }
        } else if spread == Spread::Frames && rayon::current_num_threads() > 1 && self.track.is_none() {
            style_frames(&mut job, &ClipSearch::of_input(&self.stylizer, &input), on_frame)?;
        } else {
            for (frame, pose) in poses.iter().enumerate() {
                follow(&mut job, frame)?;
                on_frame(&job.push(pose, &mut NoClock))?;
            }
        }
        let motion = job.finish();
        let file = output_of(clip, db, &motion).map_err(TaskError::new)?;
        let mut notes = clip.notes.clone();
        notes.extend(input.notes());
        notes.extend(motion.notes(db.rate_hz));
        Ok(Styled { motion, file, summary, notes })
    }
}

/// Returns the clip on the database's body and at its rate.
///
/// # Errors
/// A message why the clip cannot be styled.
pub fn input_of(clip: &Clip, db: &Catalogue) -> Result<ClipInput, String> {
    let on_body = to_humanoid(&clip.motion, &clip.binding, &db.proportions);
    let input = ClipInput::new(on_body, db.rate_hz).map_err(|e| e.to_string())?;
    if input.motion.poses.len() < MIN_CLIP_FRAMES {
        return Err(format!(
            "the motion lasts {:.2} s from its first frame to its last; at least {:.2} s are needed",
            clip.motion.duration_secs() - clip.motion.frame_time_secs,
            (MIN_CLIP_FRAMES - 1) as f32 / db.rate_hz
        ));
    }
    Ok(input)
}

/// Returns the styled clip on the input's skeleton and at its rate.
fn output_of(clip: &Clip, db: &Catalogue, styled: &StyledMotion) -> Result<bvh::Bvh, bvh::BvhError> {
    clip.file.with_motion(&styled.on_skeleton(db.rate_hz, &clip.motion, &clip.binding))
}
