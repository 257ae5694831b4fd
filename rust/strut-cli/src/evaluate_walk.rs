//! `strut evaluate-walk`: how well models of walks say what they were not trained on.

use crate::corpus;
use crate::failure::{Failure, Outcome};
use crate::files::{Outputs, print, print_warnings};
use crate::threads::ThreadPool;
use crate::walks::{Walk, read_walks};
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use strut_core::hsmm::evaluation::{Manner, Reconstruction, recognise, transition_peak};
use strut_core::hsmm::{Options, Training, WalkModel, WalkVoices, Walker, WeightsError, train};
use strut_formats::corpus::Pattern;
use strut_formats::{strutdb, walk_model};

/// Steps of the walks that are measured.
const STEPS: u64 = 20;
/// Steps in between of the transitions that are measured.
const BETWEEN: [u32; 4] = [0, 2, 4, 6];
/// Frames that are timed.
const FRAMES: u32 = 3000;

/// Measure a model of walk styles on takes that it was not trained on
#[derive(clap::Args)]
pub(crate) struct Args {
    /// .bvh files, folders with all below them, .zip archives
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// How file names give the labels [default: {action}_{style}_{take}.bvh]
    #[arg(long, value_name = "P")]
    pattern: Option<Pattern>,
    /// Takes of every style that are tested on
    #[arg(long, value_name = "TAKES", value_delimiter = ',', default_value = "1,2")]
    held_out: Vec<u32>,
    /// Write the tables as Markdown
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check(args.output.as_deref())?;
    let mut refused = Vec::new();
    let (body, walks) = read_walks(&args.inputs, args.pattern.as_ref(), None, &mut refused)?;
    print_warnings(&corpus::warnings(&refused));
    let (tests, rest): (Vec<&Walk>, Vec<&Walk>) = walks.iter().partition(|w| args.held_out.contains(&w.take));
    if tests.is_empty() || rest.is_empty() {
        return Err(Failure::new("--held-out leaves no walk to train on, or none to test"));
    }
    let clips: Vec<Training> = rest.iter().map(|w| Training { style: &w.style, track: &w.track }).collect();
    let begin = Instant::now();
    let refined = train(&body, &clips, Options { refined: true }, &ThreadPool).map_err(Failure::new)?;
    let seconds = begin.elapsed().as_secs_f64();
    let plain = train(&body, &clips, Options { refined: false }, &ThreadPool).map_err(Failure::new)?;

    let mut text = String::from("# Walk synthesis\n\n");
    let inputs: Vec<String> =
        args.inputs.iter().filter_map(|p| p.file_name()).map(|n| n.display().to_string()).collect();
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "Written by `strut evaluate-walk` on the walks of {}: {} clips of {} styles to train on in {seconds:.1} s, {} \
         clips held out. The model file has {} kB.\n",
        inputs.join(", "),
        rest.len(),
        refined.styles.len(),
        tests.len(),
        walk_model::write(&refined, strutdb::GENERATOR).len().div_ceil(1000)
    );
    held_out(&mut text, &[("adapted", &plain), ("refined", &refined)], &tests);
    let voices = Arc::new(WalkVoices::new(&refined));
    linearity(&mut text, &refined, &voices).map_err(Failure::new)?;
    transitions(&mut text, &refined, &voices).map_err(Failure::new)?;
    let _ = writeln!(text, "## Cost\n\n{:.1} µs a frame, natively, with root and joint limits.", cost_us(&voices));

    match &args.output {
        Some(path) => {
            let mut outputs = Outputs::default();
            outputs.stage(path, text.as_bytes())?;
            outputs.commit()?;
        }
        None => print(&text),
    }
    Ok(())
}

/// What held-out walks show of each model.
fn held_out(text: &mut String, models: &[(&str, &WalkModel)], tests: &[&Walk]) {
    text.push_str(
        "## Held-out walks\n\nWith the states' likeliest durations. *Amplitude* and *step length* are shares of ",
    );
    text.push_str("the recorded ones; *recognised* are steps whose style is the likeliest.\n\n");
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

/// Weights of one style, or of two.
fn weights(model: &WalkModel, of: &[(usize, f32)]) -> Vec<f32> {
    let mut weights = vec![0.0; model.styles.len()];
    for &(style, weight) in of {
        weights[style] += weight;
    }
    weights
}

/// Pairs of different styles.
fn pairs(model: &WalkModel) -> impl Iterator<Item = (usize, usize)> {
    let styles = model.styles.len();
    (0..styles).flat_map(move |a| (a + 1..styles).map(move |b| (a, b)))
}

/// How straight the way between two styles is.
fn linearity(text: &mut String, model: &WalkModel, voices: &Arc<WalkVoices>) -> Result<(), WeightsError> {
    let mut deviations: Vec<(&str, Vec<f64>)> = Vec::new();
    for (a, b) in pairs(model) {
        let at = |k: f32| Manner::of(model, voices, &weights(model, &[(a, 1.0 - k), (b, k)]), STEPS);
        let manners = (0..=10).map(|i| at(i as f32 / 10.0)).collect::<Result<Vec<_>, _>>()?;
        let (first, last) = (manners[0].named(), manners[10].named());
        for (i, ((name, from), (_, to))) in first.into_iter().zip(last).enumerate() {
            let off = |(n, m): (usize, &Manner)| (m.named()[i].1 - from - (to - from) * n as f64 / 10.0).abs();
            let worst = manners.iter().enumerate().map(off).fold(0.0, f64::max);
            match deviations.get_mut(i) {
                Some((_, all)) => all.push(worst / (to - from).abs().max(1e-9)),
                None => deviations.push((name, vec![worst / (to - from).abs().max(1e-9)])),
            }
        }
    }
    text.push_str(
        "## Interpolation\n\nGreatest deviation from the straight line between two styles, as a share of what lies ",
    );
    let _ =
        writeln!(text, "between them, of eleven mixtures: median over all pairs.\n\n| | deviation |\n| --- | ---: |");
    for (name, mut all) in deviations {
        all.sort_by(f64::total_cmp);
        let _ = writeln!(text, "| {name} | {:.1} % |", 100.0 * all[all.len() / 2]);
    }
    text.push('\n');
    Ok(())
}

/// How hard changes of style are.
fn transitions(text: &mut String, model: &WalkModel, voices: &Arc<WalkVoices>) -> Result<(), WeightsError> {
    text.push_str(
        "## Transitions\n\nGreatest acceleration of any joint's degree of freedom while one style gives way to ",
    );
    text.push_str("another, as a share of the greatest of steady walking: all pairs.\n\n");
    text.push_str("| steps in between | median | worst |\n| ---: | ---: | ---: |\n");
    for between in BETWEEN {
        let peak = |(a, b)| {
            transition_peak(model, voices, [&weights(model, &[(a, 1.0)]), &weights(model, &[(b, 1.0)])], between)
        };
        let mut peaks = pairs(model).map(peak).collect::<Result<Vec<_>, _>>()?;
        peaks.sort_by(f64::total_cmp);
        let _ = writeln!(text, "| {between} | {:.2} | {:.2} |", peaks[peaks.len() / 2], peaks[peaks.len() - 1]);
    }
    text.push('\n');
    Ok(())
}

/// Microseconds of a frame.
fn cost_us(voices: &Arc<WalkVoices>) -> f64 {
    let mut walker = Walker::new(Arc::clone(voices));
    let begin = Instant::now();
    (0..FRAMES).for_each(|_| _ = walker.advance());
    1e6 * begin.elapsed().as_secs_f64() / f64::from(FRAMES)
}
