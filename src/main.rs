//! The `rockfrag` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(rockfrag::cli::main(std::env::args_os()))
}
