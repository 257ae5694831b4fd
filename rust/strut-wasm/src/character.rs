//! Handle of a character: its joint mapping, and the conversion of poses to rotations of its bones.

use crate::common::{EngineError, floats_of, offsets_of, skeleton_of, write_floats};
use js_sys::Float32Array;
use strut_core::humanoid::{JOINTS, POSE_FLOATS, Pose, Proportions, Role};
use strut_core::math::{Quat, Vec3};
use strut_core::retarget::{Binding, CharacterFacts, FromHumanoid, SolePoint, ToHumanoid, loose_feet};
use strut_core::skeleton::{Joint, Skeleton};
use wasm_bindgen::prelude::wasm_bindgen;

/// A bound character. Joints are specified in the bind pose, in which the character was modelled.
#[wasm_bindgen]
pub struct Character {
    skeleton: Skeleton,
    facts: CharacterFacts,
    binding: Binding,
    sole_points: Vec<SolePoint>,
    body: Proportions,
    retarget: FromHumanoid,
    /// Conversion from the character's joints to its own body.
    observe: ToHumanoid,
    /// Local transforms of the file's rest pose, in frames that are aligned with the world in the bind pose.
    rest: Vec<(Vec3, Quat)>,
    /// World rotations of each joint and of its parent in the bind pose.
    bind: Vec<(Quat, Quat)>,
    hips: usize,
    translations: Vec<Vec3>,
    rotations: Vec<Quat>,
    out: Vec<f32>,
}

#[wasm_bindgen]
impl Character {
    /// Binds a skeleton.
    ///
    /// `parents`: index of each joint's parent, which precedes it; −1 for joint 0. `offsets`: from the parent to the
    /// joint in the bind pose, along the world axes, xyz. `bind`: world rotation of each joint in the bind pose, xyzw.
    /// `local`: local rotation of each joint at rest, xyzw, which joints without a role keep. `roles`: joint of each of
    /// the 21 roles, −1 if not given.
    ///
    /// # Errors
    /// If the numbers are no valid skeleton, or the skeleton cannot be bound.
    #[wasm_bindgen(constructor)]
    pub fn new(
        names: Vec<String>,
        parents: &[i32],
        offsets: &[f32],
        bind: &[f32],
        local: &[f32],
        roles: &[i32],
        metres_per_unit: f32,
    ) -> Result<Self, EngineError> {
        let skeleton = skeleton_of(names, parents, offsets)?;
        let facts = CharacterFacts { metres_per_unit, sole_height: None, roles: roles_of(roles, skeleton.len())? };
        if !(metres_per_unit.is_finite() && metres_per_unit > 0.0) {
            return Err(EngineError::bad_input("a unit must be a positive number of metres"));
        }
        let bind = rotations_of(bind, skeleton.len())?;
        let local = rotations_of(local, skeleton.len())?;
        let binding = Binding::of_character(&skeleton, &facts).map_err(|e| EngineError::bad_file(e, ""))?;
        let parent = |j: &Joint| j.parent.map_or(Quat::IDENTITY, |p| bind[p]);
        let bind: Vec<(Quat, Quat)> = skeleton.joints().iter().zip(&bind).map(|(j, b)| (*b, parent(j))).collect();
        let rest: Vec<(Vec3, Quat)> = (skeleton.joints().iter().zip(&bind).zip(&local))
            .map(|((joint, (own, above)), local)| (joint.offset, (*above * *local * own.inverse()).normalized()))
            .collect();
        let body = Proportions::default();
        Ok(Self {
            retarget: FromHumanoid::for_character(&binding, &body, &[]),
            observe: ToHumanoid::new(&binding, &binding.proportions),
            sole_points: Vec::new(),
            hips: binding.joint_of_role[Role::Hips.index()].unwrap_or(0),
            body,
            translations: vec![Vec3::ZERO; rest.len()],
            rotations: vec![Quat::IDENTITY; rest.len()],
            out: vec![0.0; 3 + 4 * rest.len()],
            skeleton,
            facts,
            binding,
            rest,
            bind,
        })
    }

    /// Returns the joint of each of the 21 roles where it can be found, −1 for the others. It is the suggestion for the
    /// user when binding fails. The arguments are those of the constructor.
    ///
    /// # Errors
    /// If the numbers are no valid skeleton.
    #[wasm_bindgen(js_name = likelyRoles)]
    pub fn likely_roles(
        names: Vec<String>,
        parents: &[i32],
        offsets: &[f32],
        roles: &[i32],
    ) -> Result<Vec<i32>, EngineError> {
        let skeleton = skeleton_of(names, parents, offsets)?;
        let known = roles_of(roles, skeleton.len())?;
        Ok(numbers_of(&Binding::likely_roles_of_character(&skeleton, &known)))
    }

    /// Returns the feet that are children of the root instead of their legs: pairs of the foot's joint and the joint of
    /// its lower leg.
    ///
    /// # Errors
    /// If the numbers are no valid skeleton.
    #[wasm_bindgen(js_name = looseFeet)]
    pub fn loose_feet(names: Vec<String>, parents: &[i32], offsets: &[f32]) -> Result<Vec<i32>, EngineError> {
        let skeleton = skeleton_of(names, parents, offsets)?;
        Ok(loose_feet(&skeleton).iter().flat_map(|foot| [foot.joint as i32, foot.lower_leg as i32]).collect())
    }

