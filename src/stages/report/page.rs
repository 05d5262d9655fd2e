//! The page: one answer, one table, one figure; then further figures; then, folded, how it was made and tested.

use serde::Serialize;
use serde_json::Value;

use super::figures::name;
use super::studies;
use super::tables::{FileMade, ObjectRates, Tables};
use crate::fragility::{Calibration, Cases, Measure, Parameter, ParameterRow};
use crate::keyword::Keyword;
use crate::report::text::number;
use crate::report::{Column, Figure, Page, Section, Table};
use crate::rocking::Outcome;
use crate::stages::ida::CapacityFitRow;
use crate::studies::Validation;
use crate::studies::paper::Comparison;
use crate::units::G_M_S2;

/// Doubts under the table; the others are folded.
const MOST_DOUBTS: usize = 3;
/// Figures that are seen where there are rates, numbers of the paper, or neither; the others are folded.
const SEEN: [&[&str]; 3] = [
    &["list"],
    &["overturning-hybrid", "calibrated", "motion", "similarity", "planes", "exceedance"],
    &["ida", "calibrated", "overturning", "validation", "ranking"],
];

/// Composes the page.
pub fn page(tables: &Tables, figures: Vec<Figure>, key: String) -> anyhow::Result<Page> {
    let subject = match (tables.objects.is_empty(), tables.compared.is_empty()) {
        (false, _) => 0,
        (_, false) => 1,
        _ => 2,
    };
    let (sentence, table) = match subject {
        0 => (sentence_of_rates(tables), rates(tables)),
        1 => (sentence_of_paper(&tables.compared), planes(&tables.compared)),
        _ => (sentence_of_outcomes(tables), outcomes(tables)?),
    };
    let (seen, more): (Vec<Figure>, Vec<Figure>) =
        figures.into_iter().partition(|figure| SEEN[subject].contains(&figure.name.as_str()));
    let mut doubts: Vec<String> = tables
        .files
        .iter()
        .filter_map(|file| file.made.as_ref())
        .flat_map(|made| made.doubts.clone())
        .collect();
    doubts.sort_unstable();
    doubts.dedup();
    let others = doubts.split_off(doubts.len().min(MOST_DOUBTS));
    let mut sections = vec![
        Section { heading: "More figures".to_string(), figures: more, ..Section::default() },
        Section { heading: "Method".to_string(), paragraphs: method(tables), ..Section::default() },
        Section {
            heading: "Tests and fits".to_string(),
            paragraphs: others,
            tables: tests(tables, subject)?,
            ..Section::default()
        },
        Section { heading: "Files".to_string(), tables: vec![files(&tables.files)], ..Section::default() },
    ];
    sections.retain(|section| section.figures.len() + section.paragraphs.len() + section.tables.len() > 0);
    Ok(Page { sentence, table: Some(table), notes: doubts, figures: seen, sections, key, ..Page::default() })
}

/// Columns of texts, then of numbers.
fn table(caption: &str, texts: &[&str], numbers: &[&str], rows: Vec<Vec<String>>) -> Table {
    let texts = texts.iter().map(|head| Column::text(head));
    let columns = texts.chain(numbers.iter().map(|head| Column::number(head))).collect();
    Table { caption: caption.to_string(), columns, rows }
}

/// Some fields of rows, under their names.
fn fields<R: Serialize>(caption: &str, rows: &[R], texts: &[&str], numbers: &[&str]) -> Table {
    let cell = |row: &Value, field: &&str| match &row[*field] {
        Value::Number(count) if count.is_i64() => count.to_string(),
        Value::Number(value) => number::significant(value.as_f64().unwrap_or(f64::NAN), 3),
        Value::String(text) if text.starts_with("im") => text.to_uppercase().replace("IM3_INV", "1/IM3"),
        Value::String(text) => text.replace('_', " "),
        _ => String::new(),
    };
    let row = |row: &R| {
        let row = serde_json::json!(row);
        texts.iter().chain(numbers).map(|field| cell(&row, field)).collect()
    };
    let rows = rows.iter().map(row).collect();
    let head =
        |fields: &[&str]| -> Vec<String> { fields.iter().map(|field| field.replace('_', " ")).collect() };
    let (texts, numbers) = (head(texts), head(numbers));
    let all = |head: &'_ [String]| -> Vec<String> { head.to_vec() };
    let (texts, numbers) = (all(&texts), all(&numbers));
    let [texts, numbers] = [&texts, &numbers].map(|head| head.iter().map(String::as_str).collect::<Vec<_>>());
    table(caption, &texts, &numbers, rows)
}

