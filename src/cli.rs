//! The command line: what all commands have in common, and those that are no stage.

use std::ffi::OsString;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Args, Command, FromArgMatches, Subcommand, ValueEnum};

use crate::allocator::keep_freed_buffers;
use crate::pipeline::cache::May;
use crate::pipeline::console::Console;
use crate::pipeline::terminal::Terminal;
use crate::pipeline::{UsageError, cache};
use crate::stages::inspect::inspect;
use crate::stages::registry::{Config, commands};
use crate::stages::run::{dry_run, run};
use crate::stages::seed_spread::{SeedSpreadOptions, seed_spread};
use crate::table::store::guarded::quiet_damage;

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
        .version(env!("CARGO_PKG_VERSION"))
        .max_term_width(100)
        .subcommand_required(true)
        .arg_required_else_help(true);
    let command = Common::augment_args(command).subcommands(commands());
    Tool::augment_subcommands(command)
        .about("Dimensionless fragility curves for rocking structures in near-fault earthquakes")
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
                eprintln!("error: {error:#}");
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
    match Tool::from_arg_matches(matches)? {
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
