//! One body under many names.

use super::*;
use crate::math::Quat;
use crate::motion::Motion;
use crate::skeleton::Joint;

/// The same body under the names of Mixamo, Biped, Bandai Namco, VRM, 100STYLE, Rokoko, SMPL, CMU and
/// Unreal.
const CONVENTIONS: [[&str; 22]; 9] = [
    [
        "mixamorig:Hips",
        "mixamorig:Spine",
        "mixamorig:Spine1",
        "mixamorig:Spine2",
        "mixamorig:Neck",
        "mixamorig:Head",
        "mixamorig:LeftShoulder",
        "mixamorig:LeftArm",
        "mixamorig:LeftForeArm",
        "mixamorig:LeftHand",
        "mixamorig:RightShoulder",
        "mixamorig:RightArm",
        "mixamorig:RightForeArm",
        "mixamorig:RightHand",
        "mixamorig:LeftUpLeg",
        "mixamorig:LeftLeg",
        "mixamorig:LeftFoot",
        "mixamorig:LeftToeBase",
        "mixamorig:RightUpLeg",
        "mixamorig:RightLeg",
        "mixamorig:RightFoot",
        "mixamorig:RightToeBase",
    ],
    [
        "Bip01 Pelvis",
        "Bip01 Spine",
        "Bip01 Spine1",
        "Bip01 Spine2",
        "Bip01 Neck",
        "Bip01 Head",
        "Bip01 L Clavicle",
        "Bip01 L UpperArm",
        "Bip01 L Forearm",
        "Bip01 L Hand",
        "Bip01 R Clavicle",
        "Bip01 R UpperArm",
        "Bip01 R Forearm",
        "Bip01 R Hand",
        "Bip01 L Thigh",
        "Bip01 L Calf",
        "Bip01 L Foot",
        "Bip01 L Toe0",
        "Bip01 R Thigh",
        "Bip01 R Calf",
        "Bip01 R Foot",
        "Bip01 R Toe0",
    ],
    [
        "Hips",
        "Spine",
        "Chest",
        "UpperChest",
        "Neck",
        "Head",
        "Shoulder_L",
        "UpperArm_L",
        "LowerArm_L",
        "Hand_L",
        "Shoulder_R",
        "UpperArm_R",
        "LowerArm_R",
        "Hand_R",
        "UpperLeg_L",
        "LowerLeg_L",
        "Foot_L",
        "Toes_L",
        "UpperLeg_R",
        "LowerLeg_R",
        "Foot_R",
        "Toes_R",
    ],
    [
        "J_Bip_C_Hips",
        "J_Bip_C_Spine",
        "J_Bip_C_Chest",
        "J_Bip_C_UpperChest",
        "J_Bip_C_Neck",
        "J_Bip_C_Head",
        "J_Bip_L_Shoulder",
        "J_Bip_L_UpperArm",
        "J_Bip_L_LowerArm",
        "J_Bip_L_Hand",
        "J_Bip_R_Shoulder",
        "J_Bip_R_UpperArm",
        "J_Bip_R_LowerArm",
        "J_Bip_R_Hand",
        "J_Bip_L_UpperLeg",
        "J_Bip_L_LowerLeg",
        "J_Bip_L_Foot",
        "J_Bip_L_ToeBase",
        "J_Bip_R_UpperLeg",
        "J_Bip_R_LowerLeg",
        "J_Bip_R_Foot",
        "J_Bip_R_ToeBase",
    ],
    [
        "Hips",
        "Chest",
        "Chest2",
        "Chest3",
        "Neck",
        "Head",
        "LeftCollar",
        "LeftShoulder",
        "LeftElbow",
        "LeftWrist",
        "RightCollar",
        "RightShoulder",
        "RightElbow",
        "RightWrist",
        "LeftHip",
        "LeftKnee",
        "LeftAnkle",
        "LeftToe",
        "RightHip",
        "RightKnee",
        "RightAnkle",
        "RightToe",
    ],
    [
        "hips",
        "spine1",
        "spine2",
        "spine3",
        "neck",
        "head",
        "left_shoulder",
        "left_arm",
        "left_forearm",
        "left_hand",
        "right_shoulder",
        "right_arm",
        "right_forearm",
        "right_hand",
        "left_thigh",
        "left_shin",
        "left_foot",
        "left_toe",
        "right_thigh",
        "right_shin",
        "right_foot",
        "right_toe",
    ],
    [
        "m_avg_Pelvis",
        "m_avg_Spine1",
        "m_avg_Spine2",
        "m_avg_Spine3",
        "m_avg_Neck",
        "m_avg_Head",
        "L_Collar",
        "L_Shoulder",
        "L_Elbow",
        "L_Wrist",
        "R_Collar",
        "R_Shoulder",
        "R_Elbow",
        "R_Wrist",
        "L_Hip",
        "L_Knee",
        "L_Ankle",
        "L_Foot",
        "R_Hip",
        "R_Knee",
        "R_Ankle",
        "R_Foot",
    ],
    [
        "root",
        "lowerback",
        "upperback",
        "thorax",
        "lowerneck",
        "head",
        "lclavicle",
        "lhumerus",
        "lradius",
        "lwrist",
        "rclavicle",
        "rhumerus",
        "rradius",
        "rwrist",
        "lfemur",
        "ltibia",
        "lfoot",
        "ltoes",
        "rfemur",
        "rtibia",
        "rfoot",
        "rtoes",
    ],
    [
        "pelvis",
        "spine_01",
        "spine_02",
        "spine_03",
        "neck_01",
        "head",
        "clavicle_l",
        "upperarm_l",
        "lowerarm_l",
        "hand_l",
        "clavicle_r",
        "upperarm_r",
        "lowerarm_r",
        "hand_r",
        "thigh_l",
        "calf_l",
        "foot_l",
        "ball_l",
        "thigh_r",
        "calf_r",
        "foot_r",
        "ball_r",
    ],
];

