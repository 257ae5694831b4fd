//! Bimodal styles, for reports: classes whose takes form two clusters.
//!
//! The target of a frame is the mean of its counterparts in the takes of a style. If the takes form two clusters, that
//! mean matches neither: takes 1 to 4 of the `exhausted` turns of bandai-namco-2 differ about half as much from neutral
//! as takes 5 to 8, and the output lies between them.

use super::motion_statistics::{MotionStatistics, TakeSpread, motion_statistics};
use super::offline::Database;
use crate::math::partition::principal_partition;

/// Minimum number of clips in a cluster: a single clip may be an outlier.
const MIN_CLIPS: usize = 2;

/// Minimum distance of two clusters, in units of the usual distance of two takes of a class.
///
/// With it, `walk-turn-left` and `walk-turn-right` of bandai-namco-2 in `exhausted` are reported (2.0 and 1.8) and no
/// other of its 28 classes of 4 or more clips. Next are 1.30 (`run` in `active`, most of whose variance lies within the
/// clusters), 1.25 (`walk-turn-right` in `elderly`) and less, which is the difference between the two recording
/// sessions. 80 of 84 classes mixed from two styles with four takes each are reported. Of unimodal classes 1.7 % are
/// reported if only 4 of their clips are kept, 0.9 % with 5, none with 6. The classes of bandai-namco-1, of xia and of
/// the built-in motions have 3 clips at most and are not tested.
///
/// A class contributes to the usual distance: if it is the only one with several clips, two equal halves are at most
/// 1.3 apart.
const MIN_SEPARATION: f64 = 1.4;

/// Minimum share of the variance of a class that lies between its clusters: more than within them.
const MIN_EXPLAINED: f64 = 0.5;

/// A bimodal style: its takes of an action form two clusters.
#[derive(Clone, Debug, PartialEq)]
pub struct BimodalStyle {
    /// Name of the action.
    pub action: String,
    /// Name of the style.
    pub style: String,
    /// Distance of the clusters, in units of the usual distance of two takes of a class in the database; at least 1.4.
    pub separation: f32,
    /// Names of the clips of each cluster, at least 2, in the database's order. The first cluster contains the first
    /// clip of the class.
    pub clips: [Vec<String>; 2],
}

/// Bimodal styles of a database, in the order of its classes. Classes with fewer than 4 clips are not tested.
pub fn bimodal_styles(db: &Database) -> Vec<BimodalStyle> {
    let takes = statistics_of_takes(db);
    let spread = TakeSpread::of(&takes);
    let found = db.classes().iter().zip(&takes).filter_map(|(class, takes)| {
        let (separation, groups) = clusters(takes, &spread)?;
        let name = |i: usize| db.clips[class.clips.start + i].name.clone();
        Some(BimodalStyle {
            action: db.actions[usize::from(class.action)].clone(),
            style: db.styles[usize::from(class.style)].clone(),
            separation: separation as f32,
            clips: groups.map(|group| group.into_iter().map(name).collect()),
        })
    });
    found.collect()
}

/// Statistics of the clips of every class, in the database's order.
pub fn statistics_of_takes(db: &Database) -> Vec<Vec<MotionStatistics>> {
    let statistics = |clip: usize| motion_statistics(&db.point_cloud[db.clips[clip].rows()]);
    db.classes().iter().map(|class| class.clips.clone().map(statistics).collect()).collect()
}

/// Distance and takes (as indices) of the two clusters that takes form, if they do.
fn clusters(takes: &[MotionStatistics], spread: &TakeSpread) -> Option<(f64, [Vec<usize>; 2])> {
    let standardised: Vec<MotionStatistics> = takes.iter().map(|take| spread.standardised(take)).collect();
    let found = principal_partition(&standardised, MIN_CLIPS)?;
    let separation = found.distance / spread.distance_of_takes();
    (separation >= MIN_SEPARATION && found.explained > MIN_EXPLAINED).then_some((separation, found.groups))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::database::motion_statistics::STATISTICS;
    use crate::math::random::SplitMix64;
    use proptest::prelude::*;

    /// Takes of a class around a value, each differing from it by up to 1 cm in every statistic.
    fn takes(n: usize, place: f64, seed: u64) -> Vec<MotionStatistics> {
        let mut random = SplitMix64::new(seed);
        let mut off = || random.below(2001) as f64 / 1000.0 - 1.0;
        (0..n).map(|_| std::array::from_fn(|_| place + 0.01 * off())).collect()
    }

    /// Result for a class in a database with five unimodal classes.
    fn manners_of(class: &[MotionStatistics]) -> Option<(f64, [Vec<usize>; 2])> {
        let mut classes: Vec<_> = (0..5).map(|i| takes(6, i as f64, i)).collect();
        classes.push(class.to_vec());
        clusters(class, &TakeSpread::of(&classes))
    }

    fn of_two_places(apart: f64, seed: u64) -> Vec<MotionStatistics> {
        [takes(4, 1.0, seed), takes(2, 1.0 + apart, seed + 1)].concat()
    }

    proptest! {
        #[test]
        fn two_manners_are_found_in_any_order(seed in any::<u32>(), shuffle in any::<u64>()) {
            let class = of_two_places(0.05, u64::from(seed));
            let mut order: Vec<usize> = (0..6).collect();
            SplitMix64::new(shuffle).shuffle(&mut order);
            let (separation, groups) = manners_of(&order.iter().map(|&i| class[i]).collect::<Vec<_>>()).unwrap();
            prop_assert!(separation > MIN_SEPARATION && separation < 10.0);
            prop_assert!(groups[0].contains(&0));
            for group in groups {
                let late = group.iter().filter(|&&i| order[i] >= 4).count();
                prop_assert!(late == 0 || late == group.len(), "{:?}", group);
            }
        }

        #[test]
        fn one_manner_is_not_two(seed in any::<u32>(), n in 0..9_usize) {
            prop_assert_eq!(manners_of(&takes(n, 3.0, u64::from(seed))), None);
        }

        #[test]
        fn what_is_far_off_alone_is_no_manner(seed in any::<u32>()) {
            let mut class = takes(6, 1.0, u64::from(seed));
            class[2] = [1.3; STATISTICS];
            prop_assert_eq!(manners_of(&class), None);
        }
    }

    #[test]
    fn bimodality_needs_four_takes() {
        for n in 0..=3 {
            let class = takes(n, 1.0, 7);
            let apart: Vec<MotionStatistics> =
                class.iter().zip(0_u8..).map(|(take, i)| take.map(|v| v + f64::from(i))).collect();
            assert_eq!(manners_of(&apart), None);
        }
    }

    #[test]
    fn takes_that_are_all_alike_have_one_manner() {
        let class = vec![[1.0; STATISTICS]; 6];
        assert_eq!(clusters(&class, &TakeSpread::of(std::slice::from_ref(&class))), None);
    }
}