    /// Returns the joint of each of the 21 roles; −1 for a role that the skeleton lacks.
    pub fn roles(&self) -> Vec<i32> {
        numbers_of(&self.binding.joint_of_role)
    }

    /// Returns the confidence of the joint mapping, 0–1: 1 if every role is given or found by its name.
    pub fn confidence(&self) -> f32 {
        self.binding.confidence
    }

    /// Returns notes on what was matched and assumed, as sentences.
    pub fn notes(&self) -> Vec<String> {
        self.binding.notes.clone()
    }

    /// Returns the body as canonical humanoid, metres: 21 × xyz. The first offset is the height of the hips above the
    /// soles.
    pub fn proportions(&self) -> Vec<f32> {
        offsets_of(&self.binding.proportions)
    }

    /// Returns the rotation from the file's axes to the engine's, xyzw: the identity for files with +Y up.
    #[wasm_bindgen(js_name = worldFromFile)]
    pub fn world_from_file(&self) -> Vec<f32> {
        self.binding.world_from_file.to_array().to_vec()
    }

    /// Sets the height of the soles in the bind pose along the body's up axis, in the unit of the offsets.
    ///
    /// `points`: points of the feet that can touch the ground, five numbers each: side (0 left, 1 right), part (0 foot,
    /// 1 toes), and the offset from the joint of that part in the bind pose, xyz along the file's axes.
    ///
    /// Without a height it is estimated from the ankles, as before the first call.
    ///
    /// # Errors
    /// If a number is not finite, or there is no such side or part; the former soles are then kept.
    #[wasm_bindgen(js_name = setSole)]
    pub fn set_sole(&mut self, height: Option<f32>, points: &[f32]) -> Result<(), EngineError> {
        if height.is_some_and(|height| !height.is_finite()) {
            return Err(EngineError::bad_input("the height of the soles must be a number"));
        }
        let sole_points = sole_points_of(points)?;
        let facts = CharacterFacts { sole_height: height, ..self.facts.clone() };
        let binding = Binding::of_character(&self.skeleton, &facts).map_err(|e| EngineError::bad_file(e, ""))?;
        (self.facts, self.binding, self.sole_points) = (facts, binding, sole_points);
        self.retarget = FromHumanoid::for_character(&self.binding, &self.body, &self.sole_points);
        self.observe = ToHumanoid::new(&self.binding, &self.binding.proportions);
        Ok(())
    }

    /// Sets the body that poses are on: 21 × xyz, metres.
    ///
    /// # Errors
    /// If these are not 63 numbers of a valid body; the former body is then kept.
    #[wasm_bindgen(js_name = setBody)]
    pub fn set_body(&mut self, proportions: &[f32]) -> Result<(), EngineError> {
        let (offsets, rest) = proportions.as_chunks::<3>();
        let mut body = Proportions { offsets: [Vec3::ZERO; JOINTS] };
        if offsets.len() != JOINTS || !rest.is_empty() {
            let found = proportions.len();
            return Err(EngineError::bad_input(format!(
                "the proportions of a body have {} numbers, not {found}",
                3 * JOINTS
            )));
        }
        for (to, from) in body.offsets.iter_mut().zip(offsets) {
            *to = Vec3::from_array(*from);
        }
        if !body.is_valid() {
            return Err(EngineError::bad_input("these proportions do not describe a body"));
        }
        self.body = body;
        self.retarget = FromHumanoid::for_character(&self.binding, &self.body, &self.sole_points);
        Ok(())
    }

    /// Converts frames of the character's own animation to poses on the body of [`Character::set_body`], 87 numbers a
    /// frame.
    ///
    /// `locals`: for each frame and joint the local translation, xyz in the unit of the offsets, and the local
    /// rotation, xyzw.
    ///
    /// # Errors
    /// If the array is not a whole number of frames, or a number is not finite.
    #[wasm_bindgen(js_name = toPoses)]
    pub fn to_poses(&self, locals: &[f32]) -> Result<Vec<f32>, EngineError> {
        let (transforms, rest) = locals.as_chunks::<7>();
        let whole = rest.is_empty() && transforms.len().is_multiple_of(self.bind.len());
        if !whole || !locals.iter().all(|x| x.is_finite()) {
            return Err(EngineError::bad_input("a frame needs seven finite numbers per joint"));
        }
        let mut retarget = ToHumanoid::new(&self.binding, &self.body);
        let (mut translations, mut rotations) = (self.translations.clone(), self.rotations.clone());
        let poses: Vec<Pose> = (transforms.chunks_exact(self.bind.len()))
            .map(|frame| {
                for (j, ([x, y, z, q @ ..], (own, above))) in frame.iter().zip(&self.bind).enumerate() {
                    translations[j] = *above * Vec3::new(*x, *y, *z);
                    rotations[j] = (*above * Quat::from_array(*q).normalized() * own.inverse()).normalized();
                }
                retarget.frame(&translations, &rotations)
            })
            .collect();
        Ok(floats_of(poses.iter()))
    }

