//! One clip from its file to the styled file.

use super::frames::style_frames;
use super::summary::Summary;
use crate::failure::{Failure, Outcome};
use crate::files::Outputs;
use crate::gather::Source;
use crate::progress::Bar;
use crate::trace::{StageTimer, TraceLog, class_names};
use std::path::Path;
use strut_core::catalogue::Catalogue;
use strut_core::database::build::MIN_CLIP_FRAMES;
use strut_core::humanoid::HumanoidMotion;
use strut_core::retarget::to_humanoid;
use strut_core::transfer::{ClipJob, ClipSearch, NoClock, StyledMotion, Stylizer, Trace};
use strut_formats::bvh;
use strut_formats::corpus::Clip;

/// What is spread over threads, with the same result.
pub(super) enum Spread {
    /// The frames of a clip, whose progress the bar shows.
    Frames(Bar),
    /// Clips, so that each keeps to its thread.
    Clips,
}

/// A clip that is styled but not yet under its name.
pub(super) struct Styled {
    pub(super) outputs: Outputs,
    /// What there is to say of it.
    pub(super) text: String,
}

/// Styles clips alike.
pub(super) struct Styling {
    stylizer: Stylizer,
    /// Names of the database's classes.
    classes: Vec<String>,
}

/// The clip in a file.
pub(super) fn read(source: &Source) -> Outcome<Clip> {
    let fail = |reason: String| Failure::in_file(Path::new(&source.path), reason);
    Clip::parse(&source.bytes().map_err(fail)?).map_err(|reason| fail(reason.to_string()))
}

impl Styling {
    /// With the styles and options of a stylizer.
    pub(super) fn new(stylizer: Stylizer) -> Self {
        let classes = class_names(stylizer.model().catalogue());
        Self { stylizer, classes }
    }

    /// Styles a source's clip for a target, and traces it into a file if there is one.
    pub(super) fn style(
        &self,
        source: &Source,
        clip: &Clip,
        target: &Path,
        trace: Option<&Path>,
        spread: &Spread,
    ) -> Outcome<Styled> {
        let db = self.stylizer.model().catalogue();
        let input = input_of(clip, db).map_err(|reason| Failure::in_file(Path::new(&source.path), reason))?;
        let mut summary = Summary::new(self.classes.len());
        let mut log = trace.map(|target| (TraceLog::new(db, &self.classes), target));
        let mut job = ClipJob::new(self.stylizer.clone());
        let mut on_frame = |trace: &Trace<'_>| {
            summary.add(trace.class_weights);
            if let Spread::Frames(bar) = spread {
                bar.step();
            }
        };
        if let Spread::Frames(bar) = spread {
            bar.show("styling", 0, input.poses.len());
        }
        if let Some((log, _)) = &mut log {
            let mut timer = StageTimer::default();
            for pose in &input.poses {
                let trace = job.push(pose, &mut timer);
                on_frame(&trace);
                log.push(&trace, timer.take());
            }
        } else if matches!(spread, Spread::Frames(_)) && rayon::current_num_threads() > 1 {
            style_frames(&mut job, &ClipSearch::new(&self.stylizer, &input.poses), on_frame);
        } else {
            for pose in &input.poses {
                on_frame(&job.push(pose, &mut NoClock));
            }
        }
        let styled = job.finish();

        let output = output_of(clip, db, &styled).map_err(Failure::new)?;
        let mut outputs = Outputs::default();
        outputs.stage(target, bvh::write(&output).as_bytes())?;
        if let Some((log, target)) = log {
            outputs.stage(target, &log.into_json_lines(&styled.frames).map_err(Failure::new)?)?;
        }
        let text = summary.text(target, clip, &output, &styled, &self.classes);
        Ok(Styled { outputs, text })
    }
}

/// The clip on the database's body and at its rate, or why it cannot be styled.
fn input_of(clip: &Clip, db: &Catalogue) -> Result<HumanoidMotion, String> {
    let input =
        to_humanoid(&clip.motion, &clip.binding, &db.proportions).resampled(db.rate_hz).map_err(|e| e.to_string())?;
    if input.poses.len() < MIN_CLIP_FRAMES {
        let frames = if clip.file.frames == 1 { "1 frame".into() } else { format!("{} frames", clip.file.frames) };
        return Err(format!(
            "the motion has {frames} ({:.2} s); at least {:.2} s are needed",
            clip.motion.duration_secs(),
            MIN_CLIP_FRAMES as f32 / db.rate_hz
        ));
    }
    Ok(input)
}

/// The styled clip on the input's skeleton and at its rate.
fn output_of(clip: &Clip, db: &Catalogue, styled: &StyledMotion) -> Result<bvh::Bvh, bvh::BvhError> {
    clip.file.with_motion(&styled.on_skeleton(db.rate_hz, &clip.motion, &clip.binding))
}
