//! Holds planted feet in place and soles above the ground (`docs/methods/mar.md` §11), frame by frame.

use super::contact_likelihood::stands;
use crate::contact::Thresholds;
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::{Limb, Sole, Soles, WorldPose, two_bone_ik, world_from_local};
use crate::math::float_funcs::exp;
use crate::math::{Vec2, Vec3};

/// Frames over which a hold fades in.
const EASE_FRAMES: u32 = 3;
/// Time constant of the return to the predicted position after release, seconds. The return is a critically damped
/// spring rather than a plain decay, so that the foot leaves with its current speed.
const DECAY_SECS: f32 = 0.12;
/// Greatest correction of a foot, metres; the root takes up the excess.
const MAX_CORRECTION: f32 = 0.2;
/// The root moves only if a target is out of reach by more than this, metres.
const MIN_SHIFT: f32 = 1e-4;
/// The root moves to keep planted feet in place, at most as fast as it moves anyway or this fast, m/s; beyond that the
/// foot slides. Without a limit the body jumps where two planted feet pull it apart: at 4 m/s in a driven half-turn.
const MIN_ROOT_SPEED: f32 = 0.5;

#[derive(Clone, Copy, Debug, Default)]
struct Foot {
    planted_frames: u32,
    /// c: from the predicted to the corrected position, horizontal.
    correction: Vec3,
    /// Its rate of change, m/s.
    velocity: Vec3,
    /// Sole of the last predicted pose, with the root's shift applied.
    last: Option<Sole>,
}

impl Foot {
    fn is_planted(&self) -> bool {
        self.planted_frames > 0
    }

    /// Returns whether a foot is as low and slow as a planted one (§3), whatever its likelihood.
    fn is_still(&self, sole: Sole, speed: f32, thresholds: &Thresholds) -> bool {
        let [height, limit] = if self.is_planted() {
            [thresholds.off_height, thresholds.off_speed]
        } else {
            [thresholds.on_height, thresholds.on_speed]
        };
        self.last.is_some() && sole.lowest() < height && speed < limit
    }

    /// Accumulates c ← c − travel of the pivot while planted, otherwise lets it decay.
    fn update(&mut self, sole: Sole, likelihood: f32, thresholds: &Thresholds, dt_secs: f32) {
        let travel = self.last.map_or(Vec3::ZERO, |last| sole.pivot_travel(&last));
        let still = self.is_still(sole, travel.length() / dt_secs, thresholds);
        let planted = stands(self.is_planted(), likelihood) || still;
        self.planted_frames = if planted { self.planted_frames.saturating_add(1) } else { 0 };
        if planted {
            let step = travel * (self.planted_frames.min(EASE_FRAMES) as f32 / EASE_FRAMES as f32);
            self.correction -= step;
            self.velocity = -step / dt_secs;
        } else {
            let rate = 2.0 / DECAY_SECS;
            let (c, v, decay) = (self.correction, self.velocity, exp(-rate * dt_secs));
            let pull = v + c * rate;
            self.correction = (c + pull * dt_secs) * decay;
            self.velocity = (v - pull * (rate * dt_secs)) * decay;
        }
        self.last = Some(sole);
    }

    /// Part of the correction beyond its limit.
    fn excess(&self) -> Vec3 {
        self.correction - self.correction.clamp_length_max(MAX_CORRECTION)
    }
}

/// The footplant filter of one character.
#[derive(Clone, Debug)]
pub struct Footplant {
    proportions: Proportions,
    soles: Soles,
    thresholds: Thresholds,
    feet: [Foot; 2],
    /// Total shift of the root that has kept planted feet in place where their corrections reached the limit.
    root_shift: Vec3,
    /// Root of the last predicted pose.
    last_root: Option<Vec3>,
}

impl Footplant {
    /// Filter for a humanoid of these proportions.
    pub fn new(proportions: Proportions) -> Self {
        Self {
            proportions,
            soles: Soles::new(&proportions),
            thresholds: Thresholds::scaled_to(&proportions),
            feet: [Foot::default(); 2],
            root_shift: Vec3::ZERO,
            last_root: None,
        }
    }

    /// Resets the state.
    pub fn reset(&mut self) {
        self.feet = [Foot::default(); 2];
        self.root_shift = Vec3::ZERO;
        self.last_root = None;
    }

