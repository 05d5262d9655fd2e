//! evaluate: probabilities at one intensity, at each of a table, or over the hazard of a site.

mod answer;
mod csv_table;
mod options;
mod point;
mod rates;
mod table;

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use anyhow::Context;
use serde_json::{Value, json};

use self::answer::Answer;
use self::options::Format;
pub use self::options::{EvaluateOptions, HazardOptions, LimitsBy, PointOptions};
use self::table::EvaluatedTable;
use super::shared::answers::Answers;
use super::shared::chosen_fits::ChosenFits;
use super::shared::fits::{FIT_INPUTS, FitFiles, ModelForm, note_fits_of_run};
use super::shared::hazard;
use super::shared::resampled_fits;
use super::shared::structures::{StructureSpec, warn_of_size};
use super::shared::surface::{self, PAPER_LIMIT, Surface};
use crate::fragility::universal::{self, Scenarios};
use crate::fragility::{ReplicateLimits, ResampledModel};
use crate::keyword::Keyword;
use crate::motion::Suite;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, expect_parquet};
use crate::pipeline::files::hash;
use crate::pipeline::options::Word;
use crate::pipeline::stage::{Stage, beside, content_of_role, places};
use crate::pipeline::terminal::Terminal;
use crate::table::TableError;
use crate::table::evaluated::EVALUATED;
use crate::table::schema::headings::Headings;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::text_file;
use crate::table::store::writer::TableWriter;

/// The role of a table of intensities.
const INTENSITIES: &str = "intensities";

impl LimitsBy {
    /// The fits, with their resamples where limits need them.
    fn choose(self, files: &FitFiles) -> anyhow::Result<ChosenFits> {
        let chosen = files.choose()?;
        let limits = match self {
            LimitsBy::Delta => return Ok(chosen),
            LimitsBy::Percentile => ReplicateLimits::Percentile,
            LimitsBy::BiasCorrected => ReplicateLimits::BiasCorrected,
        };
        let replicates = resampled_fits::read(files, &chosen)?;
        Ok(ChosenFits { resampled: Some(ResampledModel { replicates, limits }), ..chosen })
    }

    /// The files that the fits come from, by the role each plays.
    fn fit_files(self, files: &FitFiles) -> anyhow::Result<Vec<(&'static str, Source)>> {
        let mut sources = files.inputs().to_vec();
        if self != LimitsBy::Delta {
            let [pex, pro] = resampled_fits::files(files)?;
            sources.extend([("pex bootstrap", pex.into()), ("pro bootstrap", pro.into())]);
        }
        Ok(sources)
    }
}

