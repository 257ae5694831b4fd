//! Robustness of styles to attenuation, exaggeration and negation.

use super::mixture::{STEPS, weights};
use std::fmt::Write;
use std::sync::Arc;
use strut_core::hsmm::{RuntimeWalkModel, WalkModel, WeightsError};
use strut_evaluation::walk::{ExtrapolationReport, GaitStatistics, extrapolation, strengths};

/// Measured intensities.
const INTENSITIES: [f32; 9] = [-3.0, -2.0, -1.0, 0.0, 1.0, 1.5, 2.0, 2.5, 3.0];
/// Intensities over which the gait's statistics should be monotonic, in steps of [`MONOTONE_STEP`].
const MONOTONE: std::ops::RangeInclusive<i16> = -4..=8;
const MONOTONE_STEP: f32 = 0.25;

/// Text above the tables.
pub(super) const INTRODUCTION: &str = "## Intensity\n\nThe first table counts the styles that fail at an intensity. A style fails if over 1 % of the \
     joint angles are more than 10° outside the recorded range. It also fails if a knee is overextended by more than \
     8°, or if the wrong foot supports the body for over 15 % of the time. *Limited* is measured with the soft limits \
     of joints and durations, *free* without them. Without limits, a state that lasts less than half a frame is also \
     a failure.\n\nThe other tables are for intensities from -1 to 2 in steps of 0.25. *Increments* is the share of \
     increments in the same direction as the total change. *Styles* counts the styles of which all increments are in \
     this direction. *Greatest step back* is the greatest increment in the opposite direction, as a share of the \
     total change of the style that changes most. The *style itself* is the position of its mean poses between the \
     average walk and the style.\n\n";

/// Writes the tables of a model.
pub(super) fn write(text: &mut String, model: &WalkModel, runtime: &Arc<RuntimeWalkModel>) -> Result<(), WeightsError> {
    failures(text, model, runtime)?;
    monotony(text, model, runtime)
}

fn failures(text: &mut String, model: &WalkModel, runtime: &Arc<RuntimeWalkModel>) -> Result<(), WeightsError> {
    let styles = model.styles.len();
    let row = |first: &str, cells: [String; INTENSITIES.len()]| format!("| {first} | {} |\n", cells.join(" | "));
    text.push_str(&row("", INTENSITIES.map(|at| at.to_string())));
    text.push_str(&row("---", INTENSITIES.map(|_| "---:".into())));
    for (name, limits) in [("free", false), ("limited", true)] {
        let all = INTENSITIES
            .iter()
            .map(|at| (0..styles).map(|s| extrapolation(model, runtime, s, *at, limits)).collect::<Result<Vec<_>, _>>())
            .collect::<Result<Vec<_>, _>>()?;
        let each = |f: fn(&[ExtrapolationReport]) -> String| std::array::from_fn(|i| f(&all[i]));
        text.push_str(&row(&format!("fail, {name}"), each(|b| b.iter().filter(|b| b.fails).count().to_string())));
        let worst =
            |b: &[ExtrapolationReport]| format!("{:.0}°", b.iter().map(|b| b.knee).fold(f64::INFINITY, f64::min));
        text.push_str(&row(&format!("worst knee, {name}"), each(worst)));
    }
    text.push('\n');
    Ok(())
}

fn monotony(text: &mut String, model: &WalkModel, runtime: &Arc<RuntimeWalkModel>) -> Result<(), WeightsError> {
    let intensities: Vec<f32> = MONOTONE.map(|i| f32::from(i) * MONOTONE_STEP).collect();
    let styles = 0..model.styles.len();
    let own = styles.clone().map(|style| strengths(model, runtime, style, &intensities, STEPS));
    let mut measures: Vec<(&str, Vec<Vec<f64>>)> = vec![("style itself", own.collect::<Result<_, _>>()?)];
    for style in styles {
        let manner = |at: &f32| GaitStatistics::of(model, runtime, &weights(model, &[(style, *at)]), STEPS);
        let manners: Vec<GaitStatistics> = intensities.iter().map(manner).collect::<Result<_, _>>()?;
        for (i, (name, _)) in manners[0].named().into_iter().enumerate() {
            if measures.iter().all(|(other, _)| *other != name) {
                measures.push((name, Vec::new()));
            }
            measures[i + 1].1.push(manners.iter().map(|m| m.named()[i].1).collect());
        }
    }
    text.push_str("| | increments | styles | greatest step back |\n");
    text.push_str("| --- | ---: | ---: | ---: |\n");
    for (name, ways) in &measures {
        let change = |way: &[f64]| way[way.len() - 1] - way[0];
        let most = ways.iter().map(|way| change(way).abs()).fold(f64::MIN_POSITIVE, f64::max);
        let (mut right, mut of, mut whole, mut back) = (0, 0, 0, 0.0_f64);
        for way in ways {
            let steps_back: Vec<f64> = way.windows(2).map(|w| (w[0] - w[1]) * change(way).signum()).collect();
            let worst = steps_back.iter().copied().fold(0.0, f64::max);
            right += steps_back.iter().filter(|back| **back <= 0.0).count();
            (of, whole) = (of + steps_back.len(), whole + usize::from(worst <= 0.0));
            back = back.max(worst / most);
        }
        let _ = writeln!(
            text,
            "| {name} | {:.1} % | {whole} of {} | {:.1} % |",
            100.0 * right as f64 / of as f64,
            ways.len(),
            100.0 * back
        );
    }
    text.push('\n');
    Ok(())
}
