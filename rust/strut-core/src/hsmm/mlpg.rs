//! Maximum-likelihood parameter generation: the trajectory whose poses, velocities and accelerations fit their means best
//! (`docs/methods/hsmm.md` §8).
//!
//! For each degree of freedom it minimises Σₜ p (cₜ − m)² + p′ (Δcₜ − m′)² + p″ (Δ²cₜ − m″)², with Δcₜ = (cₜ₊₁ − cₜ₋₁) / 2
//! and Δ²cₜ = cₜ₊₁ − 2cₜ + cₜ₋₁: a symmetric system with five diagonals, which [`Banded`] solves for all frames. If only the
//! next frame is needed and the two before it are known, [`CostToGo`] recurses backwards from the last frame to it.

use super::model::Stream;
use crate::math::lanes::Lane;
use std::ops::{Add, Div, Mul, Sub};

/// The scalar type of a trajectory: one degree of freedom, or four in parallel.
pub trait Number:
    Copy + Default + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// Converts a constant.
    fn of(value: f32) -> Self;
}

impl Number for f32 {
    fn of(value: f32) -> Self {
        value
    }
}

impl Number for f64 {
    fn of(value: f32) -> Self {
        value.into()
    }
}

impl Number for Lane {
    fn of(value: f32) -> Self {
        Self::splat(value)
    }
}

/// A mean and its weight: the inverse of its variance.
#[derive(Clone, Copy, Debug, Default)]
pub struct Term<T> {
    /// The mean.
    pub mean: T,
    /// Its weight.
    pub weight: T,
}

/// The quadratic terms in which cₜ appears: its pose, and the velocity and the acceleration of the frame before.
#[derive(Clone, Copy, Debug, Default)]
pub struct FrameTerms<T> {
    /// Term of cₜ.
    pub pose: Term<T>,
    /// Term of (cₜ − cₜ₋₂) / 2.
    pub velocity: Term<T>,
    /// Term of cₜ − 2cₜ₋₁ + cₜ₋₂.
    pub acceleration: Term<T>,
}

/// The optimal value of a frame as a function of the two before it: cₜ = q (r − α cₜ₋₂ − β cₜ₋₁).
#[derive(Clone, Copy, Debug)]
pub struct Choice<T> {
    alpha: T,
    beta: T,
    q: T,
    r: T,
}

impl<T: Number> Choice<T> {
    /// Returns the value after cₜ₋₂ and cₜ₋₁.
    pub fn after(&self, [before, last]: [T; 2]) -> T {
        self.q * (self.r - self.alpha * before - self.beta * last)
    }
}

/// Least cost of the frames from t on, as a function of a = cₜ₋₂ and b = cₜ₋₁:
/// J(a, b) = A a² + 2B ab + C b² − 2D a − 2E b and a constant. After the last frame it is zero.
#[derive(Clone, Copy, Debug, Default)]
pub struct CostToGo<T> {
    aa: T,
    ab: T,
    bb: T,
    a: T,
    b: T,
}

impl<T: Number> CostToGo<T> {
    /// Prepends a frame; returns the new cost and the frame's optimal value. All of J except the terms of that frame is a
    /// function of it and of the frame before; minimising over the frame gives the same form (dynamic programming, as in
    /// linear-quadratic control).
    #[inline]
    pub fn with(&self, frame: &FrameTerms<T>) -> (Self, Choice<T>) {
        let (p, v, g) = (frame.pose.weight, frame.velocity.weight, frame.acceleration.weight);
        let (quarter, pull) = (v * T::of(0.25), v * frame.velocity.mean * T::of(0.5));
        let (twice, bend) = (g + g, g * frame.acceleration.mean);
        let alpha = g - quarter;
        let beta = self.ab - twice;
        let q = T::of(1.0) / (p + quarter + g + self.bb);
        let r = p * frame.pose.mean + pull + bend + self.b;
        let (alpha_q, beta_q) = (alpha * q, beta * q);
        let cost = Self {
            aa: quarter + g - alpha * alpha_q,
            ab: T::of(0.0) - twice - alpha * beta_q,
            bb: twice + twice + self.aa - beta * beta_q,
            a: bend - pull - alpha_q * r,
            b: self.a - bend - bend - beta_q * r,
        };
        (cost, Choice { alpha, beta, q, r })
    }
}

/// State of one frame: the indices of its side and its state.
pub type FrameState = (usize, usize);

