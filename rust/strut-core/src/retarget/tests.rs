//! One walk on many rigs: the canonical motion does not depend on a skeleton's zero pose, axes and unit.

use super::*;
use crate::humanoid::{HumanoidMotion, JOINTS, PARENTS, Pose, Proportions, Role};
use crate::kinematics::world_from_local;
use crate::math::float_funcs::sin;
use crate::math::{Quat, Vec3, exp_map};
use crate::motion::Motion;
use crate::note::NoteCode;
use crate::skeleton::{Joint, Skeleton};
use proptest::prelude::*;
use std::f32::consts::{FRAC_PI_2, TAU};

/// A body whose feet slope as those of game rigs do, so that rigs without a zero pose have the same feet.
fn body() -> Proportions {
    let mut p = Proportions::default();
    for toes in [Role::LeftToes, Role::RightToes] {
        p.offsets[toes.index()] = Quat::from_rotation_x(0.69) * Vec3::Z * 0.15;
    }
    for shoulder in [Role::LeftUpperArm, Role::RightUpperArm] {
        p.offsets[shoulder.index()].y = 0.0;
    }
    p
}

/// Two strides towards +X: arms hang and swing, elbows and knees flex, the trunk sways a little.
fn walk() -> HumanoidMotion {
    let proportions = body();
    let poses = (0..60).map(|f| {
        let phase = TAU * f as f32 / 30.0;
        let (swing, lift) = (sin(phase), sin(phase + 1.0));
        let mut pose = Pose { root: Vec3::new(0.03 * f as f32, 0.93 + 0.01 * lift, 0.2), ..Pose::default() };
        let mut turn = |role: Role, v: Vec3| pose.rotations[role.index()] = exp_map::exp(v);
        turn(Role::Hips, Vec3::new(0.0, FRAC_PI_2, 0.02 * swing));
        turn(Role::Spine, Vec3::new(0.05, 0.1 * swing, 0.0));
        turn(Role::Chest, Vec3::new(0.03, 0.05 * swing, 0.02));
        turn(Role::Neck, Vec3::new(0.1, 0.0, 0.03 * lift));
        turn(Role::Head, Vec3::new(-0.1, 0.1 * swing, 0.0));
        turn(Role::LeftShoulder, Vec3::new(0.0, 0.1, 0.05));
        turn(Role::RightShoulder, Vec3::new(0.0, -0.1, 0.05));
        turn(Role::LeftUpperArm, Vec3::new(0.4 * swing, 0.0, -1.2));
        turn(Role::RightUpperArm, Vec3::new(-0.4 * swing, 0.0, 1.2));
        turn(Role::LeftLowerArm, Vec3::new(0.2, -0.5 - 0.3 * lift, 0.0));
        turn(Role::RightLowerArm, Vec3::new(-0.2, 0.5 - 0.3 * lift, 0.0));
        turn(Role::LeftHand, Vec3::new(0.1, 0.0, 0.1 * swing));
        turn(Role::RightHand, Vec3::new(0.1, 0.1, 0.0));
        turn(Role::LeftUpperLeg, Vec3::new(-0.1 - 0.4 * swing, 0.05, 0.0));
        turn(Role::RightUpperLeg, Vec3::new(-0.1 + 0.4 * swing, -0.05, 0.0));
        turn(Role::LeftLowerLeg, Vec3::new(0.5 + 0.4 * lift, 0.0, 0.0));
        turn(Role::RightLowerLeg, Vec3::new(0.5 - 0.4 * lift, 0.0, 0.0));
        turn(Role::LeftFoot, Vec3::new(-0.1 * lift, 0.05, 0.0));
        turn(Role::RightFoot, Vec3::new(0.1 * lift, 0.0, 0.05));
        pose
    });
    HumanoidMotion { proportions, rate_hz: 30.0, poses: poses.collect() }
}

/// A rig for the body: each joint's frame in the canonical T-pose, and the file's world.
struct Rig {
    /// Frame of the rig's joint in the canonical joint's frame.
    frames: [Quat; JOINTS],
    file_from_world: Quat,
    units_per_metre: f32,
}

