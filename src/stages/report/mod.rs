//! report: one page and its figures, of all tables in a folder.

mod page;
mod tables;

use std::path::{Path, PathBuf};

use clap::Args;
use clap::ValueHint::{AnyPath, FilePath};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::chart::{DPI, Figure, png, svg};
use crate::document::PageArgs;
use crate::number::counted;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::paths::{Files, Read};
use crate::table::file;
use tables::Tables;

/// Write a page with tables and figures of everything in a folder, or of files
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag report --in out --title \"Server room\" \
    --author \"A. Engineer\" --out report.html")]
pub struct Report {
    /// Folder or files of other commands; evaluations of the same objects are
    /// before and after, or under different hazards alternatives
    #[arg(long = "in", id = "in", value_name = "DIR|FILE,...", value_hint = AnyPath, default_value = ".")]
    #[serde(rename = "in")]
    input: Vec<PathBuf>,
    /// Page to write; its figures go into a folder of its name [default: report.html in DIR or beside FILE]
    #[arg(long, value_name = "FILE", value_hint = FilePath)]
    out: Option<PathBuf>,
    #[command(flatten)]
    #[serde(flatten)]
    signed: PageArgs,
}

impl Report {
    fn page(&self) -> PathBuf {
        let first = self.input.first().map_or(PathBuf::new(), |path| path.to_path_buf());
        match &self.out {
            Some(out) if out.extension().is_none() => out.with_extension("html"),
            Some(out) => out.to_path_buf(),
            None if first.is_dir() => first.join("report.html"),
            None => first.with_file_name("report.html"),
        }
    }
}

impl Stage for Report {
    fn files(&self) -> Files {
        let paths = self.input.iter().flat_map(|path| {
            // Partitions stand in folders in the folder.
            let entries = file::entries(path).into_iter().flatten();
            std::iter::once(path.to_path_buf())
                .chain(entries.filter(|entry| entry.is_dir()))
                .collect::<Vec<_>>()
        });
        Files { read: vec![Read::new("in", paths)], written: vec![self.page()], endings: &["html"] }
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let mut tables = Tables::read(&self.input)?;
        let (whole, figures) = page::page(&mut tables)?;
        let (page, folder) = (self.page(), self.page().with_extension(""));
        let left_out: String = tables.left_out.iter().map(|note| format!("{note}\n")).collect();
        let summary = format!("a page, {}\n{left_out}", counted(figures.len(), "figure"));
        figures.par_iter().try_for_each(|figure| write(figure, &folder.join(&figure.name), context))?;
        context.write_file(&page, whole.signed(&self.signed).html()?.as_bytes())?;
        Ok(summary)
    }
}

fn write(figure: &Figure, stem: &Path, context: &Context) -> anyhow::Result<()> {
    let svg = svg(figure);
    context.write_file(&stem.with_added_extension("png"), &png(&svg, DPI)?)?;
    context.write_file(&stem.with_added_extension("svg"), svg.as_bytes())?;
    context.write_file(&stem.with_added_extension("csv"), figure.csv()?.as_bytes())
}
