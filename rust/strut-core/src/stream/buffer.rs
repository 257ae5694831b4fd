//! A jitter buffer: frames are delayed a little so that most late or reordered frames still arrive in time.
//!
//! With s the time at which a frame was sent and a that of its arrival, o = least a − s of the last seconds is the offset of
//! the clocks plus the shortest transit; l = a − s − o is the lateness of a frame. At time τ the motion at τ − o − D is
//! played. The delay D = period + p95(l) rises at once and falls slowly.

use crate::humanoid::Pose;
use crate::math::exp_map::{exp, log};
use std::collections::VecDeque;

/// Longest delay, seconds.
pub const MAX_DELAY_SECS: f64 = 0.2;
/// Windows over which the least transit and the lateness are measured, seconds.
const TRANSIT_WINDOW_SECS: f64 = 4.0;
const LATENESS_WINDOW_SECS: f64 = 2.0;
/// Share of the frames that should arrive in time.
const IN_TIME: f64 = 0.95;
/// Rate at which the delay falls, seconds per second: motion that is half a percent too fast is not noticeable.
const DELAY_FALL: f64 = 0.005;
/// Time over which motion is extrapolated with its last velocity, seconds; then it is held.
const EXTRAPOLATED_SECS: f64 = 0.05;
/// After this time without a frame the stream is lost, seconds.
const LOST_SECS: f64 = 0.5;
/// If the offset of a sender's clock changes by more than this, the clock was reset, seconds.
const CLOCK_JUMP_SECS: f64 = 1.0;
/// Number of successive frames that must agree on the new offset, and their tolerance: a single wrong time is not a reset.
const CLOCK_FRAMES: usize = 3;
const SAME_CLOCK_SECS: f64 = 0.25;
/// Frames closer to each other than this are dropped, seconds: 240 Hz with tolerance for clocks in whole milliseconds.
const LEAST_STEP_SECS: f64 = 0.9 / 240.0;
/// Capacities for frames and arrivals, larger than either window needs at 240 Hz.
const MOST_FRAMES: usize = 256;
const MOST_ARRIVALS: usize = 1200;
/// Assumed period before two frames have arrived, seconds.
const FIRST_PERIOD_SECS: f64 = 1.0 / 60.0;

/// Delay of the frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Delay {
    /// Adapts to the jitter of the stream.
    Auto,
    /// A fixed delay, seconds; clamped to 0 … [`MAX_DELAY_SECS`].
    Fixed(f64),
}

/// Result of pushing a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrival {
    /// It arrived in time.
    InTime,
    /// Its time had already been played.
    Late,
    /// Its time equals another's or is so near to it that the rate would exceed 240 Hz; or its time is far from all others'.
    Dropped,
    /// It starts a stream: the first one, or the first after a loss or a reset of the sender's clock.
    Begins,
}

/// Source of a played pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Play {
    /// Interpolated between frames before and after.
    Interpolated,
    /// Extrapolated from the newest frames.
    Extrapolated,
    /// No frame has arrived for a while: the last pose is held.
    Held,
    /// No frame has arrived for half a second.
    Lost,
}

/// The motion at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Played {
    /// The pose.
    pub pose: Pose,
    /// Source of the pose.
    pub play: Play,
    /// Time when it was sent, on the sender's clock, seconds.
    pub sent_secs: f64,
    /// Earliest time when it could have been played, on the receiver's clock, seconds.
    pub due_secs: f64,
    /// Whether it is discontinuous with the pose played before.
    pub begins: bool,
}

/// Counts since the buffer was created.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BufferStats {
    /// Accepted frames, late ones included.
    pub taken: u64,
    /// Accepted frames whose time had already been played.
    pub late: u64,
    /// Dropped frames: too near to another one, or with a time far from all others'.
    pub dropped: u64,
    /// Frames that never arrived, inferred from the sender's times.
    pub missing: u64,
    /// Streams that ended: lost, or interrupted by a reset of the sender's clock.
    pub losses: u64,
}

#[derive(Clone, Copy, Debug)]
struct Frame {
    sent_secs: f64,
    pose: Pose,
}

/// See the module documentation. Frames may be pushed in any order; nothing is allocated after construction.
#[derive(Clone, Debug)]
pub struct JitterBuffer {
    fixed: Option<f64>,
    /// Frames that are still needed, sorted by time.
    frames: VecDeque<Frame>,
    /// Time of arrival and transit a − s of recent frames.
    arrivals: VecDeque<[f64; 2]>,
    scratch: Vec<f64>,
    /// Transit of the last frames with another offset, and their number.
    off: Option<(f64, usize)>,
    /// o in the module documentation.
    least_transit: f64,
    period_secs: f64,
    delay_secs: f64,
    /// The delay that is aimed at.
    wanted_secs: f64,
    /// Time of the last call of `at`.
    asked_secs: Option<f64>,
    /// Time on the sender's clock up to which motion has been played.
    head_secs: Option<f64>,
    last: Option<Played>,
    begins: bool,
    stats: BufferStats,
}

