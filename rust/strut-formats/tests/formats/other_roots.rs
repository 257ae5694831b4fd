//! A body is read as the same body if its file starts at the chest, the head or the spine.

use crate::mocap;
use crate::performances::apart;
use strut_core::humanoid::{HumanoidMotion, Proportions, Role};
use strut_core::math::{Quat, Vec3};
use strut_core::motion::Motion;
use strut_core::retarget::{Binding, from_humanoid, to_humanoid};
use strut_core::skeleton::{Joint, Skeleton};
use strut_formats::bvh;

/// Greatest distance of a joint from its position in the clean file, metres.
const NEAR: f32 = 1e-3;

fn performed(motion: &Motion, binding: &Binding) -> HumanoidMotion {
    to_humanoid(motion, binding, &Proportions::default())
}

/// World positions and rotations of the joints in a frame.
fn world(motion: &Motion, frame: usize) -> Vec<(Vec3, Quat)> {
    let mut world: Vec<(Vec3, Quat)> = Vec::new();
    let locals = motion.translations_at(frame).iter().zip(motion.rotations_at(frame));
    for (joint, (&t, &r)) in motion.skeleton.joints().iter().zip(locals) {
        let (place, turn) = joint.parent.map_or((Vec3::ZERO, Quat::IDENTITY), |p| world[p]);
        world.push((place + turn * t, turn * r));
    }
    world
}

/// The same motion with another root. Each joint on the path between the roots is attached to its former child.
fn rooted_at(motion: &Motion, root: usize) -> Motion {
    let old = motion.skeleton.joints();
    let way: Vec<usize> = std::iter::successors(Some(root), |&j| old[j].parent).collect();
    let on_way = |joint: usize| way.iter().position(|&j| j == joint);
    // Joints in their new order with their new parents, parents first.
    let mut order: Vec<(usize, Option<usize>)> = vec![(root, None)];
    order.extend(way.windows(2).map(|pair| (pair[1], Some(pair[0]))));
    order.extend((0..old.len()).filter(|&j| on_way(j).is_none()).map(|j| (j, old[j].parent)));
    let place = |joint: usize| order.iter().position(|&(j, _)| j == joint).unwrap();

    // Position of a joint in the frame of its new parent, given the old translations.
    let hangs = |joint: usize, t: &[Vec3]| match (on_way(joint), old[joint].parent.and_then(on_way)) {
        (Some(0), _) => Vec3::ZERO,
        (Some(i), _) => {
            if i == 1 {
                Vec3::ZERO
            } else {
                -t[way[i - 2]]
            }
        }
        (None, Some(i)) if i > 0 => t[joint] - t[way[i - 1]],
        (None, _) => t[joint],
    };
    let offsets: Vec<Vec3> = old.iter().map(|joint| joint.offset).collect();
    let joints = order.iter().map(|&(j, parent)| Joint {
        name: old[j].name.clone(),
        parent: parent.map(place),
        offset: hangs(j, &offsets),
        end: old[j].end,
    });
    let (mut translations, mut rotations) = (Vec::new(), Vec::new());
    for f in 0..motion.frames() {
        let (t, r, world) = (motion.translations_at(f), motion.rotations_at(f), world(motion, f));
        for &(j, _) in &order {
            translations.push(if j == root { world[root].0 } else { hangs(j, t) });
            rotations.push(match on_way(j) {
                Some(0) => world[root].1,
                Some(i) => r[way[i - 1]].inverse(),
                None => r[j],
            });
        }
    }
    let skeleton = Skeleton::new(joints.collect()).unwrap();
    Motion::new(skeleton, motion.frame_time_secs, translations, rotations).unwrap()
}

#[test]
fn a_clip_that_begins_elsewhere_in_the_trunk_is_the_same_and_is_written_back() {
    let Some(clips) = mocap::clips() else { return };
    for path in clips.iter().step_by(29) {
        let motion = bvh::parse(&std::fs::read(path).unwrap()).unwrap().to_motion().unwrap();
        let binding = Binding::detect(&motion).unwrap();
        let clean = performed(&motion, &binding);
        let every_frame: Vec<f64> = (0..motion.frames()).map(|f| f as f64).collect();
        let written = from_humanoid(&clean, &motion, &binding, &every_frame);
        let written = apart(&performed(&written, &binding), &clean);
        for role in [Role::Spine, Role::Chest, Role::Neck, Role::Head] {
            let Some(root) = binding.joint_of_role[role.index()] else { continue };
            let name = format!("{} from the {}", path.display(), role.name());
            let other = rooted_at(&motion, root);
            let read = Binding::detect(&other).unwrap_or_else(|e| panic!("{name}: {e}"));
            let same = performed(&other, &read);
            // The spine of CMU's body has two joints at the hips, which a file with another root does not show.
            let doubled = if name.contains("xia") { 0.01 } else { NEAR };
            let distance = apart(&same, &clean);
            assert!(distance < doubled, "{name}: {distance} m");
            let back = from_humanoid(&same, &other, &read, &every_frame);
            let off = apart(&performed(&back, &read), &same);
            assert!(off < written + NEAR, "{name}: written {off} m off, the clip itself {written}");
        }
    }
}

#[test]
fn the_chest_is_found_as_the_root_without_names() {
    let Some(clips) = mocap::clips() else { return };
    for path in clips.iter().step_by(61) {
        let motion = bvh::parse(&std::fs::read(path).unwrap()).unwrap().to_motion().unwrap();
        let chest = Binding::detect(&motion).unwrap().joint_of_role[Role::Chest.index()].unwrap();
        let other = rooted_at(&motion, chest);
        let named = Binding::detect(&other).unwrap();
        let joints = other.skeleton.joints().iter().enumerate();
        let nameless = joints.map(|(j, joint)| Joint { name: format!("n{j}"), ..joint.clone() }).collect();
        let nameless = Motion { skeleton: Skeleton::new(nameless).unwrap(), ..other };
        let read = Binding::detect(&nameless).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        for role in [Role::Hips, Role::LeftLowerLeg, Role::RightFoot, Role::LeftLowerArm, Role::RightUpperArm] {
            let [a, b] = [&named, &read].map(|binding| binding.joint_of_role[role.index()]);
            assert_eq!(a, b, "{}: {}", path.display(), role.name());
        }
    }
}
