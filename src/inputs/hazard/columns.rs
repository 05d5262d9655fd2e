//! What the headings of a hazard say: measures by their units, rates, probabilities and return periods, means
//! and fractiles.

use rockfrag_core::fragility::Peak;
use rockfrag_core::units::Quantity;

use crate::inputs::words::is_one_of;
use crate::inputs::{Grid, Heading, InputError, Result};

/// An intensity measure type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display)]
pub enum Imt {
    #[strum(serialize = "PGA")]
    Pga,
    #[strum(serialize = "PGV")]
    Pgv,
    /// Spectral acceleration at 1 s.
    #[strum(serialize = "SA(1.0 s)")]
    Spectral,
    /// At another period.
    #[strum(serialize = "SA")]
    Other,
}

/// Which of several curves of a measure, with the words of OpenQuake.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::Display, strum::EnumString)]
pub enum Statistic {
    #[strum(to_string = "mean", serialize = "hcurve-mean")]
    Mean,
    #[strum(to_string = "median", serialize = "quantile-0.5", serialize = "quantile-0.50")]
    Median,
    #[strum(to_string = "16 %", serialize = "quantile-0.16")]
    Low,
    #[strum(to_string = "84 %", serialize = "quantile-0.84")]
    High,
}

/// How a column expresses frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Frequency {
    /// Annual rate of exceedance.
    Rate,
    /// Probability of exceedance in this many years.
    ProbabilityIn(f64),
    /// Years between exceedances.
    ReturnPeriod,
    /// Annual rate of occurrence of a pair of peaks.
    Occurrence,
}

/// A column by its heading: of values, of frequencies, or of neither.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HazardColumn {
    pub at: usize,
    /// Unit of its values, in m/s2 or m/s.
    pub unit: Option<f64>,
    pub frequency: Option<Frequency>,
    /// None where the heading names none: `Ground Motion (g)`, `AFE`.
    pub measure: Option<Imt>,
    pub statistic: Statistic,
}

fn is_numeric(word: &str) -> bool {
    word.starts_with(|sign: char| sign.is_ascii_digit())
}

impl HazardColumn {
    /// Reads the heading of a column of a file whose probabilities are for so many years, if it says so.
    pub fn new(at: usize, heading: &Heading, investigation_years: Option<f64>) -> HazardColumn {
        // A fractile may stand behind the unit: pga_g_16.
        let ranked = heading.text.rsplit_once('_');
        let ranked = ranked.filter(|(_, rank)| matches!(*rank, "16" | "84" | "p16" | "p84"));
        let (text, rank) = ranked.unwrap_or((&heading.text, ""));
        let Heading { bare, unit, .. } = Heading::new(text);
        let unit = unit.or(heading.unit);
        let quantity = unit.map(|unit| unit.quantity);
        let text = parted(&format!("{bare} {rank}"));
        let mut words: Vec<&str> = text.split_whitespace().collect();
        // A unit at the end of `PoE in 50 years`.
        words.extend((quantity == Some(Quantity::Time)).then_some("years"));
        let measure = take_measure(&mut words);
        let statistic = take_statistic(&mut words);
        let unit = unit.filter(|_| are_of_values(&words, measure, quantity)).map(|unit| unit.si);
        let frequency = Frequency::new(&words, investigation_years).filter(|_| unit.is_none());
        let is_velocity = quantity == Some(Quantity::Velocity);
        let measure = measure.or(is_velocity.then_some(Imt::Pgv));
        HazardColumn { at, unit, frequency, measure, statistic }
    }

    pub fn is_of_curve(&self) -> bool {
        self.unit.is_some() || self.frequency.is_some()
    }
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit, or has a
/// word more, which may change the meaning: `vertical PGA`. An acceleration without a name is PGA.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    let HazardColumn { unit, measure, .. } = HazardColumn::new(0, heading, None);
    match measure {
        None | Some(Imt::Pga) => Some((Peak::Pga, unit?)),
        Some(Imt::Pgv) => Some((Peak::Pgv, unit?)),
        Some(Imt::Spectral | Imt::Other) => None,
    }
}

/// Whether a heading in a unit, with these words beside a measure, is of values.
fn are_of_values(words: &[&str], measure: Option<Imt>, quantity: Option<Quantity>) -> bool {
    let name = match (quantity, measure) {
        (Some(Quantity::Acceleration), Some(Imt::Spectral | Imt::Other)) => return words.is_empty(),
        (Some(Quantity::Acceleration), None | Some(Imt::Pga)) => "acceleration",
        (Some(Quantity::Velocity), None | Some(Imt::Pgv)) => "velocity",
        _ => return false,
    };
    let is_named = measure.is_some() || words.iter().any(|word| is_one_of(word, name));
    is_named && words.iter().all(|word| is_one_of(word, name) || is_one_of(word, "of-values"))
}

/// A text in lower case with blanks between words and numbers: `pe50` is `pe 50`.
fn parted(text: &str) -> String {
    let is_digit = |sign: char| sign.is_ascii_digit() || sign == '.';
    let mut parted = String::new();
    for sign in text.to_lowercase().chars() {
        let last = parted.chars().last().unwrap_or(' ');
        if is_digit(sign) != is_digit(last) {
            parted.push(' ');
        }
        parted.push(if sign.is_alphanumeric() || sign == '.' { sign } else { ' ' });
    }
    parted.replace(". ", " ").replace(" .", " ").trim_matches('.').to_string()
}

