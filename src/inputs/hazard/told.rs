//! What a hazard file says of its columns elsewhere: in comments and titles, in columns with one text, in its
//! name.

use std::collections::BTreeSet;
use std::path::Path;

use rockfrag_core::units::Unit;

use super::columns::{Frequency, Imt, Phrase, Statistic};
use crate::inputs::grid::only;
use crate::inputs::words::{means, says_vertical};
use crate::inputs::{Grid, Heading, InputError, Meaning, Result};
use crate::source::split_sheet;

#[derive(Debug, Default)]
pub struct Told {
    pub measures: Vec<Imt>,
    pub units: Vec<Unit>,
    pub statistic: Option<Statistic>,
    /// That probabilities are for.
    pub years: Option<f64>,
}

impl Told {
    /// Reads comments, titles, remarks, and the names of the file and its sheet.
    pub fn new(grid: &Grid, file: &Path) -> Result<Told> {
        let years = noted(grid, "investigation time").and_then(|years| years.parse().ok());
        let mut told = Told { years, ..Told::default() };
        for key in ["imt", "kind", "statistic", "component"] {
            noted(grid, key).map_or(Ok(()), |value| told.qualify(&Heading::new(key), value))?;
        }
        let remarks = (0..grid.headings.len()).filter(|at| means(&grid.headings[*at].name, "remark"));
        let remarks = remarks.flat_map(|at| grid.rows().map(move |row| grid.cell(row, at)));
        let (file, _) = split_sheet(file);
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        let mut texts = grid.notes.iter().map(String::as_str).chain(remarks).chain([&*name]);
        texts.try_for_each(|text| told.remark(text))?;
        Ok(told)
    }

    fn remark(&mut self, text: &str) -> Result<()> {
        // AG is a form of company there.
        let parts = text.split([';', ',']).map(|part| Phrase::new(&part.replace("AG", "")));
        let parts: Vec<Phrase> = parts.collect();
        let has = |word: &str| parts.iter().any(|part| part.rest.iter().any(|own| own == word));
        let is_limit = |part: &Phrase| matches!(part.statistic, Some(Statistic::Low | Statistic::High));
        let ranked = parts.iter().find(|part| part.is_ranked && (is_limit(part) || !has("mean")));
        let is_other = ranked.is_some_and(|part| part.statistic.is_none());
        if is_other || says_vertical(text) {
            let expected = "horizontal motion: the mean, the median, or the 16th and 84th percentiles";
            return Err(InputError::unexpected(format!("'{text}'"), expected));
        }
        self.statistic = ranked.and_then(|part| part.statistic).or(self.statistic);
        for part in parts {
            let is_of_unit = |word: &String| means(word, "unit") || word.starts_with("acc");
            let is_of_unit = !part.measures.is_empty() || part.rest.iter().any(is_of_unit);
            if let (Some(Frequency::ProbabilityIn(years)), None) = (part.frequency, self.years) {
                self.years = Some(years);
            }
            self.units.extend(part.unit.filter(|_| is_of_unit));
            self.add(part.measures);
        }
        Ok(())
    }

    fn add(&mut self, measures: Vec<Imt>) {
        for imt in measures {
            match self.measures.iter_mut().find(|known| known.may_be(imt)) {
                Some(known) if *known == Imt::Sa => *known = imt,
                Some(_) => {}
                None => self.measures.push(imt),
            }
        }
    }

    /// Takes what one text says of all rows, `mean` of a `kind`, if it is understood to its end.
    pub fn qualify(&mut self, heading: &Heading, text: &str) -> Result<()> {
        let whole = match (means(&heading.name, "spectral-period"), text.parse()) {
            (true, Ok(0.0)) => "PGA".to_string(),
            (true, _) => format!("SA {text} s"),
            (false, _) => format!("{} {text}", heading.bare),
        };
        let phrase = Phrase::new(&whole);
        if !phrase.says_only(&["qualifier", "of-values"]) {
            let expected = "PGA, PGV or SA(1.0), horizontal, mean, median, or quantiles 0.16 and 0.84";
            return Err(InputError::unexpected(format!("{} '{text}'", heading.text), expected));
        }
        self.add(phrase.measures);
        self.statistic = phrase.statistic.or(self.statistic);
        Ok(())
    }

    /// What a column says that is not of a curve.
    pub fn meaning(&mut self, grid: &Grid, at: usize, is_joint: bool) -> Meaning {
        let heading = &grid.headings[at];
        let is = |meaning: &str| means(&heading.name, meaning);
        let cells: BTreeSet<&str> = grid.rows().filter_map(|row| grid.value(row, at)).collect();
        match cells.first() {
            _ if is("place") => Meaning::Known("site".to_string()),
            _ if is_joint && is("magnitude") => Meaning::Known("magnitude".to_string()),
            None => Meaning::Kept,
            _ if is_joint && is("field") || is("remark") || is("spectral-shape") => Meaning::Kept,
            Some(cell) if cells.len() == 1 && self.qualify(heading, cell).is_ok() => {
                Meaning::Known(cell.to_string())
            }
            _ => Meaning::NotUnderstood,
        }
    }

    /// The unit that is named of values such as these, if it is one.
    pub fn unit(&self, is_of_values: impl Fn(Unit) -> bool) -> Option<Unit> {
        only(self.units.iter().copied().filter(|unit| is_of_values(*unit)))
    }

    /// Refuses headings in another unit, or probabilities in another time, than comments name.
    pub fn expect_same(&self, headings: &[Heading]) -> Result<()> {
        let differs = |heading: &&Heading| {
            let unit = heading.unit.and_then(|own| self.unit(|unit| unit.quantity == own.quantity));
            let is_other_time = match (Phrase::new(&heading.text).frequency, self.years) {
                (Some(Frequency::ProbabilityIn(years)), Some(told)) => years != told,
                _ => false,
            };
            unit.is_some() && unit != heading.unit || is_other_time
        };
        let other = headings.iter().find(differs).map(|heading| format!("heading '{}'", heading.text));
        let expected = "the same unit, or the same years, in both";
        other.map_or(Ok(()), |other| Err(InputError::unexpected(other + " against a comment", expected)))
    }

    /// The measure of a curve whose headings name this one, or none; an acceleration of which nothing is said
    /// is PGA.
    pub fn measure(&self, named: Option<Imt>) -> Result<Imt> {
        match (named, &self.measures[..]) {
            (None, [imt]) => Ok(*imt),
            (Some(Imt::Sa), [imt]) if imt.may_be(Imt::Sa) => Ok(*imt),
            (Some(named), _) => Ok(named),
            (None, []) => Ok(Imt::Pga),
            (None, [first, second, ..]) => {
                let found = format!("{first} and {second} in comments");
                Err(InputError::unexpected(found, "the measure in the heading, by --columns if need be"))
            }
        }
    }
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
