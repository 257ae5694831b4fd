//! A phase-locked loop on the gait cycle of the input (`docs/methods/mar.md` §9); not in the paper.
//!
//! A predicted duration is that of the neighbours' own step of a frame. The neighbours do not always advance as the
//! input does: they stall where the database is sparse, and run ahead to catch up, and time would be stretched and
//! compressed with them. The loop follows their mean phase smoothly. Durations are multiplied by its pace relative to
//! the neighbours'.

use crate::catalogue::GaitPhase;
use crate::math::float_funcs::{atan2, exp, half_life_share, ln};
use crate::search::Neighbour;
use std::f32::consts::TAU;

/// Half-life of the loop's error, seconds.
const LOCK_HALF_LIFE_SECS: f32 = 0.09;
/// Half-life of the pace's low-pass filter, seconds.
const PACE_HALF_LIFE_SECS: f32 = 0.03;
/// The loop restarts where its error exceeds this, in cycles.
const RELOCK_CYCLES: f32 = 0.15;
/// Greatest correction as a share of the neighbours' advance.
const MOST_CORRECTION: f32 = 0.25;

/// Phase estimate from the neighbours of a frame: weighted sums.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PhaseEstimate {
    cos: f32,
    sin: f32,
    advance: f32,
    weight: f32,
}

impl PhaseEstimate {
    /// Adds the neighbours of a class.
    pub(super) fn add(&mut self, phases: &GaitPhase, class_weight: f32, neighbours: &[Neighbour], weights: &[f32]) {
        let total: f32 = weights.iter().sum();
        if total <= 0.0 {
            return;
        }
        for (n, weight) in neighbours.iter().zip(weights) {
            let row = n.row as usize;
            let advance = phases.advance(row);
            if advance > 0.0 {
                let weight = class_weight * weight / total;
                let [cos, sin] = phases.phasor(row);
                self.cos += weight * cos;
                self.sin += weight * sin;
                self.advance += weight * advance;
                self.weight += weight;
            }
        }
    }
}

/// The loop of one stream of frames.
#[derive(Clone, Copy, Debug)]
pub(super) struct PhaseLock {
    /// p, in cycles; `None` before the first frame and where most of the neighbours have no gait phase.
    phase: Option<f32>,
    /// Pace, low-pass filtered.
    pace: f32,
}

impl Default for PhaseLock {
    fn default() -> Self {
        Self { phase: None, pace: 1.0 }
    }
}

impl PhaseLock {
    /// Follows the phase of the next frame. Returns the factor of durations.
    ///
    /// `known` is the similarity of the input to the database: for unknown input the neighbours' phase is no better
    /// than their durations, and following it makes the output rougher. `tempo` is η, the exponent of the pace.
    pub(super) fn follow(&mut self, seen: PhaseEstimate, known: f32, tempo: f32, frame_secs: f32) -> f32 {
        if seen.weight < 0.5 {
            *self = Self::default();
            return 1.0;
        }
        let advance = seen.advance / seen.weight;
        let phase = atan2(seen.sin, seen.cos) / TAU;
        let expected = self.phase.map_or(phase, |before| before + advance);
        let error = phase - expected - (phase - expected).round();
        let (from, error) = if error.abs() > RELOCK_CYCLES { (phase, 0.0) } else { (expected, error) };
        let gain = known * half_life_share(frame_secs, LOCK_HALF_LIFE_SECS);
        let correction = (gain * error).clamp(-MOST_CORRECTION * advance, MOST_CORRECTION * advance);
        let next = from + correction;
        self.phase = Some(next - next.floor());
        let pace = exp(tempo * ln(1.0 + correction / advance));
        self.pace += half_life_share(frame_secs, PACE_HALF_LIFE_SECS) * (pace - self.pace);
        self.pace
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME_SECS: f32 = 1.0 / 60.0;
    /// Advance per frame of a cycle of one second.
    const ADVANCE: f32 = 1.0 / 60.0;
    /// Input that is like the database, and input that is unlike it.
    const KNOWN: f32 = 1.0;
    const UNKNOWN: f32 = 0.0;
    /// η.
    const HALF: f32 = 0.5;

    fn seen(phase: f32) -> PhaseEstimate {
        let (sin, cos) = crate::math::float_funcs::sin_cos(TAU * phase);
        PhaseEstimate { cos, sin, advance: ADVANCE, weight: 1.0 }
    }

    /// Pace after each of these phases.
    fn paces(phases: impl Iterator<Item = f32>, known: f32) -> Vec<f32> {
        let mut lock = PhaseLock::default();
        phases.map(|phase| lock.follow(seen(phase), known, HALF, FRAME_SECS)).collect()
    }

    #[test]
    fn neighbours_that_go_on_keep_their_pace() {
        for pace in paces((0..200).map(|i| 0.3 + ADVANCE * i as f32), KNOWN) {
            assert!((pace - 1.0).abs() < 1e-4, "{pace}");
        }
    }

    #[test]
    fn neighbours_that_go_slower_than_their_own_clips_take_less_time_by_half() {
        let paces = paces((0..400).map(|i| 0.9 * ADVANCE * i as f32), KNOWN);
        assert!((paces[399] - 0.9_f32.sqrt()).abs() < 1e-3, "{}", paces[399]);
    }

    #[test]
    fn a_jump_begins_anew_and_changes_no_pace() {
        let jumping = |i: usize| ADVANCE * i as f32 + if i < 50 { 0.0 } else { 0.4 };
        for pace in paces((0..100).map(jumping), KNOWN) {
            assert!((pace - 1.0).abs() < 1e-4, "{pace}");
        }
    }

    #[test]
    fn unknown_input_and_what_is_no_gait_change_no_pace() {
        assert!(paces((0..100).map(|i| 0.8 * ADVANCE * i as f32), UNKNOWN).iter().all(|pace| *pace == 1.0));
        let mut lock = PhaseLock::default();
        lock.follow(seen(0.1), KNOWN, HALF, FRAME_SECS);
        lock.follow(seen(0.05), KNOWN, HALF, FRAME_SECS);
        assert_eq!(lock.follow(PhaseEstimate::default(), KNOWN, HALF, FRAME_SECS), 1.0);
        assert_eq!(lock.phase, None);
    }

    #[test]
    fn the_correction_is_bounded() {
        for (i, pace) in paces((0..300).map(|i| 0.14 * ((i / 2) % 2) as f32), KNOWN).into_iter().enumerate() {
            assert!((0.75_f32.sqrt()..=1.25_f32.sqrt()).contains(&pace), "{i}: {pace}");
        }
    }
}
