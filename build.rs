//! Hashes the sources, data and dependencies of the program, which are part of the key of every result.

use std::path::{Path, PathBuf};

fn main() {
    let root = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets it"));
    let mut hash = FNV_OFFSET;
    // A package from the registry has no core/: there the lock file has its checksum.
    for folder in
        ["src", "data", "core/src", "core/data"].into_iter().filter(|folder| root.join(folder).is_dir())
    {
        println!("cargo:rerun-if-changed={folder}");
        add_folder(&mut hash, &root.join(folder), folder);
    }
    // Another version of a dependency may give other numbers.
    println!("cargo:rerun-if-changed=Cargo.lock");
    add_file(&mut hash, &root.join("Cargo.lock"), "Cargo.lock");
    println!("cargo:rustc-env=ROCKFRAG_PROGRAM={hash:032x}");
}

/// FNV-1a of 128 bits: std's hash may differ between versions of Rust, and a hash of results must not.
const FNV_OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
const FNV_PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;

fn add(hash: &mut u128, bytes: &[u8]) {
    for byte in bytes {
        *hash = (*hash ^ u128::from(*byte)).wrapping_mul(FNV_PRIME);
    }
}

/// Adds the names and contents of all files, in the order of their names.
fn add_folder(hash: &mut u128, folder: &Path, name: &str) {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut names: Vec<String> =
        entries.flatten().map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    names.retain(|name| !name.starts_with('.'));
    names.sort_unstable();
    for entry in names {
        let (path, name) = (folder.join(&entry), format!("{name}/{entry}"));
        if path.is_dir() {
            add_folder(hash, &path, &name);
        } else {
            add_file(hash, &path, &name);
        }
    }
}

fn add_file(hash: &mut u128, path: &Path, name: &str) {
    let Ok(mut bytes) = std::fs::read(path) else { return };
    // A checkout may end its lines in CR LF.
    bytes.retain(|byte| *byte != b'\r');
    add(hash, name.as_bytes());
    add(hash, &bytes.len().to_le_bytes());
    add(hash, &bytes);
}
