//! The arguments of `strut evaluate`.

use std::path::PathBuf;
use strut_core::search::WINDOW;
use strut_core::transfer::Options;
use strut_formats::corpus::Pattern;
use strut_tasks::evaluate::{Labels, Part, PassMode, Protocol, Registration, Request};
use strut_tasks::search::Search;
use strut_tasks::stylize::Switch;

/// Help on the output of `--json`.
const JSON_HELP: &str = "\
Methods: nn nearest neighbour, knn mean of the K nearest, lar one local autoregression, mar
mixture of autoregressive models, gar global autoregression, lti a linear time-invariant system
(Hsu et al. 2005; lti-dof: one for each degree of freedom), gp Gaussian process (Ikemoto et al.
2009).

Options may have lists of values: all combinations are measured.

The results of --json:
  protocol, rate, generator, command
  results  [{action, source, target, method, labels, mode, k, delta, lambda, kappa, rho, tempo,
           coherence, intensity, part, window, search, registration, takes, samples, frames,
           pose_error_cm, timing_error_ms, velocity_error_cm_s, floor_cm, input_cm, …,
           style_progress (share of the distance from the input to the mean of the style's takes
           in the database that the output covers, in means and standard deviations of the joint
           positions), take_progress (the same for the held-out take; both are absent where every
           class of the database has one take), skate_cm_s_in, skate_cm_s_out, jerk_ratio,
           acceleration_ratio, content_correlation, ms_per_frame}]
  Means over the samples (folds, or input clips); NAME_sd is the standard deviation of NAME over
  them.
After an interruption, run the same command with the same --json file to continue.";

/// Measure the error of styled motion against real motion
///
/// Protocol loo (leave one out): each take of the source style is styled with a database that lacks the clips of that
/// take, and the result is compared with the same take of the target style. Protocol off-database: other clips are
/// styled with a database of all takes, and the result is compared with the input.
#[derive(clap::Args)]
#[command(after_long_help = JSON_HELP)]
pub(crate) struct Args {
    /// The clips: a folder of .bvh files
    #[arg(long, value_name = "DIR")]
    pub(super) data: PathBuf,
    /// Pattern of the labels in file names [default: common patterns are tried]
    #[arg(long, value_name = "P")]
    pub(super) pattern: Option<Pattern>,
    /// The style of the inputs, which is the neutral style of the databases
    #[arg(long, value_name = "NAME")]
    pub(super) source: String,
    /// Actions of the inputs and of the databases [default: all]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub(super) actions: Vec<String>,
    /// Actions of the databases [default: those of the inputs]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub(super) database_actions: Vec<String>,
    /// Styles to predict [default: all but the source]
    #[arg(long, value_name = "S,T", value_delimiter = ',')]
    pub(super) targets: Vec<String>,
    /// Methods to compare
    #[arg(long, value_name = "M,…", value_delimiter = ',', default_value = "nn,knn,lar,mar")]
    pub(super) methods: Vec<String>,
    /// Labels of the input that the engine knows
    #[arg(long, value_delimiter = ',', default_value = "none")]
    pub(super) labels: Vec<Labels>,
    /// The protocol
    #[arg(long, default_value = "loo")]
    pub(super) protocol: Protocol,
    /// off-database: .bvh files and folders to style
    #[arg(long, value_name = "INPUT", value_delimiter = ',')]
    pub(super) inputs: Vec<PathBuf>,
    /// Whether clips are styled as a whole or frame by frame
    #[arg(long, value_delimiter = ',', default_value = "offline")]
    pub(super) mode: Vec<PassMode>,
    /// How the databases are registered
    #[arg(long, value_delimiter = ',', default_value = "dtw")]
    pub(super) registration: Vec<Registration>,
    /// Largest number of takes of each target class in a database, 0 for all; results are means of three random draws
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "0")]
    pub(super) takes: Vec<usize>,
    /// Frames of a search window
    #[arg(long, value_name = "S", value_delimiter = ',', default_values_t = [WINDOW])]
    pub(super) window: Vec<usize>,
    /// How neighbours are found: exact, or kdtree:M for M candidates of a kd-tree in each class
    #[arg(long, value_name = "SEARCH", value_delimiter = ',', default_value = "exact")]
    pub(super) search: Vec<Search>,
    /// K: number of neighbours (most similar examples) in each class
    #[arg(short, value_delimiter = ',', default_values_t = [Options::DEFAULT.k])]
    pub(super) k: Vec<usize>,
    /// Ridge regularisation of the regressions, as a share of K: more is smoother, less shows more detail of the style
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.lambda])]
    pub(super) lambda: Vec<f32>,
    /// Share of the bias that is kept in the output, 0 to 1; bias is the part of the input that no example explains
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.rho])]
    pub(super) rho: Vec<f32>,
    /// Tempo of walks and runs: 0 keeps the input's tempo, 1 uses the style's
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.tempo])]
    pub(super) tempo: Vec<f32>,
    /// Tolerance of the bias, in standard deviations of the neighbours: input within it has no bias; inf for no bias
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.kappa])]
    pub(super) kappa: Vec<f32>,
    /// How slowly the weight of a class decreases with its distance from the input
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.delta])]
    pub(super) delta: Vec<f32>,
    /// Whether the output is smoothed where the database has no similar motion
    #[arg(long, value_delimiter = ',', default_value = "on")]
    pub(super) coherence: Vec<Switch>,
    /// Weight of the target style: 0 is neutral, more than 1 exaggerates
    #[arg(long, value_name = "F", value_delimiter = ',', default_value = "1")]
    pub(super) intensity: Vec<f32>,
    /// Part of the body that takes the target style; the rest is neutral
    #[arg(long, value_delimiter = ',', default_value = "whole")]
    pub(super) part: Vec<Part>,
    /// loo: number of folds, the first ones; 0 for all
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(super) folds: usize,
    /// loo: instead of the means, print for every action and style how much of the distance to the target is covered
    #[arg(long)]
    pub(super) progress: bool,
    /// Write the results as JSON
    #[arg(long, value_name = "FILE")]
    pub(super) json: Option<PathBuf>,
    /// loo: write the knee angle and the timing of the first fold over time, for every method, as JSON
    #[arg(long, value_name = "FILE")]
    pub(super) curves: Option<PathBuf>,
}

impl Args {
    /// Returns the request, with the command line as it was typed.
    pub(super) fn request(&self, command: String) -> Request {
        Request {
            data: self.data.clone(),
            pattern: self.pattern.clone(),
            source: self.source.clone(),
            actions: self.actions.clone(),
            database_actions: self.database_actions.clone(),
            targets: self.targets.clone(),
            methods: self.methods.clone(),
            labels: self.labels.clone(),
            protocol: self.protocol,
            inputs: self.inputs.clone(),
            mode: self.mode.clone(),
            registration: self.registration.clone(),
            takes: self.takes.clone(),
            window: self.window.clone(),
            search: self.search.clone(),
            k: self.k.clone(),
            lambda: self.lambda.clone(),
            rho: self.rho.clone(),
            tempo: self.tempo.clone(),
            kappa: self.kappa.clone(),
            delta: self.delta.clone(),
            coherence: self.coherence.clone(),
            intensity: self.intensity.clone(),
            part: self.part.clone(),
            folds: self.folds,
            wants_curves: self.curves.is_some(),
            results: self.json.clone(),
            command,
        }
    }
}
