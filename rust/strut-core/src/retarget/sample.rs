//! World transforms of a clip at a few frames, on which binding is based.

use crate::math::stats::median;
use crate::math::{Quat, Vec3, exp_map};
use crate::motion::Motion;

/// Greatest number of frames sampled, evenly spread over the clip. Every estimate is a mean that is then snapped, so more
/// frames would only take more time.
const MAX_FRAMES: usize = 64;

/// World transforms of every joint at some frames, in the file's units and axes.
pub(super) struct Sample {
    parents: Vec<Option<usize>>,
    frames: Vec<Vec<(Vec3, Quat)>>,
    /// Position of each joint in its parent's frame: `OFFSET`, or the median of the position channels if these differ.
    pub(super) translations: Vec<Vec3>,
}

impl Sample {
    /// Samples a motion that has at least one frame; an empty one gives an empty sample.
    pub(super) fn of(motion: &Motion) -> Self {
        Self::seen(motion, false)
    }

    /// Samples a motion's mirror image.
    pub(super) fn of_mirror_image(motion: &Motion) -> Self {
        Self::seen(motion, true)
    }

    fn seen(motion: &Motion, mirrored: bool) -> Self {
        let count = motion.frames().min(MAX_FRAMES);
        let indices: Vec<usize> = (0..count).map(|i| i * (motion.frames() - 1) / (count - 1).max(1)).collect();
        let frames = indices.iter().map(|&f| world_transforms(motion, f, mirrored)).collect();
        let translations =
            (0..motion.skeleton.len()).map(|j| usual_translation(motion, &indices, j, mirrored)).collect();
        let parents = motion.skeleton.joints().iter().map(|j| j.parent).collect();
        Self { parents, frames, translations }
    }

    /// Whether the clip had no frames.
    pub(super) fn is_empty(&self) -> bool {
        self.frames.is_empty()
    }

    /// Evaluates `f` in each frame with the joints' world positions and rotations.
    pub(super) fn each<T>(&self, f: impl Fn(&[(Vec3, Quat)]) -> T) -> impl Iterator<Item = T> {
        self.frames.iter().map(move |frame| f(frame))
    }

    /// Mean of a vector over the frames; `f` takes the joints' world positions and rotations.
    pub(super) fn mean(&self, f: impl Fn(&[(Vec3, Quat)]) -> Vec3) -> Vec3 {
        let sum = self.frames.iter().fold(Vec3::ZERO, |sum, frame| sum + f(frame));
        sum / self.frames.len().max(1) as f32
    }

    /// Mean position of `joint` in the frame of `of`.
    pub(super) fn mean_local(&self, of: usize, joint: usize) -> Vec3 {
        if self.parents[joint] == Some(of) {
            // Exact, so that rounding in a clip does not affect the rest pose.
            return self.translations[joint];
        }
        self.mean(|w| w[of].1.inv_mul_vec3(w[joint].0 - w[of].0))
    }

    /// Mean distance between two joints.
    pub(super) fn mean_distance(&self, a: usize, b: usize) -> f32 {
        self.mean(|w| Vec3::splat((w[a].0 - w[b].0).length())).x
    }

    /// Mean of a rotation over the frames.
    pub(super) fn mean_rotation(&self, f: impl Fn(&[(Vec3, Quat)]) -> Quat) -> Quat {
        let rotations: Vec<Quat> = self.frames.iter().map(|frame| f(frame)).collect();
        exp_map::karcher_mean(&rotations)
    }
}

/// A local transform of a file, or of the file mirrored at the plane x = 0.
pub(super) fn local(translation: Vec3, rotation: Quat, mirrored: bool) -> (Vec3, Quat) {
    if mirrored { (translation * Vec3::new(-1.0, 1.0, 1.0), rotation.mirrored()) } else { (translation, rotation) }
}

fn world_transforms(motion: &Motion, frame: usize, mirrored: bool) -> Vec<(Vec3, Quat)> {
    let mut world: Vec<(Vec3, Quat)> = Vec::with_capacity(motion.skeleton.len());
    let locals = motion.translations_at(frame).iter().zip(motion.rotations_at(frame));
    for (joint, (&t, &r)) in motion.skeleton.joints().iter().zip(locals) {
        let (p, q) = joint.parent.map_or((Vec3::ZERO, Quat::IDENTITY), |p| world[p]);
        let (t, r) = local(t, r, mirrored);
        world.push((p + q * t, q * r));
    }
    world
}

/// The offset if the position channels agree with it to 1 %, so that rounding in a clip does not change the binding; their
/// median otherwise.
fn usual_translation(motion: &Motion, frames: &[usize], joint: usize, mirrored: bool) -> Vec3 {
    let of_file = usual_translation_of_file(motion, frames, joint);
    local(of_file, Quat::IDENTITY, mirrored).0
}

fn usual_translation_of_file(motion: &Motion, frames: &[usize], joint: usize) -> Vec3 {
    let offset = motion.skeleton.joints()[joint].offset;
    if frames.is_empty() {
        return offset;
    }
    let along = |axis: usize| frames.iter().map(move |&f| motion.translations_at(f)[joint].to_array()[axis].into());
    let median = Vec3::from_array([0, 1, 2].map(|axis| median(along(axis)).unwrap_or_default() as f32));
    if (median - offset).length() <= 0.01 * offset.length() { offset } else { median }
}
