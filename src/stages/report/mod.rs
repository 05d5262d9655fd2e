//! report: figures and one page of all that a folder of files holds.

mod fits;
mod motions;
mod provenance;
mod responses;
mod studies;
mod tables;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::compare_paper::ComparePaper;
use super::evaluate::Evaluate;
use super::fit_pex::FitPex;
use super::fit_pro::FitPro;
use super::ida::Ida;
use super::rank_ims::RankIms;
use super::sample_scenarios::SampleScenarios;
use super::simulate::Simulate;
use super::synthesize_motions::SynthesizeMotions;
use super::universality::Universality;
use super::validate::Validate;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::{check, defaults};
use crate::pipeline::stage::{Stage, folder_of};
use crate::report::data::{File, ReportData};
use crate::report::{ALL, Draw, Figure, Page, Part, Place, csv, page, png, svg};
use crate::table::TableError;
use crate::table::pex::PexRow;
use crate::table::row::ReadRow;
use crate::table::store::contents;
use crate::table::store::contents::footer;
use crate::table::store::folder::{self, file_name};
use crate::table::store::partition::Partition;
use crate::table::store::provenance::{Provenance, Recorded};
use crate::table::store::source::{Source, Target};
use crate::table::store::text_file;

/// What the report shows.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct ReportOptions {
    /// Title of the page [default: Rocking fragility]
    #[arg(long)]
    pub title: Option<String>,
    /// Author, below the title
    #[arg(long)]
    pub author: Option<String>,
    /// Date, in your own words; without it the page has none
    #[arg(long)]
    pub date: Option<String>,
    /// Suite to show [default: all]
    #[arg(long)]
    pub suite: Option<String>,
    /// Structure to show [default: all]
    #[arg(long)]
    pub structure: Option<String>,
    /// Largest number of pairs of suite and structure to draw, in the order of the file; findings and tables hold all
    #[arg(long, default_value = "4", value_name = "N")]
    pub groups: usize,
    /// Number of motions to browse in the page
    #[arg(long, default_value = "40", value_name = "N")]
    pub motions: usize,
    /// Dots per inch of the PNG files
    #[arg(long, default_value = "300")]
    pub dpi: f64,
}

impl Default for ReportOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for ReportOptions {}

/// The role of the responses, which must be there where there are no rates.
const RESPONSES: &str = "responses";
/// The role of annual rates.
const RATES: &str = "rates";

/// The stage, ready to run.
pub struct Report {
    options: ReportOptions,
    folder: PathBuf,
    /// Annual rates, if they are named.
    rates: Option<PathBuf>,
    out: PathBuf,
}

