use super::em::EmTrainer;
use super::learning::Somn;
use super::mixture::{
    Component, FIRST_VARIANCE, Gate, SETTLING_ROUNDS, Samples, log_likelihood, posteriors, settle, squared_distance,
};
use super::*;
use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ as SINE_RATE_HZ, walk};
use crate::humanoid::{HumanoidMotion, Proportions};
use crate::incremental::IncrementalJob;
use crate::math::float_funcs::double;
use crate::math::random::SplitMix64;
use crate::parallel::Sequential;
use std::sync::{Arc, LazyLock};

/// A number from −1 to 1.
fn uniform(random: &mut SplitMix64) -> f64 {
    random.below(1 << 30) as f64 / f64::from(1 << 29) - 1.0
}

/// An approximately normal number of variance 1.
fn normal(random: &mut SplitMix64) -> f64 {
    (0..12).map(|_| 0.5 * uniform(random)).sum()
}

/// Two-dimensional poses on one of two lines, two fifths on the first and three on the second.
fn two_lines(seed: u64) -> Samples {
    let mut random = SplitMix64::new(seed);
    let mut samples = Samples { axes: 1, ..Samples::default() };
    for i in 0..2000 {
        let u = 3.0_f64.sqrt() * uniform(&mut random);
        let line = if i % 5 < 2 { [2.0 * u + 1.0, 0.5 * u] } else { [-u - 1.0, u - 1.0] };
        let mut row = [0.0; DIMS];
        row.iter_mut().zip(line).for_each(|(x, on)| *x = on + 0.05 * normal(&mut random));
        samples.rows.push(row);
        samples.styles.push([u, 0.0, 0.0]);
    }
    samples
}

fn recording(gait: &Gait) -> Recording {
    let motion = HumanoidMotion {
        proportions: Proportions::default(),
        rate_hz: SINE_RATE_HZ,
        poses: walk(gait, 600, 0.1).poses,
    };
    Recording::new("walk", &motion).unwrap()
}

fn axes(text: &str) -> Vec<Measure> {
    Measure::parse_list(text).unwrap()
}

/// Walks of three cadences, with measures of the feet as style.
static MODEL: LazyLock<Arc<KeyStyleModel>> = LazyLock::new(|| {
    let walks = [0.0, 3.0, 6.0].map(|more| recording(&Gait { period: NEUTRAL.period + more, ..NEUTRAL }));
    let walks: Vec<&Recording> = walks.iter().collect();
    Arc::new(train(&walks, &axes("foot_separation, foot_height_difference"), Options::default()).unwrap())
});

fn synthesis() -> Synthesis {
    Synthesis::new(Arc::clone(&MODEL))
}

/// The style at an angle of a circle about the mean, in standard deviations.
fn on_circle(radius: f64, angle: f64) -> Style {
    MODEL.in_units(&[radius * double::cos(angle), -radius * double::sin(angle), 0.0])
}

fn distance(a: &Row, b: &Row) -> f64 {
    squared_distance(a, b).sqrt()
}

#[test]
fn the_step_follows_the_gradient_of_the_likelihood() {
    let samples = two_lines(1);
    let mut network = Somn::new(&samples, 2, 20, 1, false);
    (0..3).for_each(|_| _ = network.pass(&samples));
    let (components, variance) = (network.components, 0.2);
    let gates = Gate::all(&components, 1).unwrap();
    let (x, u) = (&samples.rows[7], &samples.styles[7]);
    let likelihood = |components: &[Component]| log_likelihood((components, &gates), variance, x, u);
    let mut shares = [0.0; 2];
    posteriors((&components, &gates), variance, x, u, &mut shares);
    for (i, share) in shares.iter().enumerate() {
        let mut residual = [0.0; DIMS];
        components[i].predict(u, 1, &mut residual);
        residual.iter_mut().zip(x).for_each(|(e, x)| *e = x - *e);
        // A step of this rate is the gradient: r (x − Zv) vᵀ / σ².
        let mut stepped = components[i].clone();
        stepped.learn(&residual, u, 1, share / variance * (1.0 + u[0] * u[0]));
        for d in 0..2 {
            for slope in [false, true] {
                let number = |c: &mut Component, by: f64| {
                    let z = if slope { &mut c.slopes[0][d] } else { &mut c.mean[d] };
                    *z += by;
                    *z
                };
                let numerical = [1e-5, -1e-5].map(|h| {
                    let mut moved = components.clone();
                    number(&mut moved[i], h);
                    likelihood(&moved)
                });
                let numerical = (numerical[0] - numerical[1]) / 2e-5;
                let analytic = number(&mut stepped, 0.0) - number(&mut components[i].clone(), 0.0);
                assert!((numerical - analytic).abs() < 1e-6 * (1.0 + analytic.abs()), "{numerical} {analytic}");
            }
        }
    }
}

