//! A small synthetic database for tests: bodies whose legs and arms swing as sines.

use std::f32::consts::TAU;
use strut_core::database::{Clip, Database, DatabaseParts};
use strut_core::humanoid::{Pose, Proportions, Role};
use strut_core::kinematics::{Soles, world_from_local};
use strut_core::math::float_funcs::sin;
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::{HeadingFilter, Placement, PoseChart, point_cloud};

pub(crate) const RATE_HZ: f32 = 60.0;

/// Numbers between −1 and 1 (linear congruential generator of Numerical Recipes).
pub(crate) fn noise(seed: u32) -> impl Iterator<Item = f64> {
    let next = |s: &u32| Some(s.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    std::iter::successors(Some(seed), next).skip(1).map(|s| f64::from(s >> 8) / f64::from(1 << 23) - 1.0)
}

const FRAMES: usize = 150;

/// A gait; angles in radians.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gait {
    /// Frames of a cycle.
    pub(crate) period: f32,
    /// Swing of the thighs.
    pub(crate) swing: f32,
    /// Bend of the knees in the air.
    pub(crate) knee: f32,
    /// Forward lean of the chest.
    pub(crate) lean: f32,
    /// Swing of the arms.
    pub(crate) arms: f32,
    /// Turn of the path, rad/s.
    pub(crate) turn: f32,
}

pub(crate) const NEUTRAL: Gait = Gait { period: 64.0, swing: 0.4, knee: 0.7, lean: 0.05, arms: 0.4, turn: 0.0 };
/// The same walk, slower, leaning, with short steps.
pub(crate) const BENT: Gait = Gait { period: 76.0, swing: 0.28, knee: 0.5, lean: 0.5, arms: 0.15, turn: 0.0 };
const FAST: Gait = Gait { period: 44.0, swing: 0.6, knee: 1.2, lean: 0.15, arms: 0.7, turn: 0.0 };
const FAST_BENT: Gait = Gait { period: 50.0, swing: 0.45, knee: 0.9, lean: 0.6, arms: 0.3, turn: 0.0 };

/// A walk: poses and foot contacts.
pub(crate) struct Walk {
    pub(crate) poses: Vec<Pose>,
    pub(crate) contact: Vec<[u8; 2]>,
}

fn limbs(gait: &Gait, phase: f32) -> Pose {
    let wave = |offset: f32| sin(TAU * (phase + offset));
    let mut pose = Pose { root: Vec3::ZERO, ..Pose::default() };
    let mut turn = |role: Role, q: Quat| pose.rotations[role.index()] = q;
    for (thigh, shin, foot, offset) in [
        (Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot, 0.0),
        (Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot, 0.5),
    ] {
        let hip = -gait.swing * wave(offset);
        let knee = 0.15 + 0.5 * gait.knee * (1.0 + wave(offset + 0.3));
        turn(thigh, Quat::from_rotation_x(hip));
        turn(shin, Quat::from_rotation_x(knee));
        turn(foot, Quat::from_rotation_x(-hip - knee));
    }
    turn(Role::Chest, Quat::from_rotation_x(gait.lean + 0.03 * wave(0.1)));
    for (arm, side, offset) in [(Role::LeftUpperArm, -1.0, 0.5), (Role::RightUpperArm, 1.0, 0.0)] {
        let swing = Quat::from_rotation_x(-gait.arms * wave(offset));
        turn(arm, swing * Quat::from_rotation_z(side * 1.3));
    }
    pose
}

