//! Neutral clips and their mirror images, in the frame of their root.

use super::moves::{Move, MoveRows, moves_in};
use super::smoothing::smoothed;
use crate::database::Database;
use crate::humanoid::{HumanoidMotion, Pose, Proportions, TooManyFrames};
use crate::kinematics::world_from_local;
use crate::math::float_funcs::{atan2, wrap_angle};
use crate::math::stats;
use crate::math::{Quat, Vec2, Vec3};
use crate::pose_vector::heading_of;
use crate::retarget::between_bodies;
use std::ops::Range;
use thiserror::Error;

/// Half-widths of the windows over which the root's place and heading are smoothed, seconds: 31 and 61 frames at 60 Hz.
const PLACE_HALF_SECS: f32 = 0.25;
const HEADING_HALF_SECS: f32 = 0.5;
/// A clip whose median root speed is lower than this is not locomotion, m/s.
const LEAST_SPEED: f32 = 0.4;
/// Least locomotion that driving needs, seconds.
const LEAST_SECS: f32 = 5.0;
/// Rows within this time, seconds, of one whose root is slower than this, m/s, are standing: 15 frames at 60 Hz.
const STANDING_SECS: f32 = 0.25;
const STANDING_SPEED: f32 = 0.3;
/// A clip on the spot that turns by more than this, radians, is a turn.
const LEAST_TURN: f32 = 0.5;
/// The database contains standing if its clips have this many seconds with a root slower than this, m/s.
const KNOWN_STANDING_SECS: f32 = 0.5;
const KNOWN_STANDING_SPEED: f32 = 0.1;

/// A clip used for driving.
#[derive(Clone, Debug, PartialEq)]
pub struct NeutralClip {
    /// Display name.
    pub name: String,
    /// Its action, such as "walk".
    pub action: String,
    /// One pose per frame, in the world.
    pub poses: Vec<Pose>,
    /// Which feet are planted in each frame, [left, right].
    pub contacts: Vec<[bool; 2]>,
}

/// Error of clips that driving cannot use.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DrivingError {
    /// The clips contain too little locomotion.
    #[error("the neutral clips have {secs:.1} s of walking; driving needs {LEAST_SECS} s")]
    TooShort {
        /// Seconds of clips in which the root moves.
        secs: f32,
    },
    /// A clip's numbers of contacts and poses differ.
    #[error("the clip '{name}' has {poses} poses and {contacts} contacts")]
    Shape {
        /// Its name.
        name: String,
        /// Number of its poses.
        poses: usize,
        /// Number of its contacts.
        contacts: usize,
    },
}

impl NeutralClip {
    /// Returns the neutral clips of a database.
    pub fn all_of(db: &Database) -> Vec<Self> {
        let neutral = (0..db.clips.len()).filter(|&clip| db.clips[clip].style == db.neutral);
        neutral.map(|clip| Self::of(db, clip, db.motion_of_clip(clip).poses)).collect()
    }

    /// Returns the neutral clips of a database of takes, converted to another body and frame rate.
    ///
    /// # Errors
    /// [`TooManyFrames`] if a clip has too many frames at this rate.
    pub fn all_carried(takes: &Database, body: &Proportions, rate_hz: f32) -> Result<Vec<Self>, TooManyFrames> {
        let neutral = (0..takes.clips.len()).filter(|&clip| takes.clips[clip].style == takes.neutral);
        let carried = |clip| {
            let of = Self::of(takes, clip, takes.motion_of_clip(clip).poses);
            of.carried(takes.proportions, takes.rate_hz, body, rate_hz)
        };
        neutral.map(carried).collect()
    }

    /// Converts the clip from a body and a frame rate to others.
    ///
    /// # Errors
    /// [`TooManyFrames`] if it has too many frames at this rate.
    pub fn carried(
        self,
        from: Proportions,
        from_hz: f32,
        body: &Proportions,
        rate_hz: f32,
    ) -> Result<Self, TooManyFrames> {
        let motion = HumanoidMotion { proportions: from, rate_hz: from_hz, poses: self.poses };
        let poses = between_bodies(&motion, body).resampled(rate_hz)?.poses;
        let last = self.contacts.len().saturating_sub(1);
        let at = |i: usize| ((i as f32 * from_hz / rate_hz).round() as usize).min(last);
        let contacts = (0..poses.len()).map(|i| self.contacts.get(at(i)).copied().unwrap_or_default()).collect();
        Ok(Self { poses, contacts, ..self })
    }

