//! Leave-one-out cross-validation, fold by fold.

use super::checkpoint::Checkpoint;
use super::request::Request;
use super::results::{Sample, quality_values};
use super::settings::{Build, Grid, Setting};
use crate::error::{Outcome, TaskError};
use crate::progress::{Counter, OnProgress};
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::sync::Arc;
use strut_core::database::build::SourceClip;
use strut_core::transfer::Model;
use strut_evaluation::leave_one_out::{LeaveOneOut, Trial};
use strut_evaluation::style_progress::StyleProgress;
use strut_evaluation::truth::Errors;

/// Number of draws for a fold with randomly chosen takes.
const DRAWS: u32 = 3;

/// A database to build and a take to hold out of it.
#[derive(Clone, Copy, Debug)]
struct Fold {
    /// Index of the build settings.
    build: usize,
    take: u32,
    /// Number of the random draw of the kept takes.
    draw: u32,
}

/// Returns the samples of all folds, in an order that does not depend on the threads.
pub(super) fn run(
    args: &Request,
    grid: &Grid,
    clips: &[SourceClip],
    checkpoint: &Checkpoint,
    on_progress: &OnProgress<'_>,
) -> Outcome<Vec<Sample>> {
    let plain = grid.builds[0].options(&args.source);
    let mut takes = protocol(args, clips, grid.builds[0], &plain).takes();
    if args.folds > 0 {
        takes.truncate(args.folds);
    }
    // Folds with randomly chosen takes are repeated.
    let draws = |build: usize| if grid.builds[build].takes == 0 { 1 } else { DRAWS };
    let folds =
        |build| takes.iter().flat_map(move |&take| (0..draws(build)).map(move |draw| Fold { build, take, draw }));
    let units: Vec<Fold> = (0..grid.builds.len()).flat_map(folds).collect();
    let counter = Counter::new("folds", units.len(), on_progress);
    let samples: Vec<Vec<Sample>> = units
        .into_par_iter()
        .map(|fold| {
            let Fold { build, take, draw } = fold;
            let unit = format!("{build} {take} {draw}");
            if let Some(samples) = checkpoint.done(&unit) {
                counter.step()?;
                return Ok(samples.clone());
            }
            let samples = samples_of(args, grid, clips, fold)?;
            checkpoint.keep(&unit, &samples)?;
            counter.step()?;
            Ok(samples)
        })
        .collect::<Outcome<_>>()?;
    Ok(samples.into_iter().flatten().collect())
}

/// Returns the protocol of the arguments with these build settings.
pub(super) fn protocol<'a>(
    args: &'a Request,
    clips: &'a [SourceClip],
    build: Build,
    options: &'a strut_core::database::build::BuildOptions,
) -> LeaveOneOut<'a> {
    LeaveOneOut {
        clips,
        source: &args.source,
        actions: &args.actions,
        database_actions: &args.database_actions,
        targets: &args.targets,
        target_takes: build.takes,
        build: options,
    }
}

fn samples_of(args: &Request, grid: &Grid, clips: &[SourceClip], fold: Fold) -> Outcome<Vec<Sample>> {
    let Fold { build, take, draw } = fold;
    let options = grid.builds[build].options(&args.source);
    let protocol = protocol(args, clips, grid.builds[build], &options);
    let trials = protocol.trials(take);
    if trials.is_empty() {
        return Ok(Vec::new());
    }
    let database = protocol.database_without(take, draw).map_err(TaskError::new)?;
    let takes = StyleProgress::new(&database);
    let model = grid.builds[build].model(database);
    let trials: Vec<&Trial> = trials.iter().filter(|t| model.catalogue().style_index(&t.target).is_some()).collect();
    let jobs: Vec<(&Trial, usize)> =
        trials.iter().flat_map(|t| (0..grid.settings.len()).map(move |s| (*t, s))).collect();
    jobs.par_iter()
        .map(|&(trial, s)| {
            sample(trial, &grid.settings[s], &model, &takes)
                .map(|v| Sample::new(&trial.action, &trial.target, build, s, v))
        })
        .collect()
}

/// Returns the values of a trial with one setting. `takes` are the takes in the database.
fn sample(
    trial: &Trial,
    setting: &Setting,
    model: &Arc<Model>,
    takes: &StyleProgress,
) -> Outcome<Vec<(&'static str, f64)>> {
    let stylizer = setting.stylizer(model, Some(&trial.action), &trial.target)?;
    let (styled, ms_per_frame) = setting.styled(&stylizer, &trial.input);
    let measured = trial.measure(&styled);
    let errors = |names: [&'static str; 3], e: Errors| {
        let values = [e.pose * 100.0, e.timing * 1000.0, e.velocity * 100.0];
        names.into_iter().zip(values)
    };
    let mut values = vec![
        ("frames", measured.errors.frames as f64),
        ("ms_per_frame", ms_per_frame),
        ("finished_pose_error_cm", measured.finished_errors.pose * 100.0),
    ];
    values.extend(quality_values(&measured.quality));
    values.extend(errors(["pose_error_cm", "timing_error_ms", "velocity_error_cm_s"], measured.errors));
    values.extend(errors(["input_cm", "input_ms", "input_cm_s"], trial.unchanged));
    let progress = |of| takes.of(&trial.action, &trial.target, &trial.input, of);
    for (name, of) in [("style_progress", &styled.output), ("take_progress", &trial.target_take)] {
        values.extend(progress(of).map(|share| (name, share)));
    }
    if let Some(floor) = trial.floor {
        values.extend(errors(["floor_cm", "floor_ms", "floor_cm_s"], floor.best_take));
        values.extend(errors(["mean_floor_cm", "mean_floor_ms", "mean_floor_cm_s"], floor.mean_of_takes));
    }
    Ok(values)
}
