//! The page: one sentence, one table, one figure; then further figures; folded, tests and files.

use rockfrag_core::fragility::{Cases, DemandModel, Group, Measure, Predictors};
use rockfrag_core::paper::{self, Claim};
use rockfrag_core::rocking::{Outcome, Structure};
use rockfrag_core::statistics::Interval;
use rockfrag_core::studies::Validation;
use rockfrag_core::studies::comparison::Comparison;
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::Warnings;
use serde::Serialize;
use serde_json::{Value, json};

use super::tables::{Item, Kind, Tables};
use crate::answer::AnswerTable;
use crate::chart::Figure;
use crate::chart::text::{file_words, literal, minus};
use crate::document::{Document, Table, compare, response};
use crate::figures::common::{called, name, name_of, order, rocked, scaled_label, short_label};
use crate::figures::*;
use crate::number::{self, TWO_DIGITS};
use crate::stages::compare_paper::table_two;
use crate::stages::shared::fits::CurveLine;
use crate::table::responses::{CapacityFitRow, OutcomeWord, ResponseRow};
use crate::table::rows::{self, by};

/// The most responses of a table of demand.
const MOST_RESPONSES: usize = 100;
/// Structures in the first sentence; the table has all.
const MOST_NAMED: usize = 4;
/// Figures that are seen on the page of a list, which has no others, of the paper and of other responses.
const OF_RATES: &[&str] = &["map", "ida", "validation"];
const OF_PAPER: &[&str] = &["hybrid", "demand", "map", "motion", "similarity", "planes", "exceedance"];
const OF_RESPONSES: &[&str] = &["ida", "universality", "map", "overturning", "validation"];

/// The most pairs of suite and structure that are drawn.
const MOST_GROUPS: usize = 24;

/// The most panels of a figure of several structures, and groups that have a colour.
const MOST_PANELS: usize = 4;
const MOST_COLOURS: usize = 6;

/// What two words mean.
const ANGLES: &str = "Slenderness (*α*): the angle at which an object tips. Restitution (*η*): its angular \
                      velocity after an impact over that before.";

/// The page of all tables, and all their figures, of which the page shows some.
pub fn page(tables: &mut Tables) -> anyhow::Result<(Document, Vec<Figure>)> {
    let others = figures(tables)?;
    let mut head = head(tables);
    head.figures.retain(|figure| !figure.panels.is_empty());
    let all = [head.figures.clone(), others.clone()].concat();
    let is_client = !tables.answers.is_empty();
    let shown = match (is_client, tables.compared.is_empty()) {
        (true, _) => OF_RATES,
        (_, true) => OF_RESPONSES,
        _ => OF_PAPER,
    };
    let (seen, more): (Vec<Figure>, Vec<Figure>) =
        others.into_iter().partition(|figure| shown.iter().any(|name| figure.name.starts_with(name)));
    let mut joined = Warnings::default();
    tables.made().for_each(|made| joined.join(&made.warnings));
    let (warnings, folded) = if is_client { (vec![], joined.lines()) } else { (joined.lines(), vec![]) };
    head.notes = [tables.left_out.clone(), head.notes, warnings].concat();
    head.tables.extend([vec![outcomes(tables)?], demands(tables)?].concat());
    head.tables.retain(|table| !table.rows.is_empty());
    let section = |title: &str| Document { title: title.to_string(), ..Document::default() };
    let mut sections = vec![
        Document { tables: claims(tables), ..section("The paper's claims") },
        Document { figures: if is_client { Vec::new() } else { more }, ..section("More figures") },
        Document { facts: folded, tables: tests(tables)?, ..section("Tests and fits") },
        Document { tables: vec![files(tables)], ..section("Files") },
    ];
    sections.retain(Document::has_content);
    head.figures.extend(seen);
    head.sections.extend(sections);
    Ok((head, all))
}

