//! report: one page and its figures, of all tables in a folder.

mod page;
mod tables;

use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;
use serde::Serialize;

use crate::number::counted;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::paths::{InputFolder, PageOutput, Read, split_lists};
use crate::report::{DPI, Figure, Page, png, svg};
use crate::table::file;
use tables::Tables;

/// Write a page with tables and figures of everything in a folder, or of files
#[derive(Debug, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag report --in out --title \"Server room\" \
    --author \"A. Engineer\" --out report.html")]
pub struct Report {
    /// Folder or files of other commands; two evaluations of the same objects are before and after
    #[arg(long = "in", id = "in", value_name = "DIR|FILE,...", default_value = ".")]
    input: Vec<InputFolder>,
    /// Page to write; its figures go into a folder of its name [default: report.html in DIR or beside FILE]
    #[arg(long, value_name = "FILE")]
    out: Option<PageOutput>,
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
        let first = split_lists(&self.input).into_iter().next().unwrap_or_default();
        match &self.out {
            Some(out) => out.with_extension("html"),
            None if first.is_dir() => first.join("report.html"),
            None => first.with_file_name("report.html"),
        }
    }
}

impl Stage for Report {
    fn inputs(&self) -> Vec<Read> {
        let paths = split_lists(&self.input).into_iter().flat_map(|path| {
            // Partitions stand in folders in the folder.
            let entries = file::entries(&path).into_iter().flatten();
            std::iter::once(path).chain(entries.filter(|entry| entry.is_dir())).collect::<Vec<_>>()
        });
        vec![Read::new("in", paths)]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![self.page()]
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let mut tables = Tables::read(&split_lists(&self.input))?;
        let (whole, figures) = page::page(&mut tables)?;
        let (page, folder) = (self.page(), self.page().with_extension(""));
        let left_out: String = tables.left_out.iter().map(|note| format!("{note}\n")).collect();
        let summary = format!("a page, {}\n{left_out}", counted(figures.len(), "figure"));
        figures.par_iter().try_for_each(|figure| write(figure, &folder.join(&figure.name), context))?;
        let byline = [&self.author, &self.date].into_iter().flatten().cloned().collect::<Vec<_>>().join(", ");
        let title = self.title.clone().unwrap_or(whole.title);
        context.write_file(&page, Page { title, byline, ..whole }.html().as_bytes())?;
        Ok(summary)
    }
}

/// Writes a figure, its picture and its numbers.
fn write(figure: &Figure, stem: &Path, context: &Context) -> anyhow::Result<()> {
    let svg = svg(figure);
    context.write_file(&stem.with_added_extension("png"), &png(&svg, DPI)?)?;
    context.write_file(&stem.with_added_extension("svg"), svg.as_bytes())?;
    context.write_file(&stem.with_added_extension("csv"), figure.csv()?.as_bytes())
}