#[test]
fn two_lines_are_told_apart() {
    for seed in 0..3 {
        let samples = two_lines(seed);
        let mut network = Somn::new(&samples, 2, 20, seed, false);
        (0..20).for_each(|_| _ = network.pass(&samples));
        let mut components = network.components;
        let mut variance = FIRST_VARIANCE;
        (0..SETTLING_ROUNDS).for_each(|_| variance = settle(&samples, &mut components, variance, |_, _| {}));
        components.sort_by(|a, b| a.weight.total_cmp(&b.weight));
        for (component, (weight, slope, mean)) in
            components.iter().zip([(0.4, [2.0, 0.5], [1.0, 0.0]), (0.6, [-1.0, 1.0], [-1.0, -1.0])])
        {
            assert!((component.weight - weight).abs() < 0.02, "seed {seed}: {}", component.weight);
            for d in 0..2 {
                assert!(
                    (component.slopes[0][d] - slope[d]).abs() < 0.03,
                    "seed {seed}: {:?}",
                    &component.slopes[0][..2]
                );
                assert!((component.mean[d] - mean[d]).abs() < 0.03, "seed {seed}: {:?}", &component.mean[..2]);
            }
        }
    }
}

#[test]
fn with_the_printed_sign_it_diverges() {
    let samples = two_lines(1);
    let mut greatest = [0.0_f64; 2];
    for (greatest, sign) in greatest.iter_mut().zip([1.0, -1.0]) {
        let mut component = Somn::new(&samples, 1, 20, 1, false).components.remove(0);
        for (x, u) in samples.rows.iter().zip(&samples.styles) {
            let mut residual = [0.0; DIMS];
            component.predict(u, 1, &mut residual);
            residual.iter_mut().zip(x).for_each(|(e, x)| *e = x - *e);
            component.learn(&residual, u, 1, 0.1 * sign);
        }
        *greatest = component.mean.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    }
    assert!(greatest[0] < 3.0 && greatest[1] > 1e6, "{greatest:?}");
}

#[test]
fn a_single_map_is_that_of_least_squares() {
    let (learnt, held_out) = (two_lines(1), two_lines(2));
    let mut network = Somn::new(&learnt, 1, 20, 1, false);
    (0..20).for_each(|_| _ = network.pass(&learnt));
    let least_squares = EmTrainer::new(&learnt, 1, 0.0, 1);
    let [a, b] = [&network.components[0], &least_squares.components[0]].map(|component| {
        let squares = held_out.rows.iter().zip(&held_out.styles).map(|(x, u)| {
            let mut predicted = [0.0; DIMS];
            component.predict(u, 1, &mut predicted);
            squared_distance(x, &predicted)
        });
        squares.sum::<f64>().sqrt()
    });
    assert!((a / b - 1.0).abs() < 0.02, "{a} {b}");
}

#[test]
fn a_seed_gives_one_model_and_another_seed_another() {
    let walk = recording(&NEUTRAL);
    let model = |seed| train(&[&walk], &axes("foot_separation"), Options { seed, ..Options::default() }).unwrap();
    assert_eq!(model(1), model(1));
    assert_ne!(model(1).components, model(2).components);
}

