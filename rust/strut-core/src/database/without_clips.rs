//! Removes clips from a database, to hold them out for evaluation or measurement.

use super::offline::Database;
use super::parts::{Clip, DatabaseParts};
use super::validation::DatabaseError;
use crate::humanoid::HumanoidMotion;

impl Database {
    /// The database without the clips of these indices. Counterparts in them are lost.
    ///
    /// # Errors
    /// If no clip is left.
    pub fn without_clips(&self, indices: &[usize]) -> Result<Self, DatabaseError> {
        let kept: Vec<&Clip> =
            self.clips.iter().enumerate().filter(|(i, _)| !indices.contains(i)).map(|(_, c)| c).collect();
        let mut parts = DatabaseParts {
            clips: Vec::with_capacity(kept.len()),
            pose: Vec::new(),
            point_cloud: Vec::new(),
            canonical_time: Vec::new(),
            time_step: Vec::new(),
            contact: Vec::new(),
            counterpart: Vec::new(),
            actions: self.actions.clone(),
            styles: self.styles.clone(),
            ..**self
        };
        for clip in &kept {
            parts.clips.push(Clip { first_frame: parts.pose.len(), ..(*clip).clone() });
            parts.pose.extend_from_slice(&self.pose[clip.rows()]);
            parts.point_cloud.extend_from_slice(&self.point_cloud[clip.rows()]);
            parts.canonical_time.extend_from_slice(&self.canonical_time[clip.rows()]);
            parts.time_step.extend_from_slice(&self.time_step[clip.rows()]);
            parts.contact.extend_from_slice(&self.contact[clip.rows()]);
        }
        let moved = |at: f32| {
            let new = kept.partition_point(|c| c.rows().end <= at as usize);
            kept.get(new).filter(|c| c.rows().contains(&(at as usize)))?;
            let (from, to) = (kept[new].first_frame, parts.clips[new].first_frame);
            // A row index between two clips would be interpolated across clips.
            Some((to as f32 + (at - from as f32)).min((to + kept[new].frames - 1) as f32))
        };
        for row in kept.iter().flat_map(|c| c.rows()) {
            for style in 0..self.styles.len() as u16 {
                let end = parts.counterpart.len() + self.counterparts_per_style;
                parts.counterpart.extend(self.counterparts(row, style).filter_map(moved));
                parts.counterpart.resize(end, -1.0);
            }
        }
        Self::new(parts)
    }

    /// Motion of a clip, starting above the origin and heading along +Z.
    ///
    /// # Panics
    /// If the clip does not exist.
    pub fn motion_of_clip(&self, clip: usize) -> HumanoidMotion {
        let rows = self.pose[self.clips[clip].rows()].iter().copied();
        let poses = self.chart.decode_clip(rows, 1.0 / self.rate_hz);
        HumanoidMotion { proportions: self.proportions, rate_hz: self.rate_hz, poses }
    }
}

#[cfg(test)]
mod tests {
    use crate::fixtures::database;

    /// Counterparts lie in the same frames of the same clips as before; those in removed clips are lost.
    #[test]
    fn counterparts_move_with_their_clips() {
        let db = database();
        let removed = db.clips.len() / 2;
        let less = db.without_clips(&[removed]).unwrap();
        let place_in = |clips: &[super::Clip], at: f32| {
            let clip = clips.iter().position(|c| c.rows().contains(&(at as usize))).unwrap();
            (clips[clip].name.clone(), at - clips[clip].first_frame as f32)
        };
        let mut lost = 0;
        let kept = db.clips.iter().enumerate().filter(|(i, _)| *i != removed).map(|(_, clip)| clip);
        for (before, after) in kept.zip(&less.clips) {
            assert_eq!(before.name, after.name);
            for (row, new_row) in before.rows().zip(after.rows()) {
                for style in 0..db.styles.len() as u16 {
                    let places = db.counterparts(row, style).map(|at| place_in(&db.clips, at));
                    let all: Vec<_> = places.collect();
                    let expected: Vec<_> = all.iter().filter(|(name, _)| *name != db.clips[removed].name).collect();
                    let found: Vec<_> = less.counterparts(new_row, style).map(|at| place_in(&less.clips, at)).collect();
                    lost += all.len() - expected.len();
                    assert_eq!(found.len(), expected.len());
                    for ((name, frame), (expected_name, expected_frame)) in found.iter().zip(expected) {
                        // Frames are rounded to single precision where the clip lies.
                        assert_eq!(name, expected_name);
                        assert!((frame - expected_frame).abs() < 1e-3, "{frame} {expected_frame}");
                    }
                }
            }
        }
        assert!(lost > 0);
    }
}
