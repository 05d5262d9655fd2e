//! The list of formats.

use crate::keyword::keywords;

keywords! {
    /// A text format, in order of detection.
    pub enum Format {
        /// COSMOS V1 and V2.
        Cosmos = "cosmos",
        /// K-NET and KiK-net.
        Knet = "knet",
        /// Engineering Strong Motion database.
        Esm = "esm",
        /// PEER's AT2.
        PeerAt2 = "at2",
        /// Columns of a table.
        Csv = "csv",
    }
}
