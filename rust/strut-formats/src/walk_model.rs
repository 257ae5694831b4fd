//! The file of a walk model, `.strutwalk`: a [safetensors](https://github.com/huggingface/safetensors) container.
//!
//! Tensors, little-endian f32; S styles, two sides (left, right), five states, D = 63 degrees of freedom (an exponential map
//! about its reference for every joint), three parts (pose, velocity and acceleration per frame):
//!
//! | Name | Shape | Content |
//! | --- | --- | --- |
//! | `reference` | 21, 4 | mean rotations x y z w; that of the hips without the heading |
//! | `means` | S, 2, 5, 3, D | means of every style's states |
//! | `durations` | S, 2, 5 | how many frames they last |
//! | `variances` | 2, 5, 3, D | what all styles share |
//! | `duration_variances` | 2, 5 | frames² |
//! | `range` | 2, D | least and greatest value in the recorded walks |
//!
//! The metadata entry `strut-walk` is a JSON object: `version`, `generator`, `rate_hz`, `skeleton` as in a database, `styles`
//! (their names) and `contexts`, the step of each of the two sides' models: models of other contexts, such as the first step
//! of a walk, may follow in a later version.

use crate::model_file::{self, ModelFileError, ModelKind, value};
use crate::strutdb::SkeletonInfo;
use serde::{Deserialize, Serialize};
use strut_core::hsmm::{DIMS, PerState, RATE_HZ, SIDES, STATES, StyleMeans, WalkModel, numbers};
use strut_core::humanoid::JOINTS;
use thiserror::Error;

/// What the file is.
pub const KIND: ModelKind = ModelKind { name: "walk model", entry: "strut-walk", version: "1.0", max_bytes: 64 << 20 };
/// Most styles of a model.
pub const MAX_STYLES: usize = 1000;
/// Most frames of a state.
const MAX_FRAMES: f32 = 1000.0;

const CONTEXTS: [&str; SIDES] = ["left", "right"];
const OBSERVATION: usize = 3 * DIMS;

