use super::*;
use crate::fixtures::{BENT, NEUTRAL, database, walk};
use crate::math::float_funcs::exp;
use crate::math::linear::solve_positive_definite;
use crate::pose_vector::DOFS;
use crate::registration::WarpMethod;
use crate::transfer::MAX_FEEDBACK;
use crate::transfer::class_weights::known;

const BENT_STYLE: [f32; 2] = [0.0, 1.0];
const FIT: FitSettings = FitSettings { dof: 0, k: 40, lambda: 0.1, noise: 0.0, taper: true };

fn lens(options: Options) -> Lens {
    let model = Arc::new(Model::new(database()));
    Lens::new(model, walk(&NEUTRAL, 150, 0.3).poses, options, &BENT_STYLE).unwrap()
}

/// One class only, and no option that changes the prediction of Eq. 7.
fn plain() -> Options {
    Options { action: Some(0), input_style: Some(0), coherence: false, tempo: 0.0, ..Options::DEFAULT }
}

/// β and the prediction in double precision from the definition, with the feedback limited as in `regression`.
fn dense(fit: &Fit, lambda: f64) -> ([f64; 3], f64) {
    let sum: f64 = fit.weights.iter().map(|&v| f64::from(v)).sum();
    let mean =
        |values: &[f32]| values.iter().zip(&fit.weights).map(|(&x, &v)| f64::from(x) * f64::from(v)).sum::<f64>() / sum;
    let columns = [&fit.x_previous, &fit.y_previous, &fit.x];
    let (means, target_mean) = (columns.map(|c| mean(c)), mean(&fit.y));
    let of = |column: usize, i: usize| f64::from(columns[column][i]) - means[column];
    let product = |f: &dyn Fn(usize) -> f64| (0..fit.x.len()).map(|i| f64::from(fit.weights[i]) * f(i)).sum::<f64>();
    let sigma = f64::from(fit.global_deviation);
    let ridge = lambda * sum * sigma * sigma;
    let gram = |a: usize, b: usize| product(&|i| of(a, i) * of(b, i)) + if a == b { ridge } else { 0.0 };
    let right = |a: usize| product(&|i| of(a, i) * (f64::from(fit.y[i]) - target_mean));
    let mut matrix: Vec<f64> = (0..9).map(|i| gram(i / 3, i % 3)).collect();
    let mut beta: Vec<f64> = (0..3).map(right).collect();
    solve_positive_definite(&mut matrix, &mut beta).unwrap();
    let limit = f64::from(MAX_FEEDBACK);
    if beta[1].abs() > limit {
        let b = beta[1].clamp(-limit, limit);
        let mut matrix = [gram(0, 0), gram(0, 2), gram(2, 0), gram(2, 2)];
        let mut two = [right(0) - b * gram(0, 1), right(2) - b * gram(2, 1)];
        solve_positive_definite(&mut matrix, &mut two).unwrap();
        beta = vec![two[0], b, two[1]];
    }
    let bias = f64::from(fit.bias);
    let rho = f64::from(Options::DEFAULT.rho);
    let known = [bias, rho * bias, bias];
    let predicted = (0..3).map(|i| beta[i] * (f64::from(fit.query[i]) - known[i] - means[i])).sum::<f64>();
    ([beta[0], beta[1], beta[2]], target_mean + predicted + rho * bias)
}

#[test]
fn neighbours_and_classes_are_those_of_the_stylizer() {
    let mut lens = lens(Options::DEFAULT);
    for frame in [2, 40, 149] {
        lens.look_at(frame);
        let class = lens.heaviest_class().unwrap();
        let own = lens.stylizer().trace().neighbours().map(|n| n.distance).collect::<Vec<f32>>();
        let found = lens.neighbours(class, own.len(), 5, &QueryChange::default()).unwrap();
        assert_eq!(found.iter().map(|n| n.square.sqrt()).collect::<Vec<f32>>(), own);
        let classes = lens.classes();
        let least = classes.iter().map(|c| c.mean_square).fold(f32::INFINITY, f32::min);
        let width = Options::DEFAULT.delta * (3.0 - 2.0 * known(least));
        let raw = classes.iter().map(|c| exp((least - c.mean_square) / (width * least)));
        let sum: f32 = raw.clone().filter(|w| *w > 2e-5).sum();
        for (class, raw) in classes.iter().zip(raw) {
            assert!((class.weight - raw / sum).abs() < 1e-4, "{class:?} {raw} of {sum}");
        }
    }
}

