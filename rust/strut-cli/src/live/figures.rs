//! Statistics of a stream.

use serde::Serialize;
use std::fmt::{self, Display};

/// Width of the latency bins, seconds, and their number: half a second in total.
const BIN_SECS: f64 = 1e-4;
const BINS: usize = 5000;

/// Statistics of a stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub(super) struct Figures {
    pub(super) secs: f64,
    /// Number of frames received from the performer, and their rate while frames arrived.
    pub(super) frames_in: u64,
    pub(super) hz: f64,
    /// Number of styled frames sent.
    pub(super) frames_out: u64,
    /// Percentage of the frames that were late.
    pub(super) late_percent: f64,
    /// Percentage of the frames that never arrived complete.
    pub(super) lost_percent: f64,
    /// Number of frames of the present performer that were dropped because a part was lost.
    pub(super) frames_partial: u64,
    /// Number of times that the performer was lost.
    pub(super) losses: u64,
    /// Number of packets that were invalid Open Sound Control or beyond its limits, of messages with wrong arguments,
    /// and of packets from other performers.
    pub(super) packets_refused: u64,
    pub(super) messages_dropped: u64,
    pub(super) packets_of_others: u64,
    /// Delay of the buffer.
    pub(super) buffer_ms: f64,
    /// Time from the earliest moment at which a frame could have been displayed until it was sent.
    pub(super) latency_ms: Spread,
    /// Part of it for the computation of a frame.
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

/// Counts durations in bins: percentiles of any number of them in constant memory.
pub(super) struct Histogram {
    counts: Vec<u64>,
}

impl Default for Histogram {
    fn default() -> Self {
        Self { counts: vec![0; BINS] }
    }
}

impl Histogram {
    /// Counts a duration, seconds. Durations beyond the bins are counted in the last one.
    pub(super) fn count(&mut self, secs: f64) {
        let bin = ((secs.max(0.0) / BIN_SECS) as usize).min(BINS - 1);
        self.counts[bin] += 1;
    }

    /// Returns percentiles in milliseconds; 0 without samples.
    pub(super) fn spread(&self) -> Spread {
        Spread { p50: self.below(0.5), p95: self.below(0.95) }
    }

    /// Returns the middle of the bin up to which this share of all durations lies.
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
