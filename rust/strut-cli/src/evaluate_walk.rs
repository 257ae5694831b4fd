//! `strut evaluate-walk`: errors of walk models on held-out takes.

mod halves;
mod intensity;
mod mixture;

use crate::print::{print_warnings, write_or_print};
use mixture::{STEPS, weights};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use strut_core::hsmm::{
    HORIZON, LabelledClip, Options, RuntimeWalkModel, Track, WalkModel, Walker, WeightsError, train,
};
use strut_core::math::stats;
use strut_evaluation::walk::{
    ContextTree, GaitStatistics, Peaks, Reconstruction, horizon_error, recognise, recursion_error, stopping_peaks,
    transition_peaks,
};
use strut_formats::corpus::Pattern;
use strut_formats::walk_model;
use strut_tasks::corpus;
use strut_tasks::files::Outputs;
use strut_tasks::progress::unwatched;
use strut_tasks::threads::ThreadPool;
use strut_tasks::walks::{Walk, read_walks};
use strut_tasks::{Outcome, TaskError};

/// Numbers of steps of the measured transitions.
const BETWEEN: [u32; 4] = [0, 2, 4, 6];
/// Number of timed frames.
const FRAMES: u32 = 3000;

/// Measure a walk model on takes that were not used in training
#[derive(clap::Args)]
pub(crate) struct Args {
    /// .bvh files, folders (searched recursively) and .zip archives
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// Pattern of the labels in file names [default: {action}_{style}_{take}.bvh]
    #[arg(long, value_name = "P")]
    pattern: Option<Pattern>,
    /// Takes of every style to test on
    #[arg(long, value_name = "TAKES", value_delimiter = ',', default_value = "1,2")]
    held_out: Vec<u32>,
    /// Walks of which the first half of every take predicts the second half: files, folders or archives
    #[arg(long, value_name = "INPUT")]
    halves: Vec<PathBuf>,
    /// Write the tables as Markdown
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check(args.output.as_deref())?;
    let mut refused = Vec::new();
    let (body, walks) = read_walks(&args.inputs, args.pattern.as_ref(), None, &mut refused, &unwatched)?;
    let (tests, rest): (Vec<&Walk>, Vec<&Walk>) = walks.iter().partition(|w| args.held_out.contains(&w.take));
    if tests.is_empty() || rest.is_empty() {
        return Err(TaskError::new("--held-out leaves no walk for training or for testing; other takes were expected"));
    }
    let styles: BTreeSet<&str> = rest.iter().map(|walk| walk.style.as_str()).collect();
    if styles.len() < 2 {
        let found = names(&args.inputs);
        return Err(TaskError::new(format_args!("{found}: walks of at least two styles were expected for training")));
    }
    let clips: Vec<LabelledClip> = rest.iter().map(|w| LabelledClip { style: &w.style, track: &w.track }).collect();
    let begin = Instant::now();
    let refined = train(&body, &clips, Options { refined: true }, &ThreadPool).map_err(TaskError::new)?;
    let seconds = begin.elapsed().as_secs_f64();
    let plain = train(&body, &clips, Options { refined: false }, &ThreadPool).map_err(TaskError::new)?;

    let mut text = String::from("# Walk synthesis\n\n");
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "Written by `strut evaluate-walk` on the walks of {}. Training on {} clips of {} styles took {seconds:.1} s; \
         {} clips were held out. The model file has {} kB.\n",
        names(&args.inputs),
        rest.len(),
        refined.styles.len(),
        tests.len(),
        walk_model::write(&refined, strut_formats::GENERATOR).len().div_ceil(1000)
    );
    held_out(&mut text, &[("adapted", &plain), ("refined", &refined)], &tests);
    let takes = match args.halves.as_slice() {
        [] => Vec::new(),
        inputs => read_walks(inputs, args.pattern.as_ref(), None, &mut refused, &unwatched)?.1,
    };
    if !takes.is_empty() {
        halves::write(&mut text, &names(&args.halves), (&body, &clips), &takes).map_err(TaskError::new)?;
    }
    let runtime = Arc::new(RuntimeWalkModel::new(&refined));
    let plain_runtime = Arc::new(RuntimeWalkModel::new(&plain));
    linearity(&mut text, [(&plain, &plain_runtime), (&refined, &runtime)]).map_err(TaskError::new)?;
    text.push_str(intensity::INTRODUCTION);
    let _ = writeln!(text, "### {} styles\n", refined.styles.len());
    intensity::write(&mut text, &refined, &runtime).map_err(TaskError::new)?;
    if !takes.is_empty() {
        let more = halves::with_first_takes((&body, &clips), &takes).map_err(TaskError::new)?;
        let _ = writeln!(text, "### {} styles: with the first takes of {}\n", more.styles.len(), names(&args.halves));
        intensity::write(&mut text, &more, &Arc::new(RuntimeWalkModel::new(&more))).map_err(TaskError::new)?;
    }
    transitions(&mut text, &refined, &runtime).map_err(TaskError::new)?;
    contexts(&mut text, &plain, &walks);
    horizon(&mut text, &refined, &runtime, &tests).map_err(TaskError::new)?;
    let _ = writeln!(
        text,
        "## Cost\n\n{:.1} µs per frame, natively, including the root and the joint limits.",
        cost_us(&runtime)
    );

    print_warnings(&corpus::warnings(&refused));
    write_or_print(args.output.as_deref(), &text)
}

