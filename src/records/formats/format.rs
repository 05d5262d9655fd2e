//! The list of formats.

use crate::keyword::keywords;

/// A text format, in order of detection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Cosmos,
    /// KiK-net too.
    Knet,
    Esm,
    PeerAt2,
    Csv,
}

keywords!(Format { Cosmos = "cosmos", Knet = "knet", Esm = "esm", PeerAt2 = "at2", Csv = "csv" });
