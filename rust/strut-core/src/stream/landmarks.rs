//! Landmarks of a body in a camera's picture → pose.
//!
//! The 33 points are those of common body trackers (`BlazePose`; Bazarevsky et al. 2020): metres from the centre of the hips,
//! x to the right of the picture, y down, z away from the camera, so that p = (x, −y, −z) faces +Z towards it. Bones take the
//! directions of the points; knees and elbows bend in the planes of their limbs. The supporting foot moves the body: a walk
//! ends within 2 % of its true distance, but a run loses the distance of its flight phases, half of the total.

use super::one_euro::{OneEuro, OneEuroSettings};
use crate::humanoid::{JOINTS, Pose, Proportions, Role};
use crate::kinematics::root_path::{RootPath, Support};
use crate::kinematics::{Limb, world_from_local};
use crate::math::{Quat, Vec3};

/// Number of landmarks.
pub const LANDMARKS: usize = 33;

const NOSE: usize = 0;
const EARS: [usize; 2] = [7, 8];
const SHOULDERS: [usize; 2] = [11, 12];
const ELBOWS: [usize; 2] = [13, 14];
const WRISTS: [usize; 2] = [15, 16];
const HIPS: [usize; 2] = [23, 24];
const KNEES: [usize; 2] = [25, 26];
const ANKLES: [usize; 2] = [27, 28];
const HEELS: [usize; 2] = [29, 30];
const TOES: [usize; 2] = [31, 32];

/// A limb with a point less visible than this keeps its pose.
const LEAST_VISIBILITY: f32 = 0.5;
/// With β = 0.3 a wrist that swings as in walking lags by 9 cm on average, with β = 10 by 1.6 cm. At rest both remove more
/// than four fifths of the jitter.
const FILTER: OneEuroSettings = OneEuroSettings { least_cutoff_hz: 1.0, beta: 10.0 };
/// Weight of the limb's unbent hinge axis relative to the sine of its bend.
const REST_HINGE: f32 = 0.1;

/// A landmark of the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Landmark {
    /// Metres from the centre of the hips: right, down, away from the camera.
    pub position: Vec3,
    /// From 0 (hidden) to 1.
    pub visibility: f32,
}

/// Fits poses to landmarks, frame by frame.
#[derive(Clone, Debug)]
pub struct LandmarkFit {
    proportions: Proportions,
    filters: [OneEuro; LANDMARKS],
    points: [Vec3; LANDMARKS],
    last: Pose,
    path: RootPath,
}

impl LandmarkFit {
    /// Creates a fit for a body of these proportions, at the origin.
    pub fn new(proportions: &Proportions) -> Self {
        Self {
            proportions: *proportions,
            filters: [OneEuro::default(); LANDMARKS],
            points: [Vec3::ZERO; LANDMARKS],
            last: Pose::default(),
            path: RootPath::new(proportions),
        }
    }

    /// Returns the pose of the next landmarks, `dt_secs` (> 0) after the last. Limbs with hidden or non-finite points keep
    /// their pose.
    pub fn next(&mut self, landmarks: &[Landmark; LANDMARKS], dt_secs: f32) -> Pose {
        let dt_secs = if dt_secs > 1e-3 { dt_secs } else { 1e-3 };
        let seen = landmarks.map(|l| l.visibility >= LEAST_VISIBILITY && l.position.is_finite());
        for i in (0..LANDMARKS).filter(|&i| seen[i]) {
            let Vec3 { x, y, z } = landmarks[i].position;
            self.points[i] = self.filters[i].next(Vec3::new(x, -y, -z), dt_secs, FILTER);
        }
        let mut pose = self.last;
        self.fit(&seen, &mut pose.rotations);
        self.last = pose;
        self.path.place(&mut pose, Support::Auto, 0.0, dt_secs);
        pose
    }

