//! A performance on the skeletons of other programs is read as the same performance; a skeleton that is not human is
//! rejected.

use crate::mocap;
use crate::performances::apart;
use std::path::{Path, PathBuf};
use strut_core::humanoid::{HumanoidMotion, JOINTS, Proportions, Role};
use strut_core::math::{Quat, Vec3};
use strut_core::motion::Motion;
use strut_core::note::NoteCode;
use strut_core::retarget::{BindError, Binding, CharacterFacts, ReadAs, to_humanoid};
use strut_core::skeleton::{Joint, Skeleton};
use strut_formats::bvh;

/// Greatest distance of a joint from its position in the clean file, metres.
const NEAR: f32 = 1e-3;

/// Files as other programs write them: `$STRUT_MOCAP/../cases`, else `shared/cases` beside the repository. If they are
/// missing, prints that the test is skipped.
fn cases() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/cases");
    let folder = std::env::var_os("STRUT_MOCAP").map_or(beside, |data| PathBuf::from(data).join("../cases"));
    if !folder.is_dir() {
        mocap::skip("no files of other programs; they lie in `cases` beside the folder of STRUT_MOCAP");
        return None;
    }
    Some(folder)
}

fn read(path: &Path) -> Motion {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    bvh::parse(&bytes).unwrap().to_motion().unwrap()
}

fn case(folder: &Path, name: &str) -> Motion {
    read(&folder.join("files").join(name))
}

fn performed(motion: &Motion) -> HumanoidMotion {
    to_humanoid(motion, &Binding::detect(motion).unwrap(), &Proportions::default())
}

/// A joint that is inserted above others: its name, and its share of their translation.
struct Inserted {
    above: Vec<usize>,
    name: String,
    share: f32,
}

/// The motion with joints that do not turn inserted between given joints and their common parent.
fn with_inserted(motion: &Motion, inserted: &[Inserted]) -> Motion {
    let old = motion.skeleton.joints();
    // New joints, inserted ones (by index) and old ones, in an order with parents first.
    let mut joints: Vec<Joint> = Vec::new();
    let mut origin: Vec<(usize, f32, bool)> = Vec::new();
    let mut place = vec![0; old.len()];
    let mut place_of_inserted = vec![None; inserted.len()];
    for (j, joint) in old.iter().enumerate() {
        let mut parent = joint.parent.map(|p| place[p]);
        let mut rest = joint.offset;
        let mut taken = (j, 1.0, true);
        if let Some(i) = inserted.iter().position(|i| i.above.contains(&j)) {
            let share = inserted[i].share;
            let first = inserted[i].above[0];
            let at = *place_of_inserted[i].get_or_insert_with(|| {
                joints.push(Joint {
                    name: inserted[i].name.clone(),
                    parent,
                    offset: old[first].offset * share,
                    end: None,
                });
                origin.push((first, share, false));
                joints.len() - 1
            });
            parent = Some(at);
            rest = joint.offset - old[first].offset * share;
            taken = (j, share, true);
        }
        joints.push(Joint { name: joint.name.clone(), parent, offset: rest, end: joint.end });
        origin.push(taken);
        place[j] = joints.len() - 1;
    }
    let (mut translations, mut rotations) = (Vec::new(), Vec::new());
    for f in 0..motion.frames() {
        let (t, r) = (motion.translations_at(f), motion.rotations_at(f));
        for &(j, share, is_old) in &origin {
            let first = inserted.iter().find(|i| i.above.contains(&j)).map(|i| i.above[0]);
            translations.push(match (is_old, first) {
                (false, _) => t[j] * share,
                (true, Some(first)) => t[j] - t[first] * share,
                (true, None) => t[j],
            });
            rotations.push(if is_old { r[j] } else { Quat::IDENTITY });
        }
    }
    Motion::new(Skeleton::new(joints).unwrap(), motion.frame_time_secs, translations, rotations).unwrap()
}

/// The motion without the joints `ends`, which have no children.
fn without(motion: &Motion, ends: &[usize]) -> Motion {
    let kept: Vec<usize> = (0..motion.skeleton.len()).filter(|j| !ends.contains(j)).collect();
    let place = |old: usize| kept.iter().position(|&k| k == old);
    let joints = kept.iter().map(|&j| {
        let joint = &motion.skeleton.joints()[j];
        Joint { parent: joint.parent.and_then(place), ..joint.clone() }
    });
    let frames = 0..motion.frames();
    let translations = frames.clone().flat_map(|f| kept.iter().map(move |&j| motion.translations_at(f)[j])).collect();
    let rotations = frames.flat_map(|f| kept.iter().map(move |&j| motion.rotations_at(f)[j])).collect();
    Motion::new(Skeleton::new(joints.collect()).unwrap(), motion.frame_time_secs, translations, rotations).unwrap()
}

