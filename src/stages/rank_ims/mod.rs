//! rank-ims: which intensity measures, alone and together, predict best.

pub mod verdict;

use clap::Args;
use polars::prelude::DataFrame;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::fit_pex::TransitionAt;
use super::simulate::Simulate;
use super::synthesize_motions::SynthesizeMotions;
use crate::fragility::{Case, Placed};
use crate::keyword::Keyword;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::{Parsed, Several, check, check_bound, defaults};
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::stages::shared::groups::{self, Group};
use crate::stages::shared::motions::note_passed_over;
use crate::stages::shared::uncertainty::LIMIT_STATE;
use crate::studies::{FurtherMeasure, MeasureRanking, RankingRules, RankingSample, Rating, Target};
use crate::table::motion_measures::{MotionMeasures, OwnMeasure, own_columns};
use crate::table::ranking::{RANKING, RankedCandidate, RankingRow, ReliabilityRow};
use crate::table::store::provenance::Provenance;

use crate::table::row::WriteRow;
use crate::table::store::source::{self, Source};

/// How measures are ranked.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct RankImsOptions {
    /// Limit state of P_ex: a demand |theta|max / alpha
    #[arg(long, default_value = "0.10", value_name = "DEMAND")]
    pub limit_state: f64,
    /// IM4 at which the demand breaks: a number, or found (where the pooled residual of the paper's two planes is least)
    #[arg(long, default_value = "found", value_name = "IM4")]
    pub transition: TransitionAt,
    /// Largest number of measures in a model, 1 to 3
    #[arg(long, default_value = "3", value_name = "N")]
    pub terms: usize,
    /// Largest number of cross-validation folds; each holds out whole cells of magnitude and distance, or whole earthquakes
    #[arg(long, default_value = "10", value_name = "N")]
    pub folds: usize,
    /// Further columns of --motions to rank as measures. The unit at the end of the name says how to make them dimensionless:
    /// fiv3_m_s by p v / (g tan alpha)
    #[arg(long, value_name = "COLUMN,...")]
    pub candidate: Option<Several<Parsed<OwnMeasure>>>,
}

impl Default for RankImsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for RankImsOptions {}

/// The stage, ready to run.
pub struct RankIms {
    options: RankImsOptions,
    rules: RankingRules,
    input: Source,
    motions: Option<Source>,
    out: source::Target,
}

impl RankIms {
    /// Of the responses in `input`, with the further measures of their `motions` if there are any, into the file `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(
        options: &RankImsOptions,
        input: impl Into<Source>,
        motions: Option<Source>,
        out: impl Into<source::Target>,
    ) -> anyhow::Result<RankIms> {
        let RankImsOptions { limit_state, transition, terms, folds, .. } = options.clone();
        check_bound(&LIMIT_STATE, limit_state)?;
        check((1..=3).contains(&terms), "terms", terms, "1, 2 or 3 measures")?;
        check((2..=1000).contains(&folds), "folds", folds, "2 to 1000 folds")?;
        if options.candidate.is_some() && motions.is_none() {
            return Err(UsageError::because("candidate needs the motions; name their file with --motions"));
        }
        let rules = RankingRules { folds, terms, transition: transition.im4() };
        Ok(RankIms { options: options.clone(), rules, input: input.into(), motions, out: out.into() })
    }

    /// That the candidates are there, and says which other columns are not taken.
    fn expect_columns(&self, motions: &Source, own: &[OwnMeasure], console: &Console) -> anyhow::Result<()> {
        let mut columns = own_columns(motions)?;
        for own in own.iter().map(ToString::to_string) {
            let Some(place) = columns.iter().position(|column| *column == own) else {
                let there =
                    if columns.is_empty() { "it has none of its own".into() } else { columns.join(", ") };
                let file = motions.name().display();
                return Err(UsageError::because(format!(
                    "{file}: no further column '{own}'; expected one of its own: {there}"
                )));
            };
            columns.remove(place);
        }
        note_passed_over(motions, &columns, "take them with --candidate", console);
        Ok(())
    }

    fn reliability_target(&self) -> source::Target {
        self.out.part("reliability")
    }
}

/// The measures of a group that its motions have besides those of Eq. 13.
fn further(
    group: &Group,
    placed: &[Placed],
    rows: &[usize],
    motions: &MotionMeasures,
) -> Vec<FurtherMeasure> {
    let structure = group.structure_of();
    let measures = motions.further.iter().map(|measure| FurtherMeasure {
        name: measure.name.clone(),
        ln: placed
            .iter()
            .map(|case| {
                let value = measure.values[rows[case.row]]?;
                let value = measure.quantity.dimensionless(value, &structure(case.row));
                Some(value).filter(|value| *value > 0.0).map(libm::log)
            })
            .collect(),
    });
    measures.collect()
}

/// All candidates for one target in a group.
fn rows(group: &Group, sample: RankingSample, rules: &RankingRules) -> Vec<RankedCandidate> {
    let (target, n) = (sample.target, sample.len());
    let events = sample.happened.iter().filter(|&&happened| happened).count();
    let ranking = MeasureRanking::new(sample, rules);
    let ratings = ranking.candidates.par_iter();
    let ratings = ratings.map(|candidate| ranking.rate(candidate).map(Rating::without_cases)).collect();
    let row = |ranked| RankedCandidate {
        suite: group.suite.clone(),
        structure: group.structure.clone(),
        target,
        n,
        events,
        clustered_by: group.shared.as_str(),
        ranked,
    };
    ranking.rank(ratings).into_iter().map(row).collect()
}

