//! Tests of complete baselines: on sparse training data through the stylizer, and on their training targets. Their
//! parts are tested in their own modules.

use crate::database::{Database, DatabaseParts};
use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, database, walk};
use crate::math::float_funcs::ln;
use crate::pose_vector::DOFS;
use crate::transfer::{Method, Model, Options, Stylizer};
use std::sync::Arc;

/// Methods, and the greatest accepted height of their hips for extreme input, metres. The measured values were 0.98 to
/// 1.2; a joint system of few frames extrapolates farther, to 5.2.
const METHODS: [(Method, f32); 4] =
    [(Method::GlobalAr, 1.5), (Method::Lti, 1.5), (Method::LtiJoint, 6.0), (Method::Gp, 1.5)];

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
fn training_error(pairs: &super::Pairs<'_>, predictor: &dyn super::Predictor) -> [f32; 2] {
    let sigma = pairs.catalogue.sigma();
    let (mut error, mut of_duration, mut count) = (0.0, 0.0, 0);
    for rows in pairs.segments.iter().cloned() {
        let mut memory = vec![0.0; predictor.memory_len()];
        predictor.start(&mut memory, &pairs.inputs[rows.start..=rows.start]);
        let mut previous_output = pairs.targets[rows.start];
        for t in rows.skip(1) {
            let (input, previous_input) = (&pairs.inputs[t], &pairs.inputs[t - 1]);
            let now = super::Now { input, previous_input, previous_output: &previous_output };
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
    let pairs = super::Pairs::new(model.catalogue(), &table, &[0]);
    // Twice the measured errors.
    for (baseline, greatest) in [
        (super::Baseline::GlobalAr, [0.03, 0.03]),
        (super::Baseline::Lti, [0.02, 0.0025]),
        (super::Baseline::LtiJoint, [0.009, 0.0025]),
        (super::Baseline::Gp, [0.05, 0.02]),
    ] {
        let predictor = model.baselines().predictor(baseline, &pairs, 0.1);
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
        let pairs = super::Pairs::new(model.catalogue(), &table, &classes);
        let predictor = model.baselines().predictor(super::Baseline::Gp, &pairs, 0.1);
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
    let pairs = super::Pairs::new(model.catalogue(), &table, &[0]);
    for baseline in [super::Baseline::Lti, super::Baseline::LtiJoint] {
        let predictor = model.baselines().predictor(baseline, &pairs, 0.1);
        let input = &pairs.inputs[40];
        let now = super::Now { input, previous_input: input, previous_output: input };
        let settled = |past: &[crate::pose_vector::PoseRow]| {
            let mut memory = vec![0.0; predictor.memory_len()];
            predictor.start(&mut memory, past);
            (0..600).map(|_| predictor.predict(&mut memory, now)).last().unwrap()
        };
        let (a, b) = (settled(&[]), settled(&pairs.inputs[..80]));
        let apart = (0..DOFS).map(|d| (a.output[d] - b.output[d]).abs()).fold(0.0, f32::max);
        assert!(apart < 1e-2 && (a.step_secs - b.step_secs).abs() < 1e-4, "{baseline:?}: {apart}");
    }
}
