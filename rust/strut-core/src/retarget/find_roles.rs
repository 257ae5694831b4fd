//! Detection of the roles of a skeleton's joints: by names, and where these fail by the shape of the tree.
//!
//! A body is a tree with two pairs of equal chains: legs at the hips, arms higher up. Names determine the joints of each limb
//! (the best consistent chain over all paths from a leaf to the root). A part without a matching name is found on the other
//! side or by its place between named joints. A limb with almost no matching names is taken from the symmetric pairs of
//! chains. The trunk needs no names: it lies between the parent joints of the legs and of the arms, and the hips are where
//! the paths to the two diverge.

use super::body_tree::BodyTree;
use super::names::{NameHint, Part, Side};
use super::sample::Sample;
use crate::humanoid::{JOINTS, Role};
use crate::math::{Vec3, sort_by_number};
use crate::skeleton::Skeleton;

/// Joint of each role, and the confidence (0 to 1).
pub(super) struct FoundRoles {
    pub(super) joint_of_role: [Option<usize>; JOINTS],
    pub(super) confidence: f32,
}

/// Parts of a limb from the trunk outwards; the middle two and the end are required.
type LimbParts = [Part; 4];
const LEG: LimbParts = [Part::UpperLeg, Part::LowerLeg, Part::Foot, Part::Toes];
const ARM: LimbParts = [Part::Shoulder, Part::UpperArm, Part::LowerArm, Part::Hand];

/// Index of the first of the three required parts of legs and of arms.
const FIRST_REQUIRED: [usize; 2] = [0, 1];

/// Greatest ratio of the bones on both sides of a joint that is found by its place between named ones.
const UNEQUAL_BONES: f32 = 2.5;

/// A joint is at its parent's place if it is nearer than this share of the next bone's length.
const SAME_PLACE: f32 = 0.01;

/// Joints of a limb, in the order of its parts.
type LimbJoints = [Option<usize>; 4];

/// Contribution to the confidence of a role found by name, by the shape of the tree, or not at all.
const BY_NAME: f32 = 1.0;
const BY_TREE: f32 = 0.6;

/// Finds the roles of a skeleton. Roles that are not found are `None`.
pub(super) fn find_roles(skeleton: &Skeleton, sample: &Sample) -> FoundRoles {
    let tree = Tree::of(skeleton, sample);
    let names: Vec<&str> = skeleton.joints().iter().map(|j| j.name.as_str()).collect();
    let hints = NameHint::of_all(&names);
    let named =
        [LEG, ARM].map(|parts| [Side::Left, Side::Right].map(|side| best_named_chain(&tree, &hints, parts, side)));
    let mut limbs = named;
    for (pair, first) in limbs.iter_mut().zip(FIRST_REQUIRED) {
        complete_pair(&tree, &hints, pair, first);
    }
    let mut incomplete =
        limbs.iter().zip(FIRST_REQUIRED).map(|(pair, first)| pair.iter().any(|l| !is_complete(l, first)));
    if incomplete.any(|i| i)
        && let Some((mut tree_legs, mut tree_arms)) = limbs_by_shape(&tree, sample)
    {
        if sides_exchanged(&hints, &[tree_legs, tree_arms]) {
            tree_legs.swap(0, 1);
            tree_arms.swap(0, 1);
        }
        for ((pair, by_shape), first) in limbs.iter_mut().zip([tree_legs, tree_arms]).zip(FIRST_REQUIRED) {
            take_unnamed(pair, by_shape, first);
        }
    }
    let confidence = [0, 1].map(|kind| {
        let share = share_by_name(&named[kind], &limbs[kind], FIRST_REQUIRED[kind]);
        BY_TREE + (BY_NAME - BY_TREE) * share
    });
    let [legs, arms] = limbs;

    let mut joint_of_role = [None; JOINTS];
    for (side, i) in [(Side::Left, 0), (Side::Right, 1)] {
        for (parts, joints) in [(LEG, legs[i]), (ARM, arms[i])] {
            for (part, joint) in parts.iter().zip(joints) {
                joint_of_role[part.on(side).index()] = joint;
            }
        }
    }
    find_trunk(&tree, sample, &hints, &mut joint_of_role);

    let found = joint_of_role.iter().flatten().count() as f32 / JOINTS as f32;
    let confidence = found * 0.5 * (confidence[0] + confidence[1]);
    FoundRoles { joint_of_role, confidence }
}