#[test]
fn a_walk_on_the_skeletons_of_other_programs_is_the_clean_walk() {
    let Some(folder) = cases() else { return };
    let clean = performed(&case(&folder, "00_clean.bvh"));
    for name in ["S06b_character_creator.bvh", "S17c_daz_no_pelvis.bvh", "S20_deepmotion.bvh"] {
        let motion = case(&folder, name);
        assert_eq!(Binding::detect(&motion).unwrap().confidence, 1.0, "{name}");
        let distance = apart(&performed(&motion), &clean);
        assert!(distance < NEAR, "{name}: {distance} m");
    }
}

#[test]
fn toes_at_the_ankle_are_no_toes() {
    let Some(folder) = cases() else { return };
    let motion = case(&folder, "S16_zero_toes.bvh");
    let joints = motion.skeleton.joints();
    let toes: Vec<usize> = (0..joints.len()).filter(|&j| joints[j].name.contains("Toe")).collect();
    assert_eq!(toes.len(), 2);
    let distance = apart(&performed(&motion), &performed(&without(&motion, &toes)));
    assert!(distance < NEAR, "{distance} m");
    let distance = apart(&performed(&motion), &performed(&case(&folder, "00_clean.bvh")));
    assert!(distance < NEAR, "{distance} m from the clean walk");
}

#[test]
fn a_hand_at_the_elbow_gives_the_forearm_to_the_joint_below_it() {
    let Some(clips) = mocap::clips() else { return };
    for path in clips.iter().step_by(91) {
        let motion = read(path);
        let joint = |role: Role| Binding::detect(&motion).unwrap().joint_of_role[role.index()].unwrap();
        let wrists = [Role::LeftHand, Role::RightHand].map(joint);
        let at_elbow = |(name, above): (&str, usize)| Inserted { above: vec![above], name: name.into(), share: 0.0 };
        let doubled = with_inserted(
            &motion,
            &["LeftHand", "RightHand"].into_iter().zip(wrists).map(at_elbow).collect::<Vec<_>>(),
        );
        let joints = doubled.skeleton.joints().iter().enumerate();
        let named = joints.map(|(j, joint)| {
            let is_wrist =
                joint.parent.is_some_and(|p| ["LeftHand", "RightHand"].contains(&&*doubled.skeleton.joints()[p].name));
            Joint { name: if is_wrist { format!("Palm{j}") } else { joint.name.clone() }, ..joint.clone() }
        });
        let doubled = Motion { skeleton: Skeleton::new(named.collect()).unwrap(), ..doubled.clone() };
        let distance = apart(&performed(&doubled), &performed(&motion));
        assert!(distance < NEAR, "{}: {distance} m", path.display());
    }
}

#[test]
fn a_pelvis_of_its_own_and_twist_bones_change_nothing() {
    let Some(clips) = mocap::clips() else { return };
    for path in clips.iter().step_by(23) {
        let motion = read(path);
        let binding = Binding::detect(&motion).unwrap();
        let joint = |role: Role| binding.joint_of_role[role.index()].unwrap();
        let clean = performed(&motion);
        let hips = joint(Role::Hips);
        let on_hips = |roles: [Role; 2]| {
            // The ancestor of each joint that is a child of the hips.
            roles.map(|role| {
                let joints = motion.skeleton.joints();
                std::iter::successors(Some(joint(role)), |&j| joints[j].parent)
                    .find(|&j| joints[j].parent == Some(hips))
                    .unwrap()
            })
        };
        let legs = on_hips([Role::LeftUpperLeg, Role::RightUpperLeg]);
        let pelvis = Inserted { above: legs.to_vec(), name: "Pelvis".to_owned(), share: 0.0 };
        let twists = [
            (Role::LeftLowerLeg, "LeftUpLegTwist"),
            (Role::RightLowerLeg, "RightThighTwist"),
            (Role::LeftLowerArm, "LeftArmRoll"),
            (Role::RightHand, "RightForeArmTwist1"),
        ]
        .map(|(role, name)| Inserted { above: vec![joint(role)], name: name.to_owned(), share: 0.4 });
        let twisted = performed(&with_inserted(&motion, &twists));
        let distance = apart(&twisted, &clean);
        assert!(distance < NEAR, "{}: {distance} m with twist bones", path.display());
        let with_pelvis = with_inserted(&motion, &[pelvis]);
        let distance = apart(&performed(&with_pelvis), &clean);
        assert!(distance < NEAR, "{}: {distance} m with a pelvis", path.display());
    }
}