impl Default for Rig {
    fn default() -> Self {
        Self { frames: [Quat::IDENTITY; JOINTS], file_from_world: Quat::IDENTITY, units_per_metre: 100.0 }
    }
}

/// The motion as a file with this rig.
fn rigged(motion: &HumanoidMotion, rig: &Rig) -> Motion {
    let parent = |j: usize| PARENTS.get(j).copied().filter(|&p| p < JOINTS);
    let offset = |j: usize| {
        let frame = parent(j).map_or(Quat::IDENTITY, |p| rig.frames[p]);
        frame.inv_mul_vec3(motion.proportions.offsets[j]) * rig.units_per_metre
    };
    let joints = Role::ALL.iter().enumerate().map(|(j, role)| Joint {
        name: role.name().to_owned(),
        parent: parent(j),
        offset: offset(j),
        end: None,
    });
    let (mut translations, mut rotations) = (Vec::new(), Vec::new());
    for pose in &motion.poses {
        for j in 0..JOINTS {
            let above = parent(j).map_or(rig.file_from_world.inverse(), |p| rig.frames[p]);
            rotations.push(above.inv_mul(pose.rotations[j] * rig.frames[j]));
            translations.push(if j == 0 { rig.file_from_world * pose.root * rig.units_per_metre } else { offset(j) });
        }
    }
    let skeleton = Skeleton::new(joints.collect()).unwrap();
    Motion::new(skeleton, 1.0 / f64::from(motion.rate_hz), translations, rotations).unwrap()
}

/// Roles whose local rotations differ by more than 0.01 rad, and the greatest difference.
fn differing_roles(a: &HumanoidMotion, b: &HumanoidMotion) -> Vec<(&'static str, f32)> {
    let angle = |j: usize| {
        let pairs = a.poses.iter().zip(&b.poses);
        pairs.map(|(p, q)| p.rotations[j].inv_mul(q.rotations[j]).angle()).fold(0.0, f32::max)
    };
    Role::ALL.iter().map(|r| (r.name(), angle(r.index()))).filter(|(_, angle)| *angle > 0.01).collect()
}

/// Binds the rigged walk, and checks that the result is the canonical walk.
fn check_rig(rig: &Rig) -> Binding {
    let expected = walk();
    let file = rigged(&expected, rig);
    let binding = Binding::detect(&file).unwrap();
    let found = to_humanoid(&file, &binding, &expected.proportions);
    assert_eq!(differing_roles(&found, &expected), []);
    // Heights above the ground are only as accurate as the ankle's height.
    let root = (found.poses[40].root - expected.poses[40].root) * Vec3::new(1.0, 0.0, 1.0);
    assert!(root.length() < 1e-3, "{root}");
    assert!((binding.metres_per_unit * rig.units_per_metre - 1.0).abs() < 1e-4);
    binding
}

#[test]
fn a_t_pose_rig_is_the_humanoid() {
    let binding = check_rig(&Rig::default());
    assert_eq!(binding.joint_of_role, std::array::from_fn(Some));
    assert_eq!(binding.notes, ["Matched all 21 joints.", "Lengths are in centimetres."]);
}

#[test]
fn an_arms_down_zero_pose_is_raised() {
    let mut rig = Rig::default();
    for (upper, angle) in [(Role::LeftUpperArm, -1.3), (Role::RightUpperArm, 1.3)] {
        for j in upper.index()..upper.index() + 3 {
            rig.frames[j] = Quat::from_rotation_z(angle).inverse();
        }
    }
    check_rig(&rig);
}

#[test]
fn a_zero_pose_may_face_anywhere() {
    for turn in [FRAC_PI_2, 2.0 * FRAC_PI_2, -FRAC_PI_2] {
        check_rig(&Rig { frames: [Quat::from_rotation_y(turn); JOINTS], ..Rig::default() });
    }
}

#[test]
fn z_up_files_are_turned_upright() {
    let up = Quat::from_rotation_x(FRAC_PI_2);
    // The zero pose stands along +Z too, as exporters with that convention write it.
    let rig = Rig { file_from_world: up, frames: [up.inverse(); JOINTS], ..Rig::default() };
    let binding = check_rig(&rig);
    assert!(binding.notes.contains(&"The up axis of this file is +Z.".to_owned()));
}

