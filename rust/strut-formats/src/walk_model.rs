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

use crate::strutdb::SkeletonInfo;
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use serde::{Deserialize, Serialize};
use strut_core::hsmm::{DIMS, PerState, RATE_HZ, SIDES, STATES, StyleMeans, WalkModel, numbers};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use thiserror::Error;

/// Most bytes a file may have.
pub const MAX_BYTES: usize = 64 << 20;
/// Most styles of a model.
pub const MAX_STYLES: usize = 1000;
/// Version that is written, and whose major part is read.
pub const VERSION: &str = "1.0";

const METADATA: &str = "strut-walk";
const CONTEXTS: [&str; SIDES] = ["left", "right"];
const OBSERVATION: usize = 3 * DIMS;

/// Why bytes are no walk model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum WalkModelError {
    /// Above [`MAX_BYTES`].
    #[error("the file has {0} bytes; a walk model has at most {MAX_BYTES}")]
    TooManyBytes(usize),
    /// No safetensors file, or a damaged one.
    #[error("this is no walk model, or it is cut short: {0}")]
    NotSafetensors(String),
    /// A safetensors file of another kind.
    #[error("this safetensors file is no walk model: it has no '{METADATA}' metadata")]
    NoMetadata,
    /// The metadata are no JSON of the expected form.
    #[error("the walk model's metadata cannot be read: {0}")]
    Metadata(String),
    /// Another major version.
    #[error("the walk model has version {0}; this Strut reads version {VERSION}")]
    Version(String),
    /// Another body, rate, or set of contexts.
    #[error("the walk model's {0} differ from those of this Strut")]
    Layout(&'static str),
    /// No styles, or too many.
    #[error("the walk model has {0} styles; 1 to {MAX_STYLES} were expected")]
    Styles(usize),
    /// A tensor is absent, or has another type or shape.
    #[error("tensor '{name}' is {found}; f32 {expected:?} was expected")]
    Tensor { name: &'static str, found: String, expected: Vec<usize> },
    /// A number that cannot be.
    #[error("tensor '{name}' holds {value}; {expected} was expected")]
    Value { name: &'static str, value: String, expected: &'static str },
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
        version: VERSION.to_owned(),
        generator: generator.to_owned(),
        rate_hz: RATE_HZ,
        skeleton: SkeletonInfo::of(&model.proportions),
        styles: model.styles.clone(),
        contexts: CONTEXTS.map(str::to_owned).to_vec(),
    };
    let styles = model.means.len();
    let per_state = |of: &PerState<f64>| of.as_flattened().to_vec();
    let tensors: [(&str, Vec<usize>, Vec<f64>); 6] = [
        ("reference", vec![JOINTS, 4], model.reference.iter().flat_map(|q| q.to_array()).map(f64::from).collect()),
        (
            "means",
            vec![styles, SIDES, STATES, 3, DIMS],
            model.means.iter().flat_map(|m| numbers(&m.means)).copied().collect(),
        ),
        ("durations", vec![styles, SIDES, STATES], model.means.iter().flat_map(|m| per_state(&m.durations)).collect()),
        ("variances", vec![SIDES, STATES, 3, DIMS], numbers(&model.variances).to_vec()),
        ("duration_variances", vec![SIDES, STATES], per_state(&model.duration_variances)),
        ("range", vec![2, DIMS], model.range.as_flattened().to_vec()),
    ];
    let bytes: Vec<(&str, Vec<usize>, Vec<u8>)> = tensors
        .into_iter()
        .map(|(name, shape, values)| (name, shape, values.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect()))
        .collect();
    let views = bytes.iter().map(|(name, shape, bytes)| {
        (*name, TensorView::new(Dtype::F32, shape.clone(), bytes).expect("as many bytes as the shape says"))
    });
    let json = serde_json::to_string(&metadata).expect("strings and numbers are JSON");
    let metadata = std::iter::once((METADATA.to_owned(), json)).collect();
    safetensors::serialize(views, Some(metadata)).expect("tensors have distinct names")
}

