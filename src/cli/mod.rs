//! The command line: commands, their runs, and all that is printed. Names and files of others may hold
//! letters that move, colour or reorder a terminal.

pub mod calls;

use std::any::TypeId;
use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{ErrorKind, Write, stderr, stdout};
use std::path::PathBuf;
use std::time::Instant;

use anyhow::Context as _;
use clap::{Arg, ArgAction, Command, FromArgMatches, Parser, value_parser};
use clap_complete::Shell;
use rockfrag_core::fragility::{MotionKind, Peak};
use rockfrag_core::motion::Suite;
use rockfrag_core::object::Base;
use rockfrag_core::warning::Warnings;
use serde_json::{Value, json};
use strum::VariantArray;

use crate::inputs::Reading;
use crate::number::{LONGEST_TEXT, shown, visible};
use crate::pipeline::UsageError;
use crate::pipeline::call::{Call, Planned, is_view};
use crate::pipeline::context::{COMMON, Common, threads_of};
use crate::pipeline::options::{SeveralErrors, is_path, name_of, on_line};
use crate::source::silence_decoder_panics;
use crate::stages::shared::model_args::ModelName;
use crate::stages::{self, StageKind, init, inspect};
use crate::table::frame::Format;
use crate::table::provenance::{Provenance, on_command_line};

const NO_THREAD: &str = "a thread cannot start";
/// Letters of an error, which may name what a file says.
const LONGEST_ERROR: usize = 2000;
/// Stages whose text is what people make a folder for.
const STAGES_WITH_ANSWER: [&str; 4] = ["ida", "fit-pro", "compare-paper", "evaluate"];
/// Warnings that are printed.
const SHOWN: usize = 3;
/// Hidden letters of our own texts.
const OURS: [char; 2] = ['\n', '\t'];

