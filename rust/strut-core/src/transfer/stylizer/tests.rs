//! Tests of all stages together, on the synthetic walks.

use super::*;
use crate::catalogue::Catalogue;
use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, Walk, database, walk};
use crate::humanoid::Role;
use crate::kinematics::world_from_local;
use crate::math::Vec3;
use crate::math::float_funcs::wrap_angle;
use crate::pose_vector::ROW;
use crate::transfer::{Footplant, Method, ground_clearance};

fn model() -> Arc<Model> {
    Arc::new(Model::new(database()))
}

fn stylizer(model: &Arc<Model>, bent: f32) -> Stylizer {
    let mut s = Stylizer::new(Arc::clone(model), Options::DEFAULT).unwrap();
    s.set_styles(&[0.0, bent]).unwrap();
    s
}

fn unseen_walk() -> Walk {
    walk(&Gait { period: 63.0, swing: 0.41, ..NEUTRAL }, 240, 0.15)
}

fn run(stylizer: &mut Stylizer, poses: &[Pose]) -> Vec<StyledFrame> {
    poses.iter().map(|p| *stylizer.push(p)).collect()
}

fn chest_lean(frame: &StyledFrame) -> f32 {
    let up = frame.pose.rotations[Role::Chest.index()] * Vec3::Y;
    crate::math::float_funcs::atan2(up.z, up.y)
}

#[test]
fn an_unlabelled_walk_becomes_the_style_and_takes_its_time() {
    let mut s = stylizer(&model(), 1.0);
    let input = unseen_walk();
    let frames = run(&mut s, &input.poses);
    let lean = frames[60..].iter().map(chest_lean).sum::<f32>() / 180.0;
    assert!((lean - BENT.lean).abs() < 0.05, "lean {lean}");
    let ratio = frames[239].time_out_secs / frames[239].time_in_secs;
    let expected = f64::from((BENT.period + 1.0) / (NEUTRAL.period + 1.0));
    assert!((ratio - expected).abs() < 0.04, "ratio {ratio}, expected {expected}");
    assert!(s.trace().class_weights[0] > 0.9, "{:?}", s.trace().class_weights);
    assert!((s.trace().class_weights.iter().sum::<f32>() - 1.0).abs() < 1e-5);
    assert_eq!(s.trace().neighbours().count(), 40);
}

#[test]
fn skipped_classes_would_have_changed_nothing() {
    let model = model();
    let input = unseen_walk().poses;
    let run = |least_weight| {
        let mut s = Stylizer::new(Arc::clone(&model), Options { least_weight, ..Options::DEFAULT }).unwrap();
        s.set_styles(&[0.0, 1.0]).unwrap();
        let mut classes = 0;
        let mut frames = Vec::new();
        for pose in &input {
            let pose = s.push(pose).pose;
            classes += s.trace().class_weights.iter().filter(|w| **w > 0.0).count();
            frames.push(world_from_local(&model.catalogue().proportions, &pose).positions);
        }
        (frames, classes)
    };
    let (skipping, few) = run(Options::DEFAULT.least_weight);
    let (complete, all) = run(0.0);
    assert_eq!(all, 4 * input.len());
    assert!(4 * few < 3 * all, "{few} of {all}");
    for (a, b) in skipping.iter().flatten().zip(complete.iter().flatten()) {
        assert!((*a - *b).length() < 1e-5, "{a} {b}");
    }
}

/// A window may be shorter than the frames over which the speed of a foot is measured, also at the start of a clip.
#[test]
fn windows_of_any_length_style() {
    for length in [1, 2, 3] {
        let index = crate::search::Index::with_window(&database(), length);
        let model = Arc::new(Model::of(Catalogue::with_index(database(), index)));
        let mut s = stylizer(&model, 1.0);
        // For the start of a clip of the database the search finds that start.
        for gait in [NEUTRAL, BENT] {
            s.reset(None);
            for frame in run(&mut s, &walk(&gait, 20, 0.0).poses) {
                assert!(frame.pose.is_finite(), "{length}");
            }
        }
    }
}

