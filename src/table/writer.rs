//! Writes a table under a temporary name and renames it: readers never see part of a file.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use arrow_schema::{DataType, SchemaRef};
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
/// Suffix of files being written, and how many random letters stand before it: more than a word has.
const PARTIAL: &str = ".partial";
const LETTERS: usize = 16;
/// Links that are followed, as systems do.
const MOST_LINKS: usize = 40;

pub struct TableWriter {
    writer: ArrowWriter<File>,
    written: PendingFile,
}

impl TableWriter {
    pub fn create(path: &Path, schema: &SchemaRef) -> Result<TableWriter, TableError> {
        let written = PendingFile::begin(path)?;
        let file = written.partial.as_file().try_clone().map_err(|source| cannot_write(path, source))?;
        let writer = ArrowWriter::try_new(file, schema.clone(), Some(properties(schema)));
        Ok(TableWriter { writer: writer.map_err(|cause| cannot_write(path, cause))?, written })
    }

    pub fn path(&self) -> &Path {
        &self.written.path
    }

    pub fn partial(&self) -> &Path {
        self.written.partial.path()
    }

    pub fn append(&mut self, rows: &RecordBatch) -> Result<(), TableError> {
        self.writer.write(rows).map_err(|cause| cannot_write(self.path(), cause))
    }

    pub fn finish(mut self, made: &Provenance) -> Result<PendingFile, TableError> {
        let checksums = self.checksums().map_err(|cause| cannot_write(self.path(), cause))?;
        self.writer.append_key_value_metadata(checksums);
        self.writer.append_key_value_metadata(made.key_value());
        self.writer.close().map_err(|cause| cannot_write(&self.written.path, cause))?;
        self.written.synced()
    }

    /// Computes the checksums of all rows, once these are in the file.
    fn checksums(&mut self) -> parquet::errors::Result<KeyValue> {
        self.writer.flush()?;
        self.writer.sync()?;
        checksums(self.partial(), self.writer.flushed_row_groups())
    }
}

/// A whole file under its temporary name, which goes with it unless it gets its own.
pub struct PendingFile {
    partial: NamedTempFile,
    pub path: PathBuf,
    /// Where `path` leads if it is a link.
    target: PathBuf,
}

impl PendingFile {
    pub fn new(path: &Path, content: &[u8]) -> Result<PendingFile, TableError> {
        let mut written = PendingFile::begin(path)?;
        written.partial.write_all(content).map_err(|source| cannot_write(path, source))?;
        written.synced()
    }

    fn begin(path: &Path) -> Result<PendingFile, TableError> {
        let (target, path) = (linked(path), path.to_path_buf());
        if target.file_name().is_none() {
            return Err(cannot_write(&path, "that is not a file name"));
        }
        // Whoever made the link knows where it should lead.
        if !path.is_symlink() {
            std::fs::create_dir_all(folder_of(&target)).map_err(|source| cannot_write(&path, source))?;
        }
        remove_strays(&target);
        match beside(&target, create_locked) {
            Ok(partial) => Ok(PendingFile { partial, path, target }),
            Err(source) => Err(cannot_write(&path, format!("{}: {source}", folder_of(&target).display()))),
        }
    }

    fn synced(self) -> Result<PendingFile, TableError> {
        self.partial.as_file().sync_all().map_err(|source| cannot_write(&self.path, source))?;
        Ok(self)
    }

    /// Takes the permissions of the file that it replaces, if both have one owner.
    fn take_permissions(&self) -> io::Result<()> {
        #[cfg(unix)]
        if let (Ok(former), own) = (self.target.metadata(), self.partial.as_file().metadata()?) {
            use std::os::unix::fs::{MetadataExt, PermissionsExt};
            let [mode, now] = [&former, &own].map(|file| file.mode() & 0o777);
            // Some file systems refuse to change them.
            if former.uid() == own.uid() && mode != now {
                return self.partial.as_file().set_permissions(PermissionsExt::from_mode(mode));
            }
        }
        Ok(())
    }
}

