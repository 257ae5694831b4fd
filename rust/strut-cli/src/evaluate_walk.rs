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
use strut_core::hsmm::evaluation::{
    Bearing, ContextTree, Manner, Reconstruction, bearing, horizon_error, recognise, stopping_peak, transition_peak,
};
use strut_core::hsmm::{
    HORIZON, Options, Side, Track, Training, WalkModel, WalkVoices, Walker, WeightsError, steps_of, train,
};
use strut_formats::corpus::Pattern;
use strut_formats::{strutdb, walk_model};

/// Steps of the walks that are measured: a frame more or less counts little in so many.
const STEPS: u64 = 100;
/// Intensities that styles are tried at, and those between which their manner shall change in one direction.
const INTENSITIES: [f32; 9] = [-3.0, -2.0, -1.0, 0.0, 1.0, 1.5, 2.0, 2.5, 3.0];
const MONOTONE: std::ops::RangeInclusive<i16> = -4..=8;
const MONOTONE_STEP: f32 = 0.25;
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
    /// Walks of which the first half of every take is to say the second; files, folders or archives
    #[arg(long, value_name = "INPUT")]
    halves: Vec<PathBuf>,
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
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "Written by `strut evaluate-walk` on the walks of {}: {} clips of {} styles to train on in {seconds:.1} s, {} \
         clips held out. The model file has {} kB.\n",
        names(&args.inputs),
        rest.len(),
        refined.styles.len(),
        tests.len(),
        walk_model::write(&refined, strutdb::GENERATOR).len().div_ceil(1000)
    );
    held_out(&mut text, &[("adapted", &plain), ("refined", &refined)], &tests);
    if !args.halves.is_empty() {
        halves(&mut text, &args.halves, args.pattern.as_ref(), &clips)?;
    }
    let voices = Arc::new(WalkVoices::new(&refined));
    let plain_voices = Arc::new(WalkVoices::new(&plain));
    linearity(&mut text, [(&plain, &plain_voices), (&refined, &voices)]).map_err(Failure::new)?;
    intensity(&mut text, &refined, &voices).map_err(Failure::new)?;
    transitions(&mut text, &refined, &voices).map_err(Failure::new)?;
    contexts(&mut text, &plain, &walks);
    horizon(&mut text, &refined, &voices).map_err(Failure::new)?;
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

