//! validate: curves tested on responses that they were not fitted to, such as those to recorded motions; with a hazard, annual
//! rates counted without any curve.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Args;
use polars::prelude::DataFrame;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::shared::chosen_fits::ChosenFits;
use super::shared::counts::{self, COUNTED, RESPONSES_ROLE};
use super::shared::fits::{FIT_INPUTS, FitFiles, FitsOptions, ModelForm};
use super::shared::groups::{self, Group};
use super::shared::hazard::{self, Hazard};
use super::shared::surface::{PAPER_LIMIT, Surface};
use super::simulate::Simulate;
use crate::fragility::universal::Scenarios;
use crate::fragility::{Event, Peak, Placed, Probabilities};
use crate::hazard::{Count, CountedRate, HazardCurve};
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output, StageOptions};
use crate::pipeline::files::hash;
use crate::pipeline::options::{Parsed, defaults};
use crate::pipeline::stage::{Stage, content_of_role, places};
use crate::pipeline::terminal::Terminal;
use crate::studies::Forecasts;
use crate::table::TableError;
use crate::table::fits::GroupKey;
use crate::table::ida::IDA_STRIPES;
use crate::table::row::WriteRow;
use crate::table::schema::headings::Headings;
use crate::table::store::contents::recorded;
use crate::table::store::frame::read_frame;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::validation::{self, VALIDATION, ValidationRow};

/// Which fits, and a hazard.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub struct ValidateOptions {
    #[command(flatten)]
    #[serde(flatten)]
    pub fits: FitsOptions,
    /// CSV file of a hazard curve of PGA or PGV, as evaluate reads it: the annual rates are also counted in the motions, weighted to
    /// follow the curve, for comparison with those of the fits
    #[arg(long, value_name = "FILE", help_heading = "Hazard of a site")]
    pub hazard: Option<PathBuf>,
    /// Which headings of the file of --hazard stand for which columns, as pga_g=PGA,annual_rate_of_exceedance=rate
    #[arg(long, value_name = "COLUMN=HEADING,...", requires = "hazard", help_heading = "Hazard of a site")]
    pub columns: Option<Parsed<Headings>>,
}

impl Default for ValidateOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for ValidateOptions {
    fn resolve_paths(&mut self, folder: &Path) {
        if let Some(hazard) = &mut self.hazard {
            *hazard = folder.join(&*hazard);
        }
    }
}

/// A hazard of one peak.
type Curve = (Peak, HazardCurve);

/// The stage, ready to run.
pub struct Validate {
    /// The fits; without them the surface that is shipped.
    fits: Option<FitFiles>,
    options: ValidateOptions,
    input: Source,
    out: Target,
}

/// The fits of each suite and structure that are asked for, or why there are none.
struct Choice(Vec<(GroupKey, anyhow::Result<ChosenFits>)>);

impl Choice {
    fn usable(&self) -> impl Iterator<Item = &ChosenFits> {
        self.0.iter().filter_map(|(_, fits)| fits.as_ref().ok())
    }

    fn warn(&self, groups: &[Group], console: &Console) {
        let named = |suite: &Option<String>, structure: &str| {
            suite.as_ref().map_or(structure.to_string(), |suite| format!("{suite}, {structure}"))
        };
        let unusable = self.0.iter().filter_map(|((suite, structure), fits)| {
            Some((format!("fits left out, {}", fits.as_ref().err()?), named(suite, structure)))
        });
        let of_group = |group: &Group| {
            let Group { suite, structure, eta, .. } = group;
            let mut of_structure = self.usable().filter(|fits| fits.structure == *structure).peekable();
            let name = named(suite, structure);
            if of_structure.peek().is_none() {
                let are_told = self.0.iter().any(|((_, structure), _)| structure == &group.structure);
                let reason = "responses left out, since no fits are of their structure".to_string();
                return (!are_told).then_some((reason, name));
            }
            let is_other = of_structure.any(|fits| fits.is_other_eta(*eta));
            is_other
                .then(|| ("these have another eta than their fits".to_string(), format!("{name} ({eta:.4})")))
        };
        console.warn_of_many(unusable.chain(groups.iter().filter_map(of_group)));
    }
}

