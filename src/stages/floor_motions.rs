//! floor-motions: motions of the ground as a floor of a building has them.

use std::path::PathBuf;

use arrow_array::RecordBatch;
use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::motion::{Floor, MeasurePlan, MotionMeasures, Suite};
use rockfrag_core::object::Field;
use serde::{Deserialize, Serialize};

use super::shared::motions::process_in_order;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Files, Read, out_of_partition};
use crate::table::TableError;
use crate::table::columns::Batch;
use crate::table::file::Partition;
use crate::table::motions::{ACCELERATION, Sampled, batch, open, parts, spectral_period_s};
use crate::table::rows;

const AT_ONCE: usize = 32;

/// Filter motions through a linear building to one of its floors
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag floor-motions --in motions.parquet --period 0.6 --level 0.5 \
    --out floor.parquet")]
pub struct FloorMotions {
    /// Motions of the ground to read: motion_id, dt_s and acceleration_m_s2
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "motions.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Motions of the floor to write, with all other columns
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "floor.parquet")]
    out: PathBuf,
    /// First period of the building, s
    #[arg(long, value_name = "S", value_parser = |text: &str| Field::Period.parse_value(text))]
    period: f64,
    /// Height of the floor over that of the roof, 0 to 1
    #[arg(long, value_name = "Z", value_parser = |text: &str| Field::Level.parse_value(text))]
    level: f64,
    /// Damping ratio of the modes
    #[arg(long, value_name = "RATIO", default_value = "0.05",
          value_parser = number(0.005..=0.5, "a ratio from 0.005 to 0.5: is it in percent?"))]
    damping: f64,
    /// Only part i of n (0 to n - 1), into the folder --out
    #[arg(long, value_name = "I/N")]
    partition: Option<Partition>,
}

#[derive(Serialize, Deserialize)]
struct FloorRow {
    suite: String,
    floor_period_s: f64,
    floor_level: f64,
}

impl Stage for FloorMotions {
    fn files(&self) -> Files {
        let read = Read::partition("in", &self.input, self.partition);
        Files::tables([read], [out_of_partition(&self.out, self.partition)])
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let table = open(&self.input, self.partition)?;
        let problem = TableError::table(&self.input, "motions of a floor; expected those of the ground");
        anyhow::ensure!(table.schema().index_of("floor_level").is_err(), problem);
        let rows = RecordBatch::new_empty(table.schema().clone());
        let columns = Batch { path: (*self.input).into(), first_row: 0, rows };
        let schema = self.filter(Sampled { columns, motions: Vec::new() })?.schema();
        let mut writer = context.create(&context.plan.outputs[0], &schema)?;
        process_in_order(
            &context.bar(table.rows()),
            parts(&table, |_| true, AT_ONCE),
            |some| self.filter(some),
            |some| Ok(writer.append(&some)?),
        )?;
        let summary =
            format!("{} motions at level {} of a building of {} s\n", table.rows(), self.level, self.period);
        context.finish(writer, &summary)?;
        Ok(summary)
    }
}

impl FloorMotions {
    /// The rows of the floor; measures are those of its motions, all other columns those of the ground.
    fn filter(&self, ground: Sampled) -> anyhow::Result<RecordBatch> {
        let Sampled { columns, motions } = ground;
        let floor = Floor { period_s: self.period, level: self.level };
        let schema = columns.rows.schema();
        let periods = schema.fields().iter().filter_map(|field| spectral_period_s(field.name()));
        let housner = columns.numbers("housner_m")?.iter().any(Option::is_some);
        let plan = MeasurePlan { housner, sa_periods_s: periods.collect() };
        let (mut floors, mut filtered, mut measured) = (Vec::new(), Vec::new(), Vec::new());
        for motion in motions {
            motion.record()?;
            let moved = floor.motion(&motion.acceleration_m_s2, motion.dt_s, self.damping);
            let (written, measures) = plan.measure_written(moved.into_iter(), motion.dt_s);
            measured.push(measures);
            filtered.push(written);
            floors.push(FloorRow {
                suite: motion.suite.unwrap_or("record".to_string()) + Suite::ON_FLOOR,
                floor_period_s: self.period,
                floor_level: self.level,
            });
        }
        let known = [others(&columns.rows)?, rows::batch(&floors)?, rows::batch(&measured)?];
        batch(&known, &plan.sa_periods_s, measured.iter().zip(filtered.iter().map(Vec::as_slice)))
    }
}

/// All columns that are neither the suite nor samples nor measures of them.
fn others(rows: &RecordBatch) -> anyhow::Result<RecordBatch> {
    let (schema, measures) = (rows.schema(), rows::schema::<MotionMeasures>());
    let is_other = |&at: &usize| {
        let name = schema.field(at).name();
        !(name == ACCELERATION || name == "suite" || spectral_period_s(name).is_some())
            && measures.index_of(name).is_err()
    };
    let kept: Vec<usize> = (0..schema.fields().len()).filter(is_other).collect();
    Ok(rows.project(&kept)?)
}
