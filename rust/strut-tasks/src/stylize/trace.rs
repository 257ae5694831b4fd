//! `stylize --trace`: how every frame was computed, as JSON lines.

use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;
use strut_core::catalogue::Catalogue;
use strut_core::database::Class;
use strut_core::transfer::{Stage, StageClock, StyledFrame, Trace};

/// Class weights below this are omitted as negligible.
const MIN_WEIGHT: f32 = 1e-4;

/// One line of the trace.
#[derive(Serialize)]
struct Line<'a> {
    /// Number of the input frame at the database's rate.
    frame: usize,
    /// Seconds since the first frame on the input's time axis.
    time_in: f64,
    /// Seconds since the first frame on the output's time axis.
    time_out: f64,
    /// Output time since the previous frame, seconds.
    dt: f32,
    /// Weight of every class that took part, by "action/style".
    class_weights: BTreeMap<&'a str, f32>,
    /// Clip, frame in the clip and distance (metres) of the neighbours in the class with the greatest weight, nearest
    /// first.
    neighbours: Vec<(&'a str, usize, f32)>,
    /// Largest bias of a degree of freedom in standard deviations.
    bias: f32,
    /// Probability of contact of the left and the right foot.
    contact: [f32; 2],
    /// Microseconds by stage.
    cost_us: BTreeMap<&'static str, f64>,
}

/// Returns "action/style" of every class of a database.
pub fn class_names(db: &Catalogue) -> Vec<String> {
    let name = |c: &Class| format!("{}/{}", db.actions[usize::from(c.action)], db.styles[usize::from(c.style)]);
    db.classes().iter().map(name).collect()
}

/// Collects the lines of a clip.
pub struct TraceLog<'a> {
    db: &'a Catalogue,
    /// See [`class_names`].
    classes: &'a [String],
    lines: Vec<Line<'a>>,
}

impl<'a> TraceLog<'a> {
    /// Creates an empty log for a database with these classes.
    pub fn new(db: &'a Catalogue, classes: &'a [String]) -> Self {
        Self { db, classes, lines: Vec::new() }
    }

    /// Adds a frame.
    pub fn push(&mut self, trace: &Trace<'_>, cost_us: BTreeMap<&'static str, f64>) {
        let weights = self.classes.iter().map(String::as_str).zip(trace.class_weights.iter().copied());
        let neighbours = trace.neighbours().map(|n| (self.db.clips[n.clip].name.as_str(), n.frame, n.distance));
        self.lines.push(Line {
            frame: self.lines.len(),
            time_in: trace.frame.time_in_secs,
            time_out: trace.frame.time_out_secs,
            dt: trace.frame.dt_secs,
            class_weights: weights.filter(|(_, w)| *w >= MIN_WEIGHT).collect(),
            neighbours: neighbours.collect(),
            bias: trace.bias,
            contact: trace.frame.contact,
            cost_us,
        });
    }

    /// Returns the lines as text, with the contacts of the finished frames.
    ///
    /// # Errors
    /// If a value cannot be written as JSON.
    pub fn into_json_lines(self, finished: &[StyledFrame]) -> serde_json::Result<Vec<u8>> {
        let mut out = Vec::new();
        for (mut line, frame) in self.lines.into_iter().zip(finished) {
            line.contact = frame.contact;
            serde_json::to_writer(&mut out, &line)?;
            out.push(b'\n');
        }
        Ok(out)
    }
}

/// Measures the time of the stages of a frame.
pub struct StageTimer {
    last: Instant,
    cost_us: BTreeMap<&'static str, f64>,
}

impl Default for StageTimer {
    fn default() -> Self {
        Self { last: Instant::now(), cost_us: BTreeMap::new() }
    }
}

impl StageTimer {
    /// Returns and clears the microseconds by stage of the last frame.
    pub fn take(&mut self) -> BTreeMap<&'static str, f64> {
        std::mem::take(&mut self.cost_us)
    }
}

impl StageClock for StageTimer {
    fn start(&mut self) {
        self.last = Instant::now();
    }

    fn end(&mut self, stage: Stage) {
        let now = Instant::now();
        self.cost_us.insert(stage.name(), (now - self.last).as_secs_f64() * 1e6);
        self.last = now;
    }
}