impl Validate {
    /// Warns if the curves were fitted to the responses they are tested on.
    fn warn_of_own_responses(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<()> {
        let responses = provenance.inputs.get(RESPONSES_ROLE);
        for (_, fits) in self.fits.iter().flat_map(FitFiles::inputs) {
            // A table in memory does not say what it was made from.
            let Source::Path(path) = fits else { continue };
            let fitted_to =
                recorded(&path)?.and_then(|recorded| recorded.provenance.inputs.get(RESPONSES_ROLE).cloned());
            if fitted_to.as_ref() == responses {
                console.warn(&format!(
                    "{} was fitted to these responses, {}: agreement proves nothing",
                    path.display(),
                    self.input.name().display()
                ));
            }
        }
        Ok(())
    }

    fn by_fits(
        &self,
        fits: &FitFiles,
        groups: &[Group],
        curve: Option<&Curve>,
        provenance: &Provenance,
        console: &Console,
    ) -> anyhow::Result<Vec<ValidationRow>> {
        let choice = Choice(fits.choose_each()?);
        choice.warn(groups, console);
        self.warn_of_own_responses(provenance, console)?;
        let of_group = |group: &Group| -> Vec<ValidationRow> {
            let fits = choice.usable().filter(|fits| fits.structure == group.structure);
            fits.flat_map(|fits| rows(group, fits, curve)).collect()
        };
        Ok(groups.iter().flat_map(of_group).collect())
    }

    /// Of each group, as motions of the suite that is asked for, or of its own; combined ones where that is none of the surface.
    fn by_surface(&self, groups: &[Group], curve: Option<&Curve>) -> anyhow::Result<Vec<ValidationRow>> {
        let asked = self.options.fits.suite.as_deref();
        let mut rows = Vec::new();
        for group in groups {
            let surface = match asked {
                Some(_) => Surface::new(asked, None, Scenarios::One)?,
                None => Surface::beside(group.suite.as_deref(), PAPER_LIMIT, Scenarios::One),
            };
            let structure = group.structure_of();
            let probabilities =
                |case: &Placed| surface.0.probabilities(&structure(case.row), &case.case.measures);
            let count = curve.and_then(|curve| count(group, curve, surface.0.limit, probabilities));
            for event in EVENTS {
                let forecasts = Forecasts::by_surface(&surface.0, &group.cases, event, &structure);
                rows.extend(row(
                    group,
                    Some(surface.0.motions.as_str()),
                    event,
                    surface.0.limit,
                    &forecasts,
                    count.as_ref(),
                ));
            }
        }
        Ok(rows)
    }

    /// The hazard that rates are counted for.
    fn curve(&self) -> anyhow::Result<Option<Curve>> {
        let Some(path) = &self.options.hazard else { return Ok(None) };
        let headings = self.options.columns.clone().map_or(Headings::default(), |Parsed(headings)| headings);
        match hazard::read(path, &headings)? {
            Hazard::Curve(peak, curve) => Ok(Some((peak, curve))),
            Hazard::Joint(_) => bail!(
                "{}: a joint hazard; expected one of PGA or of PGV, by which the motions are weighted",
                path.display()
            ),
        }
    }

    /// Warns where the curves have a rate that a count excludes.
    fn warn_of_rates(rows: &[ValidationRow], console: &Console) {
        let off = rows.iter().filter(|row| row.rates_agree() == Some(false)).map(|row| {
            let [counted, low, high, expected] =
                [row.counted_rate, row.counted_rate_low, row.counted_rate_high, row.expected_rate]
                    .map(|rate| rate.unwrap_or(f64::NAN));
            let rates = format!("{expected:.1e}, counted {counted:.1e} ({low:.1e} to {high:.1e})");
            let reason = "the curves have other annual rates at these motions than a count of them";
            (reason.to_string(), format!("{} {rates}", subject(row)))
        });
        console.warn_of_many(off);
    }

    /// Warns if something happened to which the curves give no chance.
    fn warn_of_impossible(rows: &[ValidationRow], console: &Console) {
        let impossible = rows.iter().filter(|row| row.impossible > 0).map(|row| {
            let reason = "what happened has a probability of 0 by the curves, and the log score is minus infinity (null)";
            (reason.to_string(), format!("{} in {} of {} cases", subject(row), row.impossible, row.n))
        });
        console.warn_of_many(impossible);
    }
}

impl Declare for Validate {
    type Options = ValidateOptions;
    const NAME: &'static str = VALIDATION.stage;
    const ABOUT: &'static str = "Test fits on responses they were not fitted to, such as those to records: observed and \
         expected counts, scores";
    const EXAMPLES: &'static str =
        "rockfrag validate --in responses.parquet --pex pex.parquet --pro pro.parquet";
    const HELPS: &'static [(&'static str, &'static str)] = &[
        ("suite", "Suite of the fits [default: all]"),
        ("structure", "Structure of the fits [default: all]"),
    ];
    const INPUTS: &'static [Input] = &[
        Input::file(
            RESPONSES_ROLE,
            "in",
            Simulate::OUTPUT.file,
            "Responses to test the fits on, such as those to records",
        ),
        FIT_INPUTS[0].if_there(),
        FIT_INPUTS[1].if_there(),
    ];
    const OUTPUT: Output = Output::file(
        "validation.parquet",
        "Validation file to write [default: validation.parquet beside the input]",
    );
    const SHOWS_TABLE: bool = true;
    const HAS_PROGRESS: bool = false;

    fn create(options: &ValidateOptions, files: &Files) -> anyhow::Result<Validate> {
        let (input, out) = (files.input(RESPONSES_ROLE)?, files.out(Self::OUTPUT.file)?);
        Ok(Validate { fits: FitFiles::if_asked(&options.fits, files)?, options: options.clone(), input, out })
    }
}

/// What a row is about.
fn subject(ValidationRow { structure, fits_suite, event, .. }: &ValidationRow) -> String {
    format!(
        "{structure}, {} by the curves of {}",
        event.as_str(),
        fits_suite.as_deref().unwrap_or("no suite")
    )
}

