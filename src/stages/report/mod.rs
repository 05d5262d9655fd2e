//! report: one page and its figures, of all tables in a folder.

pub mod figures;
mod page;
pub mod tables;

use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::{Args, ValueHint};
use rayon::prelude::*;

use crate::number::counted;
use crate::pipeline::cache::is_ours;
use crate::pipeline::context::Context;
use crate::pipeline::{Stage, UsageError};
use crate::report::{Figure, Page, png, svg};
use crate::table::writer::write_file;
use tables::Tables;

/// Dots per inch of the PNG files.
const DPI: f32 = 300.0;

/// Write a page with tables and figures of everything in a folder
#[derive(Debug, Args)]
pub struct Report {
    /// Folder of the tables of other commands
    #[arg(long = "in", id = "in", value_name = "DIR", value_hint = ValueHint::FilePath, default_value = ".")]
    input: PathBuf,
    /// Page to write; its figures go into a folder of its name [default: report.html in DIR]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
    /// Title of the page
    #[arg(long, value_name = "TEXT", default_value = "Rocking fragility")]
    title: String,
    /// Author, below the title
    #[arg(long, value_name = "TEXT")]
    author: Option<String>,
    /// Date, below the title
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
}

impl Report {
    fn page(&self) -> PathBuf {
        self.out.clone().unwrap_or_else(|| self.input.join("report.html"))
    }
}

impl Stage for Report {
    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.page()]
    }

    fn check(&self) -> anyhow::Result<()> {
        let page = self.page();
        if page.extension().is_none_or(|ending| ending != "html") {
            let page = page.display();
            return Err(UsageError::because(format!(
                "out is {page}; expected the name of a page, such as report.html"
            )));
        }
        Ok(())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        if !self.input.is_dir() {
            bail!("{}: no such folder; expected that of the tables", self.input.display());
        }
        let tables = Tables::read(&self.input)?;
        let figures = figures::all(&tables)?;
        let (page, folder) = (self.page(), self.page().with_extension(""));
        let summary = format!("{}: {}\n", page.display(), counted(figures.len(), "figure"));
        let key = context.provenance(&summary)?.json();
        let stems: Vec<PathBuf> = figures.iter().map(|figure| folder.join(&figure.name)).collect();
        if let Some(other) = stems.iter().find_map(|stem| foreign(stem)).filter(|_| !context.common.force) {
            bail!("{}: not written by rockfrag; --force replaces it", other.display());
        }
        let paths = figures.par_iter().zip(&stems);
        paths.try_for_each(|(figure, stem)| write_figure(figure, stem, &key))?;
        let byline = [&self.author, &self.date].into_iter().flatten().cloned().collect::<Vec<_>>().join(", ");
        let whole = page::page(&tables, figures, key)?;
        let html = Page { title: self.title.clone(), byline, ..whole }.html();
        write_file(&page, html.as_bytes())?;
        Ok(summary)
    }
}

/// Its files are ours if the SVG has our provenance.
fn foreign(stem: &Path) -> Option<PathBuf> {
    let files = ["svg", "png", "csv"].map(|ending| stem.with_added_extension(ending));
    let there = files.iter().find(|file| file.exists())?;
    (!is_ours(&files[0])).then(|| there.clone())
}

fn write_figure(figure: &Figure, stem: &Path, key: &str) -> anyhow::Result<()> {
    let svg = svg(figure, key);
    write_file(&stem.with_added_extension("svg"), svg.as_bytes())?;
    write_file(&stem.with_added_extension("csv"), figure.csv()?.as_bytes())?;
    Ok(write_file(&stem.with_added_extension("png"), &png(&svg, DPI)?)?)
}
