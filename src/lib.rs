//! The pipeline of the command `rockfrag` over Parquet files. The science is [`rockfrag_core`].

pub mod answer;
pub mod chart;
pub mod cli;
pub mod document;
pub mod export;
pub mod figures;
pub mod inputs;
pub mod number;
pub mod pipeline;
pub mod source;
pub mod stages;
pub mod table;
