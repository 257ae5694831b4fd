//! `strut bench`: time per frame, stage by stage.

mod measure;
mod recall;
mod table;
mod yardstick;

use crate::print::print;
use crate::progress::Bar;
use measure::{Mode, Row, Run};
use recall::SearchRow;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;
use strut_core::catalogue::Catalogue;
use strut_core::database::{Database, MAX_FRAMES};
use strut_core::search::Index;
use strut_core::transfer::Model;
use strut_demo::benchmark::{self, LEAST_FRAMES, PAPER_FRAMES, Query};
use strut_formats::strutdb::{self, Contents};
use strut_tasks::clip::read_database;
use strut_tasks::files::Outputs;
use strut_tasks::{Outcome, TaskError};
use yardstick::{Comparison, Yardstick};

/// Measure how long a frame takes
///
/// Styles motion that is not in the database, on one thread. Prints the median and the 95th percentile of every stage
/// beside the times of the paper's Table 2. It also prints the share of the nearest windows that kd-trees find.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A database to measure; some of its clips are removed and styled
    #[arg(long, value_name = "DB", conflicts_with = "frames")]
    db: Option<PathBuf>,
    /// Without --db: numbers of frames of the procedural databases to measure
    #[arg(long, value_name = "N[,N…]", value_delimiter = ',', default_values_t = [PAPER_FRAMES])]
    frames: Vec<usize>,
    /// Also compare with the search of the paper, which compares all windows on a GPU
    #[arg(long)]
    gpu: bool,
    /// Write the results as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// Output of `--json`; `npm run bench` writes the same.
#[derive(Serialize)]
struct Report {
    machine: String,
    rows: Vec<Row>,
    recall: Vec<SearchRow>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    gpu: Vec<Comparison>,
}

/// Greatest number of frames of a database that is also written, opened and its index copied. Larger ones would not fit
/// in memory together with their file.
const MOST_TO_OPEN: usize = 500_000;

pub(crate) fn run(args: &Args) -> Outcome {
    Outputs::check(args.json.as_deref())?;
    let wrong = args.frames.iter().find(|n| !(LEAST_FRAMES..=MAX_FRAMES).contains(n));
    if let Some(n) = wrong {
        return Err(TaskError::usage(format!("--frames is {n}; {LEAST_FRAMES} to {MAX_FRAMES} was expected")));
    }
    let mut report = Report { machine: machine(), rows: Vec::new(), recall: Vec::new(), gpu: Vec::new() };
    print(&format!("{}, one thread\n", report.machine));
    let yardstick = if args.gpu { Yardstick::open()? } else { None };
    let yardstick = yardstick.as_ref();
    if let Some(path) = &args.db {
        let (database, queries) = benchmark::hold_out(&read_database(path)?)
            .ok_or_else(|| TaskError::in_file(path, "no class has two clips, of which one could be held out"))?;
        measure_on(database, &queries, yardstick, &mut report);
    } else {
        let queries = benchmark::queries();
        for &frames in &args.frames {
            measure_on(benchmark::database(frames).map_err(TaskError::new)?, &queries, yardstick, &mut report);
        }
    }
    let mut outputs = Outputs::default();
    outputs.stage_json(args.json.as_deref(), &report)?;
    outputs.commit()
}

/// Measures a database, prints the tables and adds their rows.
fn measure_on(database: Database, queries: &[Query], yardstick: Option<&Yardstick>, report: &mut Report) {
    let rows = &mut report.rows;
    let first = rows.len();
    let write = || strutdb::write(&database, &Index::build(&database).plan(), strut_formats::GENERATOR);
    let file = (database.frames() <= MOST_TO_OPEN).then(write);
    // Opened from its file if there is one, as in normal use.
    let started = Instant::now();
    let opened = file.and_then(|bytes| {
        let Contents { database, plan } = strutdb::read(&bytes).ok()?;
        Some((Index::from_plan(&database, plan?).ok()?, database))
    });
    let (index, database) = opened.unwrap_or_else(|| (Index::build(&database), database));
    let (frames, classes) = (database.frames(), database.classes().len());
    let model = Arc::new(Model::of(Catalogue::with_index(database, index)));
    let opened_ms = started.elapsed().as_secs_f64() * 1e3;
    if frames <= MOST_TO_OPEN {
        rows.push(Row::new("open", "all", frames, classes, vec![opened_ms]));
    }
    let bar = Bar::new("measuring", Mode::ALL.len() * queries.len());
    for mode in Mode::ALL {
        let mut run = Run::new(&model, mode);
        for query in queries {
            run.add(query);
            bar.step();
        }
        rows.extend(run.rows());
    }
    drop(bar);
    print(&table::text(&rows[first..], frames, classes));
    let windows = recall::all_windows(model.catalogue(), queries);
    if frames <= MOST_TO_OPEN {
        let recall = recall::measure(model.catalogue(), model.index(), &windows);
        print(&recall::text(&recall));
        report.recall.extend(recall);
    }
    if let Some((rows, comparison)) = yardstick.and_then(|y| y.measure(model.index(), &windows)) {
        report.rows.extend(rows);
        report.gpu.push(comparison);
    }
}

/// Returns the name of the processor and the number of its threads.
fn machine() -> String {
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let cpu = std::fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| {
        let line = text.lines().find(|l| l.starts_with("model name"))?;
        Some(line.split_once(':')?.1.trim().to_owned())
    });
    format!("{}, {threads} threads, {}", cpu.unwrap_or_else(|| std::env::consts::ARCH.into()), std::env::consts::OS)
}
