//! The page: one answer, one table, one figure; then further figures; then, folded, how it was made and tested.

use super::figures::{calibration, name};
use super::studies;
use super::tables::{FileMade, Tables};
use crate::fragility::Measure;
use crate::fragility::{Calibration, Cases, Event, Parameter, ParameterRow, Scenarios, logit_overturning};
use crate::keyword::Keyword;
use crate::report::text::number;
use crate::report::{Column, Figure, Page, Section, Table};
use crate::rocking::Outcome;
use crate::studies::paper::Comparison;
use crate::units::G_M_S2;

/// Doubts under the table; the others are folded.
const MOST_DOUBTS: usize = 3;
/// Figures that are seen, by the beginning of their names, in their order; the others are folded.
const SEEN_OF_PAPER: [&str; 6] =
    ["overturning-hybrid", "calibrated", "motion", "similarity", "planes", "exceedance"];
const SEEN_OF_STUDY: [&str; 6] = ["ida", "calibrated", "overturning", "rates", "validation", "ranking"];
const DIGITS: usize = 3;

/// Composes the page.
pub fn page(tables: &Tables, figures: Vec<Figure>, title: String, byline: String, key: String) -> Page {
    let of_paper = !tables.compared.is_empty();
    let seen = if of_paper { &SEEN_OF_PAPER } else { &SEEN_OF_STUDY };
    let rank = |figure: &Figure| seen.iter().position(|name| figure.name == *name);
    let (mut first, others): (Vec<Figure>, Vec<Figure>) =
        figures.into_iter().partition(|figure| rank(figure).is_some());
    first.sort_by_key(rank);
    let (sentence, table) = match of_paper {
        true => (sentence_of_paper(&tables.compared), planes_of_paper(&tables.compared)),
        false => (sentence_of_study(tables), outcomes(tables)),
    };
    let mut doubts: Vec<String> = tables.files.iter().flat_map(FileMade::doubts).collect();
    doubts.sort_unstable();
    doubts.dedup();
    let later = doubts.split_off(doubts.len().min(MOST_DOUBTS));
    let mut sections = vec![
        Section { heading: "More figures".to_string(), figures: others, ..Section::default() },
        Section { heading: "Method".to_string(), paragraphs: method(tables), ..Section::default() },
        Section {
            heading: "Tests and fits".to_string(),
            paragraphs: later,
            tables: tests(tables),
            ..Section::default()
        },
        Section { heading: "Files".to_string(), tables: vec![files(&tables.files)], ..Section::default() },
    ];
    sections.retain(|section| {
        !(section.figures.is_empty() && section.paragraphs.is_empty() && section.tables.is_empty())
    });
    Page { title, byline, sentence, table: Some(table), notes: doubts, figures: first, sections, key }
}

fn table(caption: &str, columns: Vec<Column>, rows: Vec<Vec<String>>) -> Table {
    Table { caption: caption.to_string(), columns, rows }
}

/// Columns of text, then of numbers.
fn columns(texts: &[&str], numbers: &[&str]) -> Vec<Column> {
    let texts = texts.iter().map(|head| Column::text(head));
    texts.chain(numbers.iter().map(|head| Column::number(head))).collect()
}

fn short(value: Option<f64>) -> String {
    number::significant(value.unwrap_or(f64::NAN), DIGITS)
}

fn limits(value: Option<f64>, low: Option<f64>, high: Option<f64>, factor: f64) -> String {
    match (value, low, high) {
        (Some(value), Some(low), Some(high)) => {
            number::with_limits([value, low, high].map(|x| factor * x), 2)
        }
        _ => short(value.map(|value| factor * value)),
    }
}

fn sentence_of_paper(compared: &[Comparison]) -> String {
    let tested = compared.iter().filter_map(|number| number.z);
    let near = tested.clone().filter(|z| z.abs() <= 2.0).count();
    format!(
        "Of {} numbers that the paper publishes and that vary between seeds, {near} lie within two standard deviations of ours.",
        tested.count()
    )
}

