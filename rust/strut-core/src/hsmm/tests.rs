use super::*;
use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ as SINE_RATE_HZ, noise, walk};
use crate::humanoid::{HumanoidMotion, JOINTS, Pose, Proportions, Role};
use crate::incremental::IncrementalJob;
use crate::math::{Vec3, exp_map};
use crate::parallel::Sequential;
use std::sync::{Arc, LazyLock};

/// Thirty seconds of a gait with a slight tremor, so that no variance is zero.
fn track(gait: &Gait) -> Track {
    let (proportions, mut poses) = (Proportions::default(), walk(gait, 1800, 0.1).poses);
    let mut noise = noise(1).map(|v| 0.015 * v as f32);
    let mut random = || noise.next().unwrap();
    for rotation in poses.iter_mut().flat_map(|pose| &mut pose.rotations) {
        *rotation = *rotation * exp_map::exp(Vec3::new(random(), random(), random()));
    }
    Track::new(&HumanoidMotion { proportions, rate_hz: SINE_RATE_HZ, poses }).unwrap()
}

/// A model of gaits, trained on clips with steps of two durations.
fn model_of(gaits: &[(&str, Gait)]) -> WalkModel {
    let tracks: Vec<(&str, Track)> = gaits
        .iter()
        .flat_map(|(name, gait)| [0.0, 3.0].map(|more| (*name, track(&Gait { period: gait.period + more, ..*gait }))))
        .collect();
    let clips: Vec<LabelledClip> = tracks.iter().map(|(style, track)| LabelledClip { style, track }).collect();
    train(&Proportions::default(), &clips, Options::default(), &Sequential).unwrap()
}

/// Upright and bent walking.
static MODEL: LazyLock<WalkModel> = LazyLock::new(|| model_of(&[("upright", NEUTRAL), ("bent", BENT)]));

/// Runtime model of the first `styles` styles.
pub(crate) fn runtime(styles: usize) -> Arc<RuntimeWalkModel> {
    let mut model = MODEL.clone();
    model.styles.truncate(styles);
    model.means.truncate(styles);
    Arc::new(RuntimeWalkModel::new(&model))
}

pub(super) fn walker(weights: &[f32]) -> Walker {
    let mut walker = Walker::new(Arc::new(RuntimeWalkModel::new(&MODEL)));
    walker.set_styles(weights).unwrap();
    walker.reset(Vec3::ZERO, 0.0);
    walker
}

/// Mean angle between the joints of two poses, degrees, and the greatest.
fn angles(a: &[crate::math::Quat; JOINTS], b: &[crate::math::Quat; JOINTS]) -> (f32, f32) {
    let all: Vec<f32> = a.iter().zip(b).map(|(a, b)| a.inv_mul(*b).angle().to_degrees()).collect();
    (all.iter().sum::<f32>() / all.len() as f32, all.iter().copied().fold(0.0, f32::max))
}

#[test]
fn steps_alternate_and_last_half_a_cycle() {
    let steps = steps_of(&track(&NEUTRAL));
    assert!(steps.len() >= 50, "{}", steps.len());
    for pair in steps.windows(2) {
        assert_eq!(pair[0].side, pair[1].side.other());
        assert_eq!(pair[0].frames.end, pair[1].frames.start);
    }
    let lengths: Vec<usize> = steps.iter().map(|step| step.frames.len()).collect();
    assert!(lengths.iter().all(|length| length.abs_diff(16) <= 2), "{lengths:?}");
}

