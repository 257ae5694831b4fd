//! Errors, jumps, control, support and cost (`docs/methods/somn.md` §7 and §9).

use super::data::DataSet;
use std::fmt::Write;
use std::sync::Arc;
use std::time::Instant;
use strut_core::somn::{
    DragCharacter, EM_RIDGE, KeyStyleModel, Learning, MAX_AXES, Mode, Options, PoseSpace, RATE_HZ, Recording, Row,
    Style, Synthesis, train,
};
use strut_evaluation::key_style::{Baseline, Observed, largest_change, pose_error, third_difference};
use strut_tasks::{Outcome, TaskError};

/// Number of polylines to drag along, polylines per draw, recorded styles on each, and frames between two of these
/// styles.
const LINES: usize = 100;
const LINES_A_DRAW: usize = 10;
const STYLES_EACH: usize = 6;
const FRAMES_EACH: usize = 45;
/// The mixture as it was trained.
pub(super) const AS_LEARNT: Mode = temperature(1.0);
/// Number of timed poses.
const POSES: usize = 20_000;

/// Returns held-out recordings with their measured styles.
pub(super) fn observed(model: &KeyStyleModel, recordings: &[Recording]) -> Vec<Observed> {
    recordings.iter().map(|recording| Observed::new(model, recording)).collect()
}

/// Returns the mean error of poses predicted from their styles.
fn mean_error(model: &KeyStyleModel, of: &[Observed], mut row: impl FnMut(&Style) -> Row) -> [f64; 2] {
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for (x, style) in of.iter().flat_map(|o| o.rows.iter().zip(&o.styles)) {
        let error = pose_error(&model.space, &row(style), x);
        (0..2).for_each(|i| sums[i] += error[i]);
        count += 1.0;
    }
    sums.map(|sum| sum / count)
}

fn mean(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values.clone().sum::<f64>() / values.count() as f64
}

/// Writes likelihood and error of every training method.
pub(super) fn errors(text: &mut String, sets: &[DataSet], seeds: u64) -> Outcome {
    let _ = writeln!(
        text,
        "## Held-out poses\n\nMeans of {seeds} seeds. The column *ll* is the log-likelihood of a pose given its \
         style, in nats. *Hard* is Algorithm 1 of the paper, with regions. *Smooth* is the mixture as trained \
         (temperature 1). *Default* is the setting for dragging in the playground: temperature 2 and a blur of 0.3.\n\n\
         | data | method | ll training | ll held out | hard | smooth | | default | time |\n\
         | --- | --- | ---: | ---: | ---: | ---: | --- | ---: | ---: |"
    );
    let usual = format!("EM, ridge {EM_RIDGE}");
    for set in sets {
        let methods = [
            (&*usual, Learning::Em { ridge: EM_RIDGE }, set.plan.published[1]),
            ("EM, ridge 0.3", Learning::Em { ridge: 0.3 }, [f64::NAN; 2]),
            ("SOMN", Learning::Som, set.plan.published[0]),
        ];
        for (name, learning, published) in methods {
            let begin = Instant::now();
            let models = set.models(learning, seeds)?;
            let secs = begin.elapsed().as_secs_f64() / seeds as f64;
            let likelihood = |recordings: &[Recording]| {
                mean(models.iter().map(|model| {
                    let of = observed(model, recordings);
                    let frames = |o: &Observed| o.rows.len() as f64;
                    of.iter().map(|o| o.log_likelihood(model) * frames(o)).sum::<f64>()
                        / of.iter().map(frames).sum::<f64>()
                }))
            };
            let error = |mode: Mode| {
                let errors: Vec<[f64; 2]> = models
                    .iter()
                    .map(|model| {
                        let mut synthesis = Synthesis::new(Arc::new(model.clone()));
                        mean_error(model, &observed(model, &set.test), |style| synthesis.row(style, mode))
                    })
                    .collect();
                [0, 1].map(|i| mean(errors.iter().map(|e| e[i])))
            };
            let (hard, smooth) = (error(Mode::Hard), error(AS_LEARNT));
            let default = error(Mode::default());
            let _ = writeln!(
                text,
                "| {} | {name} | {:.1} | {:.1} | {:.2}° | {:.2}° / {:.2} cm | {} | {:.2}° | {secs:.2} s |",
                set.plan.name,
                likelihood(&set.training),
                likelihood(&set.test),
                hard[0],
                smooth[0],
                smooth[1],
                published_pair(published),
                default[0],
            );
        }
    }
    text.push('\n');
    Ok(())
}