    /// Returns the number of floats that [`Character::apply`] writes.
    #[wasm_bindgen(js_name = frameFloats)]
    pub fn frame_floats(&self) -> usize {
        self.out.len()
    }

    /// Writes the local transforms of one pose: the translation of the hips in their parent's frame, xyz in the unit of the
    /// offsets, then the local rotation of every joint, xyzw. Nothing is allocated.
    ///
    /// # Errors
    /// If an array has another length, or the pose is not finite.
    pub fn apply(&mut self, pose: &Float32Array, into: &Float32Array) -> Result<(), EngineError> {
        let mut floats = [0.0; POSE_FLOATS];
        if pose.length() as usize != POSE_FLOATS {
            return Err(EngineError::bad_input(format!("a pose has {POSE_FLOATS} numbers, not {}", pose.length())));
        }
        pose.copy_to(&mut floats);
        self.play(&floats)?;
        write_floats(&self.out, into)
    }

    /// Writes the pose that results from the last [`Character::apply`], with the true positions of the joints: 87
    /// numbers on the character's own body ([`Character::proportions`]). Nothing is allocated.
    ///
    /// # Errors
    /// If the array has another length.
    pub fn pose(&mut self, into: &Float32Array) -> Result<(), EngineError> {
        let mut floats = [0.0; POSE_FLOATS];
        self.observe.frame(&self.translations, &self.rotations).write_to(&mut floats);
        write_floats(&floats, into)
    }
}

impl Character {
    /// [`Character::apply`] without JavaScript arrays: returns the numbers in the same order.
    ///
    /// # Errors
    /// If the pose is not finite.
    pub fn play(&mut self, pose: &[f32; POSE_FLOATS]) -> Result<&[f32], EngineError> {
        let pose = Pose::read_from(pose);
        if !pose.is_finite() {
            return Err(EngineError::bad_input("the numbers of a pose must be finite"));
        }
        for ((translation, rotation), rest) in self.translations.iter_mut().zip(&mut self.rotations).zip(&self.rest) {
            (*translation, *rotation) = *rest;
        }
        self.retarget.frame(&pose, &mut self.translations, &mut self.rotations);
        let Some((hips, rotations)) = self.out.split_first_chunk_mut::<3>() else { return Ok(&self.out) };
        // q = B_parent⁻¹ · q′ · B converts the aligned frames back to the file's.
        *hips = self.bind[self.hips].1.inv_mul_vec3(self.translations[self.hips]).to_array();
        for ((out, (own, above)), turned) in
            rotations.as_chunks_mut::<4>().0.iter_mut().zip(&self.bind).zip(&self.rotations)
        {
            *out = above.inv_mul(*turned * *own).normalized().to_array();
        }
        Ok(&self.out)
    }
}

/// Reads unit quaternions from a flat array, one per joint.
fn rotations_of(floats: &[f32], joints: usize) -> Result<Vec<Quat>, EngineError> {
    let (rotations, rest) = floats.as_chunks::<4>();
    if rotations.len() != joints || !rest.is_empty() || !floats.iter().all(|x| x.is_finite()) {
        return Err(EngineError::bad_input("every joint needs a rotation of four finite numbers"));
    }
    Ok(rotations.iter().map(|q| Quat::from_array(*q).normalized()).collect())
}

/// Reads points of the feet from a flat array.
fn sole_points_of(floats: &[f32]) -> Result<Vec<SolePoint>, EngineError> {
    let (points, rest) = floats.as_chunks::<5>();
    let point = |&[side, part, x, y, z]: &[f32; 5]| {
        let at = Vec3::new(x, y, z);
        let known = [side, part].iter().all(|n| *n == 0.0 || *n == 1.0);
        (known && at.is_finite()).then_some(SolePoint { side: side as usize, on_toes: part == 1.0, at })
    };
    let found: Option<Vec<SolePoint>> = points.iter().map(point).collect();
    let found = found.filter(|_| rest.is_empty());
    found.ok_or_else(|| EngineError::bad_input("a point of a sole needs a side, a part and three finite numbers"))
}

/// Converts joints of roles to numbers, −1 for none.
fn numbers_of(roles: &[Option<usize>; JOINTS]) -> Vec<i32> {
    roles.iter().map(|joint| joint.map_or(-1, |j| j as i32)).collect()
}

/// Converts numbers to joints of roles.
fn roles_of(roles: &[i32], joints: usize) -> Result<[Option<usize>; JOINTS], EngineError> {
    let mut out = [None; JOINTS];
    if roles.len() != JOINTS || roles.iter().any(|&j| usize::try_from(j).is_ok_and(|j| j >= joints)) {
        return Err(EngineError::bad_input(format!(
            "the joints of {JOINTS} roles were expected, −1 where there is none"
        )));
    }
    for (to, from) in out.iter_mut().zip(roles) {
        *to = usize::try_from(*from).ok();
    }
    Ok(out)
}
