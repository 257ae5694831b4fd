//! Which clips are walks.

use super::features::Track;
use super::steps::steps_of;
use crate::database::Database;
use crate::humanoid::HumanoidMotion;

/// The action that is walking, where clips have any of that name.
pub const WALK: &str = "walk";

/// The clips of a database that may be walks, by their numbers: those of [`WALK`], or all where there is no such action.
pub fn walks_among(db: &Database) -> Vec<usize> {
    let walk = db.action_index(WALK);
    (0..db.clips.len()).filter(|&i| walk.is_none_or(|walk| db.clips[i].action == walk)).collect()
}

/// A clip as a walk, with the number of its steps.
///
/// # Errors
/// If the clip is not a walk; with the reason.
pub fn walk_of(motion: &HumanoidMotion) -> Result<(Track, usize), String> {
    let track = Track::new(motion).map_err(|e| e.to_string())?;
    match steps_of(&track).len() {
        0 => Err("it holds no step".to_owned()),
        steps => Ok((track, steps)),
    }
}

/// The action to learn walking from, of walks with their actions and numbers of steps: that with the most steps, and of two
/// with as many the one that comes first.
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