/// How likely free-standing structures are to rock or overturn in an earthquake, and how often at a site
#[derive(Debug, Parser)]
#[command(name = "rockfrag", version, arg_required_else_help = true, args_override_self = true)]
#[command(after_help = "First: rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6")]
enum Tool {
    /// Run all stages of a pipeline file, skipping what is up to date
    Run {
        /// Pipeline file
        #[arg(default_value = "pipeline.yaml")]
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
    /// Write a folder to start from: paper (the paper's set-up), records (your records), site (a hazard
    /// curve) or list (objects)
    Init {
        #[arg(value_enum, default_value = "paper")]
        start: init::Start,
        /// Folder to write into; nothing there is replaced
        #[arg(long, value_name = "DIR", default_value = ".")]
        out: PathBuf,
    },
    /// Show what a file holds and where it came from
    Inspect(inspect::Inspect),
    /// Print the completions of a shell
    Completions { shell: Shell },
}

/// All commands. The options of stages are texts here, and none is required: a pipeline file may have it.
pub fn command() -> Command {
    let of_stage = |arg: Arg| {
        let is_usual = arg.get_long().is_none_or(|flag| USUAL.split(' ').any(|usual| usual == flag));
        arg.hide_short_help(!is_usual).required(false).value_parser(value_parser!(String))
    };
    let stages = stages::all().into_iter().map(|kind| kind.command.mut_args(of_stage));
    <Tool as clap::CommandFactory>::command().subcommands(stages)
}

/// The options that `-h` shows; `--help` shows all.
const USUAL: &str = "about all author candidate column depth dt eta fits from hazard height in keep-going \
                     level limit-state magnitude measure motions mw name out over pairs partition period \
                     pex pga pgv pro re rotate sa samples scale seed site structure structures suite \
                     target terms title to trace unit vs30 width";

pub fn describe() -> Value {
    let stages = stages::all().into_iter().map(|StageKind { command, .. }| {
        let options: Vec<Value> = command.get_arguments().map(option).collect();
        let help = command.get_about().map(ToString::to_string);
        json!({ "name": command.get_name(), "help": help, "options": options })
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
    json!({
        "name": name,
        "kind": kind,
        "type": type_of(arg),
        "many": arg.get_value_delimiter().is_some() || matches!(arg.get_action(), ArgAction::Append),
        "default": arg.get_default_values().first().map_or("".into(), |text| text.to_string_lossy()),
        "help": arg.get_help().map(ToString::to_string),
        "positional": arg.is_positional(),
        "common": arg.get_help_heading() == Some(COMMON),
    })
}

/// What an option takes: float, int, path, one of some words, or text.
fn type_of(arg: &Arg) -> Value {
    fn words<T: VariantArray + ToString + 'static>() -> (TypeId, Value) {
        (TypeId::of::<T>(), T::VARIANTS.iter().map(T::to_string).collect())
    }
    let known = [
        (TypeId::of::<f64>(), json!("float")),
        (TypeId::of::<u32>(), json!("int")),
        (TypeId::of::<u64>(), json!("int")),
        (TypeId::of::<usize>(), json!("int")),
        (TypeId::of::<PathBuf>(), json!("path")),
        words::<Base>(),
        words::<Format>(),
        words::<ModelName>(),
        words::<MotionKind>(),
        words::<Peak>(),
        words::<Suite>(),
    ];
    let id = arg.get_value_parser().type_id();
    known.into_iter().find(|(known, _)| id == *known).map_or(json!("text"), |(_, words)| words)
}

/// Runs a command line, program name first. Returns the exit code: 0 success, 1 failure, 2 wrong usage.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    silence_decoder_panics();
    let error = match run(arguments) {
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

fn run(arguments: impl IntoIterator<Item = OsString>) -> anyhow::Result<u8> {
    let matches = command().try_get_matches_from(arguments)?;
    if let Some((name, matches)) = matches.subcommand()
        && let Some(stage) = stages::all().into_iter().find(|stage| stage.name() == name)
    {
        let call = calls::of_stage(&stage, on_line(&stage.command, matches))?;
        threads_of(call.common.threads)?.build_global().context(NO_THREAD)?;
        return run_one(&call).map(|()| 0);
    }
    let text = match Tool::from_arg_matches(&matches)? {
        Tool::Run { pipeline, out, seed, dry_run: is_dry, check, mut common } => {
            threads_of(common.threads)?.build_global().context(NO_THREAD)?;
            let calls = calls::of_run(&pipeline, out, seed)?;
            common.is_run = true;
            if !(is_dry || check) {
                return run_all(&calls, &common).map(|()| 0);
            }
            let (plan, is_due) = dry_run(&calls, &common)?;
            print(&plan, Format::Text)?;
            return Ok(u8::from(check && is_due));
        }
        Tool::Init { start, out } => init::init(start, &out)?,
        Tool::Inspect(inspect) => return print(&inspect.run()?, inspect.format).map(|()| 0),
        Tool::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command(), "rockfrag", &mut script);
            String::from_utf8(script)?
        }
    };
    print(&text, Format::Text).map(|()| 0)
}

fn run_one(call: &Call) -> anyhow::Result<()> {
    let done = call.run(&call.common, &mut Planned::new())?;
    if !done.ran && !call.common.quiet {
        tell(&format!("{}: up to date", call.name));
    }
    print(&done.made.summary, call.stage.format())?;
    tell_gaps(&done.made);
    warn(&done.made.warnings);
    Ok(())
}

/// Runs the stages that are not up to date, and prints the text of the last answer, else of the last stage.
fn run_all(calls: &[Call], common: &Common) -> anyhow::Result<()> {
    let (mut printed, mut warnings, mut made) = (String::new(), Warnings::default(), Planned::new());
    let answer =
        calls.iter().rposition(|call| STAGES_WITH_ANSWER.contains(&&*call.name)).unwrap_or(calls.len() - 1);
    for (place, call) in calls.iter().enumerate() {
        let start = Instant::now();
        let done = call.run(common, &mut made).with_context(|| call.name.clone())?;
        if !common.quiet {
            let seconds = start.elapsed().as_secs_f64();
            let took = if done.ran { format!("{seconds:.2} s") } else { "up to date".to_string() };
            tell(&format!("{:20} {took}", call.name));
        }
        warnings.join(&done.made.warnings);
        tell_gaps(&done.made);
        if place == answer {
            printed = done.made.summary;
        }
    }
    warn(&warnings);
    print(&printed, calls[answer].stage.format())
}

/// Names the columns that are not understood where what is printed does not.
fn tell_gaps(made: &Provenance) {
    let gaps = made.readings.iter().filter_map(Reading::gaps);
    gaps.filter(|gaps| !made.summary.contains(gaps)).for_each(|gaps| tell(&gaps));
}

fn warn(warnings: &Warnings) {
    let lines = warnings.lines();
    for (after, line) in (0..lines.len()).rev().zip(&lines).take(SHOWN) {
        let is_cut = after > 0 && after + SHOWN == lines.len();
        let more = if is_cut { format!(" ({after} more: rockfrag inspect)") } else { String::new() };
        tell(&format!("warning: {line}{more}"));
    }
}

/// Lists what each stage would do, with its options, and why; and whether any would run.
fn dry_run(calls: &[Call], common: &Common) -> anyhow::Result<(String, bool)> {
    let (mut text, mut is_due) = (String::new(), false);
    let mut planned = Planned::new();
    for call in calls {
        let plan = call.plan(&planned)?;
        planned.extend(plan.keys());
        let would = match call.freshness(&plan) {
            Ok(_) if !common.force => "up to date".to_string(),
            fresh => {
                is_due |= plan.outputs.iter().any(|path| !is_view(path) || !path.exists());
                let reason = fresh.err().unwrap_or("--force".to_string());
                let refused = plan.expect_replaceable(&plan.outputs, common).err();
                refused.map_or(format!("run: {reason}"), |refused| format!("cannot run: {refused}"))
            }
        };
        writeln!(text, "{}: {}", call.name, shown(&would, LONGEST_TEXT))?;
        for option in call.options.iter().flat_map(|(name, value)| on_command_line(name, value)) {
            writeln!(text, "    {}", shown(&option, LONGEST_TEXT))?;
        }
        for read in call.stage.files().read.iter().filter(|read| !read.paths.is_empty()) {
            let paths: Vec<String> = read.paths.iter().map(|path| path.display().to_string()).collect();
            writeln!(text, "    --{} {}", read.flag, shown(&paths.join(" "), LONGEST_TEXT))?;
        }
    }
    Ok((text, is_due))
}

/// Prints to stdout: CSV, which knows no escapes, to the letter. A closed pipe (`| head`) is not an error.
fn print(text: &str, format: Format) -> anyhow::Result<()> {
    let text = if format == Format::Csv { text.into() } else { visible(text, &OURS) };
    let mut stdout = stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done?),
    }
}

/// Prints to stderr, if anyone listens there.
fn tell(text: &str) {
    let _ = writeln!(stderr(), "{}", visible(text, &OURS));
}