/// Takes the words that name a measure out of a heading.
fn take_measure(words: &mut Vec<&str>) -> Option<Imt> {
    for at in 0..words.len() {
        let period: Vec<&str> = words[at + 1..].iter().copied().take_while(|word| is_numeric(word)).collect();
        let is_after_spectral = at > 0 && words[at - 1] == "spectral";
        let (measure, length) = match words[at] {
            "pgv" => (Imt::Pgv, 1),
            "pga" | "ag" => (Imt::Pga, 1),
            "s" if at > 0 || period.is_empty() => continue,
            "acceleration" if !is_after_spectral => continue,
            "sa" | "psa" | "s" | "acceleration" => {
                let is_at_1_s = period.join(".").parse() == Ok(1.0);
                let in_s = words.get(at + 1 + period.len()).is_some_and(|next| matches!(*next, "s" | "sec"));
                let measure = if is_at_1_s { Imt::Spectral } else { Imt::Other };
                (measure, 1 + period.len() + usize::from(in_s))
            }
            _ => continue,
        };
        words.drain(at..at + length);
        words.retain(|word| *word != "spectral");
        return Some(measure);
    }
    None
}

/// Words beside the number of a fractile.
const RANKS: [&str; 5] = ["p", "th", "percentile", "fractile", "quantile"];

/// Finds a fractile among the words of a heading, and its place. A number of years is none; in a sentence a
/// number is one with a word of rank beside it.
fn find_statistic(words: &[&str], in_sentence: bool) -> Option<(usize, Statistic)> {
    (0..words.len()).find_map(|at| {
        let before = at.checked_sub(1).map_or("", |before| words[before]);
        let after = words.get(at + 1).copied().unwrap_or_default();
        let is_ranked = [before, after].iter().any(|word| RANKS.contains(word));
        let are_years = is_one_of(after, "years") || is_one_of(before, "probability");
        let statistic = match words[at] {
            "median" => return Some((at, Statistic::Median)),
            "50" if !is_ranked => return None,
            "50" | "0.5" => Statistic::Median,
            "16" | "0.16" => Statistic::Low,
            "84" | "0.84" => Statistic::High,
            _ => return None,
        };
        (is_ranked || !in_sentence && !are_years).then_some((at, statistic))
    })
}

/// Takes the words that name a fractile out of a heading.
fn take_statistic(words: &mut Vec<&str>) -> Statistic {
    let Some((at, statistic)) = find_statistic(words, false) else { return Statistic::Mean };
    words.remove(at);
    words.retain(|word| !RANKS.contains(word));
    statistic
}

/// Finds the statistic that a comment, or a column of statistics, names for the curves of a file.
pub fn noted_statistic(grid: &Grid) -> Result<Statistic> {
    let mut texts = grid.notes.clone();
    if let Some(column) = grid.about("statistic") {
        let mut cells: Vec<&str> = grid.rows().map(|row| grid.cell(row, column)).collect();
        cells.dedup();
        if let [first, second, ..] = cells[..] {
            let found = format!("{} {first} and {second}", grid.headings[column].text);
            return Err(InputError::unexpected(found, "one: a file for each"));
        }
        texts.extend(cells.first().map(|cell| cell.to_string()));
    }
    let named = texts.iter().find_map(|text| {
        let text = parted(text);
        let words: Vec<&str> = text.split_whitespace().collect();
        find_statistic(&words, true).filter(|_| !words.contains(&"mean"))
    });
    Ok(named.map_or(Statistic::Mean, |(_, statistic)| statistic))
}

impl Frequency {
    /// None where a word stands beside that may change the meaning: `monthly rate`, `non-exceedance`.
    fn new(words: &[&str], investigation_years: Option<f64>) -> Option<Frequency> {
        const MEANINGS: [&str; 5] = ["rate", "return-period", "probability", "years", "of-rates"];
        let (numbers, words): (Vec<&str>, Vec<&str>) = words.iter().partition(|word| is_numeric(word));
        let has = |meaning: &str| words.iter().any(|word| is_one_of(word, meaning));
        let years: Option<f64> = numbers.first().and_then(|number| number.parse().ok());
        match words.iter().all(|word| MEANINGS.iter().any(|meaning| is_one_of(word, meaning))) {
            false => None,
            _ if has("probability") => {
                let annual = words.iter().any(|word| matches!(*word, "annual" | "aep" | "ape"));
                years.or(annual.then_some(1.0)).or(investigation_years).map(Frequency::ProbabilityIn)
            }
            // The 475 of `1/475 yr` is of one row, or of none.
            _ if numbers.iter().any(|number| number.parse() != Ok(1.0)) => None,
            _ if words.contains(&"occurrence") => Some(Frequency::Occurrence),
            _ if has("return-period") || words.starts_with(&["t", "r"]) => Some(Frequency::ReturnPeriod),
            _ => has("rate").then_some(Frequency::Rate),
        }
    }

    /// Reads the annual rate in a cell; none if the motion is certain, whose rate is unknown.
    pub fn annual_rate(self, grid: &Grid, row: usize, column: usize) -> Result<Option<f64>> {
        let number = grid.number(row, column)?;
        let (rate, expected) = match self {
            Frequency::Rate | Frequency::Occurrence if grid.is_percent(row, column) => {
                (None, "a rate a year, such as 0.002; percent are probabilities")
            }
            Frequency::Rate | Frequency::Occurrence => {
                (Some(number).filter(|rate| (0.0..=1000.0).contains(rate)), "a rate a year from 0 to 1000")
            }
            Frequency::ReturnPeriod => ((number > 0.0).then_some(1.0 / number), "years above 0"),
            Frequency::ProbabilityIn(_) if number == 1.0 => return Ok(None),
            Frequency::ProbabilityIn(years) => {
                let rate = (0.0..1.0).contains(&number).then(|| -(-number).ln_1p() / years);
                (rate, "a probability from 0 to 1, or with a percent sign")
            }
        };
        rate.map(Some).ok_or_else(|| grid.refusal(row, column, expected))
    }
}