/// All methods without training. Those with training are tested in `strut-motion-evaluation`.
const METHODS: &[Method] = &[Method::Mar, Method::LocalAr, Method::NearestNeighbour, Method::Knn];

#[test]
fn every_method_styles() {
    let model = model();
    for &method in METHODS {
        let options = Options { method, action: Some(0), input_style: Some(0), ..Options::DEFAULT };
        let mut s = Stylizer::new(Arc::clone(&model), options).unwrap();
        s.set_styles(&[0.0, 1.0]).unwrap();
        let frames = run(&mut s, &unseen_walk().poses);
        let lean = frames[60..].iter().map(chest_lean).sum::<f32>() / 180.0;
        assert!((lean - BENT.lean).abs() < 0.06, "{method:?}: lean {lean}");
        let ratio = frames[239].time_out_secs / frames[239].time_in_secs;
        let expected = f64::from((BENT.period + 1.0) / (NEUTRAL.period + 1.0));
        assert!((ratio - expected).abs() < 0.04, "{method:?}: ratio {ratio}, expected {expected}");
    }
}

/// Whichever option is changed, and whenever, nothing of the previous options remains.
#[test]
fn options_that_are_set_later_give_the_bits_of_a_new_stylizer() {
    let (model, input) = (model(), unseen_walk());
    let changes: [fn(&mut Options); 11] = [
        |o| o.k = 12,
        |o| o.delta = 1.5,
        |o| o.least_weight = 0.1,
        |o| o.lambda = 3.0,
        |o| o.kappa = 0.5,
        |o| o.rho = 0.1,
        |o| o.tempo = 0.9,
        |o| o.coherence = false,
        |o| (o.timing, o.footplant) = (false, false),
        |o| o.action = Some(1),
        |o| o.input_style = Some(1),
    ];
    for (&method, other) in METHODS.iter().zip(METHODS.iter().cycle().skip(1)) {
        for (i, change) in changes.iter().enumerate() {
            let mut options = Options { method, ..Options::DEFAULT };
            let set_later = |from: Options, to: Options| {
                let mut s = Stylizer::new(Arc::clone(&model), from).unwrap();
                s.set_styles(&[0.0, 0.8]).unwrap();
                s.set_options(to).unwrap();
                run(&mut s, &input.poses[..12])
            };
            let before = options;
            change(&mut options);
            let fresh = set_later(options, options);
            assert!(set_later(before, options) == fresh, "{method:?}: option {i}");
            if i == 0 {
                assert!(
                    set_later(Options { method: *other, ..options }, options) == fresh,
                    "{method:?} after {other:?}"
                );
            }
        }
    }
}

#[test]
fn another_method_takes_over_in_the_middle() {
    let model = model();
    let input = unseen_walk().poses;
    let mut s = stylizer(&model, 1.0);
    run(&mut s, &input[..100]);
    s.set_options(Options { method: Method::Knn, ..Options::DEFAULT }).unwrap();
    let frames = run(&mut s, &input[100..]);
    let lean = frames[60..].iter().map(chest_lean).sum::<f32>() / 80.0;
    assert!((lean - BENT.lean).abs() < 0.05, "lean {lean}");
}

#[test]
fn half_a_style_is_half_way() {
    let model = model();
    let mean = |bent: f32| {
        let frames = run(&mut stylizer(&model, bent), &unseen_walk().poses);
        let lean = frames[60..].iter().map(chest_lean).sum::<f32>() / 180.0;
        (lean, frames[239].time_out_secs as f32)
    };
    let (none, half, full) = (mean(0.0), mean(0.5), mean(1.0));
    assert!((half.0 - 0.5 * (none.0 + full.0)).abs() < 0.01);
    assert!((half.1 - 0.5 * (none.1 + full.1)).abs() < 0.01);
    assert!(mean(1.4).0 > full.0 + 0.05, "exaggeration");
}

