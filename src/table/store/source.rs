//! Where a table is read from and where it is written to: files, or memory where another program calls.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;

/// A table in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct MemoryTable {
    /// What it is called in messages.
    pub name: PathBuf,
    pub schema: SchemaRef,
    /// Its rows, in order.
    pub batches: Vec<RecordBatch>,
}

impl MemoryTable {
    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        self.batches.iter().map(|batch| batch.num_rows() as u64).sum()
    }
}

/// Where a table is read from.
#[derive(Debug, Clone, PartialEq)]
pub enum Source {
    /// A Parquet file, or a folder of them.
    Path(PathBuf),
    /// Memory.
    Memory(Arc<MemoryTable>),
}

impl Source {
    /// What it is called in messages.
    pub fn name(&self) -> &Path {
        match self {
            Source::Path(path) => path,
            Source::Memory(table) => &table.name,
        }
    }
}

impl From<&Source> for Source {
    fn from(source: &Source) -> Source {
        source.clone()
    }
}

impl<P: AsRef<Path>> From<P> for Source {
    fn from(path: P) -> Source {
        Source::Path(path.as_ref().to_path_buf())
    }
}

/// Where a table is written to.
#[derive(Debug, Clone)]
pub enum Target {
    /// A Parquet file.
    Path(PathBuf),
    /// A table in memory, by its name.
    Memory(MemoryTables, String),
}

impl Target {
    /// The path, if it is one.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Target::Path(path) => Some(path),
            Target::Memory(..) => None,
        }
    }

    /// A further output of the same stage: `pex.parquet` becomes `pex.scan.parquet`, memory the place `scan`.
    pub fn part(&self, part: &str) -> Target {
        match self {
            Target::Path(path) => Target::Path(with_part(path, part)),
            Target::Memory(tables, _) => Target::Memory(tables.clone(), part.to_string()),
        }
    }
}

/// `pex.parquet` becomes `pex.scan.parquet`: a further output of the same stage.
pub fn with_part(path: &Path, part: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}.{part}.parquet"))
}

impl<P: AsRef<Path>> From<P> for Target {
    fn from(path: P) -> Target {
        Target::Path(path.as_ref().to_path_buf())
    }
}

/// Tables that a stage leaves in memory, by name.
#[derive(Debug, Clone, Default)]
pub struct MemoryTables(Arc<Mutex<BTreeMap<String, MemoryTable>>>);

impl MemoryTables {
    /// A place on it.
    pub fn place(&self, name: &str) -> Target {
        Target::Memory(self.clone(), name.to_string())
    }

    /// Takes what was left under a name.
    pub fn take(&self, name: &str) -> Option<MemoryTable> {
        self.0.lock().ok()?.remove(name)
    }

    pub(super) fn put(&self, name: &str, table: MemoryTable) {
        if let Ok(mut tables) = self.0.lock() {
            tables.insert(name.to_string(), table);
        }
    }
}
