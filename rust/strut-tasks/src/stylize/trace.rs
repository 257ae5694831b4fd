//! `stylize --trace`: how every frame was computed, as JSON lines.

use serde::Serialize;
use std::collections::BTreeMap;
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, Write};
use std::time::Instant;
use strut_core::catalogue::Catalogue;
use strut_core::database::Class;
use strut_core::transfer::{Stage, StageClock, StyledFrame, Trace};

/// Class weights below this are omitted as negligible.
const MIN_WEIGHT: f32 = 1e-4;

/// The fields of a line that are known when its frame is styled. The contacts, which foot planting changes at the end of
/// the clip, and the cost follow them.
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
}

/// Returns "action/style" of every class of a database.
pub fn class_names(db: &Catalogue) -> Vec<String> {
    let name = |c: &Class| format!("{}/{}", db.actions[usize::from(c.action)], db.styles[usize::from(c.style)]);
    db.classes().iter().map(name).collect()
}

/// A temporary file, or bytes in memory.
pub trait Spool: Read + Write + Seek + Send {}

impl<T: Read + Write + Seek + Send> Spool for T {}

/// Collects the lines of a clip in a temporary file, since the trace of a long clip is larger than the clip.
pub struct TraceLog<'a> {
    db: &'a Catalogue,
    /// See [`class_names`].
    classes: &'a [String],
    /// Two lines per frame: the [`Line`], and the microseconds by stage.
    spool: BufWriter<Box<dyn Spool + 'a>>,
    frames: usize,
}

impl<'a> TraceLog<'a> {
    /// Creates an empty log for a database with these classes. The spool is empty.
    pub fn new(db: &'a Catalogue, classes: &'a [String], spool: impl Spool + 'a) -> Self {
        Self { db, classes, spool: BufWriter::new(Box::new(spool)), frames: 0 }
    }

    /// Adds a frame.
    ///
    /// # Errors
    /// If the spool cannot be written.
    pub fn push(&mut self, trace: &Trace<'_>, cost_us: &BTreeMap<&'static str, f64>) -> io::Result<()> {
        let weights = self.classes.iter().map(String::as_str).zip(trace.class_weights.iter().copied());
        let neighbours = trace.neighbours().map(|n| (self.db.clips[n.clip].name.as_str(), n.frame, n.distance));
        let line = Line {
            frame: self.frames,
            time_in: trace.frame.time_in_secs,
            time_out: trace.frame.time_out_secs,
            dt: trace.frame.dt_secs,
            class_weights: weights.filter(|(_, w)| *w >= MIN_WEIGHT).collect(),
            neighbours: neighbours.collect(),
            bias: trace.bias,
        };
        self.frames += 1;
        serde_json::to_writer(&mut self.spool, &line)?;
        self.spool.write_all(b"\n")?;
        serde_json::to_writer(&mut self.spool, cost_us)?;
        self.spool.write_all(b"\n")
    }

    /// Writes the lines, with the contacts of the finished frames.
    ///
    /// # Errors
    /// If the spool cannot be read or the target cannot be written.
    pub fn write_json_lines(self, finished: &[StyledFrame], out: &mut dyn Write) -> io::Result<()> {
        let mut spool = self.spool.into_inner().map_err(io::IntoInnerError::into_error)?;
        spool.rewind()?;
        let mut parts = BufReader::new(spool).lines();
        for frame in finished {
            let (Some(line), Some(cost_us)) = (parts.next(), parts.next()) else { break };
            let (line, cost_us) = (line?, cost_us?);
            let fields = line.strip_suffix('}').unwrap_or(&line);
            writeln!(out, r#"{fields},"contact":{},"cost_us":{cost_us}}}"#, serde_json::to_string(&frame.contact)?)?;
        }
        Ok(())
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
