//! What OpenQuake exports for one site: a curve with a column for each level, and ground-motion fields.

use std::path::Path;

use rockfrag_core::units::{CM_PER_M, G_M_S2};

use super::columns::{Frequency, Imt, Phrase, Statistic};
use super::{Curve, CurvePoint};
use crate::inputs::{Grid, Heading, InputError, Result};

/// Gives the columns of ground-motion fields headings with their units: PGA in g, PGV in cm/s.
pub fn name_fields(grid: &mut Grid) {
    for heading in &mut grid.headings {
        let Some(imt) = heading.text.strip_prefix("gmv_") else { continue };
        *heading = Heading::new(&format!("{imt} ({})", if imt == "PGV" { "cm/s" } else { "g" }));
    }
}

/// Reads a curve: the probability of exceedance of each level, in g or cm/s.
pub fn probabilities(grid: &Grid, file: &Path) -> Result<Curve> {
    let (measure, unit) = match noted(grid, "imt") {
        Some("PGA") => (Imt::Pga, G_M_S2),
        Some("PGV") => (Imt::Pgv, 1.0 / CM_PER_M),
        Some("SA(1.0)") => (Imt::SA_1S, G_M_S2),
        other => {
            let found = other.map_or("no imt in the header".to_string(), |imt| format!("a curve of {imt}"));
            return Err(InputError::unexpected(found, "PGA, PGV or SA(1.0)"));
        }
    };
    let unknown = || InputError::unexpected("no years after investigation_time", "the file as exported");
    let frequency = Frequency::ProbabilityIn(investigation_years(grid).ok_or_else(unknown)?);
    let statistic = statistic(grid)?;
    if grid.lines.len() != 1 {
        let found = format!("curves of {} sites", grid.lines.len());
        return Err(InputError::unexpected(found, "the row of one"));
    }
    let mut points = Vec::new();
    for (column, heading) in grid.headings.iter().enumerate() {
        let Some(level) = heading.text.strip_prefix("poe-") else { continue };
        let unknown = |_| InputError::unexpected(format!("heading {}", heading.text), "poe- and a level");
        let value = unit * level.parse::<f64>().map_err(unknown)?;
        let annual_rate = frequency.annual_rate(grid, 0, column)?;
        points.push(CurvePoint { value, annual_rate, row: 0, column });
    }
    Curve::new((measure, statistic), points, grid, file)
}

/// Which of several curves it is. What is not known to be the mean is not taken for it.
fn statistic(grid: &Grid) -> Result<Statistic> {
    // Before version 3, the kind was the first word of the header.
    let header = grid.notes.first().map_or("", |note| note.trim_start_matches(['#', ' ']));
    let kind = noted(grid, "kind").or(header.split([',', ' ']).next()).unwrap_or_default();
    let phrase = Phrase::new(kind);
    let expected = "the mean, and quantiles 0.16 and 0.84 beside it";
    let is_understood = phrase.measure.is_none() && phrase.says_only(&["qualifier"]);
    let known = is_understood.then(|| phrase.statistic.unwrap_or(Statistic::Mean));
    known.ok_or_else(|| InputError::unexpected(format!("a curve of kind '{kind}'"), expected))
}

/// The years that probabilities are for, by the header.
pub fn investigation_years(grid: &Grid) -> Option<f64> {
    noted(grid, "investigation time")?.parse().ok()
}

/// What a comment says after a key: of 760 in `vs30=760.0`, `Vs30: 760 m/s` or `# vs30 = '760'`.
pub fn noted<'a>(grid: &'a Grid, key: &str) -> Option<&'a str> {
    grid.notes.iter().find_map(|note| {
        let lower = note.to_ascii_lowercase().replace('_', " ");
        let places = lower.match_indices(key).filter(|(at, _)| !note[..*at].ends_with(char::is_alphanumeric));
        let mut values = places.map(|(at, _)| note[at + key.len()..].trim_start());
        let value = values.find_map(|rest| rest.strip_prefix(['=', ':']))?;
        value.trim_start_matches(['\'', '"', ' ']).split([',', '"', '\'', ' ', ';']).next()
    })
}
