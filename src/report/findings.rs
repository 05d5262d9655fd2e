//! The first page: what was asked, what came out, how sure it is, and by what method.

use std::fmt::Write;

use super::data::{Analysis, By, File, Median, Rates, ReportData, Summary, measure_label, scaled_words};
use super::text::{escape, number};
use crate::fragility::overturning::LEAST_EVENTS;
use crate::fragility::{Gap, Measure, USEFUL_R2};
use crate::keyword::{self, Keyword};
use crate::rocking::Structure;
use crate::statistics::FitStatus;
use crate::studies::wilson_limits;
use crate::units::G_M_S2;

/// The most rows on the first page; the table of curves has all.
const MOST_ROWS: usize = 8;
/// The most structures whose parameters are told one by one.
const MOST_STRUCTURES: usize = 4;
/// Stages in the order in which their warnings matter to a reader, and how many are told on the first page; the others are folded.
const BY_WEIGHT: [(&str, usize); 4] = [("evaluate", 6), ("validate", 4), ("fit-pro", 3), ("fit-pex", 0)];
const MOST_WARNINGS: usize = 2;

/// What gives rates without fits.
const OF_SURFACE: &str = "Rates by the <i>universal surface</i> are not from simulations of these structures: two regressions, which come with rockfrag, give the probabilities of any rigid block or frame over PGA, PGV, p, α and η. They were fitted to simulated responses of 320 other structures. ";

/// Writes the section.
pub fn findings(html: &mut String, data: &ReportData) {
    html.push_str("<section id=\"findings\"><h2>Findings</h2>\n<h3>What was asked</h3>\n");
    let _ = writeln!(html, "<p>{}</p>", escape(&asked(data)));
    html.push_str("<h3>What came out</h3>\n");
    let is_first = data.has_few_events();
    if is_first {
        lowest_intensities(html, data);
    }
    if !data.summaries.is_empty() {
        if is_first && !data.analyses.is_empty() {
            html.push_str("<h4>The motions as they are</h4>\n");
        }
        came_out(html, data);
    }
    if !is_first {
        lowest_intensities(html, data);
    }
    for rates in &data.rates {
        at_site(html, rates);
    }
    let fits = match data.summaries.is_empty() {
        true => "",
        false => {
            "Each motion is computed or recorded, the rocking of each structure in it is integrated, and curves are fitted to how it ended, as in Dimitrakopoulos &amp; Paraskeva (2015). "
        }
    };
    let surface = if data.has_rates_by(By::Surface) { OF_SURFACE } else { "" };
    let _ = writeln!(
        html,
        "<h3>By what method</h3>\n<p>{fits}{surface}<a href=\"#method\">Method, symbols and references</a> say more. {}</p>\n<h3>How sure this is</h3>",
        escape(&data.made())
    );
    doubts(html, data);
    html.push_str("</section>\n");
}

fn asked(data: &ReportData) -> String {
    let mut structures: Vec<&Summary> = Vec::new();
    let mut suites: Vec<&str> = Vec::new();
    for summary in &data.summaries {
        if structures.iter().all(|known| known.structure.name != summary.structure.name) {
            structures.push(summary);
        }
        let suite = summary.suite.as_deref().unwrap_or("one kind");
        if !suites.contains(&suite) {
            suites.push(suite);
        }
    }
    let of = |summary: &&Summary| {
        let structure = &summary.structure;
        let [p, alpha, eta] = [structure.p_rad_s, structure.alpha_rad, structure.eta].map(number::short);
        format!(
            "{} (p = {p} rad/s, α = {alpha} rad, η = {eta}; {})",
            structure.name,
            structure.words_of_friction()
        )
    };
    let (count, names) = (structures.len(), structures.iter().map(of).collect::<Vec<_>>());
    let names = match count {
        ..=MOST_STRUCTURES => names.join(", "),
        _ => format!("{} and {} more", names[..2].join(", "), count - 2),
    };
    let motions: Vec<String> = suites
        .iter()
        .map(|suite| {
            let is_its = |summary: &&Summary| summary.suite.as_deref().unwrap_or("one kind") == *suite;
            let most = data.summaries.iter().filter(is_its).map(|summary| summary.n).max().unwrap_or(0);
            format!("{} of {suite}{}", number::count(most), suite_words(suite))
        })
        .collect();
    if structures.is_empty() {
        let names: Vec<&str> = data.rates.iter().map(|rates| rates.name.as_str()).collect();
        return format!(
            "How often free-standing structures rock, fail and overturn at a site. {}.",
            names.join(". ")
        );
    }
    let limit = match data.limit {
        Some(limit) => {
            format!(
                ", or rock with a rotation |θ|max of more than {} of their slenderness α",
                number::plain(limit)
            )
        }
        None => String::new(),
    };
    format!(
        "How likely free-standing structures overturn{limit}, given the ground motion. {count} {}: {names}. Motions: {}.",
        if count == 1 { "structure" } else { "structures" },
        motions.join(", ")
    )
}