#[test]
fn clips_without_steps_are_refused_by_name() {
    let standing = Gait { swing: 0.0, knee: 0.0, arms: 0.0, ..NEUTRAL };
    let poses = walk(&standing, 200, 0.0).poses;
    let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: SINE_RATE_HZ, poses };
    assert!(matches!(Track::new(&motion), Err(TrackError::NoWay(_))));

    let poses = walk(&Gait { turn: 0.8, ..NEUTRAL }, 400, 0.0).poses;
    let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: SINE_RATE_HZ, poses };
    assert!(matches!(Track::new(&motion), Err(TrackError::Turns(_))));

    let (walking, mut gliding) = (track(&NEUTRAL), track(&NEUTRAL));
    let pose = gliding.positions[0];
    gliding.positions.fill(pose);
    let clips = [LabelledClip { style: "walks", track: &walking }, LabelledClip { style: "glides", track: &gliding }];
    let refused = train(&Proportions::default(), &clips, Options::default(), &Sequential);
    assert_eq!(refused.unwrap_err(), TrainError::NoStepInStyle("glides".into()));
}

#[test]
fn training_in_steps_gives_the_same_model() {
    let tracks = [track(&NEUTRAL), track(&BENT)];
    let clips: Vec<LabelledClip> =
        ["upright", "bent"].iter().zip(&tracks).map(|(style, track)| LabelledClip { style, track }).collect();
    let whole = train(&Proportions::default(), &clips, Options::default(), &Sequential).unwrap();
    let mut trainer = Trainer::new(&Proportions::default(), &clips, Options::default(), &Sequential).unwrap();
    let mut done = Vec::new();
    while let Ok(Some(progress)) = trainer.step(&Sequential) {
        assert_eq!(progress.total, 5);
        done.push(progress.done);
    }
    assert_eq!(done, [1, 2, 3, 4, 5]);
    assert_eq!(trainer.conclude(&Sequential), Ok(whole));
}

#[test]
fn drawn_durations_vary_about_the_means_and_come_again() {
    let lengths = |seed: Option<u32>| {
        let mut walker = walker(&[1.0, 0.0]);
        walker.set_variation(seed);
        let mut lengths = [0; 40];
        (0..400).for_each(|_| {
            walker.advance();
            if let Some(length) = lengths.get_mut(walker.step().0 as usize) {
                *length += 1;
            }
        });
        lengths[1..20].to_vec()
    };
    let distinct = |lengths: &[i32]| lengths.iter().collect::<std::collections::BTreeSet<_>>().len();
    assert_eq!(lengths(Some(3)), lengths(Some(3)));
    assert_ne!(lengths(Some(3)), lengths(Some(4)));
    assert!(distinct(&lengths(Some(3))) > distinct(&lengths(None)));
    let mean = |lengths: &[i32]| lengths.iter().sum::<i32>() as f32 / lengths.len() as f32;
    let ratio = mean(&lengths(Some(3))) / mean(&lengths(None));
    assert!((0.95..1.05).contains(&ratio), "{ratio}");
}

#[test]
fn feet_stand_in_turn_and_never_slide() {
    let mut walker = walker(&[0.5, 0.5]);
    let planted: Vec<[bool; 2]> = (0..300)
        .map(|_| {
            walker.advance();
            walker.planted()
        })
        .collect();
    assert!(planted.iter().all(|p| p[0] || p[1]), "somebody who walks always stands");
    let landings = |side: usize| planted.windows(2).filter(|w| !w[0][side] && w[1][side]).count();
    let steps = walker.step().0 as usize;
    for side in 0..2 {
        assert!(landings(side).abs_diff(steps / 2) <= 1, "{} landings in {steps} steps", landings(side));
    }
}

#[test]
fn a_joint_is_drawn_near_its_means() {
    let runtime = Arc::new(RuntimeWalkModel::new(&MODEL));
    let curve = JointCurve::new(&MODEL, &runtime, [&[1.0, 0.0]; SIDES], crate::humanoid::Role::LeftLowerLeg).unwrap();
    assert!((25..45).contains(&curve.points.len()), "{}", curve.points.len());
    let outside = curve.points.iter().filter(|p| (p.angle - p.mean).abs() > 2.5 * p.deviation).count();
    assert!(outside * 5 < curve.points.len(), "{outside} of {}", curve.points.len());
    let [least, greatest] = [f32::min as fn(f32, f32) -> f32, f32::max]
        .map(|extreme| curve.points.iter().map(|p| p.angle).reduce(extreme).unwrap());
    assert!(greatest - least > 0.3, "a knee bends");
}

