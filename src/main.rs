//! The `rockfrag` command.

mod allocator;

use std::process::ExitCode;

use rockfrag::pipeline::UsageError;
use rockfrag::table::store::guarded::quiet_damage;

fn main() -> ExitCode {
    allocator::keep_freed_buffers();
    quiet_damage();
    match rockfrag::cli::main() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(if error.is::<UsageError>() { 2 } else { 1 })
        }
    }
}
