//! Tests of the search against brute force.

use super::*;
use crate::database::{Clip, Database, DatabaseParts};
use crate::fixtures::{self, BENT, Gait, NEUTRAL};
use crate::humanoid::JOINTS;
use crate::math::Vec3;
use crate::math::random::SplitMix64;
use crate::pose_vector::{HEADING_RATE, HeadingFilter, Placement, VELOCITY_Z};
use proptest::prelude::*;
use std::sync::{Arc, OnceLock};

/// Searches classes by the metric; returns the neighbours found by brute force.
fn both(
    index: &Index,
    window: &QueryWindow,
    metric: Metric,
    classes: &[usize],
    k: usize,
    scratch: &mut Scratch,
    out: &mut Neighbours,
) -> Neighbours {
    let query = index.prepare(window, metric);
    index.nearest(&query, classes, k, scratch, out);
    let mut expected = Neighbours::default();
    index.nearest_by_brute_force(&query, classes, k, &mut expected);
    expected
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn a_walk_finds_what_brute_force_finds(
        lean in 0.0f32..0.6, period in 40.0f32..90.0, turn in -0.5f32..0.5, k in 1usize..50, length in 0usize..3,
    ) {
        static INDICES: OnceLock<[Index; 3]> = OnceLock::new();
        let db = fixtures::database();
        let index = &INDICES.get_or_init(|| [WINDOW, 1, MAX_WINDOW].map(|l| Index::with_window(&db, l)))[length];
        let gait = Gait { period, lean, turn, ..if lean > 0.3 { BENT } else { NEUTRAL } };
        let (mut window, mut filter, mut scratch) =
            (QueryWindow::new(index.window_length()), HeadingFilter::default(), Scratch::default());
        let mut found = [Neighbours::default(), Neighbours::default()];
        for pose in &fixtures::walk(&gait, 40, 0.1).poses {
            window.follow(pose, &db.proportions, db.rate_hz, &mut filter);
            for (metric, out) in [Metric::FullBody, Metric::LowerBody].into_iter().zip(&mut found) {
                let expected = both(index, &window, metric, &[0, index.classes() - 1], k, &mut scratch, out);
                prop_assert_eq!(out.as_slice(), expected.as_slice());
            }
        }
    }
}

/// Degenerate recordings.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Walk,
    /// The same frame repeated.
    Frozen,
    /// All joints at one point.
    Collapsed,
    /// A figure of the size of a house, far above the ground.
    Giant,
    /// Hundreds of metres per frame.
    Fast,
}

fn cloud(kind: Kind, row: usize, of: &Database) -> [Vec3; JOINTS] {
    let row = if matches!(kind, Kind::Frozen) { 7 } else { row % of.frames() };
    of.point_cloud[row].map(|p| match kind {
        Kind::Collapsed => Vec3::ZERO,
        Kind::Giant => p * 12.0 + Vec3::new(3.0, 700.0, -20.0),
        _ => p,
    })
}

/// A database with a class for each kind and number of frames, with clips of at most 30 frames.
fn database(classes: &[(Kind, usize)]) -> Database {
    let walk = fixtures::database();
    let mut parts = DatabaseParts {
        actions: (0..classes.len()).map(|i| i.to_string()).collect(),
        styles: vec!["only".into()],
        neutral: 0,
        clips: Vec::new(),
        pose: Vec::new(),
        point_cloud: Vec::new(),
        counterparts_per_style: 1,
        ..(*walk).clone()
    };
    for (action, &(kind, frames)) in classes.iter().enumerate() {
        for first in (0..frames).step_by(30) {
            let clip = Clip { action: action as u16, style: 0, first_frame: parts.pose.len(), ..walk.clips[0].clone() };
            parts.clips.push(Clip { frames: (frames - first).min(30), ..clip });
            for row in first..frames.min(first + 30) {
                let mut pose = walk.pose[row % walk.frames()];
                if matches!(kind, Kind::Fast) {
                    (pose[VELOCITY_Z], pose[HEADING_RATE]) = (9000.0, 1.0);
                }
                parts.pose.push(pose);
                parts.point_cloud.push(cloud(kind, row, &walk));
            }
        }
    }
    let n = parts.pose.len();
    (parts.canonical_time, parts.time_step) = (vec![0.0; n], vec![0.1; n]);
    (parts.contact, parts.counterpart) = (vec![[0; 2]; n], vec![-1.0; n]);
    Database::new(parts).unwrap()
}

