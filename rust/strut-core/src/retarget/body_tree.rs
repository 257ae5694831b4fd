//! The tree of a body: its joints as descendants of the hips.
//!
//! It equals the file's tree unless the file's root is elsewhere, at the chest, the head or a tracker. World transforms and
//! the output always follow the file's tree; the parents of roles, and the order in which rest rotations are computed, follow
//! the body's.

use crate::humanoid::{JOINTS, Role};
use crate::skeleton::Skeleton;

/// A hierarchy of joints below the hips.
pub(super) struct BodyTree {
    /// Parent of each joint.
    pub(super) parents: Vec<Option<usize>>,
    /// Joints in an order with parents first.
    pub(super) order: Vec<usize>,
    /// The joint at whose position the bone of each joint begins. A bone begins at its own joint, except on the path between
    /// the file's root and the hips: with the root at the chest, the spine's bone ends at the spine joint and begins at the
    /// hips' joint.
    pub(super) begins: Vec<usize>,
}

impl BodyTree {
    /// The tree of a skeleton with these roles.
    pub(super) fn of_skeleton(skeleton: &Skeleton, roles: &[Option<usize>; JOINTS]) -> Self {
        Self::of(skeleton.joints().iter().map(|joint| joint.parent).collect(), roles)
    }

    /// The tree of a file's parents, in an order with parents first, with these roles.
    pub(super) fn of(file_parents: Vec<Option<usize>>, roles: &[Option<usize>; JOINTS]) -> Self {
        let file = Self::of_file(file_parents);
        let joints = file.parents.len();
        let known = |joint: usize| Some(joint).filter(|&j| j < joints);
        let Some(hips) = roles[Role::Hips.index()].and_then(known) else { return file };
        let hangs_on_hips = |joint: usize| file.way_up(joint).any(|j| j == hips);
        if roles.iter().flatten().copied().filter_map(known).all(hangs_on_hips) { file } else { file.rooted_at(hips) }
    }

    /// The tree of the file itself.
    pub(super) fn of_file(parents: Vec<Option<usize>>) -> Self {
        let all = 0..parents.len();
        Self { parents, order: all.clone().collect(), begins: all.collect() }
    }

    /// The same bones with another root.
    pub(super) fn rooted_at(&self, root: usize) -> Self {
        let (mut parents, mut begins) = (self.parents.clone(), self.begins.clone());
        let way: Vec<usize> = self.way_up(root).collect();
        for pair in way.windows(2) {
            parents[pair[1]] = Some(pair[0]);
            begins[pair[1]] = pair[0];
        }
        parents[root] = None;
        // The path from the new root to the old one, then everything else in its former order.
        let rest = self.order.iter().copied().filter(|joint| !way.contains(joint));
        let order = way.iter().copied().chain(rest).collect();
        Self { parents, order, begins }
    }

    /// From a joint up to the root, both included.
    fn way_up(&self, joint: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(joint), |&j| self.parents[j])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chest with head and spine, which ends in the hips with two legs.
    fn from_the_chest() -> Vec<Option<usize>> {
        vec![None, Some(0), Some(0), Some(2), Some(3), Some(3)]
    }

    #[test]
    fn the_way_to_the_former_root_is_turned_round() {
        let mut roles = [None; JOINTS];
        roles[Role::Hips.index()] = Some(3);
        roles[Role::Head.index()] = Some(1);
        let body = BodyTree::of(from_the_chest(), &roles);
        assert_eq!(body.parents, [Some(2), Some(0), Some(3), None, Some(3), Some(3)]);
        assert_eq!(body.order, [3, 2, 0, 1, 4, 5]);
        assert_eq!(body.begins, [2, 1, 3, 3, 4, 5]);
    }

    #[test]
    fn a_file_that_hangs_on_the_hips_stays_as_it_is() {
        let mut roles = [None; JOINTS];
        roles[Role::Hips.index()] = Some(3);
        roles[Role::LeftUpperLeg.index()] = Some(4);
        let body = BodyTree::of(from_the_chest(), &roles);
        assert_eq!(body.parents, from_the_chest());
        assert_eq!(body.order, [0, 1, 2, 3, 4, 5]);
        assert_eq!(body.begins, body.order);
    }
}
