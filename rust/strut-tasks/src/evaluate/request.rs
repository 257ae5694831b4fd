//! What to measure.

use super::choices::{Labels, Part, PassMode, Registration};
use crate::search::Search;
use crate::stylize::Switch;
use std::path::PathBuf;
use strut_formats::corpus::Pattern;

/// What is compared with what.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[allow(missing_docs)] // The fields of a request say it, and comments would be the help of the command.
pub enum Protocol {
    Loo,
    OffDatabase,
}

impl Protocol {
    /// Its name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Loo => "loo",
            Self::OffDatabase => "off-database",
        }
    }
}

/// What to measure. Of lists all combinations are measured.
#[derive(Clone, Debug)]
pub struct Request {
    /// The clips: a folder of BVH files.
    pub data: PathBuf,
    /// How file names give the labels; the usual ones are tried otherwise.
    pub pattern: Option<Pattern>,
    /// The style of the inputs, neutral in the databases.
    pub source: String,
    /// Actions of the inputs and of the databases; all if empty.
    pub actions: Vec<String>,
    /// Actions of the databases, if others than the inputs'.
    pub database_actions: Vec<String>,
    /// Styles to predict; all but the source if empty.
    pub targets: Vec<String>,
    /// Methods by name.
    pub methods: Vec<String>,
    /// Labels of the input that the engine is given.
    pub labels: Vec<Labels>,
    /// Takes that are left out, or clips that databases do not hold.
    pub protocol: Protocol,
    /// Off the database: files and folders to style.
    pub inputs: Vec<PathBuf>,
    /// Whether clips pass as a whole or frame by frame.
    pub mode: Vec<PassMode>,
    /// How the databases are registered.
    pub registration: Vec<Registration>,
    /// Greatest number of takes of each target class in a database; 0 for all.
    pub takes: Vec<usize>,
    /// Frames of a search window.
    pub window: Vec<usize>,
    /// How neighbours are found.
    pub search: Vec<Search>,
    /// Neighbours in each class.
    pub k: Vec<usize>,
    /// Ridge of the regressions, as a share of K.
    pub lambda: Vec<f32>,
    /// Share of the bias that is kept in the output: 0 to 1.
    pub rho: Vec<f32>,
    /// How much of the tempo becomes the style's own: 0 to 1.
    pub tempo: Vec<f32>,
    /// Standard deviations from the neighbours beyond which input is bias.
    pub kappa: Vec<f32>,
    /// How slowly the weight of a class falls with its distance.
    pub delta: Vec<f32>,
    /// Whether output is smoothed where the input is unlike the database.
    pub coherence: Vec<Switch>,
    /// Weight of the target style.
    pub intensity: Vec<f32>,
    /// Part of the body that takes the target style.
    pub part: Vec<Part>,
    /// Leaving out: number of folds, the first ones; 0 for all.
    pub folds: usize,
    /// Leaving out: whether the curves of the first fold are wanted.
    pub wants_curves: bool,
    /// Where the results will be: a run that is stopped goes on from a file beside it.
    pub results: Option<PathBuf>,
    /// What was asked for, in a line: recorded with the results; a run goes on only if it is the same.
    pub command: String,
}