#[test]
fn shares_stay_positive_and_whole() {
    let samples = two_lines(2);
    let mut network = Somn::new(&samples, 12, 20, 3, false);
    let whole = |components: &[Component]| {
        let sum: f64 = components.iter().map(|c| c.weight).sum();
        assert!((sum - 1.0).abs() < 1e-12 && components.iter().all(|c| c.weight > 0.0), "{sum}");
    };
    for _ in 0..20 {
        network.pass(&samples);
        whole(&network.components);
    }
    let mut em = EmTrainer::new(&samples, 12, 0.01, 3);
    for _ in 0..10 {
        em.round(&samples);
        whole(&em.components);
    }
}

/// Logarithm of the density of all poses with their styles.
fn joint_log_likelihood(samples: &Samples, em: &EmTrainer) -> f64 {
    let gates = Gate::all(&em.components, samples.axes).unwrap();
    let mut responsibilities = vec![0.0; gates.len()];
    let pairs = samples.rows.iter().zip(&samples.styles);
    pairs.map(|(x, u)| posteriors((&em.components, &gates), em.variance, x, u, &mut responsibilities)).sum()
}

#[test]
fn expectation_maximisation_never_lowers_the_likelihood() {
    let samples = two_lines(4);
    for components in [1, 2, 4] {
        let mut em = EmTrainer::new(&samples, components, 0.0, 1);
        let mut last = f64::NEG_INFINITY;
        for round in 0..15 {
            em.round(&samples);
            let likelihood = joint_log_likelihood(&samples, &em);
            assert!(likelihood >= last - 1e-3, "{components} components, round {round}: {likelihood} after {last}");
            last = likelihood;
        }
    }
}

#[test]
fn the_error_falls_while_learning_and_expectation_and_maximisation_raises_the_likelihood() {
    let walk = recording(&NEUTRAL);
    let mut trainer = Trainer::new(&[&walk], &axes("foot_separation"), Options::default()).unwrap();
    let mut progress = Vec::new();
    while let Ok(Some(p)) = trainer.step(&Sequential) {
        assert_eq!((p.done, p.total), (progress.len() + 1, 26));
        progress.push(p.error);
    }
    assert!(progress[19] < 0.7 * progress[0], "{progress:?}");

    let samples = two_lines(4);
    let mut em = EmTrainer::new(&samples, 4, 0.0, 1);
    let mut variances = Vec::new();
    for _ in 0..12 {
        em.round(&samples);
        variances.push(em.variance);
    }
    assert!(variances.windows(2).all(|w| w[1] < w[0] + 1e-4), "{variances:?}");
}

#[test]
fn half_the_change_of_style_is_half_the_change_of_pose() {
    let mut synthesis = synthesis();
    for i in 0..40 {
        let at = |s: &mut Synthesis, by: f64| s.row(&on_circle(1.0, 0.157 * f64::from(i) + by), Mode::default());
        let [here, whole, half] = [0.0, 0.02, 0.01].map(|by| at(&mut synthesis, by));
        let ratio = distance(&half, &here) / distance(&whole, &here);
        assert!((0.4..0.6).contains(&ratio), "{ratio}");
    }
}

#[test]
fn smooth_poses_jump_less_than_hard_ones() {
    let mut synthesis = synthesis();
    let mut greatest = |mode| {
        let rows: Vec<Row> = (0..2000).map(|i| synthesis.row(&on_circle(1.0, 0.00314 * f64::from(i)), mode)).collect();
        rows.windows(2).map(|w| distance(&w[0], &w[1])).fold(0.0, f64::max)
    };
    let (hard, smooth) = (greatest(Mode::Hard), greatest(Mode::default()));
    assert!(smooth < 0.3 * hard, "{smooth} {hard}");
}