/// The stage, ready to run.
pub struct Evaluate {
    options: EvaluateOptions,
    /// The fits that answer; without them the surface that is shipped does.
    fits: Option<FitFiles>,
    fit_files: Vec<(&'static str, Source)>,
    /// Why fits that are there do not answer.
    why_not: Option<String>,
    structure: StructureSpec,
    /// A table of intensities, if it is asked at each of them.
    intensities: Option<Source>,
    /// Other headings of its columns.
    headings: Headings,
    format: Format,
    /// Where the answer goes, if it is not printed.
    out: Option<Target>,
    printed: OnceLock<String>,
}

impl Declare for Evaluate {
    type Options = EvaluateOptions;
    const NAME: &'static str = EVALUATED.stage;
    const ABOUT: &'static str = "Compute probabilities of rocking, failure and overturning: at one intensity, at each row of a \
         table, or per year at a site";
    const EXAMPLES: &'static str = "rockfrag evaluate --model universal --width 0.5 --height 2.0 --pga 0.5 --pgv 0.6\n\
        rockfrag evaluate --model universal --width 0.5 --height 2.0 --hazard hazard.csv";
    const HELPS: &'static [(&'static str, &'static str)] = &[
        (
            "suite",
            "Suite of the fits or of the universal surface [default: the only one; of the surface, csgm]",
        ),
        (
            "eta",
            "Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions, or as in the fits]",
        ),
    ];
    const INPUTS: &'static [Input] = &[
        FIT_INPUTS[0].if_there(),
        FIT_INPUTS[1].if_there(),
        Input::file(
            INTENSITIES,
            "in",
            "",
            "Parquet or CSV table with pga_m_s2 (in CSV also pga_g) and pgv_m_s and, where they vary, p_rad_s, alpha_rad, eta, tp_s and tm_s; other columns of text and numbers are copied to the output",
        )
        .if_named()
        .under("Many intensities")
        .without(&["pga", "pgv", "tp", "tm", "hazard", "format"]),
    ];
    const OUTPUT: Output = Output::file(
        "evaluated.parquet",
        "File to write [default: stdout; with --in, evaluated.parquet beside the table; a name in .csv makes it CSV]",
    )
    .under("Output");

    fn create(options: &EvaluateOptions, files: &Files) -> anyhow::Result<Evaluate> {
        let structure = options.structure.spec(options.fits.structure.as_deref())?;
        let (fits, why_not) = asked_fits(options, files, &structure)?;
        let fits = fits.map(|fits| fits.prefer(options.structure.name.as_deref()));
        let intensities = files.optional(INTENSITIES);
        let beside_table = || Some(beside(intensities.as_ref()?.name(), Self::OUTPUT.file).into());
        let format = options.format.map(|Word(format)| format);
        let file =
            format.map_or(Self::OUTPUT.file.to_string(), |format| format!("evaluated.{}", format.ending()));
        let out = files.asked(&file).or_else(beside_table);
        let format = format.unwrap_or_else(|| out.as_ref().map_or(Format::Table, Format::of));
        if let (Some(_), Some(out)) = (&intensities, &out)
            && format != Format::Csv
        {
            expect_parquet(out)?;
        }
        let (intensities, headings) = match intensities {
            Some(Source::Path(path)) if csv_table::is_csv(&path) => {
                let table = csv_table::read(&path, &options.headings())?;
                (Some(Source::Memory(Arc::new(table))), Headings::default())
            }
            other => (other, options.headings()),
        };
        if format == Format::Parquet && out.is_none() {
            return Err(UsageError::because("format parquet needs --out FILE"));
        }
        Ok(Evaluate {
            fit_files: match &fits {
                Some(fits) => options.limits.0.fit_files(fits)?,
                None => Vec::new(),
            },
            structure,
            options: options.clone(),
            fits,
            why_not,
            intensities,
            headings,
            format,
            out,
            printed: OnceLock::new(),
        })
    }
}

/// The fits that answer; where they are only found, and cannot answer for this structure, why.
fn asked_fits(
    options: &EvaluateOptions,
    files: &Files,
    structure: &StructureSpec,
) -> anyhow::Result<(Option<FitFiles>, Option<String>)> {
    let fits = FitFiles::if_asked(&options.fits, files)?;
    let is_open = options.fits.model.is_none()
        && options.limits.0 == LimitsBy::Delta
        && files.optional(INTENSITIES).is_none();
    let structure = structure.structure().ok().filter(|_| is_open);
    let why_not = fits.as_ref().zip(structure).and_then(|(fits, asked)| fits.why_not(files, &asked));
    Ok((fits.filter(|_| why_not.is_none()), why_not))
}

impl Evaluate {
    /// What answers.
    fn answers(&self) -> anyhow::Result<Box<dyn Answers>> {
        let (limits, limit) = (self.options.limits.0, self.options.limit_state);
        let scenarios = match self.options.hazard.hazard {
            Some(_) => Scenarios::Many,
            None => Scenarios::One,
        };
        let Some(fits) = &self.fits else {
            if limits != LimitsBy::Delta {
                return Err(UsageError::because(
                    "limits percentile and bc are of fits, and the universal surface has its own; leave --limits out, or name fits \
                     with --pex and --pro",
                ));
            }
            return Ok(Box::new(Surface::new(self.options.fits.suite.as_deref(), limit, scenarios)?));
        };
        surface::expect_no_limit(limit)?;
        let mut chosen = limits.choose(fits)?;
        if scenarios == Scenarios::Many {
            chosen.model = chosen.model.over_many_cells();
        }
        Ok(Box::new(chosen))
    }

    /// Answers for one intensity or one site.
    fn answer(&self, answers: &dyn Answers, console: &Console) -> anyhow::Result<Answer> {
        answers.warn(console);
        let structure = answers.structure(&self.structure)?;
        warn_of_size([&structure], console);
        answers.warn_of_structure(&structure, console);
        match &self.options.hazard.hazard {
            Some(path) => {
                let hazard =
                    hazard::read_and_tell(path, &self.options.headings(), |note| console.note(note))?;
                let fits = self.fits.as_ref();
                rates::answer(&self.options.hazard, path, hazard, answers, &structure, fits, console)
            }
            None => point::answer(&self.options.point, answers, &structure, console),
        }
    }