/// The hierarchy with precomputed quantities for the searches.
struct Tree {
    parents: Vec<Option<usize>>,
    /// Joints in an order with parents first.
    order: Vec<usize>,
    children: Vec<Vec<usize>>,
    /// Distance between the positions where each bone and its parent's bone begin, file units.
    lengths: Vec<f32>,
}

impl Tree {
    fn of(skeleton: &Skeleton, sample: &Sample) -> Self {
        let file = BodyTree::of_file(skeleton.joints().iter().map(|j| j.parent).collect());
        Self::with_lengths(file, sample.translations.iter().map(|t| t.length()).collect())
    }

    /// The same bones with another root.
    fn rooted_at(&self, root: usize, sample: &Sample) -> Self {
        let body = BodyTree::of_file(self.parents.clone()).rooted_at(root);
        let begins = |joint: usize| body.begins[joint];
        let length = |joint: usize| {
            body.parents[joint].map_or(0.0, |parent| sample.mean_distance(begins(parent), begins(joint)))
        };
        let lengths = (0..self.parents.len()).map(length).collect();
        Self::with_lengths(body, lengths)
    }

    fn with_lengths(BodyTree { parents, order, .. }: BodyTree, lengths: Vec<f32>) -> Self {
        Self { children: children_of(&parents), parents, order, lengths }
    }

    /// Path from the root to this joint, both included.
    fn path_to(&self, joint: usize) -> Vec<usize> {
        let mut path: Vec<usize> = std::iter::successors(Some(joint), |&j| self.parents[j]).collect();
        path.reverse();
        path
    }

    fn lowest_common_ancestor(&self, a: usize, b: usize) -> usize {
        let (a, b) = (self.path_to(a), self.path_to(b));
        a.iter().zip(&b).take_while(|(x, y)| x == y).last().map_or(0, |(x, _)| *x)
    }

    fn depth(&self, joint: usize) -> usize {
        self.path_to(joint).len()
    }

    fn is_ancestor(&self, ancestor: usize, joint: usize) -> bool {
        self.path_to(joint).contains(&ancestor)
    }

    /// Joints strictly between an ancestor and a joint, outwards.
    fn between(&self, ancestor: usize, joint: usize) -> Vec<usize> {
        let path = self.path_to(joint);
        path.iter().skip_while(|&&j| j != ancestor).skip(1).copied().filter(|&j| j != joint).collect()
    }

    /// Distance along the bones from an ancestor to a joint.
    fn distance(&self, ancestor: usize, joint: usize) -> f32 {
        std::iter::successors(Some(joint), |&j| self.parents[j])
            .take_while(|&j| j != ancestor)
            .map(|j| self.lengths[j])
            .sum()
    }

    /// The longest chain of bones from `joint` outwards, `joint` first.
    fn longest_chain(&self, joint: usize) -> Vec<usize> {
        // Children come after their parents, so one backward pass computes the reach of every subtree.
        let mut reach = vec![0.0_f32; self.parents.len()];
        let mut next = vec![None; self.parents.len()];
        for &j in self.order.iter().rev() {
            for &c in &self.children[j] {
                let length = self.lengths[c] + reach[c];
                if next[j].is_none() || length > reach[j] {
                    (reach[j], next[j]) = (length, Some(c));
                }
            }
            if j == joint {
                break;
            }
        }
        std::iter::successors(Some(joint), |&j| next[j]).collect()
    }
}

fn children_of(parents: &[Option<usize>]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); parents.len()];
    for (joint, parent) in parents.iter().enumerate() {
        if let Some(p) = parent {
            children[*p].push(joint);
        }
    }
    children
}