/// What a suite is, after its name.
fn suite_words(suite: &str) -> &'static str {
    match suite {
        "pulse" => " (velocity pulses alone)",
        "csgm" => " (pulses with high frequencies)",
        "hfc" => " (high frequencies alone)",
        "record" => " (recorded or given)",
        _ => "",
    }
}

/// From which intensity on motions overturn each structure, where they were scaled until they did.
fn lowest_intensities(html: &mut String, data: &ReportData) {
    let Some(Analysis { measure, levels, .. }) = data.analyses.first() else { return };
    let [low, high] = [levels.first(), levels.last()]
        .map(|level| number::short(level.map_or(f64::NAN, |level| level.intensity)));
    let words = match keyword::parse(measure) {
        Ok(im) => format!("{} ({})", measure_label(im).words(), scaled_words(measure)),
        Err(_) if measure == "scale" => "factor on the motions".to_string(),
        Err(_) => scaled_words(measure),
    };
    let title = format!("Lowest {words} that overturns");
    let _ = writeln!(html, "<h4>{}</h4>", escape(&title));
    let heads = ["structure, motions", "number", "median", "as PGV (m/s)", "dispersion β", "never overturn"];
    let as_pgv = |analysis: &Analysis| {
        let is_its = |summary: &&Summary| summary.name() == analysis.name;
        let Structure { p_rad_s, alpha_rad, .. } = data.summaries.iter().find(is_its)?.structure;
        let pgv_m_s = G_M_S2 * libm::tan(alpha_rad) / p_rad_s;
        let theta = analysis.theta.filter(|_| analysis.measure == Measure::Im5.as_str())?;
        Some(theta.map(|im5| im5 * pgv_m_s))
    };
    let number =
        |value: Option<[f64; 3]>| value.map_or("–".to_string(), |value| number::with_limits(value, 2));
    let row = |analysis: &Analysis| {
        let n = analysis.levels.first().map_or(0, |level| level.n);
        let pgv = as_pgv(analysis);
        let Analysis { name, theta, beta, censored: [safe, _], .. } = analysis;
        vec![name.clone(), number::count(n), number(*theta), number(pgv), number(*beta), number::count(*safe)]
    };
    let (first, others) = data.analyses.split_at(data.analyses.len().min(MOST_ROWS));
    answers(html, &title, &heads, first.iter().map(row));
    let mut notes = "Each motion was scaled until it overturned the structure (<a href=\"#figure-ida\">incremental dynamic analysis</a>); half of the motions do so at the median or below it. Limits are 95 % limits for the number of motions.".to_string();
    if data.analyses.iter().any(|analysis| analysis.censored != [0, 0]) {
        let _ = write!(
            notes,
            " Some motions overturn a structure nowhere from {low} to {high}, or at {low} already: limits are too narrow there."
        );
    }
    if data.has_few_events() {
        notes.push_str(" Where few of the motions as they are overturn a structure, or few do not, its median here says more than its curve.");
    }
    if !others.is_empty() {
        let _ =
            write!(notes, " {} more are in <a href=\"#tables\">the tables</a>.", number::count(others.len()));
    }
    let _ = writeln!(html, "<p>{notes}</p>");
}