/// How well the first half of every take says its second half: what one performance holds, beside other styles of which
/// there is more.
fn halves(text: &mut String, inputs: &[PathBuf], pattern: Option<&Pattern>, others: &[Training<'_>]) -> Outcome {
    let mut refused = Vec::new();
    let (body, walks) = read_walks(inputs, pattern, None, &mut refused)?;
    let halves: Vec<(String, [Track; 2])> =
        walks.into_iter().map(|w| (format!("{} {}", w.style, w.take), w.track.halves())).collect();
    // A style per take, of those whose first half has steps of both feet.
    let has_both = |track: &Track| {
        let steps = steps_of(track);
        [Side::Left, Side::Right].iter().all(|side| steps.iter().any(|step| step.side == *side))
    };
    let usable: Vec<_> = halves.iter().filter(|(_, [first, _])| has_both(first)).collect();
    let first_halves = usable.iter().map(|(style, [first, _])| Training { style, track: first });
    let clips: Vec<Training> = others.iter().copied().chain(first_halves).collect();
    let _ = writeln!(
        text,
        "## Half a take\n\nThe first half of each of {} takes of {} trains a style of its own beside the styles above, and is \
         to say the second.\n\n\
         | means | rotations | positions | amplitude | step length |\n| --- | ---: | ---: | ---: | ---: |",
        usable.len(),
        names(inputs)
    );
    for (name, refined) in [("adapted", false), ("refined", true)] {
        let model = train(&body, &clips, Options { refined }, &ThreadPool).map_err(Failure::new)?;
        let mut all = Reconstruction::default();
        for (style, [_, second]) in &usable {
            if let Some(style) = model.styles.iter().position(|s| s == style) {
                all.add(&model, style, second);
            }
        }
        let _ = writeln!(
            text,
            "| {name} | {:.2}° | {:.2} cm | {:.3} | {:.3} |",
            all.degrees(),
            all.centimetres(),
            all.amplitude(),
            all.step_length()
        );
    }
    text.push('\n');
    Ok(())
}

/// How straight the way between two styles is, by the adapted means and by the refined ones.
fn linearity(text: &mut String, models: [(&WalkModel, &Arc<WalkVoices>); 2]) -> Result<(), WeightsError> {
    let [adapted, refined] = models.map(|(model, voices)| deviations(model, voices));
    text.push_str(
        "## Interpolation\n\nGreatest deviation from the straight line between two styles, of eleven mixtures, ",
    );
    let _ = writeln!(
        text,
        "as a share of what lies between the two: median over all pairs, {STEPS} steps each.\n\n\
         | | adapted | refined |\n| --- | ---: | ---: |"
    );
    for ((name, adapted), (_, refined)) in adapted?.into_iter().zip(refined?) {
        let _ = writeln!(text, "| {name} | {:.1} % | {:.1} % |", 100.0 * adapted, 100.0 * refined);
    }
    text.push('\n');
    Ok(())
}

/// Median deviations from the straight line between styles, by name.
fn deviations(model: &WalkModel, voices: &Arc<WalkVoices>) -> Result<Vec<(&'static str, f64)>, WeightsError> {
    let mut all: Vec<(&str, Vec<f64>)> = Vec::new();
    for (a, b) in pairs(model) {
        let at = |k: f32| Manner::of(model, voices, &weights(model, &[(a, 1.0 - k), (b, k)]), STEPS);
        let manners = (0..=10).map(|i| at(i as f32 / 10.0)).collect::<Result<Vec<_>, _>>()?;
        let (first, last) = (manners[0].named(), manners[10].named());
        for (i, ((name, from), (_, to))) in first.into_iter().zip(last).enumerate() {
            let off = |(n, m): (usize, &Manner)| (m.named()[i].1 - from - (to - from) * n as f64 / 10.0).abs();
            let worst = manners.iter().enumerate().map(off).fold(0.0, f64::max) / (to - from).abs().max(1e-9);
            match all.get_mut(i) {
                Some((_, of_name)) => of_name.push(worst),
                None => all.push((name, vec![worst])),
            }
        }
    }
    Ok(all.into_iter().map(|(name, of_name)| (name, median(of_name))).collect())
}

/// How styles bear being weakened, exaggerated and negated.
fn intensity(text: &mut String, model: &WalkModel, voices: &Arc<WalkVoices>) -> Result<(), WeightsError> {
    let styles = model.styles.len();
    let _ = writeln!(
        text,
        "## Intensity\n\nOf {styles} styles those that fail at an intensity against the average: over 1 % of the joints' \
         angles more than 10° outside what was recorded, a knee bent the wrong way by over 8°, or the wrong foot bearing the \
         body for over 15 % of the time. *Limited* is with the joints' soft limits, *free* without them and without that of \
         the states' durations, of which one below half a frame is a failure too.\n"
    );
    let row = |first: &str, cells: [String; INTENSITIES.len()]| format!("| {first} | {} |\n", cells.join(" | "));
    text.push_str(&row("", INTENSITIES.map(|at| at.to_string())));
    text.push_str(&row("---", INTENSITIES.map(|_| "---:".into())));
    for (name, limits) in [("free", false), ("limited", true)] {
        let all = INTENSITIES
            .iter()
            .map(|at| (0..styles).map(|s| bearing(model, voices, s, *at, limits)).collect::<Result<Vec<_>, _>>())
            .collect::<Result<Vec<_>, _>>()?;
        let each = |f: fn(&[Bearing]) -> String| std::array::from_fn(|i| f(&all[i]));
        text.push_str(&row(&format!("fail, {name}"), each(|b| b.iter().filter(|b| b.fails).count().to_string())));
        let worst = |b: &[Bearing]| format!("{:.0}°", b.iter().map(|b| b.knee).fold(f64::INFINITY, f64::min));
        text.push_str(&row(&format!("worst knee, {name}"), each(worst)));
    }
    let _ = writeln!(
        text,
        "\nFrom {} to {} in steps of {MONOTONE_STEP}, increments that go the way that the whole goes, styles of which all do, \
         and the greatest increment that does not, as a share of what lies between the style's ends and of that of the style \
         which changes most:\n\n\
         | | increments | styles | greatest step back | of the greatest change |\n| --- | ---: | ---: | ---: | ---: |",
        f32::from(*MONOTONE.start()) * MONOTONE_STEP,
        f32::from(*MONOTONE.end()) * MONOTONE_STEP
    );
    let ways = (0..styles)
        .map(|style| {
            let at =
                |i: i16| Manner::of(model, voices, &weights(model, &[(style, f32::from(i) * MONOTONE_STEP)]), STEPS);
            MONOTONE.map(at).collect::<Result<Vec<_>, _>>()
        })
        .collect::<Result<Vec<_>, _>>()?;
    for (i, (name, _)) in ways[0][0].named().into_iter().enumerate() {
        let values = |way: &Vec<Manner>| -> Vec<f64> { way.iter().map(|m| m.named()[i].1).collect() };
        let change = |values: &[f64]| values[values.len() - 1] - values[0];
        let most = ways.iter().map(|way| change(&values(way)).abs()).fold(f64::MIN_POSITIVE, f64::max);
        let (mut same, mut of, mut whole, mut back, mut of_most) = (0, 0, 0, 0.0_f64, 0.0_f64);
        for way in &ways {
            let values = values(way);
            let whole_change = change(&values);
            let steps_back = values.windows(2).map(|w| -(w[1] - w[0]) * whole_change.signum());
            let worst = steps_back.clone().fold(0.0, f64::max);
            let right = steps_back.filter(|back| *back <= 0.0).count();
            (same, of, whole) = (same + right, of + values.len() - 1, whole + usize::from(right + 1 == values.len()));
            (back, of_most) = (back.max(worst / whole_change.abs()), of_most.max(worst / most));
        }
        let _ = writeln!(
            text,
            "| {name} | {:.1} % | {whole} of {styles} | {:.1} % | {:.1} % |",
            100.0 * f64::from(same as u32) / of as f64,
            100.0 * back,
            100.0 * of_most
        );
    }
    text.push('\n');
    Ok(())
}

/// Which steps deserve models of their own.
fn contexts(text: &mut String, model: &WalkModel, walks: &[Walk]) {
    let walks: Vec<(usize, &Track)> = walks
        .iter()
        .filter_map(|w| Some((model.styles.iter().position(|style| *style == w.style)?, &w.track)))
        .collect();
    text.push_str(
        "## Contexts\n\nA tree by minimum description length parts the steps of all walks by side and by place in ",
    );
    text.push_str("the clip, as long as that makes the frames likelier by more than it costs.\n\n");
    for (name, style_free) in [("As recorded", false), ("With every style's mean pose taken off", true)] {
        let ContextTree { splits, rejected, cost } = ContextTree::grow(model, &walks, style_free);
        let asked: Vec<String> = splits.iter().map(|s| format!("{} gains {:.0}", s.question, s.gain)).collect();
        let _ = writeln!(
            text,
            "- {name}, a split costs {cost:.0}: {} leaves ({}); the best question that is not asked gains {rejected:.0}.",
            splits.len() + 1,
            asked.join(", ")
        );
    }
    text.push_str(
        "\nSide is worth its model many hundred times over, place hardly, as the clips are cut out of longer walks: ",
    );
    text.push_str("models are those of left and right steps.\n\n");
}

/// How hard changes of style are.
fn transitions(text: &mut String, model: &WalkModel, voices: &Arc<WalkVoices>) -> Result<(), WeightsError> {
    text.push_str("## Transitions\n\nGreatest acceleration while one style gives way to another, as a share of the ");
    text.push_str("greatest of steady walking in either: of the degree of freedom where that is largest, and of all ");
    text.push_str("together. All pairs.\n\n");
    text.push_str("| steps in between | largest, median | worst | together, median | worst |\n");
    text.push_str("| ---: | ---: | ---: | ---: | ---: |\n");
    for between in BETWEEN {
        let peak = |(a, b)| {
            transition_peak(model, voices, [&weights(model, &[(a, 1.0)]), &weights(model, &[(b, 1.0)])], between)
        };
        let peaks = pairs(model).map(peak).collect::<Result<Vec<_>, _>>()?;
        let _ = write!(text, "| {between} |");
        for i in 0..2 {
            let of: Vec<f64> = peaks.iter().map(|p| p[i]).collect();
            let worst = of.iter().copied().fold(0.0, f64::max);
            let _ = write!(text, " {:.2} | {worst:.2} |", median(of));
        }
        text.push('\n');
    }
    let stops = (0..model.styles.len())
        .map(|s| stopping_peak(model, voices, &weights(model, &[(s, 1.0)])))
        .collect::<Result<Vec<_>, _>>()?;
    let [largest, together] = [0, 1].map(|i| stops.iter().map(|p| p[i]).fold(0.0, f64::max));
    let _ = writeln!(
        text,
        "\nWho stops within two steps, stands and goes again reaches {largest:.2} and {together:.2} of it at worst, in all \
         styles.\n"
    );
    Ok(())
}

/// What looking ahead no farther costs.
fn horizon(text: &mut String, model: &WalkModel, voices: &Arc<WalkVoices>) -> Result<(), WeightsError> {
    let errors = (0..model.styles.len()).map(|s| horizon_error(model, voices, s)).collect::<Result<Vec<_>, _>>()?;
    let mean = errors.iter().map(|e| e[0]).sum::<f64>() / errors.len() as f64;
    let worst = errors.iter().map(|e| e[1]).fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "## Looking ahead\n\nAgainst the trajectory of the whole walk, joints that look {HORIZON} frames ahead are off by \
         {mean:.3}° on average and {worst:.2}° at most.\n"
    );
    Ok(())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Names of files and folders, for a sentence.
fn names(inputs: &[PathBuf]) -> String {
    let names: Vec<String> = inputs.iter().filter_map(|p| p.file_name()).map(|n| n.display().to_string()).collect();
    names.join(", ")
}

/// Microseconds of a frame.
fn cost_us(voices: &Arc<WalkVoices>) -> f64 {
    let mut walker = Walker::new(Arc::clone(voices));
    let begin = Instant::now();
    (0..FRAMES).for_each(|_| _ = walker.advance());
    1e6 * begin.elapsed().as_secs_f64() / f64::from(FRAMES)
}
