//! The file of a key-style model, `.strutkeys`: a [safetensors](https://github.com/huggingface/safetensors) container.
//!
//! Tensors, little-endian f32; A axes (1 to 3), K components, N recorded frames, D = 64 numbers of a pose (an exponential map
//! about its reference for every joint, then (height of the hips − 0.9 m) / 0.8 m):
//!
//! | Name | Shape | Content |
//! | --- | --- | --- |
//! | `reference` | 21, 4 | mean rotations x y z w; that of the hips without the facing direction |
//! | `style_mean`, `style_deviation` | A | of the recorded styles, in the axes' units; all else is standardised by them |
//! | `slopes` | K, A, D | a pose's change with a style |
//! | `means` | K, D | the pose of the mean style |
//! | `weights` | K | shares of the components |
//! | `centres`, `spreads` | K, A; K, A, A | mean and covariance of the styles that each knows |
//! | `styles` | N, A | the recorded styles |
//! | `poses` | N, D | the recorded poses |
//!
//! The metadata entry `strut-keys` is a JSON object: `version`, `generator`, `rate_hz`, `skeleton` as in a database, `axes`
//! (name or expression, and unit), `variance`, `least_support`, `travels`, and `clips` with their names and frames.

use crate::strutdb::SkeletonInfo;
use safetensors::SafeTensors;
use safetensors::tensor::{Dtype, TensorView};
use serde::{Deserialize, Serialize};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use strut_core::somn::{
    ClipSpan, Component, DIMS, KeyStyleModel, MAX_AXES, MAX_COMPONENTS, Measure, PoseSpace, RATE_HZ, Style,
};
use thiserror::Error;

/// Most bytes a file may have.
pub const MAX_BYTES: usize = 256 << 20;
/// Version that is written, and whose major part is read.
pub const VERSION: &str = "1.0";

const METADATA: &str = "strut-keys";