fn published_pair([degrees, centimetres]: [f64; 2]) -> String {
    match (degrees.is_nan(), centimetres.is_nan()) {
        (true, _) => String::new(),
        (false, true) => format!("*{degrees:.2}°*"),
        (false, false) => format!("*{degrees:.2}° / {centimetres:.2} cm*"),
    }
}

/// Writes baselines without a model.
pub(super) fn baselines(text: &mut String, sets: &[DataSet]) -> Outcome {
    text.push_str(
        "## Baselines without a mixture\n\nThe baselines are the mean pose, one linear map (least squares), the \
         recorded pose of the nearest style, and a kernel. *Kernel* is the mean of the recorded poses, weighted by a \
         Gaussian of 0.15 or 0.3 standard deviations of the style.\n\n\
         | data | mean | linear | nearest | kernel 0.15 | kernel 0.3 |\n| --- | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for set in sets {
        let model = set.train(Learning::Em { ridge: 0.0 }, 1, 0).map_err(TaskError::new)?;
        let test = observed(&model, &set.test);
        let mut linear = Synthesis::new(Arc::new(model.clone()));
        let of = |baseline: Baseline| mean_error(&model, &test, |style| baseline.row(&model, style));
        let cells = [
            of(Baseline::Mean),
            mean_error(&model, &test, |style| linear.row(style, Mode::default())),
            of(Baseline::Nearest),
            of(Baseline::Kernel(0.15)),
            of(Baseline::Kernel(0.3)),
        ];
        let cells = cells.map(|[degrees, cm]| format!("{degrees:.2}° / {cm:.2} cm"));
        let _ = writeln!(text, "| {} | {} |", set.plan.name, cells.join(" | "));
    }
    text.push('\n');
    Ok(())
}

const fn temperature(temperature: f64) -> Mode {
    Mode::Smooth { temperature, blur: 0.0 }
}

/// Writes how far joints jump while a style is dragged.
pub(super) fn jumps(text: &mut String, sets: &[&DataSet]) -> Outcome {
    let _ = writeln!(
        text,
        "## Dragging\n\nThe style moves along polylines through {STYLES_EACH} recorded styles, {FRAMES_EACH} frames \
         per segment. The table has the largest change of any joint from one frame to the next. A few segments \
         determine it, so {} draws of {LINES_A_DRAW} polylines were made: their median, minimum and maximum are \
         given. *Spring* means that the style is limited to the recorded range and follows a critically damped spring \
         of 0.1 s, as on the pad of the playground. *Error* is measured on held-out poses.\n\n\
         | data | mode | median draw | minimum to maximum | prototype | error |\n| --- | --- | ---: | ---: | ---: | ---: |",
        LINES / LINES_A_DRAW
    );
    for set in sets {
        let model = Arc::new(set.model()?);
        let lines = polylines(&model);
        let draws = |rows: &mut dyn FnMut(&[Style]) -> Vec<Row>| -> Vec<f64> {
            let greatest: Vec<f64> = lines.iter().map(|line| largest_change(&model.space, &rows(line))).collect();
            let mut draws: Vec<f64> =
                greatest.chunks(LINES_A_DRAW).map(|draw| draw.iter().copied().fold(0.0, f64::max)).collect();
            draws.sort_by(f64::total_cmp);
            draws
        };
        let mut row = |name: &str, mode: Mode, is_sprung: bool, published: Option<[f64; 2]>| {
            let mut character = DragCharacter::new(Arc::clone(&model));
            character.set_mode(mode);
            let mut synthesis = Synthesis::new(Arc::clone(&model));
            let draws = draws(&mut |line| {
                character.reset(&line[0]);
                let mut follow = |style| {
                    if !is_sprung {
                        return synthesis.row(style, mode);
                    }
                    character.drag(style, 1.0 / f64::from(RATE_HZ));
                    *character.row()
                };
                line.iter().map(&mut follow).collect()
            });
            let error = if is_sprung {
                String::new()
            } else {
                let test = observed(&model, &set.test);
                format!("{:.2}°", mean_error(&model, &test, |style| synthesis.row(style, mode))[0])
            };
            let published =
                published.map_or(String::new(), |of| format!("*{:.1}°*", of[usize::from(set.plan.name == "walk")]));
            let (median, least, most) = (draws[draws.len() / 2], draws[0], draws[draws.len() - 1]);
            let _ = writeln!(
                text,
                "| {} | {name} | {median:.1}° | {least:.1} to {most:.1}° | {published} | {error} |",
                set.plan.name
            );
        };
        row("hard", Mode::Hard, false, Some([56.4, 25.0]));
        row("hard, spring", Mode::Hard, true, Some([9.8, 4.3]));
        row("temperature 1", AS_LEARNT, false, Some([11.6, 8.7]));
        row("temperature 2", temperature(2.0), false, Some([7.4, 5.1]));
        row("temperature 4", temperature(4.0), false, Some([5.6, 2.9]));
        for (temperature, blur) in [(1.0, 0.2), (1.0, 0.3), (2.0, 0.2)] {
            let name = format!("temperature {temperature}, blur {blur}");
            row(&name, Mode::Smooth { temperature, blur }, false, None);
        }
        row("**temperature 2, blur 0.3: the default**", Mode::default(), false, None);
        row("the default, spring", Mode::default(), true, None);
        let recorded =
            observed(&model, &set.test).iter().map(|o| largest_change(&model.space, &o.rows)).fold(0.0, f64::max);
        let published = if set.plan.name == "walk" { "*17.6°*" } else { "" };
        let _ = writeln!(text, "| {} | recorded | {recorded:.1}° | | {published} | |", set.plan.name);
    }
    text.push('\n');
    Ok(())
}