fn figures(tables: &mut Tables) -> anyhow::Result<Vec<Figure>> {
    let rocking = tables.groups.iter().filter(|cases| rocked(cases).next().is_some());
    let mut groups: Vec<&Cases> = rocking.collect();
    let rest = groups.split_off(groups.len().min(MOST_GROUPS));
    if !rest.is_empty() {
        let names = rest.into_iter().map(name).collect::<Vec<_>>().join("; ");
        tables.left_out.push(format!("Not drawn, beyond the first {MOST_GROUPS}: {names}."));
    }
    groups.sort_by_key(|cases| order(cases));
    let (motions, fits) = (tables.motions()?, &tables.fits);
    let stripes = tables.rows(Kind::Stripes)?;
    let mut figures = vec![ida(&tables.rows(Kind::CapacityFits)?, &tables.rows(Kind::Capacities)?, &stripes)];
    let draw = |all: &[fn(&Fits, &[&Cases]) -> Figure]| {
        all.iter().flat_map(|draw| by_structure(&groups, |groups| draw(fits, groups))).collect::<Vec<_>>()
    };
    figures.extend(draw(&[hybrids, maps]));
    figures.extend([
        universality(&tables.groups),
        validation(&tables.rows(Kind::Reliability)?),
        motion(&motions),
        similarity(&tables.groups, &motions).unwrap_or_default(),
    ]);
    // As the demand was fitted: smaller rotations are raised to the floor.
    let mut fitted: Vec<Cases> = groups.iter().copied().cloned().collect();
    fitted.iter_mut().for_each(|cases| cases.raise_rotations(fits.rotation_floor));
    figures.extend(by_structure(&fitted.iter().collect::<Vec<_>>(), |groups| planes(fits, groups)));
    figures.extend(draw(&[exceedance, overturning, quality, |_, groups| demand(groups)]));
    figures.extend(fitted.iter().map(|cases| regressions(fits, cases)));
    figures.retain(|figure| !figure.panels.is_empty());
    Ok(figures)
}

/// The figure of all groups; one a structure, where it would have too many panels or colours.
fn by_structure(groups: &[&Cases], draw: impl Fn(&[&Cases]) -> Figure) -> Vec<Figure> {
    let whole = draw(groups);
    if whole.panels.len() <= MOST_PANELS && groups.len() <= MOST_COLOURS {
        return vec![whole];
    }
    let of_structure = |groups: &[&Cases]| {
        let (figure, structure) = (draw(groups), called(&groups[0].structure));
        let name = format!("{}-{}", figure.name, file_words(&structure));
        Figure { name, title: format!("{}: {structure}", figure.title), ..figure }
    };
    by(groups.iter().copied(), |cases| &cases.structure.name)
        .iter()
        .flat_map(|groups| groups.chunks(MOST_COLOURS).map(of_structure))
        .collect()
}

/// The head of the page: of the evaluations, else of the paper, of responses over time or of responses.
fn head(tables: &Tables) -> Document {
    let Tables { answers, compared, traces, groups, .. } = tables;
    let mut head = match tables.are_files.then(|| compare::document(answers)).flatten() {
        Some(document) => document,
        None if !answers.is_empty() => Document::of_answers(&AnswerTable::joined(answers)),
        None if !compared.is_empty() => Document {
            title: "The paper's fragility curves beside those of this run".to_string(),
            place: "Dimitrakopoulos & Paraskeva (2015)".to_string(),
            lead: tables.made_by("compare-paper").map_or(Vec::new(), |made| {
                let sentences = made.summary.split("\n\n").take(1);
                sentences.map(|text| literal(&text.replace(":\n", ": ").replace("\n  ", "; "))).collect()
            }),
            tables: vec![published_planes(compared)],
            facts: vec![ANGLES.to_string()],
            ..Document::default()
        },
        None if !traces.is_empty() => return response::document(traces),
        None => Document {
            title: groups.first().map_or("Fits and motions", |_| "What rocks and what overturns").to_string(),
            lead: overturned(groups).into_iter().collect(),
            facts: groups.first().map(|_| ANGLES.to_string()).into_iter().collect(),
            ..Document::default()
        },
    };
    head.figures.extend(response::figures(traces));
    head
}

/// Some fields of rows, under their names; those that no row has are left out.
fn table<R: Serialize>(caption: &str, rows: impl IntoIterator<Item = R>, fields: &str) -> Table {
    let rows = rows.into_iter().map(|row| json!(row));
    let cells = rows.map(|row| fields.split(' ').map(|field| cell(&row, field)).collect());
    let heads = fields.split(' ').map(|field| field.replace('_', " ")).collect();
    Table { caption: caption.to_string(), heads, rows: cells.collect(), ..Table::default() }
}

