//! validate: curves tested on responses that they were not fitted to, such as those to recorded motions.

use polars::prelude::DataFrame;
use serde_json::{Value, json};

use super::shared::chosen_fits::ChosenFits;
use super::shared::fits::{FIT_INPUTS, FitFiles, FitsOptions, ModelForm};
use super::shared::groups::{self, Group};
use super::shared::surface::{PAPER_LIMIT, Surface};
use super::simulate::Simulate;
use crate::fragility::Event;
use crate::fragility::universal::Scenarios;
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output};
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::studies::Forecasts;
use crate::table::row::WriteRow;
use crate::table::store::contents::recorded;
use crate::table::store::frame::read_frame;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::validation::{self, VALIDATION, ValidationRow};

/// The role that responses play here as in the fits.
const RESPONSES_ROLE: &str = "responses";

/// The stage, ready to run.
pub struct Validate {
    /// The fits; without them the surface that is shipped.
    fits: Option<FitFiles>,
    options: FitsOptions,
    input: Source,
    out: Target,
}

/// The fits of each suite and structure that are asked for, or why there are none.
struct Choice(Vec<anyhow::Result<ChosenFits>>);

impl Choice {
    fn usable(&self) -> impl Iterator<Item = &ChosenFits> {
        self.0.iter().filter_map(|fits| fits.as_ref().ok())
    }

    fn warn(&self, groups: &[Group], console: &Console) {
        for why in self.0.iter().filter_map(|fits| fits.as_ref().err()) {
            console.warn(&format!("left out: {why}"));
        }
        for group in groups {
            let mut of_structure = self.usable().filter(|fits| fits.structure == group.structure).peekable();
            if of_structure.peek().is_none() {
                console.warn(&format!("no fits of structure '{}': left out", group.structure));
            } else if of_structure.any(|fits| fits.is_other_eta(group.eta)) {
                let Group { structure, eta, .. } = group;
                console.warn(&format!("{structure} has eta {eta:.4}, and fits that depend on another one"));
            }
        }
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
                    "{} was fitted to these responses, {}: that they agree proves nothing",
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
        provenance: &Provenance,
        console: &Console,
    ) -> anyhow::Result<Vec<ValidationRow>> {
        let choice = Choice(fits.choose_each()?);
        choice.warn(groups, console);
        self.warn_of_own_responses(provenance, console)?;
        let of_group = |group: &Group| -> Vec<ValidationRow> {
            let fits = choice.usable().filter(|fits| fits.structure == group.structure);
            fits.flat_map(|fits| rows(group, fits)).collect()
        };
        Ok(groups.iter().flat_map(of_group).collect())
    }

    /// Of each group, as motions of the suite that is asked for, or of its own; combined ones where that is none of the surface.
    fn by_surface(&self, groups: &[Group]) -> anyhow::Result<Vec<ValidationRow>> {
        let asked = self.options.suite.as_deref();
        let mut rows = Vec::new();
        for group in groups {
            let surface = match asked {
                Some(_) => Surface::new(asked, None, Scenarios::One)?,
                None => Surface::beside(group.suite.as_deref(), PAPER_LIMIT, Scenarios::One),
            };
            let structure = group.structure_of();
            for event in EVENTS {
                let forecasts = Forecasts::by_surface(&surface.0, &group.cases, event, &structure);
                rows.extend(row(group, Some(surface.0.motions.as_str()), event, surface.0.limit, &forecasts));
            }
        }
        Ok(rows)
    }

    /// Warns if something happened which the curves hold impossible.
    fn warn_of_impossible(&self, rows: &[ValidationRow], console: &Console) {
        for ValidationRow { structure, fits_suite, event, n, impossible, .. } in rows {
            if *impossible > 0 {
                console.warn(&format!(
                    "{structure}: what happened in {} of {} cases has a probability of 0 by the curves of {} \
                     for {}: the log score is minus infinity (null)",
                    impossible,
                    n,
                    fits_suite.as_deref().unwrap_or("no suite"),
                    event.as_str()
                ));
            }
        }
    }
}

impl Declare for Validate {
    type Options = FitsOptions;
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

    fn create(options: &FitsOptions, files: &Files) -> anyhow::Result<Validate> {
        let (input, out) = (files.input(RESPONSES_ROLE)?, files.out(Self::OUTPUT.file)?);
        Ok(Validate { fits: FitFiles::if_asked(options, files)?, options: options.clone(), input, out })
    }
}

const EVENTS: [Event; 3] = [Event::Overturning, Event::Exceeding, Event::Failure];

/// All events of a group by the fits of one suite; those that cannot happen in any case are left out.
fn rows<'a>(group: &'a Group, fits: &'a ChosenFits) -> impl Iterator<Item = ValidationRow> + 'a {
    // Many magnitudes and distances: the limits are of the fits.
    let model = fits.model.over_many_cells();
    EVENTS.into_iter().filter_map(move |event| {
        let forecasts = Forecasts::new(&model, &group.cases, event);
        row(group, fits.suite.as_deref(), event, model.limit, &forecasts)
    })
}

fn row(
    group: &Group,
    suite: Option<&str>,
    event: Event,
    limit: f64,
    forecasts: &Forecasts,
) -> Option<ValidationRow> {
    Some(ValidationRow::new(
        group.suite.as_deref(),
        &group.structure,
        suite,
        event,
        limit,
        &forecasts.validation()?,
        forecasts.without_measure,
    ))
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
        match &self.fits {
            Some(fits) => json!(fits.options),
            None => json!({ "model": ModelForm::Universal.as_str(), "suite": self.options.suite }),
        }
    }

    fn show(&self, terminal: &Terminal) -> anyhow::Result<String> {
        self.out.path().map_or(Ok(String::new()), |out| Ok(terminal.table(&validation::show(out)?)))
    }

    fn rows(&self) -> anyhow::Result<Option<DataFrame>> {
        Ok(self.out.path().map(|out| read_frame(out, &VALIDATION)).transpose()?)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        let (rows, by) = match &self.fits {
            Some(fits) => (self.by_fits(fits, &groups, provenance, console)?, ""),
            None => (self.by_surface(&groups)?, " by the universal surface"),
        };
        if rows.is_empty() {
            anyhow::bail!(
                "{}: nothing that the fits predict; expected rocking responses of the same structures",
                self.input.name().display()
            );
        }
        self.warn_of_impossible(&rows, console);
        ValidationRow::write(&rows, self.out.clone(), provenance)?;
        Ok(format!("{} counts of {} groups of responses{by}", rows.len(), groups.len()))
    }
}