#[test]
fn units_are_told_by_the_leg() {
    for (units_per_metre, word) in [(1.0, "metres"), (39.37, "inches"), (1000.0, "millimetres"), (10.0, "decimetres")] {
        let rig = Rig { units_per_metre, ..Rig::default() };
        let file = rigged(&walk(), &rig);
        let binding = Binding::detect(&file).unwrap();
        assert_eq!(binding.notes[1], format!("Lengths are in {word}."));
    }
    let odd = rigged(&walk(), &Rig { units_per_metre: 18.0, ..Rig::default() });
    let leg = Binding::detect(&odd).unwrap().proportions.leg_length();
    assert!((leg - 0.85).abs() < 1e-3, "{leg}");
}

#[test]
fn rigs_with_bones_along_any_local_axis_agree() {
    // Bandai Namco's convention and others: each joint's frame is rotated by quarter turns, so that the zero pose does not
    // resemble a body.
    let quarter = |axis: Vec3, n: usize| Quat::from_axis_angle(axis, FRAC_PI_2 * n as f32);
    for seed in 1..12_usize {
        let mut rig = Rig::default();
        for j in 0..JOINTS {
            let n = seed * (7 * j + 3) + j * j;
            rig.frames[j] = quarter(Vec3::X, n % 4) * quarter(Vec3::Y, n / 4 % 4) * quarter(Vec3::Z, n / 16 % 4);
        }
        // Pronation makes the twist of forearms ambiguous: they continue the upper arm. End joints have the frame of their
        // parent.
        for (role, above) in [
            (Role::LeftLowerArm, Role::LeftUpperArm),
            (Role::RightLowerArm, Role::RightUpperArm),
            (Role::LeftHand, Role::LeftUpperArm),
            (Role::RightHand, Role::RightLowerArm),
            (Role::Head, Role::Neck),
        ] {
            rig.frames[role.index()] = rig.frames[above.index()];
        }
        // The line from ankle to toes is along an axis; the toes' frame is bent up from it.
        for foot in [Role::LeftFoot, Role::RightFoot] {
            let sloped = Quat::from_rotation_x(0.69) * rig.frames[foot.index()];
            rig.frames[foot.index()] = sloped;
            rig.frames[foot.index() + 1] = Quat::from_rotation_x(-0.29) * sloped;
        }
        let binding = check_rig(&rig);
        assert_eq!(binding.notes.len(), 3, "{:?}", binding.notes);
    }
}

#[test]
fn the_file_comes_back_from_another_body() {
    let mut file_body = walk();
    for shin in [Role::LeftFoot, Role::RightFoot, Role::LeftHand, Role::RightHand] {
        file_body.proportions.offsets[shin.index()] *= 0.85;
    }
    file_body.proportions.offsets[Role::RightLowerLeg.index()] *= 1.03;
    let file = rigged(&file_body, &Rig::default());
    let binding = Binding::detect(&file).unwrap();
    let humanoid = to_humanoid(&file, &binding, &Proportions::default());
    let frames: Vec<f64> = (0..file.frames()).map(|f| f as f64).collect();
    let back = from_humanoid(&humanoid, &file, &binding, &frames);
    for (f, pose) in file_body.poses.iter().enumerate() {
        let before = world_from_local(&file_body.proportions, pose);
        let rotations = std::array::from_fn(|j| back.rotations_at(f)[j]);
        let after =
            world_from_local(&file_body.proportions, &Pose { root: back.translations_at(f)[0] / 100.0, rotations });
        for role in Role::ALL {
            let error = (after.positions[role.index()] - before.positions[role.index()]).length();
            assert!(error < 0.005, "frame {f}, {}: {error} m", role.name());
        }
        for end in [Role::LeftFoot, Role::RightFoot, Role::LeftToes, Role::LeftHand, Role::RightHand] {
            let error = (after.positions[end.index()] - before.positions[end.index()]).length();
            assert!(error < 0.001, "frame {f}, {}: {error} m", end.name());
        }
    }
}