#[test]
fn a_style_alone_is_itself_to_the_bit() {
    let average = MODEL.average();
    for style in 0..2 {
        let weights: Vec<f64> = (0..2).map(|s| f64::from(u8::from(s == style))).collect();
        assert_eq!(MODEL.mix(&average, &weights), MODEL.means[style]);
    }
    assert_eq!(MODEL.mix(&average, &[0.0, 0.0]), average);
}

#[test]
fn the_style_that_is_asked_for_is_walked() {
    let lean = |weights: &[f32]| {
        let mut walker = walker(weights);
        (0..120).map(|_| exp_map::log(walker.advance().rotations[2]).x).sum::<f32>() / 120.0
    };
    let [upright, bent, half, average] = [[1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [0.0, 0.0]].map(|w| lean(&w));
    assert!((upright - NEUTRAL.lean).abs() < 0.01 && (bent - BENT.lean).abs() < 0.01, "{upright} {bent}");
    assert!((half - 0.5 * (upright + bent)).abs() < 0.01 && (average - half).abs() < 0.01);
}

#[test]
fn what_touches_the_ground_stays_where_it_is() {
    for weights in [[1.0, 0.0], [0.0, 2.0], [-2.0, 1.0]] {
        let mut walker = walker(&weights);
        walker.set_turn(0.1);
        let mut last = None;
        for _ in 0..300 {
            walker.advance();
            let now = walker.contact().unwrap();
            if let Some((foot, point, at)) = last
                && (foot, point) == (now.0, now.1)
            {
                let moved: Vec3 = now.2 - at;
                assert!(moved.x * moved.x + moved.z * moved.z < 1e-10, "{moved}");
            }
            last = Some(now);
        }
    }
}

#[test]
fn an_hour_of_walking_neither_drifts_nor_grows() {
    /// Frames of an hour, and of the ten seconds at either end that are compared.
    const HOUR: usize = 3600 * RATE_HZ as usize;
    const ENDS: usize = 10 * RATE_HZ as usize;
    let mut walker = walker(&[0.6, 0.7]);
    let frames = |walker: &mut Walker| -> Vec<Pose> { (0..ENDS).map(|_| *walker.advance()).collect() };
    // The step length settles.
    frames(&mut walker);
    let first = frames(&mut walker);
    (0..HOUR - 3 * ENDS).for_each(|_| _ = walker.advance());
    let last = frames(&mut walker);
    let mean = |of: &dyn Fn(&Pose) -> f32, poses: &[Pose]| poses.iter().map(of).sum::<f32>() / poses.len() as f32;
    let height = |poses| mean(&|pose| pose.root.y, poses);
    assert!((height(&first) - height(&last)).abs() < 0.002, "{} {}", height(&first), height(&last));
    for joint in 0..JOINTS {
        let angle = |poses| mean(&|pose| pose.rotations[joint].angle(), poses);
        let drift = angle(&last) - angle(&first);
        // 0.009 rad was measured: the ends contain different parts of a step.
        assert!(drift.abs() < 0.02, "joint {joint}: {drift} rad");
    }
    let end = walker.pose().root;
    assert!(end.z > 1200.0 && end.x.abs() < 0.05 * end.z, "{end}");
}

#[test]
fn a_beat_is_kept() {
    for (weights, cadence) in [([1.0, 0.0], 100.0), ([-0.5, 1.5], 180.0), ([0.0, 1.0], 50.0)] {
        let mut walker = walker(&weights);
        walker.set_cadence(Some(cadence));
        (0..40).for_each(|_| _ = walker.advance());
        let from = walker.step().0;
        (0..1800).for_each(|_| _ = walker.advance());
        let steps = walker.step().0 - from;
        assert!(steps.abs_diff(cadence as u64) <= 1, "{steps} of {cadence}");
    }
}

#[test]
fn steps_come_to_end_on_the_beat() {
    let mut walker = walker(&[1.0, 0.0]);
    (0..50).for_each(|_| _ = walker.advance());
    // 120 steps a minute are 15 frames each; a beat is 8.2 frames from now.
    walker.set_beat(120.0, 8.2 / RATE_HZ);
    let strikes: Vec<u32> = (1..200)
        .filter(|_| {
            let step = walker.step().0;
            walker.advance();
            walker.step().0 != step
        })
        .collect();
    let off: Vec<f32> = strikes.iter().map(|frame| (*frame as f32 - 8.2 + 7.5).rem_euclid(15.0) - 7.5).collect();
    assert!(off.len() >= 11 && off[5..].iter().all(|off| off.abs() <= 0.7), "{off:?}");
}

#[test]
fn feet_may_differ_in_style() {
    let lean = |sides: [&[f32]; SIDES]| {
        let mut walker = walker(&[1.0, 0.0]);
        walker.plan_transition(4, 2, sides).unwrap();
        (0..100).for_each(|_| _ = walker.advance());
        let mut sums = [(0.0, 0.0); SIDES];
        for _ in 0..160 {
            let lean = exp_map::log(walker.advance().rotations[2]).x;
            let (sum, count) = &mut sums[walker.step().1 as usize];
            (*sum, *count) = (*sum + lean, *count + 1.0);
        }
        sums.map(|(sum, count)| sum / count)
    };
    let [left, right] = lean([&[1.0, 0.0], &[0.0, 1.0]]);
    assert!(right - left > 0.15, "{left} {right}");
    let [left, right] = lean([&[0.0, 1.0]; SIDES]);
    assert!((right - left).abs() < 0.05, "{left} {right}");
}

#[test]
fn a_transition_goes_through_its_steps() {
    let mut walker = walker(&[1.0, 0.0]);
    (0..60).for_each(|_| _ = walker.advance());
    let step = walker.next_step() + 2;
    walker.plan_transition(step, 3, [&[0.0, 1.0]; SIDES]).unwrap();
    let mut leans = Vec::new();
    while walker.step().0 < step + 6 {
        let lean = exp_map::log(walker.advance().rotations[2]).x;
        leans.push((walker.step().0, lean));
    }
    let mean = |number: u64| {
        let of: Vec<f32> = leans.iter().filter(|l| l.0 == number).map(|l| l.1).collect();
        of.iter().sum::<f32>() / of.len() as f32
    };
    for (number, share) in [(step - 1, 0.0), (step, 0.17), (step + 1, 0.5), (step + 2, 0.83), (step + 4, 1.0)] {
        let expected = NEUTRAL.lean + share * (BENT.lean - NEUTRAL.lean);
        assert!((mean(number) - expected).abs() < 0.06, "{number}: {} against {expected}", mean(number));
    }
}

#[test]
fn who_stops_stands_still_and_can_go_again() {
    let mut walker = walker(&[1.0, 0.0]);
    (0..100).for_each(|_| _ = walker.advance());
    walker.set_walking(false);
    (0..90).for_each(|_| _ = walker.advance());
    let stands = *walker.advance();
    for _ in 0..60 {
        let pose = walker.advance();
        assert!((pose.root - stands.root).length() < 1e-3 && angles(&pose.rotations, &stands.rotations).1 < 0.1);
    }
    walker.set_walking(true);
    let begin = walker.pose().root.z;
    (0..60).for_each(|_| _ = walker.advance());
    let mut other = super::tests::walker(&[1.0, 0.0]);
    (0..60).for_each(|_| _ = other.advance());
    // The walk starts in the first of the two seconds.
    let share = (walker.pose().root.z - begin) / other.pose().root.z;
    assert!((0.5..0.9).contains(&share), "{share}");
}

#[test]
fn strides_are_longer_where_that_is_asked_for() {
    let ways = [0.6, 0.75, 1.0, 1.2].map(|share| {
        let mut walker = walker(&[1.0, 0.0]);
        walker.set_stride(share);
        (0..300).for_each(|_| _ = walker.advance());
        walker.pose().root.z
    });
    assert!(ways.is_sorted() && ways[0] < 0.85 * ways[2], "{ways:?}");
}

/// Mean length of a walker's next steps, metres.
fn mean_step_length(walker: &mut Walker, steps: u64) -> f64 {
    let mut place_at = |step: u64| {
        while walker.next_step() < step {
            walker.advance();
        }
        walker.pose().root
    };
    let settled = 20;
    let from = place_at(settled);
    f64::from((place_at(settled + steps) - from).length()) / steps as f64
}

#[test]
fn steps_are_as_long_as_the_mixture_says() {
    let all = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [0.75, 0.25]];
    let off: Vec<_> = all
        .into_iter()
        .map(|weights| {
            let expected = MODEL.mix(&MODEL.average(), &weights.map(f64::from)).step_length;
            (weights, mean_step_length(&mut walker(&weights), 40) / expected - 1.0)
        })
        .collect();
    // 0.045 without the correction: step lengths do not mix like joint angles.
    assert!(off.iter().all(|(_, off)| off.abs() < 0.02), "{off:?}");
}