/// Reads a file; trusts nothing.
///
/// # Errors
/// [`WalkModelError`] for anything but a walk model of this major version.
pub fn read(file: &[u8]) -> Result<WalkModel, WalkModelError> {
    if file.len() > MAX_BYTES {
        return Err(WalkModelError::TooManyBytes(file.len()));
    }
    let bad = |e: safetensors::SafeTensorError| WalkModelError::NotSafetensors(e.to_string());
    let (_, header) = SafeTensors::read_metadata(file).map_err(bad)?;
    let json = header.metadata().as_ref().and_then(|m| m.get(METADATA)).ok_or(WalkModelError::NoMetadata)?;
    let metadata: Metadata = serde_json::from_str(json).map_err(|e| WalkModelError::Metadata(e.to_string()))?;
    let major = |v: &str| v.split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major(&metadata.version) != major(VERSION) {
        return Err(WalkModelError::Version(metadata.version.chars().take(20).collect()));
    }
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

    let tensors = SafeTensors::deserialize(file).map_err(bad)?;
    let tensor = |name: &'static str, expected: &[usize]| values_of(&tensors, name, expected);
    let reference = tensor("reference", &[JOINTS, 4])?;
    let means = tensor("means", &[styles, SIDES, STATES, 3, DIMS])?;
    let durations = positive("durations", tensor("durations", &[styles, SIDES, STATES])?)?;
    let variances = positive("variances", tensor("variances", &[SIDES, STATES, 3, DIMS])?)?;
    let duration_variances = positive("duration_variances", tensor("duration_variances", &[SIDES, STATES])?)?;
    let range = tensor("range", &[2, DIMS])?;

    let rotations: Vec<Quat> = reference
        .chunks_exact(4)
        .map(|q| Quat::from_xyzw(q[0] as f32, q[1] as f32, q[2] as f32, q[3] as f32))
        .collect();
    if let Some(q) = rotations.iter().find(|q| (q.dot(**q) - 1.0).abs() > 1e-3) {
        let value = format!("{:?}", q.to_array());
        return Err(WalkModelError::Value { name: "reference", value, expected: "a unit quaternion" });
    }
    Ok(WalkModel {
        proportions,
        reference: std::array::from_fn(|j| rotations[j].normalized()),
        variances: Box::new(observations(&variances)),
        duration_variances: per_state(&duration_variances),
        range: std::array::from_fn(|end| std::array::from_fn(|d| range[end * DIMS + d])),
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

/// The finite numbers of a tensor of this shape.
fn values_of(tensors: &SafeTensors<'_>, name: &'static str, expected: &[usize]) -> Result<Vec<f64>, WalkModelError> {
    let wrong = |found: String| WalkModelError::Tensor { name, found, expected: expected.to_vec() };
    let tensor = tensors.tensor(name).map_err(|_| wrong("absent".to_owned()))?;
    if tensor.dtype() != Dtype::F32 || tensor.shape() != expected {
        return Err(wrong(format!("{:?} {:?}", tensor.dtype(), tensor.shape())));
    }
    let values: Vec<f64> =
        tensor.data().chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]).into()).collect();
    match values.iter().find(|v| !v.is_finite()) {
        Some(v) => Err(WalkModelError::Value { name, value: v.to_string(), expected: "a finite number" }),
        None => Ok(values),
    }
}

fn positive(name: &'static str, values: Vec<f64>) -> Result<Vec<f64>, WalkModelError> {
    match values.iter().find(|v| **v <= 0.0) {
        Some(v) => Err(WalkModelError::Value { name, value: v.to_string(), expected: "a positive number" }),
        None => Ok(values),
    }
}

fn observations(values: &[f64]) -> [[[[f64; DIMS]; 3]; STATES]; SIDES] {
    let at = |side, state, part, d| values[((side * STATES + state) * 3 + part) * DIMS + d];
    std::array::from_fn(|side| {
        std::array::from_fn(|state| std::array::from_fn(|part| std::array::from_fn(|d| at(side, state, part, d))))
    })
}

fn per_state(values: &[f64]) -> [[f64; STATES]; SIDES] {
    std::array::from_fn(|side| std::array::from_fn(|state| values[side * STATES + state]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use strut_core::humanoid::Proportions;

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
        (other.styles, other.means) = (Vec::new(), Vec::new());
        assert_eq!(read(&write(&other, "test")), Err(WalkModelError::Styles(0)));
    }

    proptest! {
        #[test]
        fn changed_bytes_never_panic(at in 0usize..3000, value: u8, cut in 0usize..100) {
            let mut bytes = write(&model(), "test");
            bytes[at] = value;
            bytes.truncate(bytes.len() - cut);
            let _ = read(&bytes);
        }
    }
}
