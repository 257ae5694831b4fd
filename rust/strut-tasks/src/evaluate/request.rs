//! Request of an evaluation.

use super::choices::{Labels, Part, PassMode, Registration};
use crate::error::{Outcome, TaskError};
use crate::search::Search;
use crate::stylize::Switch;
use crate::suggestion::unknown;
use serde::Deserialize;
use serde::de::value::{Error, StrDeserializer};
use serde::de::{DeserializeOwned, IntoDeserializer};
use std::fmt::Display;
use std::path::PathBuf;
use std::str::FromStr;
use strut_core::search::WINDOW;
use strut_core::transfer::Options;
use strut_formats::corpus::Pattern;
use strut_formats::quotation;

/// What is compared with what.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs)] // The fields of a request explain it, and comments would appear in the help.
pub enum Protocol {
    Loo,
    OffDatabase,
}

impl Protocol {
    /// Returns the name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Loo => "loo",
            Self::OffDatabase => "off-database",
        }
    }
}

/// Request of an evaluation. All combinations of the values in lists are measured.
// The comments of the fields are the command's help.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
pub struct Request {
    /// The clips: a folder of .bvh files
    #[cfg_attr(feature = "clap", arg(long, value_name = "DIR"))]
    pub data: PathBuf,
    /// Pattern of the labels in file names [default: common patterns are tried]
    #[cfg_attr(feature = "clap", arg(long, value_name = "P"))]
    pub pattern: Option<Pattern>,
    /// The style of the inputs, which is the neutral style of the databases
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub source: String,
    /// Actions of the inputs and of the databases [default: all]
    #[cfg_attr(feature = "clap", arg(long, value_name = "A,B", value_delimiter = ','))]
    pub actions: Vec<String>,
    /// Actions of the databases [default: those of the inputs]
    #[cfg_attr(feature = "clap", arg(long, value_name = "A,B", value_delimiter = ','))]
    pub database_actions: Vec<String>,
    /// Styles to predict [default: all but the source]
    #[cfg_attr(feature = "clap", arg(long, value_name = "S,T", value_delimiter = ','))]
    pub targets: Vec<String>,
    /// Methods to compare
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "M,…", value_delimiter = ',', default_value = "nn,knn,lar,mar")
    )]
    pub methods: Vec<String>,
    /// Labels of the input that the engine knows
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', default_value = "none"))]
    pub labels: Vec<Labels>,
    /// The protocol
    #[cfg_attr(feature = "clap", arg(long, default_value = "loo"))]
    pub protocol: Protocol,
    /// off-database: .bvh files and folders to style
    #[cfg_attr(feature = "clap", arg(long, value_name = "INPUT", value_delimiter = ','))]
    pub inputs: Vec<PathBuf>,
    /// Whether clips are styled as a whole or frame by frame
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', default_value = "offline"))]
    pub mode: Vec<PassMode>,
    /// How the databases are registered
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', default_value = "dtw"))]
    pub registration: Vec<Registration>,
    /// Largest number of takes of each target class in a database, 0 for all; results are means of three random draws
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", value_delimiter = ',', default_value = "0"))]
    pub takes: Vec<usize>,
    /// Frames of a search window
    #[cfg_attr(feature = "clap", arg(long, value_name = "S", value_delimiter = ',', default_values_t = [WINDOW]))]
    pub window: Vec<usize>,
    /// How neighbours are found: exact, or kdtree:M for M candidates of a kd-tree in each class
    #[cfg_attr(feature = "clap", arg(long, value_name = "SEARCH", value_delimiter = ',', default_value = "exact"))]
    pub search: Vec<Search>,
    /// K: number of neighbours (most similar examples) in each class
    #[cfg_attr(feature = "clap", arg(short, value_delimiter = ',', default_values_t = [Options::DEFAULT.k]))]
    pub k: Vec<usize>,
    /// Ridge regularisation of the regressions, as a share of K: more is smoother, less shows more detail of the style
    #[cfg_attr(feature = "clap", arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.lambda]))]
    pub lambda: Vec<f32>,
    /// Share of the bias that is kept in the output, 0 to 1; bias is the part of the input that no example explains
    #[cfg_attr(feature = "clap", arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.rho]))]
    pub rho: Vec<f32>,
    /// Tempo of walks and runs: 0 keeps the input's tempo, 1 uses the style's
    #[cfg_attr(feature = "clap", arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.tempo]))]
    pub tempo: Vec<f32>,
    /// Tolerance of the bias, in standard deviations of the neighbours: input within it has no bias; inf for no bias
    #[cfg_attr(feature = "clap", arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.kappa]))]
    pub kappa: Vec<f32>,
    /// How slowly the weight of a class decreases with its distance from the input
    #[cfg_attr(feature = "clap", arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.delta]))]
    pub delta: Vec<f32>,
    /// Whether the output is smoothed where the database has no similar motion
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', default_value = "on"))]
    pub coherence: Vec<Switch>,
    /// Weight of the target style: 0 is neutral, more than 1 exaggerates
    #[cfg_attr(feature = "clap", arg(long, value_name = "F", value_delimiter = ',', default_value = "1"))]
    pub intensity: Vec<f32>,
    /// Part of the body that takes the target style; the rest is neutral
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', default_value = "whole"))]
    pub part: Vec<Part>,
    /// loo: number of folds, the first ones; 0 for all
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", default_value_t = 0))]
    pub folds: usize,
    /// Write the results as JSON
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub json: Option<PathBuf>,
    /// Whether the curves of the first fold are requested.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub wants_curves: bool,
    /// The command line. It is recorded with the results. An interrupted run resumes from a checkpoint next to the file of the
    /// results only if it is the same.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub command: String,
}

