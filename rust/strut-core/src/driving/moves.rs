//! Moves that a driver plays on request: the motion of a clip between two rests.

use crate::humanoid::{Pose, Proportions, Role};
use crate::kinematics::world_from_local;
use crate::math::stats::runs_where;
use crate::math::{Vec2, Vec3};
use std::ops::Range;

/// Joints whose speeds distinguish a move from a rest.
const POINTS: [Role; 6] = [Role::Hips, Role::Head, Role::LeftHand, Role::RightHand, Role::LeftFoot, Role::RightFoot];
/// At rest the fastest of them is slower than this, m/s, in the mean over frames within this time, seconds …
const REST_SPEED: f32 = 0.75;
const MEAN_HALF_SECS: f32 = 1.0 / 30.0;
/// … and none is farther than this from its place at the beginning of the clip, metres: a fist or a foot that is held
/// out is not at rest.
const REST_DISTANCE: f32 = 0.2;
/// A move takes at least this long, seconds, and its peak speed is higher than this, m/s.
const LEAST_SECS: f32 = 1.0 / 3.0;
const LEAST_PEAK: f32 = 1.0;

/// Shortest time without a planted foot that counts as the flight of a jump, seconds.
const LEAST_FLIGHT_SECS: f32 = 0.1;
/// A move is entered at most this long after its beginning, and the flight of a jump at most this long before its take-off,
/// seconds.
const ENTRY_SECS: f32 = 1.0 / 6.0;
const BEFORE_TAKE_OFF_SECS: f32 = 1.0 / 30.0;

/// A move that can be requested besides locomotion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Move {
    /// A jump.
    Jump,
    /// A strike with a fist.
    Punch,
    /// A kick.
    Kick,
}

impl Move {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Jump, Self::Punch, Self::Kick];

    /// Its name, with which the names of its actions begin, as in "jump" and "jumping".
    pub fn name(self) -> &'static str {
        match self {
            Self::Jump => "jump",
            Self::Punch => "punch",
            Self::Kick => "kick",
        }
    }

    /// Returns the move of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.name() == name)
    }

    /// The move that clips of an action contain.
    pub(super) fn of_action(action: &str) -> Option<Self> {
        let action = action.to_ascii_lowercase();
        Self::ALL.into_iter().find(|of| action.starts_with(of.name()))
    }
}

/// The part of a move that is played.
pub(super) struct MovePart {
    /// Rows at which it may be entered.
    pub(super) entries: Range<usize>,
    /// The row after its last one.
    pub(super) end: usize,
}

/// The rows of a move, from rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MoveRows {
    pub(super) action: Move,
    pub(super) rows: Range<usize>,
    /// The rows of a jump from take-off to landing: no foot is planted.
    pub(super) flight: Option<Range<usize>>,
}

impl MoveRows {
    /// Shifts the rows for a clip that begins at row `first`.
    pub(super) fn after(&self, first: usize) -> Self {
        let shifted = |rows: &Range<usize>| first + rows.start..first + rows.end;
        Self { action: self.action, rows: shifted(&self.rows), flight: self.flight.as_ref().map(shifted) }
    }

    /// Returns the whole move, which may be entered in its first rows.
    pub(super) fn part_from_rest(&self, rate_hz: f32) -> MovePart {
        let Range { start, end } = self.rows;
        MovePart { entries: start..(start + rows_in(ENTRY_SECS, rate_hz)).min(end), end }
    }

    /// Returns the flight of a jump, which may be entered up to its take-off; `None` for a move without a flight.
    pub(super) fn part_from_take_off(&self, rate_hz: f32) -> Option<MovePart> {
        let Range { start, end } = self.flight.clone()?;
        let first = start.saturating_sub(rows_in(BEFORE_TAKE_OFF_SECS, rate_hz)).max(self.rows.start);
        Some(MovePart { entries: first..start + 1, end })
    }
}