    fn of(db: &Database, clip: usize, poses: Vec<Pose>) -> Self {
        let of = &db.clips[clip];
        Self {
            name: of.name.clone(),
            action: db.actions[usize::from(of.action)].clone(),
            poses,
            contacts: db.contact[of.rows()].iter().map(|feet| feet.map(|planted| planted != 0)).collect(),
        }
    }
}

/// Purpose of a clip of [`DrivingClips`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClipKind {
    /// Locomotion, from the database or from the spare clips.
    Locomotion,
    /// A take that the database lacks: standing, a turn on the spot, a halt, a change of gait.
    Take,
    /// Moves that are played on request.
    Moves,
}

/// A clip of [`DrivingClips`].
#[derive(Clone, Debug, PartialEq)]
pub struct DrivingClip {
    /// Index of its source clip: the database's own clips come first, then spare clips, then takes.
    pub source: usize,
    /// Its purpose.
    pub kind: ClipKind,
    /// Whether left and right are swapped.
    pub mirrored: bool,
    /// Whether the clip turns on the spot.
    pub(super) turns: bool,
    /// Its rows.
    pub rows: Range<usize>,
}

/// Motion of the root at a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RootMotion {
    /// Velocity over the ground in the root's frame, (x, z) in m/s.
    pub velocity: Vec2,
    /// Turn rate, rad/s about +Y.
    pub turn_rate: f32,
}

/// Neutral motion in the frame of its root: on the ground under the hips, with the heading of the body, both smoothed.
#[derive(Clone, Debug)]
pub struct DrivingClips {
    /// Bone offsets.
    pub proportions: Proportions,
    /// Frames per second.
    pub rate_hz: f32,
    names: Vec<String>,
    clips: Vec<DrivingClip>,
    poses: Vec<Pose>,
    motions: Vec<RootMotion>,
    contacts: Vec<[bool; 2]>,
    standing: Vec<bool>,
    moves: Vec<MoveRows>,
    knows_standing: bool,
}

impl DrivingClips {
    /// Collects the locomotion and the moves of the database's clips, `own`, and all `takes`; each also mirrored. If
    /// `own` contains too little locomotion, that of `spare` replaces it.
    ///
    /// # Errors
    /// [`DrivingError`] if the database's own locomotion is too short and `spare` has none, or if a clip is
    /// inconsistent.
    pub fn new(
        proportions: Proportions,
        rate_hz: f32,
        own: &[NeutralClip],
        spare: &[NeutralClip],
        takes: &[NeutralClip],
    ) -> Result<Self, DrivingError> {
        let all = || own.iter().chain(spare).chain(takes);
        let mut of = Self {
            proportions,
            rate_hz,
            names: all().map(|clip| clip.name.clone()).collect(),
            clips: vec![],
            poses: vec![],
            motions: vec![],
            contacts: vec![],
            standing: vec![],
            moves: vec![],
            knows_standing: false,
        };
        for clip in all() {
            let (poses, contacts) = (clip.poses.len(), clip.contacts.len());
            if poses != contacts {
                return Err(DrivingError::Shape { name: clip.name.clone(), poses, contacts });
            }
        }
        let trajectories: Vec<RootTrajectory> = own.iter().map(|clip| of.trajectory_of(clip)).collect();
        let stands = |motion: &&RootMotion| motion.velocity.length() < KNOWN_STANDING_SPEED;
        let stood = trajectories.iter().flat_map(|trajectory| &trajectory.motions).filter(stands).count();
        of.knows_standing = stood as f32 >= KNOWN_STANDING_SECS * rate_hz;
        let is_locomotion = |clip: &NeutralClip, trajectory: &RootTrajectory| {
            Move::of_action(&clip.action).is_none() && median_speed(&trajectory.motions) > LEAST_SPEED
        };
        let walked = own
            .iter()
            .zip(&trajectories)
            .filter(|(clip, trajectory)| is_locomotion(clip, trajectory))
            .map(|(clip, _)| clip.poses.len());
        let secs = walked.sum::<usize>() as f32 / rate_hz;
        let is_enough = secs >= LEAST_SECS;
        for (source, (clip, trajectory)) in own.iter().zip(&trajectories).enumerate() {
            if Move::of_action(&clip.action).is_some() {
                of.add(source, ClipKind::Moves, clip, trajectory);
            } else if is_enough && is_locomotion(clip, trajectory) {
                of.add(source, ClipKind::Locomotion, clip, trajectory);
            }
        }
        for (i, clip) in spare.iter().enumerate().filter(|_| !is_enough) {
            let trajectory = of.trajectory_of(clip);
            if is_locomotion(clip, &trajectory) {
                of.add(own.len() + i, ClipKind::Locomotion, clip, &trajectory);
            }
        }
        if !of.clips.iter().any(|clip| clip.kind == ClipKind::Locomotion) {
            return Err(DrivingError::TooShort { secs });
        }
        for (i, clip) in takes.iter().enumerate() {
            let trajectory = of.trajectory_of(clip);
            of.add(own.len() + spare.len() + i, ClipKind::Take, clip, &trajectory);
        }
        Ok(of)
    }

