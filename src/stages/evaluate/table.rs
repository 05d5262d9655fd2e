use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::{Schema, SchemaRef};
use rayon::prelude::*;

use super::options::Format;
use crate::fragility::universal::Scenarios;
use crate::fragility::{PeaksDoubt, UniversalModel, doubt_of_peaks};
use crate::pipeline::console::Console;
use crate::pipeline::stream::pipelined;
use crate::rocking::Structure;
use crate::stages::shared::answers::Answers;
use crate::stages::shared::motions::in_g;
use crate::table::evaluated::{self, EVALUATED, EvaluatedRow};
use crate::table::intensities::{Intensities, Intensity, IntensityBatches};
use crate::table::schema::headings::Headings;
use crate::table::store::frame::frame_of;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::text;
use crate::table::store::text_file::TextWriter;
use crate::table::store::writer::TableWriter;

/// Rows that are read at once, and written as a row group.
const BATCH: usize = 16_384;

/// Where the rows go.
enum Writer {
    Parquet(TableWriter),
    Csv(TextWriter),
}

impl Writer {
    fn create(out: &Target, schema: &SchemaRef, provenance: &Provenance) -> anyhow::Result<Writer> {
        Ok(match out {
            Target::Path(path) if Format::of(out) == Format::Csv => Writer::Csv(TextWriter::create(path)?),
            _ => Writer::Parquet(TableWriter::with_schema(
                out.clone(),
                &EVALUATED,
                schema.clone(),
                provenance.clone(),
            )?),
        })
    }

    fn write(&mut self, rows: &RecordBatch, is_first: bool) -> anyhow::Result<()> {
        match self {
            Writer::Parquet(writer) => Ok(writer.write_row_group(rows)?),
            Writer::Csv(writer) => {
                let text = text::csv(&frame_of(rows)?)?;
                let without_heading = || text.split_once('\n').map_or("", |(_, rows)| rows);
                Ok(writer.write(if is_first { &text } else { without_heading() })?)
            }
        }
    }

    fn finish(self) -> anyhow::Result<()> {
        match self {
            Writer::Parquet(writer) => Ok(writer.finish()?),
            Writer::Csv(writer) => Ok(writer.finish()?),
        }
    }
}

/// Probabilities at each intensity of a table.
pub struct EvaluatedTable {
    pub answers: Box<dyn Answers>,
    /// Other headings of its columns.
    pub headings: Headings,
    /// Of all rows; without it each row has its own.
    pub structure: Option<Structure>,
}

impl EvaluatedTable {
    /// Reads intensities from `input` and writes their probabilities to `out`.
    ///
    /// # Errors
    /// If the table lacks a column or holds a value that cannot be used, or `out` cannot be written.
    pub fn write(
        &self,
        input: &Source,
        out: &Target,
        provenance: &Provenance,
        console: &Console,
    ) -> anyhow::Result<String> {
        let nameless = self.structure.clone().map(|structure| Structure { name: String::new(), ..structure });
        let intensities = IntensityBatches::open(input, &self.headings, nameless, self.answers.eta(), BATCH)?;
        let total = intensities.rows();
        self.answers.warn(console);
        if let lost @ [_, ..] = intensities.not_kept() {
            console
                .note(&format!("columns not copied: {}; convert them to text or numbers", lost.join(", ")));
        }
        let own = EVALUATED.schema();
        let kept = intensities.kept().iter().cloned().map(Arc::new);
        let schema = Arc::new(Schema::new(own.fields().iter().cloned().chain(kept).collect::<Vec<_>>()));
        let mut writer = Writer::create(out, &schema, provenance)?;
        let (mut suspect, mut is_first) = (Suspect::default(), true);
        let surface = self.answers.surface(Scenarios::One);
        let bar = console.bar(&provenance.stage, total);
        pipelined(
            intensities.map(|batch| Ok(batch?)),
            |Intensities { rows: intensities, kept }| {
                let row = |one| self.row(one, surface.as_ref());
                let rows: Vec<EvaluatedRow> = intensities.par_iter().map(row).collect();
                let suspect = Suspect::among(&rows, &intensities, &*self.answers);
                bar.inc(rows.len() as u64)?;
                let columns = evaluated::batch(&rows)?.columns().iter().cloned().chain(kept).collect();
                Ok((RecordBatch::try_new(schema.clone(), columns)?, suspect))
            },
            |(batch, more)| {
                suspect.add(&more);
                writer.write(&batch, std::mem::take(&mut is_first))
            },
        )?;
        bar.finish();
        suspect.warn(&*self.answers, console);
        writer.finish()?;
        Ok(format!("{total} rows by the {}", self.answers.words()))
    }