/// Why bytes are no key-style model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum KeyStyleModelError {
    /// Above [`MAX_BYTES`].
    #[error("the file has {0} bytes; a key-style model has at most {MAX_BYTES}")]
    TooManyBytes(usize),
    /// No safetensors file, or a damaged one.
    #[error("this is no key-style model, or it is cut short: {0}")]
    NotSafetensors(String),
    /// A safetensors file of another kind.
    #[error("this safetensors file is no key-style model: it has no '{METADATA}' metadata")]
    NoMetadata,
    /// The metadata are no JSON of the expected form.
    #[error("the key-style model's metadata cannot be read: {0}")]
    Metadata(String),
    /// Another major version.
    #[error("the key-style model has version {0}; this Strut reads version {VERSION}")]
    Version(String),
    /// Another body or rate.
    #[error("the key-style model's {0} differ from those of this Strut")]
    Layout(&'static str),
    /// Too few or too many of something.
    #[error("the key-style model has {found} {what}; {least} to {most} were expected")]
    Count { what: &'static str, found: usize, least: usize, most: usize },
    /// An axis that cannot be measured.
    #[error("the key-style model's axis '{axis}' cannot be measured: {reason}")]
    Axis { axis: String, reason: String },
    /// A tensor is absent, or has another type or shape.
    #[error("tensor '{name}' is {found}; f32 {expected:?} was expected")]
    Tensor { name: &'static str, found: String, expected: Vec<usize> },
    /// A number that cannot be.
    #[error("'{name}' holds {value}; {expected} was expected")]
    Value { name: &'static str, value: String, expected: &'static str },
}

#[derive(Serialize, Deserialize)]
struct Metadata {
    version: String,
    generator: String,
    rate_hz: f32,
    skeleton: SkeletonInfo,
    axes: Vec<AxisInfo>,
    variance: f64,
    least_support: f64,
    travels: bool,
    clips: Vec<ClipInfo>,
}

#[derive(Serialize, Deserialize)]
struct AxisInfo {
    measure: String,
    unit: String,
}

#[derive(Serialize, Deserialize)]
struct ClipInfo {
    name: String,
    frames: usize,
}

/// The file of a model; `generator` names the program and version that made it. Numbers of tensors are rounded to single
/// precision.
///
/// # Panics
/// Never: names and shapes are those of this module.
pub fn write(model: &KeyStyleModel, generator: &str) -> Vec<u8> {
    let axes = model.axis_count();
    let metadata = Metadata {
        version: VERSION.to_owned(),
        generator: generator.to_owned(),
        rate_hz: RATE_HZ,
        skeleton: SkeletonInfo::of(&model.space.proportions),
        axes: model.axes.iter().map(|a| AxisInfo { measure: a.to_string(), unit: a.unit().to_string() }).collect(),
        variance: model.variance,
        least_support: model.least_support,
        travels: model.travels,
        clips: model.clips.iter().map(|c| ClipInfo { name: c.name.clone(), frames: c.frames }).collect(),
    };
    let (count, frames) = (model.components.len(), model.rows.len());
    let parts = || model.components.iter();
    let numbers: [(&str, Vec<usize>, Vec<f64>); 9] = [
        (
            "reference",
            vec![JOINTS, 4],
            model.space.reference.iter().flat_map(|q| q.to_array()).map(f64::from).collect(),
        ),
        ("style_mean", vec![axes], model.style_mean[..axes].to_vec()),
        ("style_deviation", vec![axes], model.style_deviation[..axes].to_vec()),
        ("slopes", vec![count, axes, DIMS], parts().flat_map(|c| c.slopes[..axes].as_flattened()).copied().collect()),
        ("means", vec![count, DIMS], parts().flat_map(|c| c.mean).collect()),
        ("weights", vec![count], parts().map(|c| c.weight).collect()),
        ("centres", vec![count, axes], parts().flat_map(|c| &c.centre[..axes]).copied().collect()),
        (
            "spreads",
            vec![count, axes, axes],
            parts().flat_map(|c| c.spread[..axes].iter().flat_map(|row| &row[..axes])).copied().collect(),
        ),
        ("styles", vec![frames, axes], model.styles.iter().flat_map(|u| &u[..axes]).copied().collect()),
    ];
    let rounded = |values: Vec<f64>| values.iter().flat_map(|v| (*v as f32).to_le_bytes()).collect::<Vec<u8>>();
    let mut tensors: Vec<(&str, Vec<usize>, Vec<u8>)> =
        numbers.into_iter().map(|(name, shape, values)| (name, shape, rounded(values))).collect();
    let poses = model.rows.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    tensors.push(("poses", vec![frames, DIMS], poses));
    let views = tensors.iter().map(|(name, shape, bytes)| {
        (*name, TensorView::new(Dtype::F32, shape.clone(), bytes).expect("as many bytes as the shape says"))
    });
    let json = serde_json::to_string(&metadata).expect("strings and numbers are JSON");
    let metadata = std::iter::once((METADATA.to_owned(), json)).collect();
    safetensors::serialize(views, Some(metadata)).expect("tensors have distinct names")
}

/// Reads a file; trusts nothing.
///
/// # Errors
/// [`KeyStyleModelError`] for anything but a key-style model of this major version.
pub fn read(file: &[u8]) -> Result<KeyStyleModel, KeyStyleModelError> {
    if file.len() > MAX_BYTES {
        return Err(KeyStyleModelError::TooManyBytes(file.len()));
    }
    let bad = |e: safetensors::SafeTensorError| KeyStyleModelError::NotSafetensors(e.to_string());
    let (_, header) = SafeTensors::read_metadata(file).map_err(bad)?;
    let json = header.metadata().as_ref().and_then(|m| m.get(METADATA)).ok_or(KeyStyleModelError::NoMetadata)?;
    let metadata: Metadata = serde_json::from_str(json).map_err(|e| KeyStyleModelError::Metadata(e.to_string()))?;
    let major = |v: &str| v.split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major(&metadata.version) != major(VERSION) {
        return Err(KeyStyleModelError::Version(metadata.version.chars().take(20).collect()));
    }
    let proportions = metadata.skeleton.proportions().ok_or(KeyStyleModelError::Layout("joints"))?;
    if metadata.rate_hz != RATE_HZ {
        return Err(KeyStyleModelError::Layout("frames per second"));
    }
    let axes = metadata.axes.len();
    within("axes", axes, 1, MAX_AXES)?;
    let measures = metadata.axes.iter().map(|axis| {
        Measure::parse(&axis.measure).map_err(|e| KeyStyleModelError::Axis {
            axis: axis.measure.chars().take(80).collect(),
            reason: e.to_string(),
        })
    });
    let measures = measures.collect::<Result<Vec<_>, _>>()?;

    let tensors = SafeTensors::deserialize(file).map_err(bad)?;
    let rows = |name| tensors.tensor(name).ok().and_then(|t| t.shape().first().copied()).unwrap_or_default();
    let (count, frames) = (rows("weights"), rows("styles"));
    within("components", count, 1, MAX_COMPONENTS)?;
    within("frames", frames, 1, MAX_BYTES / (4 * DIMS))?;
    let (clips, in_clips) = spans(metadata.clips);
    if in_clips != Some(frames) {
        return Err(KeyStyleModelError::Layout("clips and frames"));
    }
    let tensor = |name: &'static str, expected: &[usize]| values_of(&tensors, name, expected);
    let reference = tensor("reference", &[JOINTS, 4])?;
    let reference: Vec<Quat> = reference.chunks_exact(4).map(|q| Quat::from_xyzw(q[0], q[1], q[2], q[3])).collect();
    if let Some(q) = reference.iter().find(|q| (q.dot(**q) - 1.0).abs() > 1e-3) {
        return Err(value("reference", format!("{:?}", q.to_array()), "a unit quaternion"));
    }
    let style_mean = tensor("style_mean", &[axes])?;
    let style_deviation = positive("style_deviation", tensor("style_deviation", &[axes])?)?;
    let slopes = tensor("slopes", &[count, axes, DIMS])?;
    let means = tensor("means", &[count, DIMS])?;
    let weights = positive("weights", tensor("weights", &[count])?)?;
    let centres = tensor("centres", &[count, axes])?;
    let spreads = tensor("spreads", &[count, axes, axes])?;
    let components = (0..count).map(|i| Component {
        slopes: std::array::from_fn(|j| {
            std::array::from_fn(|d| if j < axes { slopes[(i * axes + j) * DIMS + d].into() } else { 0.0 })
        }),
        mean: std::array::from_fn(|d| means[i * DIMS + d].into()),
        weight: weights[i].into(),
        centre: style(&centres[i * axes..(i + 1) * axes]),
        spread: std::array::from_fn(|j| {
            if j < axes {
                style(&spreads[(i * axes + j) * axes..][..axes])
            } else {
                std::array::from_fn(|k| f64::from(u8::from(j == k)))
            }
        }),
    });
    let components: Vec<Component> = components.collect();
    if let Some(i) = components.iter().position(|c| !c.knows_a_region(axes)) {
        return Err(value("spreads", format!("that of component {}", i + 1), "a positive definite covariance"));
    }
    if !(metadata.variance > 0.0 && metadata.variance.is_finite()) {
        return Err(value("variance", metadata.variance.to_string(), "a positive number"));
    }
    let mut deviation = style(&style_deviation);
    deviation[axes..].fill(1.0);
    Ok(KeyStyleModel {
        space: PoseSpace::new(&proportions, std::array::from_fn(|j| reference[j].normalized())),
        axes: measures,
        style_mean: style(&style_mean),
        style_deviation: deviation,
        components,
        variance: metadata.variance,
        least_support: metadata.least_support,
        travels: metadata.travels,
        clips,
        styles: tensor("styles", &[frames, axes])?.chunks_exact(axes).map(style).collect(),
        rows: tensor("poses", &[frames, DIMS])?.as_chunks().0.to_vec(),
    })
}

fn within(what: &'static str, found: usize, least: usize, most: usize) -> Result<(), KeyStyleModelError> {
    if (least..=most).contains(&found) { Ok(()) } else { Err(KeyStyleModelError::Count { what, found, least, most }) }
}

/// Clips one after the other, and how many frames they have; none if these are beyond all numbers.
fn spans(clips: Vec<ClipInfo>) -> (Vec<ClipSpan>, Option<usize>) {
    let mut next = Some(0_usize);
    let spans = clips.into_iter().map(|ClipInfo { name, frames }| {
        let first_frame = next.unwrap_or_default();
        next = next.and_then(|n| n.checked_add(frames));
        ClipSpan { name, first_frame, frames }
    });
    (spans.collect(), next)
}

fn style(values: &[f32]) -> Style {
    std::array::from_fn(|j| values.get(j).copied().unwrap_or_default().into())
}

fn value(name: &'static str, value: String, expected: &'static str) -> KeyStyleModelError {
    KeyStyleModelError::Value { name, value, expected }
}

/// The finite numbers of a tensor of this shape.
fn values_of(
    tensors: &SafeTensors<'_>,
    name: &'static str,
    expected: &[usize],
) -> Result<Vec<f32>, KeyStyleModelError> {
    let wrong = |found: String| KeyStyleModelError::Tensor { name, found, expected: expected.to_vec() };
    let tensor = tensors.tensor(name).map_err(|_| wrong("absent".to_owned()))?;
    if tensor.dtype() != Dtype::F32 || tensor.shape() != expected {
        return Err(wrong(format!("{:?} {:?}", tensor.dtype(), tensor.shape())));
    }
    let values: Vec<f32> =
        tensor.data().chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    match values.iter().find(|v| !v.is_finite()) {
        Some(v) => Err(value(name, v.to_string(), "a finite number")),
        None => Ok(values),
    }
}

fn positive(name: &'static str, values: Vec<f32>) -> Result<Vec<f32>, KeyStyleModelError> {
    match values.iter().find(|v| **v <= 0.0) {
        Some(v) => Err(value(name, v.to_string(), "a positive number")),
        None => Ok(values),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use strut_core::humanoid::Proportions;

    fn model() -> KeyStyleModel {
        let spread = [[0.5, 0.25, 0.0], [0.25, 0.5, 0.0], [0.0, 0.0, 1.0]];
        let component = |value: f64| Component {
            slopes: [[value; DIMS], [0.5; DIMS], [0.0; DIMS]],
            mean: [value; DIMS],
            weight: 0.5,
            centre: [value, -value, 0.0],
            spread,
        };
        KeyStyleModel {
            space: PoseSpace::new(&Proportions::default(), [Quat::IDENTITY; JOINTS]),
            axes: Measure::parse_list("hips_height, hand_l.y - max(0, shoulder_l.y)").unwrap(),
            style_mean: [90.0, 12.5, 0.0],
            style_deviation: [2.0, 4.0, 1.0],
            components: vec![component(0.5), component(-0.125)],
            variance: 0.1,
            least_support: -2.75,
            travels: true,
            clips: vec![
                ClipSpan { name: "a \"<b>".into(), first_frame: 0, frames: 2 },
                ClipSpan { name: "歩く".into(), first_frame: 2, frames: 1 },
            ],
            styles: vec![[0.5, -1.5, 0.0], [0.25, 0.0, 0.0], [2.0, 1.0, 0.0]],
            rows: vec![[0.1; DIMS], [0.2; DIMS], [-0.3; DIMS]],
        }
    }

    #[test]
    fn a_model_comes_back() {
        let bytes = write(&model(), "test");
        assert_eq!(read(&bytes).unwrap(), model());
        assert_eq!(write(&read(&bytes).unwrap(), "test"), bytes);
    }

    #[test]
    fn what_is_no_model_is_refused_with_a_reason() {
        let bytes = write(&model(), "test");
        let refused = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(refused(&bytes[..bytes.len() - 7]).contains("cut short"));
        assert!(refused(b"HIERARCHY\nROOT Hips\n").contains("no key-style model"));
        let changed = |change: &dyn Fn(&mut KeyStyleModel)| {
            let mut other = model();
            change(&mut other);
            refused(&write(&other, "test"))
        };
        assert!(changed(&|m| m.style_deviation[1] = 0.0).contains("'style_deviation' holds 0; a positive number"));
        assert!(changed(&|m| m.components[1].slopes[0][7] = f64::NAN).contains("'slopes' holds NaN; a finite number"));
        assert!(changed(&|m| m.components[0].spread[0][0] = -1.0).contains("component 1; a positive definite"));
        assert!(changed(&|m| m.clips[0].frames = usize::MAX).contains("clips and frames differ"));
        assert!(changed(&|m| m.components.clear()).contains("has 0 components; 1 to 64 were expected"));
        assert!(changed(&|m| m.axes.clear()).contains("has 0 axes; 1 to 3 were expected"));
        assert!(changed(&|m| m.variance = -1.0).contains("'variance' holds -1; a positive number"));
        let mut unknown = bytes.clone();
        let name = bytes.windows(11).position(|w| w == b"hips_height").unwrap();
        unknown[name + 10] = b'd';
        assert!(refused(&unknown).contains("axis 'hips_heighd' cannot be measured: column 1"));
    }

    proptest! {
        #[test]
        fn changed_bytes_never_panic(at in 0usize..4000, value: u8, cut in 0usize..100) {
            let mut bytes = write(&model(), "test");
            let at = at % bytes.len();
            bytes[at] = value;
            bytes.truncate(bytes.len() - cut);
            let _ = read(&bytes);
        }
    }
}
