//! Prepares a clip for styling: resamples it to the database's frame rate, bridges gaps, finds cuts and a calibration pose.
//!
//! A stream cannot tell a cut from one bad frame; a clip shows both sides. The motion is not continuous across a cut,
//! so each side is styled separately.

use crate::humanoid::{HumanoidMotion, Pose, Role, TooManyFrames};
use crate::kinematics::world_from_local;
use crate::note::{Note, NoteCode};
use std::ops::Range;

/// The hips jump where their step differs from those before and after by more than this, metres …
const ROOT_JUMP: f32 = 0.08;
/// … plus the distance due to the greatest plausible acceleration, m/s². Landing from a jump reaches 50.
const ROOT_ACCELERATION: f32 = 60.0;
/// A joint jumps where it turns by more than this, radians …
const TURN_JUMP: f32 = 0.35;
/// … plus the turn due to the greatest plausible acceleration, rad/s² …
const TURN_ACCELERATION: f32 = 400.0;
/// … and more than this many times as far as in the neighbouring frames.
const TURN_RATIO: f32 = 4.0;
/// The pose jumps where this many joints jump. Recordings contain single joints that flip.
const JOINTS_THAT_JUMP: usize = 4;
/// Longest gap that is bridged, seconds.
const GAP_SECS: f32 = 0.25;
/// The two sides of a gap are similar within this mean turn of the joints, radians, and this speed of the hips, m/s.
const ALIKE_TURN: f32 = 0.35;
const ALIKE_SPEED: f32 = 3.0;
/// A calibration pose moves less than this from its first frame, metres and radians.
const STILL_ROOT: f32 = 0.02;
const STILL_TURN: f32 = 0.05;
/// Times that differ by less than this part of a frame at the database's rate count as equal: files round their frame time.
const ALMOST: f64 = 0.02;

/// A clip at the database's frame rate.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipInput {
    /// Its poses.
    pub motion: HumanoidMotion,
    /// Frames of [`ClipInput::motion`] that follow a cut, ascending.
    pub cuts: Vec<usize>,
    /// Number of first frames that are a calibration pose; 0 if there is none.
    pub calibration: usize,
    /// Number of frames of the clip that were replaced by interpolation between their neighbours.
    pub bridged: usize,
}

impl ClipInput {
    /// Prepares a clip that has its own frame rate.
    ///
    /// # Errors
    /// If it has too many frames at the database's rate.
    pub fn new(motion: HumanoidMotion, rate_hz: f32) -> Result<Self, TooManyFrames> {
        motion.frames_at(rate_hz)?;
        let mut motion = motion;
        let jumps = jumps(&motion);
        let (cuts, bridged) = bridge(&mut motion, jumps);
        let first = cuts.first().copied().unwrap_or(0);
        let calibration = if is_calibration(&motion, 0..first) { first } else { 0 };
        let ratio = f64::from(rate_hz) / f64::from(motion.rate_hz);
        let at_rate = |frame: usize| (frame as f64 * ratio - ALMOST).ceil() as usize;
        Ok(Self {
            calibration: at_rate(calibration),
            motion: resampled(&motion, rate_hz, &cuts),
            cuts: cuts.into_iter().map(at_rate).collect(),
            bridged,
        })
    }

    /// Wraps a clip that has the database's rate and no cuts.
    pub fn whole(motion: HumanoidMotion) -> Self {
        Self { motion, cuts: Vec::new(), calibration: 0, bridged: 0 }
    }

    /// Notes about the input.
    pub fn notes(&self) -> Vec<Note> {
        let secs = |frame: usize| f64::from(frame as f32 / self.motion.rate_hz);
        let mut notes = Vec::new();
        if self.calibration > 0 {
            notes.push(Note::new(
                NoteCode::CalibrationPose,
                format!(
                    "The clip begins with a calibration pose of {:.2} s, which was left unchanged.",
                    secs(self.calibration)
                ),
            ));
        }
        let cuts: Vec<f64> = self.cuts.iter().filter(|cut| **cut != self.calibration).map(|cut| secs(*cut)).collect();
        match cuts.as_slice() {
            [] => {}
            [one] => notes.push(Note::new(
                NoteCode::Cut,
                format!("The motion jumps at {one:.2} s. The parts before and after were styled separately."),
            )),
            [first, ..] => notes.push(Note::new(
                NoteCode::Cut,
                format!(
                    "The motion jumps {} times, first at {first:.2} s. The parts in between were styled separately.",
                    cuts.len()
                ),
            )),
        }
        if self.bridged > 0 {
            let (frames, were) = if self.bridged == 1 { ("frame", "was") } else { ("frames", "were") };
            notes.push(Note::new(
                NoteCode::Repaired,
                format!("{} {frames} did not fit the neighbouring frames and {were} replaced.", self.bridged),
            ));
        }
        notes
    }
}