    /// Fits the local rotations of the visible limbs.
    fn fit(&self, seen: &[bool; LANDMARKS], local: &mut [Quat; JOINTS]) {
        let sees = |pairs: &[[usize; 2]]| pairs.iter().flatten().all(|&i| seen[i]);
        if sees(&[HIPS, SHOULDERS]) {
            self.fit_trunk(local);
        }
        // World rotations so far; those of the limbs are added below.
        let mut world = world_from_local(&self.proportions, &Pose { root: Vec3::ZERO, rotations: *local }).rotations;
        if seen[NOSE] && sees(&[EARS]) {
            self.fit_head(&world, local);
        }
        for side in 0..2 {
            let arm = [SHOULDERS[side], ELBOWS[side], WRISTS[side]];
            if arm.iter().all(|&i| seen[i]) {
                self.fit_limb(Limb::ARMS[side], arm, &mut world, local);
            }
            let leg = [HIPS[side], KNEES[side], ANKLES[side]];
            if leg.iter().all(|&i| seen[i]) {
                self.fit_limb(Limb::LEGS[side], leg, &mut world, local);
                if seen[HEELS[side]] && seen[TOES[side]] {
                    let foot = [Role::LeftFoot, Role::RightFoot][side];
                    self.fit_foot(side, foot, &world, local);
                }
            }
        }
    }

    /// Fits the hips by the line between the hip joints and the middle of the shoulders. Spine and chest each take half of
    /// the shoulder line's rotation relative to the hips.
    fn fit_trunk(&self, local: &mut [Quat; JOINTS]) {
        let across = |pair: [usize; 2]| self.points[pair[0]] - self.points[pair[1]];
        let middle = |pair: [usize; 2]| 0.5 * (self.points[pair[0]] + self.points[pair[1]]);
        let up = middle(SHOULDERS) - middle(HIPS);
        let rest = world_from_local(&self.proportions, &Pose::default()).positions;
        let at = |role: Role| rest[role.index()];
        let joints = [Role::LeftUpperLeg, Role::RightUpperLeg].map(at);
        let shoulders = [Role::LeftUpperArm, Role::RightUpperArm].map(at);
        let rest_up = 0.5 * (shoulders[0] + shoulders[1] - joints[0] - joints[1]);
        let turned = |across: Vec3, rest_across: Vec3| {
            Some(frame(across, up)? * frame(rest_across, rest_up).unwrap_or_default().inverse())
        };
        let hips = turned(across(HIPS), joints[0] - joints[1]);
        let chest = turned(across(SHOULDERS), shoulders[0] - shoulders[1]);
        if let (Some(hips), Some(chest)) = (hips, chest) {
            let half = Quat::IDENTITY.slerp(hips.inv_mul(chest), 0.5);
            local[Role::Hips.index()] = hips;
            local[Role::Spine.index()] = half;
            local[Role::Chest.index()] = half;
        }
    }

    /// Neck and head each take half of the rotation of the ears and the nose, whose plane is level in the T-pose.
    fn fit_head(&self, world: &[Quat; JOINTS], local: &mut [Quat; JOINTS]) {
        let [left, right] = EARS.map(|i| self.points[i]);
        let forward = self.points[NOSE] - 0.5 * (left + right);
        let across = left - right;
        if let Some(head) = frame(across, forward.cross(across)) {
            let half = Quat::IDENTITY.slerp(world[Role::Chest.index()].inv_mul(head), 0.5);
            local[Role::Neck.index()] = half;
            local[Role::Head.index()] = half;
        }
    }

