//! universality: the curves of one structure tested on the responses of all others to the same motions.

mod words;

use clap::Args;
use polars::prelude::DataFrame;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::shared::fits::ModelForm;
use super::shared::groups::{self, Group};
use super::shared::uncertainty::LIMIT_STATE;
use super::simulate::Simulate;
use crate::fragility::{Case, Event, Measure, Placed};
use crate::keyword::Keyword;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::options::{Word, check, check_bound, defaults};
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::statistics::FitStatus;
use crate::studies::{
    CurveForm, CurveSubject, PooledFit, PooledStructure, PooledTerms, Transfer, fit_pooled,
};
use crate::table::row::WriteRow;
use crate::table::store::frame::read_frame;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;
use crate::table::universality::{POOLED, PooledRow, UNIVERSALITY, UniversalityRow};

/// Whose curves, and which.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct UniversalityOptions {
    /// Structure whose curves to transfer to all others
    #[arg(long, default_value = "electrical-equipment", value_name = "NAME")]
    pub reference: String,
    /// bivariate (two planes over im4 and im3, hybrid curve of im4 and im3_inv) or univariate
    #[arg(long, default_value = "bivariate")]
    pub model: Word<ModelForm>,
    /// Measure of the univariate model, im1 to im6 [default: im5]
    #[arg(long, value_name = "IM")]
    pub measure: Option<Word<Measure>>,
    /// IM4 at which the two planes of all structures meet
    #[arg(long, default_value = "1.3", value_name = "IM4")]
    pub transition: f64,
    /// Limit state of P_ex: a demand |theta|max / alpha
    #[arg(long, default_value = "0.10", value_name = "DEMAND")]
    pub limit_state: f64,
}

impl Default for UniversalityOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for UniversalityOptions {}

/// The stage, ready to run.
pub struct Universality {
    options: UniversalityOptions,
    form: CurveForm,
    input: Source,
    out: Target,
}

/// All structures under one suite, and where the reference stands among them.
struct SuiteOfGroups<'a> {
    groups: Vec<&'a Group>,
    /// The cases of each.
    cases: Vec<Vec<Case>>,
    /// The cell of each motion; where all share one, each is its own.
    cells: Vec<usize>,
    reference: usize,
}

/// One event under one suite.
struct Judgement {
    rows: Vec<UniversalityRow>,
    coefficients: Vec<PooledRow>,
    /// Why there is no pooled curve, and which.
    missing: Vec<(String, String)>,
}