/// The joints of one path from root to leaf whose names match the limb best: parts in order, optional ones possibly missing.
/// A required part counts more than any difference of words.
fn best_named_chain(tree: &Tree, hints: &[NameHint], parts: LimbParts, side: Side) -> LimbJoints {
    let required = |i: usize| if parts[0] == Part::UpperLeg { i < 3 } else { i > 0 };
    let score = |joint: usize, i: usize| {
        let weight = if hints[joint].side == Some(side) { hints[joint].weight(parts[i]) } else { 0.0 };
        if weight > 0.0 && required(i) { weight + 1.0 } else { weight }
    };
    // If a joint is at its parent's place and its child has as good a name, the child moves the bone.
    let doubles_its_parent = |chosen: Option<usize>, joint: usize| {
        chosen.is_some_and(|j| tree.parents[joint] == Some(j) && tree.lengths[j] <= SAME_PLACE * tree.lengths[joint])
    };
    // best[j][n]: score of the best choice of the first n parts on the path to j, and the last part's joint.
    let mut best: Vec<[(f32, LimbJoints); 5]> = Vec::with_capacity(hints.len());
    let mut winner = (0.0, [None; 4]);
    for joint in 0..hints.len() {
        let above = tree.parents[joint].map_or([(0.0, [None; 4]); 5], |p| best[p]);
        let mut here = above;
        for n in 1..=4 {
            // Part n−1 is absent, at an ancestor, or at this joint.
            if here[n - 1].0 > here[n].0 {
                here[n] = here[n - 1];
            }
            let own = score(joint, n - 1);
            let (total, before) = (above[n - 1].0 + own, here[n].0);
            if own > 0.0 && (total > before || total >= before && doubles_its_parent(here[n].1[n - 1], joint)) {
                here[n] = above[n - 1];
                here[n].0 += own;
                here[n].1[n - 1] = Some(joint);
            }
        }
        if here[4].0 > winner.0 {
            winner = here[4];
        }
        best.push(here);
    }
    winner.1
}

/// Whether a limb has its three required parts.
fn is_complete(limb: &LimbJoints, first: usize) -> bool {
    limb[first..first + 3].iter().all(Option::is_some)
}

/// Fills the parts of a pair of limbs that names do not give: from the other side if that is complete, else by the place
/// between named joints.
fn complete_pair(tree: &Tree, hints: &[NameHint], pair: &mut [LimbJoints; 2], first: usize) {
    for side in [0, 1] {
        if is_complete(&pair[1 - side], first)
            && !is_complete(&pair[side], first)
            && let Some(limb) = mirrored(tree, hints, &pair[1 - side], &pair[side])
        {
            pair[side] = limb;
        }
        // A `Shoulder` that was matched as the upper arm is a collarbone if the other side has one.
        let [collarbone, upper, lower, end] = pair[side];
        if collarbone.is_none()
            && pair[1 - side].iter().all(Option::is_some)
            && let Some(limb) = mirrored(tree, hints, &pair[1 - side], &[None, None, lower, end])
            && limb[0] == upper
        {
            pair[side] = limb;
        }
    }
    for side in [0, 1] {
        let other = pair[1 - side].iter().flatten().next().copied();
        fill_gap(tree, hints, &mut pair[side], first, other);
    }
}

/// Completes a limb by the other side: with the joints at the same places of an equal chain. `None` if there is no such
/// chain, or the named joints are not on it.
fn mirrored(tree: &Tree, hints: &[NameHint], complete: &LimbJoints, partial: &LimbJoints) -> Option<LimbJoints> {
    symmetric_pairs(tree)
        .iter()
        .flat_map(|pair| [(0, 1), (1, 0)].map(|(a, b)| (&pair.chains[a], &pair.chains[b])))
        .find_map(|(chain, opposite)| {
            let mut limb = *partial;
            for (slot, joint) in limb.iter_mut().zip(complete) {
                let Some(joint) = joint else { continue };
                let twin = opposite.get(chain.iter().position(|j| j == joint)?).copied()?;
                *slot = slot.or(Some(twin).filter(|&t| !hints[t].is_other));
            }
            let joints: Vec<usize> = limb.iter().flatten().copied().collect();
            joints.windows(2).all(|w| w[0] != w[1] && tree.is_ancestor(w[0], w[1])).then_some(limb)
        })
}

/// Fills the one missing required part of a limb such that the two bones are about equal. `other` is a joint of the opposite
/// limb.
fn fill_gap(tree: &Tree, hints: &[NameHint], limb: &mut LimbJoints, first: usize, other: Option<usize>) {
    let nearest = |candidates: Vec<usize>, bones: &dyn Fn(usize) -> (f32, f32)| {
        let unequal = |j: usize| {
            let (a, b) = bones(j);
            a.max(b) / a.min(b)
        };
        let near = candidates.into_iter().filter(|&j| !hints[j].is_other && unequal(j) < UNEQUAL_BONES);
        near.min_by(|&a, &b| unequal(a).total_cmp(&unequal(b)))
    };
    let missing = match [limb[first], limb[first + 1], limb[first + 2]] {
        [Some(upper), None, Some(end)] => {
            let bones = |j| (tree.distance(upper, j), tree.distance(j, end));
            nearest(tree.between(upper, end), &bones).map(|j| (1, j))
        }
        [None, Some(lower), Some(end)] => {
            let above = if first == 0 { None } else { limb[0] };
            let Some(top) = above.or_else(|| other.map(|o| tree.lowest_common_ancestor(o, lower))) else { return };
            let bones = |j| (tree.distance(j, lower), tree.distance(lower, end));
            nearest(tree.between(top, lower), &bones).map(|j| (0, j))
        }
        [Some(upper), Some(lower), None] => {
            let bones = |j| (tree.distance(upper, lower), tree.distance(lower, j));
            let chain = tree.longest_chain(lower);
            nearest(chain.get(1..).unwrap_or_default().to_vec(), &bones).map(|j| (2, j))
        }
        _ => None,
    };
    if let Some((part, joint)) = missing {
        limb[first + part] = Some(joint);
    }
}

