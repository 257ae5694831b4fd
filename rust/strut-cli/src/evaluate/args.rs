//! The arguments of `strut evaluate`.

use std::path::PathBuf;
use strut_tasks::evaluate::Request;

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
    #[command(flatten)]
    pub(super) request: Request,
    /// loo: instead of the means, print for every action and style how much of the distance to the target is covered
    #[arg(long)]
    pub(super) progress: bool,
    /// loo: write the knee angle and the timing of the first fold over time, for every method, as JSON
    #[arg(long, value_name = "FILE")]
    pub(super) curves: Option<PathBuf>,
}