    /// Fits both bones to their directions; the limb is rotated about its axis so that its middle joint is a hinge.
    fn fit_limb(&self, limb: Limb, points: [usize; 3], world: &mut [Quat; JOINTS], local: &mut [Quat; JOINTS]) {
        let [upper, lower, end] = limb.roles();
        let parent = upper.parent().map_or(Quat::IDENTITY, |parent| world[parent.index()]);
        let rest = [lower, end].map(|role| self.proportions.offsets[role.index()]);
        // Bending moves the end away from the direction in which the middle joint moves.
        let rest_hinge = rest[0].cross(-limb.pole());
        let [a, b, c] = points.map(|i| self.points[i]);
        let bones = [(b - a).normalize_or_zero(), (c - b).normalize_or_zero()];
        let unbent = Quat::from_rotation_arc(parent * rest[0], bones[0]) * parent * rest_hinge.normalize_or_zero();
        let hinge = bones[0].cross(bones[1]) + REST_HINGE * unbent;
        let fitted =
            |bone: Vec3, rest: Vec3| Some(frame(hinge, bone)? * frame(rest_hinge, rest).unwrap_or_default().inverse());
        if let (Some(first), Some(second)) = (fitted(bones[0], rest[0]), fitted(bones[1], rest[1])) {
            local[upper.index()] = parent.inv_mul(first);
            local[lower.index()] = first.inv_mul(second);
            world[upper.index()] = first;
            world[lower.index()] = second;
        }
    }

    /// The sole is aligned with heel and toes, below the ankle.
    fn fit_foot(&self, side: usize, foot: Role, world: &[Quat; JOINTS], local: &mut [Quat; JOINTS]) {
        let [heel, toes, ankle] = [HEELS, TOES, ANKLES].map(|pair| self.points[pair[side]]);
        let along = toes - heel;
        if let Some(turned) = frame((ankle - heel).cross(along), along.cross((ankle - heel).cross(along))) {
            let shin = foot.parent().map_or(Quat::IDENTITY, |shin| world[shin.index()]);
            local[foot.index()] = shin.inv_mul(turned);
        }
    }
}

