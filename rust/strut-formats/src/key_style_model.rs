//! Key-style model file, `.strutkeys`: a [container].
//!
//! Tensors are little-endian f32. There are A axes (1 to 3), K components and N recorded frames. A pose has D = 64
//! numbers: an exponential map relative to its reference for every joint, then (height of the hips − 0.9 m) / 0.8 m.
//!
//! | Name | Shape | Content |
//! | --- | --- | --- |
//! | `reference` | 21, 4 | mean rotations x y z w; that of the hips without the facing direction |
//! | `style_mean`, `style_deviation` | A | of the recorded styles, in the axes' units; other tensors hold standardised styles |
//! | `slopes` | K, A, D | change of the pose per unit of style |
//! | `means` | K, D | the pose of the mean style |
//! | `weights` | K | shares of the components |
//! | `centres`, `spreads` | K, A; K, A, A | mean and covariance of the styles of each component |
//! | `styles` | N, A | the recorded styles |
//! | `poses` | N, D | the recorded poses |
//!
//! The metadata entry `strut-keys` is a JSON object. `version`, `generator`, `checksum`, `rate_hz` and `skeleton` are as in a
//! database. `axes` has a name or an expression and a unit for each axis. The others are `variance`, `least_support`, `travels`,
//! and `clips` with their names and frames.

use crate::container::{self, ContainerError, Kind, floats, rounded};
use crate::quotation::quotation;
use crate::strutdb::SkeletonInfo;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use strut_core::somn::{
    ClipSpan, Component, DIMS, KeyStyleModel, MAX_AXES, MAX_COMPONENTS, Measure, PoseSpace, RATE_HZ, Style,
};
use thiserror::Error;

/// The kind of file.
pub const KIND: Kind =
    Kind { name: "key-style model", entry: "strut-keys", version: "1.1", checksum_since: 1, max_bytes: 256 << 20 };

/// Greatest absolute value of a pose's number and of its change with a standard deviation of an axis, radians or
/// metres. Far beyond it poses overflow in single precision.
const MODERATE: f32 = 1e3;
const MODERATE_EXPECTED: &str = "a number within ±1000";
/// Greatest absolute value of a style, in its unit or in standard deviations.
const STYLE: f32 = 1e6;
const STYLE_EXPECTED: &str = "a number within ±1000000";
/// Standard deviations of an axis, and variances of poses; training gives at least 1e-5.
const DEVIATIONS: RangeInclusive<f32> = 1e-6..=STYLE;
const VARIANCES: RangeInclusive<f64> = 1e-9..=1e6;

