//! Tests of the smallest built-in database, with which embedded players start.

use std::ops::ControlFlow;
use std::sync::Arc;
use strut_core::database::Database;
use strut_core::humanoid::Pose;
use strut_core::transfer::{Model, NoClock, Options, Stylizer, stylize_clip};
use strut_demo::{
    NamedMotion, STYLES, counterpart, database, first_walk_database, input_clips, walk_database, walk_input,
};
use strut_formats::strutdb::packed;

/// Upper bound of the mean angle between joints of the proud walk styled with the small and with the full database,
/// radians. The measured value was 0.0054 (0.31°).
const MAX_MEAN_ANGLE: f32 = 0.01;
/// The same for the first strides alone, with which a page starts. The measured value was 0.0126 (0.72°), and 0.0274 in
/// the worst frame.
const MAX_FIRST_ANGLE: f32 = 0.015;
/// Upper bound of the small database's distance from the performed proud walk, relative to the full one's. The measured
/// value was 1.03.
const MAX_LOSS: f32 = 1.15;

#[test]
fn it_has_one_walk_a_style() {
    let whole = database().unwrap();
    let file = packed::write(&walk_database(&whole).unwrap(), &[]);
    let db = packed::read_database(&file).unwrap();
    assert_eq!(db.actions, ["walk"]);
    assert_eq!(db.styles.len(), 8);
    assert!(STYLES.iter().all(|style| db.styles.iter().any(|name| name == style.name)), "{:?}", db.styles);
    assert_eq!(db.styles[usize::from(db.neutral)], "neutral");
    assert_eq!(db.clips.len(), db.styles.len());
}

#[test]
fn a_page_can_begin_with_the_first_steps() {
    let NamedMotion { motion, .. } = walk_input();
    let whole = database().unwrap();
    let first = proud(first_walk_database(&whole).unwrap(), &motion.poses);
    let full = proud(whole, &motion.poses);
    let apart = mean_angle(&first, &full);
    let worst = first.iter().zip(&full).map(|(a, b)| mean_angle(&[*a], &[*b])).fold(0.0, f32::max);
    println!("{apart} rad apart in the mean, {worst} in a frame");
    assert!(apart < MAX_FIRST_ANGLE, "{apart} rad");
    assert!(worst < 2.5 * MAX_FIRST_ANGLE, "{worst} rad");
}

#[test]
fn the_full_database_stores_no_walk_again() {
    let whole = database().unwrap();
    let alone = packed::write(&whole, &[]);
    let walks = packed::write(&walk_database(&whole).unwrap(), &[]);
    let mut both = walks.clone();
    packed::append(&mut both, &whole, &[]).unwrap();
    assert_eq!(*packed::read_database(&both).unwrap(), *packed::read_database(&alone).unwrap());
    // A walk has seven more columns than its pose.
    assert!(both.len() < alone.len() + walks.len() / 4, "{} of {} and {}", both.len(), alone.len(), walks.len());
}

#[test]
fn it_styles_a_neutral_walk_as_the_full_database_does() {
    let NamedMotion { name, motion } = walk_input();
    assert_eq!(name, "neutral walk");
    assert_eq!(motion, input_clips().swap_remove(0).motion);
    let performed = counterpart(name, "proud").unwrap().poses;
    let whole = database().unwrap();
    let small = proud(walk_database(&whole).unwrap(), &motion.poses);
    let full = proud(whole, &motion.poses);
    let apart = mean_angle(&small, &full);
    let [small_error, full_error] = [&small, &full].map(|poses| mean_angle(poses, &performed));
    let unstyled = mean_angle(&motion.poses, &performed);
    println!("{apart} rad apart; from the performed walk {small_error}, {full_error}, unstyled {unstyled}");
    assert!(apart < MAX_MEAN_ANGLE, "{apart} rad");
    assert!(small_error < MAX_LOSS * full_error, "{small_error} rad, with the full database {full_error} rad");
    assert!(small_error < unstyled / 2.0, "{small_error} rad, unstyled {unstyled} rad");
}

/// A clip in the proud style.
fn proud(database: Database, poses: &[Pose]) -> Vec<Pose> {
    let weights: Vec<f32> = database.styles.iter().map(|style| f32::from(style == "proud")).collect();
    let mut stylizer = Stylizer::new(Arc::new(Model::new(database)), Options::DEFAULT).unwrap();
    stylizer.set_styles(&weights).unwrap();
    let styled = stylize_clip(&stylizer, poses, &mut NoClock, |_, _| ControlFlow::Continue(())).unwrap();
    styled.frames.iter().map(|frame| frame.pose).collect()
}

/// Mean angle between the same joints of the same frames, radians.
fn mean_angle(a: &[Pose], b: &[Pose]) -> f32 {
    assert_eq!(a.len(), b.len());
    let rotations = |poses: &[Pose]| poses.iter().flat_map(|pose| pose.rotations).collect::<Vec<_>>();
    let (a, b) = (rotations(a), rotations(b));
    a.iter().zip(&b).map(|(a, b)| a.inv_mul(*b).angle()).sum::<f32>() / a.len() as f32
}