#[test]
fn what_is_asked_for_is_what_is_measured() {
    let mut synthesis = synthesis();
    let mut off = [0.0; 2];
    for u in &MODEL.styles {
        let pose = synthesis.pose(&MODEL.in_units(u), Mode::default());
        let measured = MODEL.standardised(&synthesis.measured(&pose));
        (0..2).for_each(|j| off[j] += (measured[j] - u[j]).abs() / MODEL.styles.len() as f64);
    }
    assert!(off.iter().all(|off| *off < 0.1), "{off:?}");
}

#[test]
fn styles_that_do_not_say_the_pose_are_found_out() {
    assert!(MODEL.unexplained_share() < KeyStyleModel::MAX_UNEXPLAINED_SHARE, "{}", MODEL.unexplained_share());
    // The same poses with styles that are unrelated to them.
    let mut random = SplitMix64::new(1);
    let mut other = (**MODEL).clone();
    other.styles.iter_mut().for_each(|u| *u = [normal(&mut random), normal(&mut random), 0.0]);
    assert!(other.unexplained_share() > 0.9, "{}", other.unexplained_share());
}

#[test]
fn styles_beyond_reach_are_brought_back() {
    let mut synthesis = synthesis();
    let recorded = MODEL.in_units(&MODEL.styles[5]);
    let same = synthesis.within_reach(&recorded);
    assert!((0..2).all(|j| (same[j] - recorded[j]).abs() < 1e-9));
    for far in [100.0, -100.0, 1e300, f64::INFINITY, f64::NAN] {
        let reached = MODEL.standardised(&synthesis.within_reach(&MODEL.in_units(&[far, -far, 0.0])));
        let nearest =
            MODEL.styles.iter().map(|u| double::hypot(u[0] - reached[0], u[1] - reached[1])).fold(f64::MAX, f64::min);
        assert!(nearest <= 0.5 + 1e-9, "{far}: {nearest}");
        for mode in [Mode::Hard, Mode::default()] {
            let pose = synthesis.pose(&MODEL.in_units(&[far, -far, 0.0]), mode);
            assert!(pose.is_finite() && (synthesis.weights().iter().sum::<f64>() - 1.0).abs() < 1e-9);
        }
    }
    let [inside, outside] = [0.5, 30.0].map(|r| synthesis.support(&on_circle(r, 1.0)));
    assert!(outside < MODEL.least_support && inside > outside);
}

#[test]
fn key_poses_are_gone_through() {
    let mut synthesis = synthesis();
    let key = |i: usize| {
        let frame = 10 + 9 * i;
        let style = MODEL.in_units(&MODEL.styles[frame]);
        Key { secs: 0.3 * i as f64, style, row: Some(MODEL.recorded_row(frame)) }
    };
    let keys: Vec<Key> = (0..6).map(key).collect();
    for interpolation in [Interpolation::CatmullRom, Interpolation::Monotone] {
        let styling = KeyStyling::new(&keys, interpolation, &mut synthesis, Mode::default()).unwrap();
        for key in &keys {
            let row = |s: &mut Synthesis, method| styling.row(s, key.secs, method);
            let [hybrid, framed] = [Method::Hybrid, Method::KeyFrame].map(|m| row(&mut synthesis, m));
            let pose = key.row.unwrap();
            assert!(distance(&hybrid, &pose) < 1e-6 && distance(&framed, &pose) < 1e-6);
            assert!(distance(&row(&mut synthesis, Method::KeyStyle), &pose) > 1e-6);
        }
        let motion = styling.motion(&mut synthesis, Method::KeyStyle);
        assert_eq!((motion.poses.len(), motion.rate_hz), (46, RATE_HZ));
    }
}

#[test]
fn keys_that_are_none_are_refused() {
    let key = |secs: f64, u: f64| Key { secs, style: [u, 0.0, 0.0], row: None };
    let refused = |keys: &[Key]| {
        KeyStyling::new(keys, Interpolation::default(), &mut synthesis(), Mode::default()).unwrap_err().to_string()
    };
    assert!(refused(&[]).contains("there is no key"));
    assert!(refused(&[key(0.0, 1.0), key(1.0, f64::NAN)]).contains("key 2 holds a number that is not finite"));
    assert!(refused(&[key(f64::NAN, 1.0)]).contains("key 1 holds"));
    assert!(refused(&[key(0.5, 1.0), key(0.5, 2.0)]).contains("key 2 is at 0.5 s, not after the one before"));
    assert!(refused(&[key(0.0, 1.0), key(1e9, 2.0)]).contains("at most 3600 s"));
}