    fn row(&self, intensity: &Intensity, surface: Option<&UniversalModel>) -> EvaluatedRow {
        let Intensity { structure, measures, .. } = intensity;
        let probabilities = self.answers.probabilities(structure, measures);
        let rocks = probabilities.p_nr == 0.0;
        let distance = self.answers.model().distance(structure, measures).filter(|_| rocks);
        let surface = surface.filter(|_| rocks);
        EvaluatedRow {
            p_rad_s: intensity.structure.p_rad_s,
            alpha_rad: intensity.structure.alpha_rad,
            pga_m_s2: intensity.pga_m_s2,
            pgv_m_s: intensity.pgv_m_s,
            probabilities,
            out_of_range: self.answers.model().outside(measures).first().map(|out| out.measure),
            distance: distance.map(|(distance, _)| distance),
            p_ro_universal: surface.and_then(|surface| surface.p_ro(structure, measures)),
        }
    }
}

/// Counts of rows that need a word of warning.
#[derive(Default)]
struct Suspect {
    out_of_range: usize,
    other_structure: usize,
    other_block: usize,
    without_measure: usize,
    doubtful_size: usize,
    doubtful: [usize; PeaksDoubt::ALL.len()],
    rocking: usize,
    largest_pga_m_s2: f64,
}

impl Suspect {
    fn among(rows: &[EvaluatedRow], intensities: &[Intensity], answers: &dyn Answers) -> Suspect {
        let has_no_measure =
            |row: &&EvaluatedRow| row.probabilities.p_nr == 0.0 && row.probabilities.given_rocking.is_none();
        let is_other = |intensity: &&Intensity| answers.is_other_structure(&intensity.structure);
        Suspect {
            out_of_range: rows.iter().filter(|row| row.out_of_range.is_some()).count(),
            other_structure: intensities.iter().filter(is_other).count(),
            other_block: intensities.iter().filter(|one| answers.is_other_block(&one.structure)).count(),
            doubtful_size: intensities.iter().filter(|one| one.structure.doubt().is_some()).count(),
            doubtful: PeaksDoubt::ALL.map(|doubt| {
                let is_so = |row: &&EvaluatedRow| doubt_of_peaks(row.pga_m_s2, row.pgv_m_s) == Some(doubt);
                rows.iter().filter(is_so).count()
            }),
            without_measure: rows.iter().filter(has_no_measure).count(),
            rocking: rows.iter().filter(|row| row.probabilities.p_nr == 0.0).count(),
            largest_pga_m_s2: rows.iter().map(|row| row.pga_m_s2).fold(0.0, f64::max),
        }
    }

    fn add(&mut self, more: &Suspect) {
        self.out_of_range += more.out_of_range;
        self.other_structure += more.other_structure;
        self.other_block += more.other_block;
        self.without_measure += more.without_measure;
        self.doubtful_size += more.doubtful_size;
        self.rocking += more.rocking;
        self.largest_pga_m_s2 = self.largest_pga_m_s2.max(more.largest_pga_m_s2);
        self.doubtful.iter_mut().zip(more.doubtful).for_each(|(sum, more)| *sum += more);
    }

    fn warn(&self, answers: &dyn Answers, console: &Console) {
        let other = answers.words_of_others();
        for (rows, reason) in [
            (self.out_of_range, "a measure outside of the data (column out_of_range): extrapolated"),
            (self.other_structure, &other),
            (
                self.other_block,
                "another p or alpha than the fits: curves taken to other structures often fail",
            ),
            (self.doubtful_size, "a p of a solid block of 90 m and more: were its dimensions in cm?"),
            (self.without_measure, "no value of a measure that the fits need: their probabilities are null"),
        ]
        .into_iter()
        .chain(self.doubtful.into_iter().zip(PeaksDoubt::ALL.map(PeaksDoubt::words)))
        {
            if rows > 0 {
                console.warn(&format!("{rows} rows have {reason}"));
            }
        }
        if self.rocking == 0
            && let Some(question) = in_g("row", "pga_m_s2", self.largest_pga_m_s2)
        {
            console.warn(&question);
        }
    }
}