impl Request {
    /// Names of the options that [`Self::set`] accepts.
    pub const NAMES: [&'static str; 23] = [
        "pattern",
        "actions",
        "database-actions",
        "targets",
        "methods",
        "labels",
        "protocol",
        "inputs",
        "mode",
        "registration",
        "takes",
        "window",
        "search",
        "k",
        "lambda",
        "rho",
        "tempo",
        "kappa",
        "delta",
        "coherence",
        "intensity",
        "part",
        "folds",
    ];

    /// Creates a request with the command's defaults.
    pub fn new(data: PathBuf, source: String) -> Self {
        let Options { k, lambda, rho, tempo, kappa, delta, .. } = Options::DEFAULT;
        Self {
            data,
            pattern: None,
            source,
            actions: Vec::new(),
            database_actions: Vec::new(),
            targets: Vec::new(),
            methods: ["nn", "knn", "lar", "mar"].map(str::to_owned).into(),
            labels: vec![Labels::None],
            protocol: Protocol::Loo,
            inputs: Vec::new(),
            mode: vec![PassMode::Offline],
            registration: vec![Registration::Dtw],
            takes: vec![0],
            window: vec![WINDOW],
            search: vec![Search::Exact],
            k: vec![k],
            lambda: vec![lambda],
            rho: vec![rho],
            tempo: vec![tempo],
            kappa: vec![kappa],
            delta: vec![delta],
            coherence: vec![Switch::On],
            intensity: vec![1.0],
            part: vec![Part::Whole],
            folds: 0,
            wants_curves: false,
            json: None,
            command: String::new(),
        }
    }

