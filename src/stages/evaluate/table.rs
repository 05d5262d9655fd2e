use rayon::prelude::*;
use serde_json::{Value, json};

use super::LimitsBy;
use crate::pipeline::console::Console;
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::pipelined;
use crate::rocking::Structure;
use crate::stages::chosen_fits::ChosenFits;
use crate::stages::fits::FitsOptions;
use crate::stages::structure_options::StructureOptions;
use crate::table::evaluated::{self, EVALUATED, EvaluatedRow};
use crate::table::intensities::{Intensity, IntensityBatches};
use crate::table::provenance::Provenance;
use crate::table::source::{Source, Target};
use crate::table::writer::TableWriter;

/// Rows that are read at once, and written as a row group.
const BATCH: usize = 16_384;

/// Probabilities at each intensity of a table, ready to run.
pub struct EvaluateTable {
    fits: ChosenFits,
    fit_files: Vec<(&'static str, Source)>,
    /// Of all rows; without it each row has its own.
    structure: Option<Structure>,
    input: Source,
    out: Target,
}

impl EvaluateTable {
    /// At the intensities in `input`, into `out`.
    ///
    /// # Errors
    /// If the fits cannot be read or chosen, or the structure in the options is impossible.
    pub fn new(
        fits: &FitsOptions,
        limits: LimitsBy,
        structure: &StructureOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<EvaluateTable> {
        let fit_files = limits.fit_files(fits)?;
        let fits = limits.choose(fits)?;
        let structure = structure.is_given().then(|| structure.structure(fits.model.eta)).transpose()?;
        Ok(EvaluateTable { fits, fit_files, structure, input: input.into(), out: out.into() })
    }

    fn row(&self, intensity: &Intensity) -> EvaluatedRow {
        let (model, measures) = (&self.fits.model, &intensity.measures);
        let probabilities = self.fits.probabilities(measures);
        EvaluatedRow {
            p_rad_s: intensity.structure.p_rad_s,
            alpha_rad: intensity.structure.alpha_rad,
            pga_m_s2: intensity.pga_m_s2,
            pgv_m_s: intensity.pgv_m_s,
            probabilities,
            out_of_range: model.out_of_range(measures).next().map(|out| out.measure),
        }
    }
}

/// Rows that need a word of warning.
#[derive(Default)]
struct Doubtful {
    out_of_range: usize,
    other_eta: usize,
    without_measure: usize,
}

impl Doubtful {
    fn among(rows: &[EvaluatedRow], intensities: &[Intensity], fits: &ChosenFits) -> Doubtful {
        let has_no_measure =
            |row: &&EvaluatedRow| row.probabilities.p_nr == 0.0 && row.probabilities.given_rocking.is_none();
        let has_other_eta = |intensity: &&Intensity| fits.is_other_eta(intensity.structure.eta);
        Doubtful {
            out_of_range: rows.iter().filter(|row| row.out_of_range.is_some()).count(),
            other_eta: intensities.iter().filter(has_other_eta).count(),
            without_measure: rows.iter().filter(has_no_measure).count(),
        }
    }

    fn add(&mut self, more: &Doubtful) {
        self.out_of_range += more.out_of_range;
        self.other_eta += more.other_eta;
        self.without_measure += more.without_measure;
    }

    fn warn(&self, fits: &ChosenFits, console: &Console) {
        let eta = format!("another eta than the fits ({}): they depend on it", fits.model.eta);
        for (rows, reason) in [
            (self.out_of_range, "a measure outside of the data (column out_of_range): extrapolated"),
            (self.other_eta, &eta),
            (self.without_measure, "no value of a measure that the fits need: their probabilities are null"),
        ] {
            if rows > 0 {
                console.note(&format!("warning: {rows} rows have {reason}"));
            }
        }
    }
}

impl Stage for EvaluateTable {
    fn subcommand(&self) -> &'static str {
        EVALUATED.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        self.fit_files.iter().cloned().chain([("intensities", self.input.clone())]).collect()
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let structure = self.structure.as_ref();
        let structure = structure.map(|s| json!({ "p": s.p_rad_s, "alpha": s.alpha_rad, "eta": s.eta }));
        json!({ "fits": self.fits.words(), "limits": self.fits.words_of_limits(), "structure": structure })
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let nameless = self.structure.clone().map(|structure| Structure { name: String::new(), ..structure });
        let intensities = IntensityBatches::open(&self.input, nameless, self.fits.model.eta, BATCH)?;
        let total = intensities.rows();
        self.fits.warn_of_few_events(console);
        let mut writer = TableWriter::create(self.out.clone(), &EVALUATED, provenance.clone())?;
        let mut doubtful = Doubtful::default();
        let bar = console.bar(self.subcommand(), total);
        pipelined(
            intensities.map(|batch| Ok(batch?)),
            |intensities| {
                let rows: Vec<EvaluatedRow> = intensities.par_iter().map(|one| self.row(one)).collect();
                let doubtful = Doubtful::among(&rows, &intensities, &self.fits);
                bar.inc(rows.len() as u64)?;
                Ok((evaluated::batch(&rows)?, doubtful))
            },
            |(batch, more)| {
                doubtful.add(&more);
                Ok(writer.write_row_group(&batch)?)
            },
        )?;
        writer.finish()?;
        bar.finish();
        doubtful.warn(&self.fits, console);
        Ok(format!("{total} rows"))
    }
}
