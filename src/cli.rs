//! The command line: what all commands have in common, and those that are no stage.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{Args, Command, FromArgMatches, Subcommand, ValueEnum};

use crate::pipeline::cache::May;
use crate::pipeline::console::Console;
use crate::pipeline::terminal::Terminal;
use crate::pipeline::{UsageError, cache};
use crate::stages::inspect::inspect;
use crate::stages::registry::{Config, commands};
use crate::stages::run::{dry_run, run};
use crate::stages::seed_spread::{SeedSpreadOptions, seed_spread};

#[derive(Debug, Args)]
#[command(next_help_heading = "Common options")]
struct Common {
    /// Pipeline file whose options hold where no flag is given
    #[arg(long, global = true, value_name = "FILE")]
    config: Option<PathBuf>,
    /// Threads [default: all cores]
    #[arg(long, global = true, value_name = "N")]
    threads: Option<usize>,
    /// Say nothing but errors and results
    #[arg(long, global = true)]
    quiet: bool,
    /// Progress bars on a terminal
    #[arg(long, global = true, default_value = "auto")]
    progress: Progress,
    /// Run even what is up to date
    #[arg(long, global = true)]
    force: bool,
    /// Write over files that another stage or program has made
    #[arg(long, global = true)]
    overwrite: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Progress {
    Auto,
    Never,
}

/// The commands that are no stage.
#[derive(Debug, Subcommand)]
enum Tool {
    /// Run all stages of a pipeline file, skipping what is up to date
    Run {
        /// The pipeline file
        #[arg(default_value = "pipeline.yaml")]
        pipeline: PathBuf,
        /// Folder of all files [default: as the pipeline file says, or out beside it]
        #[arg(long)]
        out: Option<PathBuf>,
        /// Seed of all stages
        #[arg(long)]
        seed: Option<u64>,
        /// Only print the resolved plan, and why each stage would or would not run
        #[arg(long)]
        dry_run: bool,
    },
    /// Repeat the pipeline over seeds, to see how far its numbers move by chance
    SeedSpread {
        /// The pipeline file
        #[arg(default_value = "pipeline.yaml")]
        pipeline: PathBuf,
        #[command(flatten)]
        options: SeedSpreadOptions,
    },
    /// Show what a file holds and where it came from
    Inspect {
        /// A Parquet file
        file: PathBuf,
    },
}

fn command() -> Command {
    let command = Command::new("rockfrag")
        .version(crate::VERSION)
        .max_term_width(100)
        .subcommand_required(true)
        .arg_required_else_help(true);
    let command = Common::augment_args(command).subcommands(commands());
    Tool::augment_subcommands(command)
        .about("Dimensionless fragility curves for rocking structures in near-fault earthquakes")
}

/// Parses the command line and does what it says.
///
/// # Errors
/// Those of the stage that was called; [`UsageError`] for a mistake in the call.
pub fn main() -> anyhow::Result<()> {
    let matches = command().get_matches();
    let common = Common::from_arg_matches(&matches)?;
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
    let (subcommand, flags) = matches.subcommand().ok_or_else(|| UsageError::because("no subcommand"))?;
    if let Some(stages) = config.called(subcommand, flags)? {
        return stages.iter().try_for_each(|stage| {
            cache::run_alone(stage.as_ref(), may, &console)?;
            print(&stage.show(&Terminal::stdout())?)
        });
    }
    match Tool::from_arg_matches(&matches)? {
        Tool::Run { pipeline, out, seed, dry_run } => {
            let config = Config::read(&pipeline)?;
            let config = if let Some(seed) = seed { config.with_seed(seed) } else { config };
            run_all(&config, &pipeline, out, dry_run, may, &console)
        }
        Tool::SeedSpread { pipeline, options } => {
            seed_spread(&pipeline, &options, may, &Console { progress: false, ..console })
        }
        Tool::Inspect { file } => print(&inspect(&file, &Terminal::stdout())?),
    }
}

fn run_all(
    config: &Config,
    pipeline: &Path,
    out: Option<PathBuf>,
    dry: bool,
    may: May,
    console: &Console,
) -> anyhow::Result<()> {
    let stages = config.stages(&out.or(config.out.clone()).unwrap_or_default())?;
    if stages.is_empty() {
        return Err(UsageError::because(format!("{}: no stage; expected at least one", pipeline.display())));
    }
    if dry {
        return print(&dry_run(&stages, may)?);
    }
    run(&stages, may, console)?;
    stages.iter().try_for_each(|stage| print(&stage.show(&Terminal::stdout())?))
}

/// To stdout; a reader that has seen enough (`| head`) is no error.
fn print(text: &str) -> anyhow::Result<()> {
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done?),
    }
}
