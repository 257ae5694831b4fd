//! Key poses of a drill, and the interpolation between them.
//!
//! Between two poses at rest every quantity follows a minimum-jerk profile (Flash & Hogan 1985, "The coordination of
//! arm movements"): its speed is bell-shaped. At a pose that is passed without rest, speed is continuous. A body in the
//! air is in free fall.

use crate::forms::{Arm, Swing};
use crate::jet::quintic_weights;
use crate::pelvis::GRAVITY;
use strut_core::math::interpolation::monotone_slope;

/// Posture of the pelvis and the trunk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Body {
    /// Displacement of the pelvis to the left of its standing position, metres.
    pub(crate) aside: f32,
    /// Displacement of the pelvis ahead of its standing position, metres.
    pub(crate) ahead: f32,
    /// Displacement of the pelvis below its standing position, metres.
    pub(crate) drop: f32,
    /// Turn of the pelvis to the left, degrees.
    pub(crate) yaw: f32,
    /// Forward tilt of the pelvis, degrees.
    pub(crate) pitch: f32,
    /// Turn of the chest to the left of the pelvis, degrees.
    pub(crate) chest_yaw: f32,
    /// Forward bend of the chest against the pelvis, degrees.
    pub(crate) bend: f32,
}

/// Posture of a foot.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foot {
    /// Displacement of the ankle outward from its standing position, metres.
    pub(crate) out: f32,
    /// Displacement of the ankle ahead of its standing position, metres.
    pub(crate) ahead: f32,
    /// Height of the ankle above its height on the ground, or above its hanging height in the air, metres.
    pub(crate) lift: f32,
    /// Toes up, degrees.
    pub(crate) pitch: f32,
    /// Rotation of the foot's position about the middle of the stance, degrees to the left.
    pub(crate) turn: f32,
}

/// A pose of the whole body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Key {
    /// Time since the previous key in a neutral performance, seconds. After a take-off gravity determines it.
    pub(crate) secs: f32,
    /// Whether the body is in the air from this key to the next.
    pub(crate) airborne: bool,
    pub(crate) body: Body,
    /// Left and right.
    pub(crate) arms: [Arm; 2],
    /// Left and right.
    pub(crate) feet: [Foot; 2],
    /// Swing of the left and the right leg. If set, it determines the position of the foot.
    pub(crate) swings: [Option<Swing>; 2],
}

/// Number of quantities of a key.
pub(crate) const CHANNELS: usize = 25;
const AHEAD: usize = 1;
const DROP: usize = 2;
/// Indices of the feet's first quantities.
const FEET: [usize; 2] = [15, 20];

impl Key {
    /// All quantities as an array.
    pub(crate) fn channels(&self) -> [f32; CHANNELS] {
        let b = &self.body;
        let mut out = [0.0; CHANNELS];
        out[..7].copy_from_slice(&[b.aside, b.ahead, b.drop, b.yaw, b.pitch, b.chest_yaw, b.bend]);
        for (to, a) in out[7..15].chunks_exact_mut(4).zip(&self.arms) {
            to.copy_from_slice(&[a.flexion, a.spread, a.twist, a.elbow]);
        }
        for (at, f) in FEET.into_iter().zip(&self.feet) {
            out[at..at + 5].copy_from_slice(&[f.out, f.ahead, f.lift, f.pitch, f.turn]);
        }
        out
    }

    /// The key with these quantities.
    pub(crate) fn with_channels(self, v: &[f32; CHANNELS]) -> Self {
        let arm = |i: usize| Arm { flexion: v[i], spread: v[i + 1], twist: v[i + 2], elbow: v[i + 3] };
        let foot = |i: usize| Foot { out: v[i], ahead: v[i + 1], lift: v[i + 2], pitch: v[i + 3], turn: v[i + 4] };
        let [aside, ahead, drop, yaw, pitch, chest_yaw, bend, ..] = *v;
        Self {
            body: Body { aside, ahead, drop, yaw, pitch, chest_yaw, bend },
            arms: [arm(7), arm(11)],
            feet: FEET.map(foot),
            ..self
        }
    }

    /// Mirror image of the key.
    pub(crate) fn mirrored(self) -> Self {
        let Body { aside, yaw, chest_yaw, .. } = self.body;
        let [left, right] = self.feet.map(|foot| Foot { turn: -foot.turn, ..foot });
        Self {
            body: Body { aside: -aside, yaw: -yaw, chest_yaw: -chest_yaw, ..self.body },
            arms: [self.arms[1], self.arms[0]],
            feet: [right, left],
            swings: [self.swings[1], self.swings[0]],
            ..self
        }
    }
}

/// A key at its time, with the time derivatives of its quantities.
#[derive(Clone, Copy, Debug)]
struct Instant {
    secs: f32,
    /// Whether a flight starts or ends here.
    ballistic: bool,
    values: [f32; CHANNELS],
    speeds: [f32; CHANNELS],
}

/// The flight at a moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight {
    /// Seconds since take-off and until landing.
    pub(crate) since: f32,
    /// See `since`.
    pub(crate) left: f32,
    /// Speed at which the body leaves the ground and lands, m/s.
    pub(crate) take_off: f32,
    /// See `take_off`.
    pub(crate) landing: f32,
}

impl Flight {
    /// Height of the body above the straight line between take-off and landing.
    pub(crate) fn height(&self) -> f32 {
        0.5 * GRAVITY * self.since * self.left
    }
}

/// Key poses on a time line. A flight is a take-off key, one key at its top, and a landing key.
#[derive(Clone, Debug)]
pub(crate) struct Timeline {
    keys: Vec<Key>,
    instants: Vec<Instant>,
}

