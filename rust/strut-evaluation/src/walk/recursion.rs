//! Error of the backward recursion from the horizon in single precision.

use super::shared_of;
use strut_core::hsmm::HORIZON;
use strut_core::hsmm::ROTATION_DIMS;
use strut_core::hsmm::Track;
use strut_core::hsmm::WalkModel;
use strut_core::hsmm::parts::Sample;
use strut_core::hsmm::parts::Stream;
use strut_core::hsmm::parts::chains;
use strut_core::hsmm::parts::{Banded, CostToGo, FrameState, FrameTerms, Number, Term};

/// The terms of a state by side, state and part.
type Terms<'a, T> = &'a dyn Fn(FrameState, Stream) -> Term<T>;

/// Compares two trajectories through the states of a recorded walk of a style, each of which continues its own last two
/// frames with a look-ahead of [`HORIZON`] frames: the recursion of a [`Walker`](strut_core::hsmm::Walker) in single precision, and the
/// banded system in double precision, from the means of the first two frames on. Returns the greatest difference between
/// their angles, radians; `None` for a walk that is shorter than the horizon.
pub fn recursion_error(model: &WalkModel, style: usize, track: &Track) -> Option<f64> {
    let (shared, sample) = (shared_of(model), Sample::new(style, track, &model.reference));
    let mut greatest = None;
    for chain in chains(&sample, &model.means[style], &shared) {
        for d in 0..ROTATION_DIMS {
            let numbers = |(side, state): FrameState, part: Stream| {
                let [mean, variance] =
                    [&model.means[style].means, &model.variances].map(|of| of[side][state][part as usize][d]);
                [mean as f32, 1.0 / variance as f32]
            };
            let single = |state: FrameState, part: Stream| {
                let [mean, weight] = numbers(state, part);
                Term { mean, weight }
            };
            let double = |state: FrameState, part: Stream| {
                let [mean, weight] = numbers(state, part).map(f64::from);
                Term { mean, weight }
            };
            let first = [chain.states[0], chain.states[1]].map(|state| double(state, Stream::Static).mean);
            let (mut by_recursion, mut by_system) = (first.map(|c| c as f32), first);
            // The frame before, and those up to the horizon.
            for states in chain.states[1..].windows(HORIZON + 2) {
                by_recursion = [by_recursion[1], recursion(states, &single, by_recursion)];
                by_system = [by_system[1], system(states, &double, by_system)];
                let off = (f64::from(by_recursion[1]) - by_system[1]).abs();
                greatest = Some(off.max(greatest.unwrap_or(0.0)));
            }
        }
    }
    greatest
}

/// The second frame of a sequence of states, by the recursion.
fn recursion<T: Number>(states: &[FrameState], term: Terms<T>, known: [T; 2]) -> T {
    let frame = |pair: &[FrameState]| FrameTerms {
        pose: term(pair[1], Stream::Static),
        velocity: term(pair[0], Stream::Delta),
        acceleration: term(pair[0], Stream::DeltaDelta),
    };
    let rest = states[1..].windows(2).rev().fold(CostToGo::default(), |rest, pair| rest.with(&frame(pair)).0);
    rest.with(&frame(states)).1.after(known)
}

/// The same frame by the banded system.
fn system<T: Number>(states: &[FrameState], term: Terms<T>, known: [T; 2]) -> T {
    let mut system = Banded::default();
    let (before, path) = (states[0], &states[1..]);
    system.begin(path.len());
    for (t, state) in path.iter().enumerate() {
        system.pose(t, term(*state, Stream::Static));
        if t > 0 && t + 1 < path.len() {
            system.velocity(t, term(*state, Stream::Delta));
            system.acceleration(t, term(*state, Stream::DeltaDelta));
        }
    }
    let terms = |part: Stream| [before, path[0]].map(|state| term(state, part));
    system.after(known, terms(Stream::Delta), terms(Stream::DeltaDelta));
    system.solve()[0]
}