#[test]
fn steps_get_longer_all_the_way_where_legs_reach_their_limit() {
    // With twice the long style, the thighs would swing half as far again as recorded.
    let gaits = [("short", Gait { swing: 0.1, ..NEUTRAL }), ("long", Gait { swing: 0.7, ..NEUTRAL })];
    let model = model_of(&gaits);
    let [_, twice] = model.means[1].step_length_bends;
    assert!(twice < 0.0, "twice the long steps cannot be reached: {twice}");
    let runtime = Arc::new(RuntimeWalkModel::new(&model));
    let lengths: Vec<f64> = (-4..=8)
        .map(|quarter: i16| {
            let mut walker = Walker::new(Arc::clone(&runtime));
            walker.set_styles(&[0.0, 0.25 * f32::from(quarter)]).unwrap();
            mean_step_length(&mut walker, 40)
        })
        .collect();
    assert!(lengths.is_sorted(), "{lengths:.4?}");
    let asked = 2.0 * model.means[1].step_length - model.average().step_length + twice;
    let off = lengths[12] / asked - 1.0;
    // 0.19 with the proportional length.
    assert!(off.abs() < 0.03, "{off}");
}

#[test]
fn of_a_longer_stride_the_length_is_known() {
    let mut walker = walker(&[0.5, 0.5]);
    walker.set_stride(0.9);
    let (found, whole) = (mean_step_length(&mut walker, 40), MODEL.average().step_length);
    assert!((found / whole - 0.9).abs() < 0.005, "{found} of {whole}");
}

