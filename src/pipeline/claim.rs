//! Which runs may write into a folder at the same time.

use std::fs::{File, TryLockError};
use std::path::Path;

use super::console::Console;

/// What a run does in a folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Claim {
    /// It writes files that are read again in the same run: no other may come between.
    Alone,
    /// It writes files that are whole by themselves.
    Shared,
}

/// A folder that is claimed until this is dropped, or the run ends in whatever way.
pub struct Claimed {
    _folder: Option<File>,
}

/// Claims a folder, and waits for other runs that do not go together with this one. A file system that knows no locks
/// claims nothing.
pub fn claim(folder: &Path, claim: Claim, console: &Console) -> Claimed {
    let Ok(file) = File::open(folder) else { return Claimed { _folder: None } };
    let tried = match claim {
        Claim::Alone => file.try_lock(),
        Claim::Shared => file.try_lock_shared(),
    };
    if let Err(TryLockError::WouldBlock) = tried {
        console.note(&format!("waiting for another run in {}", folder.display()));
        let waited = match claim {
            Claim::Alone => file.lock(),
            Claim::Shared => file.lock_shared(),
        };
        return Claimed { _folder: waited.is_ok().then_some(file) };
    }
    Claimed { _folder: Some(file) }
}
