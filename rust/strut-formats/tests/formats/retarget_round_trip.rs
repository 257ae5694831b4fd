//! Retargeting of real motion capture: every clip is unchanged after the conversion to a database's body and back, and
//! looks human on that body.

use crate::mocap;
use std::path::{Path, PathBuf};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Pose, Proportions, Role};
use strut_core::kinematics::{WorldPose, world_from_local};
use strut_core::math::{Quat, Vec3, exp_map};
use strut_core::motion::Motion;
use strut_core::pose_vector::heading_of;
use strut_core::retarget::{Binding, from_humanoid, to_humanoid};
use strut_formats::bvh;

struct Clip {
    /// Folder and file name.
    name: String,
    motion: Motion,
    binding: Binding,
}

fn load(path: &Path) -> Clip {
    let name = path.iter().rev().take(2).map(|p| p.to_string_lossy()).collect::<Vec<_>>();
    let name = format!("{}/{}", name[1], name[0]);
    let motion = bvh::parse(&std::fs::read(path).unwrap()).unwrap().to_motion().unwrap();
    let binding = Binding::detect(&motion).unwrap_or_else(|e| panic!("{name}: {e}"));
    Clip { name, motion, binding }
}

/// First clip whose path contains `part`.
fn find(clips: &[PathBuf], part: &str) -> Option<Clip> {
    clips.iter().find(|p| p.to_string_lossy().contains(part)).map(|p| load(p))
}

/// World positions of a file's joints in metres.
fn positions(clip: &Clip, motion: &Motion, frame: usize) -> Vec<Vec3> {
    let mut world: Vec<(Vec3, Quat)> = Vec::new();
    let locals = motion.translations_at(frame).iter().zip(motion.rotations_at(frame));
    for (joint, (t, r)) in motion.skeleton.joints().iter().zip(locals) {
        let (p, q) = joint.parent.map_or((Vec3::ZERO, Quat::IDENTITY), |p| world[p]);
        world.push((p + q * *t, q * *r));
    }
    world.into_iter().map(|(p, _)| p * clip.binding.metres_per_unit).collect()
}

/// Mean error of all joints, and of ankles and toes, after the conversion to a body and back, centimetres.
fn round_trip_errors(clip: &Clip, body: &Proportions) -> (f32, f32) {
    let humanoid = to_humanoid(&clip.motion, &clip.binding, body);
    let frames: Vec<f64> = (0..clip.motion.frames()).map(|f| f as f64).collect();
    let back = from_humanoid(&humanoid, &clip.motion, &clip.binding, &frames);
    let roles = [Role::LeftFoot, Role::RightFoot, Role::LeftToes, Role::RightToes];
    let feet: Vec<usize> = roles.iter().filter_map(|r| clip.binding.joint_of_role[r.index()]).collect();
    let (mut all, mut foot) = (0.0, 0.0);
    for f in 0..clip.motion.frames() {
        let (before, after) = (positions(clip, &clip.motion, f), positions(clip, &back, f));
        let errors: Vec<f32> = before.iter().zip(&after).map(|(a, b)| 100.0 * (*a - *b).length()).collect();
        all += errors.iter().sum::<f32>() / errors.len() as f32;
        foot += feet.iter().map(|&j| errors[j]).sum::<f32>() / feet.len() as f32;
    }
    (all / clip.motion.frames() as f32, foot / clip.motion.frames() as f32)
}

#[test]
fn every_clip_comes_back_from_the_bodies_of_two_databases() {
    let Some(clips) = mocap::clips() else { return };
    let bodies: Vec<(&str, Proportions)> = ["bandai-namco-2", "xia"]
        .into_iter()
        .filter_map(|set| Some((set, find(&clips, &format!("/{set}/"))?.binding.proportions)))
        .collect();
    let mut worst = (0.0_f32, 0.0_f32);
    for clip in clips.iter().map(|p| load(p)) {
        for (set, body) in &bodies {
            let (all, feet) = round_trip_errors(&clip, body);
            assert!(all <= 1.0 && feet <= 0.5, "{} on {set}: {all} cm, feet {feet} cm", clip.name);
            worst = (worst.0.max(all), worst.1.max(feet));
        }
    }
    println!("worst clip: mean joint error {:.3} cm, feet {:.3} cm", worst.0, worst.1);
}

