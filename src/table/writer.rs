//! Writes a table under a temporary name and renames it: readers never see part of a file.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use arrow_schema::{DataType, Field, SchemaRef};
use parquet::arrow::ArrowWriter;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::schema::types::ColumnPath;
use tempfile::NamedTempFile;

use super::TableError;
use super::checksums::checksums;
use super::provenance::{CREATED_BY, Provenance};

/// Rows per row group: of a narrow table, and of one with samples.
const ROWS_IN_GROUP: usize = 32_768;
pub const MOTIONS_IN_GROUP: usize = 64;
/// Bytes after which a row group ends: rows of long motions are written before they fill the memory.
const MOST_BYTES_IN_GROUP: usize = 256 << 20;
/// Suffix of files being written.
const PARTIAL: &str = ".partial";

pub struct TableWriter {
    path: PathBuf,
    writer: ArrowWriter<NamedTempFile>,
}

impl TableWriter {
    pub fn create(path: &Path, schema: &SchemaRef) -> Result<TableWriter, TableError> {
        let writer = ArrowWriter::try_new(partial_beside(path)?, schema.clone(), Some(properties(schema)));
        let writer = writer.map_err(|cause| cannot_write(path, cause))?;
        Ok(TableWriter { path: path.to_path_buf(), writer })
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Its temporary name.
    pub fn partial(&self) -> &Path {
        self.writer.inner().path()
    }

    pub fn append(&mut self, rows: &RecordBatch) -> Result<(), TableError> {
        self.writer.write(rows).map_err(|cause| cannot_write(&self.path, cause))
    }

    /// Ends the table.
    pub fn finish(mut self, made: &Provenance) -> Result<Written, TableError> {
        let checksums = self.checksums().map_err(|cause| cannot_write(&self.path, cause))?;
        self.writer.append_key_value_metadata(checksums);
        self.writer.append_key_value_metadata(made.key_value());
        let partial = self.writer.into_inner().map_err(|cause| cannot_write(&self.path, cause))?;
        Written::synced(partial, &self.path)
    }

    /// Computes the checksums of all rows, once these are in the file.
    fn checksums(&mut self) -> parquet::errors::Result<KeyValue> {
        self.writer.flush()?;
        self.writer.sync()?;
        Ok(checksums(self.partial(), self.writer.flushed_row_groups())?)
    }
}

/// A whole file under its temporary name, which goes with it unless it gets its own.
pub struct Written {
    partial: NamedTempFile,
    path: PathBuf,
}

impl Written {
    pub fn new(path: &Path, content: &[u8]) -> Result<Written, TableError> {
        let mut partial = partial_beside(path)?;
        partial.write_all(content).map_err(|source| cannot_write(path, source))?;
        Written::synced(partial, path)
    }

    fn synced(partial: NamedTempFile, path: &Path) -> Result<Written, TableError> {
        partial.as_file().sync_all().map_err(|source| cannot_write(path, source))?;
        Ok(Written { partial, path: path.to_path_buf() })
    }

    /// Gives it its name, and the permissions of the file that it replaces.
    pub fn persist(self) -> Result<(), TableError> {
        let target = linked(&self.path);
        if let Ok(former) = target.metadata() {
            let set = self.partial.as_file().set_permissions(former.permissions());
            set.map_err(|source| cannot_write(&self.path, source))?;
        }
        let renamed = self.partial.persist(target);
        renamed.map(drop).map_err(|refused| cannot_write(&self.path, refused.error))
    }

    /// Gives it its name, unless something is there already.
    pub fn persist_new(self) -> Result<(), TableError> {
        let renamed = self.partial.persist_noclobber(&self.path);
        renamed.map(drop).map_err(|refused| cannot_write(&self.path, refused.error))
    }
}

/// Returns what a link points to, whether it is there or not; any other path as it is.
fn linked(path: &Path) -> PathBuf {
    match (path.canonicalize(), path.read_link()) {
        (Ok(real), Ok(_)) => real,
        (Err(_), Ok(target)) => path.with_file_name(target),
        _ => path.to_path_buf(),
    }
}

fn cannot_write(path: &Path, cause: impl ToString) -> TableError {
    TableError::table(path, format!("cannot write: {}", cause.to_string()))
}

/// Creates a temporary file beside `path`, locked while it is written, so that other runs do not remove it.
fn partial_beside(path: &Path) -> Result<NamedTempFile, TableError> {
    let target = linked(path);
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = target.file_name().ok_or_else(|| cannot_write(path, "that is not a file name"))?;
    let name = name.to_string_lossy();
    // A name may have 255 bytes, of which the random letters and the suffix take some.
    let prefix = match name.len() {
        0..=200 => format!(".{name}."),
        _ => format!(".{}.", blake3::hash(name.as_bytes()).to_hex()),
    };
    // Whoever made the link knows where it should lead.
    if !path.is_symlink() {
        std::fs::create_dir_all(folder).map_err(|source| cannot_write(path, source))?;
    }
    remove_strays(folder, &prefix);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(PARTIAL);
    // Default permissions, in place of the private ones of a temporary file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    loop {
        let partial = builder.tempfile_in(folder).map_err(|source| cannot_write(path, source))?;
        // Until it is locked, another run may take it for one of a killed run.
        if partial.as_file().try_lock().is_ok() && partial.path().exists() {
            return Ok(partial);
        }
    }
}

/// Removes files of killed runs. One that cannot be removed does no harm.
fn remove_strays(folder: &Path, prefix: &str) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_partial = name.starts_with(prefix) && name.ends_with(PARTIAL);
        if is_partial && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Returns the name of the items of a column of samples.
fn samples(field: &Field) -> Option<&str> {
    match field.data_type() {
        DataType::List(item) if item.data_type() == &DataType::Float32 => Some(item.name()),
        _ => None,
    }
}

/// Returns the compression of the columns: no dictionary of numbers, which rarely repeat; samples split by
/// bytes.
fn properties(schema: &SchemaRef) -> WriterProperties {
    let zstd = Compression::ZSTD(ZstdLevel::try_new(1).unwrap_or_default());
    let has_samples = schema.fields().iter().any(|field| samples(field).is_some());
    let mut properties = WriterProperties::builder()
        .set_created_by(CREATED_BY.to_string())
        .set_compression(zstd)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_max_row_group_bytes(Some(MOST_BYTES_IN_GROUP))
        .set_max_row_group_row_count(Some(if has_samples { MOTIONS_IN_GROUP } else { ROWS_IN_GROUP }));
    for field in schema.fields() {
        if field.data_type() == &DataType::Float64 {
            properties =
                properties.set_column_dictionary_enabled(ColumnPath::from(field.name().as_str()), false);
        }
        if let Some(item) = samples(field) {
            let path = ColumnPath::new(vec![field.name().clone(), "list".to_string(), item.to_string()]);
            properties = properties
                .set_column_dictionary_enabled(path.clone(), false)
                .set_column_statistics_enabled(path.clone(), EnabledStatistics::None)
                .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
        }
    }
    properties.build()
}
