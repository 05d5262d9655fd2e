//! The `rockfrag` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    // Frames are small: one thread of polars beside those of --threads.
    // SAFETY: no other thread runs yet.
    #[allow(unsafe_code)]
    unsafe {
        std::env::set_var("POLARS_MAX_THREADS", "1")
    };
    ExitCode::from(rockfrag::cli::main(std::env::args_os()))
}