/// Takes limbs from the shape of the tree if names give less than two of their three parts.
fn take_unnamed(pair: &mut [LimbJoints; 2], by_shape: [LimbJoints; 2], first: usize) {
    let plain = pair.map(|limb| limb[first..first + 3].iter().flatten().count() >= 2);
    if !plain[0] && !plain[1] {
        *pair = by_shape;
        return;
    }
    for side in [0, 1] {
        let free = by_shape[side].iter().flatten().all(|joint| !pair[1 - side].contains(&Some(*joint)));
        if !plain[side] && free {
            pair[side] = by_shape[side];
        }
    }
}

/// Whether most limb joints (left, right) are named as the other side: a four-legged animal's arms are in front of its legs,
/// not above them, which exchanges the sides by shape.
fn sides_exchanged(hints: &[NameHint], pairs: &[[LimbJoints; 2]; 2]) -> bool {
    let named = |limbs: usize, side: Side| {
        let joints = pairs.iter().flat_map(|pair| pair[limbs].iter().flatten());
        joints.filter(|&&joint| hints[joint].side == Some(side)).count()
    };
    named(0, Side::Right) + named(1, Side::Left) > named(0, Side::Left) + named(1, Side::Right)
}

/// Share of the required parts of a pair of limbs that were found by name.
fn share_by_name(named: &[LimbJoints; 2], found: &[LimbJoints; 2], first: usize) -> f32 {
    let required = |limbs: &[LimbJoints; 2]| limbs.map(|limb| [limb[first], limb[first + 1], limb[first + 2]]);
    let (named, found) = (required(named), required(found));
    let same = named.iter().flatten().zip(found.iter().flatten()).filter(|(a, b)| a.is_some() && a == b);
    same.count() as f32 / 6.0
}

/// Two chains of equal bones below the same joint.
struct Pair {
    joint: usize,
    chains: [Vec<usize>; 2],
    length: f32,
}

/// Legs and arms (left, right) of a skeleton, by shape only.
fn limbs_by_shape(tree: &Tree, sample: &Sample) -> Option<([LimbJoints; 2], [LimbJoints; 2])> {
    let mut pairs = symmetric_pairs(tree);
    let longest = pairs.iter().map(|p| p.length).fold(0.0, f32::max);
    // Fingers, toes and ears come in pairs, too.
    pairs.retain(|p| p.length > 0.4 * longest);
    // Sorted by depth, with the longest first at equal depth.
    sort_by_number(&mut pairs, |p| -p.length);
    sort_by_number(&mut pairs, |p| tree.depth(p.joint) as f32);
    let nearest = pairs.first()?;
    let farther = pairs
        .iter()
        .filter(|p| p.joint != nearest.joint && tree.is_ancestor(nearest.joint, p.joint))
        .max_by(|a, b| a.length.total_cmp(&b.length))?;
    // A file with its root at the chest ends in a pelvis, from which only the longer limbs and single joints branch.
    let branches = |joint: usize| tree.children[joint].iter().filter(|&&c| !tree.children[c].is_empty()).count();
    let from_the_chest =
        branches(farther.joint) == 2 && branches(nearest.joint) > 3 && farther.length > 1.1 * nearest.length;
    let (legs, arms) = if from_the_chest { (farther, nearest) } else { (nearest, farther) };
    let mut leg_joints = [limb_joints(tree, &legs.chains[0], 0)?, limb_joints(tree, &legs.chains[1], 0)?];
    let mut arm_joints = [limb_joints(tree, &arms.chains[0], 1)?, limb_joints(tree, &arms.chains[1], 1)?];
    if leftness(sample, arms.joint, &leg_joints)? < 0.0 {
        leg_joints.swap(0, 1);
    }
    let (hips, shoulders) = ([leg_joints[0][0]?, leg_joints[1][0]?], [arm_joints[0][1]?, arm_joints[1][1]?]);
    let agreement = sample.mean(|w| {
        let (a, b) = (w[hips[0]].0 - w[hips[1]].0, w[shoulders[0]].0 - w[shoulders[1]].0);
        Vec3::splat(a.dot(b))
    });
    if agreement.x < 0.0 {
        arm_joints.swap(0, 1);
    }
    Some((leg_joints, arm_joints))
}