impl Report {
    /// Of the files in a folder, into the page `out`; its figures go into a folder of the same name.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(
        options: &ReportOptions,
        folder: PathBuf,
        rates: Option<PathBuf>,
        out: PathBuf,
    ) -> anyhow::Result<Report> {
        check(options.groups >= 1, "groups", options.groups, "1 or more")?;
        check(
            options.motions <= 200,
            "motions",
            options.motions,
            "200 or fewer, so that the page stays small",
        )?;
        let ending = out.extension().unwrap_or_default().to_string_lossy();
        check(ending == "html", "out", out.display(), "the name of a page that ends in .html")?;
        check((36.0..=1200.0).contains(&options.dpi), "dpi", options.dpi, "36 to 1200 dots per inch")?;
        Ok(Report { options: options.clone(), folder, rates, out })
    }

    /// The responses, and of the other files that a report can show those that are there, in the order of the pipeline, by the
    /// role each plays.
    fn there(&self) -> Vec<(&'static str, PathBuf)> {
        let known = [
            ("scenarios", SampleScenarios::OUTPUT),
            ("motions", SynthesizeMotions::OUTPUT),
            (RESPONSES, Simulate::OUTPUT),
            ("pex", FitPex::OUTPUT),
            ("pro", FitPro::OUTPUT),
            ("paper", ComparePaper::OUTPUT),
            ("validation", Validate::OUTPUT),
            ("ranking", RankIms::OUTPUT),
            ("universality", Universality::OUTPUT),
        ];
        let mut places = known.map(|(role, output)| (role, self.place(output.file))).to_vec();
        let part =
            |part: &str| self.place(&Ida::OUTPUT.file.replace(".parquet", &format!(".{part}.parquet")));
        places.extend([("ida shares", part("shares")), ("ida fragility", part("fragility"))]);
        let rates = self.rates.clone().or_else(|| self.rates_in_folder());
        let must_be_there = |role: &str| role == RATES || role == RESPONSES && rates.is_none();
        let is_there = |(role, path): &(&str, PathBuf)| must_be_there(role) || path.exists();
        places.retain(is_there);
        places.extend(rates.map(|rates| (RATES, rates)));
        places
    }

    /// Annual rates in the folder: evaluated.parquet, or all files of one that holds nothing else.
    fn rates_in_folder(&self) -> Option<PathBuf> {
        let evaluated = self.place(Evaluate::OUTPUT.file);
        if studies::are_rates(&evaluated) {
            return Some(evaluated);
        }
        let files = folder::parquet_files(&self.folder).ok()?;
        (!files.is_empty() && files.iter().all(|file| studies::are_rates(file))).then(|| self.folder.clone())
    }

    /// Where a file is: in the folder by its name, or as a folder of partitions without the ending. The folder may be that of the
    /// partitions of the responses; then the others are beside it.
    fn place(&self, file: &str) -> PathBuf {
        let is_of_partitions = self.is_of_partitions();
        let folder = if is_of_partitions { folder_of(&self.folder) } else { &self.folder };
        let whole = folder.join(file);
        let parts = whole.with_extension("");
        match () {
            () if is_of_partitions && file == Simulate::OUTPUT.file => self.folder.clone(),
            () if !whole.exists() && parts.is_dir() => parts,
            () => whole,
        }
    }

    /// Whether the folder holds partitions rather than the files of a run.
    fn is_of_partitions(&self) -> bool {
        let first = Partition { index: 0, of: 1 }.file_name();
        self.folder.join(first).is_file()
    }

    fn read_data(&self, console: &Console) -> anyhow::Result<ReportData> {
        let inputs = self.there();
        let there =
            |role: &str| inputs.iter().find(|(other, _)| *other == role).map(|(_, path)| path.as_path());
        let regressions = there("pex").map(PexRow::read).transpose()?.unwrap_or_default();
        let limit = regressions.first().map(|row| row.limit_state);
        let responses = there(RESPONSES).map(|path| responses::read(path, &self.options, limit));
        let (mut groups, mut summaries, left_out) = responses.transpose()?.unwrap_or_default();
        fits::add_regressions(&regressions, &mut groups);
        if let Some(pro) = there("pro") {
            fits::add_curves(pro, &mut groups, &mut summaries, console)?;
        }
        let ReportOptions { title, author, date, .. } = self.options.clone();
        let mut data =
            ReportData { title, author, date, summaries, limit, left_out, ..ReportData::default() };
        if let (Some(pex), Some(pro)) = (there("pex"), there("pro")) {
            data.models = fits::models(pex, pro, &groups);
        }
        if let Some(path) = there("motions") {
            let structures = motions::structures(&groups);
            (data.motions, data.parts) = motions::read(path, &structures, self.options.motions)?;
        }
        data.rates = there(RATES).map(studies::rates).transpose()?.unwrap_or_default();
        let shares = there("ida shares").map(|shares| studies::analyses(shares, there("ida fragility")));
        data.analyses = shares.transpose()?.unwrap_or_default();
        data.validations = there("validation").map(studies::validations).transpose()?.unwrap_or_default();
        data.rankings = there("ranking").map(studies::rankings).transpose()?.unwrap_or_default();
        data.transfers = there("universality").map(studies::transfers).transpose()?;
        data.tables = tables::read(&inputs)?;
        let files = inputs.iter().map(|(role, path)| match *role {
            // Of a structure each.
            RATES => folder::files(path),
            _ => Ok(vec![path.clone()]),
        });
        let files = files.collect::<Result<Vec<_>, TableError>>()?.concat();
        data.files = files.iter().map(|path| file(path)).collect::<Result<_, TableError>>()?;
        data.groups = groups;
        Ok(data)
    }

    /// The folder of the figures.
    fn figures(&self) -> PathBuf {
        self.out.with_extension("")
    }
}

/// Gives each figure a name of its own, whatever structures are called, and what its files say of how it was made.
fn finish(figures: &mut [(Part, Figure)], made: &str) {
    let mut names = HashSet::new();
    for (index, (_, figure)) in figures.iter_mut().enumerate() {
        if !names.insert(figure.name.clone()) {
            figure.name = format!("{}-{}", figure.name, index + 1);
        }
        figure.made = made.to_string();
    }
}