    /// Corrects the next frame in place, `dt_secs` of output time after the one before, given the
    /// likelihood that each foot is planted. Returns which feet are held.
    pub fn apply(&mut self, pose: &mut Pose, likelihood: [f32; 2], dt_secs: f32) -> [bool; 2] {
        let went = self.last_root.replace(pose.root).map_or(Vec3::ZERO, |last| pose.root - last);
        let most = Vec2::new(went.x, went.z).length().max(MIN_ROOT_SPEED * dt_secs);
        pose.root += self.root_shift;
        let mut world = world_from_local(&self.proportions, pose);
        for (side, (foot, likelihood)) in self.feet.iter_mut().zip(likelihood).enumerate() {
            foot.update(self.soles.of(&world, side), likelihood, &self.thresholds, dt_secs);
        }
        let planted = self.feet.map(|f| f.is_planted());
        let over_cap = mean_of_planted(planted, |side| self.feet[side].excess()).clamp_length_max(most);
        self.move_root(over_cap, pose, &mut world);
        let corrected = self.with_feet_in_place(pose, &world);
        let out_of_reach = mean_of_planted(planted, |side| corrected.1[side]);
        if out_of_reach.length() > MIN_SHIFT {
            let left = most - over_cap.length();
            self.move_root(out_of_reach.clamp_length_max(left), pose, &mut world);
            *pose = self.with_feet_in_place(pose, &world).0;
        } else {
            *pose = corrected.0;
        }
        planted
    }

    /// Shifts the root permanently and reduces the corrections of planted feet by the same amount.
    fn move_root(&mut self, by: Vec3, pose: &mut Pose, world: &mut WorldPose) {
        if by == Vec3::ZERO {
            return;
        }
        self.root_shift += by;
        pose.root += by;
        *world = world_from_local(&self.proportions, pose);
        for (side, foot) in self.feet.iter_mut().enumerate() {
            foot.last = Some(self.soles.of(world, side));
            if foot.is_planted() {
                foot.correction = (foot.correction - by).clamp_length_max(MAX_CORRECTION);
            }
        }
    }

    /// Pose with both feet at their corrected positions above the ground, and the horizontal part of the corrections
    /// that the legs could not reach.
    fn with_feet_in_place(&self, pose: &Pose, world: &WorldPose) -> (Pose, [Vec3; 2]) {
        let (mut pose, mut world) = (*pose, *world);
        let mut residual = [Vec3::ZERO; 2];
        for (side, limb) in Limb::LEGS.into_iter().enumerate() {
            let depth = (-self.soles.of(&world, side).lowest()).max(0.0);
            let by = self.feet[side].correction + Vec3::Y * depth;
            if by != Vec3::ZERO {
                let ankle = Soles::JOINTS[side][0].index();
                let target = world.positions[ankle] + by;
                two_bone_ik(&self.proportions, &mut pose, &mut world, limb, target);
                residual[side] = (target - world.positions[ankle]) * Vec3::new(1.0, 0.0, 1.0);
            }
        }
        (pose, residual)
    }
}

/// Mean over the planted feet for which `value` is not zero.
fn mean_of_planted(planted: [bool; 2], value: impl Fn(usize) -> Vec3) -> Vec3 {
    let (mut sum, mut count) = (Vec3::ZERO, 0.0);
    for side in (0..2).filter(|&s| planted[s]) {
        let v = value(side);
        if v != Vec3::ZERO {
            sum += v;
            count += 1.0;
        }
    }
    sum / f32::max(count, 1.0)
}

