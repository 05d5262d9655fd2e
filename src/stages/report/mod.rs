//! report: one page and its figures, of all tables in a folder.

pub mod evaluations;
mod figures;
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
use crate::report::{DPI, Figure, Page, made_in_words, png, svg};
use crate::table::writer::write_file;
use tables::Tables;

/// Write a page with tables and figures of everything in a folder, or of files
#[derive(Debug, Args)]
pub struct Report {
    /// Folder or files of other commands; two evaluations of the same objects are before and after
    #[arg(long = "in", id = "in", value_name = "DIR|FILE,...", value_hint = ValueHint::FilePath, value_delimiter = ',', default_value = ".")]
    input: Vec<PathBuf>,
    /// Page to write; its figures go into a folder of its name [default: report.html in DIR or beside FILE]
    #[arg(long, value_name = "FILE", value_hint = ValueHint::AnyPath)]
    out: Option<PathBuf>,
    /// Title of the page [default: from what it shows]
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Author, below the title
    #[arg(long, value_name = "TEXT")]
    author: Option<String>,
    /// Date, below the title
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
}

impl Report {
    fn page(&self) -> PathBuf {
        let beside = |first: &PathBuf| match first.is_dir() {
            true => first.join("report.html"),
            false => first.with_file_name("report.html"),
        };
        let default = || self.input.first().map_or(PathBuf::from("report.html"), beside);
        self.out.clone().unwrap_or_else(default)
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
        if let Some(missing) = self.input.iter().find(|path| !path.exists()) {
            bail!("{}: no such file or folder; expected tables of other commands", missing.display());
        }
        let tables = Tables::read(&self.input)?;
        let mut notes = Vec::new();
        let figures = figures::all(&tables, &mut notes)?;
        let (page, folder) = (self.page(), self.page().with_extension(""));
        let left_out: String = tables.left_out.iter().chain(&notes).map(|note| format!("{note}\n")).collect();
        let summary = format!("{}: {}\n{left_out}", page.display(), counted(figures.len(), "figure"));
        let key = context.provenance(&summary)?.json();
        let stems: Vec<PathBuf> = figures.iter().map(|figure| folder.join(&figure.name)).collect();
        if let Some(other) = stems.iter().find_map(|stem| foreign(stem)).filter(|_| !context.common.force) {
            bail!("{}: not written by rockfrag; --force replaces it", other.display());
        }
        let paths = figures.par_iter().zip(&stems);
        paths.try_for_each(|(figure, stem)| write_figure(figure, stem, &key))?;
        let whole = page::page(&tables, figures, notes)?;
        let byline = [&self.author, &self.date].into_iter().flatten().cloned().collect::<Vec<_>>().join(", ");
        let title = self.title.clone().unwrap_or(whole.title);
        let html = Page { title, byline, key, made: made_in_words(), ..whole }.html();
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
    Ok(write_file(&stem.with_added_extension("png"), &png(&svg, DPI, key)?)?)
}