#[test]
fn planted_feet_stay_planted_on_another_body() {
    let mut standing = walk();
    let world = |h: &HumanoidMotion, f: usize| world_from_local(&h.proportions, &h.poses[f]);
    // Only the trunk moves; inverse kinematics holds the feet.
    let first = standing.poses[0];
    let ankles = Role::LeftFoot.index();
    let held = world(&standing, 0).positions[ankles];
    for (f, pose) in standing.poses.iter_mut().enumerate() {
        *pose = first;
        pose.root += Vec3::new(0.002 * f as f32, -0.001 * f as f32, 0.0);
        let mut w = world_from_local(&standing.proportions, pose);
        crate::kinematics::two_bone_ik(&standing.proportions, pose, &mut w, crate::kinematics::Limb::LeftLeg, held);
    }
    let file = rigged(&standing, &Rig::default());
    let binding = Binding::detect(&file).unwrap();
    let mut target = Proportions::default();
    target.offsets[Role::LeftFoot.index()] *= 0.8;
    target.offsets[Role::RightFoot.index()] *= 0.8;
    let found = to_humanoid(&file, &binding, &target);
    let start = world(&found, 0).positions[ankles];
    for f in 0..found.poses.len() {
        let slid = (world(&found, f).positions[ankles] - start).length();
        assert!(slid < 1e-3, "frame {f}: {slid} m");
    }
}

#[test]
fn missing_joints_are_named() {
    let file = rigged(&walk(), &Rig::default());
    let mut roles = Binding::detect(&file).unwrap().joint_of_role;
    roles[Role::LeftLowerLeg.index()] = None;
    let error = Binding::read(&file, &ReadAs { joints: Some(roles), ..ReadAs::default() }).unwrap_err();
    let sentence = "No left knee was found in this skeleton. Choose the joint, or use another file.";
    assert_eq!(error.to_string(), sentence);
    roles[Role::LeftLowerLeg.index()] = Some(Role::Head.index());
    assert!(matches!(
        Binding::read(&file, &ReadAs { joints: Some(roles), ..ReadAs::default() }),
        Err(BindError::Misplaced { .. })
    ));
    roles[Role::LeftLowerLeg.index()] = Some(1000);
    assert!(matches!(
        Binding::read(&file, &ReadAs { joints: Some(roles), ..ReadAs::default() }),
        Err(BindError::Misplaced { .. })
    ));
}

#[test]
fn a_body_without_toes_shoulders_chest_and_neck_is_bound() {
    let full = rigged(&walk(), &Rig::default());
    let mut roles = Binding::detect(&full).unwrap().joint_of_role;
    let optional = [Role::Chest, Role::Neck, Role::LeftShoulder, Role::RightShoulder, Role::LeftToes, Role::RightToes];
    for role in optional {
        roles[role.index()] = None;
    }
    let binding = Binding::read(&full, &ReadAs { joints: Some(roles), ..ReadAs::default() }).unwrap();
    let humanoid = to_humanoid(&full, &binding, &Proportions::default());
    for pose in &humanoid.poses {
        assert!(pose.is_finite());
        for role in optional {
            assert!(pose.rotations[role.index()].angle() < 1e-3, "{}", role.name());
        }
    }
    assert_eq!(binding.unmapped.len(), optional.len());
}

#[test]
fn a_clip_without_frames_is_refused() {
    let mut file = rigged(&walk(), &Rig::default());
    file.translations.clear();
    file.rotations.clear();
    assert_eq!(Binding::detect(&file), Err(BindError::NoFrames));
}

/// A body on hands and feet, facing +Z: the trunk is horizontal, arms and legs hang down from it.
fn on_all_fours(proportions: Proportions) -> HumanoidMotion {
    let mut pose = Pose { root: Vec3::Y * 0.8, ..Pose::default() };
    pose.rotations[Role::Hips.index()] = Quat::from_rotation_x(FRAC_PI_2);
    for leg in [Role::LeftUpperLeg, Role::RightUpperLeg] {
        pose.rotations[leg.index()] = Quat::from_rotation_x(-FRAC_PI_2);
    }
    pose.rotations[Role::LeftUpperArm.index()] = Quat::from_rotation_y(-FRAC_PI_2);
    pose.rotations[Role::RightUpperArm.index()] = Quat::from_rotation_y(FRAC_PI_2);
    HumanoidMotion { proportions, rate_hz: 30.0, poses: vec![pose; 10] }
}

