//! The pipeline of the command `rockfrag` over Parquet files. The science is [`rockfrag_core`].

pub mod cli;
pub mod export;
pub mod inputs;
pub mod number;
pub mod pipeline;
pub mod report;
pub mod source;
pub mod stages;
pub mod table;
