//! Where the body goes: the supporting foot does not slide, so that the pose says it (HSMM specification, §11).

use crate::humanoid::{Pose, Proportions};
use crate::kinematics::{WorldPose, world_from_local};
use crate::math::{Quat, Vec3};
use crate::transfer::Soles;

/// Points of a foot that may touch the ground: heel, ball, and the tip of the toes.
const POINTS: usize = 3;
/// How far the tip of the toes lies before the ball, as a share of the distance from ankle to toes on the ground.
const TIP_SHARE: f32 = 0.35;
/// How much lower another foot, or another point, must be to take over, metres.
const OTHER_FOOT: f32 = 0.02;
const OTHER_POINT: f32 = 0.005;
/// The same for another foot where nothing but the poses tells which one supports.
const OTHER_FOOT_UNTOLD: f32 = 0.005;

/// The other foot stands too while its lowest point is no higher than this above the ground, and moves no farther a frame, metres.
const STANDING_HEIGHT: f32 = 0.025;
const STANDING_WAY: f32 = 0.012;

/// Which foot supports the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Support {
    /// The left one (0) or the right one (1), unless the other is clearly lower.
    On(usize),
    /// Whichever the poses show to be lower.
    Untold,
}

/// The path of a body that walks.
#[derive(Clone, Debug)]
pub(crate) struct RootPath {
    proportions: Proportions,
    feet: Feet,
    /// Where the root was in the last frame.
    root: Vec3,
    /// Foot and point that touch the ground, and where both feet's points were for a root at the origin.
    last: Option<(usize, usize, FeetPoints)>,
    /// Feet that stand.
    planted: [bool; 2],
}

type FeetPoints = [[Vec3; POINTS]; 2];

/// Where the feet may touch the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Feet {
    soles: Soles,
    /// From the ball to the tip of the toes, in the toes' frame.
    tips: [Vec3; 2],
}

impl Feet {
    pub(crate) fn new(proportions: &Proportions) -> Self {
        let ground = Vec3::new(1.0, 0.0, 1.0);
        let tips = Soles::JOINTS.map(|[_, toes]| proportions.offsets[toes.index()] * ground * TIP_SHARE);
        Self { soles: Soles::new(proportions), tips }
    }

    /// Height of the lowest point of both feet.
    pub(crate) fn lowest(&self, world: &WorldPose) -> f32 {
        self.points(world).iter().map(least_height).fold(f32::INFINITY, f32::min)
    }

    fn points(&self, world: &WorldPose) -> FeetPoints {
        std::array::from_fn(|side| {
            let sole = self.soles.of(world, side);
            let toes = world.rotations[Soles::JOINTS[side][1].index()];
            [sole.heel, sole.ball, sole.ball + toes * self.tips[side]]
        })
    }
}

impl RootPath {
    pub(crate) fn new(proportions: &Proportions) -> Self {
        let feet = Feet::new(proportions);
        Self { proportions: *proportions, feet, root: Vec3::ZERO, last: None, planted: [false; 2] }
    }

    /// Begins anew above a point of the ground.
    pub(crate) fn reset(&mut self, at: Vec3) {
        (self.root, self.last) = (at, None);
    }

    /// Puts the next pose where its supporting foot says, turned by a heading.
    pub(crate) fn place(&mut self, pose: &mut Pose, support: impl Into<Support>, heading: f32) {
        pose.root = Vec3::ZERO;
        pose.rotations[0] = Quat::from_rotation_y(heading) * pose.rotations[0];
        let points = self.feet.points(&world_from_local(&self.proportions, pose));
        let lowest =
            |foot: usize| (0..POINTS).min_by(|a, b| points[foot][*a].y.total_cmp(&points[foot][*b].y)).unwrap_or(0);
        let height = |foot: usize| points[foot][lowest(foot)].y;
        let (support, lower_by, bears): (_, _, fn(&[Vec3; POINTS]) -> f32) = match support.into() {
            Support::On(foot) => (foot, OTHER_FOOT, least_height),
            // A foot in the air may point its toes to the ground; the whole of it is higher all the same.
            Support::Untold => (self.last.map_or(0, |last| last.0), OTHER_FOOT_UNTOLD, mean_height),
        };
        let other = 1 - support;
        let foot = if bears(&points[other]) < bears(&points[support]) - lower_by { other } else { support };
        let mut point = lowest(foot);
        let root_before = self.root;
        if let Some((last_foot, last_point, before)) = self.last {
            // What touched the ground in the last frame is where it was; only then may another point take over.
            let moved = before[last_foot][last_point] - points[last_foot][last_point];
            self.root += Vec3::new(moved.x, 0.0, moved.z);
            if last_foot == foot && points[foot][point].y > points[foot][last_point].y - OTHER_POINT {
                point = last_point;
            }
        }
        self.root.y = -height(support).min(height(other));
        let before = self.last.map_or(points, |(_, _, before)| before);
        self.planted = std::array::from_fn(|side| {
            let p = lowest(side);
            let way = (points[side][p] + self.root - before[side][p] - root_before) * Vec3::new(1.0, 0.0, 1.0);
            side == foot || (points[side][p].y + self.root.y < STANDING_HEIGHT && way.length() < STANDING_WAY)
        });
        self.last = Some((foot, point, points));
        pose.root = self.root;
    }

    /// Feet that stand in the last pose, left and right.
    pub(crate) fn planted(&self) -> [bool; 2] {
        self.planted
    }

    /// The point that touches the ground, in the world; `None` before the first frame.
    #[cfg(any(test, feature = "offline"))]
    pub(crate) fn contact(&self) -> Option<(usize, usize, Vec3)> {
        self.last.map(|(foot, point, points)| (foot, point, points[foot][point] + self.root))
    }
}

fn least_height(points: &[Vec3; POINTS]) -> f32 {
    points.iter().map(|point| point.y).fold(f32::INFINITY, f32::min)
}

fn mean_height(points: &[Vec3; POINTS]) -> f32 {
    points.iter().map(|point| point.y).sum::<f32>() / POINTS as f32
}