#[test]
fn what_cannot_be_learnt_from_is_refused_by_name() {
    let (walk, bent) = (recording(&NEUTRAL), recording(&BENT));
    let refused = |recordings: &[&Recording], text: &str| {
        train(recordings, &axes(text), Options::default()).unwrap_err().to_string()
    };
    let short = |poses: usize| walk.part(0..poses);
    assert!(refused(&[&short(10)], "hips_height").contains("10 frames together at 30 frames per second; at least 48"));
    assert!(refused(&[&short(1), &short(1)], "hips_height").contains("2 frames together"));
    assert!(refused(&[], "hips_height").contains("0 frames"));
    assert!(refused(&[&walk], "hips.x").contains("'hips.x' is 0.0 cm in every frame"));
    assert!(refused(&[&walk, &bent], "1 / hips.x").contains("'1 / hips.x' has no value in frame 1 of 'walk'"));
    assert!(refused(&[&walk], "hips_height, hips_height").contains("given twice"));
    assert!(refused(&[&walk], "foot_l.x, foot_l.y, foot_l.z, hips_height").contains("4 style variables"));
    let mut still = walk.clone();
    still.poses.fill(walk.poses[0]);
    still.frames.fill(walk.frames[0]);
    assert!(refused(&[&still], "foot_separation").contains("in every frame"));
}

#[test]
fn a_walk_travels_and_faces_where_it_goes_and_who_stays_faces_ahead() {
    let walk = recording(&NEUTRAL);
    assert!(walk.travels && (walk.frames[100].speed - walk.frames[200].speed).abs() < 0.2);
    let gait = Gait { swing: 0.0, knee: 0.0, ..NEUTRAL };
    let mut motion = HumanoidMotion {
        proportions: Proportions::default(),
        rate_hz: SINE_RATE_HZ,
        poses: crate::fixtures::walk(&gait, 200, 0.0).poses,
    };
    let turn = crate::math::Quat::from_rotation_y(2.0);
    for pose in &mut motion.poses {
        pose.rotations[0] = turn * pose.rotations[0];
        (pose.root.x, pose.root.z) = (3.0, -1.0);
    }
    let standing = Recording::new("standing", &motion).unwrap();
    assert!(!standing.travels);
    for frame in &standing.frames {
        let toes = frame.positions[crate::humanoid::Role::LeftToes.index()]
            - frame.positions[crate::humanoid::Role::LeftFoot.index()];
        assert!(toes.z > 0.5 * toes.length(), "{toes}");
    }
    motion.poses[3].root.y = f32::NAN;
    assert_eq!(Recording::new("broken", &motion), Err(RecordingError::NotFinite(4)));
    motion.poses.clear();
    assert_eq!(Recording::new("empty", &motion), Err(RecordingError::Empty));
}

#[test]
fn turning_the_style_in_a_circle_walks_and_the_standing_foot_stays() {
    let mut character = DragCharacter::new(Arc::clone(&MODEL));
    character.reset(&on_circle(1.2, 0.0));
    let turns = |direction: f64, character: &mut DragCharacter| {
        let from = character.pose().root.z;
        for i in 0..350 {
            character.drag(&on_circle(1.2, direction * std::f64::consts::TAU * f64::from(i) / 35.0), 1.0 / 30.0);
            assert!(character.planted().iter().any(|p| *p));
        }
        character.pose().root.z - from
    };
    let ways = [1.0, -1.0].map(|direction| turns(direction, &mut character));
    assert!(ways[0] * ways[1] < 0.0 && ways.iter().all(|way| way.abs() > 3.0), "{ways:?}");
}