/// A body as (name, parent, offset); the same shape under any names.
fn body(names: &[&str; 22]) -> Motion {
    const SHAPE: [(Option<usize>, [f32; 3]); 22] = [
        (None, [0.0, 95.0, 0.0]),
        (Some(0), [0.0, 12.0, 0.0]),
        (Some(1), [0.0, 12.0, 0.0]),
        (Some(2), [0.0, 12.0, 0.0]),
        (Some(3), [0.0, 16.0, 0.0]),
        (Some(4), [0.0, 9.0, 0.0]),
        (Some(3), [3.0, 12.0, 0.0]),
        (Some(6), [14.0, 0.0, 0.0]),
        (Some(7), [28.0, 0.0, 0.0]),
        (Some(8), [24.0, 0.0, 0.0]),
        (Some(3), [-3.0, 12.0, 0.0]),
        (Some(10), [-14.0, 0.0, 0.0]),
        (Some(11), [-28.0, 0.0, 0.0]),
        (Some(12), [-24.0, 0.0, 0.0]),
        (Some(0), [9.0, -3.0, 0.0]),
        (Some(14), [0.0, -42.0, 0.0]),
        (Some(15), [0.0, -42.0, 0.0]),
        (Some(16), [0.0, -8.0, 14.0]),
        (Some(0), [-9.0, -3.0, 0.0]),
        (Some(18), [0.0, -42.0, 0.0]),
        (Some(19), [0.0, -42.0, 0.0]),
        (Some(20), [0.0, -8.0, 14.0]),
    ];
    let joints: Vec<Joint> = names
        .iter()
        .zip(SHAPE)
        .map(|(name, (parent, offset))| Joint {
            name: (*name).to_owned(),
            parent,
            offset: Vec3::from_array(offset),
            end: None,
        })
        .collect();
    let translations = joints.iter().map(|j| j.offset).collect();
    let rotations = vec![Quat::IDENTITY; joints.len()];
    Motion::new(Skeleton::new(joints).unwrap(), 1.0 / 30.0, translations, rotations).unwrap()
}

fn roles_of(motion: &Motion) -> [Option<usize>; JOINTS] {
    find_roles(&motion.skeleton, &Sample::of(motion)).joint_of_role
}

/// Spine, chest (of three trunk joints the first and the last), neck, head, arms, legs.
const EXPECTED: [usize; JOINTS] = [0, 1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21];

#[test]
fn finds_every_role_under_the_names_of_every_convention() {
    for names in CONVENTIONS {
        let motion = body(&names);
        let found = find_roles(&motion.skeleton, &Sample::of(&motion));
        assert_eq!(found.joint_of_role, EXPECTED.map(Some), "{}", names[0]);
        assert_eq!(found.confidence, 1.0, "{}", names[0]);
    }
}

#[test]
fn finds_every_role_without_names() {
    let names: Vec<String> = (0..22).map(|i| format!("node_{i}")).collect();
    let names: [&str; 22] = std::array::from_fn(|i| names[i].as_str());
    let motion = body(&names);
    let found = find_roles(&motion.skeleton, &Sample::of(&motion));
    assert_eq!(found.joint_of_role, EXPECTED.map(Some));
    assert!(found.confidence < 0.7);
}

#[test]
fn a_tail_is_no_body() {
    let names: Vec<String> = (0..22).map(|i| format!("node_{i}")).collect();
    let joints: Vec<Joint> = names
        .iter()
        .enumerate()
        .map(|(i, n)| Joint { name: n.clone(), parent: i.checked_sub(1), offset: Vec3::Y, end: None })
        .collect();
    let translations = joints.iter().map(|j| j.offset).collect();
    let skeleton = Skeleton::new(joints).unwrap();
    let motion = Motion::new(skeleton, 0.1, translations, vec![Quat::IDENTITY; 22]).unwrap();
    assert_eq!(roles_of(&motion), [None; JOINTS]);
}
