//! Databases and windows for tests, and a GPU if there is one.

use crate::context::Context;
use crate::error::GpuError;
use proptest::prelude::*;
use std::io::Write;
use std::sync::OnceLock;
use strut_core::database::{Clip, Database, DatabaseParts, PointCloud};
use strut_core::humanoid::JOINTS;
use strut_core::math::Vec3;
use strut_core::math::random::SplitMix64;
use strut_core::pose_vector::{HEADING_RATE, HeadingFilter, Placement, VELOCITY_X, VELOCITY_Z};
use strut_core::search::{Index, QueryWindow, WINDOW};
use strut_demo::benchmark::{self, LEAST_FRAMES};

/// Returns a procedural database.
pub(crate) fn database() -> &'static Database {
    static DATABASE: OnceLock<Database> = OnceLock::new();
    DATABASE.get_or_init(|| benchmark::database(LEAST_FRAMES).unwrap())
}

/// Returns the index of the database.
pub(crate) fn index() -> &'static Index {
    static INDEX: OnceLock<Index> = OnceLock::new();
    INDEX.get_or_init(|| Index::build(database()))
}

/// Returns 64 windows that are not in the database.
pub(crate) fn foreign_windows() -> Vec<QueryWindow> {
    let mut windows = Vec::new();
    for query in benchmark::queries() {
        let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
        for (i, pose) in query.motion.poses.iter().enumerate() {
            window.follow(pose, &database().proportions, database().rate_hz, &mut filter);
            if i % 23 == 11 {
                windows.push(window.clone());
            }
        }
    }
    windows.truncate(64);
    assert_eq!(windows.len(), 64);
    windows
}

/// Returns the database with other point clouds: a class for each list, in one clip each.
pub(crate) fn database_of(classes: &[Vec<PointCloud>]) -> Database {
    let procedural = database();
    let mut parts = DatabaseParts {
        actions: (0..classes.len()).map(|i| i.to_string()).collect(),
        styles: vec!["only".into()],
        neutral: 0,
        clips: Vec::new(),
        pose: Vec::new(),
        point_cloud: classes.concat(),
        counterparts_per_style: 1,
        ..(**procedural).clone()
    };
    for (action, clouds) in classes.iter().enumerate() {
        let first_frame = parts.pose.len();
        let of_class = Clip { action: action as u16, style: 0, ..procedural.clips[0].clone() };
        parts.clips.push(Clip { first_frame, frames: clouds.len(), ..of_class });
        parts.pose.extend_from_slice(&procedural.pose[..clouds.len()]);
    }
    let n = parts.pose.len();
    (parts.canonical_time, parts.time_step) = (vec![0.0; n], vec![0.1; n]);
    (parts.contact, parts.counterpart) = (vec![[0; 2]; n], vec![-1.0; n]);
    Database::new(parts).unwrap()
}

/// Returns a database of classes with these numbers of nearly equal windows: a standing figure that trembles by some
/// micrometres.
pub(crate) fn trembling(windows: &[usize]) -> Database {
    let mut random = SplitMix64::new(5);
    let mut tremble = || (random.share() - 0.5) * 1e-5;
    let mut of_frame = |_| database().point_cloud[40].map(|p| p + Vec3::new(tremble(), tremble(), tremble()));
    let classes: Vec<_> = windows.iter().map(|n| (0..n + WINDOW - 1).map(&mut of_frame).collect()).collect();
    let mut parts = (*database_of(&classes)).clone();
    for velocity in [VELOCITY_X, VELOCITY_Z, HEADING_RATE] {
        parts.pose.iter_mut().for_each(|pose| pose[velocity] = 0.0);
    }
    Database::new(parts).unwrap()
}

/// Any point cloud, as large as a person or many times larger.
fn cloud() -> impl Strategy<Value = PointCloud> {
    let point = prop::array::uniform3(-1.0f32..1.0).prop_map(Vec3::from_array);
    prop::collection::vec(point, JOINTS).prop_map(|points| std::array::from_fn(|j| points[j]))
}

/// A database of random point clouds in two classes.
pub(crate) fn random_database() -> impl Strategy<Value = Database> {
    let class = |frames| prop::collection::vec(cloud(), frames);
    (class(8..40), class(8..70), prop::sample::select(vec![0.1f32, 1.0, 30.0])).prop_map(|(a, b, size)| {
        let sized = |class: Vec<PointCloud>| class.iter().map(|cloud| cloud.map(|p| p * size)).collect();
        database_of(&[sized(a), sized(b)])
    })
}

/// Windows of random point clouds on random paths.
pub(crate) fn random_windows() -> impl Strategy<Value = Vec<QueryWindow>> {
    let at = (-2.0f32..2.0, -2.0f32..2.0, -3.0f32..3.0).prop_map(|(x, z, heading)| Placement { x, z, heading });
    let window = prop::collection::vec((cloud(), at), WINDOW).prop_map(|frames| {
        let mut window = QueryWindow::default();
        for (cloud, at) in &frames {
            window.push(cloud, *at);
        }
        window
    });
    prop::collection::vec(window, 1..40)
}

/// Returns the GPU that tests share, with its compiled kernels. Without a GPU prints that the test is skipped. If a
/// driver is named, it must exist.
pub(crate) fn context() -> Option<Context> {
    static CONTEXT: OnceLock<Result<Context, GpuError>> = OnceLock::new();
    or_skip(CONTEXT.get_or_init(Context::new).clone())
}

/// Returns a GPU for a test that stops it; otherwise as [`context`].
pub(crate) fn own_context() -> Option<Context> {
    or_skip(Context::new())
}

fn or_skip(opened: Result<Context, GpuError>) -> Option<Context> {
    if let Err(reason) = &opened {
        assert!(std::env::var_os("VK_ICD_FILENAMES").is_none(), "{reason}, though VK_ICD_FILENAMES names a driver");
        // Not `println!`, whose output cargo shows only for failed tests.
        let _ = writeln!(
            std::io::stderr(),
            "skipped: {reason}; VK_ICD_FILENAMES and LD_LIBRARY_PATH may name Chromium's SwiftShader"
        );
    }
    opened.ok()
}
