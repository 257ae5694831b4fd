//! Key-style models: poses as a function of a few style variables.

use crate::error::{Outcome, TaskError};
use crate::progress::{OnProgress, Progress};
use crate::suggestion::unknown;
use strut_core::humanoid::Role;
use strut_core::incremental::IncrementalJob;
use strut_core::parallel::Sequential;
use strut_core::somn::{Fault, KeyStyleModel, Measure, Options, Recording, Trainer};
use strut_formats::quotation;

/// Greatest number of characters of a list in a message.
const SHOWN: usize = 200;

/// Parses a list of style variables, for example `hips_height,hand_l.y - shoulder_l.y`.
///
/// # Errors
/// A message about the position of the error.
pub fn parse_axes(text: &str) -> Outcome<Vec<Measure>> {
    Measure::parse_list(text).map_err(|error| {
        let mut sentence = error.to_string();
        if let Fault::Unknown(name) = &error.fault {
            let names: Vec<&str> =
                Measure::NAMED.iter().map(|m| m.name).chain(Role::ALL.iter().map(|role| role.name())).collect();
            sentence = format!("column {}: {}", error.column, unknown("joint, measure or function", name, &names));
        }
        TaskError::new(format_args!("--axes '{}', {sentence}", quotation(text, SHOWN)))
    })
}

/// Trains a model.
///
/// # Errors
/// If the recordings are not sufficient, or the caller cancels.
pub fn train_key_styles(
    recordings: &[Recording],
    axes: &[Measure],
    options: Options,
    on_progress: &OnProgress<'_>,
) -> Outcome<KeyStyleModel> {
    let of: Vec<&Recording> = recordings.iter().collect();
    let mut trainer = Trainer::new(&of, axes, options).map_err(TaskError::new)?;
    while let Ok(Some(p)) = trainer.step(&Sequential) {
        if on_progress(Progress { what: "learning", done: p.done, total: p.total }).is_break() {
            return Err(TaskError::cancelled());
        }
    }
    let Ok(model) = trainer.conclude(&Sequential);
    Ok(model)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        let long = "hips_height,".repeat(5000);
        let refused = parse_axes(&long).unwrap_err().to_string();
        assert!(refused.chars().count() < 500, "{} characters", refused.chars().count());
    }
}
