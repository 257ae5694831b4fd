//! Division of points into two groups: Boley, "Principal Direction Divisive Partitioning", 1998. Points are ordered along the
//! direction of their largest variance, and divided such that the sum of squares between the groups is largest, which is the
//! objective of two-means.

use super::stats::mean_of;

/// Rounds of power iteration. If two directions have almost the same variance, either divides the points equally well.
const ROUNDS: usize = 32;

/// A division of points into two groups.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Partition {
    /// Indices of the points of each group, ascending; the first group contains point 0.
    pub(crate) groups: [Vec<usize>; 2],
    /// Distance between the groups' means, positive.
    pub(crate) distance: f64,
    /// Share of the points' variance that is between the groups: in (0, 1].
    pub(crate) explained: f64,
}

/// Returns the best division along the principal direction into groups of at least `least` points; `None` if there are too
/// few points, or all are equal.
pub(crate) fn principal_partition<const D: usize>(points: &[[f64; D]], least: usize) -> Option<Partition> {
    let n = points.len();
    let least = least.max(1);
    if n < 2 * least {
        return None;
    }
    // Relative to the first point, so that equal points give exact zeros instead of rounding errors.
    let apart: Vec<[f64; D]> = points.iter().map(|p| std::array::from_fn(|i| p[i] - points[0][i])).collect();
    let mean = mean_of(&apart);
    let centred: Vec<[f64; D]> = apart.iter().map(|p| std::array::from_fn(|i| p[i] - mean[i])).collect();
    let direction = principal_direction(&centred)?;
    let mut order: Vec<(f64, usize)> = centred.iter().map(|p| dot(p, &direction)).zip(0..).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));

    // Deviations from the mean sum to zero: of a group of k with sum s, the mean is s/k and that of the others −s/(n − k).
    let mut sum = [0.0; D];
    let mut best: Option<(f64, f64, usize)> = None;
    for (k, (_, point)) in (1..).zip(&order) {
        sum.iter_mut().zip(&centred[*point]).for_each(|(sum, v)| *sum += v);
        let between = dot(&sum, &sum) * n as f64 / (k * (n - k).max(1)) as f64;
        let fits = (least..=n - least).contains(&k);
        if fits && best.is_none_or(|(most, ..)| between > most) {
            let distance = dot(&sum, &sum).sqrt() * n as f64 / (k * (n - k)) as f64;
            best = Some((between, distance, k));
        }
    }
    let (between, distance, k) = best?;
    let total: f64 = centred.iter().map(|p| dot(p, p)).sum();
    let group = |of: &[(f64, usize)]| {
        let mut indices: Vec<usize> = of.iter().map(|(_, i)| *i).collect();
        indices.sort_unstable();
        indices
    };
    let mut groups = [group(&order[..k]), group(&order[k..])];
    groups.sort_unstable();
    (distance > 0.0).then(|| Partition { groups, distance, explained: (between / total).min(1.0) })
}

/// The unit vector of the largest variance of centred points; `None` if they have none.
fn principal_direction<const D: usize>(centred: &[[f64; D]]) -> Option<[f64; D]> {
    let farthest = centred.iter().max_by(|a, b| dot(a, a).total_cmp(&dot(b, b)))?;
    let mut direction = unit(*farthest)?;
    for _ in 0..ROUNDS {
        let mut next = [0.0; D];
        for point in centred {
            let along = dot(point, &direction);
            next.iter_mut().zip(point).for_each(|(sum, v)| *sum += along * v);
        }
        direction = unit(next)?;
    }
    Some(direction)
}

/// `None` for a vector of length zero, or of a length that is not finite.
fn unit<const D: usize>(v: [f64; D]) -> Option<[f64; D]> {
    let length = dot(&v, &v).sqrt();
    (length > 0.0 && length.is_finite()).then(|| v.map(|v| v / length))
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::random::SplitMix64;
    use proptest::prelude::*;

    /// `n` points within 1 of a centre.
    fn cloud(n: usize, centre: [f64; 3]) -> impl Strategy<Value = Vec<[f64; 3]>> {
        let around = move |p: [f64; 3]| std::array::from_fn(|i| p[i] + centre[i]);
        prop::collection::vec(prop::array::uniform3(-1.0..1.0_f64).prop_map(around), n)
    }

    proptest! {
        #[test]
        fn two_clouds_are_told_apart_in_any_order(
            a in cloud(4, [-4.0, 3.0, 0.0]), b in cloud(6, [4.0, 0.0, 2.0]), seed in any::<u64>()
        ) {
            let points: Vec<[f64; 3]> = a.into_iter().chain(b).collect();
            let mut order: Vec<usize> = (0..10).collect();
            SplitMix64::new(seed).shuffle(&mut order);
            let shuffled: Vec<[f64; 3]> = order.iter().map(|&i| points[i]).collect();
            let found = principal_partition(&shuffled, 2).unwrap();
            let mut named = found.groups.clone().map(|group| {
                let mut names: Vec<usize> = group.into_iter().map(|i| order[i]).collect();
                names.sort_unstable();
                names
            });
            named.sort_unstable();
            prop_assert_eq!(named, [(0..4).collect::<Vec<_>>(), (4..10).collect()]);
            prop_assert!(found.explained > 0.8 && (6.0..12.0).contains(&found.distance), "{:?}", found);
        }

        #[test]
        fn any_points_give_finite_numbers(points in prop::collection::vec(prop::array::uniform3(-1e9..1e9_f64), 0..12), least in 0..4_usize) {
            if let Some(found) = principal_partition(&points, least) {
                prop_assert!(found.groups.iter().all(|g| g.len() >= least.max(1)));
                prop_assert_eq!(found.groups.concat().len(), points.len());
                prop_assert!(found.groups[0].contains(&0));
                prop_assert!(found.distance > 0.0 && found.distance.is_finite());
                prop_assert!(found.explained > 0.0 && found.explained <= 1.0);
            }
        }
    }

    #[test]
    fn equal_or_few_points_are_not_divided() {
        assert_eq!(principal_partition(&[[0.1, 0.7]; 9], 2), None);
        assert_eq!(principal_partition(&[[0.0], [1.0], [9.0]], 2), None);
        assert_eq!(principal_partition::<3>(&[], 0), None);
    }

    #[test]
    fn the_numbers_are_those_of_the_groups() {
        let found = principal_partition(&[[0.0], [10.0], [2.0], [12.0]], 2).unwrap();
        assert_eq!(found.groups, [vec![0, 2], vec![1, 3]]);
        // Means 1 and 11; of the variance 26, 25 lie between.
        assert!((found.distance - 10.0).abs() < 1e-9 && (found.explained - 25.0 / 26.0).abs() < 1e-9, "{found:?}");
    }
}
