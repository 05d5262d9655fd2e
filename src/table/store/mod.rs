//! Reads and writes tables: Parquet files, folders of them, or memory.
//!
//! ```text
//! source       where a table is read from and written to
//! folder       a folder of files as one table; partition one of its parts
//! footer       the end of a file, which says what is in it; compact and description how it says it
//! limits       how much memory a file may ask for; guarded catches panics of the decoder on damaged files
//! table_file   one file, open at some columns; shared_file lets several threads read it; fragment a file or a table in memory
//! lists        the samples of some rows
//! reader       batches from a table; columns the columns of a batch by name, checked; frame narrow tables as polars frames
//! contents     what files and folders say of themselves
//! writer       batches to a file that gets its name when it is whole
//! provenance   what made a file, in its metadata; fingerprint the hash of what it holds
//! text         a table as aligned text, CSV or JSON; text_file text files whole
//! ```

pub mod columns;
pub(crate) mod compact;
pub mod contents;
pub(crate) mod description;
pub mod fingerprint;
pub mod folder;
pub mod footer;
pub(crate) mod fragment;
pub mod frame;
pub mod guarded;
pub(crate) mod limits;
pub(crate) mod lists;
pub mod partition;
pub mod provenance;
pub mod reader;
pub(crate) mod shared_file;
pub mod source;
pub(crate) mod table_file;
pub mod text;
pub mod text_file;
pub mod writer;
