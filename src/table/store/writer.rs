//! Writes a table beside its name and renames it when it is whole; or leaves it in memory.

use std::fs::File;
use std::ops::Range;
use std::path::{Path, PathBuf};

use arrow_array::cast::AsArray;
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::errors::ParquetError;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::schema::types::ColumnPath;
use tempfile::NamedTempFile;

use super::contents::expect_unchanged;
use super::fingerprint::Fingerprint;
use super::limits::MOST_SAMPLES;
use super::provenance::Provenance;
use super::source::{MemoryTable, MemoryTables, Target};
use crate::motion::LONGEST_MOTION;
use crate::table::TableError;
use crate::table::schema::{Kind, Table};

/// The end of the name of a file that is still being written.
const PARTIAL: &str = ".partial";

/// Rows after which a batch ends a row group, where the stage itself ends none: few, since they are held until then.
const ROWS_IN_GROUP: usize = 4096;

/// Row groups that a Parquet file has room for.
const MOST_ROW_GROUPS: usize = 32_767;

/// Writes the batches of one table in order.
pub struct TableWriter(Destination);

enum Destination {
    File(Box<FileWriter>),
    Memory(MemoryTables, String, MemoryTable),
}

/// A file on its way to its name.
struct FileWriter {
    path: PathBuf,
    provenance: Provenance,
    writer: ArrowWriter<File>,
    /// Locked while it is written, so that another run can tell a live file from a stray one.
    partial: NamedTempFile,
    fingerprint: Fingerprint,
    /// Batches since the last row group ended.
    waiting: usize,
    /// Samples since then.
    samples: u64,
}

impl TableWriter {
    /// Starts a file that will stand at `path` once it is finished. Without a finish nothing stays behind.
    ///
    /// # Errors
    /// If the folder is not there or cannot be written.
    pub fn create(
        target: impl Into<Target>,
        table: &Table,
        provenance: Provenance,
    ) -> Result<TableWriter, TableError> {
        TableWriter::with_schema(target, table, table.schema(), provenance)
    }

    /// As [`TableWriter::create`], with a schema that differs from the table's own (the type of motion_id).
    ///
    /// # Errors
    /// As there.
    pub fn with_schema(
        target: impl Into<Target>,
        table: &Table,
        schema: SchemaRef,
        provenance: Provenance,
    ) -> Result<TableWriter, TableError> {
        Ok(TableWriter(match target.into() {
            Target::Path(path) => {
                Destination::File(Box::new(FileWriter::create(&path, table, schema, provenance)?))
            }
            Target::Memory(tables, name) => {
                let empty = MemoryTable { name: table.name.into(), schema, batches: Vec::new() };
                Destination::Memory(tables, name, empty)
            }
        }))
    }

    /// Says in the file that it came to be otherwise than planned, so that it does not count as up to date.
    pub fn made_otherwise(&mut self, provenance: Provenance) {
        if let Destination::File(file) = &mut self.0 {
            file.provenance = provenance;
        }
    }

    /// Appends a batch and ends the row group, so that a reader streams what was written together; but where most of the row
    /// groups that a file has room for are there, several batches share one.
    ///
    /// # Errors
    /// If the disk is full or the batch has other columns.
    pub fn write_row_group(&mut self, batch: &RecordBatch) -> Result<(), TableError> {
        match &mut self.0 {
            Destination::File(file) => file.write_row_group(batch),
            Destination::Memory(..) => self.append(batch),
        }
    }

    /// Appends a batch.
    ///
    /// # Errors
    /// If the disk is full or the batch has other columns.
    pub fn append(&mut self, batch: &RecordBatch) -> Result<(), TableError> {
        match &mut self.0 {
            Destination::File(file) => file.append(batch),
            Destination::Memory(_, _, table) => {
                table.batches.push(batch.clone());
                Ok(())
            }
        }
    }

    /// Completes the file and puts it at its name.
    ///
    /// # Errors
    /// If the disk is full, the name cannot be taken, or an input is no longer what it was.
    pub fn finish(self) -> Result<(), TableError> {
        match self.0 {
            Destination::File(file) => file.finish(),
            Destination::Memory(tables, name, table) => {
                tables.put(&name, table);
                Ok(())
            }
        }
    }
}

