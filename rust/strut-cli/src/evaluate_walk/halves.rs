//! Prediction of the second half of a take from its first half.

use std::fmt::Write;
use strut_core::hsmm::{LabelledClip, Options, Side, Track, TrainError, WalkModel, steps_of, train};
use strut_core::humanoid::Proportions;
use strut_evaluation::walk::Reconstruction;
use strut_tasks::threads::ThreadPool;
use strut_tasks::walks::Walk;

/// Writes how well a model of the first half of every take predicts the second half.
pub(super) fn write(
    text: &mut String,
    name: &str,
    (body, others): (&Proportions, &[LabelledClip<'_>]),
    takes: &[Walk],
) -> Result<(), TrainError> {
    let halves: Vec<(String, [Track; 2])> = takes.iter().map(|w| (name_of(w), w.track.halves())).collect();
    // One style per take, for takes with steps of both feet in the first half.
    let has_both = |track: &Track| {
        let steps = steps_of(track);
        [Side::Left, Side::Right].iter().all(|side| steps.iter().any(|step| step.side == *side))
    };
    if halves.iter().all(|(_, [first, _])| !has_both(first)) {
        let _ = writeln!(text, "## Half a take\n\nNo first half of {name} has steps of both feet.\n");
        return Ok(());
    }
    let usable: Vec<_> = halves.iter().filter(|(_, [first, _])| has_both(first)).collect();
    let first_halves = usable.iter().map(|(style, [first, _])| LabelledClip { style, track: first });
    let clips: Vec<LabelledClip> = others.iter().copied().chain(first_halves).collect();
    let _ = writeln!(
        text,
        "## Half a take\n\nEach of {} takes of {name} becomes a separate style, in addition to the styles above. The \
         first half of the take is used for training, the second half is predicted. Errors are means over all frames; \
         means over the takes are in brackets.\n\n\
         | means | rotations | positions | amplitude | step length |\n| --- | ---: | ---: | ---: | ---: |",
        usable.len()
    );
    for (name, refined) in [("adapted", false), ("refined", true)] {
        let model = train(body, &clips, Options { refined }, &ThreadPool)?;
        let (mut all, mut each) = (Reconstruction::default(), Vec::new());
        for (style, [_, second]) in &usable {
            if let Some(style) = model.styles.iter().position(|s| s == style) {
                let mut take = Reconstruction::default();
                take.add(&model, style, second);
                each.push(take);
                all.add(&model, style, second);
            }
        }
        let mean = |of: fn(&Reconstruction) -> f64| each.iter().map(of).sum::<f64>() / each.len() as f64;
        let _ = writeln!(
            text,
            "| {name} | {:.2}° ({:.2}°) | {:.2} cm ({:.2} cm) | {:.3} | {:.3} |",
            all.degrees(),
            mean(Reconstruction::degrees),
            all.centimetres(),
            mean(Reconstruction::centimetres),
            all.amplitude(),
            all.step_length()
        );
    }
    text.push('\n');
    Ok(())
}

/// Trains a model on some clips and on every style's first take, which becomes a separate style.
pub(super) fn with_first_takes(
    (body, clips): (&Proportions, &[LabelledClip<'_>]),
    takes: &[Walk],
) -> Result<WalkModel, TrainError> {
    let is_first = |walk: &&Walk| takes.iter().all(|other| other.style != walk.style || other.take >= walk.take);
    let first: Vec<(String, &Track)> = takes.iter().filter(is_first).map(|w| (name_of(w), &w.track)).collect();
    let first = first.iter().map(|(style, track)| LabelledClip { style, track });
    let all: Vec<LabelledClip> = clips.iter().copied().chain(first).collect();
    train(body, &all, Options { refined: true }, &ThreadPool)
}

/// Returns the name of a take that is a separate style.
fn name_of(walk: &Walk) -> String {
    format!("{} {}", walk.style, walk.take)
}