/// A system with five diagonals and its right-hand side; reuses its memory.
#[derive(Clone, Debug, Default)]
pub struct Banded<T> {
    /// The main diagonal and the two next to it; entry t couples t with t, t + 1 and t + 2.
    diagonals: [Vec<T>; 3],
    right: Vec<T>,
}

impl<T: Number> Banded<T> {
    /// Clears the system and sets its number of frames.
    pub fn begin(&mut self, frames: usize) {
        for values in self.diagonals.iter_mut().chain([&mut self.right]) {
            values.clear();
            values.resize(frames, T::default());
        }
    }

    fn couple(&mut self, t: usize, with: usize, value: T) {
        let entry = &mut self.diagonals[with - t][t];
        *entry = *entry + value;
    }

    fn pull(&mut self, t: usize, value: T) {
        self.right[t] = self.right[t] + value;
    }

    /// Adds the term of cₜ near a mean.
    pub fn pose(&mut self, t: usize, of: Term<T>) {
        self.weigh_pose(t, of.weight);
        self.pull_pose(t, of);
    }

    fn weigh_pose(&mut self, t: usize, weight: T) {
        self.couple(t, t, weight);
    }

    fn pull_pose(&mut self, t: usize, of: Term<T>) {
        self.pull(t, of.weight * of.mean);
    }

    /// Adds the term of (cₜ₊₁ − cₜ₋₁) / 2 near a mean.
    pub fn velocity(&mut self, t: usize, of: Term<T>) {
        self.weigh_velocity(t, of.weight);
        self.pull_velocity(t, of);
    }

    fn weigh_velocity(&mut self, t: usize, weight: T) {
        let quarter = weight * T::of(0.25);
        self.couple(t - 1, t - 1, quarter);
        self.couple(t + 1, t + 1, quarter);
        self.couple(t - 1, t + 1, T::of(0.0) - quarter);
    }

    fn pull_velocity(&mut self, t: usize, of: Term<T>) {
        let half = of.weight * T::of(0.5);
        self.pull(t + 1, half * of.mean);
        self.pull(t - 1, T::of(0.0) - half * of.mean);
    }

    /// Adds the term of cₜ₊₁ − 2cₜ + cₜ₋₁ near a mean.
    pub fn acceleration(&mut self, t: usize, of: Term<T>) {
        self.weigh_acceleration(t, of.weight);
        self.pull_acceleration(t, of);
    }

    fn weigh_acceleration(&mut self, t: usize, weight: T) {
        let minus_two = T::of(-2.0) * weight;
        self.couple(t - 1, t - 1, weight);
        self.couple(t, t, T::of(4.0) * weight);
        self.couple(t + 1, t + 1, weight);
        self.couple(t - 1, t, minus_two);
        self.couple(t, t + 1, minus_two);
        self.couple(t - 1, t + 1, weight);
    }

    fn pull_acceleration(&mut self, t: usize, of: Term<T>) {
        self.pull(t - 1, of.weight * of.mean);
        self.pull(t, T::of(-2.0) * of.weight * of.mean);
        self.pull(t + 1, of.weight * of.mean);
    }

    /// Adds the terms that couple the trajectory to the known values c₋₁ and c₋₂: deltas of frames −1 and 0.
    pub fn after(&mut self, [before, last]: [T; 2], velocities: [Term<T>; 2], accelerations: [Term<T>; 2]) {
        // (c₀ − c₋₂) / 2 and (c₁ − c₋₁) / 2.
        for (t, (of, known)) in velocities.iter().zip([before, last]).enumerate() {
            self.couple(t, t, of.weight * T::of(0.25));
            self.pull(t, of.weight * T::of(0.25) * (of.mean + of.mean + known));
        }
        // c₀ − 2c₋₁ + c₋₂ and c₁ − 2c₀ + c₋₁.
        let [earlier, later] = accelerations;
        self.couple(0, 0, earlier.weight);
        self.pull(0, earlier.weight * (earlier.mean + last + last - before));
        let minus_two = T::of(-2.0) * later.weight;
        self.couple(0, 0, T::of(4.0) * later.weight);
        self.couple(0, 1, minus_two);
        self.couple(1, 1, later.weight);
        self.pull(0, minus_two * (later.mean - last));
        self.pull(1, later.weight * (later.mean - last));
    }