/// The rotation that takes +X to the direction of `x`, and +Y into the plane of `x` and `y`; `None` if they are parallel or
/// zero.
fn frame(x: Vec3, y: Vec3) -> Option<Quat> {
    let x = x.normalize_or_zero();
    let y = (y - x * x.dot(y)).normalize_or_zero();
    let spans = x != Vec3::ZERO && y != Vec3::ZERO;
    spans.then(|| Quat::from_basis(x, y, x.cross(y)).normalized())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Gait, NEUTRAL, noise, walk};

    const DT: f32 = 1.0 / 60.0;

    /// The landmarks of a pose, all visible.
    fn landmarks(pose: &Pose) -> [Landmark; LANDMARKS] {
        let proportions = Proportions::default();
        let world = world_from_local(&proportions, pose);
        let at = |role: Role| world.positions[role.index()];
        let middle = 0.5 * (at(Role::LeftUpperLeg) + at(Role::RightUpperLeg));
        let mut points = [middle; LANDMARKS];
        let head = |x: f32, z: f32| at(Role::Head) + world.rotations[Role::Head.index()] * Vec3::new(x, 0.08, z);
        (points[NOSE], points[EARS[0]], points[EARS[1]]) = (head(0.0, 0.12), head(0.08, 0.0), head(-0.08, 0.0));
        let pairs = [
            (SHOULDERS, [Role::LeftUpperArm, Role::RightUpperArm]),
            (ELBOWS, [Role::LeftLowerArm, Role::RightLowerArm]),
            (WRISTS, [Role::LeftHand, Role::RightHand]),
            (HIPS, [Role::LeftUpperLeg, Role::RightUpperLeg]),
            (KNEES, [Role::LeftLowerLeg, Role::RightLowerLeg]),
            (ANKLES, [Role::LeftFoot, Role::RightFoot]),
        ];
        for (indices, roles) in pairs {
            for side in 0..2 {
                points[indices[side]] = at(roles[side]);
            }
        }
        for (side, foot) in [Role::LeftFoot, Role::RightFoot].into_iter().enumerate() {
            let from_ankle = |v: Vec3| at(foot) + world.rotations[foot.index()] * v;
            points[HEELS[side]] = from_ankle(Vec3::new(0.0, -0.08, -0.05));
            points[TOES[side]] = from_ankle(Vec3::new(0.0, -0.08, 0.18));
        }
        points.map(|p| {
            let Vec3 { x, y, z } = p - middle;
            Landmark { position: Vec3::new(x, -y, -z), visibility: 0.9 }
        })
    }

    /// Largest distance between corresponding joints relative to the hips, metres.
    fn off(a: &Pose, b: &Pose) -> f32 {
        let about_hips =
            |pose: &Pose| world_from_local(&Proportions::default(), &Pose { root: Vec3::ZERO, ..*pose }).positions;
        about_hips(a).iter().zip(&about_hips(b)).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
    }

    #[test]
    fn somebody_who_holds_a_pose_is_seen_in_it() {
        let gait = Gait { turn: 0.4, ..NEUTRAL };
        for pose in walk(&gait, 300, 0.0).poses.iter().step_by(30) {
            let mut fit = LandmarkFit::new(&Proportions::default());
            let seen = landmarks(pose);
            let fitted = fit.next(&seen, DT);
            // The trunk bends at a single place, and the shoulders not at all.
            assert!(off(&fitted, pose) < 0.02, "{} m", off(&fitted, pose));
        }
    }

    #[test]
    fn somebody_who_walks_goes_where_the_feet_lead() {
        let gait = Gait { turn: 0.2, ..NEUTRAL };
        let poses = walk(&gait, 600, 0.0).poses;
        let mut fit = LandmarkFit::new(&Proportions::default());
        let mut path = RootPath::new(&Proportions::default());
        let mut off_sum = 0.0;
        let (mut way, mut apart) = (0.0, 0.0_f32);
        let mut last = None;
        for pose in &poses {
            let fitted = fit.next(&landmarks(pose), DT);
            let mut expected = *pose;
            path.place(&mut expected, Support::Auto, 0.0, DT);
            way += last.replace(expected.root).map_or(0.0, |last| expected.root.distance(last));
            apart = apart.max(fitted.root.distance(expected.root));
            off_sum += off(&fitted, pose);
        }
        assert!(way > 2.0 && apart < 0.1 * way, "{apart} m apart on a way of {way} m");
        assert!(off_sum / 600.0 < 0.04, "the worst joint is {} m off", off_sum / 600.0);
    }

    #[test]
    fn a_hidden_limb_is_held_and_nothing_is_not_a_number() {
        let poses = walk(&NEUTRAL, 60, 0.0).poses;
        let mut fit = LandmarkFit::new(&Proportions::default());
        let arm = Role::LeftUpperArm.index();
        let mut held = None;
        for (i, pose) in poses.iter().enumerate() {
            let mut seen = landmarks(pose);
            if i >= 20 {
                seen[ELBOWS[0]].visibility = 0.2;
                seen[KNEES[1]].position.x = f32::NAN;
            }
            let fitted = fit.next(&seen, DT);
            assert!(fitted.is_finite());
            if i == 19 {
                held = Some(fitted.rotations[arm]);
            }
            assert!(held.is_none_or(|held| held == fitted.rotations[arm]));
        }
        let mut fit = LandmarkFit::new(&Proportions::default());
        let nothing = [Landmark::default(); LANDMARKS];
        assert!(fit.next(&nothing, 0.0).is_finite());
        assert!(fit.next(&[Landmark { visibility: 1.0, ..Landmark::default() }; LANDMARKS], f32::NAN).is_finite());
    }

    #[test]
    fn the_trembling_of_somebody_at_rest_is_halved() {
        let poses = walk(&NEUTRAL, 1, 0.0).poses;
        let mut fit = LandmarkFit::new(&Proportions::default());
        let mut noise = noise(5).map(|n| n as f32 * 0.01);
        let mut sums = [0.0_f32; 2];
        let mut last: Option<(Vec3, Vec3)> = None;
        for _ in 0..300 {
            let mut seen = landmarks(&poses[0]);
            for landmark in &mut seen {
                landmark.position += Vec3::from_array(std::array::from_fn(|_| noise.next().unwrap()));
            }
            fit.next(&seen, DT);
            let now = (seen[WRISTS[0]].position, fit.points[WRISTS[0]]);
            if let Some(before) = last.replace(now) {
                sums[0] += now.0.distance(before.0);
                sums[1] += now.1.distance(before.1);
            }
        }
        assert!(sums[1] < 0.5 * sums[0], "{sums:?}");
    }
}
