//! How a file of a person is read: as a list, a hazard, a table of intensities or a record, by its headings.

use std::slice;

use rockfrag_core::motion::measures::peak;
use rockfrag_core::object::Object;
use rockfrag_core::units::G_M_S2;
use serde::Serialize;

use super::{Inspect, above};
use crate::document::readings;
use crate::inputs::records::{ReadOptions, read_records};
use crate::inputs::{ColumnReading, Grid, Heading, InputError, Meaning, Reading, is_of_list};
use crate::inputs::{hazard, intensities, objects, unpack};
use crate::number::{plain, rounded, significant};
use crate::source;
use crate::table::frame::Format;

#[derive(Debug, Clone, Copy, Serialize, strum::Display)]
#[strum(serialize_all = "lowercase")]
#[serde(rename_all = "lowercase")]
enum Kind {
    List,
    Hazard,
    Intensities,
    Record,
}

#[derive(Serialize)]
struct Own {
    kind: Kind,
    #[serde(flatten)]
    reading: Reading,
}

impl Kind {
    fn new(grid: &Grid) -> Kind {
        let is_any = |of: fn(&Heading) -> bool| grid.headings.iter().any(of);
        match () {
            () if is_any(hazard::is_of_hazard) => Kind::Hazard,
            () if is_any(is_of_list) => Kind::List,
            () if is_any(|heading| hazard::peak(heading).is_some()) && grid.has_headings => Kind::Intensities,
            () => Kind::Record,
        }
    }
}

impl Inspect {
    pub(super) fn own(&self) -> anyhow::Result<String> {
        let Own { kind, reading } = self.read()?;
        match self.format {
            Format::Json => Ok(serde_json::to_string_pretty(&Own { kind, reading })? + "\n"),
            Format::Csv => {
                let mut csv = csv::Writer::from_writer(Vec::new());
                reading.columns.iter().try_for_each(|column| csv.serialize(column))?;
                Ok(String::from_utf8(csv.into_inner()?)?)
            }
            Format::Text => {
                let table = readings::table(&reading).text(None);
                let first = format!("{}: {kind}, {} rows", reading.file, reading.rows);
                Ok(above(&[vec![first], reading.others].concat(), &table))
            }
        }
    }

    /// Reads the file as the stage does that takes it.
    fn read(&self) -> anyhow::Result<Own> {
        let (mut reader, path) = (self.list.reader(), &self.file);
        let grid = self.list.reader().read(path);
        let kind = grid.as_ref().map_or(Kind::Record, Kind::new);
        let read = match kind {
            Kind::List => {
                objects::read(path, &mut reader, &self.list.defaults()).map(|objects| places(&objects))
            }
            Kind::Hazard => {
                hazard::read(slice::from_ref(path), &mut reader, self.effective_years).map(|_| Vec::new())
            }
            Kind::Intensities => intensities::read(path, &mut reader).map(|_| Vec::new()),
            // What is neither a record nor a table is no table.
            Kind::Record => {
                let record = self.record().map_err(|error| grid.err().unwrap_or(error).in_file(path))?;
                reader.readings.push(record);
                Ok(Vec::new())
            }
        };
        let (file, reading) = (path.display().to_string(), reader.readings.pop());
        let lines = match read {
            // One of several curves gives no hazard alone.
            Err(error) if reading.is_some() => vec![error.to_string()],
            read => read?,
        };
        let reading = reading.unwrap_or_default();
        Ok(Own { kind, reading: Reading { file, others: [reading.others, lines].concat(), ..reading } })
    }

    fn record(&self) -> Result<Reading, InputError> {
        let unreadable = |error: std::io::Error| InputError::Unreadable(error.kind(), error.to_string());
        let bytes = source::read(&source::split_sheet(&self.file).0).map_err(unreadable)?;
        let column = self.column.clone();
        let options = ReadOptions { dt_s: self.dt, unit: self.unit, column, ..ReadOptions::default() };
        let motions = unpack(bytes)?.into_iter().map(|member| read_records(&member.bytes, &options));
        let mut reading = Reading::default();
        for motion in motions.collect::<Result<Vec<_>, InputError>>()?.concat() {
            let samples = &motion.acceleration_m_s2;
            let heading = motion.origin.component.unwrap_or("acceleration".to_string());
            let pga_g = significant(peak(samples) / G_M_S2, 3);
            let (format, dt_s) = (motion.format, plain(motion.dt_s));
            reading.others.push(format!("{heading}: {format}, a step of {dt_s} s, PGA {pga_g} g"));
            let [first, last] = [samples.first(), samples.last()]
                .map(|sample| sample.map_or(String::new(), |sample| rounded(*sample).to_string()));
            reading.rows = reading.rows.max(samples.len());
            let (meaning, unit) = (Meaning::Known("acceleration".into()), Some(motion.unit.name.into()));
            reading.columns.push(ColumnReading {
                heading,
                meaning,
                unit,
                filled: samples.len(),
                first,
                last,
            });
        }
        Ok(reading)
    }
}

/// The floors of objects as they are read.
fn places(objects: &[Object]) -> Vec<String> {
    let line = |Object { name, floor, place, .. }: &Object| {
        let (floor, level) = (floor.as_ref()?, place.level?);
        Some(format!("{name}: {floor} -> level {}", significant(level, 3)))
    };
    objects.iter().filter_map(line).collect()
}
