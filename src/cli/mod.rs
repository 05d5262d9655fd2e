//! The command line: what all commands have in common, and the commands that are no stage.

mod shared;

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches, Subcommand};
use clap_complete::Shell;
use serde_json::json;

use self::shared::{Common, Format, Printed, Progress, expect_no_idle, with_common};
use crate::allocator::keep_freed_buffers;
use crate::pipeline::cache::May;
use crate::pipeline::console::{Console, say};
use crate::pipeline::options::with_number_messages;
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::pipeline::{UsageError, cache};
use crate::stages::init::{Start, init};
use crate::stages::inspect::inspect;
use crate::stages::registry::{Config, commands, shows_table};
use crate::stages::run::{dry_run, findings, run};
use crate::stages::seed_spread::{SeedSpreadOptions, seed_spread};
use crate::table::store::guarded::quiet_damage;
use crate::table::store::provenance::{CODE, Warnings};
use crate::table::store::text;

/// The pipeline file that is read where none is named.
const PIPELINE: &str = "pipeline.yaml";

/// The commands that are no stage.
#[derive(Debug, Subcommand)]
enum Tool {
    /// Run all stages of a pipeline file, skipping what is up to date
    #[command(after_help = "Examples:\n  rockfrag run\n  rockfrag run pipeline.yaml --out tried --seed 7")]
    Run {
        /// The pipeline file
        #[arg(default_value = PIPELINE)]
        pipeline: PathBuf,
        /// Folder of all files [default: as the pipeline file says, or out beside it]
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// Seed of all stages
        #[arg(long)]
        seed: Option<u64>,
        /// Only print what each stage would do, with which options, and why
        #[arg(long)]
        dry_run: bool,
        #[command(flatten)]
        printed: Printed,
    },
    /// Write a folder to start from: a pipeline file, structures, and a README of three commands
    #[command(after_help = "Examples:\n  rockfrag init\n  rockfrag init records --out mine")]
    Init {
        /// Where from: paper (the paper's set-up), records (a folder of records; made-up ones are included), or site (a hazard
        /// curve)
        #[arg(value_enum, default_value = "paper", hide_possible_values = true)]
        start: Start,
        /// Folder to write into; nothing there is replaced
        #[arg(long, value_name = "DIR", default_value = ".")]
        out: PathBuf,
    },
    /// Repeat the pipeline with one seed after the other, to see how far its numbers vary by chance
    #[command(after_help = "Examples:\n  rockfrag seed-spread --seeds 3 --out spread.csv")]
    SeedSpread {
        /// The pipeline file
        #[arg(default_value = PIPELINE)]
        pipeline: PathBuf,
        #[command(flatten)]
        options: SeedSpreadOptions,
    },
    /// Show what a file holds and where it came from
    #[command(
        after_help = "Examples:\n  rockfrag inspect responses.parquet\n  rockfrag inspect responses.parquet --head 3"
    )]
    Inspect {
        /// A Parquet file, or a folder of partitions
        #[arg(value_name = "FILE|DIR")]
        file: PathBuf,
        /// Print the first N rows in place of the columns
        #[arg(long, value_name = "N")]
        head: Option<usize>,
        #[command(flatten)]
        printed: Printed,
    },
    /// Print the completions of a shell: bash, zsh, fish, powershell or elvish
    #[command(
        after_help = "Examples:\n  rockfrag completions bash > rockfrag.bash\n  rockfrag completions fish > rockfrag.fish"
    )]
    Completions {
        /// The shell
        #[arg(value_enum, hide_possible_values = true)]
        shell: Shell,
    },
    /// Write manual pages, one for each command
    #[command(after_help = "Examples:\n  rockfrag man share/man/man1")]
    Man {
        /// The folder to write them to
        folder: PathBuf,
    },
}

const FIRST: &str = "Examples:
  rockfrag evaluate --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6
  rockfrag init";

fn command() -> Command {
    let command = Command::new("rockfrag")
        .version(CODE)
        .max_term_width(100)
        .subcommand_required(true)
        .arg_required_else_help(true);
    let printed: Vec<Arg> = Printed::augment_args(Command::new("")).get_arguments().cloned().collect();
    let stages = commands().into_iter().map(|stage| match shows_table(stage.get_name()) {
        true => stage.args(printed.clone()),
        false => stage,
    });
    let command = command.subcommands(stages.collect::<Vec<_>>());
    with_number_messages(with_common(Tool::augment_subcommands(command)))
        .about("Dimensionless fragility curves for rocking structures in near-fault earthquakes")
        .after_help(FIRST)
}

/// Does what a command line says, whose first word is the program, and gives the code to exit with: 0 done, 1 a failure, 2 a mistake in
/// the call. The command and Python's entry point are this function; it is called once, before there are threads.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    keep_freed_buffers();
    quiet_damage();
    let code = match command().try_get_matches_from(arguments) {
        Ok(matches) => match obey(&matches) {
            Ok(()) => 0,
            Err(error) => {
                say(&format!("error: {error:#}"));
                if error.is::<UsageError>() { 2 } else { 1 }
            }
        },
        // Help and version too.
        Err(told) => {
            let _ = told.print();
            if told.use_stderr() { 2 } else { 0 }
        }
    };
    // A program that is no Rust one would leave the rest of the last line unsaid.
    let _ = std::io::stdout().flush();
    code
}

