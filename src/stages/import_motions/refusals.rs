use std::collections::HashSet;
use std::path::Path;

/// A file that cannot be imported, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Its path as given.
    pub file: String,
    /// What is wrong with it, and what to do.
    pub reason: String,
}

impl Refusal {
    /// Of this file for this reason.
    pub fn of(file: &Path, reason: &impl ToString) -> Refusal {
        Refusal { file: file.display().to_string(), reason: reason.to_string() }
    }
}

/// What is said of files that are refused, whole or in part, of so many.
pub fn summary(refused: &[Refusal], files: usize) -> String {
    let lines: Vec<String> =
        refused.iter().map(|refusal| format!("\n  {}: {}", refusal.file, refusal.reason)).collect();
    let distinct: HashSet<&str> = refused.iter().map(|refusal| refusal.file.as_str()).collect();
    format!("{} of {files} files refused:{}", distinct.len(), lines.concat())
}
