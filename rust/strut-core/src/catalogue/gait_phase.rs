//! Position in the gait cycle of each row of a catalogue, from the canonical times.

use crate::database::{Clip, DatabaseParts};
use crate::math::float_funcs::sin_cos;
use std::f32::consts::TAU;

/// Unit in which sine and cosine are stored.
const UNIT: f32 = 1.0 / i16::MAX as f32;

/// Phases of the rows whose action walks or runs; other rows have no phase.
#[derive(Clone, Debug)]
pub struct GaitPhase {
    /// Cosine and sine of each row's phase, in [`UNIT`]s; zeros without a phase.
    phasors: Vec<[i16; 2]>,
    /// Cycles that each row's clip advances per frame; 0 without a phase.
    advances: Vec<f32>,
}

impl GaitPhase {
    /// Phases of a database's rows. An action has gait cycles if its canonical time wraps around within a clip.
    pub(super) fn new(parts: &DatabaseParts) -> Self {
        let n = parts.canonical_time.len();
        let mut phases = Self { phasors: vec![[0; 2]; n], advances: vec![0.0; n] };
        for action in 0..parts.actions.len() {
            let clips = || parts.clips.iter().filter(|clip| usize::from(clip.action) == action);
            let Some(period) = period(clips().map(|clip| &parts.canonical_time[clip.rows()])) else { continue };
            for row in clips().flat_map(Clip::rows) {
                let (sin, cos) = sin_cos(TAU * parts.canonical_time[row] / period);
                phases.phasors[row] = [cos, sin].map(|v| (v / UNIT).round() as i16);
                phases.advances[row] = 1.0 / (parts.rate_hz * parts.time_step[row] * period);
            }
        }
        phases
    }

    /// Cosine and sine of a row's phase; zeros without a phase.
    pub fn phasor(&self, row: usize) -> [f32; 2] {
        self.phasors[row].map(|v| f32::from(v) * UNIT)
    }

    /// Cycles that a row's clip advances per frame; 0 without a phase.
    pub fn advance(&self, row: usize) -> f32 {
        self.advances[row]
    }
}

/// Length of a canonical cycle in frames, a whole number, from the canonical times of an action's clips; `None` if the
/// time wraps around in no clip.
fn period<'a>(clips: impl Iterator<Item = &'a [f32]> + Clone) -> Option<f32> {
    let greatest = clips.clone().flatten().copied().fold(0.0, f32::max);
    let wraps = |times: &[f32]| times.windows(2).any(|pair| pair[0] - pair[1] > 0.5 * greatest);
    clips.clone().any(wraps).then(|| greatest.ceil().max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_is_as_long_as_the_times_that_wrap_around() {
        let cycles: Vec<f32> = (0..200).map(|i| (0.9 * i as f32).rem_euclid(64.0)).collect();
        let clip: Vec<f32> = (0..200).map(|i| 0.9 * i as f32).collect();
        assert_eq!(period([&cycles[..], &cycles[..50]].into_iter()), Some(64.0));
        assert_eq!(period([&clip[..]].into_iter()), None);
        assert_eq!(period([].into_iter()), None);
    }

    #[test]
    fn rows_of_a_walk_have_the_phase_and_the_pace_of_their_cycle() {
        let db = crate::fixtures::database();
        let phases = GaitPhase::new(&db);
        for row in db.clips[0].rows() {
            let [cos, sin] = phases.phasor(row);
            let expected = sin_cos(TAU * db.canonical_time[row] / 64.0);
            assert!((sin - expected.0).abs() < 1e-4 && (cos - expected.1).abs() < 1e-4, "row {row}");
            let secs = 64.0 * db.time_step[row];
            assert!((phases.advance(row) - 1.0 / (db.rate_hz * secs)).abs() < 1e-6);
        }
    }
}
