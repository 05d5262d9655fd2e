//! The list of formats.

use crate::keyword::keywords;

/// A text format, in order of detection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// COSMOS V1 and V2.
    Cosmos,
    /// K-NET and KiK-net.
    Knet,
    /// Engineering Strong Motion database.
    Esm,
    /// PEER's AT2.
    PeerAt2,
    /// Columns of a table.
    Csv,
}

keywords!(Format { Cosmos = "cosmos", Knet = "knet", Esm = "esm", PeerAt2 = "at2", Csv = "csv" });
