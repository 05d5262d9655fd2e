//! The command line: commands, what is given to them, and printed text.
//!
//! ```text
//! pipeline_file  sections of options
//! calls          calls of stages, of what is given
//! ```

pub mod calls;
mod pipeline_file;

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::builder::StyledStr;
use clap::{Arg, ArgAction, Command, FromArgMatches, Parser};
use clap_complete::Shell;
use serde_json::{Value, json};

use crate::number::shown;
use crate::pipeline::UsageError;
use crate::pipeline::cache;
use crate::pipeline::context::{COMMON, Caller, Common, Context, threads_of};
use crate::pipeline::given::{is_path, name_of};
use crate::pipeline::options::SeveralErrors;
use crate::pipeline::terminal::{print, tell};
use crate::source::silence_decoder_panics;
use crate::stages::{self, StageKind, init, inspect, run};
use crate::table::frame::Format;

const PIPELINE: &str = "pipeline.yaml";
/// Letters of an error, which may name what a file says.
const LONGEST_ERROR: usize = 2000;

/// How likely free-standing structures are to rock or overturn in an earthquake, and how often at a site
#[derive(Debug, Parser)]
#[command(name = "rockfrag", version, arg_required_else_help = true, args_override_self = true)]
#[command(after_help = "First: rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6")]
enum Tool {
    /// Run all stages of a pipeline file, skipping what is up to date
    Run {
        /// Pipeline file
        #[arg(default_value = PIPELINE)]
        pipeline: PathBuf,
        /// Folder of all files [default: as in the pipeline file, else out beside it]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Seed of all stages
        #[arg(long)]
        seed: Option<u64>,
        /// Print what each stage would do, and why
        #[arg(long)]
        dry_run: bool,
        /// As --dry-run; exit with 1 if any stage would run
        #[arg(long)]
        check: bool,
        #[command(flatten)]
        common: Common,
    },
    /// Write a folder to start from: paper (the paper's set-up), records (your records) or site (a hazard
    /// curve)
    Init {
        #[arg(value_enum, default_value = "paper")]
        start: init::Start,
        /// Folder to write into; nothing there is replaced
        #[arg(long, value_name = "DIR", default_value = ".")]
        out: PathBuf,
        /// Print nothing
        #[arg(long)]
        quiet: bool,
    },
    /// Show what a file holds and where it came from
    Inspect(inspect::Inspect),
    /// Print the completions of a shell
    Completions { shell: Shell },
}

pub fn command() -> Command {
    let stages = stages::all().into_iter().map(|kind| with_short_help(kind.command));
    <Tool as clap::CommandFactory>::command().subcommands(stages)
}

/// The options that `-h` shows; `--help` shows all.
const USUAL: &str = "about all author candidate column depth dt eta fits from hazard height in keep-going \
                     level limit-state magnitude measure motions mw name out over pairs partition period \
                     pex pga pgv pro re rotate sa samples scale seed site structure structures suite \
                     target terms title to trace unit vs30 width";

fn with_short_help(command: Command) -> Command {
    command.mut_args(|arg| {
        let is_usual = arg.get_long().is_none_or(|flag| USUAL.split(' ').any(|usual| usual == flag));
        arg.hide_short_help(!is_usual)
    })
}

/// Describes all stages and their options, as JSON.
pub fn describe() -> Value {
    let stages = stages::all().into_iter().map(|StageKind { command, .. }| {
        let options = command.get_arguments().filter(|arg| arg.get_id() != "help").map(option);
        let options: Vec<Value> = options.collect();
        json!({ "name": command.get_name(), "help": words(command.get_about()), "options": options })
    });
    stages.collect()
}

fn option(arg: &Arg) -> Value {
    let name = name_of(arg);
    let kind = match arg.get_action() {
        ArgAction::SetTrue => "flag",
        _ if name == "out" => "output",
        _ if is_path(arg) => "input",
        _ => "value",
    };
    let default: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    json!({
        "name": name,
        "kind": kind,
        "default": default.join(","),
        "help": words(arg.get_help()),
        "positional": arg.is_positional(),
        "common": arg.get_help_heading() == Some(COMMON),
    })
}

fn words(text: Option<&StyledStr>) -> String {
    text.map(StyledStr::to_string).unwrap_or_default()
}

/// Runs a command line, program name first. Returns the exit code: 0 success, 1 failure, 2 wrong usage.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    silence_decoder_panics();
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let error = match run(&arguments) {
        Ok(code) => return code,
        Err(error) => error,
    };
    match error.downcast_ref::<clap::Error>() {
        // Help, and the version: our own words, in colours.
        Some(asked) if !asked.use_stderr() => {
            let _ = asked.print();
            return 0;
        }
        Some(refused) => tell(refused.to_string().trim_end()),
        None => {
            let lines = match error.downcast_ref() {
                Some(SeveralErrors(lines)) => lines.clone(),
                None => vec![format!("{error:#}")],
            };
            let lines: Vec<_> = lines.iter().map(|line| shown(line, LONGEST_ERROR)).collect();
            tell(&format!("error: {}", lines.join("\n")));
        }
    }
    if error.is::<UsageError>() || error.is::<clap::Error>() { 2 } else { 1 }
}

fn run(arguments: &[OsString]) -> anyhow::Result<u8> {
    if let [_, name, ..] = arguments
        && let Some(stage) = stages::all().into_iter().find(|stage| stage.name() == *name)
    {
        return run_stage(&stage, arguments).map(|()| 0);
    }
    let text = match Tool::from_arg_matches(&command().try_get_matches_from(arguments)?)? {
        Tool::Run { pipeline, out, seed, dry_run, check, common } => {
            if pipeline == Path::new(PIPELINE) && !pipeline.exists() {
                let message = format!("no {PIPELINE} here; `rockfrag init` writes one to start from");
                return Err(UsageError::because(message));
            }
            set_threads(&common)?;
            let calls = calls::of_run(&pipeline, out, seed)?;
            if !(dry_run || check) {
                return run::run(&calls, &Context::new(common, Caller::Run)).map(|()| 0);
            }
            let (plan, is_due) = run::dry_run(&calls, &Context::new(common, Caller::Run))?;
            print(&plan, Format::Text)?;
            return Ok(u8::from(check && is_due));
        }
        Tool::Init { start, out, quiet } => {
            let written = init::init(start, &out)?;
            if quiet { String::new() } else { written }
        }
        Tool::Inspect(inspect) => return print(&inspect.run()?, inspect.format).map(|()| 0),
        Tool::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command(), "rockfrag", &mut script);
            String::from_utf8(script)?
        }
    };
    print(&text, Format::Text).map(|()| 0)
}

fn run_stage(stage: &StageKind, line: &[OsString]) -> anyhow::Result<()> {
    let call = calls::of_line(stage, line)?;
    set_threads(&call.common)?;
    let context = Context::new(call.common.clone(), Caller::Command);
    let done = cache::run(&call, &context, &mut HashMap::new())?;
    if !done.ran && !context.common.quiet {
        tell(&format!("{}: up to date", call.name));
    }
    print(&done.summary, call.stage.format())?;
    run::warn(&done.warnings);
    Ok(())
}

fn set_threads(common: &Common) -> anyhow::Result<()> {
    let threads = threads_of(common.threads)?.unwrap_or_default().build_global();
    threads.map_err(|error| anyhow::anyhow!("a thread cannot start: {error}"))
}
