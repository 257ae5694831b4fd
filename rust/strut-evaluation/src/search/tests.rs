use super::*;
use crate::fixtures::{Gait, NEUTRAL, database, walk};
use std::num::NonZero;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{Index, QueryWindow};

/// Share of the 20 nearest windows of an unseen walk that kd-trees find with this number of candidates in each class.
fn recall_of_kd_trees(candidates: usize) -> f64 {
    let exact = Index::build(&database());
    let trees = with_kd_trees(exact.clone(), NonZero::new(candidates).unwrap());
    recall(&exact, &trees, 20)
}

/// Share of the `k` nearest windows of an unseen walk that another search finds.
fn recall(exact: &Index, other: &Index, k: usize) -> f64 {
    let db = database();
    let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
    let mut searches = [ClassSearch::default(), ClassSearch::default()];
    let mut recall = Recall::default();
    for pose in &walk(&Gait { period: 58.0, lean: 0.2, turn: 0.2, ..NEUTRAL }, 120, 0.1).poses {
        window.follow(pose, &db.proportions, db.rate_hz, &mut filter);
        let [nearest, found] = &mut searches;
        recall.add(nearest.find(exact, &window, k), found.find(other, &window, k));
    }
    recall.share()
}

#[test]
fn the_exact_search_finds_all_that_is_nearest() {
    let exact = Index::build(&database());
    assert_eq!(recall(&exact, &exact, 20), 1.0);
    assert_eq!(Recall::default().share(), 1.0, "where there is nothing to find");
}

#[test]
fn kd_trees_find_nearly_all_windows_with_as_many_candidates() {
    // The measured values were 0.922 and 0.999.
    let recall = [20, 40].map(recall_of_kd_trees);
    assert!(recall[0] > 0.9 && recall[1] > 0.995, "{recall:?}");
    assert_eq!(recall_of_kd_trees(300), 1.0, "if all windows of a class are candidates");
}
