//! Walk model file, `.strutwalk`: a [container].
//!
//! Tensors are little-endian f32. There are S styles, two sides (left, right) and five states. D = 63 are the degrees
//! of freedom of a pose, an exponential map relative to its reference for every joint. The three streams are static,
//! delta and delta-delta: pose, velocity and acceleration per frame.
//!
//! | Name | Shape | Content |
//! | --- | --- | --- |
//! | `reference` | 21, 4 | mean rotations x y z w; that of the hips without the heading |
//! | `means` | S, 2, 5, 3, D | means of every style's states |
//! | `durations` | S, 2, 5 | mean durations of the states, frames |
//! | `step_lengths` | S | mean length of a synthesised step, metres; since version 1.2, absent if it was not measured |
//! | `step_length_bends` | S, 2 | step length requested in addition to the proportional one, metres per unit of a weight below 0 and above 1; since version 1.3, absent if zero |
//! | `variances` | 2, 5, 3, D | variances, shared by all styles |
//! | `duration_variances` | 2, 5 | variances of the durations, frames² |
//! | `range` | 2, D | least and greatest value in the recorded walks |
//!
//! The metadata entry `strut-walk` is a JSON object. `version`, `generator`, `checksum`, `rate_hz` and `skeleton` are
//! as in a database. `styles` contains the names of the styles, `contexts` the steps for which the models of the two
//! sides are. Models of other contexts, such as the first step of a walk, may follow in a later version.

use crate::container::{self, ContainerError, Kind, floats, rounded};
use crate::strutdb::SkeletonInfo;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;
use strut_core::hsmm::{
    Observation, PerState, RATE_HZ, ROTATION_DIMS, SIDES, STATES, StyleMeans, WalkModel, flattened,
};
use strut_core::humanoid::JOINTS;
use strut_core::math::Quat;
use thiserror::Error;

/// The kind of file.
pub const KIND: Kind =
    Kind { name: "walk model", entry: "strut-walk", version: "1.3", checksum_since: 1, max_bytes: 64 << 20 };
/// Greatest number of styles of a model.
pub const MAX_STYLES: usize = 1000;
/// Greatest absolute value of a mean and of a range's limits, radians, and of `step_length_bends`, metres.
const MODERATE: f32 = 100.0;
/// Variances, radians²; training gives at least 1e-9. Walking divides by them in single precision.
const VARIANCES: RangeInclusive<f32> = 1e-10..=1e4;
/// Range of the durations of a state, frames.
const DURATIONS: RangeInclusive<f32> = 1e-3..=1e3;
/// Range of the lengths of a step, metres; 0 if it was not measured.
const STEP_LENGTHS: RangeInclusive<f32> = 0.0..=100.0;
/// Variances of durations, frames²; training gives at least 0.25.
const DURATION_VARIANCES: RangeInclusive<f32> = 1e-6..=1e6;

const LENGTHS: &str = "step_lengths";
const BENDS: &str = "step_length_bends";
const CONTEXTS: [&str; SIDES] = ["left", "right"];
const OBSERVATION: usize = 3 * ROTATION_DIMS;