/// Writes the reconstruction errors of each model on held-out walks.
fn held_out(text: &mut String, models: &[(&str, &WalkModel)], tests: &[&Walk]) {
    text.push_str(
        "## Held-out walks\n\nThe walks are synthesised with the likeliest durations of the states. *Amplitude* and \
         *step length* are shares of the recorded values. *Recognised* counts the steps whose own style is the \
         likeliest.\n\n",
    );
    text.push_str("| means | rotations | positions | amplitude | step length | recognised |\n");
    text.push_str("| --- | ---: | ---: | ---: | ---: | ---: |\n");
    for (name, model) in models {
        let mut all = Reconstruction::default();
        let (mut right, mut count) = (0, 0);
        for walk in tests {
            let Some(style) = model.styles.iter().position(|s| *s == walk.style) else { continue };
            all.add(model, style, &walk.track);
            let found = recognise(model, &walk.track);
            right += found.iter().filter(|s| **s == style).count();
            count += found.len();
        }
        let _ = writeln!(
            text,
            "| {name} | {:.2}° | {:.2} cm | {:.3} | {:.3} | {right} of {count} |",
            all.degrees(),
            all.centimetres(),
            all.amplitude(),
            all.step_length()
        );
    }
    text.push('\n');
}

/// Returns pairs of different styles.
fn pairs(model: &WalkModel) -> impl Iterator<Item = (usize, usize)> {
    let styles = model.styles.len();
    (0..styles).flat_map(move |a| (a + 1..styles).map(move |b| (a, b)))
}

/// Writes the linearity of interpolation between two styles, with the adapted and with the refined means.
fn linearity(text: &mut String, models: [(&WalkModel, &Arc<RuntimeWalkModel>); 2]) -> Result<(), WeightsError> {
    let [adapted, refined] = models.map(|(model, runtime)| deviations(model, runtime));
    text.push_str(
        "## Interpolation\n\nEleven mixtures are made between two styles. The table has their greatest deviation from \
         linear interpolation, ",
    );
    let _ = writeln!(
        text,
        "as a share of the difference between the two styles. Values are medians over all pairs, with {STEPS} steps \
         each.\n\n\
         | | adapted | refined |\n| --- | ---: | ---: |"
    );
    for ((name, adapted), (_, refined)) in adapted?.into_iter().zip(refined?) {
        let _ = writeln!(text, "| {name} | {:.1} % | {:.1} % |", 100.0 * adapted, 100.0 * refined);
    }
    text.push('\n');
    Ok(())
}

/// Returns the median deviations from the straight line between styles, by name.
fn deviations(model: &WalkModel, runtime: &Arc<RuntimeWalkModel>) -> Result<Vec<(&'static str, f64)>, WeightsError> {
    let mut all: Vec<(&str, Vec<f64>)> = Vec::new();
    for (a, b) in pairs(model) {
        let at = |k: f32| GaitStatistics::of(model, runtime, &weights(model, &[(a, 1.0 - k), (b, k)]), STEPS);
        let manners = (0..=10).map(|i| at(i as f32 / 10.0)).collect::<Result<Vec<_>, _>>()?;
        let (first, last) = (manners[0].named(), manners[10].named());
        for (i, ((name, from), (_, to))) in first.into_iter().zip(last).enumerate() {
            let off = |(n, m): (usize, &GaitStatistics)| (m.named()[i].1 - from - (to - from) * n as f64 / 10.0).abs();
            let worst = manners.iter().enumerate().map(off).fold(0.0, f64::max) / (to - from).abs().max(1e-9);
            match all.get_mut(i) {
                Some((_, of_name)) => of_name.push(worst),
                None => all.push((name, vec![worst])),
            }
        }
    }
    Ok(all.into_iter().map(|(name, of_name)| (name, median(of_name))).collect())
}