fn symmetric_pairs(tree: &Tree) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for joint in 0..tree.parents.len() {
        let chains: Vec<Vec<usize>> = tree.children[joint].iter().map(|&c| tree.longest_chain(c)).collect();
        for (i, a) in chains.iter().enumerate() {
            for b in &chains[i + 1..] {
                let same = a.len().min(b.len()) >= 3
                    && a.iter().zip(b).take(4).all(|(&x, &y)| {
                        (tree.lengths[x] - tree.lengths[y]).abs() <= 0.1 * tree.lengths[x].max(tree.lengths[y]) + 1e-4
                    });
                if same {
                    let length = a[1..].iter().map(|&j| tree.lengths[j]).sum();
                    pairs.push(Pair { joint, chains: [a.clone(), b.clone()], length });
                }
            }
        }
    }
    pairs
}

/// The joints of a limb on its chain: the two longest successive bones are thigh and shin, or upper arm and forearm. `first`
/// is the part of the upper joint; a joint before it is the clavicle.
fn limb_joints(tree: &Tree, chain: &[usize], first: usize) -> Option<LimbJoints> {
    let total: f32 = chain[1..].iter().map(|&j| tree.lengths[j]).sum();
    // Of several joints at the same place, the last one moves the bone.
    let distinct: Vec<usize> = chain
        .iter()
        .enumerate()
        .filter(|&(i, _)| chain.get(i + 1).is_none_or(|&next| tree.lengths[next] > 0.01 * total))
        .map(|(_, &j)| j)
        .collect();
    let two_bones = |i: usize| tree.distance(distinct[i], distinct[i + 2]);
    let starts = 0..distinct.len().checked_sub(2)?;
    let longest = starts.clone().map(two_bones).fold(0.0, f32::max);
    // Clavicle and upper arm may be as long as upper arm and forearm: the outer pair is chosen.
    let start = starts.rev().find(|&i| two_bones(i) >= 0.8 * longest)?;
    let mut joints = [None; 4];
    for (part, slot) in joints.iter_mut().enumerate() {
        *slot = (start + part).checked_sub(first).and_then(|i| distinct.get(i)).copied();
    }
    Some(joints)
}

/// Positive if the first leg is the left one: toes, or else knees, give the forward direction.
fn leftness(sample: &Sample, above: usize, legs: &[LimbJoints; 2]) -> Option<f32> {
    let hips = [legs[0][0]?, legs[1][0]?];
    let knees = [legs[0][1]?, legs[1][1]?];
    let ankles = [legs[0][2]?, legs[1][2]?];
    let toes = legs[0][3].zip(legs[1][3]);
    let mean = sample.mean(|w| {
        let up = w[above].0 - 0.5 * (w[hips[0]].0 + w[hips[1]].0);
        let across = w[hips[0]].0 - w[hips[1]].0;
        let forward = match toes {
            Some((a, b)) => w[a].0 - w[ankles[0]].0 + w[b].0 - w[ankles[1]].0,
            None => (0..2).map(|i| 2.0 * w[knees[i]].0 - w[hips[i]].0 - w[ankles[i]].0).sum(),
        };
        Vec3::splat(across.cross(up).dot(forward))
    });
    Some(mean.x)
}