fn kind() -> impl Strategy<Value = Kind> {
    prop::sample::select(vec![Kind::Walk, Kind::Frozen, Kind::Collapsed, Kind::Giant, Kind::Fast])
}

/// Coordinates of the windows of a plan along its directions.
fn points_of(db: &Database, plan: &Plan) -> [Vec<[i16; Plan::COORDINATES]>; 2] {
    let windows = windows::Windows::new(db, WINDOW);
    [Metric::FullBody, Metric::LowerBody].map(|metric| {
        let subspace = subspace::Subspace::from_floats(&plan.bases[metric as usize], WINDOW, metric).unwrap();
        let point = |row: &u32| block::quantise(&subspace.project(&windows.centred(*row as usize, metric)));
        plan.order.iter().map(point).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn anything_finds_what_brute_force_finds(
        classes in prop::collection::vec((kind(), 1usize..90), 1..5),
        queries in prop::collection::vec((kind(), 0usize..200), 1..12),
        spoilt in prop::option::of(prop::sample::select(vec![f32::NAN, f32::INFINITY, 1e30, -1e12, 1e6])),
        k in 0usize..50,
    ) {
        let (walk, db) = (fixtures::database(), database(&classes));
        let index = Index::build(&db);
        let all: Vec<usize> = (0..index.classes()).collect();
        let (mut window, mut scratch) = (QueryWindow::default(), Scratch::default());
        let mut found = [Neighbours::default(), Neighbours::default()];
        for (i, (kind, row)) in queries.into_iter().enumerate() {
            let mut points = cloud(kind, row, &walk);
            if let Some(v) = spoilt.filter(|_| i == 3) {
                points[5].x = v;
            }
            window.push(&points, Placement { x: 0.1 * i as f32, z: 0.0, heading: 0.2 });
            for (metric, out) in [Metric::FullBody, Metric::LowerBody].into_iter().zip(&mut found) {
                let expected = both(&index, &window, metric, &all, k, &mut scratch, out);
                prop_assert_eq!(out.as_slice(), expected.as_slice());
            }
        }
    }

    #[test]
    fn a_search_among_all_windows_finds_what_brute_force_finds(
        classes in prop::collection::vec((kind(), 1usize..90), 1..5),
        query in (kind(), 0usize..200), k in 1usize..50,
    ) {
        let (walk, db) = (fixtures::database(), database(&classes));
        let mut window = QueryWindow::default();
        window.push(&cloud(query.0, query.1, &walk), Placement::default());
        let all: Vec<usize> = (0..classes.len()).collect();
        let index = Index::build(&db);
        let source = All((0..classes.len()).map(|class| index.windows_of_class(class).collect()).collect());
        let index = index.with_candidates(Arc::new(source));
        let (mut scratch, mut out) = (Scratch::default(), Neighbours::default());
        let expected = both(&index, &window, Metric::FullBody, &all, k, &mut scratch, &mut out);
        prop_assert_eq!(out.as_slice(), expected.as_slice());
    }

    #[test]
    fn a_mean_that_is_reported_as_exceeded_is(
        classes in prop::collection::vec((kind(), 1usize..90), 1..5),
        (kind, row) in (kind(), 0usize..200), k in 1usize..50, share in 0.2f32..1.5,
    ) {
        let (walk, db) = (fixtures::database(), database(&classes));
        let index = Index::build(&db);
        let mut window = QueryWindow::default();
        window.push(&cloud(kind, row, &walk), Placement::default());
        for (metric, class) in [Metric::FullBody, Metric::LowerBody].into_iter().zip(0..index.classes()) {
            let (query, mut nearest) = (index.prepare(&window, metric), Neighbours::default());
            index.nearest_by_brute_force(&query, &[class], k, &mut nearest);
            let mean = nearest.mean_distance();
            // Up to the rounding of a sum of at most 50 terms.
            prop_assert!(!index.mean_exceeds(&query, class, k, mean * share) || share < 1.0 + 1e-5);
            prop_assert!(!index.mean_exceeds(&query, class, k, f32::INFINITY));
        }
    }

    #[test]
    fn what_is_found_does_not_depend_on_the_plan(seed in any::<u64>(), row in 0usize..500, k in 1usize..50) {
        static INDEX: OnceLock<Index> = OnceLock::new();
        let db = fixtures::database();
        let index = INDEX.get_or_init(|| Index::build(&db));
        let mut plan = index.plan();
        let mut random = SplitMix64::new(seed);
        for class in 0..index.classes() {
            let rows = &mut plan.order[(0..class).map(|c| index.windows_in_class(c)).sum()..][..index.windows_in_class(class)];
            random.shuffle(rows);
        }
        let turned = 4 * random.below(3);
        for basis in &mut plan.bases {
            // Coordinates are exchanged: the directions are still orthonormal, but not those of greatest variance.
            let heights = &mut basis[..Plan::BASIS_LENGTH * 15 / 39];
            heights.chunks_exact_mut(20).for_each(|frame| frame.rotate_left(turned));
        }
        plan.points = points_of(&db, &plan);
        let shuffled = Index::from_plan(&db, plan).unwrap();
        let window = {
            let mut window = QueryWindow::default();
            window.push(&db.point_cloud[row], Placement::default());
            window
        };
        for metric in [Metric::FullBody, Metric::LowerBody] {
            let (mut scratch, mut out) = (Scratch::default(), Neighbours::default());
            let expected = both(&shuffled, &window, metric, &[0, 1], k, &mut scratch, &mut out);
            prop_assert_eq!(out.as_slice(), expected.as_slice());
            index.nearest(&index.prepare(&window, metric), &[0, 1], k, &mut scratch, &mut out);
            prop_assert_eq!(out.as_slice(), expected.as_slice());
        }
    }
}

/// All windows of each class as candidates.
#[derive(Debug)]
struct All(Vec<Vec<usize>>);

impl CandidateSource for All {
    fn for_each_candidate(&self, _: &[f32; Index::COORDINATES], classes: &[usize], visit: &mut dyn FnMut(u32)) {
        classes.iter().flat_map(|&class| &self.0[class]).for_each(|&row| visit(row as u32));
    }
}

#[test]
fn classes_that_are_far_are_known_to_be() {
    let db = fixtures::database();
    let index = Index::build(&db);
    let mut window = QueryWindow::default();
    window.push(&db.point_cloud[100], Placement::default());
    let query = index.prepare(&window, Metric::FullBody);
    let mean = |class: usize| {
        let mut nearest = Neighbours::default();
        index.nearest_by_brute_force(&query, &[class], 40, &mut nearest);
        nearest.mean_distance()
    };
    let far = (0..index.classes()).max_by(|a, b| mean(*a).total_cmp(&mean(*b))).unwrap();
    assert!(index.mean_exceeds(&query, far, 40, 0.5 * mean(far)));
    assert!(index.rough_distance(&query, far) > index.rough_distance(&query, db.class_of_row(100)));
}

#[test]
fn a_plan_gives_its_index_and_others_are_refused() {
    let db = fixtures::database();
    let plan = Index::build(&db).plan();
    assert_eq!(Index::from_plan(&db, plan.clone()).unwrap().plan(), plan);
    let refused = |change: &dyn Fn(&mut Plan)| {
        let mut changed = plan.clone();
        change(&mut changed);
        Index::from_plan(&db, changed).unwrap_err()
    };
    assert_eq!(refused(&|p| p.order[1] = p.order[0]), PlanError::Order);
    assert_eq!(refused(&|p| p.order[0] = 0), PlanError::Order);
    assert_eq!(refused(&|p| p.order[0] = u32::MAX), PlanError::Order);
    assert_eq!(refused(&|p| p.order.truncate(5)), PlanError::Order);
    assert_eq!(refused(&|p| p.order.push(0)), PlanError::Order);
    assert_eq!(refused(&|p| p.order.reverse()), PlanError::Order);
    assert_eq!(refused(&|p| p.points[0].truncate(5)), PlanError::Points);
    assert_eq!(refused(&|p| p.points[1][0][3] += 1), PlanError::Points);
    assert_eq!(refused(&|p| p.points[1][1] = [i16::MIN; Plan::COORDINATES]), PlanError::Points);
    // A point that is not among those compared in full.
    assert_eq!(refused(&|p| p.points[0][1] = [0; Plan::COORDINATES]), PlanError::Points);
    assert_eq!(refused(&|p| p.points[1][1] = p.points[1][1].map(|c| c / 2)), PlanError::Points);
    assert_eq!(refused(&|p| p.bases[0].truncate(5)), PlanError::Basis);
    assert_eq!(refused(&|p| p.bases[1][200] += 0.01), PlanError::Basis);
    assert_eq!(refused(&|p| p.bases[1][0] = f32::NAN), PlanError::Basis);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn the_plan_of_any_database_is_accepted(classes in prop::collection::vec((kind(), 1usize..90), 1..5)) {
        let db = database(&classes);
        let plan = Index::build(&db).plan();
        prop_assert!(Index::from_plan(&db, plan).is_ok());
    }
}
