//! One body with the names of many conventions.

use super::*;
use crate::math::Quat;
use crate::motion::Motion;
use crate::skeleton::Joint;

/// The same body with the names of Mixamo, Biped, Bandai Namco, VRM, 100STYLE, Rokoko, SMPL, CMU and Unreal.
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

/// Names of a whole body: trunk from hips to head, then collarbone to hand and thigh to toes with `@` for the side.
struct Convention {
    trunk: [&'static str; 6],
    limbs: [&'static str; 8],
    sides: [&'static str; 2],
}

impl Convention {
    const fn new(trunk: [&'static str; 6], limbs: [&'static str; 8], sides: [&'static str; 2]) -> Self {
        Self { trunk, limbs, sides }
    }

    fn names(&self) -> Vec<String> {
        let of = |side: usize, parts: std::ops::Range<usize>| {
            self.limbs[parts].iter().map(move |name| name.replace('@', self.sides[side]))
        };
        let trunk = self.trunk.iter().map(|name| (*name).to_owned());
        trunk.chain(of(0, 0..4)).chain(of(1, 0..4)).chain(of(0, 4..8)).chain(of(1, 4..8)).collect()
    }
}

#[rustfmt::skip]
const MORE_CONVENTIONS: [Convention; 24] = [
    // DeepMotion.
    Convention::new(["hips_JNT", "spine_JNT", "spine1_JNT", "spine2_JNT", "neck_JNT", "head_JNT"],
        ["@_shoulder_JNT", "@_arm_JNT", "@_forearm_JNT", "@_hand_JNT", "@_upleg_JNT", "@_leg_JNT", "@_foot_JNT", "@_toebase_JNT"], ["l", "r"]),
    // Apple ARKit.
    Convention::new(["hips_joint", "spine_1_joint", "spine_4_joint", "spine_7_joint", "neck_1_joint", "head_joint"],
        ["@_shoulder_1_joint", "@_arm_joint", "@_forearm_joint", "@_hand_joint", "@_upLeg_joint", "@_leg_joint", "@_foot_joint", "@_toes_joint"], ["left", "right"]),
    // Perception Neuron with a performer's name.
    Convention::new(["Robot_Hips", "Robot_Spine", "Robot_Spine1", "Robot_Spine2", "Robot_Neck", "Robot_Head"],
        ["Robot_@Shoulder", "Robot_@Arm", "Robot_@ForeArm", "Robot_@Hand", "Robot_@UpLeg", "Robot_@Leg", "Robot_@Foot", "Robot_@ToeBase"], ["Left", "Right"]),
    // Xsens.
    Convention::new(["Pelvis", "L5", "L3", "T8", "Neck", "Head"],
        ["@Shoulder", "@UpperArm", "@ForeArm", "@Hand", "@UpperLeg", "@LowerLeg", "@Foot", "@Toe"], ["Left", "Right"]),
    // OptiTrack Motive.
    Convention::new(["Jane_Hip", "Jane_Ab", "Jane_Spine2", "Jane_Chest", "Jane_Neck", "Jane_Head"],
        ["Jane_@Shoulder", "Jane_@UArm", "Jane_@FArm", "Jane_@Hand", "Jane_@Thigh", "Jane_@Shin", "Jane_@Foot", "Jane_@Toe"], ["L", "R"]),
    // HumanIK.
    Convention::new(["Character1_Hips", "Character1_Spine", "Character1_Spine1", "Character1_Spine2", "Character1_Neck", "Character1_Head"],
        ["Character1_@Shoulder", "Character1_@Arm", "Character1_@ForeArm", "Character1_@Hand", "Character1_@UpLeg", "Character1_@Leg", "Character1_@Foot", "Character1_@ToeBase"], ["Left", "Right"]),
    // Maya rigs.
    Convention::new(["C_Hips_jnt", "C_Spine_01_jnt", "C_Spine_02_jnt", "C_Spine_03_jnt", "C_Neck_jnt", "C_Head_jnt"],
        ["@_Arm_Clavicle_jnt", "@_Arm_Shoulder_jnt", "@_Arm_Elbow_jnt", "@_Arm_Wrist_jnt", "@_Leg_Hip_jnt", "@_Leg_Knee_jnt", "@_Leg_Ankle_jnt", "@_Leg_Ball_jnt"], ["L", "R"]),
    // Advanced Skeleton.
    Convention::new(["Root_M", "Spine1_M", "Spine2_M", "Chest_M", "Neck_M", "Head_M"],
        ["Scapula_@", "Shoulder_@", "Elbow_@", "Wrist_@", "Hip_@", "Knee_@", "Ankle_@", "Toes_@"], ["L", "R"]),
    // Auto-Rig Pro.
    Convention::new(["root.x", "spine_01.x", "spine_02.x", "spine_03.x", "neck.x", "head.x"],
        ["shoulder.@", "arm_stretch.@", "forearm_stretch.@", "hand.@", "thigh_stretch.@", "leg_stretch.@", "foot.@", "toes_01.@"], ["l", "r"]),
    // Rigify, whose trunk joints share one word.
    Convention::new(["DEF-spine", "DEF-spine.001", "DEF-spine.002", "DEF-spine.003", "DEF-spine.004", "DEF-spine.006"],
        ["DEF-shoulder.@", "DEF-upper_arm.@", "DEF-forearm.@", "DEF-hand.@", "DEF-thigh.@", "DEF-shin.@", "DEF-foot.@", "DEF-toe.@"], ["L", "R"]),
    // Poser and Daz before Genesis 3.
    Convention::new(["hip", "abdomen", "abdomen2", "chest", "neck", "head"],
        ["@Collar", "@Shldr", "@ForeArm", "@Hand", "@Thigh", "@Shin", "@Foot", "@Toe"], ["l", "r"]),
    // Daz Genesis 3 and 8.
    Convention::new(["hip", "abdomenLower", "chestLower", "chestUpper", "neckLower", "head"],
        ["@Collar", "@ShldrBend", "@ForearmBend", "@Hand", "@ThighBend", "@Shin", "@Foot", "@Toe"], ["l", "r"]),
    // Daz Genesis 9.
    Convention::new(["hip", "spine1", "spine2", "spine4", "neck1", "head"],
        ["@_shoulder", "@_upperarm", "@_forearm", "@_hand", "@_thigh", "@_shin", "@_foot", "@_toes"], ["l", "r"]),
    // Character Creator.
    Convention::new(["CC_Base_Hip", "CC_Base_Waist", "CC_Base_Spine01", "CC_Base_Spine02", "CC_Base_NeckTwist01", "CC_Base_Head"],
        ["CC_Base_@_Clavicle", "CC_Base_@_Upperarm", "CC_Base_@_Forearm", "CC_Base_@_Hand", "CC_Base_@_Thigh", "CC_Base_@_Calf", "CC_Base_@_Foot", "CC_Base_@_ToeBase"], ["L", "R"]),
    // MakeHuman.
    Convention::new(["root", "spine05", "spine03", "spine01", "neck01", "head"],
        ["clavicle.@", "upperarm01.@", "lowerarm01.@", "wrist.@", "upperleg01.@", "lowerleg01.@", "foot.@", "toe1-1.@"], ["L", "R"]),
    // MakeHuman's older rig.
    Convention::new(["Hips", "Spine1", "Spine2", "Spine3", "Neck", "Head"],
        ["Clavicle_@", "UpArm_@", "LoArm_@", "Hand_@", "UpLeg_@", "LoLeg_@", "Foot_@", "Toe_@"], ["L", "R"]),
    // Second Life.
    Convention::new(["mPelvis", "mTorso", "mSpine3", "mChest", "mNeck", "mHead"],
        ["mCollar@", "mShoulder@", "mElbow@", "mWrist@", "mHip@", "mKnee@", "mAnkle@", "mFoot@"], ["Left", "Right"]),
    // MikuMikuDance: Japanese, as in Blender, English, romanised.
    Convention::new(["センター", "上半身", "上半身2", "上半身3", "首", "頭"],
        ["@肩", "@腕", "@ひじ", "@手首", "@足", "@ひざ", "@足首", "@つま先"], ["左", "右"]),
    Convention::new(["下半身", "上半身", "上半身2", "上半身3", "首", "頭"],
        ["肩.@", "腕.@", "ひじ.@", "手首.@", "足.@", "ひざ.@", "足首.@", "つま先.@"], ["L", "R"]),
    Convention::new(["center", "upper body", "upper body2", "upper body3", "neck", "head"],
        ["shoulder_@", "arm_@", "elbow_@", "wrist_@", "leg_@", "knee_@", "ankle_@", "toe_@"], ["L", "R"]),
    Convention::new(["sentaa", "jouhanshin", "jouhanshin2", "jouhanshin3", "kubi", "atama"],
        ["@_kata", "@_ude", "@_hiji", "@_tekubi", "@_ashi", "@_hiza", "@_ashikubi", "@_tsumasaki"], ["hidari", "migi"]),
    // Azure Kinect.
    Convention::new(["PELVIS", "SPINE_NAVEL", "SPINE_MID", "SPINE_CHEST", "NECK", "HEAD"],
        ["CLAVICLE_@", "SHOULDER_@", "ELBOW_@", "WRIST_@", "HIP_@", "KNEE_@", "ANKLE_@", "FOOT_@"], ["LEFT", "RIGHT"]),
    // SMPL.
    Convention::new(["pelvis", "spine1", "spine2", "spine3", "neck", "head"],
        ["@_collar", "@_shoulder", "@_elbow", "@_wrist", "@_hip", "@_knee", "@_ankle", "@_foot"], ["left", "right"]),
    // Meta's avatars.
    Convention::new(["Hips", "SpineLower", "SpineMiddle", "Chest", "Neck", "Head"],
        ["@_Shoulder", "@_ArmUpper", "@_ArmLower", "@_HandWrist", "@_LegUpper", "@_LegLower", "@_FootAnkle", "@_FootBall"], ["Left", "Right"]),
];

#[test]
fn finds_every_role_under_the_names_of_many_programs() {
    for convention in &MORE_CONVENTIONS {
        let names = convention.names();
        let motion = body(&std::array::from_fn(|i| names[i].as_str()));
        let found = find_roles(&motion.skeleton, &Sample::of(&motion));
        assert_eq!(found.joint_of_role, EXPECTED.map(Some), "{}, {}", names[0], names[6]);
        assert_eq!(found.confidence, 1.0, "{}, {}", names[0], names[6]);
    }
}

#[test]
fn one_part_without_a_name_is_found_by_the_other_side_or_its_place() {
    // Arms and legs, from the shoulder and the hip to the end.
    for limb in [[7, 8, 9], [14, 15, 16]] {
        for part in 0..3 {
            for sides in [vec![0], vec![4], vec![0, 4]] {
                // Two shoulders without upper arms may be upper arms.
                if limb[part] == 7 && sides.len() == 2 {
                    continue;
                }
                let mut names = CONVENTIONS[0];
                for side in &sides {
                    names[limb[part] + side] = "mixamorig:Thing";
                }
                let motion = body(&names);
                let found = find_roles(&motion.skeleton, &Sample::of(&motion));
                assert_eq!(found.joint_of_role, EXPECTED.map(Some), "{} {sides:?}", limb[part]);
                assert!(found.confidence > 0.85, "{}", found.confidence);
            }
        }
    }
}

#[test]
fn a_limb_without_names_is_the_mirror_image_of_a_named_one() {
    for joints in [6..10, 10..14, 14..18, 18..22] {
        let mut names = CONVENTIONS[0];
        joints.clone().for_each(|joint| names[joint] = "mixamorig:Thing");
        assert_eq!(roles_of(&body(&names)), EXPECTED.map(Some), "{joints:?}");
    }
}

/// A body as (name, parent, offset); the same shape with any names.
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

/// Spine, chest (the first and the last of three trunk joints), neck, head, arms, legs.
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
fn a_joint_at_the_place_of_the_hips_is_no_upper_leg_where_one_below_has_as_good_a_name() {
    let mut names = CONVENTIONS[0];
    names[14..].copy_from_slice(&[
        "LeftHip",
        "LeftKnee",
        "LeftAnkle",
        "LeftToe",
        "RightHip",
        "RightKnee",
        "RightAnkle",
        "RightToe",
    ]);
    let plain = body(&names);
    let mut joints: Vec<Joint> = Vec::new();
    let mut place = Vec::new();
    for joint in plain.skeleton.joints() {
        let mut parent = joint.parent.map(|parent: usize| place[parent]);
        if let "LeftHip" | "RightHip" = joint.name.as_str() {
            let name = format!("{}HipJoint", &joint.name[..1]);
            joints.push(Joint { name, parent, offset: Vec3::ZERO, end: None });
            parent = Some(joints.len() - 1);
        }
        place.push(joints.len());
        joints.push(Joint { parent, ..joint.clone() });
    }
    let translations = joints.iter().map(|j| j.offset).collect();
    let rotations = vec![Quat::IDENTITY; joints.len()];
    let motion = Motion::new(Skeleton::new(joints).unwrap(), 0.1, translations, rotations).unwrap();
    assert_eq!(roles_of(&motion), EXPECTED.map(|joint| Some(place[joint])));
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