fn cell(row: &Value, field: &str) -> String {
    match &row[field] {
        Value::Number(value) => match (value.as_u64(), value.as_f64()) {
            (Some(count), _) => number::count(count as usize),
            (_, number) => number.map_or(String::new(), |number| minus(number::significant(number, 3))),
        },
        Value::Object(part) if part.contains_key(field) => cell(&row[field], field),
        Value::Object(_) => {
            let value: Option<Interval<Option<f64>>> = serde_json::from_value(row[field].clone()).ok();
            value.map_or(String::new(), |value| TWO_DIGITS.both(value, ""))
        }
        Value::String(name) if field == "structure" => name_of(name),
        Value::String(name) if field.starts_with("im_") => short_label(&name.clone().into()),
        Value::String(text) if text.contains(' ') => literal(text),
        Value::String(word) => word.replace('_', " "),
        _ => String::new(),
    }
}

/// Table II: published, mean of the seeds, this run.
fn published_planes(compared: &[Comparison]) -> Table {
    let rows = table_two(compared).into_iter().map(|[suite, structure, plane, numbers @ ..]| {
        [vec![literal(&structure), literal(&suite), plane], numbers.map(minus).into()].concat()
    });
    let heads =
        ["structure", "motions", "plane", "ln *a*", "*b*_{1}", "*b*_{2}", "*R*^{2}", "*T*^{2}", "*p*"];
    Table::new(&heads, rows.collect()).explained(
        "Table II, the planes of the demand below and above the transition: published / mean of seeds / this \
         run (its *z* if 3 or more). *T*^{2} and *p*: the published plane as one more of the seeds.",
    )
}

fn overturned(groups: &[Cases]) -> Option<String> {
    let sentence = |cases: &Cases| {
        let [events, all] = [cases.count(Outcome::Overturned), cases.all.len()].map(number::count);
        format!("{events} of {all} motions overturn {}", name(cases))
    };
    let sentences = groups.iter().take(MOST_NAMED).map(sentence).reduce(|all, one| all + "; " + &one);
    sentences.map(|all| all + ".")
}

/// What came of each structure and suite, and its median by its capacities, else by the paper's curve.
fn outcomes(tables: &Tables) -> anyhow::Result<Table> {
    let capacities: Vec<CapacityFitRow> = tables.rows(Kind::CapacityFits)?;
    let of = |fit: &CapacityFitRow| format!("median of the lowest overturning {}", scaled_label(fit.measure));
    let median = capacities.first().map_or("median PGV (m/s), lognormal curve".to_string(), of);
    let often = "as often as the surface predicts";
    let structure = ["structure", "motions", "*p*, rad/s", "*α*", "*η*"];
    let heads = [&structure[..], &["number", "rock", "overturn", often, &median, "dispersion"]].concat();
    let mut rows = Vec::new();
    for cases in &tables.groups {
        let often = tables.fits.calibration(cases).map(|row| row.n_events as f64 / row.expected);
        let often = often.map(|often| format!("{} times", number::significant(often, 2)));
        let capacity = capacities.iter().find(|fit| Group::of(&fit.suite, &fit.structure) == cases.group());
        let by_curve = || curve_parameters(tables, cases);
        let (theta, beta) = capacity.map_or_else(by_curve, |fit| (fit.theta, fit.beta));
        let all = cases.all.len();
        let counts = [all, all - cases.count(Outcome::NoRocking), cases.count(Outcome::Overturned)];
        let mut row = vec![called(&cases.structure), literal(cases.suite.as_deref().unwrap_or_default())];
        let Structure { p_rad_s, alpha_rad, eta, .. } = cases.structure;
        row.extend([p_rad_s, alpha_rad, eta].map(|value| number::significant(value, 3)));
        row.extend(counts.map(number::count));
        row.push(often.unwrap_or_default());
        row.extend([theta, beta].map(|value| TWO_DIGITS.both(value, "")));
        rows.push(row);
    }
    Ok(Table::new(&heads, rows).explained("Motions that rock and overturn each structure, with 95 % limits"))
}