const EVENTS: [Event; 3] = [Event::Overturning, Event::Exceeding, Event::Failure];

/// All events of a group by the fits of one suite; those that cannot happen in any case are left out.
fn rows<'a>(
    group: &'a Group,
    fits: &'a ChosenFits,
    curve: Option<&Curve>,
) -> impl Iterator<Item = ValidationRow> + 'a {
    // Many magnitudes and distances: the limits are of the fits.
    let model = fits.model.over_many_cells();
    let probabilities = |case: &Placed| model.probabilities(&case.case.measures);
    let count = curve.and_then(|curve| count(group, curve, model.limit, probabilities));
    EVENTS.into_iter().filter_map(move |event| {
        let forecasts = Forecasts::new(&model, &group.cases, event);
        row(group, fits.suite.as_deref(), event, model.limit, &forecasts, count.as_ref())
    })
}

/// What is counted of each of [`COUNTED`], and then what the curves expect of each.
fn count(
    group: &Group,
    (peak, curve): &Curve,
    limit: f64,
    probabilities: impl Fn(&Placed) -> Probabilities,
) -> Option<Count<4>> {
    counts::count(group, *peak, curve, |case| {
        let [_, failure, overturning] = probabilities(case).limit_states()?;
        let [failed, overturned] = counts::happened(case, limit);
        Some([failed, overturned, failure.value, overturning.value])
    })
}

fn row(
    group: &Group,
    suite: Option<&str>,
    event: Event,
    limit: f64,
    forecasts: &Forecasts,
    count: Option<&Count<4>>,
) -> Option<ValidationRow> {
    let rates = COUNTED.iter().position(|counted| *counted == event).zip(count).map(|(at, count)| {
        let CountedRate { value: expected, .. } = count.rates[COUNTED.len() + at];
        (count.rates[at], expected)
    });
    let row = ValidationRow::new(
        group.suite.as_deref(),
        &group.structure,
        suite,
        event,
        limit,
        &forecasts.validation()?,
        forecasts.without_measure,
    );
    Some(match rates {
        Some((counted, expected)) => row.with_rates(counted, expected),
        None => row,
    })
}

impl Stage for Validate {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        let fits = self.fits.iter().flat_map(FitFiles::inputs);
        fits.chain([(RESPONSES_ROLE, self.input.clone())]).collect()
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let mut parameters = match &self.fits {
            Some(fits) => json!(fits.options),
            None => json!({ "model": ModelForm::Universal.as_str(), "suite": self.options.fits.suite }),
        };
        if let Some(columns) = &self.options.columns {
            parameters["columns"] = json!(columns);
        }
        parameters
    }

    fn provenance(&self) -> anyhow::Result<Provenance> {
        let sources = self.inputs();
        let content =
            |(role, source): &(&str, Source)| Ok((role.to_string(), content_of_role(role, source)?));
        let mut inputs = sources.iter().map(content).collect::<Result<BTreeMap<_, _>, TableError>>()?;
        if let Some(hazard) = &self.options.hazard {
            inputs.insert("hazard".to_string(), hash(hazard).with_context(|| hazard.display().to_string())?);
        }
        Ok(Provenance::new(Self::NAME, self.parameters(), inputs).of_sources(places(&sources)))
    }

    fn show(&self, terminal: &Terminal) -> anyhow::Result<String> {
        self.out.path().map_or(Ok(String::new()), |out| Ok(terminal.table(&validation::show(out)?)))
    }

    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        Ok(self.out.path().map(|out| read_frame(out, &VALIDATION)).transpose()?)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let curve = self.curve()?;
        let curve = curve.as_ref();
        let groups = groups::read(&self.input)?;
        let (rows, by) = match &self.fits {
            Some(fits) => (self.by_fits(fits, &groups, curve, provenance, console)?, ""),
            None => (self.by_surface(&groups, curve)?, " by the universal surface"),
        };
        if rows.is_empty() {
            anyhow::bail!(
                "{}: nothing that the fits predict; expected rocking responses of the same structures, and fits that can be used",
                self.input.name().display()
            );
        }
        if let Source::Path(path) = &self.input
            && recorded(path)?.is_some_and(|made| made.provenance.stage == IDA_STRIPES.stage)
        {
            console.warn(
                "these are stripes of ida, in which each motion counts once a level: cases are not independent, and limits of counts too narrow",
            );
        }
        Self::warn_of_impossible(&rows, console);
        Self::warn_of_rates(&rows, console);
        ValidationRow::write(&rows, self.out.clone(), provenance)?;
        let rates: Vec<bool> = rows.iter().filter_map(ValidationRow::rates_agree).collect();
        let agree = match rates.len() {
            0 => String::new(),
            all => format!(
                ", {} of {all} annual rates agree with those counted",
                rates.iter().filter(|agree| **agree).count()
            ),
        };
        Ok(format!("{} counts of {} groups of responses{by}{agree}", rows.len(), groups.len()))
    }
}