    /// Computes the trajectory for the states of all frames and terms by (side, state, part). The first and the last frame
    /// have no deltas.
    pub fn through(&mut self, states: &[FrameState], term: impl Fn(usize, usize, Stream) -> Term<T>) -> &[T] {
        self.weigh(states, |side, state, part| term(side, state, part).weight);
        self.through_weighed(states, term)
    }

    /// Resets the system to the weights of the terms of all frames, for trajectories through any means.
    pub fn weigh(&mut self, states: &[FrameState], weight: impl Fn(usize, usize, Stream) -> T) {
        self.begin(states.len());
        for (t, &(side, state)) in states.iter().enumerate() {
            self.weigh_pose(t, weight(side, state, Stream::Static));
            if t > 0 && t + 1 < states.len() {
                self.weigh_velocity(t, weight(side, state, Stream::Delta));
                self.weigh_acceleration(t, weight(side, state, Stream::DeltaDelta));
            }
        }
        self.factorise();
    }

    /// Computes the trajectory for terms whose weights are those of the last [`Banded::weigh`].
    pub fn through_weighed(&mut self, states: &[FrameState], term: impl Fn(usize, usize, Stream) -> Term<T>) -> &[T] {
        self.right.fill(T::default());
        for (t, &(side, state)) in states.iter().enumerate() {
            self.pull_pose(t, term(side, state, Stream::Static));
            if t > 0 && t + 1 < states.len() {
                self.pull_velocity(t, term(side, state, Stream::Delta));
                self.pull_acceleration(t, term(side, state, Stream::DeltaDelta));
            }
        }
        self.substitute()
    }

    /// Solves for the trajectory. The matrix is positive definite if every frame's pose has a weight.
    pub fn solve(&mut self) -> &[T] {
        self.factorise();
        self.substitute()
    }

    /// Replaces the diagonals by D and the two subdiagonals of L of the matrix's decomposition L D Lᵀ.
    fn factorise(&mut self) {
        let [d0, d1, d2] = &mut self.diagonals;
        for t in 0..d0.len() {
            if t >= 1 {
                d0[t] = d0[t] - d1[t - 1] * d1[t - 1] * d0[t - 1];
                d1[t] = d1[t] - d1[t - 1] * d2[t - 1] * d0[t - 1];
            }
            if t >= 2 {
                d0[t] = d0[t] - d2[t - 2] * d2[t - 2] * d0[t - 2];
            }
            d1[t] = d1[t] / d0[t];
            d2[t] = d2[t] / d0[t];
        }
    }