fn with_limits([value, low, high]: [Option<f64>; 3], unit: f64) -> String {
    match (value, low, high) {
        (Some(value), Some(low), Some(high)) => number::with_limits([value, low, high].map(|x| unit * x), 2),
        (None, Some(low), Some(high)) => {
            let [low, high] = [low, high].map(|x| number::significant(unit * x, 2));
            format!("{low} to {high}")
        }
        (Some(value), ..) => number::significant(unit * value, 2),
        _ => "\u{2013}".to_string(),
    }
}

fn in_years(object: &ObjectRates) -> String {
    with_limits([object.p_overturning, object.p_overturning_low, object.p_overturning_high], 100.0)
}

fn years(tables: &Tables) -> String {
    number::plain(tables.objects.iter().find_map(|object| object.years).unwrap_or(f64::NAN))
}

fn sentence_of_rates(tables: &Tables) -> String {
    let worst = &tables.objects[0];
    let rate = worst.overturning_per_year.or(worst.overturning_per_year_high);
    let often = match rate.filter(|rate| *rate > 0.0) {
        Some(rate) => format!("once in {} years", number::count(round(1.0 / rate))),
        None => "hardly ever".to_string(),
    };
    let limits = if worst.p_overturning_low.is_some() { ", 95 % limits in brackets" } else { "" };
    let all = if tables.objects.len() > 1 {
        format!("Of {} objects, ", tables.objects.len())
    } else {
        String::new()
    };
    let most = if all.is_empty() { "" } else { " most often" };
    let (years, p) = (years(tables), in_years(worst));
    format!("{all}{} overturns{most}: {often}; {p} % in {years} years{limits}.", worst.structure)
}

/// To two digits.
fn round(years: f64) -> usize {
    let unit = 10_f64.powf(years.log10().floor() - 1.0).max(1.0);
    ((years / unit).round() * unit) as usize
}

/// A row an object, the worst first.
fn rates(tables: &Tables) -> Table {
    let row = |object: &ObjectRates| {
        let size = object.width_m.zip(object.height_m);
        let size = size.map_or(String::new(), |(width, height)| format!("{width:.2} \u{d7} {height:.2} m"));
        let number = |value: Option<f64>| with_limits([value, None, None], 1.0);
        let rates = [object.rocking_per_year, object.overturning_per_year].map(number);
        let years = object.overturning_per_year.filter(|rate| *rate > 0.0);
        let years = years.map_or("\u{2013}".to_string(), |rate| number::count(round(1.0 / rate)));
        let [rock, overturn] = rates;
        let doubts = object.doubts.clone().unwrap_or_default();
        vec![
            object.structure.clone(),
            size,
            doubts,
            rock,
            overturn,
            years,
            in_years(object),
            number(object.friction),
        ]
    };
    let percent = format!("% in {} years (95 % limits)", years(tables));
    let numbers = ["rocks a year", "overturns a year", "once in years", &percent, "friction needed"];
    table("", &["object", "size", "doubt"], &numbers, tables.objects.iter().map(row).collect())
}

fn sentence_of_paper(compared: &[Comparison]) -> String {
    let z: Vec<f64> = compared.iter().filter_map(|number| number.z).collect();
    let near = z.iter().filter(|z| z.abs() <= 2.0).count();
    format!(
        "Of {} published numbers that vary between seeds, {near} lie within two standard deviations of ours.",
        z.len()
    )
}

/// Table II: published over ours.
fn planes(compared: &[Comparison]) -> Table {
    let row = |plane: &Comparison| {
        let side = plane.quantity.trim_end_matches("_plane");
        let cell = |coefficient: &str| {
            let quantity = format!("{side}_{coefficient}");
            let is_its = |number: &&Comparison| {
                (&number.quantity, &number.suite, &number.structure)
                    == (&quantity, &plane.suite, &plane.structure)
            };
            let found = compared.iter().find(is_its).map(|found| [found.published, found.ours]);
            let written = found.unwrap_or_default().map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
            written.join(" / ")
        };
        let side = if side == "low" { "below" } else { "above" };
        let texts = [plane.structure.clone(), plane.suite.clone(), side.to_string()];
        let p = with_limits([plane.t2_p, None, None], 1.0);
        texts.into_iter().chain(["ln_a", "b1", "b2", "r2"].map(cell)).chain([p]).collect()
    };
    let is_plane = |number: &&Comparison| number.quantity.ends_with("_plane");
    table(
        "Table II, the planes of the demand below and above the transition: published / ours. *p*: probability of so large a difference between seeds.",
        &["structure", "motions", "plane"],
        &["ln *a*", "*b*_{1}", "*b*_{2}", "*R*^{2}", "*p*"],
        compared.iter().filter(is_plane).map(row).collect(),
    )
}