impl JitterBuffer {
    /// Creates an empty buffer.
    pub fn new(delay: Delay) -> Self {
        let fixed = match delay {
            Delay::Auto => None,
            Delay::Fixed(secs) if secs.is_nan() => None,
            Delay::Fixed(secs) => Some(secs.clamp(0.0, MAX_DELAY_SECS)),
        };
        let first = fixed.unwrap_or(FIRST_PERIOD_SECS);
        Self {
            fixed,
            frames: VecDeque::with_capacity(MOST_FRAMES + 1),
            arrivals: VecDeque::with_capacity(MOST_ARRIVALS + 1),
            scratch: Vec::with_capacity(MOST_ARRIVALS + 1),
            off: None,
            least_transit: 0.0,
            period_secs: FIRST_PERIOD_SECS,
            delay_secs: first,
            wanted_secs: first,
            asked_secs: None,
            head_secs: None,
            last: None,
            begins: false,
            stats: BufferStats::default(),
        }
    }

    /// Adds a frame with the time at which it was sent, on any clock, and that of its arrival, seconds. Frames with a time
    /// that is not finite are dropped.
    pub fn push(&mut self, sent_secs: f64, arrived_secs: f64, pose: &Pose) -> Arrival {
        let transit = arrived_secs - sent_secs;
        if !transit.is_finite() {
            self.stats.dropped += 1;
            return Arrival::Dropped;
        }
        let is_lost = self.head_secs.is_some() && self.last.is_some_and(|last| last.play == Play::Lost);
        let is_first = self.frames.is_empty();
        let is_off = !is_first && !is_lost && (transit - self.least_transit).abs() > CLOCK_JUMP_SECS;
        if is_off && !self.clock_is_set(transit) {
            self.stats.dropped += 1;
            return Arrival::Dropped;
        }
        self.off = None;
        let begins = is_first || is_lost || is_off;
        if begins {
            self.stats.losses += u64::from(!is_first);
            self.begin();
        }
        let at = self.frames.partition_point(|frame| frame.sent_secs < sent_secs);
        let is_near = |frame: Option<&Frame>| frame.is_some_and(|f| (f.sent_secs - sent_secs).abs() < LEAST_STEP_SECS);
        if is_near(self.frames.get(at)) || at.checked_sub(1).is_some_and(|i| is_near(self.frames.get(i))) {
            self.stats.dropped += 1;
            return Arrival::Dropped;
        }
        self.measure(arrived_secs, transit);
        self.count_missing(at, sent_secs);
        self.frames.insert(at, Frame { sent_secs, pose: *pose });
        if self.frames.len() > MOST_FRAMES {
            self.frames.pop_front();
        }
        self.stats.taken += 1;
        let is_late = self.head_secs.is_some_and(|head| sent_secs <= head);
        self.stats.late += u64::from(is_late);
        match (begins, is_late) {
            (true, _) => Arrival::Begins,
            (_, true) => Arrival::Late,
            _ => Arrival::InTime,
        }
    }

    /// Returns the motion to show at a time on the receiver's clock, seconds; it never runs backwards. `None` before the
    /// first frame.
    pub fn at(&mut self, now_secs: f64) -> Option<Played> {
        let passed = self.asked_secs.map_or(0.0, |before| (now_secs - before).max(0.0));
        self.asked_secs = Some(now_secs);
        self.delay_secs = self.wanted_secs.max(self.delay_secs - DELAY_FALL * passed);
        let (Some(first), Some(newest)) = (self.frames.front(), self.frames.back()) else {
            return self.lost();
        };
        let newest_secs = newest.sent_secs;
        let playing = now_secs - self.least_transit - self.delay_secs;
        if self.head_secs.is_none() && playing < first.sent_secs {
            return self.lost();
        }
        let head = self.head_secs.map_or(playing, |before| playing.max(before));
        self.head_secs = Some(head);
        while self.frames.len() > 2 && self.frames[1].sent_secs <= head {
            self.frames.pop_front();
        }
        let beyond = head - newest_secs;
        let play = match beyond {
            b if b <= 0.0 => Play::Interpolated,
            b if b <= EXTRAPOLATED_SECS => Play::Extrapolated,
            b if b <= LOST_SECS => Play::Held,
            _ => Play::Lost,
        };
        let due_secs = head + self.least_transit;
        let begins = std::mem::take(&mut self.begins);
        let played = Played { pose: self.pose_at(head), play, sent_secs: head, due_secs, begins };
        self.last = Some(played);
        self.last
    }

    /// The current delay, seconds.
    pub fn delay_secs(&self) -> f64 {
        self.delay_secs
    }

    /// Period of the frames as sent, seconds.
    pub fn period_secs(&self) -> f64 {
        self.period_secs
    }