#[test]
fn models_that_do_not_know_their_lengths_walk_and_can_learn_them() {
    let mut old = MODEL.clone();
    for means in &mut old.means {
        (means.step_length, means.step_length_bends) = (0.0, [0.0; 2]);
    }
    let mut walker = Walker::new(Arc::new(RuntimeWalkModel::new(&old)));
    walker.set_styles(&[1.0, 0.0]).unwrap();
    assert!((mean_step_length(&mut walker, 20) / MODEL.means[0].step_length - 1.0).abs() < 0.02);
    assert_eq!(old.with_walked_lengths(&Sequential), *MODEL);
}

#[test]
fn transitions_are_not_heaped_up() {
    let mut walker = walker(&[1.0, 0.0]);
    let mut planned = 0;
    while planned < 100_000 && walker.plan_transition(1_000_000 + planned, 2, [&[0.0, 1.0]; SIDES]).is_ok() {
        planned += 1;
    }
    assert_eq!(planned, 1000);
    // Planned transitions continue, and `set_styles` makes room for new ones.
    walker.advance();
    walker.set_styles(&[1.0, 0.0]).unwrap();
    assert!(walker.plan_transition(4, 2, [&[0.0, 1.0]; SIDES]).is_ok());
}

#[test]
fn weights_that_are_none_change_nothing() {
    let mut walker = walker(&[1.0, 0.0]);
    assert_eq!(walker.set_styles(&[1.0]), Err(WeightsError::Count { found: 1, styles: 2 }));
    assert!(
        walker.set_styles(&[f32::NAN, 0.0]).is_err() && walker.plan_transition(9, 2, [&[9.0, 0.0]; SIDES]).is_err()
    );
    let mut other = super::tests::walker(&[1.0, 0.0]);
    (0..100).for_each(|_| assert_eq!(walker.advance(), other.advance()));
}