fn overturned(cases: &Cases) -> usize {
    cases.outcome.iter().filter(|outcome| **outcome == Outcome::Overturning).count()
}

fn sentence_of_outcomes(tables: &Tables) -> String {
    let share = |cases: &&Cases| overturned(cases) as f64 / cases.len() as f64;
    match tables.groups.iter().max_by(|a, b| share(a).total_cmp(&share(b))) {
        None => "There are no responses.".to_string(),
        Some(cases) if overturned(cases) == 0 => "No motion overturns any structure.".to_string(),
        Some(cases) => {
            let [events, all] = [overturned(cases), cases.len()].map(number::count);
            format!("{} overturns most often: in {events} of {all} motions.", name(cases))
        }
    }
}

/// What came of each structure and suite, and the median that overturns it: of its capacities, else of its paper's curve.
fn outcomes(tables: &Tables) -> anyhow::Result<Table> {
    let capacities: Vec<CapacityFitRow> = tables.rows("ida.fragility")?;
    let median = match capacities.first() {
        Some(fit) => format!("half overturn it at {}", studies::words(fit.measure)),
        None => "median PGV (m/s), lognormal curve".to_string(),
    };
    let row = |cases: &Cases| {
        let (suite, structure) = (&cases.suite, &cases.structure.name);
        let rock = cases.outcome.iter().filter(|outcome| **outcome != Outcome::NoRocking).count();
        let is_its = |row: &&Calibration| row.suite == *suite && row.structure == *structure;
        let often = tables.calibrations.iter().find(is_its).map(|row| row.n_events as f64 / row.expected);
        let capacity = capacities.iter().find(|fit| fit.suite == *suite && fit.structure == *structure);
        let [median, dispersion] = match capacity {
            Some(fit) => {
                [[fit.theta, fit.theta_low, fit.theta_high], [fit.beta, fit.beta_low, fit.beta_high]]
                    .map(|value| with_limits(value, 1.0))
            }
            None => curve(tables, cases),
        };
        let counts = [cases.len(), rock, overturned(cases)].map(number::count);
        let often =
            often.map_or("\u{2013}".to_string(), |often| format!("{} times", number::significant(often, 2)));
        let texts = [structure.clone(), suite.clone().unwrap_or_default()];
        texts.into_iter().chain(counts).chain([often, median, dispersion]).collect()
    };
    let numbers = ["number", "rock", "overturn", "as often as the surface predicts", &median, "dispersion"];
    let rows = tables.groups.iter().map(row).collect();
    Ok(table(
        "Motions that rock and overturn each structure, with 95 % limits",
        &["structure", "motions"],
        &numbers,
        rows,
    ))
}

/// Median, as a PGV, and dispersion of the paper's curve of p PGV / (g tan alpha).
fn curve(tables: &Tables, cases: &Cases) -> [String; 2] {
    let mut fits = tables.curves.iter().filter(|fit| fit.im_x == Measure::Im5 && fit.im_y.is_none());
    let fit = fits.find(|fit| fit.suite == cases.suite && fit.structure == cases.structure.name);
    let rows = fit.map_or(Vec::new(), |fit| fit.parameters(0.95));
    let unit = G_M_S2 * cases.structure.alpha_rad.tan() / cases.structure.p_rad_s;
    [(Parameter::Theta, unit), (Parameter::Beta, 1.0)].map(|(parameter, unit)| {
        let row = rows.iter().find(|row: &&ParameterRow| row.parameter == parameter);
        with_limits(row.map_or([None; 3], |row| [row.value, row.low, row.high].map(Some)), unit)
    })
}