/// Fills hips, spine, chest, neck and head from the limbs.
fn find_trunk(tree: &Tree, sample: &Sample, hints: &[NameHint], roles: &mut [Option<usize>; JOINTS]) {
    let at = |r: Role| roles[r.index()];
    let (Some(left_leg), Some(right_leg)) = (at(Role::LeftUpperLeg), at(Role::RightUpperLeg)) else { return };
    let (Some(left_arm), Some(right_arm)) = (at(Role::LeftUpperArm), at(Role::RightUpperArm)) else { return };
    let bearer = tree.lowest_common_ancestor(left_arm, right_arm);
    let pelvis = tree.lowest_common_ancestor(left_leg, right_leg);
    // The hips are the joint where the paths to the legs and to the arms diverge. A separate pelvis below it has no role,
    // unless the root of the skeleton is in the trunk: at the chest, the head or the spine.
    let parting = tree.lowest_common_ancestor(pelvis, bearer);
    let named_hips = tree.path_to(pelvis).into_iter().rev().take_while(|&j| j != parting);
    let named_hips = named_hips.filter(|&j| hints[j].weight(Part::Hips) > 0.0).last();
    let rerooted = match named_hips {
        _ if parting == bearer && parting != pelvis => Some(pelvis),
        Some(hips) if hints[parting].weight(Part::Trunk) > 0.0 => Some(hips),
        _ => None,
    };
    if let Some(hips) = rerooted {
        let tree = tree.rooted_at(hips, sample);
        let bearer = tree.lowest_common_ancestor(left_arm, right_arm);
        // The hips end where the spine begins: the spine joint is no duplicate of the hips.
        let spine = tree.between(hips, bearer).first().copied();
        return find_trunk_on(&tree, hints, roles, hips, spine, [left_arm, right_arm]);
    }
    let mut hips = parting;
    // Biped attaches the thighs to the spine.
    if hints[hips].weight(Part::Trunk) > 0.0
        && let Some(parent) = tree.parents[hips]
        && hints[parent].weight(Part::Hips) > 0.0
    {
        hips = parent;
    }
    find_trunk_on(tree, hints, roles, hips, None, [left_arm, right_arm]);
}

/// Fills hips, spine, chest, neck and head of a tree with its root at the hips.
fn find_trunk_on(
    tree: &Tree,
    hints: &[NameHint],
    roles: &mut [Option<usize>; JOINTS],
    hips: usize,
    spine: Option<usize>,
    [left_arm, right_arm]: [usize; 2],
) {
    let bearer = tree.lowest_common_ancestor(left_arm, right_arm);
    if bearer == hips || !tree.is_ancestor(hips, bearer) {
        roles[Role::Hips.index()] = Some(hips);
        return;
    }
    // Biped attaches the clavicles to the neck.
    let parent = tree.parents[bearer].filter(|&p| p != hips);
    let chest = if hints[bearer].weight(Part::Neck) > 0.0 { parent.unwrap_or(bearer) } else { bearer };
    let head = find_head(tree, hints, bearer, [left_arm, right_arm]);
    // A joint at its ancestor's place is only a duplicate (CMU's `LowerBack` and `Neck`).
    let first_apart = |from: usize, between: &[usize]| {
        let apart = between.iter().copied().find(|&j| tree.distance(from, j) > 0.01 * tree.distance(hips, chest));
        apart.or(between.last().copied())
    };
    let spine = spine.filter(|&s| s != chest).or_else(|| first_apart(hips, &tree.between(hips, chest)));
    roles[Role::Hips.index()] = Some(hips);
    roles[Role::Spine.index()] = spine.or(Some(chest));
    roles[Role::Chest.index()] = spine.map(|_| chest);
    roles[Role::Head.index()] = head;
    roles[Role::Neck.index()] = head.and_then(|h| first_apart(chest, &tree.between(chest, h)));
}

/// The head: the joint of that name, else the last joint of the longest chain above the arms before it branches into a face.
fn find_head(tree: &Tree, hints: &[NameHint], bearer: usize, arms: [usize; 2]) -> Option<usize> {
    let named = (0..hints.len())
        .filter(|&j| j != bearer && hints[j].weight(Part::Head) > 0.0 && tree.is_ancestor(bearer, j))
        .max_by(|&a, &b| hints[a].weight(Part::Head).total_cmp(&hints[b].weight(Part::Head)).then(b.cmp(&a)));
    if named.is_some() {
        return named;
    }
    let free = tree.children[bearer].iter().filter(|&&c| !arms.iter().any(|&a| tree.is_ancestor(c, a)));
    let chains = free.map(|&c| tree.longest_chain(c));
    let length = |chain: &Vec<usize>| chain.iter().map(|&j| tree.lengths[j]).sum::<f32>();
    let chain = chains.max_by(|a, b| length(a).total_cmp(&length(b)))?;
    chain.iter().copied().find(|&j| tree.children[j].len() != 1)
}

#[cfg(test)]
mod tests;
