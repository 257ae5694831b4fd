//! The tables of `docs/key-style.md`: errors of key-style models on held-out poses. The clips and the published numbers are
//! those of one paper's prototype, so this is no command of `strut`:
//! `cargo run --release -p strut-motion-tasks --example key_style_tables -- DATA -o ../docs/key-style.md`.
#![forbid(unsafe_code)]

mod data;
mod keys;
mod tables;

use clap::Parser;
use data::{ALL, DataSet};
use std::fmt::Write;
use std::path::PathBuf;
use strut_tasks::files::Outputs;
use strut_tasks::{Outcome, TaskError};

/// Measure key-styling on clips that were not used in training
///
/// DATA is a folder that contains bandai-namco-1 and bandai-namco-2, or these two folders. The prototype was measured on
/// the same clips.
#[derive(Parser)]
struct Args {
    /// Folders of clips
    #[arg(required = true, value_name = "DATA")]
    data: Vec<PathBuf>,
    /// Data sets to measure
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_value = "punch,walk,hands,dance,walk-all")]
    sets: Vec<String>,
    /// Number of seeds over which results are averaged
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u64).range(1..=100))]
    seeds: u64,
    /// Write the tables as Markdown
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

fn main() -> Outcome {
    let args = Args::parse();
    Outputs::check(args.output.as_deref())?;
    let sets = args.sets.iter().map(|name| {
        let known: Vec<&str> = ALL.iter().map(|set| set.name).collect();
        let set = ALL.iter().find(|set| set.name == *name);
        let set = set.ok_or_else(|| TaskError::new(strut_tasks::suggestion::unknown("data set", name, &known)))?;
        DataSet::read(set, &args.data)
    });
    let sets = sets.collect::<Outcome<Vec<_>>>()?;
    let mut text = String::from("# Key-styling\n\n");
    text.push_str(
        "Written by `strut-tasks/examples/key_style_tables` on clips of bandai-namco-1 and bandai-namco-2, with 16 components. \
         Errors are measured on held-out poses, which the models were not trained on. *Error* is the mean angle \
         between the joints, and their mean distance with both hips at the same position. The results of the \
         prototype are in *italics*.\n\n",
    );
    // Writing to a string cannot fail.
    text.push_str(
        "| data | clips | style | trained on | tested on | unexplained |\n| --- | --- | --- | ---: | ---: | ---: |\n",
    );
    for set in &sets {
        let axes: Vec<&str> = set.axes.iter().map(strut_core::somn::Measure::text).collect();
        let [learnt, tested] = [&set.training, &set.test].map(|of| of.iter().map(|r| r.poses.len()).sum::<usize>());
        let _ = writeln!(
            text,
            "| {} | {} | {} | {learnt} frames | {tested} frames | {:.0} % |",
            set.plan.name,
            set.plan.clips,
            axes.join(", "),
            100.0 * set.model()?.unexplained_share()
        );
    }
    text.push_str(
        "\n*Unexplained* is the share of the poses' variance that the style does not determine. It is measured \
         between recorded poses of similar styles. Above 60 %, `strut train-key-style` recommends other style \
         variables.\n\n",
    );
    tables::errors(&mut text, &sets, args.seeds)?;
    tables::baselines(&mut text, &sets)?;
    let shown: Vec<&DataSet> = sets.iter().filter(|set| set.plan.is_shown).collect();
    tables::jumps(&mut text, &shown)?;
    tables::control(&mut text, &sets)?;
    tables::support(&mut text, &shown)?;
    keys::against_key_frames(&mut text, &shown)?;
    if let Some(walk) = sets.iter().find(|set| set.plan.name == "walk") {
        keys::circle(&mut text, walk)?;
    }
    tables::cost(&mut text, &shown)?;
    match &args.output {
        None => print!("{text}"),
        Some(output) => {
            let mut outputs = Outputs::default();
            outputs.stage(output, text.as_bytes())?;
            outputs.commit()?;
        }
    }
    Ok(())
}
