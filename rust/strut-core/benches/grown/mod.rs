//! Databases of any size made from a real one, and motion that is not in them.

use strut_core::database::{Clip, Database, DatabaseParts};
use strut_core::humanoid::JOINTS;
use strut_core::math::Vec3;
use strut_core::math::float_funcs::sin;
use strut_core::pose_vector::{HEADING_RATE, Placement};
use strut_core::search::QueryWindow;

/// Interval of the clips that are held out of the database.
const HELD_OUT: usize = 8;

/// A database of about `frames` frames in `classes` classes: the clips of another except one in eight, repeated as
/// often as needed with their points smoothly displaced by a few centimetres.
pub(crate) fn grown(db: &Database, frames: usize, classes: usize) -> Database {
    let kept: Vec<&Clip> = db.clips.iter().enumerate().filter(|(i, _)| i % HELD_OUT != 0).map(|(_, c)| c).collect();
    assert!(kept.len() >= classes, "{} clips are too few for {classes} classes", kept.len());
    // Classes of many clips are divided until there are enough classes.
    let mut groups: Vec<Vec<&Clip>> = db
        .classes()
        .iter()
        .map(|class| kept.iter().copied().filter(|c| (c.action, c.style) == (class.action, class.style)).collect())
        .filter(|group: &Vec<&Clip>| !group.is_empty())
        .collect();
    while groups.len() < classes {
        let largest = (0..groups.len()).max_by_key(|&i| groups[i].len()).unwrap();
        let half = groups[largest].len() / 2;
        let rest = groups[largest].split_off(half);
        groups.push(rest);
    }
    let mut parts = DatabaseParts {
        actions: (0..groups.len()).map(|i| format!("action {i}")).collect(),
        styles: vec!["style".into()],
        neutral: 0,
        clips: Vec::new(),
        pose: Vec::new(),
        point_cloud: Vec::new(),
        canonical_time: Vec::new(),
        time_step: Vec::new(),
        contact: Vec::new(),
        counterparts_per_style: 1,
        counterpart: Vec::new(),
        ..(**db).clone()
    };
    for (action, group) in groups.iter().enumerate() {
        let wanted = frames * (action + 1) / groups.len() - parts.pose.len();
        let mut left = wanted;
        for copy in 0.. {
            for clip in group {
                let rows = clip.first_frame..clip.first_frame + clip.frames.min(left);
                left -= rows.len();
                if rows.len() < 2 {
                    break;
                }
                parts.clips.push(Clip {
                    name: format!("{} {copy}", clip.name),
                    action: action as u16,
                    style: 0,
                    first_frame: parts.pose.len(),
                    frames: rows.len(),
                    ..(*clip).clone()
                });
                for row in rows {
                    parts.pose.push(db.pose[row]);
                    parts.point_cloud.push(moved(&db.point_cloud[row], copy, row));
                }
            }
            if left < 2 {
                break;
            }
        }
    }
    let n = parts.pose.len();
    parts.canonical_time = vec![0.0; n];
    parts.time_step = vec![1.0 / db.rate_hz; n];
    parts.contact = vec![[0; 2]; n];
    parts.counterpart = vec![-1.0; n];
    Database::new(parts).unwrap()
}

/// A frame of a copy of a clip; copy 0 is the clip itself.
fn moved(cloud: &[Vec3; JOINTS], copy: usize, row: usize) -> [Vec3; JOINTS] {
    std::array::from_fn(|joint| {
        let wave = |axis: usize| {
            let phase = (copy * 7 + joint * 3 + axis) as f32 * 2.4;
            let amplitude = if copy == 0 { 0.0 } else { 0.02 };
            amplitude * (sin(phase) + sin(phase * 1.7 + row as f32 * (0.03 + 0.01 * sin(phase * 3.1))))
        };
        cloud[joint] + Vec3::new(wave(0), wave(1), wave(2))
    })
}

/// Windows of the clips that [`grown`] holds out, frame by frame.
pub(crate) fn held_out(db: &Database) -> Vec<QueryWindow> {
    let mut windows = Vec::new();
    for clip in db.clips.iter().step_by(HELD_OUT) {
        let (mut window, mut at) = (QueryWindow::default(), Placement::default());
        for row in clip.rows() {
            let dt = 1.0 / db.rate_hz;
            at = at.advanced(&db.pose[row], dt, db.pose[row][HEADING_RATE] * dt);
            window.push(&db.point_cloud[row], at);
            windows.push(window.clone());
        }
    }
    windows
}
