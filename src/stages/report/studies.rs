//! What other stages have left in the folder: annual rates, incremental dynamic analyses, validations, rankings.

use std::path::Path;

use serde_json::Value;

use crate::keyword::{self, Keyword};
use crate::report::data::{
    Analysis, By, Hazard, Level, PeakCurve, Ranking, Rates, StateRate, Validated, name_of,
};
use crate::stages::shared::structures::StructureSpec;
use crate::studies::{Target, Verdict};
use crate::table::evaluated::{AnnualRate, RecordedCurve, RecordedHazard};
use crate::table::ida::{Lognormal, Share};
use crate::table::ranking::RankingRow;
use crate::table::row::ReadRow;
use crate::table::store::contents::{footer, recorded};
use crate::table::store::folder;
use crate::table::universality::UniversalityRow;
use crate::table::validation::ValidationRow;

/// Whether a file of evaluate holds annual rates, rather than probabilities of many motions.
pub fn are_rates(path: &Path) -> bool {
    footer(path).is_ok_and(|footer| footer.schema.field_with_name("annual_rate").is_ok())
}

/// The annual rates of a file, or of each in a folder.
pub fn rates(path: &Path) -> anyhow::Result<Vec<Rates>> {
    folder::files(path)?.iter().map(|file| rates_of(file)).collect()
}

/// Parameters of a structure, with what stands before and after each.
const OF_STRUCTURE: [(&str, &str, &str); 6] = [
    ("name", "", ""),
    ("p", "p = ", " rad/s"),
    ("alpha", "α = ", " rad"),
    ("width", "", " m wide"),
    ("height", "", " m high"),
    ("eta", "η = ", ""),
];

fn rates_of(file: &Path) -> anyhow::Result<Rates> {
    let rows = AnnualRate::read(file)?;
    let (parameters, shown) = recorded(file)?.map_or((Value::Null, Value::Null), |recorded| {
        (recorded.provenance.parameters, recorded.provenance.shown)
    });
    let words = |of: &Value, parts: &[(&str, &str, &str)]| {
        let given = parts.iter().filter_map(|(key, before, after)| {
            let value = of.get(key).filter(|value| !value.is_null())?;
            let text = || {
                value.as_f64().map_or(value.to_string(), |number| ((number * 1e4).round() / 1e4).to_string())
            };
            Some(format!("{before}{}{after}", value.as_str().map_or_else(text, str::to_string)))
        });
        given.collect::<Vec<_>>().join(", ")
    };
    let structure = words(&parameters["structure"], &OF_STRUCTURE);
    let fits = match parameters.get("fits") {
        Some(fits) if fits["structure"].is_null() && fits["suite"].is_null() => {
            "the fits of the folder".to_string()
        }
        Some(fits) => words(fits, &[("structure", "fits of ", ""), ("suite", "", "")]),
        None => words(&parameters, &[("model", "the ", " surface"), ("suite", "", "")]),
    };
    let state = |row: &AnnualRate| StateRate {
        words: format!("{} {}", row.state.as_str(), row.meaning.replace("|theta|max / alpha", "|θ|max/α")),
        annual_rate: [Some(row.annual_rate), row.annual_rate_low, row.annual_rate_high]
            .map(|rate| rate.unwrap_or(f64::NAN)),
        probability: [Some(row.p), row.p_low, row.p_high].map(|p| p.unwrap_or(f64::NAN)),
    };
    let shown: Option<RecordedHazard> = serde_json::from_value(shown).ok();
    let spec: Option<StructureSpec> = serde_json::from_value(parameters["structure"].clone()).ok();
    let friction = spec.and_then(|spec| spec.structure_with_eta(1.0).ok());
    let friction = friction.map(|structure| format!("the structure {}", structure.words_of_friction()));
    Ok(Rates {
        name: format!("{structure}; by {fits}"),
        by: if parameters.get("fits").is_none() && !parameters.is_null() { By::Surface } else { By::Fits },
        notes: shown.iter().flat_map(|shown| shown.notes.clone()).chain(friction).collect(),
        years: rows.first().map_or(f64::NAN, |row| row.years),
        states: rows.iter().map(state).collect(),
        hazard: shown.map(hazard),
    })
}

