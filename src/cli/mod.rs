//! The command line: commands, options and printed text.

pub mod config;
mod yaml;

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::builder::StyledStr;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, Parser, Subcommand, ValueHint};
use clap_complete::Shell;
use serde_json::{Value, json};

use self::config::{Config, assigned};
use crate::number::shown;
use crate::pipeline::UsageError;
use crate::pipeline::cache::{self, is_view};
use crate::pipeline::call::Call;
use crate::pipeline::context::{COMMON, Caller, Common, Context, threads_of};
use crate::pipeline::options::{SeveralErrors, in_one_line};
use crate::pipeline::paths::{Role, path_kind};
use crate::pipeline::terminal::{print, tell};
use crate::source::{silence_decoder_panics, split_sheet};
use crate::stages::{Stages, init, inspect, run};
use crate::table::frame::Format;
use crate::table::keys::resolved;

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
    let stages = Stages::augment_subcommands(Command::new("stages"));
    let stages = stages.get_subcommands().enumerate().map(|(place, stage)| {
        let about = stage.get_about().cloned().unwrap_or_default();
        let stage = Common::augment_args(stage.clone().args_override_self(true)).about(about);
        with_short_help(stage).mut_args(with_hint).display_order(10 + place)
    });
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

/// Tells shells how to complete a path.
fn with_hint(arg: Arg) -> Arg {
    match path_kind(&arg).map(|kind| kind.role) {
        Some(Role::Folder) => arg.value_hint(ValueHint::DirPath),
        Some(_) => arg.value_hint(ValueHint::AnyPath),
        None => arg,
    }
}

/// Returns the commands of stages, in the order of a run.
pub fn stage_commands() -> Vec<Command> {
    let mut command = command();
    command.build();
    let commands = command.get_subcommands().filter(|command| Stages::has_subcommand(command.get_name()));
    commands.cloned().collect()
}

/// Describes all stages and their options, as JSON.
pub fn describe() -> Value {
    let stages = stage_commands().into_iter().map(|command| {
        let options = command.get_arguments().filter(|arg| arg.get_id() != "help").map(option);
        let options: Vec<Value> = options.collect();
        json!({ "name": command.get_name(), "help": words(command.get_about()), "options": options })
    });
    stages.collect()
}

