//! The `rockfrag` command.

use std::process::ExitCode;
use std::sync::Arc;

fn main() -> ExitCode {
    // A file that reaches the largest size allowed (`ulimit -f`) is then an error, as on a full disk, and does
    // not end the program before its temporary file is gone.
    #[cfg(unix)]
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
    ExitCode::from(rockfrag::cli::main(std::env::args_os()))
}