#[test]
fn a_ramp_of_weights_makes_no_jump() {
    let model = model();
    let input = unseen_walk();
    let largest_step = |frames: &[StyledFrame]| {
        let turn = |w: &[StyledFrame]| {
            let pairs = w[0].pose.rotations.iter().zip(&w[1].pose.rotations);
            pairs.map(|(a, b)| a.inv_mul(*b).angle()).fold(0.0, f32::max)
        };
        frames.windows(2).map(turn).fold(0.0, f32::max)
    };
    let mut s = stylizer(&model, 0.0);
    let ramp: Vec<StyledFrame> = input
        .poses
        .iter()
        .enumerate()
        .map(|(i, p)| {
            s.set_styles(&[0.0, ((i as f32 - 60.0) / 60.0).clamp(0.0, 1.0)]).unwrap();
            *s.push(p)
        })
        .collect();
    let constant = run(&mut stylizer(&model, 0.0), &input.poses);
    assert!(largest_step(&ramp) < 1.3 * largest_step(&constant) + 0.01);
}

#[test]
fn parts_take_different_styles() {
    let model = model();
    let mut s = stylizer(&model, 0.0);
    s.set_part_styles(BodyPart::Torso, Some(&[0.0, 1.0])).unwrap();
    let input = unseen_walk();
    let frames = run(&mut s, &input.poses);
    let neutral = run(&mut stylizer(&model, 0.0), &input.poses);
    let lean = frames[60..].iter().map(chest_lean).sum::<f32>() / 180.0;
    assert!((lean - BENT.lean).abs() < 0.05, "lean {lean}");
    assert_eq!(frames[200].time_out_secs, neutral[200].time_out_secs);
    let knee = Role::LeftLowerLeg.index();
    assert!(frames[200].pose.rotations[knee].dot(neutral[200].pose.rotations[knee]) > 0.9999);
}

#[test]
fn heading_passes_through() {
    let mut s = stylizer(&model(), 1.0);
    let input = walk(&Gait { turn: 0.8, ..NEUTRAL }, 180, 0.0);
    run(&mut s, &input.poses);
    let facing = s.frame().pose.rotations[0] * Vec3::Z;
    let turned = crate::math::float_funcs::atan2(facing.x, facing.z);
    assert!((wrap_angle(turned - 0.8 * 3.0)).abs() < 0.1, "{turned}");
}

#[test]
fn bad_frames_are_repaired_and_forgotten() {
    let model = model();
    let good = unseen_walk().poses;
    let mut bad = good.clone();
    bad[80].root.x = f32::NAN;
    bad[120].rotations[5].y = f32::INFINITY;
    bad[121].root.y = 1e30;
    let (mut s, mut t) = (stylizer(&model, 1.0), stylizer(&model, 1.0));
    let clean = run(&mut s, &good);
    let frames = run(&mut t, &bad);
    assert!(frames.iter().all(|f| f.pose.is_finite() && f.time_out_secs.is_finite()));
    assert_eq!(frames[239].repaired_total, 3);
    assert_eq!(frames.iter().filter(|f| f.repaired).count(), 3);
    let apart = clean[239].pose.rotations.iter().zip(&frames[239].pose.rotations).map(|(a, b)| a.inv_mul(*b).angle());
    assert!(apart.fold(0.0, f32::max) < 0.01, "the state recovers");
    let mut all_bad = stylizer(&model, 1.0);
    let nan = Pose { root: Vec3::NAN, ..Pose::default() };
    assert!(run(&mut all_bad, &[nan; 20]).iter().all(|f| f.pose.is_finite()));
}

#[test]
fn the_same_input_gives_the_same_bits_and_reset_forgets() {
    let model = model();
    let input = unseen_walk();
    let first = run(&mut stylizer(&model, 0.7), &input.poses);
    let mut s = stylizer(&model, 0.7);
    run(&mut s, &input.poses[50..90]);
    s.reset(None);
    assert_eq!(run(&mut s, &input.poses), first);
    s.reset(Some(Placement { x: 5.0, z: -3.0, heading: 1.0 }));
    let moved = run(&mut s, &input.poses);
    assert!((moved[0].pose.root - Vec3::new(5.0, first[0].pose.root.y, -3.0)).length() < 1e-5);
    assert!((moved[200].pose.rotations[4].dot(first[200].pose.rotations[4])) > 0.999_99);
}

