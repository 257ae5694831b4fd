//! Tests of complete baselines: on sparse training data through the stylizer, and on their training targets. Their
//! parts are tested in their own modules.

use super::memo::{Baseline, Baselines};
use super::pairs::Pairs;
use super::{GLOBAL_AR, GP, LTI, LTI_JOINT, method_named};
use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, database, walk};
use std::sync::Arc;
use strut_core::database::{Database, DatabaseParts};
use strut_core::humanoid::{Pose, Role};
use strut_core::math::Vec3;
use strut_core::math::float_funcs::{atan2, ln};
use strut_core::pose_vector::DOFS;
use strut_core::transfer::{
    ClipJob, ClipSearch, Method, Model, NoClock, Options, Predictor, PredictorInput, StyledFrame, Stylizer,
};

/// Methods, and the greatest accepted height of their hips for extreme input, metres. The measured values were 0.98 to
/// 1.2; a joint system of few frames extrapolates farther, to 5.2.
const METHODS: [(Method, f32); 4] = [(GLOBAL_AR, 1.5), (LTI, 1.5), (LTI_JOINT, 6.0), (GP, 1.5)];

/// The synthetic walks with one clip of a few frames in each class, registered frame by frame.
fn sparse(frames: usize) -> Database {
    let full = database();
    let kept: Vec<usize> = full.clips.iter().filter(|c| c.take == 0).flat_map(|c| c.rows().take(frames)).collect();
    let mut clips: Vec<_> = full.clips.iter().filter(|c| c.take == 0).cloned().collect();
    for (i, clip) in clips.iter_mut().enumerate() {
        (clip.first_frame, clip.frames) = (i * frames, frames);
    }
    let counterpart = (0..kept.len())
        .flat_map(|row| {
            let action = row / (2 * frames);
            [0, 1].map(|style| ((2 * action + style) * frames + row % frames) as f32)
        })
        .collect();
    Database::new(DatabaseParts {
        pose: kept.iter().map(|&r| full.pose[r]).collect(),
        point_cloud: kept.iter().map(|&r| full.point_cloud[r]).collect(),
        canonical_time: kept.iter().map(|&r| full.canonical_time[r]).collect(),
        time_step: kept.iter().map(|&r| full.time_step[r]).collect(),
        contact: kept.iter().map(|&r| full.contact[r]).collect(),
        clips,
        counterparts_per_style: 1,
        counterpart,
        actions: full.actions.clone(),
        styles: full.styles.clone(),
        ..(*full).clone()
    })
    .expect("the sparse fixture is a database")
}

#[test]
fn one_short_clip_a_class_gives_finite_motion_for_any_input() {
    let wild = Gait { period: 23.0, swing: 1.4, knee: 1.9, lean: -0.8, arms: 1.5, turn: 2.5 };
    for frames in [8, 30, 90] {
        let model = Arc::new(Model::new(sparse(frames)));
        for (method, highest) in METHODS {
            for (action, input_style) in [(None, None), (Some(0), Some(0)), (Some(1), Some(1))] {
                let options = Options { action, input_style, method, ..Options::DEFAULT };
                let mut s = Stylizer::new(Arc::clone(&model), options).unwrap();
                for weights in [[0.0, 1.0], [1.0, 0.0], [-0.5, 1.5]] {
                    s.set_styles(&weights).unwrap();
                    s.reset(None);
                    for gait in [NEUTRAL, BENT, wild] {
                        for pose in walk(&gait, 90, 0.4).poses {
                            let frame = s.push(&pose);
                            let height = frame.pose.root.y;
                            assert!(frame.pose.is_finite() && frame.dt_secs.is_finite(), "{method:?}, {frames}");
                            assert!(height.abs() < highest, "{method:?}, {frames} frames: the hips are at {height} m");
                        }
                    }
                }
            }
        }
    }
}

