//! The `rockfrag` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(unix)]
    ignore_size_limit();
    ExitCode::from(rockfrag::cli::main(std::env::args_os()))
}

/// A file that reaches the largest size allowed (`ulimit -f`) is then an error, as on a full disk, and does not
/// end the program before its temporary file is gone.
#[cfg(unix)]
#[expect(unsafe_code, reason = "std has no signals")]
fn ignore_size_limit() {
    const SIGXFSZ: i32 = 25;
    const SIG_IGN: usize = 1;
    unsafe extern "C" {
        fn signal(signal: i32, handler: usize) -> usize;
    }
    // SAFETY: no handler is installed.
    unsafe { signal(SIGXFSZ, SIG_IGN) };
}