/// Reason why bytes are not a walk model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[allow(missing_docs)]
pub enum WalkModelError {
    /// The container is of another kind or damaged.
    #[error(transparent)]
    File(#[from] ContainerError),
    /// The body, the frame rate or the contexts are not supported.
    #[error("the walk model's {0} differ from those of this release of Strut")]
    Layout(&'static str),
    /// There are no styles, or too many.
    #[error("the walk model has {0} styles; 1 to {MAX_STYLES} were expected")]
    Styles(usize),
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
    styles: Vec<String>,
    contexts: Vec<String>,
}

/// Writes the file of a model. `generator` is the name and version of the program. Numbers are rounded to single precision.
///
/// # Panics
/// Never: names and shapes are defined in this module.
pub fn write(model: &WalkModel, generator: &str) -> Vec<u8> {
    let metadata = Metadata {
        version: KIND.version.to_owned(),
        checksum: container::BLANK.to_owned(),
        generator: generator.to_owned(),
        rate_hz: RATE_HZ,
        skeleton: SkeletonInfo::of(&model.proportions),
        styles: model.styles.clone(),
        contexts: CONTEXTS.map(str::to_owned).to_vec(),
    };
    let styles = model.means.len();
    let means = || model.means.iter();
    let mut tensors = vec![
        ("reference", floats(vec![JOINTS, 4], || model.reference.iter().copied().flat_map(Quat::to_array))),
        (
            "means",
            rounded(vec![styles, SIDES, STATES, 3, ROTATION_DIMS], || {
                means().flat_map(|m| flattened(&m.means)).copied()
            }),
        ),
        (
            "durations",
            rounded(vec![styles, SIDES, STATES], || means().flat_map(|m| m.durations.as_flattened()).copied()),
        ),
        ("variances", rounded(vec![SIDES, STATES, 3, ROTATION_DIMS], || flattened(&model.variances).iter().copied())),
        (
            "duration_variances",
            rounded(vec![SIDES, STATES], || model.duration_variances.as_flattened().iter().copied()),
        ),
        ("range", rounded(vec![2, ROTATION_DIMS], || model.range.as_flattened().iter().copied())),
    ];
    if means().any(|m| m.step_length != 0.0) {
        tensors.push((LENGTHS, rounded(vec![styles], || means().map(|m| m.step_length))));
    }
    if means().any(|m| m.step_length_bends != [0.0; 2]) {
        tensors.push((BENDS, rounded(vec![styles, 2], || means().flat_map(|m| m.step_length_bends))));
    }
    container::write(KIND, &metadata, &tensors)
}

/// Reads a file; checks every value.
///
/// # Errors
/// [`WalkModelError`] unless the file is a walk model of this major version.
pub fn read(file: &[u8]) -> Result<WalkModel, WalkModelError> {
    let (metadata, tensors): (Metadata, _) = container::open(KIND, file)?;
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

    let moderate = -MODERATE..=MODERATE;
    let moderate_expected = "a number within ±100";
    let means = tensors.within("means", &[styles, SIDES, STATES, 3, ROTATION_DIMS], &moderate, moderate_expected)?;
    let durations = tensors.within("durations", &[styles, SIDES, STATES], &DURATIONS, "0.001 to 1000 frames")?;
    let step_lengths = match tensors.rows(LENGTHS) {
        0 => vec![0.0; styles],
        _ => tensors.within(LENGTHS, &[styles], &STEP_LENGTHS, "0 to 100 m")?,
    };
    let bends = match tensors.rows(BENDS) {
        0 => Vec::new(),
        _ => tensors.within(BENDS, &[styles, 2], &moderate, moderate_expected)?,
    };
    let variances = tensors.within(
        "variances",
        &[SIDES, STATES, 3, ROTATION_DIMS],
        &VARIANCES,
        "a variance of 1e-10 to 10000 rad²",
    )?;
    let duration_variances = tensors.within(
        "duration_variances",
        &[SIDES, STATES],
        &DURATION_VARIANCES,
        "a variance of 0.000001 to 1000000 frames²",
    )?;
    let range = tensors.within("range", &[2, ROTATION_DIMS], &moderate, moderate_expected)?;
    let (low, high) = range.split_at(ROTATION_DIMS);
    if let Some((low, high)) = low.iter().zip(high).find(|(low, high)| low > high) {
        return Err(ContainerError::value(
            "range",
            format!("{low} to {high}"),
            "the least and the greatest of some numbers",
        )
        .into());
    }
    let mut means: Vec<StyleMeans> = means
        .chunks_exact(SIDES * STATES * OBSERVATION)
        .zip(durations.chunks_exact(SIDES * STATES))
        .zip(step_lengths)
        .map(|((means, durations), step_length)| StyleMeans {
            means: Box::new(observations(means)),
            durations: per_state(durations),
            step_length: step_length.into(),
            step_length_bends: [0.0; 2],
        })
        .collect();
    for (means, bends) in means.iter_mut().zip(bends.chunks_exact(2)) {
        means.step_length_bends = [bends[0].into(), bends[1].into()];
    }
    Ok(WalkModel {
        proportions,
        reference: tensors.rotations("reference")?,
        variances: Box::new(observations(&variances)),
        duration_variances: per_state(&duration_variances),
        range: std::array::from_fn(|end| std::array::from_fn(|d| range[end * ROTATION_DIMS + d].into())),
        styles: metadata.styles,
        means,
    })
}

fn observations(values: &[f32]) -> PerState<Observation> {
    let at = |side, state, part, d| f64::from(values[((side * STATES + state) * 3 + part) * ROTATION_DIMS + d]);
    std::array::from_fn(|side| {
        std::array::from_fn(|state| std::array::from_fn(|part| std::array::from_fn(|d| at(side, state, part, d))))
    })
}

fn per_state(values: &[f32]) -> PerState<f64> {
    std::array::from_fn(|side| std::array::from_fn(|state| values[side * STATES + state].into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::container::version_1_0;
    use proptest::prelude::*;
    use std::sync::Arc;
    use strut_core::hsmm::{RuntimeWalkModel, Walker};
    use strut_core::humanoid::Proportions;

    fn model() -> WalkModel {
        let means = |value: f64| StyleMeans {
            means: Box::new([[[[value; ROTATION_DIMS]; 3]; STATES]; SIDES]),
            durations: [[3.0; STATES]; SIDES],
            step_length: 0.5,
            step_length_bends: [0.0, 0.125 * value],
        };
        WalkModel {
            proportions: Proportions::default(),
            reference: [Quat::IDENTITY; JOINTS],
            variances: Box::new([[[[0.25; ROTATION_DIMS]; 3]; STATES]; SIDES]),
            duration_variances: [[0.5; STATES]; SIDES],
            range: [[-1.0; ROTATION_DIMS], [1.5; ROTATION_DIMS]],
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
    fn a_file_of_version_1_0_without_checksum_opens() {
        let file = write(&model(), "test");
        assert_eq!(write(&read(&version_1_0(KIND, &file)).unwrap(), "test"), file);
    }

    #[test]
    fn a_file_that_holds_no_lengths_opens() {
        let mut old = model();
        for (name, forget) in [
            (BENDS, (|means| means.step_length_bends = [0.0; 2]) as fn(&mut StyleMeans)),
            (LENGTHS, |means| means.step_length = 0.0),
        ] {
            let holds = |file: &[u8]| file.windows(name.len()).any(|bytes| bytes == name.as_bytes());
            assert!(holds(&write(&old, "test")));
            old.means.iter_mut().for_each(forget);
            let file = write(&old, "test");
            assert!(!holds(&file));
            assert_eq!(read(&file).unwrap(), old);
            assert!(walks(&file));
        }
    }

    #[test]
    fn other_files_are_refused_with_a_reason() {
        let refused = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
        assert!(refused(b"HIERARCHY\nROOT Hips\n").contains("not a walk model"));
        let mut other = model();
        other.variances[0][0][0][0] = 0.0;
        assert!(refused(&write(&other, "test")).contains("'variances' holds 0; a variance of 1e-10 to 10000 rad²"));
        other = model();
        other.means[1].means[0][0][0][0] = f64::NAN;
        assert!(refused(&write(&other, "test")).contains("'means' holds NaN"));
        other = model();
        other.means[0].durations[1][4] = 1e38;
        assert!(refused(&write(&other, "test")).contains("'durations' holds 1"));
        other = model();
        other.variances[1][2][0][5] = 1e-40;
        assert!(refused(&write(&other, "test")).contains("'variances' holds 0.0000"));
        other = model();
        other.duration_variances[1][2] = 1e-40;
        assert!(refused(&write(&other, "test")).contains("'duration_variances' holds 0.0000"));
        other = model();
        other.means[1].means[0][0][2][0] = 1e30;
        assert!(refused(&write(&other, "test")).contains("'means' holds 1000000"));
        other = model();
        other.means[1].step_length = -0.5;
        assert!(refused(&write(&other, "test")).contains("'step_lengths' holds -0.5; 0 to 100 m"));
        other = model();
        other.means[0].step_length_bends[1] = f64::NAN;
        assert!(refused(&write(&other, "test")).contains("'step_length_bends' holds NaN; a number within ±100"));
        other = model();
        other.range[0][7] = 2.0;
        assert!(refused(&write(&other, "test")).contains("'range' holds 2 to 1.5"));
        other = model();
        (other.styles, other.means) = (Vec::new(), Vec::new());
        assert_eq!(read(&write(&other, "test")), Err(WalkModelError::Styles(0)));
    }

    fn walks(bytes: &[u8]) -> bool {
        let model = read(bytes).unwrap();
        let mut walker = Walker::new(Arc::new(RuntimeWalkModel::new(&model)));
        walker.set_styles(&vec![-5.0; model.styles.len()]).unwrap();
        (0..40).all(|_| walker.advance().is_finite())
    }

    #[test]
    fn variances_a_billion_times_apart_walk() {
        for stream in 0..3 {
            let mut uneven = model();
            uneven.variances[1][2][stream][5] = 1.2e-10;
            assert!(walks(&write(&uneven, "test")), "stream {stream}");
        }
    }

    #[test]
    fn a_body_of_astronomical_size_is_refused() {
        let mut other = model();
        other.proportions.offsets[1].y = 1e9;
        assert_eq!(read(&write(&other, "test")), Err(WalkModelError::Layout("joints")));
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

        #[test]
        fn every_model_that_is_accepted_walks(at: prop::sample::Index, value: u8) {
            let mut bytes = version_1_0(KIND, &write(&model(), "test"));
            let at = at.index(bytes.len());
            bytes[at] = value;
            prop_assert!(read(&bytes).is_err() || walks(&bytes));
        }
    }
}