impl Universality {
    /// Of the responses in `input`, into the file `out`.
    ///
    /// # Errors
    /// If an option is out of range, or two do not fit together.
    pub fn new(
        options: &UniversalityOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<Universality> {
        let (limit, transition) = (options.limit_state, options.transition);
        check_bound(&LIMIT_STATE, limit)?;
        check(transition > 1.0 && transition < 100.0, "transition", transition, "an IM4 above 1")?;
        let form = match (options.model.0, options.measure) {
            (form @ (ModelForm::Universal | ModelForm::Paper), _) => {
                return Err(UsageError::because(format!(
                    "model {} is none of this study; expected bivariate or univariate, whose lines are straight here",
                    form.as_str()
                )));
            }
            (ModelForm::Bivariate, Some(measure)) => {
                return Err(UsageError::because(format!("measure {measure} needs --model univariate")));
            }
            (ModelForm::Bivariate, None) => CurveForm::Hybrid { transition },
            (ModelForm::Univariate, measure) => {
                CurveForm::Scalar(measure.map_or(Measure::Im5, |word| word.0))
            }
        };
        Ok(Universality { options: options.clone(), form, input: input.into(), out: out.into() })
    }

    fn pooled_target(&self) -> Target {
        self.out.part("pooled")
    }

    fn subject(&self, event: Event) -> CurveSubject {
        CurveSubject { event, form: self.form, limit: self.options.limit_state }
    }

    /// The groups of each suite, which must have the reference and the same motions throughout.
    fn suites<'a>(
        &self,
        groups: &'a [Group],
        placed: &[Vec<Placed>],
    ) -> anyhow::Result<Vec<SuiteOfGroups<'a>>> {
        let mut names: Vec<&Option<String>> = Vec::new();
        for group in groups {
            if !names.contains(&&group.suite) {
                names.push(&group.suite);
            }
        }
        let of = |name: &Option<String>| {
            let of_suite = groups.iter().zip(placed).filter(|(group, _)| group.suite == *name);
            let (groups, placed): (Vec<&Group>, Vec<&Vec<Placed>>) = of_suite.unzip();
            let place = groups.iter().position(|group| group.structure == self.options.reference);
            let file = self.input.name().display();
            let Some(reference) = place else {
                let known: Vec<&str> = groups.iter().map(|group| group.structure.as_str()).collect();
                return Err(UsageError::because(format!(
                    "{file}: no structure '{}'; expected --reference with one of {}",
                    self.options.reference,
                    first_of(&known)
                )));
            };
            let own = &groups[reference].cases;
            if let Some(other) = groups.iter().find(|group| !group.cases.has_cells_of(own)) {
                anyhow::bail!(
                    "{file}: '{}' has responses to other motions than '{}'; expected the output of one simulate",
                    other.structure,
                    self.options.reference
                );
            }
            let cases_of = |placed: &&Vec<Placed>| placed.iter().map(|placed| placed.case).collect();
            let (cases, cells) = (placed.iter().map(cases_of).collect(), cells(placed[reference]));
            Ok(SuiteOfGroups { groups, cases, cells, reference })
        };
        let suites: Vec<SuiteOfGroups> = names.into_iter().map(of).collect::<anyhow::Result<_>>()?;
        if suites.iter().all(|suite| suite.groups.len() == 1) {
            return Err(UsageError::because(format!(
                "{}: '{}' is its only structure; expected others to test its curves on",
                self.input.name().display(),
                self.options.reference
            )));
        }
        Ok(suites)
    }

    /// Which structures have all curves, in place of a reference that has not.
    fn other_references(&self, suites: &[SuiteOfGroups]) -> String {
        let has_curves = |structure: &str| {
            let is_there = |suite: &SuiteOfGroups, event| {
                let place = suite.groups.iter().position(|group| group.structure == structure);
                place.is_some_and(|place| self.subject(event).fit(&suite.cases[place]).is_ok())
            };
            suites.iter().all(|suite| Event::BRANCHES.iter().all(|event| is_there(suite, *event)))
        };
        let names = suites[0].groups.iter().map(|group| group.structure.as_str());
        match names.filter(|name| has_curves(name)).collect::<Vec<_>>()[..] {
            [] => "no structure has all curves: expected responses to more motions, or to stronger ones"
                .to_string(),
            ref known => format!("expected --reference with one of {}", first_of(known)),
        }
    }

    /// Compares all structures with the reference.
    fn judge(
        &self,
        suites: &[SuiteOfGroups],
        suite: &SuiteOfGroups,
        event: Event,
    ) -> anyhow::Result<Judgement> {
        let (subject, reference) = (self.subject(event), suite.groups[suite.reference]);
        let pooled = pooled(&subject, suite);
        let row = |(k, group): (usize, &&Group)| {
            let transfer =
                Transfer::new(&subject, &suite.cases[suite.reference], &suite.cases[k], &suite.cells)
                    .map_err(|status| {
                        anyhow::anyhow!(
                            "{}: the curve of {} of '{}' is {}; {}",
                            self.input.name().display(),
                            event.as_str(),
                            reference.structure,
                            status.as_str(),
                            self.other_references(suites)
                        )
                    })?;
            let log_score = |fit: &Result<PooledFit, FitStatus>| fit.as_ref().ok()?.log_scores[k];
            let log_scores = [0, 1, 2, 3].map(|terms: usize| log_score(&pooled[terms]));
            let (suite, structure) = (group.suite.as_deref(), group.structure());
            Ok(transfer.map(|transfer| {
                let (reference, limit) = (&reference.structure, subject.limit);
                UniversalityRow::new(suite, &structure, reference, event, limit, &transfer, log_scores)
            }))
        };
        let rows: Vec<Option<UniversalityRow>> =
            suite.groups.par_iter().enumerate().map(row).collect::<anyhow::Result<_>>()?;
        let (mut coefficients, mut missing) = (Vec::new(), Vec::new());
        for (&terms, fit) in PooledTerms::ALL.iter().zip(&pooled) {
            match fit {
                Ok(fit) => coefficients.extend(fit.parts.iter().flat_map(|part| {
                    part.terms.iter().map(|term| PooledRow {
                        suite: reference.suite.clone(),
                        event,
                        terms,
                        range_low: Some(part.range.start),
                        range_high: Some(part.range.end),
                        term: term.name.clone(),
                        coefficient: term.coefficient,
                        standard_error: term.standard_error,
                        beta: part.residual_sd,
                        n: part.n,
                    })
                })),
                Err(status) => missing.push((
                    format!("no pooled curve, {}", status.as_str()),
                    format!("{} of {}", terms.as_str(), event.as_str()),
                )),
            }
        }
        Ok(Judgement { rows: rows.into_iter().flatten().collect(), coefficients, missing })
    }
}