/// Table II: published over ours.
fn planes_of_paper(compared: &[Comparison]) -> Table {
    let is_plane = |number: &&Comparison| number.quantity.ends_with("_plane");
    let row = |plane: &Comparison| {
        let side = plane.quantity.trim_end_matches("_plane");
        let cell = |coefficient: &str| {
            let of = format!("{side}_{coefficient}");
            let is_its = |number: &&Comparison| {
                (&number.quantity, &number.suite, &number.structure) == (&of, &plane.suite, &plane.structure)
            };
            let found = compared.iter().find(is_its);
            found.map_or(String::new(), |found| {
                let [published, ours] =
                    [found.published, found.ours].map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
                format!("{published} / {ours}")
            })
        };
        let side = if side == "low" { "below" } else { "above" };
        let texts = [plane.structure.clone(), plane.suite.clone(), side.to_string()];
        let numbers = ["ln_a", "b1", "b2", "r2"].map(cell);
        texts.into_iter().chain(numbers).chain([short(plane.t2_p)]).collect()
    };
    table(
        "Table II: the two planes of the demand, published / ours; *p* is the probability of so large a difference between seeds",
        columns(&["structure", "motions", "transition"], &["ln *a*", "*b*_{1}", "*b*_{2}", "*R*^{2}", "*p*"]),
        compared.iter().filter(is_plane).map(row).collect(),
    )
}

fn count(cases: &Cases, is: impl Fn(Outcome) -> bool) -> usize {
    cases.outcome.iter().filter(|outcome| is(**outcome)).count()
}

fn sentence_of_study(tables: &Tables) -> String {
    let share =
        |cases: &Cases| count(cases, |outcome| outcome == Outcome::Overturning) as f64 / cases.len() as f64;
    let most = tables.groups.iter().max_by(|a, b| share(a).total_cmp(&share(b)));
    match most {
        Some(cases) if share(cases) > 0.0 => format!(
            "{} overturns most often: in {} of {} motions.",
            name(cases),
            number::count(count(cases, |outcome| outcome == Outcome::Overturning)),
            number::count(cases.len())
        ),
        Some(_) => "No motion overturns any structure.".to_string(),
        None => "No responses.".to_string(),
    }
}

/// What came of each structure and suite.
fn outcomes(tables: &Tables) -> Table {
    let has_surface = !tables.calibrations.is_empty();
    let has_capacities = !tables.capacity_fits.is_empty();
    let row = |cases: &Cases| {
        let rock = count(cases, |outcome| outcome != Outcome::NoRocking);
        let overturn = count(cases, |outcome| outcome == Outcome::Overturning);
        let numbers = [cases.len(), rock, overturn].map(number::count);
        let often = has_surface.then(|| {
            match calibration(tables, cases).and_then(|row| times_as_often(row, cases)) {
                Some(times) => format!("{} times", number::significant(times, 2)),
                None => "\u{2013}".to_string(),
            }
        });
        let median = match has_capacities {
            true => capacity(tables, cases),
            false => curve(tables, cases),
        };
        [cases.structure.name.clone(), cases.suite.clone().unwrap_or_default()]
            .into_iter()
            .chain(numbers)
            .chain(often)
            .chain(median)
            .collect()
    };
    let scaled = tables
        .capacity_fits
        .first()
        .map(|fit| format!("half of them overturn it at {}", studies::words(fit.measure)));
    let median = scaled.unwrap_or("lognormal curve (paper): median PGV (m/s)".to_string());
    let mut numbers = vec!["number", "rock", "overturn"];
    numbers.extend(has_surface.then_some("as often as the surface predicts"));
    numbers.extend([median.as_str(), "dispersion"]);
    let mut columns = columns(&["structure", "motions"], &numbers);
    columns.extend((!has_capacities).then(|| Column::text("fit")));
    table(
        "Motions that rock and overturn each structure; limits are 95 %",
        columns,
        tables.groups.iter().map(row).collect(),
    )
}

/// How often it overturns by its calibration, over how often by the surface, in the same motions.
fn times_as_often(calibration: &Calibration, cases: &Cases) -> Option<f64> {
    let of_surface = Calibration { c: 0.0, ln_s: 0.0, ..calibration.clone() };
    let rocked = (0..cases.len()).filter(|&k| cases.happened(k, Event::Overturning, f64::INFINITY).is_some());
    let logits =
        rocked.filter_map(|k| logit_overturning(calibration.kind, &cases.structure, &cases.measures(k)));
    let (own, surface) = logits.fold((0.0, 0.0), |(own, surface), logit| {
        let p = |row: &Calibration| row.probability(logit, Scenarios::Many).value;
        (own + p(calibration), surface + p(&of_surface))
    });
    (surface > 0.0).then_some(own / surface)
}