/// How it was made: a paragraph for each kind of table.
fn method(tables: &Tables) -> Vec<String> {
    let made = |stage: &str| {
        tables.files.iter().any(|file| file.made.as_ref().is_some_and(|made| made.stage == stage))
    };
    let paragraphs = [
        (
            made("synthesize-motions"),
            "Ground motions are a velocity pulse (Mavroeidis & Papageorgiou 2003), high frequencies of a stochastic source, or both.",
        ),
        (made("import-motions"), "Ground motions are records, one component each."),
        (
            !tables.groups.is_empty(),
            "The rocking of each structure, a rigid block or frame that does not slide, follows from the equation of motion with a loss of velocity at each impact (Eqs. 4 to 6). The demand is the largest rotation over the slenderness *α* (Eq. 7); *p* is the frequency parameter.",
        ),
        (
            !tables.demand.is_empty(),
            "The demand in safe rocking is regressed on one measure or two, with two planes that meet at 1.3 times the peak acceleration of uplift (Eqs. 14 to 18).",
        ),
        (
            !tables.curves.is_empty(),
            "The probability of overturning given rocking is a lognormal curve of one measure or of a hybrid of two, of greatest likelihood (Eqs. 19 to 24).",
        ),
        (
            !tables.calibrations.is_empty() || !tables.objects.is_empty(),
            "The universal surface predicts the overturning of any block from peak acceleration and velocity; level and slope of its logit are calibrated with the responses where there are any.",
        ),
        (
            !tables.objects.is_empty(),
            "Annual rates are the integral of these probabilities over the hazard of the site. The limits do not have the error of the hazard.",
        ),
        (
            made("ida"),
            "Incremental dynamic analysis scales each motion until it overturns the structure; a lognormal distribution of these intensities has the median.",
        ),
        (
            made("validate"),
            "Validation compares predicted probabilities with the outcomes of motions that were not fitted.",
        ),
        (
            !tables.demand.is_empty(),
            "The paper is Dimitrakopoulos & Paraskeva (2015), Dimensionless fragility curves for rocking response to near-fault excitations, Earthquake Engineering & Structural Dynamics 44, 2015\u{2013}2033.",
        ),
    ];
    paragraphs.into_iter().filter(|(is_there, _)| *is_there).map(|(_, words)| words.to_string()).collect()
}

/// The tables that are folded.
fn tests(tables: &Tables, subject: usize) -> anyhow::Result<Vec<Table>> {
    let is_of_plane =
        |number: &Comparison| number.quantity.starts_with("low_") || number.quantity.starts_with("high_");
    let published: Vec<&Comparison> = tables.compared.iter().filter(|number| !is_of_plane(number)).collect();
    let group = ["structure", "suite"];
    let mut all = vec![
        fields(
            "Further numbers of the paper beside ours; *z* is (published \u{2212} mean) / sd over seeds",
            &published,
            &["quantity", "structure", "suite"],
            &["published", "ours", "mean", "sd", "z"],
        ),
        fields(
            "Lognormal curves of overturning",
            &tables.curves,
            &[&group[..], &["im_x", "im_y", "status"]].concat(),
            &["auc", "brier", "n", "n_events"],
        ),
        fields(
            "Regressions of the demand",
            &tables.demand,
            &[&group[..], &["model", "im_x", "im_y", "status"]].concat(),
            &["r2", "beta", "n"],
        ),
        fields(
            "Validation: events observed and expected",
            &tables.rows::<Validation>("validation")?,
            &[&group[..], &["event", "model"]].concat(),
            &["n", "observed", "expected", "expected_error", "log_score", "calibration_slope"],
        ),
    ];
    if subject < 2 {
        all.insert(0, outcomes(tables)?);
    }
    all.retain(|table| !table.rows.is_empty());
    Ok(all)
}

fn files(files: &[FileMade]) -> Table {
    let row = |file: &FileMade| {
        let name = file.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let option = |(name, values): (&String, &Vec<String>)| format!("{name} {}", values.join(" "));
        let options = |made: &crate::table::provenance::Provenance| {
            made.arguments.iter().map(option).collect::<Vec<_>>().join("; ")
        };
        let by = file
            .made
            .as_ref()
            .map_or("another program".to_string(), |made| format!("{} {}", made.stage, made.version));
        vec![name, by, file.made.as_ref().map(options).unwrap_or_default(), number::count(file.rows as usize)]
    };
    table("", &["file", "made by", "with"], &["rows"], files.iter().map(row).collect())
}
