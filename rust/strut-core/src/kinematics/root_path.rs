//! The path of the root, derived from the poses: the supporting foot does not slide (`docs/methods/hsmm.md` §11).

use crate::humanoid::{Pose, Proportions};
use crate::kinematics::{Soles, WorldPose, world_from_local};
use crate::math::float_funcs::half_life_share;
use crate::math::{Quat, Vec2, Vec3};

/// Points of a foot that may touch the ground: heel, ball, and the tip of the toes.
const POINTS: usize = 3;
/// Distance of the tip of the toes in front of the ball, as a share of the distance from ankle to toes on the ground.
const TIP_SHARE: f32 = 0.35;
/// How much lower another foot, or another point, must be to become the support, metres.
const OTHER_FOOT: f32 = 0.02;
const OTHER_POINT: f32 = 0.005;
/// The same for another foot if the support is determined from the poses only.
const OTHER_FOOT_AUTO: f32 = 0.005;

/// The other foot is planted, too, while its lowest point is lower than this above the ground, metres, and not faster than
/// this over the ground, m/s.
const STANDING_HEIGHT: f32 = 0.025;
const STANDING_SPEED: f32 = 0.36;

/// Half-life of the low-pass filter on the body's velocity, which it keeps at take-off, seconds.
const VELOCITY_HALF_LIFE_SECS: f32 = 0.05;
/// Longest flight, seconds: a body that is held in the air for longer stops moving.
const LONGEST_FLIGHT_SECS: f32 = 0.6;

/// Which foot supports the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Support {
    /// The left one (0) or the right one (1), unless the other is clearly lower.
    On(usize),
    /// Determined from the poses: the lower foot.
    Auto,
}

/// The path of a body with its feet on the ground.
#[derive(Clone, Debug)]
pub(crate) struct RootPath {
    proportions: Proportions,
    feet: Feet,
    /// The last pose, its root at the origin.
    posed: WorldPose,
    /// Place of the root in the last frame, [x, z] in metres: a sum over all frames, which in single precision would be off
    /// by 16 cm after an hour of walking.
    place: [f64; 2],
    /// Height of the root in the last frame, metres.
    height: f32,
    /// Foot and point in contact with the ground, and the positions of both feet's points for a root at the origin.
    last: Option<(usize, usize, FeetPoints)>,
    /// Which feet are planted.
    planted: [bool; 2],
    /// Velocity of the root over the ground, [x, z] in m/s.
    velocity: [f32; 2],
    /// Time since the last foot was planted, seconds; `None` while one is.
    flown_secs: Option<f32>,
}

type FeetPoints = [[Vec3; POINTS]; 2];