/// Mean distance of predictions and targets over consecutive rows, in standard deviations of the degrees of freedom,
/// and the mean relative difference of their durations.
fn training_error(pairs: &Pairs<'_>, predictor: &dyn Predictor) -> [f32; 2] {
    let sigma = pairs.catalogue.sigma();
    let (mut error, mut of_duration, mut count) = (0.0, 0.0, 0);
    for rows in pairs.segments.iter().cloned() {
        let mut memory = vec![0.0; predictor.memory_len()];
        predictor.start(&mut memory, &pairs.inputs[rows.start..=rows.start]);
        let mut previous_output = pairs.targets[rows.start];
        for t in rows.skip(1) {
            let (input, previous_input) = (&pairs.inputs[t], &pairs.inputs[t - 1]);
            let now = PredictorInput { input, previous_input, previous_output: &previous_output };
            let prediction = predictor.predict(&mut memory, now);
            let distance = |d: usize| (prediction.output[d] - pairs.targets[t][d]).abs() / sigma[d];
            error += (0..DOFS).map(distance).sum::<f32>() / DOFS as f32;
            of_duration += (ln(prediction.step_secs * RATE_HZ) - pairs.log_duration(t) as f32).abs();
            count += 1;
            previous_output = prediction.output;
        }
    }
    [error, of_duration].map(|sum| sum / count as f32)
}

/// Each method, with its own output as feedback, follows its training targets.
#[test]
fn training_targets_are_predicted() {
    let model = Model::new(database());
    let table = model.target_table(1);
    let pairs = Pairs::new(model.catalogue(), &table, &[0]);
    // Twice the measured errors.
    for (baseline, greatest) in [
        (Baseline::GlobalAr, [0.03, 0.03]),
        (Baseline::Lti, [0.02, 0.0025]),
        (Baseline::LtiJoint, [0.009, 0.0025]),
        (Baseline::Gp, [0.05, 0.02]),
    ] {
        let predictor = model.extension::<Baselines>().predictor(baseline, &pairs, 0.1);
        let found = training_error(&pairs, &*predictor);
        assert!(found[0] < greatest[0] && found[1] < greatest[1], "{baseline:?}: {found:?}");
    }
}

/// Shared features are kept, and concurrent requests get the same predictor.
#[test]
fn a_predictor_is_trained_once_a_model() {
    let model = Model::new(sparse(60));
    let classes = [0, 1];
    let train = |style: usize| {
        let table = model.target_table(style);
        let pairs = Pairs::new(model.catalogue(), &table, &classes);
        let predictor = model.extension::<Baselines>().predictor(Baseline::Gp, &pairs, 0.1);
        Arc::as_ptr(&predictor).cast::<()>() as usize
    };
    let first = train(1);
    let again: Vec<usize> =
        std::thread::scope(|s| [1, 1, 0].map(|style| s.spawn(move || train(style))).map(|t| t.join().unwrap()).into());
    assert_eq!(again[..2], [first; 2]);
    assert_ne!(again[2], first, "another style has its own");
}

/// With a constant input an LTI system's output becomes constant, whatever the initial state of the predictor.
#[test]
fn memory_of_the_start_dies_out() {
    let model = Model::new(database());
    let table = model.target_table(1);
    let pairs = Pairs::new(model.catalogue(), &table, &[0]);
    for baseline in [Baseline::Lti, Baseline::LtiJoint] {
        let predictor = model.extension::<Baselines>().predictor(baseline, &pairs, 0.1);
        let input = &pairs.inputs[40];
        let now = PredictorInput { input, previous_input: input, previous_output: input };
        let settled = |past: &[strut_core::pose_vector::PoseRow]| {
            let mut memory = vec![0.0; predictor.memory_len()];
            predictor.start(&mut memory, past);
            (0..600).map(|_| predictor.predict(&mut memory, now)).last().unwrap()
        };
        let (a, b) = (settled(&[]), settled(&pairs.inputs[..80]));
        let apart = (0..DOFS).map(|d| (a.output[d] - b.output[d]).abs()).fold(0.0, f32::max);
        assert!(apart < 1e-2 && (a.step_secs - b.step_secs).abs() < 1e-4, "{baseline:?}: {apart}");
    }
}

fn unseen_walk() -> Vec<Pose> {
    walk(&Gait { period: 63.0, swing: 0.41, ..NEUTRAL }, 240, 0.15).poses
}

fn run(stylizer: &mut Stylizer, poses: &[Pose]) -> Vec<StyledFrame> {
    poses.iter().map(|pose| *stylizer.push(pose)).collect()
}