#[test]
fn a_skeleton_binds_alike_in_every_clip() {
    let Some(clips) = mocap::clips() else { return };
    for sets in [vec!["/xia/"], vec!["/bandai-namco-1/", "/bandai-namco-2/"]] {
        let of_sets = clips.iter().filter(|p| sets.iter().any(|s| p.to_string_lossy().contains(s)));
        let mut bound = of_sets.map(|p| load(p));
        let Some(first) = bound.next() else { continue };
        for clip in bound {
            assert_eq!(clip.binding.joint_of_role, first.binding.joint_of_role, "{}", clip.name);
            let rests = clip.binding.rest_world_rotations.iter().zip(&first.binding.rest_world_rotations);
            let turned = rests.map(|(a, b)| a.inv_mul(*b).angle()).fold(0.0, f32::max);
            let offsets = clip.binding.proportions.offsets.iter().zip(&first.binding.proportions.offsets);
            let moved = offsets.map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max);
            // In some files the offset of the right knee differs by 0.4 mm, which is 1 mrad of the thigh.
            assert!(turned < 2e-3 && moved < 1e-3, "{} and {}: {turned} rad, {moved} m", clip.name, first.name);
        }
    }
}

#[test]
fn the_rest_pose_is_a_t_pose_of_human_size() {
    let Some(clips) = mocap::clips() else { return };
    for clip in clips.iter().map(|p| load(p)) {
        let p = clip.binding.proportions;
        let rest = Pose { root: p.offsets[0], ..Pose::default() };
        let at = |r: Role| world_from_local(&p, &rest).positions[r.index()];
        let name = &clip.name;
        assert!((1.2..2.0).contains(&at(Role::Head).y), "{name}: head at {}", at(Role::Head));
        for (side, hip) in [(1.0, Role::LeftUpperLeg), (-1.0, Role::RightUpperLeg)] {
            let role = |left: Role| if side > 0.0 { left } else { left.mirrored() };
            let (ankle, toes) = (at(role(Role::LeftFoot)), at(role(Role::LeftToes)));
            assert!((ankle - at(hip)).normalize().y < -0.999 && ankle.x * side > 0.03, "{name}: leg to {ankle}");
            assert!((0.02..0.15).contains(&ankle.y), "{name}: ankle at {ankle}");
            assert!(toes.z > ankle.z + 0.05 && toes.y < ankle.y, "{name}: toes at {toes}");
            let arm = at(role(Role::LeftHand)) - at(role(Role::LeftUpperArm));
            assert!(arm.normalize().x * side > 0.999, "{name}: arm along {arm}");
        }
    }
}

/// Means over a clip's frames, relative to the heading (+Z ahead, +X left).
struct Look {
    /// Cosine of the angle between heading and travel.
    ahead: f32,
    /// Horizontal direction of each foot.
    feet: [Vec3; 2],
    /// Flexion of the knees and elbows, degrees, left first.
    knees: [f32; 2],
    elbows: [f32; 2],
    /// Positions relative to the hips, metres.
    ankles: [Vec3; 2],
    head: Vec3,
    /// Wrists relative to shoulders.
    hands: [Vec3; 2],
    /// Directions of the palms and of the thumb sides of the hands.
    palms: [Vec3; 2],
    thumbs: [Vec3; 2],
}

fn look(motion: &HumanoidMotion) -> Look {
    let worlds: Vec<WorldPose> = motion.poses.iter().map(|p| world_from_local(&motion.proportions, p)).collect();
    let headings: Vec<Quat> = worlds.iter().map(|w| Quat::from_rotation_y(heading_of(w).expect("a heading"))).collect();
    let mean = |f: &dyn Fn(&WorldPose) -> Vec3| {
        let sum = worlds.iter().zip(&headings).fold(Vec3::ZERO, |sum, (w, h)| sum + h.inv_mul_vec3(f(w)));
        sum / worlds.len() as f32
    };
    let at = |w: &WorldPose, r: Role| w.positions[r.index()];
    let both = |f: &dyn Fn(Role) -> Vec3, left: Role| [f(left), f(left.mirrored())];
    // Flexion is the part of a local rotation about the hinge.
    let flexion = |role: Role, axis: Vec3| {
        let angles = motion.poses.iter().map(|p| {
            let (_, twist) = p.rotations[role.index()].swing_twist(axis);
            exp_map::log(twist).dot(axis).to_degrees()
        });
        angles.sum::<f32>() / motion.poses.len() as f32
    };
    let steps = worlds.windows(2).zip(&headings).map(|(w, h)| {
        let step = h.inv_mul_vec3(at(&w[1], Role::Hips) - at(&w[0], Role::Hips));
        Vec3::new(step.x, 0.0, step.z)
    });
    let travel = steps.fold(Vec3::ZERO, |sum, s| sum + s);
    let flat = |v: Vec3| Vec3::new(v.x, 0.0, v.z).normalize_or_zero();
    Look {
        ahead: travel.normalize_or_zero().z,
        feet: both(&|r| flat(mean(&|w| w.rotations[r.index()] * Vec3::Z)), Role::LeftFoot),
        knees: [Role::LeftLowerLeg, Role::RightLowerLeg].map(|r| flexion(r, Vec3::X)),
        elbows: [flexion(Role::LeftLowerArm, Vec3::NEG_Y), flexion(Role::RightLowerArm, Vec3::Y)],
        ankles: both(&|r| mean(&|w| at(w, r) - at(w, Role::Hips)), Role::LeftFoot),
        head: mean(&|w| at(w, Role::Head) - at(w, Role::Hips)),
        hands: [
            mean(&|w| at(w, Role::LeftHand) - at(w, Role::LeftUpperArm)),
            mean(&|w| at(w, Role::RightHand) - at(w, Role::RightUpperArm)),
        ],
        palms: both(&|r| mean(&|w| w.rotations[r.index()] * Vec3::NEG_Y), Role::LeftHand),
        thumbs: both(&|r| mean(&|w| w.rotations[r.index()] * Vec3::Z), Role::LeftHand),
    }
}