    fn trajectory_of(&self, clip: &NeutralClip) -> RootTrajectory {
        let roots = root_path(&self.proportions, &clip.poses, self.rate_hz);
        let motions = root_motions(&roots, self.rate_hz);
        RootTrajectory { roots, motions }
    }

    fn add(
        &mut self,
        source: usize,
        kind: ClipKind,
        clip: &NeutralClip,
        RootTrajectory { roots, motions }: &RootTrajectory,
    ) {
        let on_the_spot = median_speed(motions) <= LEAST_SPEED;
        let turned = motions.iter().map(|motion| motion.turn_rate).sum::<f32>() / self.rate_hz;
        let turns = kind == ClipKind::Take && on_the_spot && turned.abs() > LEAST_TURN;
        let standing =
            if kind == ClipKind::Take { standing_rows(motions, self.rate_hz) } else { vec![false; motions.len()] };
        let moves = match Move::of_action(&clip.action).filter(|_| kind == ClipKind::Moves) {
            Some(action) => moves_in(action, &self.proportions, &clip.poses, &clip.contacts, self.rate_hz),
            None => vec![],
        };
        for mirrored in [false, true] {
            let first = self.poses.len();
            for (pose, root) in clip.poses.iter().zip(roots) {
                let in_root = root.take(pose);
                self.poses.push(if mirrored { in_root.mirrored() } else { in_root });
            }
            self.motions.extend(motions.iter().map(|motion| if mirrored { motion.mirrored() } else { *motion }));
            self.contacts.extend(
                clip.contacts.iter().map(|&[left, right]| if mirrored { [right, left] } else { [left, right] }),
            );
            self.standing.extend(&standing);
            self.moves.extend(moves.iter().map(|found| found.after(first)));
            self.clips.push(DrivingClip { source, kind, mirrored, turns, rows: first..self.poses.len() });
        }
    }

    /// Returns the name of a clip's source.
    pub fn name(&self, clip: &DrivingClip) -> &str {
        &self.names[clip.source]
    }

    /// Moves that can be requested.
    pub fn moves(&self) -> impl Iterator<Item = Move> {
        Move::ALL.into_iter().filter(|action| self.moves.iter().any(|of| of.action == *action))
    }

    /// The rows of all moves.
    pub(super) fn move_rows(&self) -> &[MoveRows] {
        &self.moves
    }

    /// Whether a row belongs to standing.
    pub(super) fn is_standing(&self, row: usize) -> bool {
        self.standing[row]
    }

    /// Whether the database's own clips contain standing; without it, standing cannot be styled fully.
    pub(super) fn knows_standing(&self) -> bool {
        self.knows_standing
    }

