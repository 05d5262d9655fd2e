//! What the headings of a hazard say: peaks and spectral accelerations by their units, rates, probabilities and
//! return periods, means and fractiles.

use std::str::FromStr;

use anyhow::bail;

use crate::fragility::Peak;
use crate::sheet::{Heading, Sheet};
use crate::units::{CM_PER_M, G_M_S2, Quantity};

/// Another heading for a column: `pga_g=PGA`.
#[derive(Debug, Clone, PartialEq)]
pub struct Renamed {
    column: String,
    pub heading: String,
}

impl FromStr for Renamed {
    type Err = String;

    fn from_str(text: &str) -> Result<Renamed, String> {
        let pair = text.split_once('=').ok_or("expected COLUMN=HEADING, such as pga_g=PGA")?;
        Ok(Renamed { column: pair.0.trim().to_string(), heading: pair.1.trim().to_string() })
    }
}

/// Renames columns as the user requests.
pub fn rename(sheet: &mut Sheet, renamed: &[Renamed]) -> anyhow::Result<()> {
    for Renamed { column, heading } in renamed {
        let Some(found) = sheet.headings.iter_mut().find(|found| found.text == *heading) else {
            bail!("no heading '{heading}' among {}", headings(sheet));
        };
        let renamed = Heading::of(column);
        if let (Some(old), Some(new)) = (found.unit, renamed.unit)
            && old.quantity != new.quantity
        {
            bail!("--columns {column}={heading}: the heading has a unit of another quantity");
        }
        *found = renamed;
    }
    Ok(())
}

/// The headings of a sheet, for messages.
pub fn headings(sheet: &Sheet) -> String {
    let texts: Vec<&str> = sheet.headings.iter().map(|heading| heading.text.as_str()).collect();
    if texts.is_empty() { "no headings".to_string() } else { format!("headings {}", texts.join(", ")) }
}

/// Whether a heading has one of these words, and no others but those that may stand beside them: a word more
/// may mean something else (`vertical PGA`, `monthly rate`).
fn names(heading: &Heading, known: &[&str], beside: &[&str]) -> bool {
    let is_known = |word: &str| known.contains(&word);
    let mut words = heading.name.split('_');
    words.clone().any(is_known) && words.all(|word| is_known(word) || beside.contains(&word))
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    const BESIDE: [&str; 11] =
        ["peak", "ground", "g", "motion", "horizontal", "mean", "rotd50", "geomean", "h", "at", "site"];
    let unit = heading.unit?;
    match unit.quantity {
        Quantity::Acceleration if names(heading, &["pga", "ag", "a", "acceleration", "motion"], &BESIDE) => {
            Some((Peak::Pga, unit.si))
        }
        Quantity::Velocity if names(heading, &["pgv", "velocity"], &BESIDE) => Some((Peak::Pgv, unit.si)),
        _ => None,
    }
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

/// More motions a year than any site has that a hazard counts.
const MOST_FREQUENT: f64 = 1000.0;

impl Frequency {
    /// None where a word stands beside that may change the meaning: `monthly rate`, `non-exceedance`.
    fn of(heading: &Heading, investigation_years: Option<f64>) -> Option<Frequency> {
        const RATES: [&str; 6] = ["rate", "frequency", "frequenza", "afe", "afoe", "mafe"];
        const PERIODS: [&str; 5] = ["return", "ritorno", "tr", "rp", "arp"];
        const PROBABILITIES: [&str; 3] = ["probability", "poe", "aep"];
        const BESIDE: [&str; 25] = [
            "annual",
            "annua",
            "media",
            "mean",
            "of",
            "occurrence",
            "exceedance",
            "exceedence",
            "eccedenza",
            "per",
            "a",
            "in",
            "year",
            "years",
            "yr",
            "yrs",
            "period",
            "recurrence",
            "average",
            "t",
            "r",
            "tempo",
            "periodo",
            "di",
            "anni",
        ];
        let words: Vec<&str> = heading.name.split('_').filter(|word| word.parse::<f64>().is_err()).collect();
        let has = |known: &[&str]| words.iter().any(|word| known.contains(word));
        let is_known = |word: &&str| [&RATES[..], &PERIODS, &PROBABILITIES, &BESIDE].concat().contains(word);
        let mut numbers = heading.text.split(|sign: char| !sign.is_ascii_digit() && sign != '.');
        let years: Option<f64> = numbers.find_map(|number| number.parse().ok());
        if !words.iter().all(is_known) {
            None
        } else if has(&PROBABILITIES) {
            let annual = has(&["annual", "aep"]).then_some(1.0);
            years.or(annual).or(investigation_years).map(Frequency::ProbabilityIn)
        } else if years.is_some_and(|years| years != 1.0) {
            None
        } else if has(&["occurrence"]) {
            Some(Frequency::Occurrence)
        } else if has(&PERIODS) || words.starts_with(&["t", "r"]) {
            Some(Frequency::ReturnPeriod)
        } else {
            has(&RATES).then_some(Frequency::Rate)
        }
    }

    /// Converts a number to an annual rate; none if the motion is certain, whose rate is unknown.
    pub fn annual_rate(self, number: f64) -> Result<Option<f64>, &'static str> {
        match self {
            Frequency::Rate | Frequency::Occurrence if (0.0..=MOST_FREQUENT).contains(&number) => {
                Ok(Some(number))
            }
            Frequency::Rate | Frequency::Occurrence => Err("a rate a year from 0 to 1000"),
            Frequency::ReturnPeriod if number > 0.0 => Ok(Some(1.0 / number)),
            Frequency::ReturnPeriod => Err("years above 0"),
            Frequency::ProbabilityIn(years) if (0.0..1.0).contains(&number) => {
                Ok(Some(-(-number).ln_1p() / years))
            }
            Frequency::ProbabilityIn(_) if number == 1.0 => Ok(None),
            Frequency::ProbabilityIn(_) => Err("a probability from 0 to 1, or with a percent sign"),
        }
    }
}

