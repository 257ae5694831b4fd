//! The baselines through the stylizer where there is little to learn from. What they learn where there is enough is
//! tested with [`crate::transfer::Stylizer`] and, part by part, beside each of them.

use crate::database::{Database, DatabaseParts};
use crate::pose_vector::DOFS;
use crate::transfer::sine_walk::{BENT, Gait, NEUTRAL, database, walk};
use crate::transfer::{Method, Model, Options, Stylizer};
use std::sync::Arc;

const METHODS: [Method; 4] = [Method::GlobalAr, Method::Lti, Method::LtiJoint, Method::Gp];

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
        for method in METHODS {
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
                            assert!(height.abs() < 10.0, "{method:?}, {frames} frames: the hips are at {height} m");
                        }
                    }
                }
            }
        }
    }
}

/// What all styles share is kept, and threads that ask at once get the same predictor.
#[test]
fn a_predictor_is_trained_once_a_model() {
    let model = Model::new(sparse(60));
    let classes = [0, 1];
    let train = |style: usize| {
        let pairs = super::Pairs::new(model.database(), model.rows(), model.target_table(style), &classes);
        let predictor = model.baselines().predictor(super::Baseline::Gp, &pairs, 0.1);
        Arc::as_ptr(&predictor).cast::<()>() as usize
    };
    let first = train(1);
    let again: Vec<usize> =
        std::thread::scope(|s| [1, 1, 0].map(|style| s.spawn(move || train(style))).map(|t| t.join().unwrap()).into());
    assert_eq!(again[..2], [first; 2]);
    assert_ne!(again[2], first, "another style has its own");
}

/// With the input at rest an LTI system's output is at rest, wherever the predictor begins.
#[test]
fn memory_of_the_start_dies_out() {
    let model = Model::new(database());
    let pairs = super::Pairs::new(model.database(), model.rows(), model.target_table(1), &[0]);
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