    /// Writes an answer, or keeps it to be printed.
    fn deliver(&self, answer: &Answer, provenance: &Provenance) -> anyhow::Result<()> {
        let Some(out) = &self.out else {
            let _ = self.printed.set(answer.text(self.format, &provenance.warnings.all())?);
            return Ok(());
        };
        match (self.format, out) {
            (Format::Parquet, _) | (_, Target::Memory(..)) => {
                let provenance = Provenance { shown: answer.shown.clone(), ..provenance.clone() };
                let mut writer = TableWriter::create(out.clone(), &answer.table, provenance)?;
                writer.append(&answer.rows)?;
                Ok(writer.finish()?)
            }
            (format, Target::Path(path)) => {
                Ok(text_file::write(path, answer.text(format, &provenance.warnings.all())?)?)
            }
        }
    }
}

impl Stage for Evaluate {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        let intensities = self.intensities.iter().map(|source| (INTENSITIES, source.clone()));
        self.fit_files.iter().cloned().chain(intensities).collect()
    }

    fn targets(&self) -> Vec<Target> {
        self.out.iter().cloned().collect()
    }

    fn parameters(&self) -> Value {
        let EvaluateOptions { fits, limits, limit_state, point, hazard, .. } = &self.options;
        let question = match (&self.intensities, &hazard.hazard) {
            (Some(_), _) => Value::Null,
            (None, Some(_)) => json!({ "ratio": hazard.ratio, "years": hazard.years }),
            (None, None) => json!(point),
        };
        let structure = &self.structure;
        let mut parameters = match &self.fits {
            Some(files) => {
                json!({ "fits": files.options, "limits": limits, "structure": structure, "question": question })
            }
            None => json!({
                "model": ModelForm::Universal.as_str(), "surface": blake3::hash(universal::SURFACE.as_bytes()).to_hex().as_str(), "suite": fits.suite.as_deref().unwrap_or(Suite::Csgm.as_str()),
                "limit-state": limit_state.unwrap_or(PAPER_LIMIT), "structure": structure, "question": question
            }),
        };
        if let Some(columns) = &self.options.columns {
            parameters["columns"] = json!(columns);
        }
        parameters
    }

    fn provenance(&self) -> anyhow::Result<Provenance> {
        if let Some(fits) = self.fits.as_ref().filter(|_| self.options.limits.0 != LimitsBy::Delta) {
            resampled_fits::expect_files(fits)?;
        }
        let sources = self.inputs();
        let content =
            |(role, source): &(&str, Source)| Ok((role.to_string(), content_of_role(role, source)?));
        let mut inputs = sources.iter().map(content).collect::<Result<BTreeMap<_, _>, TableError>>()?;
        if let Some(hazard) = &self.options.hazard.hazard {
            let content = hash(hazard).with_context(|| hazard.display().to_string())?;
            inputs.insert("hazard".to_string(), content);
        }
        Ok(Provenance::new(Self::NAME, self.parameters(), inputs).of_sources(places(&sources)))
    }

    fn show(&self, _terminal: &Terminal) -> anyhow::Result<String> {
        Ok(self.printed.get().cloned().unwrap_or_default())
    }

    fn is_own_text(&self, head: &str) -> bool {
        answer::is_own(head)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let answers = self.answers()?;
        let given = self.options.structure.structures.is_given();
        let structure = given.then(|| answers.structure(&self.structure)).transpose()?;
        if let Some(why_not) = &self.why_not {
            console.note(why_not);
        } else if self.fits.is_none() {
            note_fits_of_run(&self.options.fits, structure.as_ref(), console);
        }
        if let (Some(input), Some(out)) = (&self.intensities, &self.out) {
            warn_of_size(&structure, console);
            let table = EvaluatedTable { answers, headings: self.headings.clone(), structure };
            return table.write(input, out, provenance, console);
        }
        self.deliver(&self.answer(&*answers, console)?, provenance)?;
        Ok(String::new())
    }
}