impl FileWriter {
    fn create(
        path: &Path,
        table: &Table,
        schema: SchemaRef,
        provenance: Provenance,
    ) -> Result<FileWriter, TableError> {
        let failed = |message: String| TableError::Write { path: path.to_path_buf(), message };
        let partial = temporary_beside(path)?;
        partial.as_file().try_lock().map_err(|source| failed(source.to_string()))?;
        let file = partial.as_file().try_clone().map_err(|source| failed(source.to_string()))?;
        let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties(table)))
            .map_err(|source| failed(words(&source)))?;
        let fingerprint = Fingerprint::new(schema);
        Ok(FileWriter {
            path: path.to_path_buf(),
            provenance,
            writer,
            partial,
            fingerprint,
            waiting: 0,
            samples: 0,
        })
    }

    fn write_row_group(&mut self, batch: &RecordBatch) -> Result<(), TableError> {
        self.write(batch)?;
        if self.waiting < self.share() { Ok(()) } else { self.end_row_group() }
    }

    fn append(&mut self, batch: &RecordBatch) -> Result<(), TableError> {
        self.write(batch)?;
        let most = ROWS_IN_GROUP * self.share();
        if self.writer.in_progress_rows() < most { Ok(()) } else { self.end_row_group() }
    }

    /// Appends a batch; a row group that would get more samples than are read from one ends before.
    fn write(&mut self, batch: &RecordBatch) -> Result<(), TableError> {
        self.fingerprint.update(batch);
        let mut first = 0;
        for (row, samples) in samples_of_rows(batch).into_iter().enumerate() {
            if samples > LONGEST_MOTION as u64 {
                let message = format!("a motion of {samples} samples; expected {LONGEST_MOTION} at most");
                return Err(TableError::Write { path: self.path.clone(), message });
            }
            if self.samples + samples > MOST_SAMPLES {
                self.write_rows(batch, first..row)?;
                self.end_row_group()?;
                first = row;
            }
            self.samples += samples;
        }
        self.write_rows(batch, first..batch.num_rows())?;
        self.waiting += 1;
        Ok(())
    }

    fn write_rows(&mut self, batch: &RecordBatch, rows: Range<usize>) -> Result<(), TableError> {
        if self.writer.flushed_row_groups().len() >= MOST_ROW_GROUPS && !rows.is_empty() {
            let message = "more rows than a Parquet file has room for; make it in parts (--partition)";
            return Err(TableError::Write { path: self.path.clone(), message: message.to_string() });
        }
        let rows = batch.slice(rows.start, rows.len());
        self.writer.write(&rows).map_err(|source| self.failed(&source))
    }

    fn end_row_group(&mut self) -> Result<(), TableError> {
        (self.waiting, self.samples) = (0, 0);
        self.writer.flush().map_err(|source| self.failed(&source))
    }

    /// How many times larger than the first row groups the next one is: once, until half the room for them is taken, and ever
    /// more as it goes.
    fn share(&self) -> usize {
        let left = MOST_ROW_GROUPS.saturating_sub(self.writer.flushed_row_groups().len());
        MOST_ROW_GROUPS / left.max(1)
    }

    fn finish(mut self) -> Result<(), TableError> {
        expect_unchanged(&self.provenance)?;
        for pair in self.provenance.key_values(&self.fingerprint.finish()) {
            self.writer.append_key_value_metadata(pair);
        }
        self.writer.finish().map_err(|source| self.failed(&source))?;
        let failed = |message: String| TableError::Write { path: self.path.clone(), message };
        self.partial.as_file().sync_all().map_err(|source| failed(source.to_string()))?;
        self.partial.persist(&self.path).map_err(|refused| failed(refused.error.to_string()))?;
        Ok(())
    }

    fn failed(&self, source: &ParquetError) -> TableError {
        TableError::Write { path: self.path.clone(), message: words(source) }
    }
}

/// How many samples each row has; nothing of a table without samples.
fn samples_of_rows(batch: &RecordBatch) -> Vec<u64> {
    let is_list = |field: &DataType| matches!(field, DataType::List(_));
    let Some(list) = batch.columns().iter().find(|column| is_list(column.data_type())) else {
        return Vec::new();
    };
    let offsets = list.as_list::<i32>().value_offsets();
    offsets.windows(2).map(|pair| (pair[1] - pair[0]) as u64).collect()
}

/// The operating system's words, without the names of the layers they came through.
fn words(source: &ParquetError) -> String {
    match source {
        ParquetError::External(inner) => inner.to_string(),
        other => other.to_string(),
    }
}

/// A file in the folder of `path` that can take its name when it is whole; strays of killed runs are removed.
pub(super) fn temporary_beside(path: &Path) -> Result<NamedTempFile, TableError> {
    let failed = |message: String| TableError::Write { path: path.to_path_buf(), message };
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let name = path.file_name().ok_or_else(|| failed("that is not a file name".to_string()))?;
    let prefix = format!(".{}.", name.to_string_lossy());
    remove_strays(folder, &prefix);
    let mut partial = tempfile::Builder::new();
    partial.prefix(&prefix).suffix(PARTIAL);
    // Those that any new file gets, not the private ones of a temporary file.
    #[cfg(unix)]
    partial.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    partial.tempfile_in(folder).map_err(|source| failed(format!("{source} (folder {})", folder.display())))
}

/// Partial files of the same name that no living run holds: a killed run left them.
fn remove_strays(folder: &Path, prefix: &str) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(prefix)
            && name.ends_with(PARTIAL)
            && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok())
        {
            // A stray that cannot be removed does no harm.
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Samples as split bytes and lightly compressed: smaller than plain, and as fast to read as it matters; a dictionary
/// or statistics of samples would only cost time and room. What stands beside them, some numbers in each row group, would
/// hardly shrink, and to get ready for it takes longer than to read it.
fn properties(table: &Table) -> WriterProperties {
    let zstd = Compression::ZSTD(ZstdLevel::try_new(1).unwrap_or_default());
    let has_samples = table.columns.iter().any(|column| column.kind == Kind::Samples);
    let mut properties = WriterProperties::builder()
        .set_created_by(format!("rockfrag {}", env!("CARGO_PKG_VERSION")))
        .set_compression(if has_samples { Compression::UNCOMPRESSED } else { zstd })
        // What is kept for each row group until the end: as little as serves, since there may be many.
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true);
    // Few numbers occur twice: a dictionary of them would only cost time.
    for column in table.columns.iter().filter(|column| column.kind == Kind::Float64) {
        properties = properties.set_column_dictionary_enabled(ColumnPath::from(column.name), false);
    }
    for column in table.columns.iter().filter(|column| column.kind == Kind::Samples) {
        let path = samples_path(column.name);
        properties = properties
            .set_column_compression(path.clone(), zstd)
            .set_column_dictionary_enabled(path.clone(), false)
            .set_column_statistics_enabled(path.clone(), EnabledStatistics::None)
            .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
    }
    properties.build()
}

/// The leaf that holds the samples of a list column.
fn samples_path(column: &str) -> ColumnPath {
    ColumnPath::new([column, "list", "item"].map(String::from).to_vec())
}