/// One row a structure and suite.
fn came_out(html: &mut String, data: &ReportData) {
    let above = data.limit.map(|limit| format!("reach {} α or overturn", number::plain(limit)));
    let mut heads = vec!["structure", "motions", "number", "rock"];
    heads.extend(above.as_deref());
    heads.extend([
        "overturn",
        "its 95 % limits",
        "half of those that rock overturn at PGV (m/s)",
        "its curve",
    ]);
    let row = |summary: &Summary| {
        let Summary { suite, structure, n, rocked, overturned, exceeded, curve } = summary;
        let mut cells = vec![
            structure.name.clone(),
            suite.clone().unwrap_or_else(|| "all".to_string()),
            number::count(*n),
            number::share(*rocked, *n),
        ];
        cells.extend(above.iter().map(|_| number::share(exceeded.unwrap_or(0) + overturned, *n)));
        let limits = wilson_limits(*overturned, *n);
        // Of none the lower limit is 0, but for rounding.
        let low = if *overturned == 0 { 0.0 } else { limits.low.max(0.0) };
        let percent = |share: f64| number::readable(100.0 * share, 2);
        cells.push(number::share(*overturned, *n));
        cells.push(format!("{} to {} %", percent(low), percent(limits.high)));
        let (median, status) = match curve {
            Some(Median { pgv_m_s, .. }) => (
                pgv_m_s.map_or("–".to_string(), |pgv| number::with_limits(pgv, 2)),
                judgement(summary).unwrap_or("no test speaks against it".to_string()),
            ),
            None => ("–".to_string(), "not fitted".to_string()),
        };
        cells.extend([median, status]);
        cells
    };
    let mut rows: Vec<&Summary> = data.summaries.iter().collect();
    if rows.len() > MOST_ROWS {
        let share = |summary: &Summary| summary.overturned as f64 / summary.rocked.max(1) as f64;
        rows.sort_by(|a, b| share(b).total_cmp(&share(a)));
    }
    let (first, others) = rows.split_at(rows.len().min(MOST_ROWS));
    answers(html, "What came out", &heads, first.iter().map(|summary| row(summary)));
    if !others.is_empty() {
        let _ = writeln!(
            html,
            "<details><summary>{} further pairs of structure and motions, of which fewer overturn</summary>",
            number::count(others.len())
        );
        answers(html, "What came out, further", &heads, others.iter().map(|summary| row(summary)));
        html.push_str("</details>\n");
    }
    html.push_str("<p>Shares are of all these motions, curves of those that rock. The velocity is where the curve over p PGV/(g tan α) gives one half; how likely it is at another intensity is in <a href=\"#curves\">the curves</a> and the <a href=\"#calculator\">calculator</a>.</p>\n");
}

/// What speaks against a curve, in few words.
fn judgement(summary: &Summary) -> Option<String> {
    let Median { status, gap, .. } = summary.curve?;
    let Summary { overturned, rocked, .. } = summary;
    let fewer = summary.fewer();
    let what = if *overturned == fewer { "overturn" } else { "do not overturn" };
    let few = || format!("{} of {} {what}", number::count(fewer), number::count(*rocked));
    Some(match (status, gap) {
        _ if fewer < LEAST_EVENTS => format!("not drawn: {}, too few", few()),
        (FitStatus::Ok, _) if summary.has_few_events() => format!("{}, so tests say little", few()),
        (FitStatus::Ok, _) => return None,
        (FitStatus::Misfit, Some(Gap { straight, bent })) => {
            format!("misfit: {straight:.2} where a curve that bends has {bent:.2}")
        }
        (FitStatus::FarMedian, _) => "median far outside of the data".to_string(),
        (status, _) => format!("none: {}", status.as_str().replace('_', " ")),
    })
}

