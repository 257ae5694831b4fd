//! Styling options, which several commands share.

use clap::Args;
use strut_core::transfer::Options;
use strut_evaluation::baselines::method_named;
use strut_tasks::Outcome;
use strut_tasks::search::Search;
use strut_tasks::stylize::{METHODS, StyleSettings, Switch};
use strut_tasks::weights::{PartWeights, StyleWeights};

/// How clips are styled.
#[derive(Args)]
pub(crate) struct StyleArgs {
    /// The input's action, if known
    #[arg(long, value_name = "NAME")]
    action: Option<String>,
    /// The input's own style, if known
    #[arg(long, value_name = "NAME")]
    input_style: Option<String>,
    /// K: number of neighbours (most similar examples) in each class
    #[arg(short, default_value_t = Options::DEFAULT.k)]
    k: usize,
    /// Ridge regularisation of the regressions, as a share of K: more is smoother, less shows more detail of the style
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.lambda)]
    lambda: f32,
    /// Share of the bias that is kept in the output, 0 to 1; bias is the part of the input that no example explains
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.rho)]
    rho: f32,
    /// Tempo of walks and runs: 0 keeps the input's tempo, 1 uses the style's
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.tempo)]
    tempo: f32,
    /// Tolerance of the bias, in standard deviations of the neighbours: input within it has no bias
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.kappa)]
    kappa: f32,
    /// How slowly the weight of a class decreases with its distance from the input
    #[arg(long, value_name = "F", default_value_t = Options::DEFAULT.delta)]
    delta: f32,
    /// Whether the output is smoothed where the database has no similar motion
    #[arg(long, default_value = "on")]
    coherence: Switch,
    /// Whether the style changes the timing
    #[arg(long, default_value = "on")]
    timing: Switch,
    /// Whether planted feet are held in place
    #[arg(long, default_value = "on")]
    footplant: Switch,
    /// mar: mixture of autoregressive models; lar: one local autoregression; nn: nearest neighbour; knn: mean of the K
    /// nearest; gar: one autoregression for all; lti: linear time-invariant system for the whole body; lti-dof: one per
    /// degree of freedom; gp: Gaussian process
    #[arg(long, default_value = "mar", value_parser = METHODS)]
    method: String,
    /// Different weights for a part of the body: head, torso, left-arm, right-arm, arms or legs
    #[arg(long, value_name = "PART:NAME=W[,…]")]
    part: Vec<PartWeights>,
    /// How neighbours are found: exact, or kdtree:M for M candidates of a kd-tree in each class
    #[arg(long, value_name = "SEARCH", default_value = "exact")]
    search: Search,
}

impl StyleArgs {
    /// Returns the settings for these styles.
    pub(crate) fn settings(&self, styles: StyleWeights) -> Outcome<StyleSettings> {
        let options = Options {
            k: self.k,
            delta: self.delta,
            lambda: self.lambda,
            kappa: self.kappa,
            rho: self.rho,
            tempo: self.tempo,
            coherence: self.coherence == Switch::On,
            timing: self.timing == Switch::On,
            footplant: self.footplant == Switch::On,
            method: method_named(&self.method).unwrap_or_default(),
            ..Options::DEFAULT
        };
        let settings = StyleSettings {
            action: self.action.clone(),
            input_style: self.input_style.clone(),
            search: self.search,
            parts: self.part.clone(),
            options,
            ..StyleSettings::new(styles)
        };
        settings.validate()?;
        Ok(settings)
    }
}
