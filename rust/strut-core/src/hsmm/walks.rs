//! The walks of a database.

use super::features::Track;
use super::steps::steps_of;
use crate::database::Database;

/// The action that is walking, where clips have any of that name.
pub const WALK: &str = "walk";

/// The clips to train a model on, by their numbers: those of [`WALK`], or all where there is no such action.
pub fn walks_among(db: &Database) -> Vec<usize> {
    let walk = db.action_index(WALK);
    (0..db.clips.len()).filter(|&i| walk.is_none_or(|walk| db.clips[i].action == walk)).collect()
}

/// A clip of a database as a walk.
///
/// # Errors
/// With why it is none.
///
/// # Panics
/// If there is no such clip.
pub fn walk_of(db: &Database, clip: usize) -> Result<Track, String> {
    let track = Track::new(&db.motion_of_clip(clip)).map_err(|e| e.to_string())?;
    if steps_of(&track).is_empty() { Err("it holds no step".to_owned()) } else { Ok(track) }
}