#[test]
fn a_fit_is_the_prediction_of_the_stylizer_and_that_of_a_dense_solution() {
    let mut lens = lens(plain());
    for frame in [30, 77, 120] {
        lens.look_at(frame);
        for dof in 0..DOFS {
            let fit = lens.fit(&FitSettings { dof, taper: false, ..FIT }).unwrap();
            assert_eq!(fit.predicted, lens.stylizer().predicted_row(1).unwrap()[dof], "frame {frame}, {dof}");
            let (beta, predicted) = dense(&fit, 0.1);
            let scale = f64::from(fit.global_deviation);
            assert!((f64::from(fit.predicted) - predicted).abs() < 1e-3 * scale, "{} {predicted}", fit.predicted);
            assert!(
                fit.beta.iter().zip(beta).all(|(a, b)| (f64::from(*a) - b).abs() < 5e-3),
                "{:?} {beta:?}",
                fit.beta
            );
        }
    }
}

#[test]
fn many_neighbours_and_a_large_ridge_give_the_mean() {
    let lens = lens(plain());
    let fit = lens.fit(&FitSettings { dof: 3, lambda: 1e9, ..FIT }).unwrap();
    assert!((fit.predicted - fit.means[3]).abs() < 1e-4 && fit.beta.iter().all(|b| b.abs() < 1e-4));
    let one = lens.fit(&FitSettings { dof: 3, k: 1, taper: false, ..FIT }).unwrap();
    assert_eq!((one.beta, one.rows.len()), ([0.0; 3], 1), "a single example has no slope");
}

#[test]
fn noise_belongs_to_a_row() {
    let lens = lens(plain());
    let clean = lens.fit(&FIT).unwrap();
    let noisy = lens.fit(&FitSettings { noise: 0.1, ..FIT }).unwrap();
    assert_eq!((&noisy.x, &noisy.rows), (&clean.x, &clean.rows), "inputs have none");
    let added: Vec<f32> = noisy.y.iter().zip(&clean.y).map(|(a, b)| a - b).collect();
    let deviation = (added.iter().map(|v| v * v).sum::<f32>() / added.len() as f32).sqrt();
    assert!((0.05..0.2).contains(&deviation), "{deviation}");
    let of_row = |row: usize| noisy.rows.iter().position(|&r| r == row);
    let both: Vec<(usize, usize)> =
        (0..noisy.rows.len()).filter_map(|i| Some((i, of_row(noisy.rows[i] - 1)?))).collect();
    assert!(!both.is_empty());
    assert!(both.iter().all(|&(i, before)| (noisy.y_previous[i] - noisy.y[before]).abs() < 1e-6));
}

/// Free-running prediction by definition, from fits at every frame.
#[test]
fn a_sweep_is_the_error_of_the_predictions_one_by_one() {
    let mut lens = lens(plain());
    let ideal = walk(&BENT, 150, 0.3).poses;
    let lambdas = [1e-3, 0.1, 10.0];
    let settings = FitSettings { dof: 3 * 14, k: 12, taper: false, ..FIT };
    let sweep = lens.sweep(&settings, &lambdas, &ideal).unwrap();
    let wanted: Vec<PoseRow> = Stream::new(lens.model(), &ideal).collect();
    for (lambda, error) in lambdas.into_iter().zip(&sweep) {
        let (mut sum, mut y) = (0.0, None);
        for (frame, wanted) in wanted.iter().enumerate().skip(2) {
            lens.look_at(frame);
            let mut fit = lens.fit(&FitSettings { lambda, ..settings }).unwrap();
            fit.query[1] = y.unwrap_or(fit.query[1]);
            let next = dense(&fit, lambda.into()).1;
            y = Some(next as f32);
            let error = next - f64::from(wanted[settings.dof]);
            sum += error * error;
        }
        let expected = (sum / 148.0).sqrt();
        // The sweep starts two frames earlier.
        assert!((f64::from(*error) - expected).abs() < 0.02 * expected, "λ {lambda}: {error} {expected}");
    }
    assert!(lens.sweep(&settings, &lambdas, &ideal[1..]).is_err());
}

#[test]
fn durations_and_votes_come_out_of_what_is_shown() {
    let mut lens = lens(plain());
    for frame in [30, 77, 120] {
        lens.look_at(frame);
        let timing = lens.timing(1).unwrap();
        let dt = lens.stylizer().frame().dt_secs;
        let voices = || timing.kernel.iter().zip(&timing.weights).map(|(g, v)| g * v);
        let shown = voices().zip(&timing.durations).map(|(w, secs)| w * secs).sum::<f32>() / voices().sum::<f32>();
        assert!((timing.duration.unwrap() - dt).abs() < 1e-6 && (shown - dt).abs() < 1e-6, "{shown} {dt}");
        let mean = timing.distances.iter().sum::<f32>() / timing.distances.len() as f32;
        assert!((timing.bandwidth - mean).abs() < 1e-4 * mean);
        let contacts = lens.contacts();
        for side in 0..2 {
            let total: f32 = contacts.voices.iter().map(|v| v[side]).sum();
            let stands = contacts.contacts.iter().zip(&contacts.voices).filter(|(c, _)| c[side]).map(|(_, v)| v[side]);
            assert!((stands.sum::<f32>() / total - contacts.votes[side]).abs() < 1e-5);
        }
    }
    assert_eq!(lens.timing(0), Err(LensError::NotActive { name: lens.model().catalogue().styles[0].clone() }));
}

