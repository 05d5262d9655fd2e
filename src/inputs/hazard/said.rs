//! What a hazard file says of its columns elsewhere: in comments and titles, in columns with one text, in its
//! name.

use std::collections::BTreeSet;
use std::path::Path;

use rockfrag_core::units::Unit;

use super::columns::{HazardColumn, Imt, Phrase, Statistic, is_ranked, parted, take_measure, take_statistic};
use super::openquake::{investigation_years, noted};
use crate::inputs::words::means;
use crate::inputs::{Grid, Heading, InputError, Meaning, Result};

#[derive(Debug, Default)]
pub struct Said {
    measures: Vec<Imt>,
    units: Vec<Unit>,
    pub statistic: Option<Statistic>,
    /// That probabilities are for.
    pub years: Option<f64>,
}

impl Said {
    /// Of a file whose probabilities are for so many years.
    pub fn in_years(years: f64) -> Said {
        Said { years: Some(years), ..Said::default() }
    }

    /// Reads comments, titles and remarks.
    pub fn new(grid: &Grid) -> Result<Said> {
        let mut said = Said { years: investigation_years(grid), ..Said::default() };
        for key in ["imt", "kind", "statistic", "component"] {
            let value = noted(grid, key).filter(|value| !said.qualify(&Heading::new(key), value));
            if let Some(value) = value {
                let expected = "PGA, PGV or SA(1.0), horizontal, mean, median, or quantiles 0.16 and 0.84";
                return Err(InputError::unexpected(format!("{key} '{value}' in a comment"), expected));
            }
        }
        let remarks = (0..grid.headings.len()).filter(|at| means(&grid.headings[*at].name, "remark"));
        let remarks = remarks.flat_map(|at| grid.rows().map(move |row| grid.cell(row, at)));
        for text in grid.notes.iter().map(String::as_str).chain(remarks) {
            said.remark(text)?;
        }
        Ok(said)
    }

    /// Takes measures, units and fractiles out of a sentence.
    fn remark(&mut self, text: &str) -> Result<()> {
        for part in text.split([';', ',']) {
            let heading = Heading::new(part);
            let words = parted(&part.replace('%', " "));
            let mut words: Vec<&str> = words.split_whitespace().filter(|word| *word != "ag").collect();
            let before = self.measures.len();
            self.measures.extend(std::iter::from_fn(|| take_measure(&mut words)));
            let is_of_unit = before < self.measures.len() || words.iter().any(|word| means(word, "unit"));
            self.units.extend(heading.unit.filter(|_| is_of_unit));
        }
        let all = parted(&text.replace('%', " "));
        let mut words: Vec<&str> = all.split_whitespace().filter(|word| *word != "th").collect();
        let is_fractile =
            |words: &[&str]| (0..words.len()).any(|at| words[at] == "median" || is_ranked(words, at));
        if words.contains(&"vertical") && !words.contains(&"horizontal") {
            return Err(InputError::unexpected(format!("'{text}'"), "horizontal motion"));
        }
        if !words.contains(&"mean") && is_fractile(&words) {
            let expected = "the mean, the median, or the 16th and 84th percentiles";
            let statistic = take_statistic(&mut words);
            self.statistic =
                Some(statistic.ok_or_else(|| InputError::unexpected(format!("'{text}'"), expected))?);
        }
        Ok(())
    }

    /// Takes what a column with one text says of all rows: `kind` and `mean`. Returns whether it is
    /// understood to its end.
    pub fn qualify(&mut self, heading: &Heading, cell: &str) -> bool {
        let phrase = Phrase::new(&match (means(&heading.name, "spectral-period"), cell.parse()) {
            (true, Ok(0.0)) => "PGA".to_string(),
            (true, _) => format!("SA {cell} s"),
            (false, _) => format!("{} {cell}", heading.bare),
        });
        let is_understood = phrase.says_only(&["qualifier", "of-values"]);
        if is_understood {
            self.measures.extend(phrase.measure);
            self.statistic = phrase.statistic.or(self.statistic);
        }
        is_understood
    }

    /// What a column of the file says.
    pub fn meaning(&mut self, grid: &Grid, column: &HazardColumn, is_joint: bool) -> Result<Meaning> {
        let heading = &grid.headings[column.at];
        let is = |meaning: &str| means(&heading.name, meaning);
        let cells: BTreeSet<&str> = grid.rows().filter_map(|row| grid.value(row, column.at)).collect();
        let mut cells = cells.into_iter();
        Ok(match (cells.next(), cells.next()) {
            _ if column.is_of_curve() => Meaning::default(),
            _ if is("place") => Meaning::Known("site".to_string()),
            _ if is_joint && is("magnitude") => Meaning::Known("magnitude".to_string()),
            _ if is_joint && is("field") => Meaning::Kept,
            (None, _) => Meaning::Kept,
            _ if is("remark") || is("spectral-shape") => Meaning::Kept,
            (Some(cell), None) if self.qualify(heading, cell) => Meaning::Known(cell.to_string()),
            (Some(first), Some(second)) if is("qualifier") => {
                let found = format!("{} {first} and {second}", heading.text);
                return Err(InputError::unexpected(found, "one: a file for each"));
            }
            _ => Meaning::NotUnderstood,
        })
    }

    /// The unit that is named of values such as these, if it is one.
    pub fn unit(&self, is_of_values: impl Fn(&Unit) -> bool) -> Option<Unit> {
        let mut units = self.units.iter().filter(|unit| is_of_values(unit));
        let first = units.next()?;
        units.all(|unit| unit == first).then_some(*first)
    }

    /// The measure of a curve whose headings name this one, or none. The name of a file tells where all else
    /// is silent; an acceleration of which nothing is said is PGA.
    pub fn measure(&self, named: Option<Imt>, file: &Path) -> Result<Imt> {
        let mut told = self.measures.clone();
        if told.is_empty() && named.is_none() {
            let name = parted(&file.file_stem().unwrap_or_default().to_string_lossy());
            told.extend(take_measure(&mut name.split_whitespace().filter(|word| *word != "ag").collect()));
        }
        let has_period = told.iter().any(|imt| matches!(imt, Imt::Spectral(Some(_))));
        told.retain(|imt| !(has_period && *imt == Imt::Spectral(None)));
        told.dedup();
        match (named, &told[..]) {
            (None, []) => Ok(Imt::Pga),
            (None, [imt]) | (Some(Imt::Spectral(None)), [imt @ Imt::Spectral(_)]) => Ok(*imt),
            (None, [first, second, ..]) => {
                let found = format!("{first} and {second} in comments");
                Err(InputError::unexpected(found, "the measure in the heading, by --columns if need be"))
            }
            (Some(named), _) => Ok(named),
        }
    }

    /// Refuses a title that names other measures than all headings.
    pub fn expect_one_of(&self, named: &[Imt]) -> Result<()> {
        let is_named = |told: &Imt| named.iter().any(|named| is_same(*named, *told));
        match (named.first(), self.measures.first()) {
            (Some(heading), Some(told)) if !self.measures.iter().any(is_named) => {
                let found = format!("{heading} in a heading and {told} in a comment");
                Err(InputError::unexpected(found, "one of them"))
            }
            _ => Ok(()),
        }
    }
}

/// Whether two names may be of one measure: SA is at any period.
fn is_same(one: Imt, other: Imt) -> bool {
    let is_at_any = |imt: Imt| imt == Imt::Spectral(None);
    one == other
        || matches!((one, other), (Imt::Spectral(_), Imt::Spectral(_)))
            && (is_at_any(one) || is_at_any(other))
}