/// What came of each structure under each motion, a table for each file of few responses.
fn demands(tables: &Tables) -> anyhow::Result<Vec<Table>> {
    let structures = by(&tables.groups, |cases| &cases.structure.name);
    let names = structures.iter().map(|its| called(&its[0].structure));
    let heads = ["motion", "PGA, g", "PGV, m/s"].map(str::to_string).into_iter().chain(names);
    let heads: Vec<String> = heads.collect();
    let is_short = |item: &&Item| item.made.is_some() && item.rows <= MOST_RESPONSES;
    let of_file = |item: &Item| {
        let responses: Vec<ResponseRow> = rows::read(&item.path)?;
        let line = |its: &Vec<&ResponseRow>| {
            let peaks = [its[0].pga_m_s2 / G_M_S2, its[0].pgv_m_s].map(|peak| TWO_DIGITS.one(peak));
            let demands = structures.iter().map(|of| {
                let response = its.iter().find(|row| row.structure.name == of[0].structure.name);
                response.map_or(String::new(), |of| match of.outcome {
                    OutcomeWord::NoRocking => "does not rock".to_string(),
                    OutcomeWord::SafeRocking => of.edp.map_or(String::new(), |edp| TWO_DIGITS.one(edp)),
                    OutcomeWord::Overturned => "overturns".to_string(),
                })
            });
            let motion = literal(&number::name(&its[0].motion_id));
            std::iter::once(motion).chain(peaks).chain(demands).collect()
        };
        let rows = by(&responses, |row| (&row.motion_id, row.pga_m_s2)).iter().map(line).collect();
        let caption = "Largest rotation under each motion, |*θ*|_{max} / *α*".to_string();
        Ok(Table { caption, heads: heads.clone(), rows, ..Table::default() })
    };
    tables.of(Kind::Responses).filter(is_short).map(of_file).collect()
}

/// Median PGV, m/s, and dispersion by the paper's curve over IM5.
fn curve_parameters(tables: &Tables, cases: &Cases) -> (Interval<Option<f64>>, Interval<Option<f64>>) {
    let curve = tables.fits.curve(cases, &Predictors::one(Measure::Im5));
    let Some(fit) = curve else { return Default::default() };
    let CurveLine { theta, beta, .. } = CurveLine::new(fit, 0.95);
    let pgv_m_s = cases.structure.uplift_acceleration_m_s2() / cases.structure.p_rad_s;
    (theta.map(|im5| im5 * pgv_m_s), beta)
}

fn tests(tables: &Tables) -> anyhow::Result<Vec<Table>> {
    let all = [
        table(
            "Further numbers of the paper, with *z* of each and of this run about the mean of seeds",
            tables.compared.iter().filter(|number| number.plane.is_none()),
            "quantity structure suite published mean z ours ours_z",
        ),
        table(
            "Lognormal curves of overturning: *θ*, *β* and *λ* of Eqs. 20 and 24",
            tables.fits.curves.iter().map(|fit| CurveLine::new(fit, 0.95)),
            "structure suite im_x im_y theta beta lambda n_events largest_difference status",
        ),
        table(
            "Planes of the demand",
            tables.fits.demand.iter().filter(|fit| fit.model == DemandModel::Biplanar),
            "structure suite range_low range_high r2 beta n largest_difference status",
        ),
        table(
            "Validation: events observed and expected",
            tables.rows::<Validation>(Kind::Validation)?,
            "structure suite event model n observed expected expected_error log_score calibration_slope",
        ),
    ];
    // A client's page has no curves and planes of the paper.
    let of_paper = if tables.answers.is_empty() { 0 } else { 3 };
    Ok(all.into_iter().skip(of_paper).filter(|table| !table.rows.is_empty()).collect())
}

/// The claims of the paper, a table each, where this run is compared with it.
fn claims(tables: &Tables) -> Vec<Table> {
    let all = if tables.compared.is_empty() { Vec::new() } else { paper::claims() };
    let of_claim = |rows: &Vec<&Claim>| {
        let Claim { claim, verdict, figure, .. } = rows[0];
        let caption = format!(
            "{claim}: {verdict}. Figure: {figure}. Means of twenty seeds with 95 % limits of one more seed; \
             support by those of the mean."
        );
        table(&caption, rows, "quantity structure suite claimed mean low high support")
    };
    by(&all, |row| &row.claim).iter().map(of_claim).collect()
}

fn files(tables: &Tables) -> Table {
    let rows = tables.items.iter().map(|item| {
        let made = item.made.as_ref().map(|made| format!("{} {}", made.stage, made.version));
        let by = made.unwrap_or_else(|| "another program".to_string());
        vec![literal(&item.name()), item.kind.to_string(), by, number::count(item.rows)]
    });
    Table::new(&["file", "holds", "made by", "rows"], rows.collect())
}