fn hazard(RecordedHazard { file, rows, curves, .. }: RecordedHazard) -> Hazard {
    let curve =
        |RecordedCurve { peak, points }| Some(PeakCurve { peak: keyword::parse(&peak).ok()?, points });
    Hazard { file, rows, curves: curves.into_iter().filter_map(curve).collect() }
}

/// The shares of an analysis, by suite and structure, with the medians in the file of fragility beside it.
pub fn analyses(shares: &Path, fragility: Option<&Path>) -> anyhow::Result<Vec<Analysis>> {
    let fits = fragility.map(Lognormal::read).transpose()?.unwrap_or_default();
    let mut analyses: Vec<Analysis> = Vec::new();
    for row in Share::read(shares)? {
        let name = name_of(&row.structure, row.suite.as_deref());
        let level = Level {
            intensity: row.intensity,
            n: row.n,
            share: [row.share, row.share_low, row.share_high],
            lognormal: row.lognormal,
        };
        if let Some(last) = analyses.last_mut().filter(|last| last.name == name) {
            last.levels.push(level);
            continue;
        }
        let is_its = |fit: &&Lognormal| fit.suite == row.suite && fit.structure == row.structure;
        let fit = fits.iter().find(is_its);
        let theta = fit.and_then(|fit| Some([fit.theta?, fit.theta_low?, fit.theta_high?]));
        let beta = fit.and_then(|fit| Some([fit.beta?, fit.beta_low?, fit.beta_high?]));
        let censored = fit.map_or([0, 0], |fit| [fit.n_safe, fit.n_below]);
        analyses.push(Analysis { name, measure: row.measure, levels: vec![level], theta, beta, censored });
    }
    Ok(analyses)
}

/// What was seen and expected, row by row.
pub fn validations(path: &Path) -> anyhow::Result<Vec<Validated>> {
    let validated = |row: &ValidationRow| {
        let share = |count: f64| count / row.n as f64;
        Validated {
            name: format!("{}: {}", name_of(&row.structure, row.suite.as_deref()), row.event.as_str()),
            n: row.n,
            seen: [row.share, row.share_low, row.share_high],
            expected: [share(row.expected), share(row.expected_low), share(row.expected_high)],
            chance_p: row.chance_p,
        }
    };
    Ok(ValidationRow::read(path)?.iter().map(validated).collect())
}

/// The candidates that stand out, by suite, structure and target.
pub fn rankings(path: &Path) -> anyhow::Result<Vec<Ranking>> {
    let mut rankings: Vec<Ranking> = Vec::new();
    for row in RankingRow::read(path)? {
        let (Some(choice), Some(gain), Some(error)) = (&row.choice, row.over_paper, row.se_over_paper) else {
            continue;
        };
        if row.terms == 0 {
            continue;
        }
        let name = name_of(&row.structure, row.suite.as_deref());
        let name = match row.target {
            Target::Demand => format!("{name}: demand"),
            Target::Overturning => format!("{name}: overturning"),
        };
        let candidate = (format!("{} ({choice})", row.measures), gain, error);
        match rankings.iter_mut().find(|ranking| ranking.name == name) {
            Some(ranking) => ranking.candidates.push(candidate),
            None => rankings.push(Ranking { name, candidates: vec![candidate] }),
        }
    }
    Ok(rankings)
}

/// How many curves hold, bend and fail on other structures.
pub fn transfers(path: &Path) -> anyhow::Result<[usize; 3]> {
    let rows = UniversalityRow::read(path)?;
    let count = |verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    Ok([Verdict::Holds, Verdict::Bends, Verdict::Fails].map(count))
}