/// The clip at another rate, to its last frame. No frame is interpolated across a cut.
fn resampled(motion: &HumanoidMotion, rate_hz: f32, cuts: &[usize]) -> HumanoidMotion {
    let step = f64::from(motion.rate_hz) / f64::from(rate_hz);
    let mut poses = Vec::new();
    let ends = cuts.iter().copied().chain(std::iter::once(motion.poses.len()));
    let mut start = 0;
    for end in ends.filter(|end| *end > 0) {
        let (first, last) = (start as f64, (end - 1) as f64);
        // Up to the first frame of the next part; the clip's end is styled too.
        let most = if end == motion.poses.len() {
            (last / step - ALMOST).ceil() + 1.0
        } else {
            (end as f64 / step - ALMOST).ceil()
        };
        while (poses.len() as f64) < most {
            poses.push(motion.sample((poses.len() as f64 * step).clamp(first, last)));
        }
        start = end;
    }
    HumanoidMotion { proportions: motion.proportions, rate_hz, poses }
}

/// Frames that are not continuous with the one before them.
fn jumps(motion: &HumanoidMotion) -> Vec<usize> {
    let poses = &motion.poses;
    let dt = 1.0 / motion.rate_hz;
    let root = ROOT_JUMP + ROOT_ACCELERATION * dt * dt;
    let turn = TURN_JUMP + TURN_ACCELERATION * dt * dt;
    // The steps before and after the step to a frame, if they exist.
    let beside =
        |frame: usize| [frame.checked_sub(1), Some(frame + 1)].map(|f| f.filter(|f| (1..poses.len()).contains(f)));
    let step = |frame: usize| poses[frame].root - poses[frame - 1].root;
    let turned =
        |frame: usize, joint: usize| poses[frame - 1].rotations[joint].inv_mul(poses[frame].rotations[joint]).angle();
    let root_jumps = |frame: usize| {
        let mut steps = beside(frame).into_iter().flatten().map(step).peekable();
        steps.peek().is_some() && steps.all(|other| (step(frame) - other).length() > root)
    };
    let joint_jumps = |frame: usize, joint: usize| {
        let here = turned(frame, joint);
        let mut others = beside(frame).into_iter().flatten().peekable();
        here > turn && others.peek().is_some() && others.all(|other| here > TURN_RATIO * turned(other, joint))
    };
    let pose_jumps =
        |frame: usize| Role::ALL.iter().filter(|role| joint_jumps(frame, role.index())).count() >= JOINTS_THAT_JUMP;
    (1..poses.len()).filter(|&frame| root_jumps(frame) || pose_jumps(frame)).collect()
}

/// Bridges short gaps whose sides are similar. Returns the remaining jumps and the number of frames replaced.
fn bridge(motion: &mut HumanoidMotion, jumps: Vec<usize>) -> (Vec<usize>, usize) {
    let longest = (GAP_SECS * motion.rate_hz) as usize;
    let (mut cuts, mut bridged, mut rest) = (Vec::new(), 0, jumps.as_slice());
    while let [jump, later @ ..] = rest {
        let back = later.iter().rposition(|other| other - jump <= longest && are_alike(motion, *jump - 1, *other));
        let Some(at) = back else {
            cuts.push(*jump);
            rest = later;
            continue;
        };
        let (before, after) = (*jump - 1, later[at]);
        let [a, b] = [before, after].map(|frame| motion.poses[frame]);
        for frame in *jump..after {
            motion.poses[frame] = a.lerp(&b, (frame - before) as f32 / (after - before) as f32);
        }
        bridged += after - *jump;
        rest = &later[at + 1..];
    }
    (cuts, bridged)
}

/// Returns whether the motion may continue from one frame to another.
fn are_alike(motion: &HumanoidMotion, before: usize, after: usize) -> bool {
    let [a, b] = [before, after].map(|frame| &motion.poses[frame]);
    let secs = (after - before) as f32 / motion.rate_hz;
    mean_turn(a, b) < ALIKE_TURN && (b.root - a.root).length() < ALIKE_SPEED * secs
}

fn mean_turn(a: &Pose, b: &Pose) -> f32 {
    let turns = a.rotations.iter().zip(&b.rotations).map(|(a, b)| a.inv_mul(*b).angle());
    turns.sum::<f32>() / a.rotations.len() as f32
}

