//! `strut evaluate`: how near styled motion comes to real motion, and what it costs.

mod checkpoint;
mod cross_validation;
mod curves;
mod off_database;
mod results;
mod settings;

use crate::corpus;
use crate::failure::{Failure, Outcome};
use crate::files::{Outputs, print, print_warnings};
use crate::gather::gather;
use crate::search::Search;
use crate::stylize::Switch;
use crate::suggestion::unknown;
use checkpoint::Checkpoint;
use clap::ValueEnum;
use results::{Report, Sample};
use settings::{Grid, Labels, Part, PassMode, Registration};
use std::collections::BTreeSet;
use std::path::PathBuf;
use strut_core::database::build::SourceClip;
use strut_core::search::WINDOW;
use strut_core::transfer::Options;
use strut_formats::corpus::{DEFAULT_PATTERN, Pattern};

/// What files are called, tried in this order unless a pattern is given.
const PATTERNS: [&str; 4] = [
    DEFAULT_PATTERN,
    "{set}_{action}_{style}_{take}.bvh",
    "{style}_{action}_{take}.bvh",
    "{set}_{style}_{action}_{take}.bvh",
];

/// What `--json` writes.
const JSON_HELP: &str = "\
Methods: nn nearest neighbour, knn mean of the K nearest, lar one local autoregression, mar mixture of autoregressive
models, gar global autoregression, lti a linear time-invariant system (Hsu et al. 2005; lti-dof: one for each degree of
freedom), gp Gaussian process (Ikemoto et al. 2009).

Every option that takes a list is varied: all combinations are measured.

The results of --json:
  protocol, rate, generator, command
  results  [{action, source, target, method, labels, mode, k, delta, lambda, kappa, rho, coherence, intensity, part,
            window, search, registration, takes, samples, frames, pose_error_cm, timing_error_ms, velocity_error_cm_s,
            floor_cm, input_cm, …, skate_cm_s_in, skate_cm_s_out, jerk_ratio, acceleration_ratio,
            content_correlation, ms_per_frame}]
  Means over the samples (folds, or input clips); NAME_sd is the standard deviation of NAME over them.
A run that is stopped goes on where it was, if --json names the same file.";

/// Measure how near styled motion comes to real motion
///
/// loo: each take of the source style is styled with a database that knows no clip of that take, and compared with the
/// same take of the target style. off-database: other clips are styled with a database of all takes, and compared
/// with themselves.
#[derive(clap::Args)]
#[command(after_long_help = JSON_HELP)]
pub(crate) struct Args {
    /// The clips: a folder of .bvh files
    #[arg(long, value_name = "DIR")]
    data: PathBuf,
    /// How file names give the labels [default: the usual ones are tried]
    #[arg(long, value_name = "P")]
    pattern: Option<Pattern>,
    /// The style of the inputs, neutral in the databases
    #[arg(long, value_name = "NAME")]
    source: String,
    /// Actions of the inputs and of the databases [default: all]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    actions: Vec<String>,
    /// Actions of the databases, if others than the inputs'
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    database_actions: Vec<String>,
    /// Styles to predict [default: all but the source]
    #[arg(long, value_name = "S,T", value_delimiter = ',')]
    targets: Vec<String>,
    /// Methods to compare
    #[arg(long, value_name = "M,…", value_delimiter = ',', default_value = "nn,knn,lar,mar")]
    methods: Vec<String>,
    /// What the engine is told of the input
    #[arg(long, value_delimiter = ',', default_value = "none")]
    labels: Vec<Labels>,
    /// What is measured
    #[arg(long, default_value = "loo")]
    protocol: Protocol,
    /// off-database: .bvh files and folders to style
    #[arg(long, value_name = "INPUT", value_delimiter = ',')]
    inputs: Vec<PathBuf>,
    /// Whether clips pass as a whole or frame by frame
    #[arg(long, value_delimiter = ',', default_value = "offline")]
    mode: Vec<PassMode>,
    /// How the databases are registered
    #[arg(long, value_delimiter = ',', default_value = "dtw")]
    registration: Vec<Registration>,
    /// Takes of each target class in a database at most; 0 for all
    #[arg(long, value_name = "N", value_delimiter = ',', default_value = "0")]
    takes: Vec<usize>,
    /// Frames that are compared in the search for neighbours
    #[arg(long, value_name = "S", value_delimiter = ',', default_values_t = [WINDOW])]
    window: Vec<usize>,
    /// How neighbours are found: exact, or kdtree:M, among M candidates of a kd-tree in each class
    #[arg(long, value_name = "SEARCH", value_delimiter = ',', default_value = "exact")]
    search: Vec<Search>,
    /// Neighbours in each class
    #[arg(short, value_delimiter = ',', default_values_t = [Options::DEFAULT.k])]
    k: Vec<usize>,
    /// Ridge of the regressions, as a share of K
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.lambda])]
    lambda: Vec<f32>,
    /// Share of what the database does not know that is kept: 0 to 1
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.rho])]
    rho: Vec<f32>,
    /// Deviations from the neighbours that the database is taken to know; inf for no bias
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.kappa])]
    kappa: Vec<f32>,
    /// How far classes less near than the nearest take part
    #[arg(long, value_name = "F", value_delimiter = ',', default_values_t = [Options::DEFAULT.delta])]
    delta: Vec<f32>,
    /// Whether what the database does not know is kept from trembling
    #[arg(long, value_delimiter = ',', default_value = "on")]
    coherence: Vec<Switch>,
    /// Weight of the target style: 0 is neutral, more than 1 exaggerates
    #[arg(long, value_name = "F", value_delimiter = ',', default_value = "1")]
    intensity: Vec<f32>,
    /// What of the body takes the target style; the rest is neutral
    #[arg(long, value_delimiter = ',', default_value = "whole")]
    part: Vec<Part>,
    /// loo: folds at most, the first ones; 0 for all
    #[arg(long, value_name = "N", default_value_t = 0)]
    folds: usize,
    /// Write the results as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// loo: write the knee and the time of the first fold's trials over time, for every method, as JSON
    #[arg(long, value_name = "FILE")]
    curves: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Protocol {
    Loo,
    OffDatabase,
}