fn at_site(html: &mut String, rates: &Rates) {
    let Rates { name, years, states, hazard, notes, .. } = rates;
    let years = format!("probability in {} years", number::plain(*years));
    let title = format!("At the site: {name}");
    let _ = writeln!(html, "<h4>{}</h4>", escape(&title));
    let rows = states.iter().map(|state| {
        let [rate, p] = [state.annual_rate, state.probability].map(|value| number::with_limits(value, 2));
        vec![state.words.clone(), rate, p]
    });
    answers(html, &title, &["limit state", "annual rate", &years], rows);
    if let Some(hazard) = hazard {
        let _ = writeln!(
            html,
            "<p>The hazard is <a href=\"#figure-hazard\">{}</a>.</p>",
            escape(&hazard.words())
        );
    }
    if !notes.is_empty() {
        html.push_str("<ul>\n");
        for note in notes {
            let mut letters = note.chars();
            let first = letters.next().filter(|_| !note.starts_with("p PGV"));
            let sentence = match first {
                Some(first) => first.to_uppercase().chain(letters).collect(),
                None => note.clone(),
            };
            let _ = writeln!(html, "<li>{}.</li>", escape(&sentence));
        }
        html.push_str("</ul>\n");
    }
}

/// A table whose rows stand as blocks in a narrow window.
fn answers(html: &mut String, title: &str, heads: &[&str], rows: impl Iterator<Item = Vec<String>>) {
    let _ = write!(html, "<table class=\"blocks\" aria-label=\"{}\"><thead><tr>", escape(title));
    for head in heads {
        let _ = write!(html, "<th scope=\"col\">{}</th>", escape(head));
    }
    html.push_str("</tr></thead><tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for (head, cell) in heads.iter().zip(row) {
            let _ = write!(html, "<td data-head=\"{}\">{}</td>", escape(head), escape(&cell));
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table>\n");
}

fn doubts(html: &mut String, data: &ReportData) {
    html.push_str("<p>Limits are 95 % limits of confidence. They cover the limited number of motions, not the choice of the motions, the shape of the curve, or what is not known of the structure. A lognormal curve goes to 1 and overturning does not: do not read a probability above 0.8 as that sure.</p>\n");
    let own = own_doubts(data);
    let weight = |file: &&File| {
        let stage = file.stage.as_deref().unwrap_or_default();
        BY_WEIGHT.iter().position(|(other, _)| *other == stage).unwrap_or(BY_WEIGHT.len())
    };
    let mut files: Vec<&File> = data.files.iter().filter(|file| !file.warnings.is_empty()).collect();
    files.sort_by_key(weight);
    if own.is_empty() && files.is_empty() {
        html.push_str("<p>No stage has warned of anything.</p>\n");
        return;
    }
    html.push_str("<ul class=\"doubts\">\n");
    for doubt in own {
        let _ = writeln!(html, "<li>{}</li>", escape(&doubt));
    }
    for file in files {
        let File { name, stage, warnings, .. } = file;
        let most = BY_WEIGHT.get(weight(&file)).map_or(MOST_WARNINGS, |(_, most)| *most);
        let is_same = |other: &&File| other.stage == *stage;
        let stage = match data.files.iter().filter(is_same).count() {
            ..=1 => escape(stage.as_deref().unwrap_or(name)),
            // One of several files of a stage.
            _ => escape(name),
        };
        let line = |html: &mut String, warning: &String| {
            let _ = writeln!(html, "<li><code>{stage}</code>: {}</li>", escape(warning));
        };
        let (first, others) = warnings.split_at(warnings.len().min(most));
        first.iter().for_each(|warning| line(html, warning));
        if !others.is_empty() {
            let _ = writeln!(
                html,
                "<li><details><summary>{} {}{} of <code>{stage}</code></summary><ul>",
                number::count(others.len()),
                if first.is_empty() { "" } else { "more " },
                if others.len() == 1 { "warning" } else { "warnings" }
            );
            others.iter().for_each(|warning| line(html, warning));
            html.push_str("</ul></details></li>\n");
        }
    }
    html.push_str("</ul>\n");
}

/// What speaks against the results by themselves.
fn own_doubts(data: &ReportData) -> Vec<String> {
    let mut doubts = Vec::new();
    let states = data
        .rates
        .iter()
        .flat_map(|rates| rates.states.iter().filter(|state| state.words.starts_with("LS2")));
    let mut demands: Vec<&str> = states.map(|state| without_surface(&state.words)).collect();
    demands.sort_unstable();
    demands.dedup();
    if demands.len() > 1 {
        doubts.push(format!(
            "LS2 is not the same limit state in all of these rates, so do not compare them: {}.",
            demands.join("; ")
        ));
    }
    let off: Vec<String> = data
        .summaries
        .iter()
        .filter_map(|summary| Some(format!("{} ({})", summary.name(), judgement(summary)?)))
        .collect();
    if !off.is_empty() {
        let (all, first) = (data.summaries.len(), off[..off.len().min(MOST_ROWS)].join("; "));
        let more = off.len().saturating_sub(MOST_ROWS);
        let more = if more > 0 { format!("; and {more} more") } else { String::new() };
        let advice = match data.has_few_events() && data.analyses.is_empty() {
            true => {
                " Where few motions overturn a structure, or few do not, rockfrag ida says more: it scales each motion until it does."
            }
            false => "",
        };
        doubts.push(format!(
            "The curve over p PGV/(g tan α) is missing or doubtful for {} of {all}: {first}{more}.{advice}",
            off.len()
        ));
    }
    let off = data.validations.iter().filter(|of| of.chance_p < 0.05).count();
    if off > 0 {
        doubts.push(format!(
            "Of the counts that the curves were tested on, {off} of {} are further out than chance allows at 5 %.",
            data.validations.len()
        ));
    }
    if let Some([holds, bends, fails]) = data.transfers.filter(|[_, bends, fails]| bends + fails > 0) {
        doubts.push(format!(
            "Of the curves taken to other structures, {holds} hold, {bends} bend and {fails} fail: simulate each structure of your own."
        ));
    }
    let without = data.groups.iter().flat_map(|group| &group.responses);
    let (all, without) = without
        .fold((0, 0), |(all, without), response| (all + 1, without + usize::from(response.tp_s.is_none())));
    if without > 0 && without < all {
        doubts.push(format!(
            "{} of {} responses are to motions without a pulse period Tp; figures over Tp leave them out and say how they ended.",
            number::count(without),
            number::count(all)
        ));
    }
    let regressions = || data.groups.iter().flat_map(|group| &group.univariate);
    let useless = regressions().filter(|regression| regression.r2 < USEFUL_R2).count();
    if useless > 0 {
        doubts.push(format!(
            "{useless} of {} regressions of the demand on one measure have an R² below {USEFUL_R2} and explain next to nothing: they are folded at the end.",
            regressions().count()
        ));
    }
    let not_drawn: usize = data.groups.iter().map(|group| group.not_drawn).sum();
    if not_drawn > 0 {
        let drawn: usize = data.groups.iter().map(|group| group.responses.len()).sum();
        doubts.push(format!(
            "Figures show {} of {} responses, spread over all of them; the table of outcomes counts all.",
            number::count(drawn),
            number::count(drawn + not_drawn)
        ));
    }
    if data.left_out > 0 {
        doubts.push(format!(
            "{} pairs of structure and motions are not drawn; --groups, --suite and --structure choose others.",
            number::count(data.left_out)
        ));
    }
    doubts
}

/// The words of a limit state without what gave it.
pub(super) fn without_surface(words: &str) -> &str {
    words.strip_suffix(", by the universal surface").unwrap_or(words)
}