/// Points of the feet that can touch the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Feet {
    soles: Soles,
    /// Vector from the ball to the tip of the toes, in the toes' frame.
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
        Self {
            proportions: *proportions,
            feet,
            posed: world_from_local(proportions, &Pose::default()),
            place: [0.0; 2],
            height: 0.0,
            last: None,
            planted: [false; 2],
            velocity: [0.0; 2],
            flown_secs: None,
        }
    }

    /// Restarts above a point of the ground.
    pub(crate) fn reset(&mut self, at: Vec3) {
        self.place = [at.x, at.z].map(f64::from);
        self.last = None;
        self.velocity = [0.0; 2];
        self.flown_secs = None;
    }

    /// Places the next pose, `dt_secs` after the previous one, by its supporting foot, rotated by a heading.
    pub(crate) fn place(&mut self, pose: &mut Pose, support: impl Into<Support>, heading: f32, dt_secs: f32) {
        self.place_above(pose, support, heading, dt_secs, 0.0);
    }

    /// The same for a pose whose lowest foot is at a height above the ground, metres: if that is more than 0, no foot
    /// supports the body, and it keeps its take-off velocity until it has landed.
    pub(crate) fn place_above(
        &mut self,
        pose: &mut Pose,
        support: impl Into<Support>,
        heading: f32,
        dt_secs: f32,
        above: f32,
    ) {
        pose.root = Vec3::ZERO;
        pose.rotations[0] = Quat::from_rotation_y(heading) * pose.rotations[0];
        self.posed = world_from_local(&self.proportions, pose);
        let points = self.feet.points(&self.posed);
        let lowest =
            |foot: usize| (0..POINTS).min_by(|a, b| points[foot][*a].y.total_cmp(&points[foot][*b].y)).unwrap_or(0);
        let height = |foot: usize| points[foot][lowest(foot)].y;
        let (support, lower_by, bears): (_, _, fn(&[Vec3; POINTS]) -> f32) = match support.into() {
            Support::On(foot) => (foot, OTHER_FOOT, least_height),
            // A foot in the air may point its toes to the ground, but its mean height is larger.
            Support::Auto => (self.last.map_or(0, |last| last.0), OTHER_FOOT_AUTO, mean_height),
        };
        let other = 1 - support;
        let foot = if bears(&points[other]) < bears(&points[support]) - lower_by { other } else { support };
        let mut point = lowest(foot);
        let mut travel = Vec3::ZERO;
        if let Some((last_foot, last_point, before)) = self.last {
            // The point of contact in the last frame does not move; only then may another point become the support.
            let moved = before[last_foot][last_point] - points[last_foot][last_point];
            travel = moved * Vec3::new(1.0, 0.0, 1.0);
            if last_foot == foot && points[foot][point].y > points[foot][last_point].y - OTHER_POINT {
                point = last_point;
            }
        }
        if above > 0.0 || self.flown_secs.is_some() {
            travel = self.fly(dt_secs, above > 0.0);
        } else if dt_secs > 0.0 && self.last.is_some() {
            let share = half_life_share(dt_secs, VELOCITY_HALF_LIFE_SECS);
            for (velocity, way) in self.velocity.iter_mut().zip([travel.x, travel.z]) {
                *velocity += share * (way / dt_secs - *velocity);
            }
        }
        self.place[0] += f64::from(travel.x);
        self.place[1] += f64::from(travel.z);
        let ground = height(support).min(height(other));
        let before = self.last.map_or(points, |(_, _, before)| before);
        self.planted = std::array::from_fn(|side| {
            let p = lowest(side);
            let way = (points[side][p] - before[side][p] + travel) * Vec3::new(1.0, 0.0, 1.0);
            let is_slow = way.length() <= STANDING_SPEED * dt_secs;
            above <= 0.0 && (side == foot || (points[side][p].y - ground < STANDING_HEIGHT && is_slow))
        });
        self.last = Some((foot, point, points));
        self.height = above - ground;
        pose.root = self.root();
    }

    /// The displacement over the ground in a frame of flight, including the one that lands.
    fn fly(&mut self, dt_secs: f32, is_in_air: bool) -> Vec3 {
        let flown = self.flown_secs.unwrap_or(0.0) + dt_secs;
        self.flown_secs = is_in_air.then_some(flown);
        if flown > LONGEST_FLIGHT_SECS {
            self.velocity = [0.0; 2];
        }
        let [x, z] = self.velocity.map(|velocity| velocity * dt_secs);
        Vec3::new(x, 0.0, z)
    }

    fn root(&self) -> Vec3 {
        Vec3::new(self.place[0] as f32, self.height, self.place[1] as f32)
    }

    /// Moves the body and its point of contact over the ground.
    pub(crate) fn shift(&mut self, by: Vec2) {
        self.place[0] += f64::from(by.x);
        self.place[1] += f64::from(by.y);
    }

    /// The last pose in the world.
    pub(crate) fn world(&self) -> WorldPose {
        let (root, posed) = (self.root(), self.posed);
        WorldPose { positions: posed.positions.map(|position| position + root), ..posed }
    }

    /// Whether the left and the right foot are planted in the last pose.
    pub(crate) fn planted(&self) -> [bool; 2] {
        self.planted
    }

    /// Foot, point and position of the contact with the ground, in the world; `None` before the first frame.
    pub(crate) fn contact(&self) -> Option<(usize, usize, Vec3)> {
        self.last.map(|(foot, point, points)| (foot, point, points[foot][point] + self.root()))
    }
}

fn least_height(points: &[Vec3; POINTS]) -> f32 {
    points.iter().map(|point| point.y).fold(f32::INFINITY, f32::min)
}