impl Timeline {
    /// Places keys at their times; the first at 0. `rise` is the height of the flight that starts with key `i`, metres.
    pub(crate) fn new(keys: Vec<Key>, rise: impl Fn(usize) -> f32) -> Self {
        let mut secs = 0.0;
        let mut instants: Vec<Instant> = Vec::with_capacity(keys.len());
        for (i, key) in keys.iter().enumerate() {
            if i > 0 {
                secs += match flight_keys(&keys, i - 1) {
                    Some([from, top, to]) => {
                        let fall = if i == top { 0.0 } else { keys[to].body.drop - keys[from].body.drop };
                        (2.0 * (rise(from) + fall).max(0.0) / GRAVITY).sqrt()
                    }
                    None => key.secs,
                };
            }
            instants.push(Instant { secs, ballistic: false, values: key.channels(), speeds: [0.0; CHANNELS] });
        }
        for i in 1..instants.len().saturating_sub(1) {
            instants[i].speeds = passing_speeds(&instants[i - 1], &instants[i], &instants[i + 1]);
        }
        for i in 0..keys.len() {
            let Some([from, top, to]) = flight_keys(&keys, i).filter(|f| f[0] == i) else { continue };
            let [t0, t1, t2] = [from, top, to].map(|k| instants[k].secs);
            let forward = (instants[to].values[AHEAD] - instants[from].values[AHEAD]) / (t2 - t0);
            for k in [from, to] {
                instants[k].ballistic = true;
                instants[k].speeds[AHEAD] = forward;
                instants[k].speeds[DROP] = GRAVITY * (instants[k].secs - t1);
            }
        }
        Self { keys, instants }
    }

    /// Time of the last key, seconds.
    pub(crate) fn secs(&self) -> f32 {
        self.instants.last().map_or(0.0, |i| i.secs)
    }

    /// Time of a phase, which counts keys, seconds.
    pub(crate) fn secs_at(&self, phase: f32) -> f32 {
        let i = (phase.max(0.0) as usize).min(self.instants.len().saturating_sub(2));
        let (a, b) = (self.instants[i].secs, self.instants[i + 1].secs);
        a + (b - a) * (phase - i as f32)
    }

    /// Pose at a time, its phase (index of the last key plus the fraction of the interval to the next), the flight it
    /// belongs to, and whether each foot is planted.
    pub(crate) fn at(&self, secs: f32) -> (Key, f32, Option<Flight>, [bool; 2]) {
        let next = self.instants.partition_point(|i| i.secs <= secs).clamp(1, self.instants.len() - 1);
        let i = next - 1;
        let (a, b) = (&self.instants[i], &self.instants[next]);
        let span = b.secs - a.secs;
        let t = ((secs - a.secs) / span).clamp(0.0, 1.0);
        let flight = flight_keys(&self.keys, i).map(|[from, top, to]| {
            let [from, top, to] = [from, top, to].map(|k| self.instants[k].secs);
            Flight {
                since: secs - from,
                left: to - secs,
                take_off: GRAVITY * (top - from),
                landing: GRAVITY * (to - top),
            }
        });
        let mut values: [f32; CHANNELS] = std::array::from_fn(|c| {
            // Before take-off and after landing the body has the acceleration of the flight, so that it is continuous.
            let fall = |of: &Instant| if c == DROP && of.ballistic { GRAVITY } else { 0.0 };
            let from = [a.values[c], a.speeds[c] * span, fall(a) * span * span];
            quintic(from, [b.values[c], b.speeds[c] * span, fall(b) * span * span], t)
        });
        if let (Some(flight), Some([from, _, to])) = (flight, flight_keys(&self.keys, i)) {
            let share = flight.since / (flight.since + flight.left);
            let line = |c: usize| {
                let (a, b) = (self.instants[from].values[c], self.instants[to].values[c]);
                a + (b - a) * share
            };
            values[AHEAD] = line(AHEAD);
            values[DROP] = line(DROP) - flight.height();
        }
        let stands = FEET.map(|foot| {
            let still = |c: usize| a.values[c] == b.values[c];
            flight.is_none()
                && still(foot)
                && still(foot + 1)
                && still(foot + 4)
                && a.values[foot + 2] == 0.0
                && b.values[foot + 2] == 0.0
        });
        (self.keys[i].with_channels(&values), i as f32 + t, flight, stands)
    }
}

/// Take-off, top and landing of the flight that contains the interval from key `i` to the next.
fn flight_keys(keys: &[Key], i: usize) -> Option<[usize; 3]> {
    if !keys[i].airborne {
        return None;
    }
    let from = if i > 0 && keys[i - 1].airborne { i - 1 } else { i };
    (from + 2 < keys.len()).then_some([from, from + 1, from + 2])
}

/// Speeds at which a key is passed: zero at an extreme (Fritsch & Butland 1984).
fn passing_speeds(a: &Instant, b: &Instant, c: &Instant) -> [f32; CHANNELS] {
    std::array::from_fn(|i| {
        let before = (b.values[i] - a.values[i]) / (b.secs - a.secs);
        let after = (c.values[i] - b.values[i]) / (c.secs - b.secs);
        monotone_slope(before, after)
    })
}

/// Quintic from a value, speed and acceleration to another three; `t` in [0, 1].
pub(crate) fn quintic(from: [f32; 3], to: [f32; 3], t: f32) -> f32 {
    let [[_, v0, a0], [p1, v1, a1]] = quintic_weights(t);
    from[0] + (to[0] - from[0]) * p1 + from[1] * v0 + from[2] * a0 + to[2] * a1 + to[1] * v1
}
