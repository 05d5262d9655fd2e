//! The bytes of people's files, of which a pipe gives its own only once.

use std::cell::Cell;
use std::collections::HashMap;
use std::io::{self, Read};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::{LazyLock, Mutex};

/// The most bytes of a pipe or device, which may have no end.
const MOST_PIPED: u64 = 200 << 20;

/// What pipes have given so far.
static PIPES: LazyLock<Mutex<HashMap<PathBuf, Vec<u8>>>> = LazyLock::new(Mutex::default);

/// Reads a file, or `-` from stdin. What a pipe gave is kept for whoever reads it again.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let is_stdin = path == Path::new("-");
    if !is_stdin && !is_pipe(path) {
        return std::fs::read(path);
    }
    let mut pipes = PIPES.lock().map_err(|_| io::Error::other("reading it failed before"))?;
    if let Some(bytes) = pipes.get(path) {
        return Ok(bytes.clone());
    }
    let mut bytes = Vec::new();
    let pipe: Box<dyn Read> =
        if is_stdin { Box::new(io::stdin()) } else { Box::new(std::fs::File::open(path)?) };
    if pipe.take(MOST_PIPED).read_to_end(&mut bytes)? as u64 == MOST_PIPED {
        return Err(io::Error::other("a pipe or device without an end; expected a file"));
    }
    pipes.insert(path.to_path_buf(), bytes.clone());
    Ok(bytes)
}

/// Splits the path of a sheet of a workbook, `list.xlsx#Sheet2`; both may have the sign in their names.
pub fn split_sheet(path: &Path) -> (PathBuf, Option<String>) {
    let text = path.to_str().filter(|_| !path.exists()).unwrap_or_default();
    let splits = || text.match_indices('#').map(|(at, _)| (&text[..at], &text[at + 1..]));
    match splits().find(|(file, _)| Path::new(file).exists()).or(splits().next_back()) {
        Some((file, sheet)) => (PathBuf::from(file), Some(sheet.to_string())),
        None => (path.to_path_buf(), None),
    }
}

/// Returns whether a path is there and neither a file nor a folder.
pub fn is_pipe(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

/// Forgets what pipes gave: a later call may find other bytes in them.
pub fn forget_pipes() {
    if let Ok(mut pipes) = PIPES.lock() {
        pipes.clear();
    }
}

thread_local! {
    static GUARDED: Cell<bool> = const { Cell::new(false) };
}

/// Calls a decoder of others, which may panic on a damaged file: then none.
pub fn guarded<T>(read: impl FnOnce() -> T) -> Option<T> {
    let before = GUARDED.replace(true);
    let read = catch_unwind(AssertUnwindSafe(read));
    GUARDED.set(before);
    read.ok()
}

/// Silences the panics of decoders, which are reported as errors.
pub fn silence_decoder_panics() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !GUARDED.get() {
            usual(panic);
        }
    }));
}
