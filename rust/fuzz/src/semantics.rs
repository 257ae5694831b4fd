//! Operations on files that parsers accept. They succeed or return an error; all results are finite, as long as the
//! input, and can be read again.

use crate::bases;
use crate::parsers::{
    edited_bvh, edited_database, edited_key_style_model, edited_walk_model, says_something, with_edited,
};
use arbitrary::Unstructured;
use std::sync::Arc;
use strut_core::catalogue::Catalogue;
use strut_core::hsmm::{RuntimeWalkModel, Walker};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose, Role};
use strut_core::math::Vec3;
use strut_core::retarget::to_humanoid;
use strut_core::search::Index;
use strut_core::somn::{Interpolation, Key, KeyStyling, MAX_AXES, Method, Mode, Synthesis};
use strut_core::transfer::{ClipJob, Model, NoClock, Options, StyledMotion, Stylizer, beyond_anatomy};
use strut_formats::bvh::{self, Bvh};
use strut_formats::corpus::Clip;
use strut_formats::{key_style_model, strutdb, walk_model};

/// Greatest number of frames of a file that are styled: longer files are only read.
const MAX_FRAMES: usize = 120;
/// Number of frames that a walk model synthesises.
const WALKED_FRAMES: usize = 60;
/// Tolerance of anatomical limits, radians, for rounding.
const ROUNDING: f32 = 0.02;

/// A BVH file with a few changes, styled with a valid database and written again.
pub(crate) fn style_a_file(data: &[u8]) {
    with_edited(data, edited_bvh, |file, u| {
        let Ok(clip) = Clip::parse(file) else { return };
        let db = bases::MODEL.catalogue();
        let input = match to_humanoid(&clip.motion, &clip.binding, &db.proportions).resampled(db.rate_hz) {
            Ok(input) if (1..=MAX_FRAMES).contains(&input.poses.len()) => input,
            Ok(_) => return,
            Err(e) => return says_something(&e),
        };
        assert!(input.poses.iter().all(Pose::is_finite));
        let stylizer = stylizer(Arc::clone(&bases::MODEL), u);
        let styled = style(stylizer, &input.poses);
        let motion = styled.on_skeleton(db.rate_hz, &clip.motion, &clip.binding);
        match clip.file.with_motion(&motion) {
            Err(e) => says_something(&e),
            Ok(out) => {
                let again = bvh::parse(&bvh::write(&out)).expect("what was written can be read");
                assert_eq!(again.joints, clip.file.joints);
                assert_eq!(again.frames, motion.frames());
            }
        }
    });
}

/// A valid motion, styled with a database that has a few changes.
pub(crate) fn style_with_a_database(data: &[u8]) {
    with_edited(data, edited_database, |file, u| {
        let Ok(contents) = strutdb::read(file) else { return };
        let database = contents.database;
        let planned = contents.plan.and_then(|plan| Index::from_plan(&database, plan).ok());
        let index = planned.unwrap_or_else(|| Index::build(&database));
        let model = Arc::new(Model::of(Catalogue::with_index(database, index)));
        style(stylizer(model, u), bases::input());
    });
}

/// Returns a stylizer with styles from the bytes.
fn stylizer(model: Arc<Model>, u: &mut Unstructured<'_>) -> Stylizer {
    let styles = model.catalogue().styles.len();
    let mut stylizer = Stylizer::new(model, Options::DEFAULT).expect("the default options are allowed");
    let weights: Vec<f32> = (0..styles).map(|_| u.int_in_range(-100i32..=200).unwrap_or(50) as f32 / 100.0).collect();
    stylizer.set_styles(&weights).expect("weights within the range");
    stylizer
}

/// Styles a clip frame by frame.
fn style(stylizer: Stylizer, input: &[Pose]) -> StyledMotion {
    let allowed = allowed(stylizer.model(), input);
    let mut job = ClipJob::new(stylizer);
    for pose in input {
        job.push(pose, &mut NoClock);
    }
    for (f, frame) in job.frames().iter().enumerate() {
        // Footplant turns ankles farther when a foot must stay on the ground.
        for role in Role::ALL {
            let beyond = beyond_anatomy(role, frame.pose.rotations[role.index()]);
            let allowed = allowed[role.index()];
            assert!(
                beyond <= allowed + ROUNDING,
                "{role:?} is {beyond} beyond anatomy in frame {f}; {allowed} allowed"
            );
        }
    }
    let styled = job.finish();
    assert_eq!(styled.frames.len(), input.len(), "a clip keeps its length");
    let mut time = f64::NEG_INFINITY;
    for (f, frame) in styled.frames.iter().enumerate() {
        assert!(frame.time_out_secs.is_finite() && frame.time_out_secs >= time, "time stands in frame {f}");
        time = frame.time_out_secs;
        assert_is_pose(&frame.pose);
    }
    styled
}

