//! `strut reference`: prints every command and option as JSON. The documentation generates its page from it
//! (`scripts/docs/reference/`).

use crate::print::print;
use clap::{Arg, Command};
use serde::Serialize;
use strut_tasks::{Outcome, TaskError};

/// A command.
#[derive(Serialize)]
struct CommandEntry {
    name: String,
    /// The whole description.
    about: String,
    usage: String,
    /// Text below the options of its help.
    more: Option<String>,
    arguments: Vec<ArgumentEntry>,
}

/// An option or an argument.
#[derive(Serialize)]
struct ArgumentEntry {
    long: Option<String>,
    short: Option<char>,
    /// Names of its values; empty for a switch.
    values: Vec<String>,
    is_required: bool,
    is_repeated: bool,
    default: Option<String>,
    possible_values: Vec<String>,
    help: String,
}

/// Prints the subcommands of a built command that its help shows.
pub(crate) fn run(root: &mut Command) -> Outcome {
    root.build();
    let shown = root.get_subcommands_mut().filter(|c| !c.is_hide_set() && c.get_name() != "help");
    let entries: Vec<_> = shown.map(command_entry).collect();
    print(&format!("{}\n", serde_json::to_string_pretty(&entries).map_err(TaskError::new)?));
    Ok(())
}

fn command_entry(command: &mut Command) -> CommandEntry {
    let usage = command.render_usage().to_string();
    let about = command.get_long_about().or_else(|| command.get_about());
    CommandEntry {
        name: command.get_name().to_owned(),
        about: about.map(ToString::to_string).unwrap_or_default(),
        usage: usage.strip_prefix("Usage: ").unwrap_or(&usage).to_owned(),
        more: command.get_after_long_help().map(ToString::to_string),
        arguments: command.get_arguments().filter(|a| a.get_id() != "help").map(argument_entry).collect(),
    }
}

fn argument_entry(argument: &Arg) -> ArgumentEntry {
    let takes_value = argument.get_action().takes_values();
    let defaults: Vec<_> = argument.get_default_values().iter().map(|v| v.to_string_lossy()).collect();
    let possible = argument.get_possible_values();
    let help = argument.get_long_help().or_else(|| argument.get_help());
    ArgumentEntry {
        long: argument.get_long().map(str::to_owned),
        short: argument.get_short(),
        values: match argument.get_value_names() {
            Some(names) if takes_value => names.iter().map(ToString::to_string).collect(),
            _ => Vec::new(),
        },
        is_required: argument.is_required_set(),
        is_repeated: argument.get_num_args().is_some_and(|n| n.max_values() > 1),
        default: (takes_value && !defaults.is_empty()).then(|| defaults.join(" ")),
        possible_values: if takes_value {
            possible.iter().map(|v| v.get_name().to_owned()).collect()
        } else {
            Vec::new()
        },
        help: help.map(ToString::to_string).unwrap_or_default(),
    }
}