/// A rig whose zero pose is the first pose of the motion.
fn modelled_as(motion: &HumanoidMotion) -> Rig {
    let world = world_from_local(&motion.proportions, &motion.poses[0]);
    Rig { frames: world.rotations.map(Quat::inverse), ..Rig::default() }
}

/// The mannequin with longer arms and trunk.
fn stretched(arms: f32, trunk: f32) -> Proportions {
    let mut body = Proportions::default();
    for role in [Role::LeftLowerArm, Role::LeftHand] {
        body.offsets[role.index()] *= arms;
        body.offsets[role.mirrored().index()] *= arms;
    }
    for role in [Role::Spine, Role::Chest] {
        body.offsets[role.index()] *= trunk;
    }
    body
}

#[test]
fn what_is_modelled_and_stands_on_four_legs_of_an_animal_is_refused() {
    // A dog has long arms, a horse a long trunk.
    for body in [stretched(1.5, 1.0), stretched(1.3, 2.0)] {
        let animal = on_all_fours(body);
        let error = Binding::detect(&rigged(&animal, &modelled_as(&animal))).unwrap_err();
        assert!(matches!(error, BindError::NotHuman(_)), "{error}");
    }
}

#[test]
fn people_on_all_fours_and_figures_with_long_arms_who_stand_are_people() {
    let crawl = on_all_fours(stretched(1.1, 1.0));
    assert!(Binding::detect(&rigged(&crawl, &modelled_as(&crawl))).is_ok());
    // A costume of an ape: it is upright in the zero pose, or in the motion.
    let ape = on_all_fours(stretched(1.6, 1.2));
    assert!(Binding::detect(&rigged(&ape, &Rig::default())).is_ok());
    let walk = HumanoidMotion { proportions: stretched(1.6, 1.2), ..walk() };
    assert!(Binding::detect(&rigged(&walk, &Rig::default())).is_ok());
}

fn has_note(binding: &Binding, code: NoteCode) -> bool {
    binding.doubts.iter().any(|note| note.code == code)
}

#[test]
fn people_on_all_fours_have_the_up_axis_of_their_file() {
    let crawl = on_all_fours(stretched(1.1, 1.0));
    let binding = Binding::detect(&rigged(&crawl, &modelled_as(&crawl))).unwrap();
    assert_eq!(binding.up, UpAxis::Y);
    assert!(!has_note(&binding, NoteCode::UpUnsure));
    // The whole file is rotated; the body crawls over the ground.
    let mut crawl = on_all_fours(Proportions::default());
    crawl.poses = (0..60).map(|f| Pose { root: Vec3::new(0.0, 0.8, 0.03 * f as f32), ..crawl.poses[0] }).collect();
    for (axis, _) in UpAxis::ALL {
        let up = axis.to_y().inverse();
        let rig = Rig { file_from_world: up, frames: [up.inverse(); JOINTS], ..Rig::default() };
        assert_eq!(Binding::detect(&rigged(&crawl, &rig)).unwrap().up, axis);
    }
}

#[test]
fn who_stands_still_along_another_axis_than_the_zero_pose_is_taken_to_stand_and_who_lies_to_lie() {
    let standing = HumanoidMotion { proportions: body(), rate_hz: 30.0, poses: vec![Pose::default(); 30] };
    let mut lying = standing.clone();
    for pose in &mut lying.poses {
        for foot in [Role::LeftFoot, Role::RightFoot] {
            pose.rotations[foot.index()] = Quat::from_rotation_x(0.5);
        }
        pose.root *= Vec3::new(1.0, 0.2, 1.0);
    }
    for (axis, _) in UpAxis::ALL.into_iter().filter(|(axis, _)| *axis != UpAxis::Y) {
        let turned = Rig { file_from_world: axis.to_y().inverse(), ..Rig::default() };
        for (motion, up) in [(&standing, axis), (&lying, UpAxis::Y)] {
            let binding = Binding::detect(&rigged(motion, &turned)).unwrap();
            assert_eq!(binding.up, up, "{axis}");
            assert!(has_note(&binding, NoteCode::UpUnsure), "{axis}");
        }
    }
}

