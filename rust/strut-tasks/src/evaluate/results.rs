//! Samples, their means, and tables of the means.

use super::choices::Part;
use super::settings::{Build, Grid, Setting};
use crate::error::{Code, Outcome, TaskError};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use strut_core::database::build::BuildOptions;
use strut_core::transfer::BodyPart;
use strut_evaluation::quality::Quality;
use strut_formats::GENERATOR;

/// Values whose standard deviation over the samples is reported.
const SPREAD: [&str; 5] =
    ["pose_error_cm", "timing_error_ms", "velocity_error_cm_s", "style_progress", "take_progress"];

/// Title, name of the value, number of decimals.
type Column = (&'static str, &'static str, usize);

const CROSS_VALIDATION_COLUMNS: &[Column] = &[
    ("pose cm", "pose_error_cm", 3),
    ("timing ms", "timing_error_ms", 1),
    ("velocity cm/s", "velocity_error_cm_s", 1),
    ("skate in", "skate_cm_s_in", 2),
    ("out cm/s", "skate_cm_s_out", 2),
    ("acceleration ×", "acceleration_ratio", 2),
    ("content", "content_correlation", 2),
    ("ms/frame", "ms_per_frame", 2),
];
const OFF_DATABASE_COLUMNS: &[Column] = &[
    ("acceleration ×", "acceleration_ratio", 2),
    ("content", "content_correlation", 2),
    ("distance cm", "distance_cm", 1),
    ("jerk ×", "jerk_ratio", 2),
    ("skate in", "skate_cm_s_in", 2),
    ("out cm/s", "skate_cm_s_out", 2),
    ("worse skate %", "worse_skate_percent", 0),
    ("sole depth cm", "sole_depth_cm", 2),
    ("beyond anatomy °", "beyond_anatomy_deg", 1),
    ("ms/frame", "ms_per_frame", 2),
];
const PART_COLUMNS: &[Column] = &[
    ("acceleration ×", "acceleration_ratio", 2),
    ("content", "content_correlation", 2),
    ("head turned °", "head_turned_deg", 1),
    ("torso °", "torso_turned_deg", 1),
    ("arms °", "arms_turned_deg", 1),
    ("legs °", "legs_turned_deg", 1),
    ("out cm/s", "skate_cm_s_out", 2),
    ("beyond anatomy °", "beyond_anatomy_deg", 1),
];

/// Measurements of one clip with one setting.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Sample {
    action: String,
    target: String,
    /// Number in [`Grid::builds`].
    build: usize,
    /// Number in [`Grid::settings`].
    setting: usize,
    values: BTreeMap<String, f64>,
}

