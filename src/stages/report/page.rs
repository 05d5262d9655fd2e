//! The page: one sentence, one table, one figure; then further figures; folded, method, tests and files.

use serde::Serialize;
use serde_json::{Value, json};

use super::tables::{Item, Kind, Tables};
use crate::fragility::{Cases, DemandModel, Measure, Parameter, ParameterRow};
use crate::keyword::Keyword;
use crate::number::{self, Limited, TWO_DIGITS};
use crate::pipeline::options::listed;
use crate::report::figures::common::{by, label_of_scaled, name};
use crate::report::text::{literal, minus};
use crate::report::{Column, Figure, Page, Section, Table, compare, list, object, response};
use crate::rocking::{Outcome, Structure};
use crate::stages::compare_paper::{both, coefficient};
use crate::studies::Validation;
use crate::studies::paper::Comparison;
use crate::table::capacities::CapacityFitRow;
use crate::units::G_M_S2;
use crate::warning::Warnings;

/// Warnings under the table; the others are folded. Structures in the first sentence; the table has all.
const MOST_WARNINGS: usize = 3;
const MOST_NAMED: usize = 4;
/// Figures that are seen on the page of a list, of the paper and of other responses. Further ones are folded;
/// of a list there are only these.
const OF_RATES: &[&str] = &["list", "object", "compared", "map", "ida", "validation"];
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

/// The page of all tables: its head is that of the evaluations, else of the paper, of responses over time or
/// of responses.
pub fn page(tables: &Tables, figures: Vec<Figure>, notes: Vec<String>) -> anyhow::Result<Page> {
    let is_client = !tables.evaluations.is_empty();
    let head = match (&tables.evaluations[..], &tables.compared[..], &tables.traces[..]) {
        ([], [], []) => of_responses(tables)?,
        ([], [], traces) => response::page(traces),
        ([], compared, _) => of_paper(tables, compared),
        (evaluations, ..) => match (tables.comparison(), evaluations) {
            (Some([before, after]), _) => compare::page(before, after),
            (_, [one]) if one.rows.len() == 1 => object::page(one, &one.rows[0]),
            (_, several) => list::page(several),
        },
    };
    let shown: &[&str] = match (is_client, tables.compared.is_empty()) {
        (true, _) => OF_RATES,
        (_, true) => OF_RESPONSES,
        _ => OF_PAPER,
    };
    let is_shown =
        |figure: &Figure| shown.contains(&figure.name.as_str()) || figure.name.starts_with("response-");
    let (mut seen, more): (Vec<Figure>, Vec<Figure>) = figures.into_iter().partition(is_shown);
    if let [figure, ..] = &head.figures[..] {
        // The head has its own, without a title that would say the same again.
        seen.retain(|other| other.name != figure.name);
    }
    if let ([figure], [_]) = (&mut seen[..], &head.moving[..]) {
        // The page of one response has its title.
        figure.title.clear();
    }
    let more = if is_client { Vec::new() } else { more };
    let mut joined = Warnings::default();
    tables.made().for_each(|made| joined.join(&made.warnings));
    let mut others = joined.lines();
    let mut all_notes = [tables.left_out.clone(), notes, head.notes.clone()].concat();
    if !is_client {
        all_notes.extend(others.drain(..others.len().min(MOST_WARNINGS)));
    }
    let method = METHOD.lines().filter_map(|line| line.split_once(": "));
    let is_shown = |stage: &str| tables.made_by(stage).is_some() && (stage != "fit-pex" || !is_client);
    let method = method.filter(|(stage, _)| is_shown(stage)).map(|(_, words)| words.to_string());
    let section = |heading: &str| Section { heading: heading.to_string(), ..Section::default() };
    let own = [
        Section { figures: more, ..section("More figures") },
        Section { paragraphs: method.collect(), ..section("Method") },
        Section { paragraphs: others, tables: tests(tables)?, ..section("Tests and fits") },
        Section { tables: vec![files(tables)], ..section("Files") },
    ];
    let mut sections = head.sections.clone();
    sections.extend(own);
    sections.retain(|section| section.figures.len() + section.paragraphs.len() + section.tables.len() > 0);
    let facts = [head.facts.clone(), facts(tables)].concat();
    let figures = [head.figures.clone(), seen].concat();
    Ok(Page { facts, notes: all_notes, figures, sections, ..head })
}

fn of_paper(tables: &Tables, compared: &[Comparison]) -> Page {
    Page {
        title: "The paper's fragilities, made again".to_string(),
        place: "Dimitrakopoulos & Paraskeva (2015)".to_string(),
        sentence: literal(tables.answer_of("compare-paper").unwrap_or_default()),
        table: Some(planes(compared)),
        ..Page::default()
    }
}