    /// Counts since the buffer was made.
    pub fn stats(&self) -> BufferStats {
        self.stats
    }

    /// Whether enough successive frames agree on a new offset of the sender's clock.
    fn clock_is_set(&mut self, transit: f64) -> bool {
        let agreeing = self.off.filter(|(before, _)| (transit - before).abs() < SAME_CLOCK_SECS);
        let frames = agreeing.map_or(1, |(_, frames)| frames + 1);
        self.off = Some((transit, frames));
        frames >= CLOCK_FRAMES
    }

    fn begin(&mut self) {
        self.frames.clear();
        self.arrivals.clear();
        self.head_secs = None;
        self.begins = true;
    }

    /// The last played motion while no stream is playing.
    fn lost(&mut self) -> Option<Played> {
        self.last = self.last.map(|last| Played { play: Play::Lost, begins: false, ..last });
        self.last
    }

    /// Counts the frames missing between a new newest frame and the one before it.
    fn count_missing(&mut self, at: usize, sent_secs: f64) {
        if at < self.frames.len() {
            // A frame that was counted as missing has arrived late.
            self.stats.missing = self.stats.missing.saturating_sub(1);
        } else if let Some(before) = self.frames.back() {
            let periods = ((sent_secs - before.sent_secs) / self.period_secs).round();
            self.stats.missing += (periods as u64).saturating_sub(1);
        }
    }

    /// Updates the least transit, the period and the target delay after an arrival.
    fn measure(&mut self, arrived_secs: f64, transit: f64) {
        self.arrivals.push_back([arrived_secs, transit]);
        let is_old = |[arrived, _]: &[f64; 2]| *arrived < arrived_secs - TRANSIT_WINDOW_SECS;
        while self.arrivals.len() > MOST_ARRIVALS || self.arrivals.front().is_some_and(is_old) {
            self.arrivals.pop_front();
        }
        self.least_transit = self.arrivals.iter().map(|[_, transit]| *transit).fold(f64::INFINITY, f64::min);

        let recent = |[arrived, _]: &&[f64; 2]| *arrived >= arrived_secs - LATENESS_WINDOW_SECS;
        self.scratch.clear();
        self.scratch.extend(self.arrivals.iter().filter(recent).map(|[arrived, transit]| arrived - transit));
        self.scratch.sort_unstable_by(f64::total_cmp);
        for i in (1..self.scratch.len()).rev() {
            self.scratch[i] -= self.scratch[i - 1];
        }
        if let Some(period) = quantile(self.scratch.get_mut(1..).unwrap_or_default(), 0.5) {
            self.period_secs = period;
        }
        self.scratch.clear();
        self.scratch.extend(self.arrivals.iter().filter(recent).map(|[_, transit]| transit - self.least_transit));
        let lateness = quantile(&mut self.scratch, IN_TIME).unwrap_or(0.0);
        self.wanted_secs = self.fixed.unwrap_or((self.period_secs + lateness).clamp(0.0, MAX_DELAY_SECS));
        self.delay_secs = self.delay_secs.max(self.wanted_secs);
    }

    /// The pose at a time; beyond the newest frame it is extrapolated briefly.
    fn pose_at(&self, secs: f64) -> Pose {
        let after = self.frames.partition_point(|frame| frame.sent_secs < secs);
        match (after.checked_sub(1).and_then(|i| self.frames.get(i)), self.frames.get(after)) {
            (Some(a), Some(b)) => {
                let t = (secs - a.sent_secs) / (b.sent_secs - a.sent_secs);
                a.pose.lerp(&b.pose, t as f32)
            }
            (None, Some(only)) => only.pose,
            (Some(newest), None) => match after.checked_sub(2).and_then(|i| self.frames.get(i)) {
                Some(before) => extrapolated(before, newest, secs),
                None => newest.pose,
            },
            (None, None) => Pose::default(),
        }
    }
}

/// Extrapolates the motion of two frames.
fn extrapolated(before: &Frame, newest: &Frame, secs: f64) -> Pose {
    let step = newest.sent_secs - before.sent_secs;
    if step > EXTRAPOLATED_SECS + MAX_DELAY_SECS {
        return newest.pose;
    }
    let share = ((secs - newest.sent_secs).min(EXTRAPOLATED_SECS) / step) as f32;
    let mut pose = newest.pose;
    pose.root += (newest.pose.root - before.pose.root) * share;
    for (q, earlier) in pose.rotations.iter_mut().zip(&before.pose.rotations) {
        *q = exp(log(*q * earlier.inverse()) * share) * *q;
    }
    pose
}

/// The quantile of the numbers at a share.
fn quantile(numbers: &mut [f64], share: f64) -> Option<f64> {
    let last = numbers.len().checked_sub(1)?;
    let at = (share * last as f64).ceil() as usize;
    Some(*numbers.select_nth_unstable_by(at, f64::total_cmp).1)
}

#[cfg(test)]
mod tests;
