//! The page: one sentence, one table, one figure; then further figures; folded, method, tests and files.

use serde::Serialize;
use serde_json::{Value, json};

use super::figures::common::{by, label_of_scaled};
use super::tables::{Tables, name};
use crate::fragility::{Cases, DemandModel, Measure, Parameter, ParameterRow};
use crate::keyword::Keyword;
use crate::number::{self, Limited, OF_HUNDRED, RATE, TWO_DIGITS};
use crate::pipeline::options::listed;
use crate::report::text::minus;
use crate::report::{Column, Figure, Page, Section, Table};
use crate::rocking::{Outcome, Structure};
use crate::stages::compare_paper::{both, coefficient};
use crate::stages::evaluate::{Answer, RatesRow, expected_number, model_of_all, size};
use crate::stages::ida::CapacityFitRow;
use crate::studies::Validation;
use crate::studies::paper::Comparison;
use crate::units::G_M_S2;
use crate::warning::{UNNAMED, Warnings};

/// Warnings under the table; the others are folded. Structures in the first sentence; the table has all.
const MOST_WARNINGS: usize = 3;
const MOST_NAMED: usize = 4;
/// Figures that are seen on the page of a list, of the paper and of other responses. Further ones are folded;
/// of a list there are only these.
const OF_RATES: &[&str] = &["list", "rates", "map", "ida", "validation"];
const OF_PAPER: &[&str] = &["overturning-hybrid", "map", "motion", "similarity", "planes", "exceedance"];
const OF_RESPONSES: &[&str] = &["ida", "map", "overturning", "validation"];

/// What is said of each stage that made a table.
const METHOD: &str = "\
synthesize-motions: Ground motions are a velocity pulse (Mavroeidis & Papageorgiou 2003), high \
frequencies of a stochastic source, or both.
import-motions: Ground motions are records, one component each.
simulate: The rocking of each structure, a rigid block or frame that does not slide, follows from the \
equation of motion with a loss of velocity at each impact (Eqs. 4 to 6). The demand is the largest \
rotation over the slenderness *α* (Eq. 7); *p* is the frequency parameter.
fit-pex: The demand in safe rocking is regressed on one measure or two, with one plane for weak motions \
and one for strong ones (Eqs. 14 to 18 of Dimitrakopoulos & Paraskeva 2015, Earthquake Engineering & \
Structural Dynamics 44, 2015\u{2013}2033).
fit-pro: The probability of overturning given rocking is the paper's lognormal curve of one measure or of \
a hybrid of two (Eqs. 19 to 24), or the universal surface, which predicts it for any block from peak \
acceleration and velocity; the responses calibrate level and slope of its logit.
ida: Incremental dynamic analysis scales each motion until it overturns the structure; a lognormal \
distribution of these intensities has the median.
validate: Validation compares predicted probabilities with the outcomes of motions that were not fitted.
evaluate: Annual rates are the integral over the hazard of the site of the probabilities of the universal \
surface, calibrated where there are responses.";

pub fn page(tables: &Tables, figures: Vec<Figure>, key: String) -> anyhow::Result<Page> {
    let answer_of = |stage: &str| tables.answer_of(stage).unwrap_or_default().to_string();
    let (sentence, first, shown) = match (&tables.objects[..], &tables.compared[..]) {
        ([], []) => (overturned(&tables.groups), outcomes(tables)?, OF_RESPONSES),
        ([], compared) => (answer_of("compare-paper"), planes(compared), OF_PAPER),
        (objects, _) => (answer_of("evaluate"), rates(objects), OF_RATES),
    };
    let (seen, more): (_, Vec<Figure>) =
        figures.into_iter().partition(|figure| shown.contains(&figure.name.as_str()));
    let more = if tables.objects.is_empty() { more } else { Vec::new() };
    let mut joined = Warnings::default();
    tables.made().for_each(|made| joined.join(&made.warnings));
    let (mut notes, mut others) = (tables.left_out.clone(), joined.lines());
    match &tables.objects[..] {
        [] => notes.extend(others.drain(..others.len().min(MOST_WARNINGS))),
        objects => notes.extend(warnings_of(objects)),
    }
    let method = METHOD.lines().filter_map(|line| line.split_once(": "));
    let is_shown =
        |stage: &str| tables.made_by(stage).is_some() && (stage != "fit-pex" || tables.objects.is_empty());
    let method = method.filter(|(stage, _)| is_shown(stage)).map(|(_, words)| words.to_string());
    let section = |heading: &str| Section { heading: heading.to_string(), ..Section::default() };
    let mut sections = vec![
        Section { figures: more, ..section("More figures") },
        Section { paragraphs: method.collect(), ..section("Method") },
        Section { paragraphs: others, tables: tests(tables)?, ..section("Tests and fits") },
        Section { tables: vec![files(tables)], ..section("Files") },
    ];
    sections.retain(|section| section.figures.len() + section.paragraphs.len() + section.tables.len() > 0);
    Ok(Page {
        sentence,
        facts: facts(tables),
        table: Some(first),
        notes,
        figures: seen,
        sections,
        key,
        ..Page::default()
    })
}