fn of_responses(tables: &Tables) -> anyhow::Result<Page> {
    Ok(Page {
        title: match tables.groups.is_empty() {
            true => "Fits and motions".to_string(),
            false => "What rocks and what overturns".to_string(),
        },
        sentence: overturned(&tables.groups),
        table: Some(outcomes(tables)?).filter(|table| !table.rows.is_empty()),
        ..Page::default()
    })
}

/// By which motions, of which structures.
fn facts(tables: &Tables) -> Vec<String> {
    let motions = ["synthesize-motions", "import-motions"].map(|stage| tables.answer_of(stage));
    let mut facts: Vec<String> =
        motions.into_iter().flatten().map(|answer| format!("Motions: {}.", literal(answer))).collect();
    let words = |Structure { name, p_rad_s, alpha_rad, eta }: &Structure| {
        let [p, alpha, eta] = [p_rad_s, alpha_rad, eta].map(|value| number::significant(*value, 3));
        format!("{} (*p* {p} rad/s, *α* {alpha}, *η* {eta})", literal(name))
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
    let is_name = |field: &str| ["structure", "file"].contains(&field);
    let is_measure = |text: &str| Measure::SCALAR.iter().any(|measure| measure.as_str() == text);
    let cell = |field: &str, value: &Value| match value {
        Value::Number(count) if count.is_u64() => number::count(count.as_u64().unwrap_or(0) as usize),
        Value::Number(value) => minus(number::significant(value.as_f64().unwrap_or(f64::NAN), 3)),
        Value::String(text) if is_name(field) => literal(text),
        Value::String(text) if text == "im3_inv" => "1/IM3".to_string(),
        Value::String(text) if is_measure(text) => text.to_uppercase(),
        Value::String(text) => plain(text),
        _ => String::new(),
    };
    let column = |field: &&str| Column {
        head: plain(field),
        is_number: !is_name(field) && rows.iter().any(|row| is_number(&row[*field])),
    };
    let cells = |row: &Value| fields.iter().map(|field| cell(field, &row[*field])).collect();
    let columns = fields.iter().map(column).collect();
    Table { caption: caption.to_string(), columns, rows: rows.iter().map(cells).collect() }
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

fn overturned(groups: &[Cases]) -> String {
    let of = |cases: &Cases| {
        let [events, all] = [cases.count(Outcome::Overturned), cases.all.len()].map(number::count);
        format!("{events} of {all} motions overturn {}", name(cases))
    };
    groups.iter().take(MOST_NAMED).map(of).collect::<Vec<_>>().join("; ") + "."
}

/// What came of each structure and suite, and the median that overturns it: of its capacities, else of the
/// paper's curve.
fn outcomes(tables: &Tables) -> anyhow::Result<Table> {
    let capacities: Vec<CapacityFitRow> = tables.rows(Kind::CapacityFits)?;
    let median = match capacities.first() {
        Some(fit) => format!("median of the lowest overturning {}", label_of_scaled(fit.measure)),
        None => "median PGV (m/s), lognormal curve".to_string(),
    };
    let row = |cases: &Cases| {
        let often = tables.fits.calibration(cases).map(|row| row.n_events as f64 / row.expected);
        let often = often.map(|often| format!("{} times", number::significant(often, 2)));
        let capacity = capacities.iter().find(|fit| fit.group() == cases.group());
        let of_capacity = capacity.map(|fit| [fit.theta, fit.beta]);
        let of_curve = || {
            let curve = tables.fits.curve(cases, Measure::Im5, None);
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
            "structure": cases.structure.name, "motions": cases.suite, "number": cases.all.len(),
            "rock": cases.all.len() - cases.count(Outcome::NoRocking),
            "overturn": cases.count(Outcome::Overturned),
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
    let planes = tables.fits.demand.iter().filter(|fit| fit.model == DemandModel::Biplanar);
    let validations: Vec<Validation> = tables.rows(Kind::Validation)?;
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
            &tables.fits.curves,
            "structure|suite|im_x|im_y|auc|n|n_events|status",
        ),
        table("Planes of the demand", planes, "structure|suite|range_low|range_high|r2|beta|n|status"),
    ];
    let mut all = match (&tables.evaluations[..], &tables.compared[..]) {
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
    let row = |item: &Item| {
        let by = match &item.made {
            Some(made) => format!("{} {}", made.stage, made.version),
            None => "another program".to_string(),
        };
        json!({ "file": item.name(), "holds": item.words(), "made by": by, "rows": item.rows })
    };
    table("", tables.items.iter().map(row), "file|holds|made by|rows")
}