fn stylizer(model: &Arc<Model>, options: Options, bent: f32) -> Stylizer {
    let mut s = Stylizer::new(Arc::clone(model), options).unwrap();
    s.set_styles(&[0.0, bent]).unwrap();
    s
}

#[test]
fn every_method_has_its_name_and_styles() {
    assert_eq!(method_named("mar"), Some(Method::Mar));
    assert_eq!(method_named("baseline"), None);
    let model = Arc::new(Model::new(database()));
    for (method, _) in METHODS {
        assert_eq!(method_named(method.name()), Some(method));
        let options = Options { method, action: Some(0), input_style: Some(0), ..Options::DEFAULT };
        let frames = run(&mut stylizer(&model, options, 1.0), &unseen_walk());
        let lean_of = |frame: &StyledFrame| {
            let up = frame.pose.rotations[Role::Chest.index()] * Vec3::Y;
            atan2(up.z, up.y)
        };
        let lean = frames[60..].iter().map(lean_of).sum::<f32>() / 180.0;
        assert!((lean - BENT.lean).abs() < 0.06, "{method:?}: lean {lean}");
        let ratio = frames[239].time_out_secs / frames[239].time_in_secs;
        let expected = f64::from((BENT.period + 1.0) / (NEUTRAL.period + 1.0));
        assert!((ratio - expected).abs() < 0.04, "{method:?}: ratio {ratio}, expected {expected}");
    }
}

/// Whichever option is changed, and whenever, nothing of the previous options remains.
#[test]
fn options_that_are_set_later_give_the_bits_of_a_new_stylizer() {
    let (model, input) = (Arc::new(Model::new(database())), unseen_walk());
    let changes: [fn(&mut Options); 6] = [
        |o| o.k = 12,
        |o| o.lambda = 3.0,
        |o| o.rho = 0.1,
        |o| (o.timing, o.footplant) = (false, false),
        |o| o.action = Some(1),
        |o| o.input_style = Some(1),
    ];
    for ((method, _), (other, _)) in METHODS.iter().zip(METHODS.iter().cycle().skip(1)) {
        for (i, change) in changes.iter().enumerate() {
            let before = Options { method: *method, ..Options::DEFAULT };
            let set_later = |from: Options, to: Options| {
                let mut s = stylizer(&model, from, 0.8);
                s.set_options(to).unwrap();
                run(&mut s, &input[..12])
            };
            let mut options = before;
            change(&mut options);
            let fresh = set_later(options, options);
            assert!(set_later(before, options) == fresh, "{method:?}: option {i}");
            assert!(set_later(Options { method: *other, ..options }, options) == fresh, "{method:?} after {other:?}");
        }
    }
}

/// A trained method keeps its memory in the stylizer and is not trained further.
#[test]
fn trained_methods_give_the_same_bits_and_allocate_nothing() {
    let (model, input) = (Arc::new(Model::new(database())), unseen_walk());
    for (method, _) in METHODS {
        let fresh = || stylizer(&model, Options { method, ..Options::DEFAULT }, 0.8);
        let first = run(&mut fresh(), &input);
        let mut s = fresh();
        run(&mut s, &input[50..90]);
        s.reset(None);
        assert_eq!(s.push(&input[0]), &first[0], "{method:?}");
        let mut frames = vec![first[0]];
        frames.reserve(input.len());
        let counted = allocation_counter::measure(|| frames.extend(input[1..].iter().map(|p| *s.push(p))));
        assert_eq!((counted.count_total, frames == first), (0, true), "{method:?}");
    }
}

#[test]
fn frames_found_in_portions_are_styled_as_in_one() {
    let (model, input) = (Arc::new(Model::new(database())), unseen_walk());
    for (method, _) in METHODS {
        let stylizer = stylizer(&model, Options { method, ..Options::DEFAULT }, 0.8);
        let search = ClipSearch::new(&stylizer, &input);
        let (mut found, mut whole) = (ClipJob::new(stylizer.clone()), ClipJob::new(stylizer.clone()));
        for portion in 0..search.portions() {
            for (pose, frame) in search.poses(portion).iter().zip(search.find(portion).frames()) {
                found.push_found(pose, &frame);
                whole.push(pose, &mut NoClock);
            }
        }
        assert_eq!(found.finish(), whole.finish(), "{method:?}");
    }
}