/// Returns how far each joint may exceed the anatomical limits: as far as the input or the database does. A joint may
/// reach any combination of the coordinates in the database.
fn allowed(model: &Model, input: &[Pose]) -> [f32; JOINTS] {
    let catalogue = model.catalogue();
    let [least, greatest] = catalogue.observed_range();
    let mut allowed = [0.0f32; JOINTS];
    for role in Role::ALL {
        let place = &mut allowed[role.index()];
        let mut allow = |rotation| *place = place.max(beyond_anatomy(role, rotation));
        for pose in input {
            allow(pose.rotations[role.index()]);
        }
        for corner in 0..8 {
            let mut row = *least;
            for axis in (0..3).filter(|axis| corner >> axis & 1 == 1) {
                row[3 * role.index() + axis] = greatest[3 * role.index() + axis];
            }
            allow(catalogue.chart.rotation(role, &row));
        }
    }
    allowed
}

/// Checks that a pose is finite and has unit rotations.
fn assert_is_pose(pose: &Pose) {
    assert!(pose.is_finite(), "{pose:?}");
    for (joint, q) in pose.rotations.iter().enumerate() {
        assert!((q.dot(*q) - 1.0).abs() < 2e-3, "joint {joint} is turned by {q:?}");
    }
}

/// A walk model with a few changes, walked.
pub(crate) fn walk(data: &[u8]) {
    with_edited(data, edited_walk_model, |file, u| {
        let Ok(model) = walk_model::read(file) else { return };
        let runtime = Arc::new(RuntimeWalkModel::new(&model));
        let mut walker = Walker::new(runtime);
        let weights: Vec<f32> =
            model.styles.iter().map(|_| u.int_in_range(-200i32..=300).unwrap_or(50) as f32 / 100.0).collect();
        walker.set_styles(&weights).expect("weights within the range");
        walker.set_turn(f32::from(u.int_in_range(-20i8..=20).unwrap_or(0)) / 100.0);
        walker.set_stride(f32::from(u.int_in_range(0u8..=20).unwrap_or(10)) / 10.0);
        walker.set_cadence(u.arbitrary().ok().flatten());
        walker.reset(Vec3::ZERO, 0.0);
        let poses: Vec<Pose> = (0..WALKED_FRAMES).map(|_| *walker.advance()).collect();
        poses.iter().for_each(assert_is_pose);
        let motion = HumanoidMotion { proportions: model.proportions, rate_hz: strut_core::hsmm::RATE_HZ, poses };
        can_be_written(&motion);
    });
}

/// A key-style model with a few changes, keyed.
pub(crate) fn key_style(data: &[u8]) {
    with_edited(data, edited_key_style_model, |file, u| {
        let Ok(model) = key_style_model::read(file) else { return };
        let key = |secs: f64, u: &mut Unstructured<'_>| {
            let mut style = [0.0; MAX_AXES];
            for value in &mut style {
                *value = f64::from(u.int_in_range(-200i32..=200).unwrap_or(0)) / 100.0;
            }
            Key { secs, style, row: None }
        };
        let keys = [key(0.0, u), key(0.4, u), key(1.0, u)];
        let mut synthesis = Synthesis::new(Arc::new(model));
        match KeyStyling::new(&keys, Interpolation::CatmullRom, &mut synthesis, Mode::KEYED) {
            Err(e) => says_something(&e),
            Ok(styling) => {
                let motion = styling.motion(&mut synthesis, Method::KeyStyle);
                motion.poses.iter().for_each(assert_is_pose);
                can_be_written(&motion);
            }
        }
    });
}

/// Checks that a motion can be written to a file and read again, frame by frame.
fn can_be_written(motion: &HumanoidMotion) {
    match Bvh::from_humanoid(motion) {
        Err(e) => says_something(&e),
        Ok(out) => {
            let again = bvh::parse(&bvh::write(&out)).expect("what was written can be read");
            assert_eq!(again.frames, motion.poses.len());
        }
    }
}