/// The moves of a clip, as frame ranges; `contacts` has one entry per pose.
pub(super) fn moves_in(
    action: Move,
    proportions: &Proportions,
    poses: &[Pose],
    contacts: &[[bool; 2]],
    rate_hz: f32,
) -> Vec<MoveRows> {
    let points: Vec<[Vec3; POINTS.len()]> = poses
        .iter()
        .map(|pose| {
            let world = world_from_local(proportions, pose);
            POINTS.map(|role| world.positions[role.index()])
        })
        .collect();
    let speeds = fastest(&points, rate_hz);
    let is_rest = |frame: usize| speeds[frame] < REST_SPEED && distance(&points[0], &points[frame]) < REST_DISTANCE;
    let mut rests = runs_where(points.len(), is_rest).into_iter();
    let mut found = Vec::new();
    let Some(mut before) = rests.next() else { return found };
    for rest in rests {
        let rows = before.end - 1..rest.start + 1;
        let peak = speeds[rows.clone()].iter().copied().fold(0.0, f32::max);
        if rows.len() as f32 >= LEAST_SECS * rate_hz && peak > LEAST_PEAK {
            let flight = (action == Move::Jump).then(|| flight_in(&contacts[rows.clone()], rate_hz)).flatten();
            let flight = flight.map(|flight| rows.start + flight.start..rows.start + flight.end);
            found.push(MoveRows { action, rows, flight });
        }
        before = rest;
    }
    found
}

fn rows_in(secs: f32, rate_hz: f32) -> usize {
    (secs * rate_hz).round() as usize
}

/// The longest run of frames without a planted foot, if it is long enough for a jump.
fn flight_in(contacts: &[[bool; 2]], rate_hz: f32) -> Option<Range<usize>> {
    let flights = runs_where(contacts.len(), |frame| contacts[frame] == [false; 2]);
    flights.into_iter().max_by_key(ExactSizeIterator::len).filter(|of| of.len() as f32 >= LEAST_FLIGHT_SECS * rate_hz)
}

/// Greatest distance of corresponding points by height and by distance from the hips: independent of the body's place
/// and heading.
fn distance(a: &[Vec3; POINTS.len()], b: &[Vec3; POINTS.len()]) -> f32 {
    let place = |of: &[Vec3; POINTS.len()], i: usize| Vec2::new((of[i] - of[0]).with_y(0.0).length(), of[i].y);
    (0..POINTS.len()).map(|i| place(a, i).distance(place(b, i))).fold(0.0, f32::max)
}

/// Speed of the fastest point in every frame, m/s, as a mean over the frames around it.
fn fastest(points: &[[Vec3; POINTS.len()]], rate_hz: f32) -> Vec<f32> {
    let speeds: Vec<f32> = (0..points.len())
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(points.len() - 1));
            let per_sec = rate_hz / (b - a).max(1) as f32;
            let each = points[a].iter().zip(&points[b]).map(|(a, b)| a.distance(*b) * per_sec);
            each.fold(0.0, f32::max)
        })
        .collect();
    let half = (MEAN_HALF_SECS * rate_hz).round() as usize;
    (0..speeds.len())
        .map(|i| {
            let around = &speeds[i.saturating_sub(half)..(i + half + 1).min(speeds.len())];
            around.iter().sum::<f32>() / around.len() as f32
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Quat;
    use crate::math::float_funcs::sin;

    #[test]
    fn lie_between_rests() {
        // An arm that is raised and lowered twice, with a second of rest before, between and after.
        let raised = |frame: usize| {
            let within = frame % 120;
            let share = (within as f32 / 60.0 - 1.0).max(0.0);
            let half_wave = sin(share * std::f32::consts::PI);
            1.5 * half_wave * half_wave
        };
        let poses: Vec<Pose> = (0..300)
            .map(|frame| {
                let mut pose = Pose { root: Vec3::Y, ..Pose::default() };
                pose.rotations[Role::RightUpperArm.index()] = Quat::from_rotation_z(raised(frame));
                pose
            })
            .collect();
        let contacts = vec![[true; 2]; poses.len()];
        let moves = moves_in(Move::Punch, &Proportions::default(), &poses, &contacts, 60.0);
        assert_eq!(moves.len(), 2, "{moves:?}");
        for (number, of) in moves.iter().enumerate() {
            let begin = 60 + 120 * number;
            assert!(of.rows.start < begin + 10 && of.rows.end > begin + 50, "{of:?}");
        }
    }

    #[test]
    fn are_told_by_the_names_of_actions() {
        assert_eq!(Move::of_action("Jumping"), Some(Move::Jump));
        assert_eq!(Move::of_action("walk"), None);
        assert_eq!(Move::named("kick"), Some(Move::Kick));
    }
}