#[test]
fn feet_neither_slide_nor_sink() {
    let model = model();
    let frames = run(&mut stylizer(&model, 1.0), &unseen_walk().poses);
    let db = model.catalogue();
    let soles = crate::kinematics::Soles::new(&db.proportions);
    let (mut travel, mut secs) = (0.0, 0.0);
    for w in frames[10..].windows(2) {
        let worlds = [0, 1].map(|i| world_from_local(&db.proportions, &w[i].pose));
        for side in 0..2 {
            if w[0].planted[side] && w[1].planted[side] {
                travel += soles.of(&worlds[1], side).pivot_travel(&soles.of(&worlds[0], side)).length();
                secs += 1.0 / RATE_HZ;
            }
        }
        assert!(ground_clearance(&db.proportions, &w[1].pose) > -1e-3);
    }
    assert!(secs > 2.0, "feet are planted half of the time at least: {secs} s");
    assert!(travel / secs < 0.02, "{} m/s", travel / secs);
}

#[test]
fn nothing_is_allocated_after_the_first_frames() {
    let (model, input) = (model(), unseen_walk());
    let allocations = || {
        let mut s = stylizer(&model, 0.6);
        s.set_part_styles(BodyPart::LeftArm, Some(&[0.5, 0.2])).unwrap();
        run(&mut s, &input.poses[..10]);
        let push = |pose| _ = s.push(pose);
        allocation_counter::measure(|| input.poses[10..].iter().for_each(push)).count_total
    };
    // The model keeps the targets that are read for the first time.
    assert!(allocations() > 0);
    assert_eq!(allocations(), 0);
}

#[test]
fn a_label_that_no_class_has_is_refused() {
    let options = Options { action: Some(7), ..Options::DEFAULT };
    assert!(matches!(Stylizer::new(model(), options), Err(OptionsError::NoClass { .. })));
}

#[test]
fn coherence_smooths_foreign_input_and_leaves_known_input_alone() {
    let model = model();
    let pass = |gait: &Gait, coherence: bool| {
        let options = Options { coherence, footplant: false, ..Options::DEFAULT };
        let mut s = Stylizer::new(Arc::clone(&model), options).unwrap();
        s.set_styles(&[0.0, 1.0]).unwrap();
        run(&mut s, &walk(gait, 240, 0.15).poses)
    };
    // Mean second difference of all rotations: a measure of jitter.
    let roughness = |frames: &[StyledFrame]| {
        let step = |a: &StyledFrame, b: &StyledFrame| {
            let pairs = a.pose.rotations.iter().zip(b.pose.rotations);
            pairs.map(|(a, b)| crate::math::exp_map::log(a.inv_mul(b))).collect::<Vec<_>>()
        };
        let change = |w: &[StyledFrame]| {
            let (first, second) = (step(&w[0], &w[1]), step(&w[1], &w[2]));
            first.iter().zip(second).map(|(a, b)| (b - *a).length()).sum::<f32>()
        };
        frames.windows(3).map(change).sum::<f32>()
    };
    let foreign = Gait { arms: 1.4, knee: 1.4, period: 50.0, ..NEUTRAL };
    let (with, without) = (pass(&foreign, true), pass(&foreign, false));
    assert!(roughness(&with) < 0.9 * roughness(&without), "{} {}", roughness(&with), roughness(&without));
    let known = Gait { period: 63.0, ..NEUTRAL };
    let (with, without) = (pass(&known, true), pass(&known, false));
    let apart = |(a, b): (&StyledFrame, &StyledFrame)| {
        let pairs = a.pose.rotations.iter().zip(&b.pose.rotations);
        pairs.map(|(a, b)| a.inv_mul(*b).angle()).fold(0.0, f32::max)
    };
    let largest = with[30..].iter().zip(&without[30..]).map(apart).fold(0.0, f32::max);
    assert!(largest < 0.03, "{largest} rad");
}

