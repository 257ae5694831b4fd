//! The exhaustive search on real motion capture outside the database, if it is present (`STRUT_MOCAP`), with the CPU
//! twins of the kernels and on a GPU if there is one.

#[path = "../../strut-formats/tests/mocap/labelled.rs"]
mod labelled;
#[path = "../../strut-formats/tests/mocap/mod.rs"]
mod mocap;

use std::ops::ControlFlow;
use strut_core::database::build::{BuildOptions, SourceClip, build};
use strut_core::parallel::Sequential;
use strut_core::pose_vector::HeadingFilter;
use strut_core::search::{Index, QueryWindow};
use strut_demo::benchmark::{Query, hold_out};
use strut_evaluation::search::ClassSearch;
use strut_gpu::{Context, Searcher};

const K: usize = 40;
/// Distance between searched frames.
const STRIDE: usize = 40;

#[test]
fn neighbours_of_recorded_motion_are_those_of_the_index() {
    let Some(mut paths) = mocap::clips() else { return };
    paths.retain(|path| {
        let path = path.to_string_lossy();
        ["2_walk_normal_00", "2_walk_elderly_00", "2_walk_youthful_00"].iter().any(|name| path.contains(name))
    });
    if paths.is_empty() {
        mocap::skip("no clips of bandai-namco-2");
        return;
    }
    let clips: Vec<SourceClip> = paths.iter().map(labelled::load).collect();
    let (recorded, _) =
        build(&clips, &BuildOptions::default(), &Sequential, &mut |_| ControlFlow::Continue(())).unwrap();
    let (database, queries) = hold_out(&recorded).unwrap();
    let index = Index::build(&database);
    let windows: Vec<QueryWindow> = queries.iter().flat_map(|query| windows(query, database.rate_hz)).collect();
    assert!(windows.len() > 20, "{} windows", windows.len());

    let graphics = Context::new().map_err(|reason| mocap::skip(&reason.to_string())).ok();
    let searchers = std::iter::once(Searcher::without_graphics(&index).unwrap())
        .chain(graphics.map(|context| Searcher::new(&index, context).unwrap()));
    for mut searcher in searchers {
        let found = searcher.nearest(&windows, K).unwrap();
        let mut search = ClassSearch::default();
        for (window, found) in windows.iter().zip(&found.neighbours) {
            for (expected, found) in search.find(&index, window, K).iter().zip(found) {
                assert_eq!(expected.as_slice(), found.as_slice());
            }
        }
        assert_eq!(found.searched_by_index, 0);
    }
}

fn windows(query: &Query, rate_hz: f32) -> Vec<QueryWindow> {
    let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
    let all = query.motion.poses.iter().map(|pose| {
        window.follow(pose, &query.motion.proportions, rate_hz, &mut filter);
        window.clone()
    });
    all.skip(STRIDE / 2).step_by(STRIDE).collect()
}