/// What was asked, of which objects, by which motions and hazard, and what the limits leave out.
fn facts(tables: &Tables) -> Vec<String> {
    let mut facts = Vec::new();
    if let Some(Answer { row: rates, doubts, .. }) = tables.objects.first() {
        let made = tables.made_by("evaluate");
        let hazard = made.and_then(|made| made.files.get("hazard")).map_or("a hazard", |name| name);
        let years = number::plain(rates.years.unwrap_or(f64::NAN));
        let objects = number::counted(tables.objects.len(), "object");
        facts.push(format!(
            "Asked: the annual rate of overturning of {objects}, and its probability in {years} years, over \
             {hazard}."
        ));
        facts.push(format!("By {}.", model_of_all(&tables.objects)));
        facts.extend(expected_number(&tables.objects));
        let without = if doubts.error_hazard.is_none() { ", without those of the hazard" } else { "" };
        let parts = doubts.words().join(", ");
        facts.push(format!("The 95 % limits contain the errors of {parts}{without}."));
        facts.extend(doubts.error_largest.map(|part| format!("Largest uncertainty: {}.", part.words())));
        return facts;
    }
    let motions = ["synthesize-motions", "import-motions"].map(|stage| tables.answer_of(stage));
    facts.extend(motions.into_iter().flatten().map(|answer| format!("Motions: {answer}.")));
    let words = |Structure { name, p_rad_s, alpha_rad, eta }: &Structure| {
        let [p, alpha, eta] = [p_rad_s, alpha_rad, eta].map(|value| number::significant(*value, 3));
        format!("{name} (*p* {p} rad/s, *α* {alpha}, *η* {eta})")
    };
    let structures = by(&tables.groups, |cases| words(&cases.structure));
    let structures: Vec<String> = structures.iter().map(|same| words(&same[0].structure)).collect();
    if !structures.is_empty() {
        facts.push(format!("Structures: {}.", listed(&structures, MOST_NAMED)));
    }
    facts
}

/// Some fields of rows, under their names; those that no row has are left out.
fn table<R: Serialize>(caption: &str, rows: impl IntoIterator<Item = R>, fields: &str) -> Table {
    let rows: Vec<Value> = rows.into_iter().map(|row| json!(row)).collect();
    let has_any = |field: &&str| rows.iter().any(|row| !row[*field].is_null());
    let fields: Vec<&str> = fields.split('|').filter(has_any).collect();
    let plain = |text: &str| if text.contains('{') { text.to_string() } else { text.replace('_', " ") };
    let is_number = |value: &Value| match value {
        Value::String(text) => text.starts_with(|sign: char| "0123456789-\u{2212}".contains(sign)),
        other => other.is_number(),
    };
    let is_name = |field: &str| ["structure", "object", "file"].contains(&field);
    let is_measure = |text: &str| Measure::SCALAR.iter().any(|measure| measure.as_str() == text);
    let cell = |field: &str, value: &Value| match value {
        Value::Number(count) if count.is_u64() => number::count(count.as_u64().unwrap_or(0) as usize),
        Value::Number(value) => minus(number::significant(value.as_f64().unwrap_or(f64::NAN), 3)),
        Value::String(text) if is_name(field) => text.clone(),
        Value::String(text) if text == "im3_inv" => "1/IM3".to_string(),
        Value::String(text) if is_measure(text) => text.to_uppercase(),
        Value::String(text) => plain(text),
        _ => String::new(),
    };
    let column = |field: &&str| Column {
        head: plain(field),
        is_number: *field != "size" && !is_name(field) && rows.iter().any(|row| is_number(&row[*field])),
    };
    let cells = |row: &Value| fields.iter().map(|field| cell(field, &row[*field])).collect();
    let columns = fields.iter().map(column).collect();
    Table { caption: caption.to_string(), columns, rows: rows.iter().map(cells).collect() }
}

