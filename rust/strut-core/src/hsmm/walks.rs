//! Selection of the clips that are walks.

use super::features::{Track, TrackError};
use super::steps::steps_of;
use crate::database::Database;
use crate::humanoid::HumanoidMotion;
use thiserror::Error;

/// Name of the walking action.
pub const WALK: &str = "walk";

/// Returns the indices of a database's clips that may be walks: those of [`WALK`], or all if there is no such action.
pub fn walks_among(db: &Database) -> Vec<usize> {
    let walk = db.action_index(WALK);
    (0..db.clips.len()).filter(|&i| walk.is_none_or(|walk| db.clips[i].action == walk)).collect()
}

/// Reason why a clip is not a walk.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum WalkError {
    /// It is not a track.
    #[error(transparent)]
    Track(#[from] TrackError),
    /// No step was found.
    #[error("it contains no step")]
    NoStep,
}

/// Converts a clip to a track, with the number of its steps.
///
/// # Errors
/// See [`WalkError`].
pub fn walk_of(motion: &HumanoidMotion) -> Result<(Track, usize), WalkError> {
    let track = Track::new(motion)?;
    match steps_of(&track).len() {
        0 => Err(WalkError::NoStep),
        steps => Ok((track, steps)),
    }
}

/// Returns the action to train walking on, from the actions and step counts of walks: the one with the most steps, and the
/// first of several with as many.
pub fn walking_action<A: Copy + PartialEq>(walks: &[(A, usize)]) -> Option<A> {
    let steps = |action: A| walks.iter().filter(|w| w.0 == action).map(|w| w.1).sum::<usize>();
    let most = walks.iter().map(|w| steps(w.0)).max()?;
    walks.iter().map(|w| w.0).find(|action| steps(*action) == most)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walking_is_what_most_steps_are_of() {
        assert_eq!(walking_action(&[("run", 4), ("walk", 3), ("walk", 2)]), Some("walk"));
        assert_eq!(walking_action(&[("b", 5), ("a", 5)]), Some("b"));
        assert_eq!(walking_action::<u16>(&[]), None);
    }
}