impl Declare for RankIms {
    type Options = RankImsOptions;
    const NAME: &'static str = RANKING.stage;
    const ABOUT: &'static str = "Rank intensity measures, alone, in pairs and triples, by how well they predict held-out cells or earthquakes

Besides im1 to im6 of the paper, the measures of --motions, made dimensionless with p and g tan alpha: p D of the \
significant durations (d5_75, d5_95); p^2 PGD / (g tan alpha) (pgd), the same of the Housner intensity (housner); \
p CAV / (g tan alpha) (cav); p times the integral of a^2 / (g tan alpha)^2 (arias); Sa / (g tan alpha) (sa_0p50 is that at \
0.5 s). Measures enter as a product, each to a power that the fit finds. PGA, PGV, Tm and Tp are those of im1 to im6.";
    const EXAMPLES: &'static str = "rockfrag rank-ims --terms 2\n\
        rockfrag rank-ims --motions motions.parquet --terms 2 --out further.parquet";
    const INPUTS: &'static [Input] = &[
        Input::file("responses", "in", Simulate::OUTPUT.file, "Responses to read"),
        Input::file(
            "motions",
            "motions",
            SynthesizeMotions::OUTPUT.file,
            "Motions of these responses, for further measures",
        )
        .if_in_run(),
    ];
    const OUTPUT: Output =
        Output::file("ranking.parquet", "Ranking to write [default: ranking.parquet beside the input]")
            .with_parts(&["reliability"]);
    const SHOWS_TABLE: bool = true;
    const HAS_PROGRESS: bool = false;

    fn create(options: &RankImsOptions, files: &Files) -> anyhow::Result<RankIms> {
        let out = files.out(Self::OUTPUT.file)?;
        RankIms::new(options, files.input("responses")?, files.optional("motions"), out)
    }
}

impl Stage for RankIms {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        let motions = self.motions.iter().map(|motions| ("motions", motions.clone()));
        [("responses", self.input.clone())].into_iter().chain(motions).collect()
    }

    fn targets(&self) -> Vec<source::Target> {
        vec![self.reliability_target(), self.out.clone()]
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn show(&self, _terminal: &Terminal) -> anyhow::Result<String> {
        self.out.path().map_or(Ok(String::new()), verdict::show)
    }

    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        self.out.path().map(verdict::shown).transpose()
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let own: Vec<OwnMeasure> =
            self.options.candidate.iter().flat_map(|Several(own)| own.iter().map(|own| own.0)).collect();
        let motions = match &self.motions {
            Some(motions) => {
                self.expect_columns(motions, &own, console)?;
                Some(MotionMeasures::read(motions, &own)?)
            }
            None => None,
        };
        // The row of the motion of each response of each group, or the first that has none.
        let mut rows_of: Vec<anyhow::Result<Vec<usize>>> = Vec::new();
        let groups = groups::read_each(&self.input, |group, response| {
            let Some(motions) = &motions else { return };
            rows_of.resize_with(rows_of.len().max(group + 1), || Ok(Vec::new()));
            if let Ok(rows) = &mut rows_of[group] {
                match motions.row(&response.motion_id.to_string(), response.pga_m_s2) {
                    Ok(row) => rows.push(row),
                    Err(error) => {
                        let of = format!("responses of '{}'", response.structure);
                        rows_of[group] = Err(error.context(of));
                    }
                }
            }
        })?;
        let mut rows_of = rows_of.into_iter();
        let mut samples: Vec<(&Group, RankingSample)> = Vec::new();
        for (group, placed) in groups.iter().zip(groups::spread(&groups, console)) {
            let rows = rows_of.next().transpose()?.unwrap_or_default();
            let further =
                motions.as_ref().map_or(Vec::new(), |motions| further(group, &placed, &rows, motions));
            let (cases, clusters): (Vec<Case>, Vec<usize>) =
                placed.iter().map(|placed| (placed.case, placed.cluster)).unzip();
            let sample = |&target: &Target| {
                let limit_state = self.options.limit_state;
                (group, RankingSample::new(target, &cases, &clusters, &further, limit_state))
            };
            samples.extend(Target::ALL.iter().map(sample));
        }
        warn(&samples, console);
        let targets = samples.len();
        let ranked: Vec<Vec<RankedCandidate>> =
            samples.into_iter().map(|(group, sample)| rows(group, sample, &self.rules)).collect();
        let reliability: Vec<ReliabilityRow> =
            ranked.iter().flatten().flat_map(RankedCandidate::reliability).collect();
        ReliabilityRow::write(&reliability, self.reliability_target(), provenance)?;
        let rows: Vec<RankingRow> = ranked.iter().flatten().map(RankingRow::from).collect();
        RankingRow::write(&rows, self.out.clone(), provenance)?;
        Ok(format!("{} models for {} targets", rows.len(), targets))
    }
}

/// Says which measures do not compete, since likelihoods are comparable on the same cases only.
fn warn(samples: &[(&Group, RankingSample)], console: &Console) {
    console.warn_each(samples.iter().flat_map(|(group, sample)| {
        sample.incomplete.iter().map(move |(name, missing)| {
            let suite = group.suite.as_deref().unwrap_or_default();
            let of = format!("{suite} {} {} ({missing})", group.structure, sample.target.as_str());
            (format!("{name} is left out, as cases are without it"), of.trim().to_string())
        })
    }));
}
