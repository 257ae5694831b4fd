//! Keys compared with recorded motion, and a walk with a style that moves in a circle (`docs/methods/somn.md` §8 and
//! §10).

use super::data::DataSet;
use super::tables::{AS_LEARNT, nearest, observed, roughness};
use std::f64::consts::TAU;
use std::fmt::Write;
use std::sync::Arc;
use strut_core::contact::label;
use strut_core::humanoid::HumanoidMotion;
use strut_core::math::float_funcs::double;
use strut_core::metrics::foot_skate;
use strut_core::somn::{DragCharacter, Interpolation, Key, KeyStyling, Method, Mode, RATE_HZ, Row, Style, Synthesis};
use strut_evaluation::key_style::{Observed, pose_error};
use strut_tasks::Outcome;

/// Distances between keys, frames.
const EVERY: [usize; 6] = [4, 8, 10, 12, 15, 20];
const EVERY_IN_BLOCKS: [usize; 3] = [4, 6, 18];
/// The circle: its radius in standard deviations, frames per turn, and turns.
const RADIUS: f64 = 1.35;
const TURN: usize = 35;
const TURNS: usize = 10;

/// Errors of the prototype: key-framing, key-styling monotone and Catmull-Rom, hybrid.
const PUBLISHED: [(&str, usize, [&str; 4]); 8] = [
    ("walk", 4, ["0.92° / 0.29 cm / 4.1", "2.50° / 1.29 cm / 8.7", "2.46° / 1.26 cm / 8.4", "0.72° / 0.31 cm / 8.7"]),
    ("walk", 8, ["2.91° / 1.44 cm / 1.3", "3.52° / 1.99 cm / 11.0", "3.25° / 1.80 cm / 9.5", "2.09° / 1.12 cm / 9.5"]),
    ("walk", 10, ["3.81° / 2.19 cm / 0.9", "3.74° / 2.32 cm / 11.0", "3.46° / 2.05 cm / 9.5", "2.50° / 1.49 cm / 9.5"]),
    (
        "walk",
        12,
        ["4.64° / 2.88 cm / 0.6", "4.40° / 3.07 cm / 12.4", "3.98° / 2.60 cm / 11.2", "3.19° / 2.16 cm / 11.2"],
    ),
    (
        "walk",
        15,
        ["5.75° / 4.18 cm / 0.4", "5.61° / 4.39 cm / 16.3", "5.29° / 4.07 cm / 14.1", "4.68° / 3.73 cm / 14.1"],
    ),
    ("walk", 20, ["7.80° / 6.55 cm / 0.1", "8.02° / 6.72 cm / 8.0", "8.41° / 7.08 cm / 6.5", "8.06° / 6.89 cm / 6.5"]),
    ("punch", 6, ["3.09° / 1.09 cm / 2.2", "", "6.01° / 2.91 cm / 10.9", "3.22° / 1.23 cm / 11.1"]),
    ("punch", 18, ["7.28° / 3.41 cm / 0.0", "", "7.89° / 3.95 cm / 5.3", "7.19° / 3.39 cm / 5.3"]),
];

/// Writes errors and dynamics by the distance of the keys.
pub(super) fn against_key_frames(text: &mut String, sets: &[&DataSet]) -> Outcome {
    text.push_str(
        "## Keys\n\nA key is taken from held-out motion every *n* frames, and the motion between the keys is compared \
         with the recording. The columns have the error, and the mean third difference of the joints in thousandths \
         of a radian: if it is small, the motion seems to float. A key frame is a whole pose (64 numbers), a key \
         style two or three numbers. Curves are Catmull-Rom splines, except in *monotone*. Regions are not blurred, \
         because blur makes a motion float. *As trained* is the mixture at temperature 1.\n\n\
         | data | n | key frames | key styles | key styles, monotone | key styles, as trained | hybrid | hybrid, as trained |\n\
         | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
    );
    for set in sets {
        let model = Arc::new(set.model()?);
        let mut synthesis = Synthesis::new(Arc::clone(&model));
        let test = observed(&model, &set.test);
        let every = if set.plan.name == "walk" { &EVERY[..] } else { &EVERY_IN_BLOCKS[..] };
        for &n in every {
            let (curve, smooth) = (Interpolation::CatmullRom, Mode::KEYED);
            let ways = [
                (Method::KeyFrame, curve, smooth),
                (Method::KeyStyle, curve, smooth),
                (Method::KeyStyle, Interpolation::Monotone, smooth),
                (Method::KeyStyle, curve, AS_LEARNT),
                (Method::Hybrid, curve, smooth),
                (Method::Hybrid, curve, AS_LEARNT),
            ];
            let cells = ways.map(|way| {
                let runs: Vec<(Vec<Row>, &[Row])> =
                    test.iter().filter_map(|of| Some((made(of, n, way, &mut synthesis)?, &of.rows[..]))).collect();
                let (mut sums, mut count) = ([0.0; 2], 0.0);
                for (made, recorded) in runs.iter().flat_map(|(made, recorded)| made.iter().zip(*recorded)) {
                    let error = pose_error(&model.space, made, recorded);
                    (0..2).for_each(|i| sums[i] += error[i]);
                    count += 1.0;
                }
                let rough = roughness(runs.iter().map(|(made, _)| &made[..]));
                format!("{:.2}° / {:.2} cm / {rough:.1}", sums[0] / count, sums[1] / count)
            });
            let _ = writeln!(text, "| {} | {n} | {} |", set.plan.name, cells.join(" | "));
        }
        let recorded = roughness(test.iter().map(|of| &of.rows[..]));
        let _ = writeln!(text, "| {} | recorded | / / {recorded:.1} | | | | | |", set.plan.name);
    }
    for (data, n, [frames, monotone, styles, hybrid]) in PUBLISHED {
        let monotone = if monotone.is_empty() { String::new() } else { format!("*{monotone}*") };
        let _ =
            writeln!(text, "| *prototype: {data}* | *{n}* | *{frames}* | | {monotone} | *{styles}* | | *{hybrid}* |");
    }
    text.push('\n');
    Ok(())
}