impl Sample {
    pub(super) fn new(
        action: &str,
        target: &str,
        build: usize,
        setting: usize,
        values: impl IntoIterator<Item = (&'static str, f64)>,
    ) -> Self {
        let values = values.into_iter().map(|(name, v)| (name.to_owned(), v)).collect();
        Self { action: action.to_owned(), target: target.to_owned(), build, setting, values }
    }
}

/// Returns measurements that need no ground truth, by their names in the results.
pub(super) fn quality_values(quality: &Quality) -> [(&'static str, f64); 12] {
    let turned = |part: BodyPart| quality.turned[part as usize].to_degrees();
    [
        ("acceleration_ratio", quality.acceleration_ratio),
        ("content_correlation", quality.content_correlation),
        ("distance_cm", quality.distance * 100.0),
        ("jerk_ratio", quality.jerk_ratio),
        ("skate_cm_s_in", quality.skate_in * 100.0),
        ("skate_cm_s_out", quality.skate_out * 100.0),
        ("sole_depth_cm", quality.sole_depth * 100.0),
        ("beyond_anatomy_deg", quality.beyond_anatomy.to_degrees()),
        ("head_turned_deg", turned(BodyPart::Head)),
        ("torso_turned_deg", turned(BodyPart::Torso)),
        ("arms_turned_deg", 0.5 * (turned(BodyPart::LeftArm) + turned(BodyPart::RightArm))),
        ("legs_turned_deg", turned(BodyPart::Legs)),
    ]
}

/// Output of `--json`.
#[derive(Serialize)]
pub struct Report {
    protocol: &'static str,
    rate: f32,
    generator: &'static str,
    command: String,
    results: Vec<Row>,
}

/// Names and values of a setting's parameters.
type Description = Vec<(&'static str, String)>;

/// Means over the samples of an action, a target and a setting.
#[derive(Serialize)]
struct Row {
    action: String,
    source: String,
    target: String,
    #[serde(flatten)]
    setting: Setting,
    #[serde(flatten)]
    build: Build,
    samples: usize,
    #[serde(flatten)]
    values: BTreeMap<String, f64>,
}

impl Report {
    /// Returns the rows of the results as JSON.
    ///
    /// # Errors
    /// None in practice.
    pub fn rows_json(&self) -> Outcome<String> {
        serde_json::to_string(&self.results).map_err(|e| TaskError::of(Code::Fault, e))
    }

    pub(super) fn new(protocol: &'static str, source: &str, grid: &Grid, samples: &[Sample], command: &str) -> Self {
        let mut groups: BTreeMap<(&str, &str, usize, usize), Vec<&Sample>> = BTreeMap::new();
        for s in samples {
            groups.entry((&s.action, &s.target, s.build, s.setting)).or_default().push(s);
        }
        let row = |((action, target, build, setting), group): ((&str, &str, usize, usize), Vec<&Sample>)| Row {
            action: action.to_owned(),
            source: source.to_owned(),
            target: target.to_owned(),
            setting: grid.settings[setting].clone(),
            build: grid.builds[build],
            samples: group.len(),
            values: means(&group.iter().map(|s| &s.values).collect::<Vec<_>>()),
        };
        Self {
            protocol,
            rate: BuildOptions::default().rate_hz,
            generator: GENERATOR,
            command: command.to_owned(),
            results: groups.into_iter().map(row).collect(),
        }
    }

    /// Returns a table of the means over actions and targets. It has one line per setting, with the parameters in which
    /// settings differ.
    pub fn markdown(&self) -> String {
        let cross_validation = self.results.iter().any(|r| r.values.contains_key("pose_error_cm"));
        let by_part = self.results.iter().any(|r| r.setting.part != Part::Whole);
        let columns = match (cross_validation, by_part) {
            (true, _) => CROSS_VALIDATION_COLUMNS,
            (false, false) => OFF_DATABASE_COLUMNS,
            (false, true) => PART_COLUMNS,
        };
        let mut lines: Vec<(Description, Vec<&Row>)> = Vec::new();
        for row in &self.results {
            let name = row.description();
            match lines.iter_mut().find(|(n, _)| *n == name) {
                Some((_, rows)) => rows.push(row),
                None => lines.push((name, vec![row])),
            }
        }
        let varies = varying(&lines.iter().map(|(name, _)| name).collect::<Vec<_>>(), 1);
        let header = varies.iter().map(|&i| lines[0].0[i].0).chain(columns.iter().map(|c| c.0));
        let mut out = table_row(header.map(str::to_owned));
        let rule = varies.iter().map(|_| "---").chain(columns.iter().map(|_| "---:"));
        out += &table_row(rule.map(str::to_owned));
        let cell = |rows: &[&Row], name: &str, digits: usize| {
            let known: Vec<f64> = rows.iter().filter_map(|r| r.values.get(name)).copied().collect();
            if known.is_empty() { "–".to_owned() } else { format!("{:.digits$}", mean(&known)) }
        };
        if cross_validation {
            let all: Vec<&Row> = self.results.iter().collect();
            for (title, prefix) in [
                ("input unchanged", "input"),
                ("floor: best other take", "floor"),
                ("floor: mean of three other takes", "mean_floor"),
            ] {
                let names = ["cm", "ms", "cm_s"].map(|unit| format!("{prefix}_{unit}"));
                let first = std::iter::once(title.to_owned()).chain(varies.iter().skip(1).map(|_| String::new()));
                let cells =
                    columns.iter().enumerate().map(|(i, c)| names.get(i).map_or(String::new(), |n| cell(&all, n, c.2)));
                out += &table_row(first.chain(cells));
            }
        }
        for (name, rows) in &lines {
            let first = varies.iter().map(|&i| name[i].1.clone());
            out += &table_row(first.chain(columns.iter().map(|c| cell(rows, c.1, c.2))));
        }
        out
    }
}

impl Report {
    /// Returns a table with a line for every action, target and setting: how much of the difference between the styles
    /// the output covers, compared with the takes held out. Each value is a mean ± standard deviation over the folds.
    /// The row with the least progress compared with the takes comes first.
    pub fn progress_markdown(&self) -> String {
        let beside =
            |row: &Row| row.values.get("style_progress").zip(row.values.get("take_progress")).map(|(s, t)| s / t);
        let mut rows: Vec<(Description, &Row)> = self.results.iter().map(|row| (row.description(), row)).collect();
        rows.sort_by(|(_, a), (_, b)| beside(a).unwrap_or(f64::NAN).total_cmp(&beside(b).unwrap_or(f64::NAN)));
        let varies = varying(&rows.iter().map(|(name, _)| name).collect::<Vec<_>>(), 0);
        let settings = varies.iter().map(|&i| rows[0].0[i].0);
        let header = ["action", "style"].into_iter().chain(settings);
        let mut out = table_row(header.chain(["output", "real takes", "output ÷ takes", "pose cm"]).map(str::to_owned));
        out += &table_row((0..varies.len() + 6).map(|i| if i < varies.len() + 2 { "---" } else { "---:" }.to_owned()));
        for (name, row) in &rows {
            let value = |name: &str| row.values.get(name).map_or("–".to_owned(), |v| format!("{v:.2}"));
            let spread = |name: &str| format!("{} ± {}", value(name), value(&format!("{name}_sd")));
            let labels = [row.action.clone(), row.target.clone()];
            let figures = [
                spread("style_progress"),
                spread("take_progress"),
                beside(row).map_or("–".to_owned(), |share| format!("{share:.2}")),
                value("pose_error_cm"),
            ];
            out += &table_row(labels.into_iter().chain(varies.iter().map(|&i| name[i].1.clone())).chain(figures));
        }
        out
    }
}

/// Returns the indices of the first `always` parameters and of those in which settings differ.
fn varying(settings: &[&Description], always: usize) -> Vec<usize> {
    let values = |i: usize| settings.iter().map(|s| &s[i].1).collect::<BTreeSet<_>>();
    (0..settings.first().map_or(0, |s| s.len())).filter(|&i| i < always || values(i).len() > 1).collect()
}

impl Row {
    /// Returns all parameters of a setting as text.
    fn description(&self) -> Description {
        let s = &self.setting;
        let text = |v: &dyn std::fmt::Debug| format!("{v:?}").to_lowercase();
        vec![
            ("method", s.method.clone()),
            ("labels", text(&s.labels)),
            ("mode", text(&s.mode)),
            ("K", s.k.to_string()),
            ("δ", s.delta.to_string()),
            ("λ", s.lambda.to_string()),
            ("κ", s.kappa.to_string()),
            ("ρ", s.rho.to_string()),
            ("η", s.tempo.to_string()),
            ("coherence", text(&s.coherence)),
            ("intensity", s.intensity.to_string()),
            ("part", text(&s.part)),
            ("window", self.build.window.to_string()),
            ("search", self.build.search.to_string()),
            ("registration", text(&self.build.registration)),
            ("takes", if self.build.takes == 0 { "all".to_owned() } else { self.build.takes.to_string() }),
        ]
    }
}

fn table_row(cells: impl Iterator<Item = String>) -> String {
    let mut out = String::from("|");
    for cell in cells {
        // Writing to a string cannot fail.
        let _ = write!(out, " {cell} |");
    }
    out + "\n"
}

/// Returns the mean of every value, the sum of frames, and the standard deviation of some values.
fn means(samples: &[&BTreeMap<String, f64>]) -> BTreeMap<String, f64> {
    let names: BTreeSet<&String> = samples.iter().flat_map(|s| s.keys()).collect();
    let mut out = BTreeMap::new();
    for name in names {
        let values: Vec<f64> = samples.iter().filter_map(|s| s.get(name)).copied().collect();
        let value = if name == "frames" { values.iter().sum() } else { mean(&values) };
        out.insert(name.clone(), value);
        if SPREAD.contains(&name.as_str()) {
            let variance = values.iter().map(|v| (v - value) * (v - value)).sum::<f64>() / values.len() as f64;
            out.insert(format!("{name}_sd"), variance.sqrt());
        }
    }
    out
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}