#[test]
fn the_spring_arrives_and_stays() {
    let mut character = DragCharacter::new(Arc::clone(&MODEL));
    character.reset(&on_circle(1.0, 0.0));
    let target = synthesis().row(&on_circle(1.0, 0.4), Mode::default());
    let begin = distance(character.row(), &target);
    let mut distances = Vec::new();
    for _ in 0..60 {
        character.drag(&on_circle(1.0, 0.4), 1.0 / 60.0);
        distances.push(distance(character.row(), &target));
    }
    assert!(distances.windows(2).all(|w| w[1] < w[0]) && distances[0] < begin);
    // A critically damped spring has covered less than half of its distance after the half-life of the free decay.
    assert!(distances[6] < 0.7 * begin && distances[59] < 1e-3 * begin, "{distances:?}");
    for secs in [f64::NAN, -1.0, f64::INFINITY] {
        assert!(character.drag(&on_circle(1.0, 2.0), secs).is_finite());
    }
}

#[test]
fn a_recorded_style_is_nearest_to_itself() {
    let synthesis = synthesis();
    for frame in (0..MODEL.styles.len()).step_by(37) {
        let nearest = synthesis.nearest(&MODEL.in_units(&MODEL.styles[frame])).unwrap();
        // Another frame may have the same style.
        let apart: f64 = (0..MAX_AXES).map(|j| (MODEL.styles[nearest][j] - MODEL.styles[frame][j]).abs()).sum();
        assert!(apart < 1e-6, "frame {frame} is {apart} from frame {nearest}");
    }
    assert!(synthesis.nearest(&[f64::NAN, 1e9, 0.0]).is_some());
}

#[test]
fn a_dragged_character_takes_poses_unchanged_and_goes_back() {
    let mut character = DragCharacter::new(Arc::clone(&MODEL));
    for row in MODEL.rows.iter().take(60) {
        let row = row.map(f64::from);
        let taken = *character.take(&row, 1.0 / f64::from(RATE_HZ));
        assert_eq!(taken.rotations, MODEL.space.pose(&row).rotations);
    }
    assert!(character.pose().root.z > 0.3, "the feet carry it ahead");
    let before = *character.pose();
    character.go_back();
    assert_eq!((character.pose().root.x, character.pose().root.z), (0.0, 0.0));
    assert_eq!(character.pose().rotations, before.rotations);
}

#[test]
fn nothing_is_allocated_while_dragging() {
    let mut character = DragCharacter::new(Arc::clone(&MODEL));
    let counted = allocation_counter::measure(|| {
        for i in 0..100 {
            character.drag(&on_circle(1.0, 0.1 * f64::from(i)), 1.0 / 60.0);
        }
        character.measured();
    });
    assert_eq!(counted.count_total, 0);
}

