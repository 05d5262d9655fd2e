//! The `rockfrag` command.

use std::process::ExitCode;

use rockfrag::pipeline::UsageError;

fn main() -> ExitCode {
    match rockfrag::cli::main() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(if error.is::<UsageError>() { 2 } else { 1 })
        }
    }
}
