//! Files that a user names: folders walked, contents hashed.

use std::collections::HashSet;
use std::fs::File;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

/// The files of a list of files and folders: folders are walked in order of names, hidden entries left out, and no file
/// counts twice. A folder that cannot be read stands for itself, so that whoever reads it finds out why.
pub fn expand(paths: &[PathBuf]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            walk(path, &mut files);
        } else {
            files.push(path.clone());
        }
    }
    let mut seen = HashSet::new();
    files.retain(|file| seen.insert(file.clone()));
    files
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        files.push(folder.to_path_buf());
        return;
    };
    let mut entries: Vec<_> = entries.flatten().collect();
    entries.sort_by_key(std::fs::DirEntry::file_name);
    for entry in entries.iter().filter(|entry| !entry.file_name().to_string_lossy().starts_with('.')) {
        let path = entry.path();
        // Links to folders are not followed, since they may lead back.
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            walk(&path, files);
        } else if path.is_file() {
            files.push(path);
        }
    }
}

/// The fingerprint of files by their names and what they hold; one that cannot be read counts as such.
pub fn content_of_all(files: &[PathBuf]) -> String {
    let hashes: Vec<String> =
        files.par_iter().map(|file| hash(file).unwrap_or_else(|error| error.to_string())).collect();
    let mut whole = blake3::Hasher::new();
    for (file, hash) in files.iter().zip(hashes) {
        whole.update(format!("{}\n{hash}\n", file.display()).as_bytes());
    }
    whole.finalize().to_hex().to_string()
}

/// The BLAKE3 hash of a file.
///
/// # Errors
/// If it cannot be read.
pub fn hash(file: &Path) -> std::io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(File::open(file)?)?;
    Ok(hasher.finalize().to_hex().to_string())
}