#[test]
fn labels_restrict_the_classes_one_by_one() {
    let model = model();
    let input = unseen_walk();
    for (action, input_style) in [(None, None), (Some(0), None), (None, Some(0)), (Some(0), Some(0))] {
        let mut s = Stylizer::new(Arc::clone(&model), Options { action, input_style, ..Options::DEFAULT }).unwrap();
        s.set_styles(&[0.0, 1.0]).unwrap();
        let mut lean = 0.0;
        for (i, pose) in input.poses.iter().enumerate() {
            let frame = *s.push(pose);
            lean += if i < 60 { 0.0 } else { chest_lean(&frame) / 180.0 };
            for (class, &weight) in model.catalogue().classes().iter().zip(s.trace().class_weights) {
                let allowed = action.is_none_or(|a| a == class.action) && input_style.is_none_or(|x| x == class.style);
                assert!(allowed || weight == 0.0, "{action:?} {input_style:?}: {class:?} weighs {weight}");
            }
        }
        assert!((lean - BENT.lean).abs() < 0.05, "{action:?} {input_style:?}: lean {lean}");
    }
}

#[test]
fn distances_are_linear_and_durations_monotone_in_the_weight() {
    let model = model();
    let input = unseen_walk();
    let passes: Vec<Vec<StyledFrame>> =
        [0.0, 0.25, 0.5, 0.75, 1.0].map(|w| run(&mut stylizer(&model, w), &input.poses)).into();
    let lean = |frames: &[StyledFrame]| frames[60..].iter().map(chest_lean).sum::<f32>() / 180.0;
    let whole = lean(&passes[4]) - lean(&passes[0]);
    for (quarter, frames) in passes.iter().enumerate() {
        let part = lean(frames) - lean(&passes[0]);
        assert!((part / whole - 0.25 * quarter as f32).abs() < 0.02, "{quarter} quarters: {part} of {whole}");
    }
    assert!(passes.windows(2).all(|p| p[0][239].time_out_secs < p[1][239].time_out_secs));
}

#[test]
fn durations_of_classes_mix_like_their_poses() {
    let model = model();
    let secs = |action, delta| {
        let options = Options { action, delta, input_style: Some(0), tempo: 0.0, ..Options::DEFAULT };
        let mut s = Stylizer::new(Arc::clone(&model), options).unwrap();
        s.set_styles(&[0.0, 1.0]).unwrap();
        run(&mut s, &unseen_walk().poses)[239].time_out_secs
    };
    let (walk, fast) = (secs(Some(0), 0.7), secs(Some(1), 0.7));
    let (sure, torn) = (secs(None, 0.7), secs(None, 100.0));
    assert!(fast < walk, "the bent run is less slow than the bent walk: {fast} {walk}");
    assert!((sure - walk).abs() < 0.1 * (walk - fast), "{sure} is the walk's {walk}");
    assert!(fast < torn && torn < sure, "{fast} {torn} {sure}");
}

/// A style with one clip of 80 frames, and input that is unlike both clips.
#[test]
fn sparse_data_and_foreign_input_do_not_diverge() {
    let full = database();
    let mut parts = crate::database::DatabaseParts::clone(&full);
    let kept: Vec<_> = [0, 2].map(|c| full.clips[c].first_frame..full.clips[c].first_frame + 80).into();
    let rows = || kept.iter().cloned().flatten();
    parts.clips = [0, 2].map(|c| full.clips[c].clone()).into();
    for (clip, first_frame) in parts.clips.iter_mut().zip([0, 80]) {
        (clip.first_frame, clip.frames) = (first_frame, 80);
    }
    parts.actions.truncate(1);
    parts.pose = rows().map(|r| full.pose[r]).collect();
    parts.point_cloud = rows().map(|r| full.point_cloud[r]).collect();
    parts.canonical_time = rows().map(|r| full.canonical_time[r]).collect();
    parts.time_step = rows().map(|r| full.time_step[r]).collect();
    parts.contact = rows().map(|r| full.contact[r]).collect();
    parts.counterparts_per_style = 1;
    parts.counterpart = rows()
        .flat_map(|row| [0, 1].map(|style| (row, style)))
        .map(|(row, style)| {
            let at = full.counterparts(row, style).next().unwrap();
            let clip = usize::from(style);
            (at - kept[clip].start as f32).min(79.0) + 80.0 * clip as f32
        })
        .collect();
    let model = Arc::new(Model::new(crate::database::Database::new(parts).unwrap()));
    let wild = Gait { period: 30.0, swing: 0.9, knee: 1.8, lean: -0.4, arms: 1.5, turn: 1.5 };
    let input = walk(&wild, 300, 0.4);
    for bent in [1.0, -1.0, 2.0] {
        let frames = run(&mut stylizer(&model, bent), &input.poses);
        for (frame, pose) in frames.iter().zip(&input.poses) {
            let pairs = frame.pose.rotations.iter().zip(&pose.rotations).skip(1);
            let apart = pairs.map(|(a, b)| a.inv_mul(*b).angle()).fold(0.0, f32::max);
            // The measured value was 1.27 rad.
            assert!(frame.pose.is_finite() && apart < 1.5, "{bent}: {apart} rad from the input");
        }
    }
}