/// Writes the contexts whose steps need separate models.
fn contexts(text: &mut String, model: &WalkModel, walks: &[Walk]) {
    let walks: Vec<(usize, &Track)> = walks
        .iter()
        .filter_map(|w| Some((model.styles.iter().position(|style| *style == w.style)?, &w.track)))
        .collect();
    text.push_str(
        "## Contexts\n\nA decision tree splits the steps of all walks by side and by position in the clip. By the \
         criterion of minimum description length, a split must increase the likelihood by more than it costs.\n\n",
    );
    for (name, style_free) in [("As recorded", false), ("With every style's mean pose subtracted", true)] {
        let ContextTree { splits, rejected, cost } = ContextTree::grow(model, &walks, style_free);
        let asked: Vec<String> = splits.iter().map(|s| format!("{} gains {:.0}", s.question, s.gain)).collect();
        let _ = writeln!(
            text,
            "- {name}, a split costs {cost:.0}: {} leaves ({}); the best rejected question gains {rejected:.0}.",
            splits.len() + 1,
            asked.join(", ")
        );
    }
    text.push_str(
        "\nThe split by side gains far more than it costs. The split by position gains less than it costs, because \
         the clips are cut from longer walks. The model therefore has two contexts: left steps and right steps.\n\n",
    );
}

/// Writes the joint velocities during changes of style.
fn transitions(text: &mut String, model: &WalkModel, runtime: &Arc<RuntimeWalkModel>) -> Result<(), WeightsError> {
    text.push_str(
        "## Transitions\n\nThe table has the greatest accelerations while the style changes, as a share of the \
         greatest acceleration of steady walking in either style, over all pairs of styles. *Joint* is the joint with \
         the largest share. *Degree of freedom* is the degree of freedom with the largest share; some hardly move. \
         *Greatest* compares the joints with the greatest acceleration.\n\n",
    );
    text.push_str(
        "| steps of the change | joint, median | worst | degree of freedom, median | worst | greatest, worst |\n",
    );
    text.push_str("| ---: | ---: | ---: | ---: | ---: | ---: |\n");
    let worst = |peaks: &[Peaks], of: fn(&Peaks) -> f64| peaks.iter().map(of).fold(0.0, f64::max);
    let middle = |peaks: &[Peaks], of: fn(&Peaks) -> f64| median(peaks.iter().map(of).collect());
    for between in BETWEEN {
        let peaks = |(a, b)| {
            transition_peaks(model, runtime, [&weights(model, &[(a, 1.0)]), &weights(model, &[(b, 1.0)])], between)
        };
        let peaks = pairs(model).map(peaks).collect::<Result<Vec<_>, _>>()?;
        let _ = writeln!(
            text,
            "| {between} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} |",
            middle(&peaks, |p| p.joint),
            worst(&peaks, |p| p.joint),
            middle(&peaks, |p| p.freedom),
            worst(&peaks, |p| p.freedom),
            worst(&peaks, |p| p.greatest)
        );
    }
    let stops = (0..model.styles.len())
        .map(|s| stopping_peaks(model, runtime, &weights(model, &[(s, 1.0)])))
        .collect::<Result<Vec<_>, _>>()?;
    let _ = writeln!(
        text,
        "\nA walk that stops within two steps, stands and starts again reaches at most {:.2}, {:.2} and {:.2} of it, \
         over all styles.\n",
        worst(&stops, |p| p.joint),
        worst(&stops, |p| p.freedom),
        worst(&stops, |p| p.greatest)
    );
    Ok(())
}

/// Writes the error of the finite horizon, and of its backward pass in single precision.
fn horizon(
    text: &mut String,
    model: &WalkModel,
    runtime: &Arc<RuntimeWalkModel>,
    tests: &[&Walk],
) -> Result<(), WeightsError> {
    let errors = (0..model.styles.len()).map(|s| horizon_error(model, runtime, s)).collect::<Result<Vec<_>, _>>()?;
    let mean = errors.iter().map(|e| e[0]).sum::<f64>() / errors.len() as f64;
    let worst = errors.iter().map(|e| e[1]).fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "## Looking ahead\n\nA walker computes its trajectory with a look-ahead of {HORIZON} frames. Joint angles \
         differ from the trajectory of the whole walk by {mean:.3}° on average and {worst:.2}° at most."
    );
    let style_of = |walk: &Walk| model.styles.iter().position(|style| *style == walk.style);
    let rounding = tests.iter().filter_map(|walk| recursion_error(model, style_of(walk)?, &walk.track));
    let _ = writeln!(
        text,
        "For the states of the held-out walks, the walker's recursion in single precision differs from the banded \
         system in double precision by {:.1e} rad at most.\n",
        rounding.fold(0.0, f64::max)
    );
    Ok(())
}

/// Returns the median; NaN without values.
fn median(values: Vec<f64>) -> f64 {
    stats::median(values).unwrap_or(f64::NAN)
}

/// Returns names of files and folders for a message.
fn names(inputs: &[PathBuf]) -> String {
    let names: Vec<String> = inputs.iter().filter_map(|p| p.file_name()).map(|n| n.display().to_string()).collect();
    names.join(", ")
}

/// Returns the time per frame, microseconds.
fn cost_us(runtime: &Arc<RuntimeWalkModel>) -> f64 {
    let mut walker = Walker::new(Arc::clone(runtime));
    let begin = Instant::now();
    (0..FRAMES).for_each(|_| _ = walker.advance());
    1e6 * begin.elapsed().as_secs_f64() / f64::from(FRAMES)
}