    /// Replaces the right-hand side by the solution.
    fn substitute(&mut self) -> &[T] {
        let [d, l1, l2] = &self.diagonals;
        let y = &mut self.right;
        for t in 0..y.len() {
            if t >= 1 {
                y[t] = y[t] - l1[t - 1] * y[t - 1];
            }
            if t >= 2 {
                y[t] = y[t] - l2[t - 2] * y[t - 2];
            }
        }
        for (y, d) in y.iter_mut().zip(d) {
            *y = *y / *d;
        }
        for t in (0..y.len()).rev() {
            if t + 1 < y.len() {
                y[t] = y[t] - l1[t] * y[t + 1];
            }
            if t + 2 < y.len() {
                y[t] = y[t] - l2[t] * y[t + 2];
            }
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Terms = Vec<[(f64, f64); 3]>;

    fn terms(frames: usize) -> impl Strategy<Value = Terms> {
        prop::collection::vec(prop::array::uniform3((-1.0f64..1.0, 0.1f64..50.0)), frames)
    }

    fn term((mean, weight): (f64, f64)) -> Term<f64> {
        Term { mean, weight }
    }

    fn begin(system: &mut Banded<f64>, terms: &[[(f64, f64); 3]]) {
        system.begin(terms.len());
        for (t, [pose, velocity, acceleration]) in terms.iter().enumerate() {
            system.pose(t, term(*pose));
            if (1..terms.len() - 1).contains(&t) {
                system.velocity(t, term(*velocity));
                system.acceleration(t, term(*acceleration));
            }
        }
    }

    fn solve(terms: &Terms) -> Vec<f64> {
        let mut system = Banded::default();
        begin(&mut system, terms);
        system.solve().to_vec()
    }

    /// The frames that follow the first, with their terms.
    fn frames(terms: &Terms) -> impl DoubleEndedIterator<Item = FrameTerms<f64>> {
        terms.windows(2).map(|pair| FrameTerms {
            pose: term(pair[1][0]),
            velocity: term(pair[0][1]),
            acceleration: term(pair[0][2]),
        })
    }

    /// The trajectory of the frames that follow the first, given two known values.
    fn recursion(terms: &Terms, known: [f64; 2]) -> Vec<f64> {
        let (mut cost, mut choices) = (CostToGo::default(), Vec::new());
        for frame in frames(terms).rev() {
            let (with, choice) = cost.with(&frame);
            cost = with;
            choices.push(choice);
        }
        let values = choices.iter().rev().scan(known, |known, choice| {
            *known = [known[1], choice.after(*known)];
            Some(known[1])
        });
        values.collect()
    }

    /// The objective.
    fn cost(terms: &Terms, c: &[f64]) -> f64 {
        terms
            .iter()
            .enumerate()
            .map(|(t, [pose, velocity, acceleration])| {
                let square = |(mean, weight): (f64, f64), v: f64| weight * (v - mean) * (v - mean);
                let inner = if (1..terms.len() - 1).contains(&t) {
                    square(*velocity, 0.5 * (c[t + 1] - c[t - 1]))
                        + square(*acceleration, c[t + 1] - 2.0 * c[t] + c[t - 1])
                } else {
                    0.0
                };
                square(*pose, c[t]) + inner
            })
            .sum()
    }

    proptest! {
        #[test]
        fn no_trajectory_is_likelier(terms in terms(30), t in 0usize..30, by in prop::sample::select(vec![-1e-3, 1e-3])) {
            let found = solve(&terms);
            let mut other = found.clone();
            other[t] += by;
            prop_assert!(cost(&terms, &found) < cost(&terms, &other));
        }

        #[test]
        fn it_goes_on_from_frames_that_are_known(terms in terms(40)) {
            let all = solve(&terms);
            // If two frames of the solution and all later terms are known, the rest is the solution again.
            let mut system = Banded::default();
            begin(&mut system, &terms[12..]);
            let of = |part: usize| [11, 12].map(|t: usize| term(terms[t][part]));
            system.after([all[10], all[11]], of(1), of(2));
            for (a, b) in system.solve().iter().zip(&all[12..]) {
                prop_assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }

        #[test]
        fn going_back_from_the_end_finds_what_follows(terms in terms(23), known in prop::array::uniform2(-1.0f64..1.0)) {
            let found = recursion(&terms, known);
            let mut system = Banded::default();
            begin(&mut system, &terms[1..]);
            let of = |part: usize| [0, 1].map(|t: usize| term(terms[t][part]));
            system.after(known, of(1), of(2));
            for (a, b) in system.solve().iter().zip(&found) {
                prop_assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
        }

        #[test]
        fn single_precision_is_enough_to_go_back(terms in terms(22), known in prop::array::uniform2(-1.0f64..1.0)) {
            let single: Vec<FrameTerms<Lane>> = frames(&terms).map(|frame| {
                let lane = |of: Term<f64>| Term { mean: Lane::splat(of.mean as f32), weight: Lane::splat(of.weight as f32) };
                FrameTerms { pose: lane(frame.pose), velocity: lane(frame.velocity), acceleration: lane(frame.acceleration) }
            }).collect();
            let rest = single[1..].iter().rev().fold(CostToGo::default(), |rest, frame| rest.with(frame).0);
            let (_, choice) = rest.with(&single[0]);
            let found = choice.after(known.map(|c| Lane::splat(c as f32))).to_array()[0];
            prop_assert!((f64::from(found) - recursion(&terms, known)[0]).abs() < 2e-5);
        }

        #[test]
        fn the_trajectory_is_linear_in_the_means(a in terms(20), b in terms(20), share in -1.0f64..2.0) {
            let with_weights = |terms: &Terms| -> Terms {
                terms.iter().zip(&a).map(|(t, w)| std::array::from_fn(|i| (t[i].0, w[i].1))).collect()
            };
            let b = with_weights(&b);
            let mixed: Terms = a.iter().zip(&b)
                .map(|(a, b)| std::array::from_fn(|i| ((1.0 - share) * a[i].0 + share * b[i].0, a[i].1))).collect();
            for ((a, b), m) in solve(&a).iter().zip(&solve(&b)).zip(&solve(&mixed)) {
                prop_assert!(((1.0 - share) * a + share * b - m).abs() < 1e-9);
            }
        }
    }
}