impl Protocol {
    fn name(self) -> &'static str {
        match self {
            Self::Loo => "loo",
            Self::OffDatabase => "off-database",
        }
    }
}

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check([args.json.as_deref(), args.curves.as_deref()].into_iter().flatten())?;
    let grid = Grid::new(args)?;
    match args.protocol {
        Protocol::Loo if !args.inputs.is_empty() => {
            return Err(Failure::usage("--inputs goes with --protocol off-database"));
        }
        Protocol::OffDatabase if args.inputs.is_empty() => {
            return Err(Failure::usage("--protocol off-database needs --inputs"));
        }
        Protocol::OffDatabase if args.curves.is_some() => {
            return Err(Failure::usage("--curves goes with --protocol loo"));
        }
        _ => {}
    }
    let clips = read(args)?;
    let checkpoint = Checkpoint::open(args.json.as_deref(), &command_line())?;
    let samples: Vec<Sample> = match args.protocol {
        Protocol::Loo => cross_validation::run(args, &grid, &clips, &checkpoint)?,
        Protocol::OffDatabase => off_database::run(args, &grid, &clips, &checkpoint)?,
    };
    if samples.is_empty() {
        let advice = "a take of the source style with the same number as one of a target style was expected";
        return Err(Failure::in_file(&args.data, format_args!("there is nothing to compare: {advice}")));
    }
    let report = Report::new(args.protocol.name(), &args.source, &grid, &samples, &command_line());
    let mut outputs = Outputs::default();
    if let Some(target) = &args.json {
        outputs.stage(target, &serde_json::to_vec_pretty(&report).map_err(Failure::new)?)?;
    }
    if let Some(target) = &args.curves {
        let curves = curves::of_first_fold(args, &grid, &clips)?;
        outputs.stage(target, &serde_json::to_vec(&curves).map_err(Failure::new)?)?;
    }
    outputs.commit()?;
    checkpoint.remove();
    print(&report.markdown());
    Ok(())
}

/// The arguments as they were typed: what a result came from, and what a checkpoint is good for.
fn command_line() -> String {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    format!("strut {}", arguments.join(" "))
}

/// The labelled clips of the actions asked for; those that cannot be read are named and left out.
fn read(args: &Args) -> Outcome<Vec<SourceClip>> {
    let sources = gather(std::slice::from_ref(&args.data))?;
    let mut refused = Vec::new();
    let labelled = match &args.pattern {
        Some(pattern) => corpus::label(&sources, Some(pattern), None, &mut refused)?,
        None => PATTERNS
            .iter()
            .find_map(|p| {
                let pattern = p.parse().ok()?;
                let labelled = corpus::label(&sources, Some(&pattern), None, &mut Vec::new()).ok()?;
                labelled.iter().any(|(_, l)| l.style == args.source).then_some(labelled)
            })
            .ok_or_else(|| {
                let advice = "say how clips are labelled with --pattern";
                Failure::in_file(&args.data, format_args!("no clip has the style '{}'; {advice}", args.source))
            })?,
    };
    let known = |name: fn(&strut_formats::corpus::Labels) -> &String| -> Vec<String> {
        labelled.iter().map(|(_, l)| name(l).clone()).collect::<BTreeSet<_>>().into_iter().collect()
    };
    let (actions, styles) = (known(|l| &l.action), known(|l| &l.style));
    let in_data = |reason| Failure::in_file(&args.data, reason);
    for (what, names, of) in [
        ("action", &args.actions, &actions),
        ("action", &args.database_actions, &actions),
        ("style", &args.targets, &styles),
        ("style", &vec![args.source.clone()], &styles),
    ] {
        if let Some(name) = names.iter().find(|n| !of.contains(n)) {
            return Err(in_data(unknown(what, name, of)));
        }
    }
    let wanted = |action: &String| {
        args.actions.is_empty() || args.actions.contains(action) || args.database_actions.contains(action)
    };
    let labelled = labelled.into_iter().filter(|(_, l)| wanted(&l.action)).collect();
    let clips = corpus::read_clips(Some(&args.source), labelled, &mut refused)?;
    for clip in refused {
        print_warnings(&format!("warning: left out {}: {}\n", clip.file, clip.reason));
    }
    Ok(clips)
}