/// Why bytes are no walk model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum WalkModelError {
    /// No such file, or a damaged one.
    #[error(transparent)]
    File(#[from] ModelFileError),
    /// Another body, rate, or set of contexts.
    #[error("the walk model's {0} differ from those of this Strut")]
    Layout(&'static str),
    /// No styles, or too many.
    #[error("the walk model has {0} styles; 1 to {MAX_STYLES} were expected")]
    Styles(usize),
}

#[derive(Serialize, Deserialize)]
struct Metadata {
    version: String,
    generator: String,
    rate_hz: f32,
    skeleton: SkeletonInfo,
    styles: Vec<String>,
    contexts: Vec<String>,
}

/// The file of a model; `generator` names the program and version that made it. Numbers are rounded to single precision.
///
/// # Panics
/// Never: names and shapes are those of this module.
pub fn write(model: &WalkModel, generator: &str) -> Vec<u8> {
    let metadata = Metadata {
        version: KIND.version.to_owned(),
        generator: generator.to_owned(),
        rate_hz: RATE_HZ,
        skeleton: SkeletonInfo::of(&model.proportions),
        styles: model.styles.clone(),
        contexts: CONTEXTS.map(str::to_owned).to_vec(),
    };
    let styles = model.means.len();
    let per_state = |of: &PerState<f64>| single(of.as_flattened());
    let tensors = vec![
        ("reference", vec![JOINTS, 4], model.reference.iter().flat_map(|q| q.to_array()).collect()),
        (
            "means",
            vec![styles, SIDES, STATES, 3, DIMS],
            model.means.iter().flat_map(|m| single(numbers(&m.means))).collect(),
        ),
        ("durations", vec![styles, SIDES, STATES], model.means.iter().flat_map(|m| per_state(&m.durations)).collect()),
        ("variances", vec![SIDES, STATES, 3, DIMS], single(numbers(&model.variances))),
        ("duration_variances", vec![SIDES, STATES], per_state(&model.duration_variances)),
        ("range", vec![2, DIMS], single(model.range.as_flattened())),
    ];
    model_file::write(KIND, &metadata, tensors)
}

/// Reads a file; trusts nothing.
///
/// # Errors
/// [`WalkModelError`] for anything but a walk model of this major version.
pub fn read(file: &[u8]) -> Result<WalkModel, WalkModelError> {
    let (metadata, tensors): (Metadata, _) = model_file::open(KIND, file)?;
    let proportions = metadata.skeleton.proportions().ok_or(WalkModelError::Layout("joints"))?;
    if metadata.rate_hz != RATE_HZ {
        return Err(WalkModelError::Layout("frames per second"));
    }
    if metadata.contexts != CONTEXTS {
        return Err(WalkModelError::Layout("contexts"));
    }
    let styles = metadata.styles.len();
    if !(1..=MAX_STYLES).contains(&styles) {
        return Err(WalkModelError::Styles(styles));
    }

    let means = tensors.numbers("means", &[styles, SIDES, STATES, 3, DIMS])?;
    let durations = tensors.positive("durations", &[styles, SIDES, STATES])?;
    if let Some(frames) = durations.iter().find(|frames| **frames > MAX_FRAMES) {
        return Err(value("durations", frames.to_string(), "at most 1000 frames").into());
    }
    let duration_variances = tensors.positive("duration_variances", &[SIDES, STATES])?;
    if let Some(variance) = duration_variances.iter().find(|variance| **variance > MAX_FRAMES * MAX_FRAMES) {
        return Err(value("duration_variances", variance.to_string(), "at most 1000000 frames²").into());
    }
    let range = tensors.numbers("range", &[2, DIMS])?;
    let (low, high) = range.split_at(DIMS);
    if let Some((low, high)) = low.iter().zip(high).find(|(low, high)| low > high) {
        return Err(value("range", format!("{low} to {high}"), "the least and the greatest of some numbers").into());
    }
    Ok(WalkModel {
        proportions,
        reference: tensors.rotations("reference")?,
        variances: Box::new(observations(&tensors.positive("variances", &[SIDES, STATES, 3, DIMS])?)),
        duration_variances: per_state(&duration_variances),
        range: std::array::from_fn(|end| std::array::from_fn(|d| range[end * DIMS + d].into())),
        styles: metadata.styles,
        means: means
            .chunks_exact(SIDES * STATES * OBSERVATION)
            .zip(durations.chunks_exact(SIDES * STATES))
            .map(|(means, durations)| StyleMeans {
                means: Box::new(observations(means)),
                durations: per_state(durations),
            })
            .collect(),
    })
}

/// In single precision.
fn single(values: &[f64]) -> Vec<f32> {
    values.iter().map(|v| *v as f32).collect()
}

fn observations(values: &[f32]) -> [[[[f64; DIMS]; 3]; STATES]; SIDES] {
    let at = |side, state, part, d| f64::from(values[((side * STATES + state) * 3 + part) * DIMS + d]);
    std::array::from_fn(|side| {
        std::array::from_fn(|state| std::array::from_fn(|part| std::array::from_fn(|d| at(side, state, part, d))))
    })
}

fn per_state(values: &[f32]) -> [[f64; STATES]; SIDES] {
    std::array::from_fn(|side| std::array::from_fn(|state| values[side * STATES + state].into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::sync::Arc;
    use strut_core::hsmm::{WalkVoices, Walker};
    use strut_core::humanoid::Proportions;
    use strut_core::math::Quat;

    fn model() -> WalkModel {
        let means = |value: f64| StyleMeans {
            means: Box::new([[[[value; DIMS]; 3]; STATES]; SIDES]),
            durations: [[3.0; STATES]; SIDES],
        };
        WalkModel {
            proportions: Proportions::default(),
            reference: [Quat::IDENTITY; JOINTS],
            variances: Box::new([[[[0.25; DIMS]; 3]; STATES]; SIDES]),
            duration_variances: [[0.5; STATES]; SIDES],
            range: [[-1.0; DIMS], [1.5; DIMS]],
            styles: vec!["proud \"<b>".into(), "悲しい".into()],
            means: vec![means(0.5), means(-0.125)],
        }
    }

    #[test]
    fn a_model_comes_back() {
        let bytes = write(&model(), "test");
        let back = read(&bytes).unwrap();
        assert_eq!(back.means, model().means);
        assert_eq!(back.styles, model().styles);
        assert_eq!(write(&back, "test"), bytes);
    }

    #[test]
    fn what_is_no_model_is_refused_with_a_reason() {
        let bytes = write(&model(), "test");
        let refused = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(refused(&bytes[..bytes.len() - 7]).contains("cut short"));
        assert!(refused(b"HIERARCHY\nROOT Hips\n").contains("no walk model"));
        let mut other = model();
        other.variances[0][0][0][0] = 0.0;
        assert!(refused(&write(&other, "test")).contains("'variances' holds 0; a positive number"));
        other = model();
        other.means[1].means[0][0][0][0] = f64::NAN;
        assert!(refused(&write(&other, "test")).contains("'means' holds NaN"));
        other = model();
        other.means[0].durations[1][4] = 1e38;
        assert!(refused(&write(&other, "test")).contains("'durations' holds 1"));
        other = model();
        other.range[0][7] = 2.0;
        assert!(refused(&write(&other, "test")).contains("'range' holds 2 to 1.5"));
        other = model();
        (other.styles, other.means) = (Vec::new(), Vec::new());
        assert_eq!(read(&write(&other, "test")), Err(WalkModelError::Styles(0)));
    }

    proptest! {
        #[test]
        fn changed_bytes_never_panic(at: usize, value: u8, cut in 0usize..100) {
            let mut bytes = write(&model(), "test");
            let at = at % bytes.len();
            bytes[at] = value;
            bytes.truncate(bytes.len() - cut);
            let _ = read(&bytes);
        }

        #[test]
        fn whatever_is_read_can_be_walked(at: usize, value: u8) {
            let mut bytes = write(&model(), "test");
            let at = at % bytes.len();
            bytes[at] = value;
            if let Ok(model) = read(&bytes) {
                let mut walker = Walker::new(Arc::new(WalkVoices::new(&model)));
                walker.set_styles(&vec![-5.0; model.styles.len()]).unwrap();
                for _ in 0..40 {
                    walker.advance();
                }
            }
        }
    }
}