#[test]
fn a_query_keeps_its_distances_when_it_moves_over_the_ground_and_not_when_time_runs_backwards() {
    let mut lens = lens(Options::DEFAULT);
    lens.look_at(70);
    let as_it_is = QueryChange::default();
    let here: Vec<Vec<f32>> = [1, 5, 9, 15].map(|s| lens.profile(0, s, &as_it_is).unwrap()).into();
    let moved = QueryChange::new([], 1.57, [1.0, -2.0], false).unwrap();
    let root = lens.query_pose(&moved).root - lens.input[70].root;
    assert!((root.x - 1.0).abs() < 1e-6 && (root.z + 2.0).abs() < 1e-6);
    for (s, here) in [1, 5, 9, 15].into_iter().zip(&here) {
        for (a, b) in lens.profile(0, s, &moved).unwrap().iter().zip(here) {
            assert!(a.is_nan() == b.is_nan() && (a.is_nan() || (a.sqrt() - b.sqrt()).abs() < 1e-4), "{s}: {a} {b}");
        }
    }
    let reversed = QueryChange { reversed: true, ..QueryChange::default() };
    let least = |squares: &[f32]| squares.iter().copied().fold(f32::INFINITY, f32::min);
    assert!((least(&lens.profile(0, 1, &reversed).unwrap()) - least(&here[0])).abs() < 1e-6, "a pose has no direction");
    assert!(least(&lens.profile(0, 9, &reversed).unwrap()) > 4.0 * least(&here[2]));
    let turned = QueryChange::new([(10, [0.5, 0.0, 0.0])], 0.0, [0.0; 2], false).unwrap();
    assert!(least(&lens.profile(0, 5, &turned).unwrap()) > least(&here[1]));
}

#[test]
fn what_is_not_there_is_an_error() {
    let (mut lens, change) = (lens(Options::DEFAULT), QueryChange::default());
    assert!(
        lens.profile(99, 5, &change).is_err()
            && lens.neighbours(99, 5, 5, &change).is_err()
            && lens.neighbours(0, usize::MAX, 5, &change).is_ok()
            && lens.timing(9).is_err()
    );
    assert!(lens.row_pose(1 << 20).is_err() && lens.row_pose(3).is_ok());
    assert!(lens.fit(&FitSettings { dof: DOFS, ..FIT }).is_err());
    assert!(lens.fit(&FitSettings { k: 0, ..FIT }).is_err());
    assert!(lens.fit(&FitSettings { lambda: f32::NAN, ..FIT }).is_err());
    assert!(lens.fit(&FitSettings { noise: -1.0, ..FIT }).is_err());
    assert!(QueryChange::new([(21, [0.0; 3])], 0.0, [0.0; 2], false).is_err());
    assert!(QueryChange::new([], f32::NAN, [0.0; 2], false).is_err());
    assert!(lens.set_options(Options { k: 0, ..Options::DEFAULT }).is_err());
    assert!(lens.set_styles(&[f32::NAN, 0.0]).is_err());
    assert_eq!(lens.frame(), 2);
    lens.look_at(usize::MAX);
    assert_eq!((lens.frame(), lens.rows().len()), (149, 150));
    let short = Lens::new(Arc::clone(lens.model()), vec![Pose::default(); 2], Options::DEFAULT, &BENT_STYLE);
    assert_eq!(short.unwrap_err(), LensError::TooShort { frames: 2, least: 3 });
}

#[test]
fn cycles_of_an_action_are_compared_and_their_counterparts_known() {
    let model = Arc::new(Model::new(database()));
    let warps = Warps::new(Arc::clone(&model), 0).unwrap();
    let style = |style: u16| model.catalogue().clips.iter().position(|c| c.action == 0 && c.style == style).unwrap();
    let stretch = |clip: usize| (clip, 10..=80);
    let (a, b) = (stretch(style(0)), stretch(style(1)));
    for by in [WarpMethod::Dtw, WarpMethod::Imw, WarpMethod::Linear] {
        let compared = warps.compare(&a, &b, by).unwrap();
        assert_eq!((compared.costs.len(), compared.warp.unwrap().len()), (71 * 71, 71));
    }
    let recorded = warps.recorded(&a, &b).unwrap();
    let row = model.catalogue().clips[a.0].first_frame + 40;
    let exact = model.catalogue().counterparts(row, 1).next().unwrap();
    assert_eq!(recorded[30], exact - (model.catalogue().clips[b.0].first_frame + 10) as f32);
    assert!(warps.compare(&a, &(b.0, 0..=1 << 20), WarpMethod::Dtw).is_err());
    assert!(warps.cycles(1 << 20).is_err() && warps.cycles(a.0).is_ok());
    assert!(Warps::new(model, 99).is_err());
}