#[test]
fn nothing_is_allocated_while_walking() {
    let mut walker = walker(&[0.3, 0.4]);
    walker.set_stride(0.9);
    let counted = allocation_counter::measure(|| (0..400).for_each(|_| _ = walker.advance()));
    assert_eq!(counted.count_total, 0);
}

/// The most likely trajectory by definition: the normal equations of all terms in one dense matrix, eliminated with pivoting.
fn dense_trajectory(
    states: &[(usize, usize)],
    d: usize,
    means: &[StyleMeans; SIDES],
    variances: &PerState<Observation>,
    factors: [f64; 3],
) -> Vec<f64> {
    let n = states.len();
    let mut a = vec![vec![0.0; n + 1]; n];
    let windows: [&[(isize, f64)]; 3] = [&[(0, 1.0)], &[(-1, -0.5), (1, 0.5)], &[(-1, 1.0), (0, -2.0), (1, 1.0)]];
    for (t, &(side, state)) in states.iter().enumerate() {
        for (part, window) in windows.iter().enumerate() {
            if part > 0 && (t == 0 || t + 1 == n) {
                continue;
            }
            let weight = 1.0 / (factors[part] * variances[side][state][part][d]);
            let mean = means[side].means[side][state][part][d];
            let at = |by: isize| t.checked_add_signed(by).unwrap();
            for (i, x) in *window {
                for (j, y) in *window {
                    a[at(*i)][at(*j)] += weight * x * y;
                }
                a[at(*i)][n] += weight * x * mean;
            }
        }
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).unwrap();
        a.swap(k, pivot);
        let top = a[k].clone();
        for row in a.iter_mut().skip(k + 1) {
            let share = row[k] / top[k];
            (k..=n).for_each(|c| row[c] -= share * top[c]);
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|c| a[k][c] * x[c]).sum();
        x[k] = (a[k][n] - known) / a[k][k];
    }
    x
}

/// Weights of the steps of either foot, and their mixtures.
fn both<'a>(left: &'a [f32], right: &'a [f32]) -> ([&'a [f32]; SIDES], [StyleMeans; SIDES]) {
    let of = |weights: &[f32]| MODEL.mix(&MODEL.average(), &weights.iter().map(|w| f64::from(*w)).collect::<Vec<_>>());
    ([left, right], [of(left), of(right)])
}

fn path(weights: [&[f32]; SIDES], of: (Role, usize), options: PathOptions) -> JointPath {
    JointPath::new(&MODEL, &RuntimeWalkModel::new(&MODEL), weights, of, options).unwrap()
}