/// Returns a pseudorandom number generator with a fixed seed.
fn random() -> impl FnMut(usize) -> usize {
    let mut seed = 1_u64;
    move |end| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % end
    }
}

fn polylines(model: &KeyStyleModel) -> Vec<Vec<Style>> {
    let mut random = random();
    let mut line = || {
        let corners: Vec<Style> =
            (0..STYLES_EACH).map(|_| model.in_units(&model.styles[random(model.styles.len())])).collect();
        corners.windows(2).flat_map(|leg| (0..FRAMES_EACH).map(|i| between(&leg[0], &leg[1], i))).collect()
    };
    (0..LINES).map(|_| line()).collect()
}

fn between(a: &Style, b: &Style, frame: usize) -> Style {
    let share = frame as f64 / FRAMES_EACH as f64;
    std::array::from_fn(|j| a[j] + share * (b[j] - a[j]))
}

/// Writes the control accuracy: requested and measured style.
pub(super) fn control(text: &mut String, sets: &[DataSet]) -> Outcome {
    text.push_str(
        "## Control\n\nThe columns have the mean difference between the requested style, a held-out one, and the \
         style that is measured on the resulting pose. *As shown*: the lowest foot of the pose is on the floor. *As \
         trained*: the mixture at temperature 1, with the hips at the predicted height; the prototype was measured in \
         this way.\n\n| data | as shown | as trained | prototype |\n| --- | --- | --- | --- |\n",
    );
    for set in sets {
        let model = Arc::new(set.model()?);
        let mut synthesis = Synthesis::new(Arc::clone(&model));
        let (mut sums, mut count) = ([[0.0; MAX_AXES]; 2], 0.0);
        for style in observed(&model, &set.test).iter().flat_map(|o| &o.styles) {
            let shown = synthesis.pose(style, Mode::default());
            let row = synthesis.row(style, AS_LEARNT);
            let mut said = model.space.pose(&row);
            said.root.y = PoseSpace::height(&row);
            for (sums, pose) in sums.iter_mut().zip([shown, said]) {
                let measured = synthesis.measured(&pose);
                (0..MAX_AXES).for_each(|j| sums[j] += (measured[j] - style[j]).abs());
            }
            count += 1.0;
        }
        let cells = sums.map(|sums| {
            let axes = set.axes.iter().zip(sums);
            axes.map(|(axis, sum)| format!("{:.2} {}", sum / count, axis.unit())).collect::<Vec<_>>().join(", ")
        });
        let _ = writeln!(text, "| {} | {} | *{}* |", set.plan.name, cells.join(" | "), set.plan.published_control);
    }
    text.push('\n');
    Ok(())
}

