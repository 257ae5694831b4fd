//! The `strut` command: files, arguments, progress, printing; no algorithms.
//!
//! Exit codes: 0 success; 1 failure, with `error: ` and one sentence on stderr and no file written; 2 wrong usage.
//! Results go to stdout and to the named files. Progress goes to stderr, only if that is a terminal.
#![forbid(unsafe_code)]
// Comments of arguments are the help, in which brackets mark what is optional.
#![allow(rustdoc::broken_intra_doc_links)]

// A batch continues after a job that panics.
const _: () = assert!(cfg!(panic = "unwind"), "the command must unwind");

mod add_style;
mod annotation;
mod bench;
mod build_db;
mod demo_db;
mod demo_report;
mod drive;
mod evaluate;
mod evaluate_walk;
mod inspect;
mod key_style;
mod label_args;
mod live;
mod manners;
mod model;
mod print;
mod progress;
mod read_args;
mod reference;
mod style_args;
mod stylize;
mod stylize_batch;
mod train_key_style;
mod train_walk;
mod walk;

use clap::{CommandFactory, Parser, Subcommand};
use std::io::Write;
use std::process::ExitCode;
use strut_tasks::{Code, Outcome};

#[derive(Parser)]
#[command(name = "strut", version, about = "Motion style transfer for BVH files", max_term_width = 110)]
struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Inspect(inspect::Args),
    BuildDb(build_db::Args),
    AddStyle(add_style::Args),
    Stylize(Box<stylize::Args>),
    StylizeBatch(Box<stylize_batch::Args>),
    Evaluate(Box<evaluate::Args>),
    Bench(bench::Args),
    DemoDb(demo_db::Args),
    Drive(drive::Args),
    Live(Box<live::Args>),
    TrainWalk(train_walk::Args),
    Walk(walk::Args),
    EvaluateWalk(evaluate_walk::Args),
    TrainKeyStyle(train_key_style::Args),
    KeyStyle(key_style::Args),
    /// Print every command and option as JSON
    #[command(hide = true)]
    Reference,
}

fn run(args: Args) -> Outcome {
    match args.command {
        Command::Inspect(args) => inspect::run(&args),
        Command::AddStyle(args) => add_style::run(&args),
        Command::BuildDb(args) => build_db::run(&args),
        Command::Stylize(args) => stylize::run(&args),
        Command::StylizeBatch(args) => stylize_batch::run(&args),
        Command::Evaluate(args) => evaluate::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::DemoDb(args) => demo_db::run(&args),
        Command::Drive(args) => drive::run(&args),
        Command::Live(args) => live::run(&args),
        Command::TrainWalk(args) => train_walk::run(&args),
        Command::Walk(args) => walk::run(&args),
        Command::EvaluateWalk(args) => evaluate_walk::run(&args),
        Command::TrainKeyStyle(args) => train_key_style::run(&args),
        Command::KeyStyle(args) => key_style::run(&args),
        Command::Reference => reference::run(&mut Args::command()),
    }
}

fn exit_code(code: Code) -> u8 {
    match code {
        Code::Usage => 2,
        // As shells expect after Ctrl-C.
        Code::Cancelled => 130,
        _ => 1,
    }
}

fn main() -> ExitCode {
    match run(Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Nothing can be done if stderr is closed.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            exit_code(error.code).into()
        }
    }
}