#[test]
fn a_dog_is_refused_unless_a_person_says_which_joints_to_take() {
    let Some(folder) = cases() else { return };
    let dog = case(&folder, "S38_dog.bvh");
    let error = Binding::detect(&dog).unwrap_err();
    assert!(matches!(error, BindError::NotHuman(_)), "{error}");
    assert!(error.to_string().starts_with("This body stands on four legs"), "{error}");
    let likely = Binding::likely_roles(&dog);
    for (role, joint) in Role::ALL.into_iter().zip(likely) {
        let (Some(side), Some(joint)) =
            (["Left", "Right"].into_iter().find(|s| role.name().starts_with(&s.to_lowercase())), joint)
        else {
            continue;
        };
        let name = &dog.skeleton.joints()[joint].name;
        assert!(name.starts_with(side), "{} is {name}", role.name());
    }
    let taken = Binding::read(&dog, &ReadAs { joints: Some(likely), ..ReadAs::default() }).unwrap();
    assert!(taken.doubts.iter().any(|note| note.code == NoteCode::NotHuman), "{:?}", taken.doubts);
    // Human joint names do not make a skeleton human.
    let named = dog.skeleton.joints().iter().map(|j| {
        let arm = |name: &str| name.replace("FrontUpperLeg", "Arm").replace("FrontLowerLeg", "ForeArm");
        Joint { name: arm(&j.name).replace("FrontFoot", "Hand").replace("FrontS", "S"), ..j.clone() }
    });
    let named = Motion { skeleton: Skeleton::new(named.collect()).unwrap(), ..dog.clone() };
    assert!(matches!(Binding::detect(&named), Err(BindError::NotHuman(_))));
}

/// Joints of a glTF character in its zero pose, with offsets along the world's axes.
fn gltf_skeleton(glb: &[u8], root: &str) -> Skeleton {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json: serde_json::Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    let nodes = json["nodes"].as_array().unwrap();
    let numbers = |node: usize, key: &str| -> Option<Vec<f32>> {
        Some(nodes[node][key].as_array()?.iter().map(|v| v.as_f64().unwrap() as f32).collect())
    };
    let mut joints: Vec<Joint> = Vec::new();
    let start = nodes.iter().position(|n| n["name"] == root).unwrap();
    let mut open: Vec<(usize, Option<usize>, Quat)> =
        vec![(start, None, Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2))];
    while let Some((node, parent, above)) = open.pop() {
        let t = numbers(node, "translation").map_or(Vec3::ZERO, |t| Vec3::from_slice(&t));
        let turn = numbers(node, "rotation").map_or(Quat::IDENTITY, |r| Quat::from_xyzw(r[0], r[1], r[2], r[3]));
        let name = nodes[node]["name"].as_str().unwrap().to_owned();
        joints.push(Joint { name, parent, offset: above * t, end: None });
        let own = joints.len() - 1;
        let children = nodes[node]["children"].as_array().into_iter().flatten();
        open.extend(children.map(|c| (c.as_u64().unwrap() as usize, Some(own), above * turn)));
    }
    Skeleton::new(joints).unwrap()
}

#[test]
fn a_fox_is_no_character() {
    let Some(folder) = cases() else { return };
    let fox = gltf_skeleton(&std::fs::read(folder.join("rigs/Fox.glb")).unwrap(), "b_Hip_01");
    let facts = CharacterFacts { metres_per_unit: 0.01, sole_height: None, roles: [None; JOINTS] };
    let error = Binding::of_character(&fox, &facts).unwrap_err();
    assert!(matches!(error, BindError::NotHuman(_)), "{error}");
}

#[test]
fn no_recording_of_a_person_is_refused_or_doubted_to_be_human() {
    let Some(clips) = mocap::clips() else { return };
    for path in clips {
        let binding = Binding::detect(&read(&path)).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(binding.doubts.iter().all(|note| note.code != NoteCode::NotHuman), "{}", path.display());
    }
}