/// Writes the distance to the nearest recorded pose, by the distance of the style to the nearest recorded style.
pub(super) fn support(text: &mut String, sets: &[&DataSet]) -> Outcome {
    /// Number of sampled styles, and their greatest distance from the mean in standard deviations.
    const TRIED: usize = 1500;
    const WIDEST: f64 = 4.0;
    const BINS: [f64; 4] = [0.25, 0.5, 1.0, 2.0];
    text.push_str(
        "## Support\n\nThe table has the mean distance of a pose from the nearest recorded pose. The columns are the \
         distance of its style from the nearest recorded style, in standard deviations. The playground and the \
         command limit this distance to 0.5.\n\n\
         | data | < 0.25 | < 0.5 | < 1 | < 2 | more | 1st percentile of the support of recorded styles |\n\
         | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for set in sets {
        let model = Arc::new(set.model()?);
        let mut synthesis = Synthesis::new(Arc::clone(&model));
        let recorded: Vec<Row> = (0..model.rows.len()).map(|i| model.recorded_row(i)).collect();
        let mut random = random();
        let mut sums = [[0.0; 2]; BINS.len() + 1];
        for _ in 0..TRIED {
            let u: Style = std::array::from_fn(|j| {
                let any = random(1 << 20) as f64 / f64::from(1 << 20);
                if j < set.axes.len() { WIDEST * (2.0 * any - 1.0) } else { 0.0 }
            });
            let square = |v: &Style| -> f64 { u.iter().zip(v).map(|(u, v)| (u - v) * (u - v)).sum() };
            let distance = model.styles.iter().map(square).fold(f64::INFINITY, f64::min).sqrt();
            let row = synthesis.row(&model.in_units(&u), Mode::default());
            let bin = &mut sums[BINS.iter().position(|b| distance < *b).unwrap_or(BINS.len())];
            bin[0] += nearest(&model, &recorded, &row);
            bin[1] += 1.0;
        }
        let cells = sums.map(|[sum, count]| format!("{:.1}°", sum / count));
        let _ = writeln!(text, "| {} | {} | {:.1} |", set.plan.name, cells.join(" | "), model.least_support);
    }
    text.push_str("| *prototype: walk* | *1.7°* | *2.5°* | *5.0°* | *10.8°* | *19.5°* | *-2.8* |\n");
    text.push_str("| *prototype: punch* | *3.3°* | *4.3°* | *5.1°* | *7.9°* | *12.9°* | *-6.5* |\n\n");
    Ok(())
}

/// Returns the mean joint angle between a pose and the nearest recorded pose, by all numbers, degrees.
pub(super) fn nearest(model: &KeyStyleModel, recorded: &[Row], row: &Row) -> f64 {
    let square = |x: &Row| -> f64 { x.iter().zip(row).map(|(a, b)| (a - b) * (a - b)).sum() };
    let nearest = recorded.iter().map(|x| (square(x), x)).reduce(|a, b| if b.0 < a.0 { b } else { a });
    nearest.map_or(f64::NAN, |(_, x)| pose_error(&model.space, x, row)[0])
}

/// Writes training and synthesis times, and file sizes.
pub(super) fn cost(text: &mut String, sets: &[&DataSet]) -> Outcome {
    text.push_str(
        "## Cost\n\n| data | frames | training | per dragged pose | model file |\n| --- | ---: | ---: | ---: | ---: \
         |\n",
    );
    for set in sets {
        let all: Vec<&Recording> = set.training.iter().chain(&set.test).collect();
        let begin = Instant::now();
        let model = Arc::new(train(&all, &set.axes, Options::default()).map_err(TaskError::new)?);
        let secs = begin.elapsed().as_secs_f64();
        let bytes = strut_formats::key_style_model::write(&model, strut_formats::GENERATOR).len();
        let mut character = DragCharacter::new(Arc::clone(&model));
        let styles: Vec<Style> = model.styles.iter().map(|u| model.in_units(u)).collect();
        let begin = Instant::now();
        (0..POSES).for_each(|i| _ = character.drag(&styles[i % styles.len()], 1.0 / 60.0));
        let us = 1e6 * begin.elapsed().as_secs_f64() / POSES as f64;
        let _ = writeln!(
            text,
            "| {} | {} | {secs:.2} s | {us:.1} µs | {} kB |",
            set.plan.name,
            model.rows.len(),
            bytes.div_ceil(1000)
        );
    }
    text.push_str(
        "\nMeasured natively on one core, with all clips. The time of a dragged pose includes limits, spring, root \
         and feet.\n",
    );
    Ok(())
}

/// Returns the mean magnitude of third differences over runs of poses, thousandths of a radian.
pub(super) fn roughness<'a>(runs: impl Iterator<Item = &'a [Row]>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for run in runs {
        if let Some(difference) = third_difference(run) {
            let weight = (run.len() - 3) as f64;
            (sum, count) = (sum + weight * difference, count + weight);
        }
    }
    1000.0 * sum / count
}