/// `frames` frames of a gait from a phase on; the planted foot does not slide.
pub(crate) fn walk(gait: &Gait, frames: usize, first_phase: f32) -> Walk {
    let proportions = Proportions::default();
    let soles = Soles::new(&proportions);
    let (mut place, mut heading) = (Vec3::ZERO, 0.0_f32);
    let mut last: Option<[Vec3; 2]> = None;
    let mut out = Walk { poses: Vec::new(), contact: Vec::new() };
    for i in 0..frames {
        let mut pose = limbs(gait, first_phase + i as f32 / gait.period);
        let world = world_from_local(&proportions, &pose);
        let feet: [Vec3; 2] = std::array::from_fn(|s| soles.of(&world, s).ball);
        let standing = usize::from(feet[1].y < feet[0].y);
        heading += gait.turn / RATE_HZ;
        let facing = Quat::from_rotation_y(heading);
        if let Some(last) = last {
            let step = facing * (last[standing] - feet[standing]);
            place += Vec3::new(step.x, 0.0, step.z);
        }
        last = Some(feet);
        pose.root = Vec3::new(place.x, -feet[standing].y, place.z);
        pose.rotations[0] = facing;
        let stands = |s: usize| u8::from(feet[s].y - feet[standing].y < 0.01);
        out.poses.push(pose);
        out.contact.push([stands(0), stands(1)]);
    }
    out
}

/// Two actions (walk, fast) in two styles (neutral, bent), two clips each, registered by phase.
pub(crate) fn database() -> Database {
    let gaits = [[NEUTRAL, BENT], [FAST, FAST_BENT]];
    let proportions = Proportions::default();
    let mut clips = Vec::new();
    let (mut poses, mut contact, mut phases, mut periods) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (action, styles) in gaits.iter().enumerate() {
        for (style, gait) in styles.iter().enumerate() {
            for take in 0..2_u32 {
                let gait = Gait { period: gait.period + 2.0 * take as f32, turn: 0.1 * take as f32, ..*gait };
                let first_phase = 0.3 * take as f32;
                let clip = walk(&gait, FRAMES, first_phase);
                clips.push(Clip {
                    name: format!("{action}-{style}-{take}"),
                    action: action as u16,
                    style: style as u16,
                    take,
                    first_frame: poses.len(),
                    frames: FRAMES,
                    source: String::new(),
                    licence: String::new(),
                });
                phases.extend((0..FRAMES).map(|i| first_phase + i as f32 / gait.period));
                periods.extend([gait.period; FRAMES]);
                poses.extend(clip.poses);
                contact.extend(clip.contact);
            }
        }
    }
    let chart = PoseChart::from_poses(poses[..2 * FRAMES].iter().map(|p| (p, 0.0)));
    let (mut pose, mut cloud) = (Vec::new(), Vec::new());
    for clip in &clips {
        let (mut filter, mut previous) = (HeadingFilter::default(), None);
        for p in &poses[clip.rows()] {
            let heading = filter.update(&world_from_local(&proportions, p), 1.0 / RATE_HZ);
            pose.push(chart.encode(p, heading, previous, 1.0 / RATE_HZ));
            cloud.push(point_cloud(&proportions, p, heading));
            previous = Some(Placement { x: p.root.x, z: p.root.z, heading });
        }
    }
    let mut counterpart = Vec::new();
    for row in 0..poses.len() {
        let own = &clips[row / FRAMES];
        for style in 0..2 {
            for other in clips.iter().filter(|c| c.action == own.action && c.style == style) {
                let (first, period) = (other.first_frame, periods[other.first_frame]);
                let turns = (phases[row] - phases[first]).rem_euclid(1.0);
                counterpart.push(first as f32 + turns * period);
            }
        }
    }
    Database::new(DatabaseParts {
        rate_hz: RATE_HZ,
        proportions,
        chart,
        actions: vec!["walk".into(), "fast".into()],
        styles: vec!["neutral".into(), "bent".into()],
        neutral: 0,
        canonical_time: phases.iter().map(|p| 64.0 * p.rem_euclid(1.0)).collect(),
        time_step: periods.iter().map(|p| p / 64.0 / RATE_HZ).collect(),
        clips,
        pose,
        point_cloud: cloud,
        contact,
        counterparts_per_style: 2,
        counterpart,
    })
    .expect("the fixture is a database")
}