fn option(arg: &Arg) -> Value {
    let path = path_kind(arg);
    let kind = match path.map(|path| path.role) {
        Some(Role::Output) => "output",
        Some(_) => "input",
        None if matches!(arg.get_action(), ArgAction::SetTrue) => "flag",
        None => "value",
    };
    let default: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    json!({
        "name": arg.get_long().unwrap_or(arg.get_id().as_str()),
        "kind": kind,
        "formats": path.map_or(&[][..], |path| path.formats),
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
    let Err(error) = run(&arguments) else { return 0 };
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

fn run(arguments: &[OsString]) -> anyhow::Result<()> {
    if let [_, name, user @ ..] = arguments
        && let Some(command) = stage_commands().into_iter().find(|command| command.get_name() == *name)
    {
        return run_stage(&command, user);
    }
    let text = match Tool::from_arg_matches(&command().try_get_matches_from(arguments)?)? {
        Tool::Run { pipeline, out, seed, dry_run, common } => {
            if pipeline == Path::new(PIPELINE) && !pipeline.exists() {
                let message = format!("no {PIPELINE} here; `rockfrag init` writes one to start from");
                return Err(UsageError::because(message));
            }
            set_threads(&common)?;
            let calls = calls_of(&pipeline, out, seed)?;
            match dry_run {
                true => run::dry_run(&calls)?,
                false => return run::run(&calls, &Context::new(common, Caller::Run)),
            }
        }
        Tool::Init { start, out, quiet } => {
            let written = init::init(start, &out)?;
            if quiet { String::new() } else { written }
        }
        Tool::Inspect(inspect) => return print(&inspect.run()?, inspect.format),
        Tool::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command(), "rockfrag", &mut script);
            String::from_utf8(script)?
        }
    };
    print(&text, Format::Text)
}

fn run_stage(command: &Command, user: &[OsString]) -> anyhow::Result<()> {
    let call = configured(command, user)?;
    set_threads(&call.common)?;
    let context = Context::new(call.common.clone(), Caller::Command);
    let done = cache::run(&call, &context, &HashMap::new())?;
    if !done.ran && !context.common.quiet {
        tell(&format!("{}: up to date", call.name));
    }
    print(&done.summary, call.stage.format())?;
    if !context.common.quiet {
        run::warn(&done.warnings);
    }
    Ok(())
}

/// Returns the call of a stage with the user's arguments, and those of its section where `--config` names a
/// file.
pub fn configured(command: &Command, user: &[OsString]) -> anyhow::Result<Call> {
    // Without errors, which later parsing reports.
    let words = [&[command.get_name().into()], user].concat();
    let known = command.clone().ignore_errors(true).try_get_matches_from(words).unwrap_or_default();
    let section = match known.try_get_one::<PathBuf>("config") {
        Ok(Some(path)) => Config::read(path, &stage_commands())?.section(command, Some(&known))?,
        _ => Vec::new(),
    };
    parsed(command, [section, user.to_vec()].concat())
}

/// Parses and checks the arguments of a stage.
fn parsed(command: &Command, arguments: Vec<OsString>) -> anyhow::Result<Call> {
    let words = [vec![OsString::from("rockfrag"), command.get_name().into()], arguments].concat();
    // Parsed as part of the whole command line, which usage lines name.
    let mut whole = self::command().try_get_matches_from(&words)?;
    if let Some(out) = whole.subcommand().and_then(out_beside_in) {
        whole = self::command().try_get_matches_from([words, vec![out]].concat())?;
    }
    let stage = Stages::from_arg_matches(&whole)?;
    let (options, stage) = (stage.options(), stage.parsed());
    let inputs = stage.inputs();
    let piped = inputs.iter().filter(|read| read.paths.contains(&PathBuf::from("-")));
    let piped: Vec<String> = piped.map(|read| format!("--{}", read.flag)).collect();
    if piped.len() > 1 {
        return Err(UsageError::because(format!("{}: expected one of them from stdin", piped.join(", "))));
    }
    stage.check()?;
    let matches = whole.subcommand_matches(command.get_name()).cloned().unwrap_or_default();
    let (name, common) = (command.get_name().to_string(), Common::from_arg_matches(&matches)?);
    Ok(Call { name, stage, common, options })
}

/// Returns `--out` beside a given `--in`, if the user gives no `--out`.
fn out_beside_in((_, matches): (&str, &ArgMatches)) -> Option<OsString> {
    let [input, out] =
        [("in", ValueSource::CommandLine), ("out", ValueSource::DefaultValue)].map(|(id, source)| {
            matches.try_contains_id(id).ok()?;
            let path = matches.get_raw(id)?.next().map(PathBuf::from);
            path.filter(|_| matches.value_source(id) == Some(source))
        });
    Some(assigned("out", input?.with_file_name(out?).as_os_str()))
}

/// Returns the calls of a pipeline file, in the order of a run.
pub fn calls_of(pipeline: &Path, out: Option<PathBuf>, seed: Option<u64>) -> anyhow::Result<Vec<Call>> {
    let commands = stage_commands();
    let mut config = Config::read(pipeline, &commands)?;
    config.seed = seed.map(|seed| seed.to_string()).or(config.seed);
    let folder = out.unwrap_or_else(|| config.out.clone());
    let (mut calls, mut written): (Vec<Call>, _) = (Vec::new(), HashMap::new());
    for command in commands.iter().filter(|command| config.has(command.get_name())) {
        let name = command.get_name();
        let call = parsed(command, config.section_of_run(command, &folder)?);
        let call = call.map_err(|error| match error.downcast_ref::<clap::Error>() {
            Some(refused) => refuse(pipeline, &format!("{name}: {}", in_one_line(refused))),
            None => error,
        })?;
        for file in call.stage.outputs() {
            let text = file.display().to_string();
            if let Some(first) = written.insert(resolved(&file), name) {
                return Err(refuse(pipeline, &format!("{first} and {name} both write {text}")));
            }
        }
        calls.push(call);
    }
    for call in &calls {
        let read = call.stage.inputs().into_iter().flat_map(|read| read.paths);
        for path in read.map(|path| split_sheet(&path).0).filter(|path| is_view(path)) {
            if let Some(writer) = written.get(&resolved(&path)) {
                let problem = format!("{writer} writes {}, which {} reads", path.display(), call.name);
                return Err(refuse(pipeline, &problem));
            }
        }
    }
    match calls.is_empty() {
        true => Err(refuse(pipeline, "no stage; expected at least one")),
        false => Ok(calls),
    }
}

fn refuse(pipeline: &Path, problem: &str) -> anyhow::Error {
    UsageError::because(format!("{}: {problem}", pipeline.display()))
}

fn set_threads(common: &Common) -> anyhow::Result<()> {
    let threads = threads_of(common.threads)?.unwrap_or_default().build_global();
    threads.map_err(|error| anyhow::anyhow!("a thread cannot start: {error}"))
}
