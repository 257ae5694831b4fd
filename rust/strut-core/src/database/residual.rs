//! Residual distance of registered clips, for reports.

use super::offline::Database;
use crate::humanoid::JOINTS;
use crate::math::Vec3;

/// Interval of the frames that are measured: neighbouring frames are nearly equal.
const STRIDE: usize = 4;

/// Mean distance of each clip's joints from those of its counterparts in all styles, metres, after the mean offset from
/// its class to the style is removed. It is the part that neither timing nor a constant pose explains. 0 for a clip
/// without counterparts.
pub fn residuals(db: &Database) -> Vec<f32> {
    let mut sums = vec![(0.0_f64, 0_usize); db.clips.len()];
    for class in db.classes() {
        for style in 0..db.styles.len() as u16 {
            let apart: Vec<(usize, [Vec3; JOINTS])> = class
                .clips
                .clone()
                .flat_map(|clip| db.clips[clip].rows().step_by(STRIDE).map(move |row| (clip, row)))
                .filter_map(|(clip, row)| Some((clip, difference(db, row, style)?)))
                .collect();
            let mut offset = [Vec3::ZERO; JOINTS];
            for (_, joints) in &apart {
                for (sum, joint) in offset.iter_mut().zip(joints) {
                    *sum += *joint / apart.len() as f32;
                }
            }
            for (clip, joints) in &apart {
                let left: f32 = joints.iter().zip(&offset).map(|(joint, offset)| (*joint - *offset).length()).sum();
                sums[*clip].0 += f64::from(left / JOINTS as f32);
                sums[*clip].1 += 1;
            }
        }
    }
    sums.into_iter().map(|(sum, count)| (sum / count.max(1) as f64) as f32).collect()
}

/// Joints of a row minus the mean of its counterparts' joints in a style; `None` without counterparts.
fn difference(db: &Database, row: usize, style: u16) -> Option<[Vec3; JOINTS]> {
    let (mut sum, mut count) = ([Vec3::ZERO; JOINTS], 0.0);
    for at in db.counterparts(row, style) {
        let i = (at as usize).min(db.frames() - 1);
        let (a, b) = (&db.point_cloud[i], &db.point_cloud[(i + 1).min(db.frames() - 1)]);
        for (sum, (a, b)) in sum.iter_mut().zip(a.iter().zip(b)) {
            *sum += *a + (*b - *a) * (at - i as f32);
        }
        count += 1.0;
    }
    (count > 0.0).then(|| std::array::from_fn(|j| db.point_cloud[row][j] - sum[j] / count))
}