/// Returns whether the frames hold one T- or A-pose: arms straight and raised equally, legs straight.
fn is_calibration(motion: &HumanoidMotion, frames: Range<usize>) -> bool {
    let Some(first) = motion.poses[frames.clone()].first() else { return false };
    let is_still = |pose: &Pose| {
        let most = pose.rotations.iter().zip(&first.rotations).map(|(a, b)| a.inv_mul(*b).angle()).fold(0.0, f32::max);
        most < STILL_TURN && (pose.root - first.root).length() < STILL_ROOT
    };
    let world = world_from_local(&motion.proportions, first);
    let bone = |from: Role, to: Role| (world.positions[to.index()] - world.positions[from.index()]).normalize_or_zero();
    let limbs = [
        [Role::LeftUpperArm, Role::LeftLowerArm, Role::LeftHand],
        [Role::RightUpperArm, Role::RightLowerArm, Role::RightHand],
        [Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot],
        [Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot],
    ];
    let are_straight = limbs.iter().all(|[a, b, c]| bone(*a, *b).dot(bone(*b, *c)) > 0.94);
    let trunk = bone(Role::Hips, Role::Neck);
    // 1 down, 0 sideways.
    let [left, right, left_leg, right_leg] = limbs.map(|[a, _, c]| -bone(a, c).dot(trunk));
    let arms_are_raised = [left, right].iter().all(|down| (-0.3..0.9).contains(down)) && (left - right).abs() < 0.2;
    are_straight && arms_are_raised && left_leg.min(right_leg) > 0.85 && motion.poses[frames].iter().all(is_still)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{NEUTRAL, walk};
    use crate::humanoid::Proportions;
    use crate::math::{Quat, Vec3};

    fn clip() -> HumanoidMotion {
        let poses = walk(&NEUTRAL, 120, 0.0).poses;
        HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses }
    }

    fn input(motion: &HumanoidMotion) -> ClipInput {
        ClipInput::new(motion.clone(), motion.rate_hz).unwrap()
    }

    fn codes(input: &ClipInput) -> Vec<NoteCode> {
        input.notes().iter().map(|note| note.code).collect()
    }

    #[test]
    fn a_clean_clip_stays_as_it_is() {
        let motion = clip();
        let input = input(&motion);
        assert_eq!((&input.motion, input.cuts.as_slice(), input.calibration), (&motion, &[][..], 0));
        assert!(input.notes().is_empty());
    }

    #[test]
    fn a_jump_to_another_place_is_a_cut() {
        let mut motion = clip();
        motion.poses[50..].iter_mut().for_each(|pose| pose.root += Vec3::new(0.6, 0.0, 0.0));
        let input = input(&motion);
        assert_eq!((input.cuts.as_slice(), &input.motion), (&[50][..], &motion));
        assert_eq!(codes(&input), [NoteCode::Cut]);
    }

    #[test]
    fn no_frame_lies_between_the_sides_of_a_cut() {
        let mut motion = clip();
        motion.rate_hz = 40.0;
        motion.poses[50..].iter_mut().for_each(|pose| pose.root.x += 7.0);
        let input = ClipInput::new(motion, 60.0).unwrap();
        assert_eq!(input.cuts, [75]);
        let x: Vec<f32> = input.motion.poses.iter().map(|pose| pose.root.x).collect();
        assert!(x[..75].iter().all(|x| *x < 3.0) && x[75..].iter().all(|x| *x > 5.0), "{:?}", &x[73..77]);
    }

    #[test]
    fn a_short_gap_is_bridged() {
        let clean = clip();
        let mut motion = clean.clone();
        for pose in &mut motion.poses[50..56] {
            pose.root += Vec3::new(0.0, 2.0, 0.0);
        }
        let input = input(&motion);
        assert_eq!((input.cuts.len(), input.bridged), (0, 6));
        let apart = input.motion.poses.iter().zip(&clean.poses).map(|(a, b)| (a.root - b.root).length());
        let farthest = apart.fold(0.0, f32::max);
        assert!(farthest < 0.05, "{farthest} m");
        assert_eq!(codes(&input), [NoteCode::Repaired]);
    }

    #[test]
    fn a_t_pose_in_front_is_kept() {
        let mut motion = clip();
        let t_pose = Pose { root: motion.proportions.offsets[0], ..Pose::default() };
        for frames in [1, 30] {
            let mut with = motion.clone();
            with.poses.splice(0..0, vec![t_pose; frames]);
            let input = input(&with);
            assert_eq!((input.cuts.as_slice(), input.calibration), (&[frames][..], frames));
            assert_eq!(codes(&input), [NoteCode::CalibrationPose]);
        }
        // A person who turns slowly in a T-pose is not still.
        for (frame, pose) in motion.poses[..30].iter_mut().enumerate() {
            *pose = t_pose;
            pose.rotations[0] = Quat::from_rotation_y(0.02 * frame as f32);
        }
        assert_eq!(input(&motion).calibration, 0);
    }

    #[test]
    fn the_end_of_a_clip_is_styled_too() {
        let mut motion = clip();
        for (rate_hz, frames) in [(60.0, 120), (59.9988, 120), (120.0, 61), (30.0, 239), (61.0, 119)] {
            motion.rate_hz = rate_hz;
            assert_eq!(ClipInput::new(motion.clone(), 60.0).unwrap().motion.poses.len(), frames, "{rate_hz}");
        }
    }
}
