//! Motion that is unlike the database: the protocol of `docs/methods/mar.md` §12, second table.
//!
//! Without a ground truth, three numbers together measure the quality of the result: its roughness relative to the
//! input, the remaining content of the input, and the distance of the output from the input.

use strut_core::database::build::headings;
use strut_core::humanoid::HumanoidMotion;
use strut_core::math::Vec3;
use strut_core::metrics::{Points, pose_error};
use strut_core::pose_vector::point_cloud;

/// Length of the moving average that [`content_correlation`] subtracts, seconds.
pub const HIGH_PASS_SECS: f32 = 0.5;

/// Measures of the result for a clip that is unlike the database.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OffDatabase {
    /// Ratio of [`mean_acceleration`] of the output to the input's: 1 is as smooth as the input.
    pub acceleration_ratio: f32,
    /// [`content_correlation`] of output and input: 1 means that the input's content is kept completely.
    pub correlation: f32,
    /// [`pose_error`] between output and input, metres: 0 means no style.
    pub distance: f32,
}

/// Measures of two clips whose frames correspond: frame i of the output is the styled frame i of the input, before feet
/// are planted and independent of its output time.
pub fn compare(input: &HumanoidMotion, output: &HumanoidMotion) -> OffDatabase {
    let (before, after) = (heading_free_points(input), heading_free_points(output));
    let window = (HIGH_PASS_SECS * input.rate_hz) as usize | 1;
    OffDatabase {
        acceleration_ratio: mean_acceleration(&after) / mean_acceleration(&before).max(f32::MIN_POSITIVE),
        correlation: content_correlation(&before, &after, window),
        distance: pose_error(&before, &after),
    }
}

/// The joints of every frame with the hips above the origin and the heading removed, metres.
pub fn heading_free_points(motion: &HumanoidMotion) -> Vec<Points> {
    let headings = headings(motion);
    motion.poses.iter().zip(headings).map(|(p, heading)| point_cloud(&motion.proportions, p, heading)).collect()
}

/// Mean magnitude of the second difference over joints and frames, metres per squared frame; 0 for fewer than 3 frames.
pub fn mean_acceleration(points: &[Points]) -> f32 {
    let accelerations = points
        .windows(3)
        .flat_map(|w| w[0].iter().zip(&w[1]).zip(&w[2]).map(|((a, b), c)| f64::from((*c - 2.0 * *b + *a).length())));
    let (sum, count) = accelerations.fold((0.0, 0_usize), |(sum, count), a| (sum + a, count + 1));
    (sum / count.max(1) as f64) as f32
}

/// Share of the fast content of `input` that is in `output`. Both are high-pass filtered (every joint relative to the
/// hips, minus its centred moving average over `window` frames, an odd number; shorter at the ends), and the
/// correlation coefficient is computed over all joints, axes and frames together.
///
/// The mean of a high-pass filtered track is negligible, so that the coefficient is Σab / √(Σa² Σb²); 0 if either does
/// not move.
pub fn content_correlation(input: &[Points], output: &[Points], window: usize) -> f32 {
    let (a, b) = (high_passed(input, window), high_passed(output, window));
    let (mut ab, mut aa, mut bb) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        ab += f64::from(a.dot(*b));
        aa += f64::from(a.length_squared());
        bb += f64::from(b.length_squared());
    }
    let scale = (aa * bb).sqrt();
    if scale > 0.0 { (ab / scale) as f32 } else { 0.0 }
}

/// Joints relative to the hips, minus their centred moving average.
fn high_passed(points: &[Points], window: usize) -> Vec<Points> {
    let relative: Vec<Points> = points.iter().map(|p| p.map(|joint| joint - p[0])).collect();
    let reach = window / 2;
    (0..relative.len())
        .map(|i| {
            let around = &relative[i.saturating_sub(reach)..(i + reach + 1).min(relative.len())];
            let share = 1.0 / around.len() as f32;
            std::array::from_fn(|j| relative[i][j] - around.iter().map(|p| p[j]).sum::<Vec3>() * share)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Gait, NEUTRAL, RATE_HZ, database, walk};
    use crate::quality::{Mode, quality, style};
    use std::sync::Arc;
    use strut_core::math::float_funcs::sin;
    use strut_core::transfer::{Model, Options, Stylizer};

    fn clip(gait: &Gait) -> HumanoidMotion {
        let proportions = strut_core::humanoid::Proportions::default();
        HumanoidMotion { proportions, rate_hz: RATE_HZ, poses: walk(gait, 180, 0.0).poses }
    }

    #[test]
    fn a_clip_is_itself() {
        let walk = clip(&NEUTRAL);
        let same = compare(&walk, &walk);
        assert_eq!((same.acceleration_ratio, same.distance), (1.0, 0.0));
        assert!((same.correlation - 1.0).abs() < 1e-6);
    }

    /// A joint that oscillates with a period of `frames` frames about `rest`.
    fn swinging(frames: f32, phase: f32, rest: f32) -> Vec<Points> {
        let track = |i: usize| {
            let mut points = [Vec3::ZERO; strut_core::humanoid::JOINTS];
            points[4].y = rest + sin(std::f32::consts::TAU * (i as f32 / frames + phase));
            points
        };
        (0..300).map(track).collect()
    }

    #[test]
    fn rest_and_slow_drift_are_no_content_and_rhythm_is() {
        let fast = swinging(15.0, 0.0, 0.3);
        assert!((content_correlation(&fast, &swinging(15.0, 0.0, -2.0), 31) - 1.0).abs() < 1e-3);
        assert!(content_correlation(&fast, &swinging(15.0, 0.25, 0.3), 31).abs() < 0.02, "a quarter out of step");
        let drifting: Vec<Points> =
            fast.iter().zip(swinging(600.0, 0.0, 0.0)).map(|(a, b)| std::array::from_fn(|j| a[j] + b[j])).collect();
        assert!(content_correlation(&fast, &drifting, 31) > 0.99);
        assert_eq!(content_correlation(&fast, &vec![[Vec3::ONE; strut_core::humanoid::JOINTS]; 300], 31), 0.0);
    }

    #[test]
    fn acceleration_of_a_parabola_is_constant() {
        let fall = |i: usize| [Vec3::new(0.0, 0.5 * (i * i) as f32, 0.0); strut_core::humanoid::JOINTS];
        assert!((mean_acceleration(&(0..20).map(fall).collect::<Vec<_>>()) - 1.0).abs() < 1e-4);
        assert_eq!(mean_acceleration(&[fall(0), fall(1)]), 0.0);
    }

    #[test]
    fn foreign_content_survives_with_rho_and_the_style_is_seen() {
        let model = Arc::new(Model::new(database()));
        // Arms that swing three times as far as any walk of the database, and a deeper bend.
        let input = clip(&Gait { arms: 1.4, knee: 1.4, ..NEUTRAL });
        let run = |rho| {
            let mut stylizer = Stylizer::new(Arc::clone(&model), Options { rho, ..Options::DEFAULT }).unwrap();
            stylizer.set_styles(&[0.0, 1.0]).unwrap();
            quality(&input, &style(&stylizer, &input, Mode::Offline))
        };
        let (none, most) = (run(0.0), run(1.0));
        assert!(most.content_correlation > none.content_correlation + 0.01, "{none:?} {most:?}");
        assert!(most.distance < none.distance && most.distance > 0.02, "{none:?} {most:?}");
    }
}