    /// Sets an option by the command's long name, from the values as typed.
    ///
    /// # Errors
    /// A message about the name or a value.
    pub fn set(&mut self, name: &str, values: &[String]) -> Outcome {
        let texts = || values.to_vec();
        match name {
            "pattern" => self.pattern = Some(one(name, values, parsed)?),
            "actions" => self.actions = texts(),
            "database-actions" => self.database_actions = texts(),
            "targets" => self.targets = texts(),
            "methods" => self.methods = texts(),
            "labels" => self.labels = all(name, values, choice)?,
            "protocol" => self.protocol = one(name, values, choice)?,
            "inputs" => self.inputs = values.iter().map(PathBuf::from).collect(),
            "mode" => self.mode = all(name, values, choice)?,
            "registration" => self.registration = all(name, values, choice)?,
            "takes" => self.takes = all(name, values, parsed)?,
            "window" => self.window = all(name, values, parsed)?,
            "search" => self.search = all(name, values, parsed)?,
            "k" => self.k = all(name, values, parsed)?,
            "lambda" => self.lambda = all(name, values, parsed)?,
            "rho" => self.rho = all(name, values, parsed)?,
            "tempo" => self.tempo = all(name, values, parsed)?,
            "kappa" => self.kappa = all(name, values, parsed)?,
            "delta" => self.delta = all(name, values, parsed)?,
            "coherence" => self.coherence = all(name, values, parsed)?,
            "intensity" => self.intensity = all(name, values, parsed)?,
            "part" => self.part = all(name, values, choice)?,
            "folds" => self.folds = one(name, values, parsed)?,
            _ => return Err(TaskError::usage(unknown("option", name, &Self::NAMES))),
        }
        Ok(())
    }
}

/// Parser of a value.
type Read<T> = fn(&str) -> Result<T, String>;

fn parsed<T: FromStr<Err: Display>>(text: &str) -> Result<T, String> {
    text.parse().map_err(|e: T::Err| e.to_string())
}

/// Parses a value of an enumeration by its name.
fn choice<T: DeserializeOwned>(text: &str) -> Result<T, String> {
    let text: StrDeserializer<'_, Error> = text.into_deserializer();
    T::deserialize(text).map_err(|e| e.to_string())
}

fn all<T>(name: &str, values: &[String], read: Read<T>) -> Outcome<Vec<T>> {
    if values.is_empty() {
        return Err(TaskError::usage(format_args!("{name} has no value; one or several were expected")));
    }
    let fail = |value: &String, e: String| {
        TaskError::usage(format_args!("{name} is '{}': {}", quotation(value, 40), quotation(&e, 200)))
    };
    values.iter().map(|value| read(value).map_err(|e| fail(value, e))).collect()
}

fn one<T>(name: &str, values: &[String], read: Read<T>) -> Outcome<T> {
    let mut all = all(name, values, read)?;
    match (all.pop(), all.is_empty()) {
        (Some(only), true) => Ok(only),
        _ => Err(TaskError::usage(format_args!("{name} has several values; one was expected"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_are_set_by_the_commands_names_and_values() {
        let mut request = Request::new("clips".into(), "normal".into());
        let mut set = |name: &str, values: &[&str]| {
            request.set(name, &values.iter().map(|v| (*v).to_owned()).collect::<Vec<_>>()).map_err(|e| e.to_string())
        };
        set("protocol", &["off-database"]).unwrap();
        set("labels", &["both", "none"]).unwrap();
        set("kappa", &["1.5", "inf"]).unwrap();
        assert!(set("mode", &["both"]).unwrap_err().contains("expected `offline` or `online`"));
        assert!(set("k", &["many"]).unwrap_err().starts_with("k is 'many': "));
        assert!(set("folds", &["1", "2"]).unwrap_err().contains("one was expected"));
        assert!(set("rho", &[]).unwrap_err().contains("has no value"));
        assert!(set("q", &["1"]).unwrap_err().contains("there is no option 'q'"));
        assert_eq!(
            (request.protocol, request.labels.len(), request.kappa[1]),
            (Protocol::OffDatabase, 2, f32::INFINITY)
        );
    }

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        let mut request = Request::new("clips".into(), "normal".into());
        let mut refused = 0;
        for name in Request::NAMES {
            if let Err(error) = request.set(name, &["x".repeat(5000)]) {
                assert!(error.message.chars().count() < 500, "{name}: {} characters", error.message.chars().count());
                refused += 1;
            }
        }
        assert!(refused > 10, "{refused}");
    }

    #[test]
    fn every_name_can_be_set() {
        for name in Request::NAMES {
            let values = ["1", "on", "{action}_{style}.bvh", "both", "loo", "offline", "dtw", "exact", "whole"];
            let sets =
                |value: &str| Request::new("clips".into(), "normal".into()).set(name, &[value.to_owned()]).is_ok();
            assert!(values.into_iter().any(sets), "{name}");
        }
    }
}