/// What is known of a file.
fn file(path: &Path) -> Result<File, TableError> {
    let footer = footer(path)?;
    let recorded = contents::recorded(path)?;
    let name = file_name(path);
    let rows = usize::try_from(footer.rows).unwrap_or(0);
    let mut warnings = Vec::new();
    for part in folder::files(path)? {
        let of_part = contents::recorded(&part)?.map(|recorded| recorded.provenance.warnings.all());
        warnings.extend(of_part.unwrap_or_default());
    }
    warnings.sort();
    warnings.dedup();
    Ok(match recorded {
        Some(Recorded { provenance, content, .. }) => File {
            name,
            stage: Some(provenance.stage),
            version: provenance.version,
            parameters: provenance.parameters,
            content,
            rows,
            warnings,
        },
        None => File {
            name,
            stage: None,
            version: String::new(),
            parameters: Value::Null,
            content: contents::content_of(path)?,
            rows,
            warnings,
        },
    })
}

impl Declare for Report {
    type Options = ReportOptions;
    const NAME: &'static str = "report";
    const ABOUT: &'static str = "Draw what a folder of files holds: one page to open in a browser, and each figure as SVG, PNG and CSV";
    const EXAMPLES: &'static str = "rockfrag report --in out\n\
        rockfrag report --in out --suite csgm --out combined.html --dpi 150";
    const INPUTS: &'static [Input] = &[
        Input::file(
            "files",
            "in",
            "",
            "Folder of the files: responses.parquet or its partitions, and any files of other stages; or annual rates alone",
        )
        .folder("out"),
        Input::file(
            RATES,
            "rates",
            "",
            "Annual rates of evaluate --hazard, in a Parquet file or a folder of them [default: evaluated.parquet in the folder]",
        )
        .if_named(),
    ];
    const OUTPUT: Output = Output::file(
        "report.html",
        "Page to write; its figures go into a folder of the same name [default: report.html in the input]",
    );
    const HAS_PROGRESS: bool = false;

    fn create(options: &ReportOptions, files: &Files) -> anyhow::Result<Report> {
        let Source::Path(folder) = files.input("files")? else {
            return Err(UsageError::because("files: a table in memory; expected a folder of files"));
        };
        if folder.is_file() {
            return Err(UsageError::because(format!(
                "in is {}, a file; expected the folder of the files, such as out",
                folder.display()
            )));
        }
        let Target::Path(out) =
            files.asked(Self::OUTPUT.file).unwrap_or(folder.join(Self::OUTPUT.file).into())
        else {
            return Err(UsageError::because("report writes a page; expected the name of a file"));
        };
        let rates = match files.optional(RATES) {
            Some(Source::Memory(_)) => {
                return Err(UsageError::because("rates: a table in memory; expected a file of evaluate"));
            }
            Some(Source::Path(rates)) => Some(rates),
            None => None,
        };
        Report::new(options, folder, rates, out)
    }
}

impl Stage for Report {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        self.there().into_iter().map(|(role, path)| (role, path.into())).collect()
    }

    fn targets(&self) -> Vec<Target> {
        vec![(&self.out).into()]
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn recorded(&self, output: &Path) -> Result<Option<Recorded>, TableError> {
        provenance::read(output)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let data = self.read_data(console)?;
        contents::expect_unchanged(provenance)?;
        // Only rates can be drawn without responses.
        let is_drawn = |(part, _): &&(Part, Draw)| *part == Part::Site || !data.groups.is_empty();
        let drawn = ALL.par_iter().filter(is_drawn).flat_map_iter(|&(part, draw): &(Part, Draw)| {
            draw(&data).into_iter().map(move |figure| (part, figure))
        });
        let mut figures: Vec<(Part, Figure)> = drawn.collect();
        finish(&mut figures, &data.made());
        let folder = self.figures();
        std::fs::create_dir_all(&folder).map_err(|source| TableError::io(&folder, source))?;
        figures.par_iter().try_for_each(|(_, figure)| -> anyhow::Result<()> {
            let path = |extension: &str| folder.join(format!("{}.{extension}", figure.name));
            text_file::write(&path("svg"), svg(figure, Place::File))?;
            text_file::write(&path("csv"), csv(&figure.drawing.plotted)?)?;
            Ok(text_file::write(&path("png"), &png(figure, self.options.dpi)?)?)
        })?;
        let name = file_name(&folder);
        let recorded = provenance::words(provenance);
        let html = page(&data, Page { figures: &figures, folder: &name, provenance: &recorded });
        text_file::write(&self.out, &html)?;
        let (count, megabytes) = (figures.len(), html.len() as f64 / 1e6);
        Ok(format!("{count} figures, and a page of {megabytes:.1} MB to open: {}", self.out.display()))
    }
}