/// The online footplant measures speeds in output time, which the style stretches.
#[test]
fn the_footplant_runs_in_output_time() {
    let model = model();
    let input = unseen_walk();
    let planted = run(&mut stylizer(&model, 1.0), &input.poses);
    let mut unplanted = Stylizer::new(Arc::clone(&model), Options { footplant: false, ..Options::DEFAULT }).unwrap();
    unplanted.set_styles(&[0.0, 1.0]).unwrap();
    let mut footplant = Footplant::new(model.catalogue().proportions);
    for (frame, pose) in planted.iter().zip(&input.poses) {
        let mut expected = *unplanted.push(pose);
        let dt_secs = if expected.dt_secs > 0.0 { expected.dt_secs } else { 1.0 / RATE_HZ };
        expected.planted = footplant.apply(&mut expected.pose, expected.contact_out, dt_secs);
        assert_eq!(*frame, expected);
    }
}

#[test]
fn durations_and_contacts_that_are_not_finite_are_replaced() {
    let mut s = stylizer(&model(), 0.5);
    run(&mut s, &unseen_walk().poses[..20]);
    for bad in [f32::NAN, f32::INFINITY] {
        let replaced = Predicted { row: [0.0; ROW], step_secs: 1.0 / RATE_HZ, contact: [0.0; 2] };
        s.styles[1].now.step_secs = bad;
        s.replace_unusable(&replaced.row);
        assert_eq!(s.styles[1].now, replaced, "{bad}");
        s.styles[1].now.contact = [bad; 2];
        s.replace_unusable(&replaced.row);
        assert_eq!(s.styles[1].now, replaced, "{bad}");
    }
}

#[test]
fn a_share_of_nothing_is_the_input_and_half_is_half_way() {
    let model = model();
    let input = unseen_walk().poses;
    let with_share = |share| {
        let mut s = stylizer(&model, 1.0);
        s.set_options(Options { footplant: false, ..Options::DEFAULT }).unwrap();
        s.set_style_share(share);
        run(&mut s, &input)
    };
    let [none, half, whole] = [0.0, 0.5, 1.0].map(with_share);
    for (frame, pose) in none.iter().zip(&input) {
        let turned = frame.pose.rotations.iter().zip(&pose.rotations).map(|(a, b)| a.inv_mul(*b).angle());
        assert!(turned.fold(0.0, f32::max) < 0.1_f32.to_radians());
        assert!(frame.pose.root.distance(pose.root) < 5e-4, "{} {}", frame.pose.root, pose.root);
    }
    let secs = [&none, &half, &whole].map(|frames| frames.last().unwrap().time_out_secs);
    assert!((secs[1] - 0.5 * (secs[0] + secs[2])).abs() < 1e-3, "{secs:?}");
    let leans = [&none, &half, &whole].map(|frames| chest_lean(&frames[120]));
    assert!((leans[1] - 0.5 * (leans[0] + leans[2])).abs() < 0.01, "{leans:?}");
}