/// The first of these names, and how many more there are.
fn first_of(names: &[&str]) -> String {
    const MOST: usize = 20;
    let first = names[..names.len().min(MOST)].join(", ");
    if names.len() > MOST { format!("{first} and {} more", names.len() - MOST) } else { first }
}

fn cells(placed: &[Placed]) -> Vec<usize> {
    let cells: Vec<usize> = placed.iter().map(|placed| placed.cell).collect();
    let one_cell = cells.iter().all(|&cell| cell == cells[0]);
    if one_cell { (0..cells.len()).collect() } else { cells }
}

/// The curves of all structures of a suite, of each of [`PooledTerms::ALL`].
fn pooled<'a, 'c>(subject: &CurveSubject, suite: &'c SuiteOfGroups<'a>) -> Vec<Result<PooledFit, FitStatus>> {
    let reference = suite.groups[suite.reference];
    let of_reference = reference.structure();
    let beside_reference = |(group, cases): (&&'a Group, &'c Vec<Case>)| {
        let structure = group.structure();
        PooledStructure {
            cases,
            ln_p: libm::log(structure.p_rad_s / of_reference.p_rad_s),
            ln_alpha: libm::log(structure.alpha_rad / of_reference.alpha_rad),
            eta: group.eta - reference.eta,
        }
    };
    let structures: Vec<PooledStructure> =
        suite.groups.iter().zip(&suite.cases).map(beside_reference).collect();
    PooledTerms::ALL.par_iter().map(|&terms| fit_pooled(subject, &structures, terms)).collect()
}

impl Declare for Universality {
    type Options = UniversalityOptions;
    const NAME: &'static str = UNIVERSALITY.stage;
    const ABOUT: &'static str =
        "Test the curves of one structure on the responses of all others to the same motions";
    const EXAMPLES: &'static str = "rockfrag universality --reference electrical-equipment";
    const INPUTS: &'static [Input] =
        &[Input::file("responses", "in", Simulate::OUTPUT.file, "Responses of all structures to read")];
    const OUTPUT: Output = Output::file(
        "universality.parquet",
        "File to write [default: universality.parquet beside the input]",
    )
    .with_parts(&["pooled"]);
    const SHOWS_TABLE: bool = true;
    const HAS_PROGRESS: bool = false;

    fn create(options: &UniversalityOptions, files: &Files) -> anyhow::Result<Universality> {
        Universality::new(options, files.input("responses")?, files.out(Self::OUTPUT.file)?)
    }
}

impl Stage for Universality {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("responses", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.pooled_target(), self.out.clone()]
    }

    fn parameters(&self) -> Value {
        json!(self.options)
    }

    fn show(&self, _terminal: &Terminal) -> anyhow::Result<String> {
        self.out.path().map_or(Ok(String::new()), words::show)
    }

    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        Ok(self.out.path().map(|out| read_frame(out, &UNIVERSALITY)).transpose()?)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let suites = self.suites(&groups, &groups::spread(&groups, console))?;
        let mut structures = 0;
        let mut writer = TableWriter::create(self.out.clone(), &UNIVERSALITY, provenance.clone())?;
        let mut pooled_writer = TableWriter::create(self.pooled_target(), &POOLED, provenance.clone())?;
        for suite in &suites {
            structures = structures.max(suite.groups.len());
            for event in Event::BRANCHES {
                let Judgement { rows, coefficients, missing } = self.judge(&suites, suite, event)?;
                console.warn_each(missing.into_iter());
                writer.append(&UniversalityRow::batch(&rows)?)?;
                pooled_writer.append(&PooledRow::batch(&coefficients)?)?;
            }
        }
        pooled_writer.finish()?;
        writer.finish()?;
        Ok(format!("{structures} structures under {} suite(s)", suites.len()))
    }
}