fn mean_height(points: &[Vec3; POINTS]) -> f32 {
    points.iter().map(|point| point.y).sum::<f32>() / POINTS as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{NEUTRAL, RATE_HZ, walk};
    use crate::humanoid::Role;

    /// Distance ahead of a body after whole cycles of a walk, metres.
    fn distance_after(cycles: usize) -> f64 {
        let cycle = walk(&NEUTRAL, NEUTRAL.period as usize, 0.0).poses;
        let mut path = RootPath::new(&Proportions::default());
        let mut last = Pose::default();
        for pose in std::iter::repeat_n(&cycle, cycles).flatten() {
            last = *pose;
            path.place(&mut last, Support::Auto, 0.0, 1.0 / RATE_HZ);
        }
        f64::from(last.root.z)
    }

    #[test]
    fn an_hour_of_walking_does_not_drift() {
        let (begin, per_cycle) = (distance_after(1), distance_after(2) - distance_after(1));
        let cycles = (3600.0 * RATE_HZ / NEUTRAL.period) as usize;
        let (found, expected) = (distance_after(cycles), begin + per_cycle * (cycles - 1) as f64);
        assert!(expected > 1000.0 && (found - expected).abs() < 0.01, "{found} m instead of {expected} m");
    }

    #[test]
    fn root_is_ballistic_in_flight() {
        const ABOVE: f32 = 0.1;
        let cycle = walk(&NEUTRAL, NEUTRAL.period as usize, 0.0).poses;
        let dt_secs = 1.0 / RATE_HZ;
        let mut path = RootPath::new(&Proportions::default());
        let mut place = |frame: usize, above: f32| {
            let mut pose = cycle[frame % cycle.len()];
            path.place_above(&mut pose, Support::Auto, 0.0, dt_secs, above);
            (pose.root, path.planted())
        };
        let walked: Vec<Vec3> = (0..2 * cycle.len()).map(|frame| place(frame, 0.0).0).collect();
        let taken_off = walked[walked.len() - 1];
        let flown: Vec<_> = (0..6).map(|frame| place(frame, ABOVE)).collect();
        let step = flown[0].0.z - taken_off.z;
        let steps = walked.windows(2).map(|pair| pair[1].z - pair[0].z);
        let (least, most) = steps.fold((0.0_f32, 0.0_f32), |(least, most), step| (least.min(step), most.max(step)));
        assert!(step > 0.0 && (least..=most).contains(&step), "{step} m a frame after {least} to {most} m");
        for pair in flown.windows(2) {
            assert!((pair[1].0.z - pair[0].0.z - step).abs() < 1e-5);
            assert_eq!(pair[1].1, [false; 2]);
        }
        // The frame in which a foot lands belongs to the flight; from then on the foot supports the body.
        let (landed, planted) = place(6, 0.0);
        assert!((landed.z - flown[5].0.z - step).abs() < 1e-5 && planted.contains(&true));
        assert!((flown[0].0.y - walked[0].y - ABOVE).abs() < 1e-5);
    }

    #[test]
    fn who_is_held_in_the_air_comes_to_rest() {
        let cycle = walk(&NEUTRAL, NEUTRAL.period as usize, 0.0).poses;
        let mut path = RootPath::new(&Proportions::default());
        let mut at = |frame: usize, above: f32| {
            let mut pose = cycle[frame];
            path.place_above(&mut pose, Support::Auto, 0.0, 1.0 / RATE_HZ, above);
            pose.root
        };
        let walked: Vec<Vec3> = (0..cycle.len()).map(|frame| at(frame, 0.0)).collect();
        let held: Vec<Vec3> = (0..RATE_HZ as usize).map(|_| at(0, 0.1)).collect();
        assert!(held[0].z > walked[walked.len() - 1].z && held[1].z > held[0].z);
        assert_eq!(held[held.len() - 1], held[held.len() - 2]);
    }

    /// The body stands on the left foot while the right one slides past at a speed, close above the ground.
    #[test]
    fn whether_a_foot_stands_depends_on_its_speed_and_not_on_the_frame_rate() {
        let proportions = Proportions::default();
        let leg = proportions.leg_length();
        for rate_hz in [15.0, 30.0, 60.0, 120.0] {
            for (speed, stands) in [(0.2, true), (0.6, false)] {
                let mut path = RootPath::new(&proportions);
                let mut planted = [false; 2];
                for frame in 0..4 {
                    let mut pose = Pose::default();
                    let angle = speed * frame as f32 / (rate_hz * leg);
                    pose.rotations[Role::RightUpperLeg.index()] = Quat::from_rotation_x(-angle);
                    pose.rotations[Role::RightFoot.index()] = Quat::from_rotation_x(angle);
                    path.place(&mut pose, Support::On(0), 0.0, 1.0 / rate_hz);
                    planted = path.planted();
                }
                assert_eq!(planted, [true, stands], "{speed} m/s at {rate_hz} Hz");
            }
        }
    }
}
