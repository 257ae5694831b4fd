//! Styling of motion that is unlike the database, clip by clip.

use super::checkpoint::Checkpoint;
use super::cross_validation::protocol;
use super::request::Request;
use super::results::{Sample, quality_values};
use super::settings::Grid;
use crate::corpus::{RefusedFile, parse};
use crate::error::{Outcome, TaskError};
use crate::gather::Source;
use crate::progress::{Counter, OnProgress};
use crate::threads::ThreadPool;
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};
use strut_core::database::build::{MIN_CLIP_FRAMES, SourceClip, build};
use strut_core::humanoid::HumanoidMotion;
use strut_core::retarget::to_humanoid;
use strut_core::transfer::Model;
use strut_evaluation::quality::quality;
use strut_formats::corpus::Clip;

/// Returns all samples: builds × inputs × targets × settings.
pub(super) fn run(
    args: &Request,
    grid: &Grid,
    (clips, sources): (&[SourceClip], &[Source]),
    checkpoint: &Checkpoint,
    refused: &Mutex<Vec<RefusedFile>>,
    on_progress: &OnProgress<'_>,
) -> Outcome<Vec<Sample>> {
    let mut samples = Vec::new();
    for (b, &of) in grid.builds.iter().enumerate() {
        let options = of.options(&args.source);
        let targets = protocol(args, clips, of, &options).targets();
        let (db, _) =
            build(clips, &options, &ThreadPool, &mut |_| ControlFlow::Continue(())).map_err(TaskError::new)?;
        let model = of.model(db);
        let counter = Counter::new("clips", sources.len(), on_progress);
        let of_clips: Vec<Vec<Sample>> = sources
            .par_iter()
            .map(|source| {
                let unit = format!("{b} {}", source.path);
                if let Some(samples) = checkpoint.done(&unit) {
                    counter.step()?;
                    return Ok(samples.clone());
                }
                let samples = match parse(source).and_then(|clip| input_of(&clip, &model)) {
                    Ok(input) => of_input(&input, grid, b, &model, &targets)?,
                    Err(reason) => {
                        let mut refused = refused.lock().unwrap_or_else(PoisonError::into_inner);
                        if refused.iter().all(|of| of.file != source.path) {
                            refused.push(RefusedFile { file: source.path.clone(), reason });
                        }
                        Vec::new()
                    }
                };
                checkpoint.keep(&unit, &samples)?;
                counter.step()?;
                Ok(samples)
            })
            .collect::<Outcome<_>>()?;
        samples.extend(of_clips.into_iter().flatten());
    }
    Ok(samples)
}

/// Returns the clip on the database's body and at its rate.
fn input_of(clip: &Clip, model: &Model) -> Result<HumanoidMotion, String> {
    let db = model.catalogue();
    let input = to_humanoid(&clip.motion, &clip.binding, &db.proportions).resampled(db.rate_hz);
    let input = input.map_err(|e| e.to_string())?;
    if input.poses.len() < MIN_CLIP_FRAMES { Err("it is too short".into()) } else { Ok(input) }
}

fn of_input(
    input: &HumanoidMotion,
    grid: &Grid,
    build: usize,
    model: &Arc<Model>,
    targets: &[&str],
) -> Outcome<Vec<Sample>> {
    let jobs: Vec<(&str, usize)> =
        targets.iter().flat_map(|t| (0..grid.settings.len()).map(move |s| (*t, s))).collect();
    jobs.into_par_iter()
        .map(|(target, s)| {
            let setting = &grid.settings[s];
            let stylizer = setting.stylizer(model, None, target)?;
            let (styled, ms_per_frame) = setting.styled(&stylizer, input);
            let quality = quality(input, &styled);
            let worse = if quality.skate_out > quality.skate_in { 100.0 } else { 0.0 };
            let own =
                [("frames", input.poses.len() as f64), ("ms_per_frame", ms_per_frame), ("worse_skate_percent", worse)];
            let values = own.into_iter().chain(quality_values(&quality));
            Ok(Sample::new("any", target, build, s, values))
        })
        .collect()
}
