//! The same performance in another file gives the same motion: every clip with another floor, up axis, sides and position.

use crate::mocap;
use std::path::Path;
use strut_core::humanoid::{HumanoidMotion, Proportions};
use strut_core::kinematics::world_from_local;
use strut_core::math::{Quat, Vec3};
use strut_core::motion::Motion;
use strut_core::note::NoteCode;
use strut_core::retarget::{Binding, UpAxis, to_humanoid};
use strut_core::skeleton::{Joint, Skeleton};
use strut_core::transfer::ClipInput;
use strut_formats::bvh::{self, Bvh, Channel};

/// The motion on the default body, and the codes of its notes.
fn read(motion: &Motion) -> (HumanoidMotion, Vec<NoteCode>) {
    let binding = Binding::detect(motion).unwrap_or_else(|e| panic!("{e}"));
    let codes = binding.doubts.iter().map(|note| note.code).collect();
    (to_humanoid(motion, &binding, &Proportions::default()), codes)
}

/// Greatest distance of a joint in every tenth frame, metres.
fn apart(a: &HumanoidMotion, b: &HumanoidMotion) -> f32 {
    let frames = a.poses.iter().zip(&b.poses).step_by(10);
    let joints = frames.flat_map(|(a, b)| {
        let [a, b] = [a, b].map(|pose| world_from_local(&Proportions::default(), pose).positions);
        a.into_iter().zip(b).map(|(a, b)| (a - b).length())
    });
    joints.fold(0.0, f32::max)
}

/// A motion with changed joint offsets and local transforms.
fn changed(motion: &Motion, translate: impl Fn(Vec3) -> Vec3, turn: impl Fn(Quat) -> Quat) -> Motion {
    let joints = motion.skeleton.joints().iter().map(|joint| Joint {
        offset: translate(joint.offset),
        end: joint.end.map(&translate),
        ..joint.clone()
    });
    Motion {
        skeleton: Skeleton::new(joints.collect()).unwrap(),
        frame_time_secs: motion.frame_time_secs,
        translations: motion.translations.iter().map(|t| translate(*t)).collect(),
        rotations: motion.rotations.iter().map(|q| turn(*q)).collect(),
    }
}

/// A motion with a changed root transform.
fn placed(motion: &Motion, translate: impl Fn(Vec3) -> Vec3, turn: Quat) -> Motion {
    let mut placed = motion.clone();
    for frame in 0..motion.frames() {
        let root = frame * motion.skeleton.len();
        placed.translations[root] = translate(motion.translations[root]);
        placed.rotations[root] = turn * motion.rotations[root];
    }
    placed
}

fn check(path: &Path) {
    let name = path.display();
    let motion = bvh::parse(&std::fs::read(path).unwrap()).unwrap().to_motion().unwrap();
    let (clean, codes) = read(&motion);
    assert!(codes.is_empty(), "{name}: {codes:?}");
    let input = ClipInput::new(clean.clone(), 60.0).unwrap();
    assert!(input.notes().is_empty(), "{name}: {:?}", input.notes());

    let metres_per_unit = Binding::detect(&motion).unwrap().metres_per_unit;
    for floor in [-1.0, 0.3, 1.0] {
        let up = Vec3::Y * (floor / metres_per_unit);
        let (moved, codes) = read(&placed(&motion, |t| t + up, Quat::IDENTITY));
        assert!(apart(&moved, &clean) < 0.005, "{name}: floor {floor}: {} m", apart(&moved, &clean));
        assert_eq!(codes, [NoteCode::Floor], "{name}: floor {floor}");
    }
    for (axis, _) in UpAxis::ALL {
        let turn = axis.to_y().inverse();
        let (turned, codes) = read(&changed(&motion, |t| turn * t, |q| turn * q * turn.inverse()));
        assert!(apart(&turned, &clean) < 0.001, "{name}: up {axis}: {} m", apart(&turned, &clean));
        assert_eq!(codes.is_empty(), axis == UpAxis::Y, "{name}: up {axis}: {codes:?}");
    }
    let (mirrored, codes) = read(&changed(&motion, |t| t * Vec3::new(-1.0, 1.0, 1.0), Quat::mirrored));
    assert!(apart(&mirrored, &clean) < 0.001, "{name}: mirrored: {} m", apart(&mirrored, &clean));
    assert_eq!(codes, [NoteCode::Mirrored], "{name}: mirrored");
}

/// A file whose body is at another position, in the file's unit.
fn moved(file: &Bvh, place: [f64; 3]) -> Bvh {
    let mut moved = file.clone();
    let channels = file.channels();
    for (column, channel) in file.joints[0].channels.iter().enumerate() {
        if let Channel::Position(axis) = channel {
            let values = moved.values.iter_mut().skip(column).step_by(channels);
            values.for_each(|value| *value += place[*axis as usize]);
        }
    }
    moved
}

/// A body that is 10 km away is moved near the origin, and written back to its position.
#[test]
fn every_clip_is_the_same_far_from_the_origin() {
    for path in mocap::clips().unwrap_or_default() {
        let name = path.display();
        let (near, notes) = bvh::parse_noted(&std::fs::read(&path).unwrap()).unwrap();
        assert!(notes.is_empty(), "{name}: {notes:?}");
        let motion = near.to_motion().unwrap();
        let (clean, _) = read(&motion);
        let metres_per_unit = f64::from(Binding::detect(&motion).unwrap().metres_per_unit);
        let far = moved(&near, [1e4 / metres_per_unit, 0.0, -5e3 / metres_per_unit]);
        let (far, notes) = bvh::parse_noted(&bvh::write(&far)).unwrap();
        assert_eq!(notes.iter().map(|note| note.code).collect::<Vec<_>>(), [NoteCode::Far], "{name}");
        let brought_near = far.to_motion().unwrap();
        let (mut same, codes) = read(&brought_near);
        assert!(codes.is_empty(), "{name}: {codes:?}");
        let shift = clean.poses[0].root - same.poses[0].root;
        same.poses.iter_mut().for_each(|pose| pose.root += shift);
        assert!(apart(&same, &clean) < 0.001, "{name}: {} m", apart(&same, &clean));
        let written = far.with_motion(&brought_near).unwrap();
        let place = |file: &Bvh, frame: usize| [0, 1, 2].map(|column| file.row(frame)[column]);
        let off =
            |frame| [0, 1, 2].map(|i| (place(&written, frame)[i] - place(&far, frame)[i]).abs() * metres_per_unit);
        let off = (0..far.frames).flat_map(off).fold(0.0, f64::max);
        assert!(off < 1e-5, "{name}: written {off} m off");
    }
}

#[test]
fn every_clip_is_the_same_on_another_floor_with_another_up_axis_and_mirrored() {
    for path in mocap::clips().unwrap_or_default() {
        check(&path);
    }
}

/// Walks over the ground in which only the root is turned, as in exports of body models.
#[test]
fn a_root_that_alone_is_turned_is_turned_back() {
    for path in mocap::clips().unwrap_or_default() {
        let text = path.to_string_lossy();
        if !(text.contains("_walk_") && text.contains("_001") || text.contains("_01_000")) {
            continue;
        }
        let motion = bvh::parse(&std::fs::read(&path).unwrap()).unwrap().to_motion().unwrap();
        let (clean, _) = read(&motion);
        for (axis, _) in UpAxis::ALL {
            let turn = axis.to_y().inverse();
            let (turned, _) = read(&placed(&motion, |t| turn * t, turn));
            assert!(apart(&turned, &clean) < 0.001, "{text}: up {axis}: {} m", apart(&turned, &clean));
        }
    }
}
