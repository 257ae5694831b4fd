//! Style progress: the share of the path from an input to a style that a motion covers.
//!
//! Input, output and real takes of the style are points in the space of motion statistics. The progress of a motion is
//! its projection on the line from the input (0) to the mean of the takes (1): real takes scatter about 1, an unchanged
//! input is 0, and more than 1 is exaggerated. Differences perpendicular to the line do not count.

use super::off_database::heading_free_points;
use strut_core::database::motion_statistics::{MotionStatistics, TakeSpread, motion_statistics};
use strut_core::database::{Database, statistics_of_takes};
use strut_core::humanoid::HumanoidMotion;
use strut_core::math::stats::mean_of;

/// Real takes of a database, relative to which progress is measured.
#[derive(Clone, Debug)]
pub struct StyleProgress {
    spread: TakeSpread,
    /// Action, style and the mean of its takes' standardised statistics.
    classes: Vec<(String, String, MotionStatistics)>,
}

impl StyleProgress {
    /// Uses the takes of this database; every statistic is divided by their spread within classes.
    pub fn new(db: &Database) -> Self {
        let takes = statistics_of_takes(db);
        let spread = TakeSpread::of(&takes);
        let name = |names: &[String], i: u16| names[usize::from(i)].clone();
        let class = |(class, takes): (&strut_core::database::Class, &Vec<MotionStatistics>)| {
            let mean = spread.standardised(&mean_of(takes));
            (name(&db.actions, class.action), name(&db.styles, class.style), mean)
        };
        let classes = db.classes().iter().zip(&takes).map(class).collect();
        Self { spread, classes }
    }

    /// Progress of `motion` on the line from `input` to the mean of the takes of a style; any number, 1 at the mean.
    /// `None` if there are no takes, no class has several, or the input is at the mean already. Both motions are on the
    /// database's body.
    pub fn of(&self, action: &str, style: &str, input: &HumanoidMotion, motion: &HumanoidMotion) -> Option<f64> {
        let (.., takes) = self.classes.iter().find(|(a, s, _)| a == action && s == style)?;
        let point = |m: &HumanoidMotion| self.spread.standardised(&motion_statistics(&heading_free_points(m)));
        progress(&point(input), takes, &point(motion))
    }
}

/// Projection of `at` on the line from `from` (0) to `to` (1); `None` if these are equal.
fn progress(from: &MotionStatistics, to: &MotionStatistics, at: &MotionStatistics) -> Option<f64> {
    let (mut along, mut way) = (0.0, 0.0);
    for ((from, to), at) in from.iter().zip(to).zip(at) {
        along += (at - from) * (to - from);
        way += (to - from) * (to - from);
    }
    (way > 0.0).then(|| along / way)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, database, walk};
    use strut_core::database::motion_statistics::STATISTICS;
    use strut_core::humanoid::Proportions;

    #[test]
    fn progress_is_a_projection() {
        let at = |x: f64, y: f64| std::array::from_fn(|i| [x, y][i % 2]);
        let [from, to] = [at(1.0, 1.0), at(3.0, 1.0)];
        for (motion, expected) in
            [(from, 0.0), (to, 1.0), (at(2.0, 9.0), 0.5), (at(0.0, 1.0), -0.5), (at(4.0, 0.0), 1.5)]
        {
            assert_eq!(progress(&from, &to, &motion), Some(expected));
        }
        assert_eq!(progress(&from, &from, &to), None);
        assert_eq!(progress(&[0.0; STATISTICS], &[0.0; STATISTICS], &[1.0; STATISTICS]), None);
    }

    #[test]
    fn half_a_style_is_half_of_the_way() {
        let clip = |gait: &Gait| HumanoidMotion {
            proportions: Proportions::default(),
            rate_hz: RATE_HZ,
            poses: walk(gait, 256, 0.0).poses,
        };
        let between = |a: f32, b: f32| 0.5 * (a + b);
        let half = Gait {
            period: between(NEUTRAL.period, BENT.period),
            swing: between(NEUTRAL.swing, BENT.swing),
            knee: between(NEUTRAL.knee, BENT.knee),
            lean: between(NEUTRAL.lean, BENT.lean),
            arms: between(NEUTRAL.arms, BENT.arms),
            turn: 0.0,
        };
        let takes = StyleProgress::new(&database());
        let of = |gait: &Gait| takes.of("walk", "bent", &clip(&NEUTRAL), &clip(gait)).unwrap();
        assert_eq!(of(&NEUTRAL), 0.0);
        assert!((of(&half) - 0.5).abs() < 0.1 && (of(&BENT) - 1.0).abs() < 0.15);
        assert_eq!(takes.of("swim", "bent", &clip(&NEUTRAL), &clip(&BENT)), None);
    }
}
