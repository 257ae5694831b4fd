//! Figures of a stream.

use serde::Serialize;
use std::fmt::{self, Display};

/// Width of the bins of latencies, and their number: half a second.
const BIN_SECS: f64 = 1e-4;
const BINS: usize = 5000;

/// How a stream goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Figures {
    pub(super) secs: f64,
    /// Frames taken from the performer, and how many a second while there were some.
    pub(super) frames_in: u64,
    pub(super) hz: f64,
    /// Styled frames sent.
    pub(super) frames_out: u64,
    /// Share of the frames that came after their time.
    pub(super) late_percent: f64,
    /// Share of the frames that never came whole.
    pub(super) lost_percent: f64,
    /// Frames of the present performer that were dropped because a part of them was lost.
    pub(super) frames_partial: u64,
    /// Times that the performer was lost.
    pub(super) losses: u64,
    /// Packets that were not Open Sound Control or beyond its limits, messages with wrong arguments, and packets of others
    /// than the performer.
    pub(super) packets_refused: u64,
    pub(super) messages_dropped: u64,
    pub(super) packets_of_others: u64,
    /// How long frames wait.
    pub(super) buffer_ms: f64,
    /// From when a frame could have been shown at the earliest until it was sent on.
    pub(super) latency_ms: Spread,
    /// Of which computing a frame.
    pub(super) computing_ms: Spread,
}

/// Median and 95th percentile.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Spread {
    pub(super) p50: f64,
    pub(super) p95: f64,
}

impl Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{:.1} Hz, {:.1} % late, {:.1} % lost, buffer {:.0} ms, latency {:.0} ms (95 %: {:.0})",
            self.hz, self.late_percent, self.lost_percent, self.buffer_ms, self.latency_ms.p50, self.latency_ms.p95
        )
    }
}

/// Counts times by their length: percentiles of any number of them in the same memory.
pub(super) struct Histogram {
    counts: Vec<u64>,
}

impl Default for Histogram {
    fn default() -> Self {
        Self { counts: vec![0; BINS] }
    }
}

impl Histogram {
    /// Counts a time, seconds; longer ones than there are bins for are in the last one.
    pub(super) fn count(&mut self, secs: f64) {
        let bin = ((secs.max(0.0) / BIN_SECS) as usize).min(BINS - 1);
        self.counts[bin] += 1;
    }

    /// Percentiles in milliseconds; 0 without times.
    pub(super) fn spread(&self) -> Spread {
        Spread { p50: self.below(0.5), p95: self.below(0.95) }
    }

    /// The middle of the bin in which a share of all times lies below.
    fn below(&self, share: f64) -> f64 {
        let wanted = share * self.counts.iter().sum::<u64>() as f64;
        let mut sum = 0;
        let bin = self.counts.iter().position(|count| {
            sum += count;
            *count > 0 && sum as f64 >= wanted
        });
        bin.map_or(0.0, |bin| 1000.0 * BIN_SECS * (bin as f64 + 0.5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_those_of_the_times() {
        let mut histogram = Histogram::default();
        assert_eq!(histogram.spread(), Spread::default());
        for i in 0..1000 {
            histogram.count(f64::from(i) * 1e-5);
        }
        histogram.count(7.0);
        let Spread { p50, p95 } = histogram.spread();
        assert!((p50 - 5.0).abs() < 0.11 && (p95 - 9.5).abs() < 0.11, "{p50} {p95}");
    }
}
