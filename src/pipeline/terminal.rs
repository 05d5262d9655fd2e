//! All that is printed. Names and files of others may hold letters that move, colour or reorder a terminal.

use std::io::{ErrorKind, Write, stderr, stdout};

use crate::number::visible;
use crate::table::frame::Format;

/// Hidden letters of our own texts.
const OURS: [char; 2] = ['\n', '\t'];

/// Prints to stdout: CSV, which knows no escapes, to the letter. A closed pipe (`| head`) is not an error.
pub fn print(text: &str, format: Format) -> anyhow::Result<()> {
    let text = if format == Format::Csv { text.into() } else { visible(text, &OURS) };
    let mut stdout = stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        done => Ok(done?),
    }
}

/// Prints to stderr, if anyone listens there.
pub fn tell(text: &str) {
    let _ = writeln!(stderr(), "{}", visible(text, &OURS));
}
