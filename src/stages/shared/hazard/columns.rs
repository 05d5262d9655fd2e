//! What the headings of a hazard say: peaks and spectral accelerations by their units, rates, probabilities and
//! return periods, means and fractiles.

use anyhow::bail;

use crate::fragility::Peak;
use crate::sheet::{Heading, Sheet};
use crate::units::Quantity;

/// Parses a column and another heading for it: `pga_g=PGA`.
pub fn renamed(text: &str) -> Result<(String, String), String> {
    let (column, heading) = text.split_once('=').ok_or("expected COLUMN=HEADING, such as pga_g=PGA")?;
    Ok((column.trim().to_string(), heading.trim().to_string()))
}

/// Renames columns as the user requests.
pub fn rename(sheet: &mut Sheet, renamed: &[(String, String)]) -> anyhow::Result<()> {
    for (column, heading) in renamed {
        let Some(found) = sheet.headings.iter_mut().find(|found| found.text == *heading) else {
            bail!("no heading '{heading}'; found {}", headings(sheet));
        };
        // A percent sign that is not part of a unit is of the numbers, whatever they are called.
        let sign = if found.unit.is_none() && heading.contains('%') { " (%)" } else { "" };
        let wanted = Heading::of(&format!("{column}{sign}"));
        if let (Some(old), Some(new)) = (found.unit, wanted.unit)
            && old.quantity != new.quantity
        {
            bail!("--columns {column}={heading}: the heading has a unit of another quantity");
        }
        *found = wanted;
    }
    Ok(())
}

/// The headings of a sheet, for messages.
pub fn headings(sheet: &Sheet) -> String {
    let texts: Vec<&str> = sheet.headings.iter().map(|heading| heading.text.as_str()).collect();
    if texts.is_empty() { "no headings".to_string() } else { format!("headings {}", texts.join(", ")) }
}

/// Whether one of the words of a list is among these.
fn has(words: &[&str], list: &str) -> bool {
    list.split(' ').any(|known| words.contains(&known))
}

/// The peak that a heading names, and its unit in m/s2 or m/s; none where it names none, or no unit, or has a
/// word more, which may change the meaning: `vertical PGA`.
pub fn peak(heading: &Heading) -> Option<(Peak, f64)> {
    const BESIDE: &str = "peak ground g motion horizontal mean rotd50 geomean h at site";
    let unit = heading.unit?;
    let (peak, names) = match unit.quantity {
        Quantity::Acceleration => (Peak::Pga, "pga ag a acceleration motion"),
        Quantity::Velocity => (Peak::Pgv, "pgv velocity"),
        _ => return None,
    };
    let words: Vec<&str> = heading.name.split('_').collect();
    let are_known = words.iter().all(|word| has(&[word], names) || has(&[word], BESIDE));
    (are_known && has(&words, names)).then_some((peak, unit.si))
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
        const RATES: &str = "rate frequency frequenza afe afoe mafe";
        const PERIODS: &str = "return ritorno tr rp arp";
        const PROBABILITIES: &str = "probability poe aep";
        const BESIDE: &str = "annual annua media mean of occurrence exceedance exceedence eccedenza per a in year \
                              years yr yrs period recurrence average t r tempo periodo di anni";
        let words: Vec<&str> = heading.name.split('_').filter(|word| word.parse::<f64>().is_err()).collect();
        let is_known =
            |word: &&str| [RATES, PERIODS, PROBABILITIES, BESIDE].iter().any(|list| has(&[word], list));
        let mut numbers = heading.text.split(|sign: char| !sign.is_ascii_digit() && sign != '.');
        let years: Option<f64> = numbers.find_map(|number| number.parse().ok());
        if !words.iter().all(is_known) {
            None
        } else if has(&words, PROBABILITIES) {
            let annual = has(&words, "annual aep").then_some(1.0);
            years.or(annual).or(investigation_years).map(Frequency::ProbabilityIn)
        } else if years.is_some_and(|years| years != 1.0) {
            None
        } else if has(&words, "occurrence") {
            Some(Frequency::Occurrence)
        } else if has(&words, PERIODS) || words.starts_with(&["t", "r"]) {
            Some(Frequency::ReturnPeriod)
        } else {
            has(&words, RATES).then_some(Frequency::Rate)
        }
    }

    /// Reads the annual rate in a cell; none if the motion is certain, whose rate is unknown.
    pub fn annual_rate(self, sheet: &Sheet, row: usize, column: usize) -> anyhow::Result<Option<f64>> {
        let [of_all, of_cell] =
            [&sheet.headings[column].text, sheet.cell(row, column)].map(|text| text.contains('%'));
        // Of a cell with its own sign, the number is a share already.
        let number = sheet.number(row, column)? * if of_all && !of_cell { 0.01 } else { 1.0 };
        let expected = match self {
            Frequency::Rate | Frequency::Occurrence if of_all || of_cell => {
                "a rate a year, such as 0.002; percent are probabilities"
            }
            Frequency::Rate | Frequency::Occurrence if (0.0..=MOST_FREQUENT).contains(&number) => {
                return Ok(Some(number));
            }
            Frequency::Rate | Frequency::Occurrence => "a rate a year from 0 to 1000",
            Frequency::ReturnPeriod if number > 0.0 => return Ok(Some(1.0 / number)),
            Frequency::ReturnPeriod => "years above 0",
            Frequency::ProbabilityIn(years) if (0.0..1.0).contains(&number) => {
                return Ok(Some(-(-number).ln_1p() / years));
            }
            Frequency::ProbabilityIn(_) if number == 1.0 => return Ok(None),
            Frequency::ProbabilityIn(_) => "a probability from 0 to 1, or with a percent sign",
        };
        Err(sheet.refusal(row, column, expected).into())
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
    let name = heading.name.as_str();
    let rest = ["spectral_acceleration", "psa", "sa", "s"].iter().find_map(|start| name.strip_prefix(start));
    let rest = rest.map(|rest| rest.trim_matches('_').trim_end_matches(['s', '_']));
    let acceleration = heading.unit.filter(|unit| unit.quantity == Quantity::Acceleration);
    let content = match (peak(&heading), Frequency::of(&heading, investigation_years), name) {
        (Some((peak, unit)), ..) => Content::Intensity(Intensity::Peak(peak), unit),
        (None, Some(frequency), _) => Content::Frequency(frequency),
        (.., "mw" | "magnitude" | "m" | "mag") => Content::Magnitude,
        (.., "t" | "period" | "periods" | "periodo") => Content::Period,
        _ => match rest.zip(acceleration) {
            Some(("1" | "1_0" | "1_00", unit)) => Content::Intensity(Intensity::Spectral, unit.si),
            Some(_) => Content::OtherSpectral,
            None => Content::Unknown,
        },
    };
    (content, statistic)
}