/// Learning of `docs/methods/somn.md` §5 in plain loops over plain arrays.
fn plain_network(
    samples: &Samples,
    components: usize,
    passes: usize,
    seed: u64,
    updates: usize,
) -> Vec<(Vec<Vec<f64>>, f64)> {
    let square = |v: f64| v * v;
    let (n, axes) = (samples.rows.len(), samples.axes);
    let mean: Vec<f64> = (0..DIMS).map(|d| samples.rows.iter().map(|x| x[d]).sum::<f64>() / n as f64).collect();
    let total: f64 =
        samples.rows.iter().flat_map(|x| (0..DIMS).map(|d| square(x[d] - mean[d])).collect::<Vec<_>>()).sum();
    let deviation = (total / n as f64).sqrt();
    let mut random = SplitMix64::new(seed);
    let mut order: Vec<usize> = (0..n).collect();
    random.shuffle(&mut order);
    // Z = [W | mean] row by row, a, m, S.
    let mut z: Vec<Vec<Vec<f64>>> = (0..components)
        .map(|i| {
            (0..DIMS)
                .map(|d| {
                    let mut row = vec![0.0; axes + 1];
                    row[axes] = 0.9 * mean[d] + 0.1 * samples.rows[order[i % n]][d];
                    row
                })
                .collect()
        })
        .collect();
    let mut a = vec![1.0 / components as f64; components];
    let mut m: Vec<Vec<f64>> = (0..components).map(|i| samples.styles[order[i % n]][..axes].to_vec()).collect();
    let mut s = vec![vec![1.0; axes]; components];
    for t in 0..updates {
        if t % n == 0 {
            random.shuffle(&mut order);
        }
        let (x, u) = (&samples.rows[order[t % n]], &samples.styles[order[t % n]]);
        let f = t as f64 / (passes * n) as f64;
        let sigma = 0.5 * deviation * double::pow(0.08 / 0.5, f);
        let delta = 0.6 * double::pow(0.01 / 0.6, f);
        let v: Vec<f64> = u[..axes].iter().copied().chain([1.0]).collect();
        let vv: f64 = v.iter().map(|v| v * v).sum();
        let e: Vec<Vec<f64>> = z
            .iter()
            .map(|z| (0..DIMS).map(|d| x[d] - (0..=axes).map(|j| z[d][j] * v[j]).sum::<f64>()).collect())
            .collect();
        let p: Vec<f64> = (0..components)
            .map(|i| {
                let gate: f64 = (0..axes).map(|j| square(u[j] - m[i][j]) / s[i][j] + double::ln(s[i][j])).sum();
                double::ln(a[i]) - e[i].iter().map(|e| e * e).sum::<f64>() / (2.0 * sigma * sigma) - 0.5 * gate
            })
            .collect();
        let top = p.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = p.iter().map(|p| double::exp(p - top)).sum();
        for i in 0..components {
            let r = double::exp(p[i] - top) / sum;
            a[i] = (a[i] + 0.2 * delta * (r - a[i])).max(1e-6);
            if r > 1e-6 {
                for d in 0..DIMS {
                    for j in 0..=axes {
                        z[i][d][j] += delta * r * e[i][d] * v[j] / vv;
                    }
                }
                for j in 0..axes {
                    let off = u[j] - m[i][j];
                    m[i][j] += delta * r * off;
                    s[i][j] = (s[i][j] + delta * r * (off * off - s[i][j])).max(0.02);
                }
            }
        }
        let all: f64 = a.iter().sum();
        for a in &mut a {
            *a /= all;
        }
    }
    z.into_iter().zip(a).collect()
}

fn trainer(learning: Learning) -> Trainer {
    let walk = recording(&NEUTRAL);
    let options = Options { components: Some(5), seed: 3, learning };
    Trainer::new(&[&walk], &axes("foot_separation, foot_height_difference"), options).unwrap()
}

#[test]
fn updates_by_hand_make_the_same_model_as_training() {
    let [mut by_hand, mut mixed, at_once] = [(); 3].map(|()| trainer(Learning::Som));
    let [done, total] = by_hand.updates();
    assert_eq!(done, 0);
    assert_eq!(std::iter::from_fn(|| by_hand.update()).count(), total);
    assert_eq!((by_hand.updates(), by_hand.update()), ([total; 2], None));
    // A pass that was begun with `update` is completed by training.
    (0..total / 3).for_each(|_| _ = mixed.update());
    let of_all_passes = by_hand.so_far();
    let [by_hand, mixed, at_once] = [by_hand, mixed, at_once].map(|trainer| {
        let Ok(model) = trainer.finish(&Sequential);
        model
    });
    assert_eq!(by_hand, at_once);
    assert_eq!(mixed, at_once);
    assert_eq!(of_all_passes, at_once);
    // The results differ only by the single precision of the poses.
    let options = Options { components: Some(5), seed: 3, learning: Learning::Som };
    let Ok(anew) = Trainer::of_model(&at_once, options).unwrap().finish(&Sequential);
    assert_eq!(anew.rows, at_once.rows);
    for (a, b) in anew.components.iter().zip(&at_once.components) {
        assert!(distance(&a.mean, &b.mean) < 1e-4 && (a.weight - b.weight).abs() < 1e-4);
    }
}