/// The warnings of objects, or why they have no rate: a line for those of the same words.
fn warnings_of(objects: &[Answer<RatesRow>]) -> Vec<String> {
    let warned = objects.iter().filter(|answer| answer.doubts.warnings.is_some());
    let line = |same: Vec<&Answer<RatesRow>>| {
        let names: Vec<&str> = same.iter().map(|answer| answer.object.structure.as_str()).collect();
        let words = same[0].doubts.warnings.as_deref().unwrap_or_default();
        if names == [UNNAMED] {
            words.to_string()
        } else {
            format!("{}: {words}", listed(&names, MOST_NAMED))
        }
    };
    by(warned, |answer| &answer.doubts.warnings).into_iter().map(line).collect()
}

fn rates(objects: &[Answer<RatesRow>]) -> Table {
    let years = objects.iter().find_map(|answer| answer.row.years).unwrap_or(f64::NAN);
    let percent = format!("% in {} years (95 % limits)", number::plain(years));
    let row = |Answer { object, row, .. }: &Answer<RatesRow>| {
        json!({
            "object": Some(&object.structure).filter(|name| *name != UNNAMED),
            "size": object.p_rad_s.map(|_| size(object)),
            "rocks a year": row.rocking_per_year.map(|rate| RATE.one(rate)),
            "once in years": row.return_period_years.map(number::period),
            (percent.as_str()): OF_HUNDRED.both(row.p_overturning, ""),
            "friction needed": object.friction.map(|friction| number::fixed(friction, 2)),
        })
    };
    let fields = format!("object|once in years|{percent}|rocks a year|size|friction needed");
    table("", objects.iter().map(row), &fields)
}

/// Table II: published over ours.
fn planes(compared: &[Comparison]) -> Table {
    let row = |plane: &Comparison| {
        let cell = |name: &str| coefficient(compared, plane, name).map(|number| minus(both(number)));
        json!({
            "structure": plane.structure, "motions": plane.suite,
            "plane": if plane.quantity == "low_plane" { "below" } else { "above" },
            "ln *a*": cell("ln_a"), "*b*_{1}": cell("b1"), "*b*_{2}": cell("b2"), "*R*^{2}": cell("r2"),
        })
    };
    let of_planes = compared.iter().filter(|number| number.quantity.ends_with("_plane"));
    table(
        "Table II, the planes of the demand below and above the transition: published / this run (*z*). *z* \
         is their difference over the standard deviation between seeds.",
        of_planes.map(row),
        "structure|motions|plane|ln *a*|*b*_{1}|*b*_{2}|*R*^{2}",
    )
}

fn count(cases: &Cases, outcome: Outcome) -> usize {
    cases.outcome.iter().filter(|other| **other == outcome).count()
}

fn overturned(groups: &[Cases]) -> String {
    let of = |cases: &Cases| {
        let [events, all] = [count(cases, Outcome::Overturning), cases.len()].map(number::count);
        format!("{events} of {all} motions overturn {}", name(cases))
    };
    groups.iter().take(MOST_NAMED).map(of).collect::<Vec<_>>().join("; ") + "."
}