    /// The clips in the order of their rows, which are contiguous.
    pub fn clips(&self) -> &[DrivingClip] {
        &self.clips
    }

    /// Number of rows of all clips.
    pub fn rows(&self) -> usize {
        self.poses.len()
    }

    /// The median speed of a clip's root over the ground, m/s.
    pub fn median_speed(&self, clip: &DrivingClip) -> f32 {
        median_speed(&self.motions[clip.rows.clone()])
    }

    /// The pose at a row in the frame of its root.
    pub fn pose(&self, row: usize) -> &Pose {
        &self.poses[row]
    }

    /// Motion of the root at a row.
    pub fn motion(&self, row: usize) -> RootMotion {
        self.motions[row]
    }

    /// Which feet are planted at a row, [left, right].
    pub fn contact(&self, row: usize) -> [bool; 2] {
        self.contacts[row]
    }

    /// Index of the clip of a row.
    pub fn clip_of(&self, row: usize) -> usize {
        self.clips.partition_point(|clip| clip.rows.end <= row)
    }
}

/// Flags rows within `STANDING_SECS` of a slow root.
fn standing_rows(motions: &[RootMotion], rate_hz: f32) -> Vec<bool> {
    let near = (STANDING_SECS * rate_hz).round() as usize;
    let is_slow = |motion: &RootMotion| motion.velocity.length() < STANDING_SPEED;
    (0..motions.len())
        .map(|i| motions[i.saturating_sub(near)..(i + near + 1).min(motions.len())].iter().any(is_slow))
        .collect()
}

fn median_speed(motions: &[RootMotion]) -> f32 {
    stats::median(motions.iter().map(|motion| motion.velocity.length().into())).map_or(0.0, |speed| speed as f32)
}

impl RootMotion {
    fn mirrored(self) -> Self {
        Self { velocity: Vec2::new(-self.velocity.x, self.velocity.y), turn_rate: -self.turn_rate }
    }
}

/// Transform of the root: a place on the ground and a heading about +Y.
#[derive(Clone, Copy, Debug)]
struct Root {
    place: Vec3,
    heading: f32,
}

/// The trajectory of a clip's root, frame by frame.
struct RootTrajectory {
    roots: Vec<Root>,
    motions: Vec<RootMotion>,
}

impl Root {
    /// Converts a pose from the world to the root's frame.
    fn take(&self, pose: &Pose) -> Pose {
        let turn = Quat::from_rotation_y(-self.heading);
        let mut out = *pose;
        out.root = turn * (pose.root - self.place);
        out.rotations[0] = turn * pose.rotations[0];
        out
    }
}

/// The root of every pose.
fn root_path(proportions: &Proportions, poses: &[Pose], rate_hz: f32) -> Vec<Root> {
    let places: Vec<[f64; 2]> = poses.iter().map(|pose| [pose.root.x, pose.root.z].map(f64::from)).collect();
    let mut heading = 0.0;
    let headings: Vec<[f64; 2]> = poses
        .iter()
        .map(|pose| {
            heading = heading_of(&world_from_local(proportions, pose)).unwrap_or(heading);
            let forward = Quat::from_rotation_y(heading) * Vec3::Z;
            [forward.x, forward.z].map(f64::from)
        })
        .collect();
    let half = |secs: f32| (secs * rate_hz).round() as usize;
    let places = smoothed(&places, half(PLACE_HALF_SECS));
    let headings = smoothed(&headings, half(HEADING_HALF_SECS));
    let root = |([x, z], [fx, fz]): (&[f64; 2], &[f64; 2])| Root {
        place: Vec3::new(*x as f32, 0.0, *z as f32),
        heading: atan2(*fx as f32, *fz as f32),
    };
    places.iter().zip(&headings).map(root).collect()
}