/// Returns the poses between the keys of a run, or `None` for fewer than two keys.
fn made(
    of: &Observed,
    n: usize,
    (method, interpolation, mode): (Method, Interpolation, Mode),
    synthesis: &mut Synthesis,
) -> Option<Vec<Row>> {
    let last = (of.rows.len() - 1) / n * n;
    let key = |t: usize| Key { secs: t as f64, style: of.styles[t], row: Some(of.rows[t]) };
    let keys: Vec<Key> = (0..=last).step_by(n).map(key).collect();
    let styling = (keys.len() > 1).then(|| KeyStyling::new(&keys, interpolation, synthesis, mode).ok())??;
    Some((0..=last).map(|t| styling.row(synthesis, t as f64, method)).collect())
}

/// Writes a walk that is made by moving the style in a circle.
pub(super) fn circle(text: &mut String, set: &DataSet) -> Outcome {
    let model = Arc::new(set.model()?);
    let style = |frame: usize| -> Style {
        let angle = -TAU * frame as f64 / TURN as f64;
        model.in_units(&[RADIUS * double::cos(angle), RADIUS * double::sin(angle), 0.0])
    };
    let recorded: Vec<Row> = (0..model.rows.len()).map(|i| model.recorded_row(i)).collect();
    let mut synthesis = Synthesis::new(Arc::clone(&model));
    let rows: Vec<Row> = (0..TURN).map(|frame| synthesis.row(&style(frame), Mode::default())).collect();
    let distances: Vec<f64> = rows.iter().map(|row| nearest(&model, &recorded, row)).collect();
    let (mean, worst) =
        (distances.iter().sum::<f64>() / distances.len() as f64, distances.iter().copied().fold(0.0, f64::max));
    let held_out = observed(&model, &set.test);
    let real: Vec<f64> = held_out.iter().flat_map(|o| &o.rows).map(|row| nearest(&model, &recorded, row)).collect();

    let mut character = DragCharacter::new(Arc::clone(&model));
    character.reset(&style(0));
    let mut poses = Vec::new();
    for frame in 0..TURN * TURNS {
        poses.push(*character.drag(&style(frame), 1.0 / f64::from(RATE_HZ)));
    }
    let motion = HumanoidMotion { proportions: model.space.proportions, rate_hz: RATE_HZ, poses };
    let planted = label(&motion);
    let way = motion.poses[motion.poses.len() - 1].root.z - motion.poses[TURN].root.z;
    let per_turn = way / (TURNS - 1) as f32;
    let _ = writeln!(
        text,
        "## A walk from a circle\n\nThe style moves around a circle with a radius of {RADIUS} standard deviations \
         about the mean style of the walk, {TURN} frames per turn. The poses are {mean:.1}° from the nearest recorded \
         pose on average, and {worst:.1}° at most. Held-out recorded poses are {:.1}° from the nearest recorded pose. \
         *The prototype: 1.9°, 3.9° and 2.35°.* The body travels {per_turn:.2} m per turn, and planted feet slide at \
         {:.1} cm/s.\n",
        real.iter().sum::<f64>() / real.len() as f64,
        100.0 * foot_skate(&motion, &planted)
    );
    Ok(())
}
