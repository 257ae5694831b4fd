//! Tests of images against all distances.

use super::*;
use crate::fixtures::{self, BENT, Gait};
use crate::pose_vector::HeadingFilter;
use proptest::prelude::*;
use std::sync::OnceLock;

fn index() -> &'static Index {
    static INDEX: OnceLock<Index> = OnceLock::new();
    INDEX.get_or_init(|| Index::build(&fixtures::database()))
}

/// Windows of a walk that is not in the database.
fn columns() -> Vec<QueryWindow> {
    let db = fixtures::database();
    let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
    let poses = fixtures::walk(&Gait { period: 57.0, lean: 0.4, turn: 0.2, ..BENT }, 40, 0.1).poses;
    poses
        .iter()
        .map(|pose| {
            window.follow(pose, &db.proportions, db.rate_hz, &mut filter);
            window.clone()
        })
        .step_by(9)
        .collect()
}

/// D of every window in a column, by the metric or by the packed windows.
fn every_distance(atlas: &mut Atlas, column: usize) -> Vec<f32> {
    let (ends, window, part) = (atlas.ends.clone(), atlas.columns[column].clone(), atlas.view.part);
    if let Some(metric) = metric_of(part) {
        let query = index().prepare(&window, metric);
        return ends.iter().map(|&row| index().distance_to(&query, row as usize)).collect();
    }
    let packed = atlas.packed(index());
    let query = packed.query(&window).unwrap();
    let windows = packed.classes.iter().flat_map(|class| &packed.windows[class.windows()]);
    windows.map(|window| packed.distance(&query, window)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn pixels_are_the_least_distances_of_their_lines(
        first in 0usize..400, count in 1usize..900, height in 1usize..120, part in prop::sample::select(BodyPart::ALL.to_vec()),
    ) {
        let mut atlas = Atlas::new(index(), columns());
        atlas.set_view(AtlasView { part, windows: [first, first + count], height });
        let view = atlas.view();
        let [first, last] = view.windows;
        prop_assert!(first < last && last <= atlas.ends.len() && view.height <= last - first);
        let mut out = vec![0.0; view.height];
        // The order is arbitrary: a column starts with the result of the last one.
        for column in (0..atlas.columns()).rev().chain([2, 0]) {
            atlas.draw(index(), column, &mut out);
            let all = every_distance(&mut atlas, column);
            let mut expected = vec![f32::INFINITY; view.height];
            for (i, d) in all[first..last].iter().enumerate() {
                let line = i * view.height / (last - first);
                expected[line] = expected[line].min(*d);
            }
            prop_assert_eq!(&out, &expected);
            let line = view.height / 2;
            let nearest = atlas.nearest(index(), column, line).unwrap();
            prop_assert_eq!(nearest.distance, out[line]);
            prop_assert_eq!(all[nearest.window], out[line]);
            prop_assert_eq!(nearest.row, atlas.ends[nearest.window] as usize);
        }
    }
}

#[test]
fn packed_distances_are_those_of_the_metrics() {
    let mut atlas = Atlas::new(index(), columns());
    for (part, metric) in [(BodyPart::Whole, Metric::FullBody), (BodyPart::Legs, Metric::LowerBody)] {
        let packed = PackedWindows::new(index(), part);
        atlas.view.part = part;
        for column in 0..atlas.columns() {
            let own = every_distance(&mut atlas, column);
            let query = packed.query(&atlas.columns[column]).unwrap();
            for (d, window) in own.iter().zip(packed.classes.iter().flat_map(|c| &packed.windows[c.windows()])) {
                assert!((packed.distance(&query, window) - d).abs() < 1e-5, "{metric:?}");
            }
        }
    }
}

#[test]
fn a_part_of_the_body_does_not_see_the_others() {
    let db = fixtures::database();
    let mut window = QueryWindow::default();
    let mut nodding = QueryWindow::default();
    for i in 0..WINDOW {
        let mut cloud = db.point_cloud[20 + i];
        window.push(&cloud, crate::pose_vector::Placement::default());
        cloud[crate::humanoid::Role::Head.index()].y -= 0.1;
        nodding.push(&cloud, crate::pose_vector::Placement::default());
    }
    for part in BodyPart::ALL {
        let packed = PackedWindows::new(index(), part);
        let [a, b] =
            [&window, &nodding].map(|window| packed.distance(&packed.query(window).unwrap(), &packed.windows[9]));
        assert_eq!(a != b, matches!(part, BodyPart::Whole | BodyPart::Head), "{part:?}: {a} {b}");
    }
    assert!(PackedWindows::new(index(), BodyPart::Head).query(&QueryWindow::default()).is_none());
}

#[test]
fn there_is_no_nearest_window_off_the_picture() {
    let mut atlas = Atlas::new(index(), columns());
    assert!(atlas.nearest(index(), atlas.columns(), 0).is_none());
    assert!(atlas.nearest(index(), 0, 1).is_none());
    assert_eq!(Atlas::new(index(), vec![QueryWindow::default()]).columns(), 0);
    // Classes are padded to whole tiles; the padding is on no line.
    let lines = atlas.packed_lines();
    assert_eq!(lines.len(), atlas.packed(index()).windows.len());
    assert_eq!(lines.iter().filter(|line| **line == 0).count(), *atlas.firsts().last().unwrap());
}

#[test]
fn a_window_of_the_database_stands_where_its_own_figure_does() {
    let db = fixtures::database();
    let places = crate::search::windows::places(&db);
    for (row, by) in [(30, 0.7), (200, -2.4), (333, 3.0)] {
        let mut window = QueryWindow::default();
        let (sin, cos) = crate::math::float_funcs::sin_cos(by);
        for (at, cloud) in places.iter().zip(&db.point_cloud).take(row + 1).skip(row + 1 - WINDOW) {
            let (x, z) = (3.0 + cos * at.x + sin * at.z, -2.0 - sin * at.x + cos * at.z);
            window.push(cloud, Placement { x, z, heading: at.heading + by });
        }
        let pose = db.chart.decode(&db.pose[row], Placement::default());
        let found = nearest_placement(index(), &window, row, &pose, &db.proportions);
        let turned = crate::math::float_funcs::wrap_angle(found.heading - places[row].heading - by);
        assert!(found.x.abs() < 1e-3 && found.z.abs() < 1e-3 && turned.abs() < 1e-2, "{found:?} {turned}");
    }
}