/// Height of the lower sole above the ground, metres; negative below it.
pub fn ground_clearance(proportions: &Proportions, pose: &Pose) -> f32 {
    let soles = Soles::new(proportions);
    let world = world_from_local(proportions, pose);
    soles.of(&world, 0).lowest().min(soles.of(&world, 1).lowest())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::humanoid::Role;
    use crate::math::Quat;
    use proptest::prelude::*;

    const DT: f32 = 1.0 / 60.0;

    /// Both knees bent, soles on the ground.
    pub(in crate::transfer) fn crouch() -> Pose {
        let p = Proportions::default();
        let mut pose = Pose { root: p.offsets[0], ..Pose::default() };
        for (thigh, shin, foot) in [
            (Role::LeftUpperLeg, Role::LeftLowerLeg, Role::LeftFoot),
            (Role::RightUpperLeg, Role::RightLowerLeg, Role::RightFoot),
        ] {
            pose.rotations[thigh.index()] = Quat::from_rotation_x(-0.3);
            pose.rotations[shin.index()] = Quat::from_rotation_x(0.6);
            pose.rotations[foot.index()] = Quat::from_rotation_x(-0.3);
        }
        pose.root.y -= ground_clearance(&p, &pose);
        pose
    }

    fn sole(pose: &Pose, side: usize) -> Sole {
        let p = Proportions::default();
        Soles::new(&p).of(&world_from_local(&p, pose), side)
    }

    proptest! {
        #[test]
        fn a_planted_foot_stays_while_the_body_drifts(speed in -0.3f32..0.3, side in 0usize..2) {
            let mut filter = Footplant::new(Proportions::default());
            let mut likelihood = [0.0; 2];
            likelihood[side] = 1.0;
            let mut places = Vec::new();
            for i in 0..30 {
                let mut pose = crouch();
                pose.root.z += speed * DT * i as f32;
                let planted = filter.apply(&mut pose, likelihood, DT);
                prop_assert!(planted[side]);
                places.push(sole(&pose, side).ball);
            }
            for p in &places[4..] {
                prop_assert!((*p - places[3]).length() < 1e-3, "{p} {}", places[3]);
            }
        }

        #[test]
        fn soles_come_up_to_the_ground(depth in 0.0f32..0.15) {
            let mut pose = crouch();
            pose.root.y -= depth;
            Footplant::new(Proportions::default()).apply(&mut pose, [0.0; 2], DT);
            prop_assert!(ground_clearance(&Proportions::default(), &pose) > -1e-3);
        }
    }

    #[test]
    fn the_root_follows_when_the_correction_reaches_its_cap() {
        let mut filter = Footplant::new(Proportions::default());
        let mut last = crouch();
        for i in 0..60 {
            last = crouch();
            last.root.x += 0.01 * i as f32;
            filter.apply(&mut last, [1.0; 2], DT);
        }
        // 0.6 m of drift: 0.2 m in the legs, the rest in the root; the feet stay where they were planted.
        assert!(last.root.x < 0.25, "{}", last.root.x);
        let eased = 0.02;
        assert!((sole(&last, 0).ball.x - sole(&crouch(), 0).ball.x).abs() < eased, "{:?}", sole(&last, 0));
    }

    #[test]
    fn the_root_of_a_body_that_stands_does_not_leap_where_a_planted_foot_runs_away() {
        let mut filter = Footplant::new(Proportions::default());
        let mut roots = Vec::new();
        for i in 0..40 {
            let mut pose = crouch();
            // The foot moves backwards at 2 m/s.
            pose.rotations[Role::LeftUpperLeg.index()] = Quat::from_rotation_x(-0.6 + 2.5 * DT * i as f32);
            filter.apply(&mut pose, [1.0, 0.0], DT);
            roots.push(pose.root);
        }
        let fastest = roots.windows(2).map(|pair| pair[0].distance(pair[1]) / DT).fold(0.0, f32::max);
        assert!(fastest > 0.9 * MIN_ROOT_SPEED && fastest < MIN_ROOT_SPEED + 1e-3, "{fastest} m/s");
    }

    #[test]
    fn a_released_foot_returns_and_what_is_in_place_is_not_touched() {
        let mut filter = Footplant::new(Proportions::default());
        for i in 0..10 {
            let mut pose = crouch();
            pose.root.x += 0.005 * i as f32;
            filter.apply(&mut pose, [1.0, 0.0], DT);
        }
        let lifted = Pose { root: crouch().root + 0.1 * Vec3::Y, ..crouch() };
        let mut pose = lifted;
        for _ in 0..60 {
            pose = lifted;
            filter.apply(&mut pose, [0.0; 2], DT);
        }
        for (a, b) in pose.rotations.iter().zip(&lifted.rotations) {
            assert!(a.dot(*b).abs() > 1.0 - 1e-5);
        }
    }

    #[test]
    fn a_foot_that_hardly_moves_is_held_whatever_is_said_of_it() {
        let mut filter = Footplant::new(Proportions::default());
        let mut planted = [false; 2];
        for i in 0..30 {
            let mut pose = crouch();
            pose.root.x += 0.005 * i as f32;
            planted = filter.apply(&mut pose, [0.0; 2], DT);
        }
        assert_eq!(planted, [true; 2]);
    }

    /// The thresholds scale with the body: a speed at which the foot of a tall body is still planted is fast for a child.
    #[test]
    fn the_thresholds_of_a_still_foot_are_scaled_to_the_legs() {
        let tall = Proportions::default();
        let small = Proportions { offsets: tall.offsets.map(|offset| offset * 0.5) };
        let is_held = |proportions: Proportions, size: f32| {
            let mut filter = Footplant::new(proportions);
            let mut planted = [false; 2];
            for i in 0..30 {
                let mut pose = crouch();
                pose.root = pose.root * size + Vec3::X * 0.006 * i as f32;
                planted = filter.apply(&mut pose, [0.0; 2], DT);
            }
            planted
        };
        assert_eq!(is_held(tall, 1.0), [true; 2]);
        assert_eq!(is_held(small, 0.5), [false; 2]);
    }
}