/// Median and dispersion of the lowest overturning intensities.
fn capacity(tables: &Tables, cases: &Cases) -> Vec<String> {
    let mut fits = tables.capacity_fits.iter();
    let fit = fits.find(|fit| fit.suite == cases.suite && fit.structure == cases.structure.name);
    fit.map_or(vec![String::new(); 2], |fit| {
        vec![
            limits(fit.theta, fit.theta_low, fit.theta_high, 1.0),
            limits(fit.beta, fit.beta_low, fit.beta_high, 1.0),
        ]
    })
}

/// Median, as a PGV, dispersion and status of the paper's curve of p PGV / (g tan alpha).
fn curve(tables: &Tables, cases: &Cases) -> Vec<String> {
    let mut fits = tables.curves.iter().filter(|fit| fit.im_x == Measure::Im5 && fit.im_y.is_none());
    let Some(fit) = fits.find(|fit| fit.suite == cases.suite && fit.structure == cases.structure.name) else {
        return vec![String::new(); 3];
    };
    let rows = fit.parameters(0.95);
    let unit = G_M_S2 * cases.structure.alpha_rad.tan() / cases.structure.p_rad_s;
    vec![
        parameter(&rows, Parameter::Theta, unit),
        parameter(&rows, Parameter::Beta, 1.0),
        words(fit.status.as_str()),
    ]
}

fn words(status: &str) -> String {
    status.replace('_', " ")
}

fn parameter(rows: &[ParameterRow], which: Parameter, unit: f64) -> String {
    let row = rows.iter().find(|row| row.parameter == which);
    row.map_or("\u{2013}".to_string(), |row| limits(Some(row.value), Some(row.low), Some(row.high), unit))
}

/// How it was made: a paragraph for each kind of table.
fn method(tables: &Tables) -> Vec<String> {
    let has_made = |stage: &str| {
        tables.files.iter().any(|file| file.made.as_ref().is_some_and(|made| made.stage == stage))
    };
    let paragraphs = [
        (
            has_made("synthesize-motions"),
            "Ground motions are a velocity pulse (Mavroeidis & Papageorgiou 2003), high frequencies of a stochastic source model, or both, over magnitudes and distances.",
        ),
        (has_made("import-motions"), "Ground motions are records, one component each."),
        (
            !tables.groups.is_empty(),
            "Rocking of each structure, a rigid block or frame that does not slide, follows from the equation of motion with a loss of velocity at each impact (Eqs. 4 to 6). Demand is the largest rotation over the slenderness *α* (Eq. 7); *p* is the frequency parameter.",
        ),
        (
            !tables.demand.is_empty(),
            "The demand in safe rocking is regressed on one measure of intensity or two, with two planes that meet at a peak acceleration of 1.3 times that of uplift (Eqs. 14 to 18).",
        ),
        (
            !tables.curves.is_empty(),
            "The probability of overturning given rocking is a lognormal curve of one measure or of a hybrid of two, by maximum likelihood (Eqs. 19 to 24).",
        ),
        (
            !tables.calibrations.is_empty(),
            "The universal surface predicts overturning of any block from peak acceleration and velocity. Two numbers calibrate it with the responses here: its level and its slope in the logit.",
        ),
        (
            !tables.capacity_fits.is_empty(),
            "Incremental dynamic analysis scales each motion until it overturns the structure; medians are those of a lognormal distribution of these intensities.",
        ),
        (
            !tables.validations.is_empty(),
            "Validation compares predicted probabilities with what came of motions that were not fitted.",
        ),
        (
            !tables.compared.is_empty() || !tables.curves.is_empty(),
            "The paper is Dimitrakopoulos & Paraskeva (2015), Dimensionless fragility curves for rocking response to near-fault excitations, Earthquake Engineering & Structural Dynamics 44, 2015\u{2013}2033.",
        ),
    ];
    paragraphs.into_iter().filter(|(is_there, _)| *is_there).map(|(_, words)| words.to_string()).collect()
}

/// The tables that are folded.
fn tests(tables: &Tables) -> Vec<Table> {
    let mut all = Vec::new();
    if !tables.compared.is_empty() {
        all.push(outcomes(tables));
        all.push(published(&tables.compared));
    }
    all.extend([curves(tables), regressions(tables), validations(tables)]);
    all.retain(|table| !table.rows.is_empty());
    all
}

