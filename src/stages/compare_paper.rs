//! compare-paper: each published number beside ours.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use crate::pipeline::context::Context;
use crate::pipeline::stage::Stage;
use crate::studies::paper::{Comparison, compare};
use crate::table::frame::{self, Format};
use crate::table::rows;

/// Compare fits of the paper's set-up with the numbers that the paper publishes
#[derive(Debug, Args)]
pub struct ComparePaper {
    /// Fits of fit-pex
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, default_value = "pex.parquet")]
    pex: PathBuf,
    /// Fits of fit-pro
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, default_value = "pro.parquet")]
    pro: PathBuf,
    /// Comparison to write
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath, default_value = "paper.parquet")]
    out: PathBuf,
    /// Print every number, not only the planes of Table II and the worked example
    #[arg(long)]
    all: bool,
}

impl Stage for ComparePaper {
    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.out.clone()]
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let compared = compare(&rows::read(&self.pex)?, &rows::read(&self.pro)?);
        let frame = frame::of_batch(&rows::batch(&compared)?)?;
        let summary = frame::show(&frame, Format::Text)?;
        context.write::<Comparison>(&self.out, &compared, &summary)?;
        Ok(summary)
    }
}