#[test]
fn walks_look_like_walks_on_every_skeleton() {
    let Some(clips) = mocap::clips() else { return };
    let bodies = [find(&clips, "/bandai-namco-2/"), find(&clips, "/xia/")];
    let walks = ["_01_0", "dataset-1_walk_", "dataset-2_walk_", "cmu/walk", "cmu/female-walk"];
    let is_walk = |p: &&PathBuf| walks.iter().any(|w| p.to_string_lossy().contains(w));
    let mut seen = 0;
    for clip in clips.iter().filter(is_walk).map(|p| load(p)) {
        for body in bodies.iter().flatten() {
            let motion = to_humanoid(&clip.motion, &clip.binding, &body.binding.proportions);
            let (look, name) = (look(&motion), &clip.name);
            seen += 1;
            assert!(look.ahead > 0.9, "{name} walks towards {}", look.ahead);
            assert!(look.head.y > 0.35, "{name}: head at {}", look.head);
            for side in 0..2 {
                assert!(look.feet[side].z > 0.75, "{name}: foot points to {}", look.feet[side]);
                assert!((8.0..80.0).contains(&look.knees[side]), "{name}: knee flexed by {}", look.knees[side]);
                assert!((3.0..150.0).contains(&look.elbows[side]), "{name}: elbow flexed by {}", look.elbows[side]);
                assert!(look.hands[side].y < 0.05, "{name}: hand at {}", look.hands[side]);
            }
        }
    }
    assert!(seen > 0, "no walk among {} clips", clips.len());
}

/// Neutral walks of all four sets.
fn neutral_walks(clips: &[PathBuf]) -> Vec<Clip> {
    let parts = ["xia/neutral_01_000", "cmu/walk", "dataset-1_walk_normal_001", "dataset-2_walk_normal_001"];
    parts.iter().filter_map(|part| find(clips, part)).collect()
}

#[test]
fn neutral_walkers_have_feet_below_hips_palms_to_the_thighs_and_thumbs_ahead() {
    let Some(clips) = mocap::clips() else { return };
    for clip in neutral_walks(&clips) {
        let motion = to_humanoid(&clip.motion, &clip.binding, &clip.binding.proportions);
        let look = look(&motion);
        assert!(look.ankles[0].x > look.ankles[1].x + 0.02, "{}: ankles at {:?}", clip.name, look.ankles);
        for (side, inward) in [(0, Vec3::NEG_X), (1, Vec3::X)] {
            assert!(look.hands[side].y < -0.3, "{}: hand at {}", clip.name, look.hands[side]);
            assert!(look.palms[side].dot(inward) > 0.4, "{}: palm faces {}", clip.name, look.palms[side]);
            assert!(look.thumbs[side].z > 0.4, "{}: thumb towards {}", clip.name, look.thumbs[side]);
        }
    }
}

#[test]
fn neutral_walks_of_all_sets_are_the_same_species() {
    let Some(clips) = mocap::clips() else { return };
    let walks = neutral_walks(&clips);
    let means: Vec<[Quat; JOINTS]> = walks
        .iter()
        .map(|clip| {
            let motion = to_humanoid(&clip.motion, &clip.binding, &clip.binding.proportions);
            let mean = |j: usize| {
                let rotations: Vec<Quat> = motion.poses.iter().map(|p| p.rotations[j]).collect();
                exp_map::karcher_mean(&rotations)
            };
            std::array::from_fn(mean)
        })
        .collect();
    for (i, a) in means.iter().enumerate() {
        for (k, b) in means[..i].iter().enumerate() {
            // The hips' rotation contains the heading, which differs between clips.
            for role in &Role::ALL[1..] {
                let angle = a[role.index()].inv_mul(b[role.index()]).angle().to_degrees();
                let pair = (&walks[i].name, &walks[k].name);
                assert!(angle < 60.0, "{}: {angle}° between {pair:?}", role.name());
            }
        }
    }
}