#[test]
fn updates_are_those_of_the_plain_loop() {
    let samples = two_lines(4);
    let mut network = Somn::new(&samples, 3, 20, 4, false);
    for updates in [1, 10, 3000] {
        while network.seen() < updates {
            network.update(&samples);
        }
        for (component, (z, a)) in network.components.iter().zip(plain_network(&samples, 3, 20, 4, updates)) {
            assert!((component.weight - a).abs() < 1e-9, "{} {a}", component.weight);
            for (d, z) in z.iter().enumerate().take(3) {
                assert!((component.slopes[0][d] - z[0]).abs() < 1e-9 && (component.mean[d] - z[1]).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn an_update_says_what_it_did() {
    let mut trainer = trainer(Learning::Som);
    assert!(trainer.responsibilities().iter().all(|r| *r == 0.0));
    let (mut widths, mut rates) = (Vec::new(), Vec::new());
    let mut samples: Vec<usize> = Vec::new();
    while let Some(update) = trainer.update() {
        let shares = trainer.responsibilities().iter().sum::<f64>();
        assert!((shares - 1.0).abs() < 1e-12);
        assert!((trainer.components().iter().map(|c| c.weight).sum::<f64>() - 1.0).abs() < 1e-12);
        widths.push(update.width);
        rates.push(update.rate);
        samples.push(update.sample);
        assert!(update.error > 0.0);
    }
    assert!(widths.windows(2).chain(rates.windows(2)).all(|w| w[0] > w[1]));
    assert!((rates[0] - 0.6).abs() < 1e-12 && (rates[rates.len() - 1] / 0.01 - 1.0).abs() < 1e-2);
    // Every pass visits all poses in a different order.
    let frames = samples.len() / 20;
    let mut passes: Vec<Vec<usize>> = samples.chunks(frames).map(<[usize]>::to_vec).collect();
    assert_ne!(passes[0], passes[1]);
    for pass in &mut passes {
        pass.sort_unstable();
    }
    assert!(passes.iter().all(|pass| *pass == (0..frames).collect::<Vec<_>>()));
}

#[test]
fn the_printed_signs_diverge_and_nothing_breaks() {
    let mut printed = trainer(Learning::AsPrinted);
    let first = printed.update().unwrap().error;
    let mut last = first;
    while let Some(update) = printed.update() {
        last = update.error;
    }
    assert!(last.is_nan() || last >= 100.0 * first, "{first} {last}");
    // The diverged model is useless, but safe to use.
    let mut synthesis = Synthesis::new(Arc::new(printed.so_far()));
    _ = synthesis.recorded_error(Mode::KEYED);
    DragCharacter::new(Arc::clone(synthesis.model())).drag(&[0.0; 3], 0.1);
}

#[test]
fn modes_are_within_their_ranges() {
    assert_eq!(Mode::smooth(2.0, 0.3), Ok(Mode::default()));
    for (temperature, blur) in [(0.0, 0.0), (f64::NAN, 0.0), (101.0, 0.0), (1.0, -0.1), (1.0, f64::INFINITY)] {
        assert!(Mode::smooth(temperature, blur).is_err());
    }
    assert!(Mode::smooth(0.0, 0.0).unwrap_err().to_string().starts_with("the temperature is 0"));
    let mut synthesis = synthesis();
    for (temperature, blur) in [(0.0, 0.0), (-1.0, 0.3), (f64::NAN, f64::NAN), (1e-300, 1e300), (f64::INFINITY, -1.0)] {
        let error = synthesis.recorded_error(Mode::Smooth { temperature, blur });
        let shares: f64 = synthesis.weights().iter().sum();
        assert!(error.is_finite() && (shares - 1.0).abs() < 1e-9, "{temperature} {blur}: {error}, {shares}");
    }
    let [learnt, blunt] =
        [1.0, 50.0].map(|temperature| synthesis.recorded_error(Mode::Smooth { temperature, blur: 0.0 }));
    assert!(learnt < blunt, "{learnt} {blunt}");
}