/// Each published number but those of the planes.
fn published(compared: &[Comparison]) -> Table {
    let is_of_plane =
        |number: &&Comparison| number.quantity.starts_with("low_") || number.quantity.starts_with("high_");
    let row = |number: &Comparison| {
        let texts = [words(&number.quantity), number.structure.clone(), number.suite.clone()];
        let numbers = [number.published, number.ours, number.mean, number.sd, number.z].map(short);
        texts.into_iter().chain(numbers).collect()
    };
    table(
        "Further numbers of the paper beside ours; *z* is (published \u{2212} mean) / deviation over seeds",
        columns(&["number", "structure", "motions"], &["published", "ours", "mean", "deviation", "*z*"]),
        compared.iter().filter(|number| !is_of_plane(number)).map(row).collect(),
    )
}

fn measures(im_x: Measure, im_y: Option<Measure>) -> String {
    let name = |measure: Measure| match measure {
        Measure::Im3Inverse => "1/IM3".to_string(),
        other => other.as_str().to_uppercase(),
    };
    im_y.map_or(name(im_x), |im_y| format!("{}, {}", name(im_x), name(im_y)))
}

fn curves(tables: &Tables) -> Table {
    let rows = tables.curves.iter().map(|fit| {
        let rows = fit.parameters(0.95);
        let texts = [
            fit.structure.clone(),
            fit.suite.clone().unwrap_or_default(),
            measures(fit.im_x, fit.im_y),
            words(fit.status.as_str()),
        ];
        let numbers = [Parameter::Theta, Parameter::Beta].map(|which| parameter(&rows, which, 1.0));
        texts.into_iter().chain(numbers).chain([short(fit.auc), fit.n_events.to_string()]).collect()
    });
    table(
        "Lognormal curves of overturning",
        columns(&["structure", "motions", "over", "fit"], &["median", "dispersion", "AUC", "events"]),
        rows.collect(),
    )
}

fn regressions(tables: &Tables) -> Table {
    let rows = tables.demand.iter().map(|fit| {
        let model = match (fit.range_low, fit.range_high) {
            (None, None) => fit.model.to_string(),
            (None, _) => "plane below".to_string(),
            _ => "plane above".to_string(),
        };
        let texts = [
            fit.structure.clone(),
            fit.suite.clone().unwrap_or_default(),
            model,
            measures(fit.im_x, fit.im_y),
            words(fit.status.as_str()),
        ];
        texts.into_iter().chain([fit.r2, fit.beta].map(short)).chain([fit.n.to_string()]).collect()
    });
    table(
        "Regressions of the demand in safe rocking",
        columns(&["structure", "motions", "model", "over", "fit"], &["*R*^{2}", "*β*", "cases"]),
        rows.collect(),
    )
}

fn validations(tables: &Tables) -> Table {
    let rows = tables.validations.iter().map(|test| {
        let texts = [
            test.structure.clone(),
            test.suite.clone().unwrap_or_default(),
            test.event.to_string(),
            test.model.clone(),
        ];
        let counts = [test.n.to_string(), test.observed.to_string()];
        let numbers =
            [Some(test.expected), Some(test.expected_error), test.log_score, test.calibration_slope]
                .map(short);
        texts.into_iter().chain(counts).chain(numbers).collect()
    });
    table(
        "Validation: counts observed and expected",
        columns(
            &["structure", "motions", "event", "model"],
            &["cases", "observed", "expected", "its error", "log score", "slope"],
        ),
        rows.collect(),
    )
}

impl FileMade {
    fn doubts(&self) -> Vec<String> {
        self.made.as_ref().map_or(Vec::new(), |made| made.doubts.clone())
    }
}

fn files(files: &[FileMade]) -> Table {
    let row = |file: &FileMade| {
        let (by, options) = match &file.made {
            Some(made) => {
                let option = |(name, values): (&String, &Vec<String>)| format!("{name} {}", values.join(" "));
                let options: Vec<String> = made.arguments.iter().map(option).collect();
                (format!("{} {}", made.stage, made.version), options.join("; "))
            }
            None => ("another program".to_string(), String::new()),
        };
        vec![file.name.clone(), by, options, number::count(file.rows as usize)]
    };
    table("", columns(&["file", "made by", "with"], &["rows"]), files.iter().map(row).collect())
}