const SOME_NAMES: [&str; 24] = [
    "Hips",
    "Spine",
    "Chest",
    "Neck",
    "Head",
    "LeftShoulder",
    "LeftArm",
    "LeftForeArm",
    "LeftHand",
    "RightShoulder",
    "RightArm",
    "RightForeArm",
    "RightHand",
    "LeftUpLeg",
    "LeftLeg",
    "LeftFoot",
    "LeftToeBase",
    "RightUpLeg",
    "RightLeg",
    "RightFoot",
    "RightToeBase",
    "L",
    "node",
    "",
];

/// Any tree with any names, and two frames of any rotations.
fn any_motion() -> impl Strategy<Value = Motion> {
    let joint = (0usize..SOME_NAMES.len(), any::<prop::sample::Index>(), prop::array::uniform3(-3i8..4), -3.0f32..3.0);
    prop::collection::vec(joint, 1..40).prop_map(|joints| {
        let skeleton = joints.iter().enumerate().map(|(i, (name, parent, offset, _))| Joint {
            name: SOME_NAMES[*name].to_owned(),
            parent: (i > 0).then(|| parent.index(i)),
            offset: Vec3::from_array(offset.map(|v| f32::from(v) * 10.0)),
            end: None,
        });
        let skeleton = Skeleton::new(skeleton.collect()).unwrap();
        let translations = skeleton.joints().iter().map(|j| j.offset).cycle().take(2 * joints.len()).collect();
        let turns = joints.iter().chain(&joints).enumerate();
        let rotations = turns.map(|(i, j)| Quat::from_axis_angle(Vec3::X, j.3 * (i % 5) as f32)).collect();
        Motion::new(skeleton, 0.1, translations, rotations).unwrap()
    })
}

proptest! {
    #[test]
    fn any_tree_is_refused_or_retargeted_to_finite_numbers(motion in any_motion()) {
        if let Ok(binding) = Binding::detect(&motion) {
            let humanoid = to_humanoid(&motion, &binding, &Proportions::default());
            prop_assert!(humanoid.poses.iter().all(Pose::is_finite));
            let back = from_humanoid(&humanoid, &motion, &binding, &[0.0, 0.5]);
            prop_assert!(back.rotations.iter().all(|q| q.is_finite()));
            prop_assert!(back.translations.iter().all(|t| t.is_finite()));
        }
    }

    #[test]
    fn a_body_with_any_rotations_is_retargeted_to_finite_numbers(
        turns in prop::collection::vec(prop::array::uniform3(-3.0f32..3.0), JOINTS),
        crushed in 0usize..JOINTS,
    ) {
        let mut walk = walk();
        for (pose, k) in walk.poses.iter_mut().zip(1..) {
            for (q, turn) in pose.rotations.iter_mut().zip(&turns) {
                *q = exp_map::exp(Vec3::from_array(*turn) * (k % 7) as f32);
            }
        }
        walk.proportions.offsets[crushed] = Vec3::ZERO;
        let file = rigged(&walk, &Rig::default());
        if let Ok(binding) = Binding::detect(&file) {
            let humanoid = to_humanoid(&file, &binding, &Proportions::default());
            prop_assert!(humanoid.poses.iter().all(Pose::is_finite));
        }
    }
}

/// The skeleton of a character in the bind pose: the body, rotated and scaled as in the file.
fn character_skeleton(body: &Proportions, turned: Quat, units_per_metre: f32) -> Skeleton {
    let parent = |j: usize| PARENTS.get(j).copied().filter(|&p| p < JOINTS);
    let joints = Role::ALL.iter().enumerate().map(|(j, role)| Joint {
        name: role.name().to_owned(),
        parent: parent(j),
        offset: turned * body.offsets[j] * units_per_metre,
        end: None,
    });
    Skeleton::new(joints.collect()).unwrap()
}

fn known(metres_per_unit: f32, sole_height: Option<f32>) -> CharacterFacts {
    CharacterFacts { metres_per_unit, sole_height, roles: [None; JOINTS] }
}