/// Gives files their names, all or none of them.
pub fn persist(files: Vec<PendingFile>) -> Result<(), TableError> {
    for file in &files {
        file.take_permissions().map_err(|source| cannot_write(&file.path, source))?;
    }
    let mut named: Vec<(PathBuf, Option<NamedTempFile<()>>)> = Vec::new();
    for (after, PendingFile { partial, path, target }) in (0..files.len()).rev().zip(files) {
        let is_kept = after > 0 && target.exists();
        let former = is_kept.then(|| beside(&target, |second| second_name(&target, second))).transpose();
        let renamed = former
            .and_then(|former| partial.persist(&target).map(|_| former).map_err(|refused| refused.error));
        match renamed {
            Ok(former) => named.push((target, former)),
            Err(source) => {
                named.into_iter().for_each(|(target, former)| restore(&target, former));
                return Err(cannot_write(&path, source));
            }
        }
    }
    Ok(())
}

/// Gives a file a second name: of a copy where the file system knows one name only.
fn second_name(file: &Path, second: &Path) -> io::Result<()> {
    std::fs::hard_link(file, second).or_else(|_| std::fs::copy(file, second).map(drop))
}

fn restore(target: &Path, former: Option<NamedTempFile<()>>) {
    let _ = match former {
        Some(former) => former.persist(target).map(drop).map_err(|refused| refused.error),
        None => std::fs::remove_file(target),
    };
}

/// Returns where a link leads, whether something is there or not; any other path as it is.
fn linked(path: &Path) -> PathBuf {
    let next = |path: &PathBuf| path.read_link().ok().map(|next| path.with_file_name(next));
    let links = std::iter::successors(Some(path.to_path_buf()), next);
    links.take(MOST_LINKS).last().unwrap_or_default()
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn cannot_write(path: &Path, cause: impl ToString) -> TableError {
    TableError::table(path, format!("cannot write: {}", cause.to_string()))
}

/// How the temporary names of a file begin. A name may have 255 bytes, of which random letters and the suffix
/// take some.
fn prefix(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match name.len() {
        0..=200 => format!(".{name}."),
        _ => format!(".{}.", blake3::hash(name.as_bytes()).to_hex()),
    }
}

/// Makes something beside a file under a temporary name.
fn beside<R>(file: &Path, make: impl FnMut(&Path) -> io::Result<R>) -> io::Result<NamedTempFile<R>> {
    let prefix = prefix(file);
    let mut names = tempfile::Builder::new();
    names.prefix(&prefix).rand_bytes(LETTERS).suffix(PARTIAL).make_in(folder_of(file), make)
}

/// Creates a file that is locked while it is written, so that other runs do not remove it.
fn create_locked(path: &Path) -> io::Result<File> {
    let file = File::create_new(path)?;
    // Until it is locked, another run may take it for one of a killed run: then the next name is tried.
    let is_kept = file.try_lock().is_ok() && path.exists();
    is_kept.then_some(file).ok_or(io::ErrorKind::AlreadyExists.into())
}

/// Removes files of killed runs. One that cannot be removed does no harm.
fn remove_strays(target: &Path) {
    let prefix = prefix(target);
    for entry in std::fs::read_dir(folder_of(target)).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let letters = name.strip_prefix(&prefix).and_then(|rest| rest.strip_suffix(PARTIAL));
        let is_partial = letters.is_some_and(|letters| letters.len() == LETTERS)
            && entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_partial && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Returns the compression of the columns: no dictionary of numbers, which rarely repeat; samples split by
/// bytes.
fn properties(schema: &SchemaRef) -> WriterProperties {
    let zstd = Compression::ZSTD(ZstdLevel::try_new(1).unwrap_or_default());
    let mut properties = WriterProperties::builder()
        .set_created_by(CREATED_BY.to_string())
        .set_compression(zstd)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_offset_index_disabled(true)
        .set_max_row_group_bytes(Some(MOST_BYTES_IN_GROUP))
        .set_max_row_group_row_count(Some(ROWS_IN_GROUP));
    for field in schema.fields() {
        let name = field.name().as_str();
        properties = match field.data_type() {
            DataType::Float64 => properties.set_column_dictionary_enabled(name.into(), false),
            DataType::List(item) if item.data_type() == &DataType::Float32 => {
                let path = ColumnPath::new([name, "list", item.name()].map(str::to_string).to_vec());
                properties
                    .set_max_row_group_row_count(Some(MOTIONS_IN_GROUP))
                    .set_column_dictionary_enabled(path.clone(), false)
                    .set_column_statistics_enabled(path.clone(), EnabledStatistics::None)
                    .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT)
            }
            _ => properties,
        };
    }
    properties.build()
}