#[test]
fn a_path_is_the_solution_of_the_dense_system() {
    let (weights, means) = both(&[1.0, 0.0], &[0.3, 0.7]);
    for variance in [[1.0; 3], [1.0, 1000.0, 1000.0], [1.0, 1.0, 0.03], [0.001, 1.0, 1.0], [50.0, 0.2, 3.0]] {
        for rho in [[0.0; 2], [1.5, -2.0]] {
            let found = path(weights, (Role::LeftUpperLeg, 0), PathOptions { variance, rho });
            // The whole walk: two steps, the pair, four more; states end at the rounded sums of their durations.
            let (mut states, mut sum, mut begins) = (Vec::new(), 0.0, Vec::new());
            for step in 0..8 {
                begins.push(states.len());
                for (state, d) in found.durations[step % 2].iter().enumerate() {
                    sum += f64::from(*d);
                    let end = (sum.round() as usize).max(states.len() + 1);
                    states.resize(end, (step % 2, state));
                }
            }
            let dense = dense_trajectory(&states, 3 * Role::LeftUpperLeg.index(), &means, &MODEL.variances, variance);
            assert_eq!(found.points.len(), begins[4] - begins[2]);
            for (point, t) in found.points.iter().zip(begins[2]..) {
                assert!((f64::from(point.angle) - dense[t]).abs() < 1e-5, "{} {}", point.angle, dense[t]);
                assert_eq!((point.side as usize, point.state), states[t]);
            }
        }
    }
}

#[test]
fn a_path_without_changes_is_what_is_walked() {
    let (weights, _) = both(&[1.0, 0.0], &[1.0, 0.0]);
    let runtime = Arc::new(RuntimeWalkModel::new(&MODEL));
    let curve = JointCurve::new(&MODEL, &runtime, weights, Role::LeftUpperLeg).unwrap();
    let path = path(weights, (Role::LeftUpperLeg, curve.axis), PathOptions::default());
    assert_eq!(path.points.len(), curve.points.len());
    for (a, b) in path.points.iter().zip(&curve.points) {
        assert_eq!((a.mean, a.deviation, a.side, a.state), (b.mean, b.deviation, b.side, b.state));
        assert!((a.angle - b.angle).abs() < 0.02, "horizon and limits of joints: {} {}", a.angle, b.angle);
    }
}

#[test]
fn steps_give_way_by_their_durations_variances() {
    let (weights, _) = both(&[1.0, 0.0], &[1.0, 0.0]);
    let frames = |rho: [f32; 2]| {
        let path = path(weights, (Role::LeftUpperLeg, 0), PathOptions { rho, ..PathOptions::default() });
        path.durations.map(|step| step.iter().sum::<f32>())
    };
    let variance = MODEL.duration_variances[0].iter().sum::<f64>() as f32;
    let (plain, longer) = (frames([0.0; 2]), frames([0.5, 0.0]));
    assert!((longer[0] - plain[0] - 0.5 * variance).abs() < 1e-3, "{plain:?} {longer:?}");
    assert_eq!(longer[1], plain[1]);
}

#[test]
fn paths_of_what_is_no_number_are_refused() {
    let runtime = RuntimeWalkModel::new(&MODEL);
    let refused = |weights: &[f32], axis: usize, options: PathOptions| {
        JointPath::new(&MODEL, &runtime, [weights; 2], (Role::Head, axis), options).unwrap_err()
    };
    let plain = PathOptions::default();
    assert!(matches!(refused(&[1.0], 0, plain), PathError::Weights(WeightsError::Count { found: 1, styles: 2 })));
    assert_eq!(refused(&[1.0, 0.0], 3, plain), PathError::Axis(3));
    for bad in [0.0, -1.0, 1001.0, f64::NAN, f64::INFINITY] {
        let options = PathOptions { variance: [1.0, bad, 1.0], ..plain };
        assert!(matches!(refused(&[1.0, 0.0], 0, options), PathError::Variance(_)));
    }
    for bad in [f32::NAN, f32::INFINITY, -11.0] {
        assert!(matches!(refused(&[1.0, 0.0], 0, PathOptions { rho: [0.0, bad], ..plain }), PathError::Rho(_)));
    }
}