/// What came of each structure and suite, and the median that overturns it: of its capacities, else of the
/// paper's curve.
fn outcomes(tables: &Tables) -> anyhow::Result<Table> {
    let capacities: Vec<CapacityFitRow> = tables.rows("ida.fragility")?;
    let median = match capacities.first() {
        Some(fit) => format!("median of the lowest overturning {}", label_of_scaled(fit.measure)),
        None => "median PGV (m/s), lognormal curve".to_string(),
    };
    let row = |cases: &Cases| {
        let often = tables.calibration(cases).map(|row| row.n_events as f64 / row.expected);
        let often = often.map(|often| format!("{} times", number::significant(often, 2)));
        let capacity = capacities.iter().find(|fit| fit.group() == cases.group());
        let of_capacity = capacity.map(|fit| [fit.theta, fit.beta]);
        let of_curve = || {
            let curve = tables.curve(cases, Measure::Im5, None);
            let parameters = curve.map_or(Vec::new(), |fit| fit.parameters(0.95));
            let pgv = G_M_S2 * cases.structure.alpha_rad.tan() / cases.structure.p_rad_s;
            [(Parameter::Theta, pgv), (Parameter::Beta, 1.0)].map(|(which, unit)| {
                let row = parameters.iter().find(|row| row.parameter == which);
                let scaled = |row: &ParameterRow| Limited::from(row.estimate()).map(|value| unit * value);
                row.map(scaled).unwrap_or_default()
            })
        };
        let [theta, beta] = of_capacity.unwrap_or_else(of_curve).map(|of| TWO_DIGITS.both(of, ""));
        json!({
            "structure": cases.structure.name, "motions": cases.suite, "number": cases.len(),
            "rock": cases.len() - count(cases, Outcome::NoRocking),
            "overturn": count(cases, Outcome::Overturning),
            "as often as the surface predicts": often,
            (median.as_str()): theta, "dispersion": beta,
        })
    };
    let fields = format!(
        "structure|motions|number|rock|overturn|as often as the surface predicts|{median}|dispersion"
    );
    Ok(table(
        "Motions that rock and overturn each structure, with 95 % limits",
        tables.groups.iter().map(row),
        &fields,
    ))
}

fn tests(tables: &Tables) -> anyhow::Result<Vec<Table>> {
    let is_of_plane =
        |number: &&Comparison| ["low_", "high_"].iter().any(|side| number.quantity.starts_with(side));
    let published = tables.compared.iter().filter(|number| !is_of_plane(number));
    let planes = tables.demand.iter().filter(|fit| fit.model == DemandModel::Biplanar);
    let validations: Vec<Validation> = tables.rows("validation")?;
    let validations = table(
        "Validation: events observed and expected",
        validations,
        "structure|suite|event|model|n|observed|expected|expected_error|log_score|calibration_slope",
    );
    let of_paper = [
        table(
            "Further numbers of the paper beside those of this run; *z* is (published \u{2212} ours) / sd \
             over seeds",
            published,
            "quantity|structure|suite|published|ours|mean|sd|z",
        ),
        table(
            "Lognormal curves of overturning",
            &tables.curves,
            "structure|suite|im_x|im_y|auc|n|n_events|status",
        ),
        table("Planes of the demand", planes, "structure|suite|range_low|range_high|r2|beta|n|status"),
    ];
    let mut all = match (&tables.objects[..], &tables.compared[..]) {
        ([], []) => Vec::from(of_paper),
        ([], _) => [vec![outcomes(tables)?], Vec::from(of_paper)].concat(),
        // A client's page has no curves and planes of the paper.
        _ => vec![outcomes(tables)?],
    };
    all.push(validations);
    all.retain(|table| !table.rows.is_empty());
    Ok(all)
}

fn files(tables: &Tables) -> Table {
    let rows = tables.files.iter().map(|(path, rows, made)| {
        let by = made
            .as_ref()
            .map_or("another program".to_string(), |made| format!("{} {}", made.stage, made.version));
        json!({ "file": path.file_name().map(|name| name.to_string_lossy()), "made by": by, "rows": rows })
    });
    table("", rows, "file|made by|rows")
}