/// Motion of the root: central differences, one-sided at the ends.
fn root_motions(roots: &[Root], rate_hz: f32) -> Vec<RootMotion> {
    (0..roots.len())
        .map(|i| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(roots.len() - 1));
            let per_sec = rate_hz / (b - a).max(1) as f32;
            let travel = (roots[b].place - roots[a].place) * per_sec;
            let velocity = Quat::from_rotation_y(-roots[i].heading) * travel;
            let turn_rate = wrap_angle(roots[b].heading - roots[a].heading) * per_sec;
            RootMotion { velocity: Vec2::new(velocity.x, velocity.z), turn_rate }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driving::tests::circle;

    #[test]
    fn are_in_the_frame_of_a_root_that_goes_round_as_the_clip_does() {
        let clips = DrivingClips::new(Proportions::default(), 60.0, &[circle(600, 1.2, 0.4)], &[], &[]).unwrap();
        let [clip, mirror] = clips.clips() else { panic!("the clip and its mirror image") };
        assert_eq!((clip.rows.clone(), mirror.rows.clone()), (0..600, 600..1200));
        for row in 40..560 {
            let motion = clips.motion(row);
            assert!((motion.velocity - Vec2::new(0.0, 1.2)).length() < 0.02, "{motion:?}");
            assert!((motion.turn_rate - 0.4).abs() < 0.01, "{motion:?}");
            let hips = clips.pose(row).root;
            assert!(Vec2::new(hips.x, hips.z).length() < 0.01, "{hips}");
            assert_eq!(clips.motion(row + 600), motion.mirrored());
            assert_eq!(clips.contact(row + 600), [clips.contact(row)[1], clips.contact(row)[0]]);
            assert_eq!(clips.pose(row + 600).mirrored(), *clips.pose(row));
            assert_eq!((clips.clip_of(row), clips.clip_of(row + 600)), (0, 1));
        }
    }

    #[test]
    fn are_those_in_which_somebody_gets_on() {
        let standing = NeutralClip { name: "idle".into(), ..circle(600, 0.1, 0.0) };
        let clips =
            DrivingClips::new(Proportions::default(), 60.0, &[standing.clone(), circle(600, 1.2, 0.0)], &[], &[])
                .unwrap();
        assert!(clips.clips().iter().all(|clip| clip.source == 1));
        let short = DrivingClips::new(Proportions::default(), 60.0, &[standing, circle(180, 1.2, 0.0)], &[], &[]);
        let sentence = short.unwrap_err().to_string();
        assert_eq!(sentence, "the neutral clips have 3.0 s of walking; driving needs 5 s");
    }

    #[test]
    fn are_spare_ones_where_too_little_gets_on_among_the_own_ones() {
        let punching = NeutralClip { action: "punch".into(), ..circle(600, 1.2, 0.0) };
        let short = circle(180, 1.2, 0.0);
        let spare = [NeutralClip { action: "kick".into(), ..circle(600, 1.0, 0.0) }, circle(600, 1.0, 0.0)];
        for (own, kept) in [(vec![], None), (vec![short], None), (vec![punching], Some(0))] {
            let clips =
                DrivingClips::new(Proportions::default(), 60.0, &own, &spare, &[circle(120, 0.5, 0.0)]).unwrap();
            let of = |kind: ClipKind| {
                let clips = clips.clips().iter().filter(move |clip| clip.kind == kind && !clip.mirrored);
                clips.map(|clip| clip.source).collect::<Vec<_>>()
            };
            assert_eq!(of(ClipKind::Locomotion), [own.len() + 1]);
            assert_eq!(of(ClipKind::Moves), Vec::from_iter(kept));
            assert_eq!(of(ClipKind::Take), [own.len() + 2]);
        }
        let enough = DrivingClips::new(Proportions::default(), 60.0, &[circle(600, 1.2, 0.0)], &spare, &[]).unwrap();
        assert!(enough.clips().iter().all(|clip| clip.source == 0));
    }

    #[test]
    fn have_a_contact_a_pose() {
        let mut clip = circle(600, 1.2, 0.0);
        clip.contacts.pop();
        let refused = DrivingClips::new(Proportions::default(), 60.0, &[clip], &[], &[]).unwrap_err();
        assert_eq!(refused.to_string(), "the clip 'circle' has 600 poses and 599 contacts");
    }
}