/// Reason why bytes are not a key-style model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum KeyStyleModelError {
    /// The container is of another kind or damaged.
    #[error(transparent)]
    File(#[from] ContainerError),
    /// The body or the frame rate is not supported.
    #[error("the key-style model's {0} differ from those of this release of Strut")]
    Layout(&'static str),
    /// A count is out of range.
    #[error("the key-style model has {found} {what}; {least} to {most} were expected")]
    Count { what: &'static str, found: usize, least: usize, most: usize },
    /// An axis cannot be measured.
    #[error("the key-style model's axis '{axis}' cannot be measured: {reason}")]
    Axis { axis: String, reason: String },
}

#[derive(Serialize, Deserialize)]
struct Metadata {
    version: String,
    /// Missing before version 1.1.
    #[serde(default)]
    checksum: String,
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

/// Writes the file of a model. `generator` is the name and version of the program. Numbers of tensors are rounded to
/// single precision.
///
/// # Panics
/// Never: names and shapes are defined in this module.
pub fn write(model: &KeyStyleModel, generator: &str) -> Vec<u8> {
    let axes = model.axis_count();
    let metadata = Metadata {
        version: KIND.version.to_owned(),
        checksum: container::BLANK.to_owned(),
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
    let tensors = [
        ("reference", floats(vec![JOINTS, 4], || model.space.reference.iter().copied().flat_map(Quat::to_array))),
        ("style_mean", rounded(vec![axes], || model.style_mean[..axes].iter().copied())),
        ("style_deviation", rounded(vec![axes], || model.style_deviation[..axes].iter().copied())),
        ("slopes", rounded(vec![count, axes, DIMS], || parts().flat_map(|c| c.slopes[..axes].as_flattened()).copied())),
        ("means", rounded(vec![count, DIMS], || parts().flat_map(|c| c.mean))),
        ("weights", rounded(vec![count], || parts().map(|c| c.weight))),
        ("centres", rounded(vec![count, axes], || parts().flat_map(|c| &c.centre[..axes]).copied())),
        (
            "spreads",
            rounded(vec![count, axes, axes], || {
                parts().flat_map(|c| c.spread[..axes].iter().flat_map(|row| &row[..axes])).copied()
            }),
        ),
        ("styles", rounded(vec![frames, axes], || model.styles.iter().flat_map(|u| &u[..axes]).copied())),
        ("poses", floats(vec![frames, DIMS], || model.rows.as_flattened().iter().copied())),
    ];
    container::write(KIND, &metadata, &tensors)
}

/// Reads a file; checks every value.
///
/// # Errors
/// [`KeyStyleModelError`] unless the file is a key-style model of this major version.
pub fn read(file: &[u8]) -> Result<KeyStyleModel, KeyStyleModelError> {
    let (metadata, tensors): (Metadata, _) = container::open(KIND, file)?;
    let proportions = metadata.skeleton.proportions().ok_or(KeyStyleModelError::Layout("joints"))?;
    if metadata.rate_hz != RATE_HZ {
        return Err(KeyStyleModelError::Layout("frames per second"));
    }
    let axes = metadata.axes.len();
    within("axes", axes, 1, MAX_AXES)?;
    let measures = metadata.axes.iter().map(|axis| {
        Measure::parse(&axis.measure)
            .map_err(|e| KeyStyleModelError::Axis { axis: quotation(&axis.measure, 80), reason: e.to_string() })
    });
    let measures = measures.collect::<Result<Vec<_>, _>>()?;

    let (count, frames) = (tensors.rows("weights"), tensors.rows("styles"));
    within("components", count, 1, MAX_COMPONENTS)?;
    within("frames", frames, 1, KIND.max_bytes / (4 * DIMS))?;
    let (clips, in_clips) = spans(metadata.clips);
    if in_clips != Some(frames) {
        return Err(KeyStyleModelError::Layout("clips and frames"));
    }
    let reference = tensors.rotations("reference")?;
    let (moderate, of_style) = (-MODERATE..=MODERATE, -STYLE..=STYLE);
    let style_mean = tensors.within("style_mean", &[axes], &of_style, STYLE_EXPECTED)?;
    let style_deviation = tensors.within("style_deviation", &[axes], &DEVIATIONS, "a number of 0.000001 to 1000000")?;
    let slopes = tensors.within("slopes", &[count, axes, DIMS], &moderate, MODERATE_EXPECTED)?;
    let means = tensors.within("means", &[count, DIMS], &moderate, MODERATE_EXPECTED)?;
    let weights = tensors.positive("weights", &[count])?;
    let centres = tensors.within("centres", &[count, axes], &of_style, STYLE_EXPECTED)?;
    let spreads = tensors.within("spreads", &[count, axes, axes], &of_style, STYLE_EXPECTED)?;
    let styles = tensors.within("styles", &[frames, axes], &of_style, STYLE_EXPECTED)?;
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
        let found = format!("that of component {}", i + 1);
        return Err(ContainerError::value("spreads", found, "a positive definite covariance").into());
    }
    if !VARIANCES.contains(&metadata.variance) {
        let found = metadata.variance.to_string();
        return Err(ContainerError::value("variance", found, "a number of 0.000000001 to 1000000").into());
    }
    let mut deviation = style(&style_deviation);
    deviation[axes..].fill(1.0);
    Ok(KeyStyleModel {
        space: PoseSpace::new(&proportions, reference),
        axes: measures,
        style_mean: style(&style_mean),
        style_deviation: deviation,
        components,
        variance: metadata.variance,
        least_support: metadata.least_support,
        travels: metadata.travels,
        clips,
        styles: styles.chunks_exact(axes).map(style).collect(),
        rows: tensors.within("poses", &[frames, DIMS], &moderate, MODERATE_EXPECTED)?.as_chunks().0.to_vec(),
    })
}

fn within(what: &'static str, found: usize, least: usize, most: usize) -> Result<(), KeyStyleModelError> {
    if (least..=most).contains(&found) { Ok(()) } else { Err(KeyStyleModelError::Count { what, found, least, most }) }
}

/// Consecutive frame ranges of the clips, and their number of frames; `None` if it overflows.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::container::version_1_0;
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
    fn a_file_of_version_1_0_without_checksum_opens() {
        let file = write(&model(), "test");
        assert_eq!(write(&read(&version_1_0(KIND, &file)).unwrap(), "test"), file);
    }

    #[test]
    fn other_files_are_refused_with_a_reason() {
        let bytes = write(&model(), "test");
        let refused = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(refused(b"HIERARCHY\nROOT Hips\n").contains("not a key-style model"));
        let changed = |change: &dyn Fn(&mut KeyStyleModel)| {
            let mut other = model();
            change(&mut other);
            refused(&write(&other, "test"))
        };
        assert!(
            changed(&|m| m.style_deviation[1] = 0.0).contains("'style_deviation' holds 0; a number of 0.000001 to")
        );
        assert!(
            changed(&|m| m.components[1].slopes[0][7] = f64::NAN).contains("'slopes' holds NaN; a number within ±1000")
        );
        assert!(
            changed(&|m| m.rows[1][3] = 1e30)
                .contains("'poses' holds 1000000000000000000000000000000; a number within")
        );
        assert!(changed(&|m| m.components[0].spread[0][0] = -1.0).contains("component 1; a positive definite"));
        assert!(changed(&|m| m.clips[0].frames = usize::MAX).contains("clips and frames differ"));
        assert!(changed(&|m| m.components.clear()).contains("has 0 components; 1 to 64 were expected"));
        assert!(changed(&|m| m.axes.clear()).contains("has 0 axes; 1 to 3 were expected"));
        assert!(changed(&|m| m.variance = -1.0).contains("'variance' holds -1; a number of 0.000000001 to 1000000"));
        let mut unknown = version_1_0(KIND, &bytes);
        let name = unknown.windows(11).position(|w| w == b"hips_height").unwrap();
        unknown[name + 10] = b'd';
        assert!(refused(&unknown).contains("axis 'hips_heighd' cannot be measured: column 1"));
    }

    proptest! {
        #[test]
        fn changed_bytes_without_checksum_never_panic(at: prop::sample::Index, value: u8, cut in 0usize..100) {
            let mut bytes = version_1_0(KIND, &write(&model(), "test"));
            let at = at.index(bytes.len());
            bytes[at] = value;
            bytes.truncate(bytes.len() - cut);
            let _ = read(&bytes);
        }
    }
}
