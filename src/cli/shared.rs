//! The options that commands share. Each command takes those that mean something to it, and refuses the others.

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, ValueEnum};
use std::path::PathBuf;

use crate::pipeline::UsageError;
use crate::stages::registry::lacks_progress;

/// What commands share.
#[derive(Debug, Args)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Pipeline file whose options hold where no flag is given
    #[arg(long, global = true, value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Threads [default: all cores]
    #[arg(long, global = true, value_name = "N")]
    pub threads: Option<usize>,
    /// Print nothing but errors and results
    #[arg(long, global = true)]
    pub quiet: bool,
    /// Show progress bars: auto (on a terminal) or never
    #[arg(long, global = true, default_value = "auto", hide_possible_values = true, value_name = "WHEN")]
    pub progress: Progress,
    /// Run even if the output is up to date
    #[arg(long, global = true)]
    pub force: bool,
    /// Replace files that another stage or program wrote
    #[arg(long, global = true)]
    pub overwrite: bool,
}

/// When progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Progress {
    Auto,
    Never,
}

const ALL: &[&str] = &["config", "threads", "quiet", "progress", "force", "overwrite"];

/// The common options that mean nothing to a command.
fn idle(command: &str) -> &'static [&'static str] {
    match command {
        "init" | "inspect" | "completions" | "man" => ALL,
        "run" => &["config"],
        "seed-spread" => &["config", "progress", "force"],
        stage if lacks_progress(stage) => &["progress"],
        _ => &[],
    }
}

/// The common options, with those hidden in each subcommand that mean nothing to it.
pub fn with_common(command: Command) -> Command {
    let command = Common::augment_args(command);
    let shared: Vec<Arg> = command.get_arguments().cloned().collect();
    command.mut_subcommands(|subcommand| {
        let is_idle = |arg: &&Arg| idle(subcommand.get_name()).contains(&arg.get_id().as_str());
        let hidden: Vec<Arg> = shared.iter().filter(is_idle).map(|arg| arg.clone().hide(true)).collect();
        subcommand.args(hidden)
    })
}

/// That no option is given that means nothing to the command.
///
/// # Errors
/// With the first one that is.
pub fn expect_no_idle(command: &str, matches: &ArgMatches) -> anyhow::Result<()> {
    let is_given = |option: &&&str| matches.value_source(option) == Some(ValueSource::CommandLine);
    match idle(command).iter().find(is_given) {
        Some(&"config") if command == "run" => {
            Err(UsageError::because("run takes no --config; expected the file itself: rockfrag run FILE"))
        }
        Some(option) => Err(UsageError::because(format!("{command} takes no --{option}; leave it out"))),
        None => Ok(()),
    }
}

/// How a table is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// To read
    Table,
    /// For a program: {"warnings": [...], "rows": [{...}, ...]}
    Json,
}

/// How a command prints its table.
#[derive(Debug, Args)]
pub struct Printed {
    /// Print a table to read, or json: an object with warnings and rows
    #[arg(long, default_value = "table", value_name = "FORMAT", hide_possible_values = true)]
    pub format: Format,
}
