//! Nearest-neighbour search among recorded styles (`docs/methods/somn.md` §7).

use super::mixture::{MAX_AXES, Style};
use kiddo::{ImmutableKdTree, SquaredEuclidean};

/// Recorded styles, in standard deviations, prepared for search without allocation.
///
/// A kd-tree finds one of the nearest styles, but not the first of several at the same distance, and it compares rounded
/// bounds. So it only bounds the distance of the nearest style; among the candidates within this bound along the first axis,
/// the nearest is found exactly. The result equals that of a linear scan, whatever the tree returns.
#[derive(Clone, Debug)]
pub(super) struct RecordedStyles {
    /// Its items are indices into `ordered`.
    tree: ImmutableKdTree<f64, MAX_AXES>,
    /// The styles and their frames, sorted by the first axis.
    ordered: Box<[(Style, usize)]>,
}

impl RecordedStyles {
    /// The styles of successive frames; one that is not finite is excluded.
    pub(super) fn new(styles: &[Style]) -> Self {
        let frames = styles.iter().copied().zip(0..);
        let mut ordered: Box<[_]> = frames.filter(|(v, _)| v.iter().all(|x| x.is_finite())).collect();
        ordered.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
        let points: Vec<Style> = ordered.iter().map(|(v, _)| *v).collect();
        Self { tree: ImmutableKdTree::new_from_slice(&points), ordered }
    }

    /// The squared distance to a recorded style that is the nearest, except for rounding; `None` without recordings.
    pub(super) fn bound(&self, u: &Style) -> Option<f64> {
        // An empty tree returns item 0, too.
        let (v, _) = self.ordered.get(self.tree.nearest_one::<SquaredEuclidean>(u).item as usize)?;
        Some(squared_distance(u, v))
    }

    /// The squared distance to the nearest recorded style, and its frame: the first of several at the same distance. `None`
    /// without recordings.
    pub(super) fn nearest(&self, u: &Style) -> Option<(f64, usize)> {
        let bound = self.bound(u)?;
        // A rounded square is at most the rounded sum that contains it, so styles within the bound are kept.
        let too_far = |v: &Style| (u[0] - v[0]) * (u[0] - v[0]) > bound;
        let first = self.ordered.partition_point(|(v, _)| v[0] < u[0] && too_far(v));
        let within = self.ordered[first..].iter().take_while(|(v, _)| v[0] < u[0] || !too_far(v));
        within.map(|(v, frame)| (squared_distance(u, v), *frame)).reduce(|a, b| if b < a { b } else { a })
    }
}

fn squared_distance(u: &Style, v: &Style) -> f64 {
    (0..MAX_AXES).map(|j| (u[j] - v[j]) * (u[j] - v[j])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Result of a linear scan.
    fn scanned(styles: &[Style], u: &Style) -> Option<(f64, usize)> {
        let all = styles.iter().enumerate().map(|(frame, v)| (squared_distance(u, v), frame));
        all.reduce(|a, b| if b.0 < a.0 { b } else { a })
    }

    /// Numbers that are often equal, so that styles repeat and distances tie; and any others.
    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![(-3i8..=3).prop_map(f64::from), -100.0..100.0, Just(0.1), Just(1e-160), Just(-0.0)]
    }

    /// Styles of one to three axes.
    fn styles(most: usize) -> impl Strategy<Value = Vec<Style>> {
        (1..=MAX_AXES, prop::collection::vec([number(), number(), number()], 0..most)).prop_map(|(axes, mut styles)| {
            for v in &mut styles {
                v[axes..].fill(0.0);
            }
            styles
        })
    }

    proptest! {
        #[test]
        fn the_nearest_is_what_a_scan_finds_to_the_bit(
            styles in styles(400), queries in prop::collection::vec([number(), number(), number()], 1..20),
        ) {
            let recorded = RecordedStyles::new(&styles);
            for u in queries.iter().chain(&styles) {
                let found = recorded.nearest(u).map(|(square, frame)| (square.to_bits(), frame));
                prop_assert_eq!(found, scanned(&styles, u).map(|(square, frame)| (square.to_bits(), frame)));
                prop_assert!(recorded.bound(u) >= scanned(&styles, u).map(|(square, _)| square));
            }
        }
    }

    #[test]
    fn hundreds_of_styles_may_be_one_and_the_first_is_nearest() {
        for v in [[0.0; MAX_AXES], [1.5, 0.0, 0.0], [1.5, -2.0, 0.25]] {
            let recorded = RecordedStyles::new(&vec![v; 700]);
            assert_eq!(recorded.nearest(&v), Some((0.0, 0)));
            assert_eq!(recorded.nearest(&[v[0] + 3.0, v[1], v[2]]), Some((9.0, 0)));
        }
    }

    #[test]
    fn what_is_not_finite_or_very_far_is_no_trouble() {
        let styles = [[f64::NAN, 0.0, 0.0], [1e300, -1e300, 0.0], [1.0, f64::INFINITY, 0.0], [1e301, 0.0, 0.0]];
        assert_eq!(RecordedStyles::new(&styles).nearest(&[0.0; MAX_AXES]), Some((f64::INFINITY, 1)));
        assert_eq!(RecordedStyles::new(&styles[..1]).nearest(&[0.0; MAX_AXES]), None);
    }
}