#[test]
fn a_character_has_the_unit_and_the_soles_that_are_given() {
    let mut child = Proportions::default();
    child.offsets.iter_mut().for_each(|o| *o *= 0.5);
    let skeleton = character_skeleton(&child, Quat::from_rotation_y(2.0 * FRAC_PI_2), 39.37);
    // Soles 2 cm thicker than bare feet.
    let binding = Binding::of_character(&skeleton, &known(0.0254, Some(-0.02 * 39.37))).unwrap();
    for (j, (found, expected)) in binding.proportions.offsets.iter().zip(child.offsets).enumerate().skip(1) {
        assert!((*found - expected).length() < 1e-4, "{j}: {found} {expected}");
    }
    assert!((binding.proportions.offsets[0].y - child.offsets[0].y - 0.02).abs() < 1e-4);
    assert_eq!(binding.notes[1], "Lengths are in inches.");
    let guessed = Binding::of_character(&skeleton, &known(0.0254, None)).unwrap();
    assert!((guessed.proportions.offsets[0].y - child.offsets[0].y - 0.02).abs() > 0.002);
}

#[test]
fn given_roles_come_first_and_found_ones_fill_the_rest() {
    let skeleton = character_skeleton(&Proportions::default(), Quat::IDENTITY, 1.0);
    let mut facts = known(1.0, None);
    facts.roles[Role::Neck.index()] = Some(Role::Head.index());
    let binding = Binding::of_character(&skeleton, &facts).unwrap();
    assert_eq!(binding.joint_of_role[Role::Neck.index()], Some(Role::Head.index()));
    assert_eq!(binding.joint_of_role[Role::Head.index()], None);
    facts.roles = std::array::from_fn(Some);
    facts.roles[Role::Neck.index()] = None;
    let binding = Binding::of_character(&skeleton, &facts).unwrap();
    assert_eq!((binding.confidence, binding.joint_of_role), (1.0, facts.roles));
    facts.roles[Role::LeftFoot.index()] = Some(Role::Head.index());
    assert!(matches!(Binding::of_character(&skeleton, &facts), Err(BindError::Misplaced { .. })));
}

#[test]
fn found_roles_that_do_not_fit_given_ones_are_left_out_on_both_sides() {
    let plain = character_skeleton(&Proportions::default(), Quat::IDENTITY, 1.0);
    // A joint between the chest and the collarbone of each side, which is given as the upper arm.
    for sides in [&[Role::LeftShoulder][..], &[Role::RightShoulder], &[Role::LeftShoulder, Role::RightShoulder]] {
        let mut joints: Vec<Joint> = plain.joints().to_vec();
        let mut facts = known(1.0, None);
        for side in sides {
            let at = joints.iter().position(|j| j.name == side.name()).unwrap();
            let half = joints[at].offset * 0.5;
            joints[at].offset = half;
            let above = Joint { name: format!("above {}", side.name()), offset: half, ..joints[at].clone() };
            joints.insert(at, above);
            for joint in &mut joints[at + 1..] {
                joint.parent = joint.parent.map(|p| p + usize::from(p >= at));
            }
            joints[at + 1].parent = Some(at);
        }
        let skeleton = Skeleton::new(joints).unwrap();
        for side in sides {
            let arm = if *side == Role::LeftShoulder { Role::LeftUpperArm } else { Role::RightUpperArm };
            facts.roles[arm.index()] =
                skeleton.joints().iter().position(|j| j.name == format!("above {}", side.name()));
        }
        let binding = Binding::of_character(&skeleton, &facts).unwrap();
        for side in [Role::LeftShoulder, Role::RightShoulder] {
            assert_eq!(binding.joint_of_role[side.index()].is_none(), sides.contains(&side), "{sides:?}");
        }
    }
}

#[test]
fn characters_of_no_size_are_refused() {
    let skeleton = character_skeleton(&Proportions::default(), Quat::IDENTITY, 1.0);
    assert_eq!(Binding::of_character(&skeleton, &known(1e-6, None)), Err(BindError::Size));
    assert_eq!(Binding::of_character(&skeleton, &known(1e6, None)), Err(BindError::Size));
    let one = Skeleton::new(vec![skeleton.joints()[0].clone()]).unwrap();
    assert_eq!(Binding::of_character(&one, &known(1.0, None)), Err(BindError::NotHumanoid));
}