/// Which of several curves of an intensity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    Mean,
    Median,
    Low,
    High,
}

/// What a curve of a file is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Intensity {
    Peak(Peak),
    /// Spectral acceleration at 1 s.
    Spectral,
}

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Content {
    /// With the unit in m/s2 or m/s.
    Intensity(Intensity, f64),
    /// Spectral acceleration at another period.
    OtherSpectral,
    Frequency(Frequency),
    Magnitude,
    Period,
    Unknown,
}

impl Intensity {
    pub fn name(self) -> &'static str {
        match self {
            Intensity::Peak(Peak::Pga) => "PGA",
            Intensity::Peak(Peak::Pgv) => "PGV",
            Intensity::Spectral => "SA(1.0 s)",
        }
    }

    /// By the name that OpenQuake gives it, with its unit in m/s2 or m/s.
    pub fn of_openquake(name: &str) -> Option<(Intensity, f64)> {
        match name {
            "PGA" => Some((Intensity::Peak(Peak::Pga), G_M_S2)),
            "PGV" => Some((Intensity::Peak(Peak::Pgv), 1.0 / CM_PER_M)),
            "SA(1.0)" => Some((Intensity::Spectral, G_M_S2)),
            _ => None,
        }
    }
}

/// What a heading says of its column, and of which curve it is.
pub fn content(heading: &Heading, investigation_years: Option<f64>) -> (Content, Statistic) {
    const STATISTICS: [(Statistic, &[&str]); 3] = [
        (Statistic::Low, &["16", "0.16", "p16", "16th"]),
        (Statistic::High, &["84", "0.84", "p84", "84th"]),
        (Statistic::Median, &["median", "p50", "50th", "0.5"]),
    ];
    let words = || heading.text.split(['_', ' ', '(', ')', '[', ']', '-', '%']);
    let named = STATISTICS.iter().find_map(|(statistic, names)| {
        words().find(|word| names.contains(&word.to_lowercase().as_str())).map(|word| (*statistic, word))
    });
    let (statistic, heading) = match named {
        Some((statistic, word)) => {
            let rest = heading.text.replacen(word, "", 1);
            (statistic, Heading::of(rest.trim_matches(['_', ' '])))
        }
        None => (Statistic::Mean, heading.clone()),
    };
    if let Some((peak, unit)) = peak(&heading) {
        return (Content::Intensity(Intensity::Peak(peak), unit), statistic);
    }
    let content = match Frequency::of(&heading, investigation_years) {
        Some(frequency) => Content::Frequency(frequency),
        None => other_content(&heading),
    };
    (content, statistic)
}

fn other_content(heading: &Heading) -> Content {
    let name = heading.name.as_str();
    let rest = ["spectral_acceleration", "psa", "sa", "s"].iter().find_map(|start| name.strip_prefix(start));
    let acceleration = heading.unit.filter(|unit| unit.quantity == Quantity::Acceleration);
    match (name, rest.map(|rest| rest.trim_matches('_').trim_end_matches(['s', '_'])), acceleration) {
        ("mw" | "magnitude" | "m" | "mag", ..) => Content::Magnitude,
        ("t" | "period" | "periods" | "periodo", ..) => Content::Period,
        (_, Some("1" | "1_0" | "1_00"), Some(unit)) => Content::Intensity(Intensity::Spectral, unit.si),
        (_, Some(_), Some(_)) => Content::OtherSpectral,
        _ => Content::Unknown,
    }
}