fn obey(matches: &ArgMatches) -> anyhow::Result<()> {
    let common = Common::from_arg_matches(matches)?;
    let (subcommand, flags) = matches.subcommand().ok_or_else(|| UsageError::because("no subcommand"))?;
    expect_no_idle(subcommand, flags)?;
    let console =
        Console { quiet: common.quiet, progress: common.progress == Progress::Auto, ..Console::default() };
    if let Some(threads) = common.threads {
        if threads == 0 {
            return Err(UsageError::because("threads is 0; expected 1 or more"));
        }
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    }
    let may = May { force: common.force, overwrite: common.overwrite };
    let config = common.config.as_deref().map(Config::read).transpose()?.unwrap_or_default();
    if let Some(stages) = config.called(subcommand, flags)? {
        let format = match shows_table(subcommand) {
            true => Printed::from_arg_matches(flags)?.format,
            false => Format::Table,
        };
        return stages.iter().try_for_each(|stage| {
            cache::run_alone(stage.as_ref(), may, &console)?;
            match format {
                Format::Table => print(&stage.show(&Terminal::stdout())?),
                Format::Json => print(&json(stage.as_ref())?),
            }
        });
    }
    match Tool::from_arg_matches(matches)? {
        Tool::Run { pipeline, out, seed, dry_run: dry, printed } => {
            let config = read_pipeline(&pipeline)?;
            let config = if let Some(seed) = seed { config.with_seed(seed) } else { config };
            let stages = stages_of(&config, &pipeline, out)?;
            if dry { print(&dry_run(&stages, may)?) } else { run_all(&stages, printed.format, may, &console) }
        }
        Tool::Init { start, out } => print(&init(start, &out)?),
        Tool::SeedSpread { pipeline, options } => {
            seed_spread(&pipeline, &options, may, &Console { progress: false, ..console })
        }
        Tool::Inspect { file, head, printed: Printed { format } } => match format {
            Format::Table => print(&inspect(&file, head)?.text(&Terminal::stdout())),
            Format::Json => print(&inspect(&file, head)?.json()),
        },
        Tool::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command(), "rockfrag", &mut script);
            print(&String::from_utf8(script)?)
        }
        Tool::Man { folder } => {
            std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
            clap_mangen::generate_to(command(), &folder).with_context(|| folder.display().to_string())?;
            let first = folder.join("rockfrag.1");
            print(&format!(
                "wrote {} and a page of each command; read them with: man -l FILE\n",
                first.display()
            ))
        }
    }
}

/// Reads a pipeline file; where there is none, says how to get one.
fn read_pipeline(path: &Path) -> anyhow::Result<Config> {
    if path == Path::new(PIPELINE) && !path.exists() {
        return Err(UsageError::because(format!(
            "no {PIPELINE} here; `rockfrag init` writes one to start from, or name the pipeline file"
        )));
    }
    Config::read(path)
}

fn stages_of(config: &Config, pipeline: &Path, out: Option<PathBuf>) -> anyhow::Result<Vec<Box<dyn Stage>>> {
    let stages = config.stages(&out.or(config.out.clone()).unwrap_or_default())?;
    if stages.is_empty() {
        return Err(UsageError::because(format!("{}: no stage; expected at least one", pipeline.display())));
    }
    Ok(stages)
}

/// Runs stages, then prints what they found: their tables, and then in words, which stay in sight.
fn run_all(stages: &[Box<dyn Stage>], format: Format, may: May, console: &Console) -> anyhow::Result<()> {
    let is_of_paper = Config::is_of_paper(stages)?;
    let expected = is_of_paper.then(Warnings::default);
    run(stages, may, &Console { expected: expected.clone(), ..console.clone() })?;
    let expected = expected.map_or(0, |expected| expected.all().len());
    if expected > 0 {
        console.note(&format!(
            "{expected} warnings, all expected of the paper's set-up: measures that say little, and curves that their tests reject; \
             `rockfrag inspect FILE` shows those of a file"
        ));
    }
    let findings = findings::of(stages, is_of_paper)?;
    match format {
        Format::Table => {
            let terminal = Terminal::stdout();
            let shown =
                stages.iter().map(|stage| stage.show(&terminal)).collect::<anyhow::Result<String>>()?;
            let gap = if findings.is_empty() || shown.is_empty() { "" } else { "\n" };
            print(&format!(
                "{shown}{gap}{}",
                findings.iter().map(|line| format!("{line}\n")).collect::<String>()
            ))
        }
        Format::Json => {
            let each = |stage: &dyn Stage| Ok(format!("\"{}\": {}", stage.name(), json(stage)?));
            let each = stages.iter().map(|stage| each(stage.as_ref())).collect::<anyhow::Result<Vec<_>>>()?;
            print(&format!("{{\n\"findings\": {},\n{}}}\n", json!(findings), each.join(",\n")))
        }
    }
}

/// The table that a stage shows, with the warnings of its file.
fn json(stage: &dyn Stage) -> anyhow::Result<String> {
    let recorded = stage.outputs().last().map(|path| stage.recorded(path)).transpose()?.flatten();
    let warnings = recorded.map_or(Vec::new(), |recorded| recorded.provenance.warnings.all());
    Ok(text::json_with_warnings(&warnings, &stage.rows()?.unwrap_or_default()))
}

/// To stdout; a reader that has seen enough (`| head`) is no error.
fn print(text: &str) -> anyhow::Result<()> {
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done?),
    }
}