/// World transforms of a character that performs a pose.
fn performed(binding: &Binding, skeleton: &Skeleton, pose: &Pose) -> Vec<(Vec3, Quat)> {
    let mut retarget = FromHumanoid::for_character(binding, &Proportions::default(), &[]);
    let mut translations: Vec<Vec3> = skeleton.joints().iter().map(|j| j.offset).collect();
    let mut rotations = vec![Quat::IDENTITY; skeleton.len()];
    retarget.frame(pose, &mut translations, &mut rotations);
    let mut world: Vec<(Vec3, Quat)> = Vec::new();
    for (j, joint) in skeleton.joints().iter().enumerate() {
        let (p, q) = joint.parent.map_or((Vec3::ZERO, Quat::IDENTITY), |p| world[p]);
        world.push((p + q * translations[j], q * rotations[j]));
    }
    world
}

#[test]
fn a_longer_foot_turns_on_its_heel_and_on_its_ball_without_sinking() {
    let mut body = Proportions::default();
    for toes in [Role::LeftToes, Role::RightToes] {
        body.offsets[toes.index()].z *= 1.6;
    }
    let skeleton = character_skeleton(&body, Quat::IDENTITY, 1.0);
    let binding = Binding::of_character(&skeleton, &known(1.0, Some(0.0))).unwrap();
    let soles = crate::kinematics::Soles::new(&binding.proportions);
    let lowest = |pitch: f32| {
        let mut pose = Pose { root: Vec3::new(0.0, 1.2, 0.0), ..Pose::default() };
        // Above the ground, where no sole is lifted.
        pose.rotations[Role::LeftFoot.index()] = Quat::from_rotation_x(pitch);
        // A foot on its ball has its toes on the ground.
        pose.rotations[Role::LeftToes.index()] = Quat::from_rotation_x(-pitch.max(0.0));
        let expected = crate::kinematics::Soles::new(&Proportions::default())
            .of(&world_from_local(&Proportions::default(), &pose), 0)
            .lowest();
        let world = performed(&binding, &skeleton, &pose);
        let [foot, toes] = [Role::LeftFoot, Role::LeftToes].map(|r| world[r.index()]);
        let sole = soles.from_ankle(0, [foot.1, toes.1], body.offsets[Role::LeftToes.index()]);
        foot.0.y + sole.lowest() - expected
    };
    for pitch in [-0.6, -0.3, -0.1, 0.0, 0.1, 0.3, 0.6] {
        assert!(lowest(pitch).abs() < 0.005, "{pitch}: {}", lowest(pitch));
    }
}

#[test]
fn joints_between_spine_and_chest_share_the_turn() {
    let body = Proportions::default();
    let plain = character_skeleton(&body, Quat::IDENTITY, 1.0);
    // One more joint halfway to the chest.
    let mut joints: Vec<Joint> = plain.joints().to_vec();
    let half = joints[2].offset * 0.5;
    joints[2].offset = half;
    joints.insert(2, Joint { name: "spine_b".to_owned(), parent: Some(1), offset: half, end: None });
    for (j, joint) in joints.iter_mut().enumerate().skip(3) {
        let parent = joint.parent.unwrap_or(0);
        joint.parent = Some(if j == 3 { 2 } else { parent + usize::from(parent >= 2) });
    }
    let skeleton = Skeleton::new(joints).unwrap();
    let binding = Binding::of_character(&skeleton, &known(1.0, None)).unwrap();
    let mut pose = Pose { root: body.offsets[0], ..Pose::default() };
    pose.rotations[Role::Chest.index()] = Quat::from_rotation_y(0.8);
    let world = performed(&binding, &skeleton, &pose);
    let turns: Vec<f32> = (1..4).map(|j| world[j].1.angle()).collect();
    assert!(
        (turns[0] - 0.0).abs() < 1e-3 && (turns[1] - 0.4).abs() < 1e-3 && (turns[2] - 0.8).abs() < 1e-3,
        "{turns:?}"
    );
}
