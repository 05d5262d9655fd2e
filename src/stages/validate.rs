//! validate: curves tested on responses that they were not fitted to, such as those to recorded motions.

use serde_json::{Value, json};

use super::shared::chosen_fits::ChosenFits;
use super::shared::fits::{FIT_INPUTS, FitFiles, FitsOptions};
use super::shared::groups::{self, Group};
use super::simulate::Simulate;
use crate::fragility::Event;
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output};
use crate::pipeline::stage::Stage;
use crate::pipeline::terminal::Terminal;
use crate::studies::Forecasts;
use crate::table::row::WriteRow;
use crate::table::store::contents::recorded;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::validation::{self, VALIDATION, ValidationRow};

/// The role that responses play here as in the fits.
const RESPONSES_ROLE: &str = "responses";

/// The stage, ready to run.
pub struct Validate {
    fits: FitFiles,
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
        for fits in [&self.fits.pex, &self.fits.pro] {
            // A table in memory does not say what it was made from.
            let Source::Path(path) = fits else { continue };
            let fitted_to =
                recorded(path)?.and_then(|recorded| recorded.provenance.inputs.get(RESPONSES_ROLE).cloned());
            if fitted_to.as_ref() == responses {
                console.warn(&format!(
                    "{} was fitted to the very responses of {}: that they agree proves nothing",
                    path.display(),
                    self.input.name().display()
                ));
            }
        }
        Ok(())
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
    const ABOUT: &'static str = "Test fits on responses they were not made from, such as those to records: counts seen and \
         expected, scores";
    const INPUTS: &'static [Input] = &[
        Input::file(
            RESPONSES_ROLE,
            "in",
            Simulate::OUTPUT.file,
            "Responses to hold the curves against, such as those to records",
        ),
        FIT_INPUTS[0],
        FIT_INPUTS[1],
    ];
    const OUTPUT: Output = Output::file(
        "validation.parquet",
        "Validation file to write [default: validation.parquet beside the input]",
    );

    fn create(options: &FitsOptions, files: &Files) -> anyhow::Result<Validate> {
        let (input, out) = (files.input(RESPONSES_ROLE)?, files.out(Self::OUTPUT.file));
        Ok(Validate { fits: FitFiles::new(options, files)?, input, out })
    }
}

/// All events of a group by the fits of one suite; those that cannot happen in any case are left out.
fn rows<'a>(group: &'a Group, fits: &'a ChosenFits) -> impl Iterator<Item = ValidationRow> + 'a {
    [Event::Overturning, Event::Exceeding, Event::Failure].into_iter().filter_map(|event| {
        let forecasts = Forecasts::new(&fits.model, &group.cases, event);
        Some(ValidationRow::new(
            group.suite.as_deref(),
            &group.structure,
            fits.suite.as_deref(),
            event,
            fits.model.limit,
            &forecasts.validation()?,
            forecasts.without_measure,
        ))
    })
}

impl Stage for Validate {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        let FitFiles { pex, pro, .. } = self.fits.clone();
        vec![("pex", pex), ("pro", pro), (RESPONSES_ROLE, self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        json!(self.fits.options)
    }

    fn show(&self, terminal: &Terminal) -> anyhow::Result<String> {
        self.out.path().map_or(Ok(String::new()), |out| Ok(terminal.table(&validation::show(out)?)))
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let choice = Choice(self.fits.choose_each()?);
        let groups = groups::read(&self.input)?;
        choice.warn(&groups, console);
        self.warn_of_own_responses(provenance, console)?;
        let of_structure = |fits: &&ChosenFits, structure: &str| fits.structure == structure;
        let rows: Vec<ValidationRow> = groups
            .iter()
            .flat_map(|group| {
                let fits = choice.usable().filter(move |fits| of_structure(fits, &group.structure));
                fits.flat_map(move |fits| rows(group, fits))
            })
            .collect();
        if rows.is_empty() {
            anyhow::bail!(
                "{}: nothing that the fits of {} predict; expected rocking responses of the same structures",
                self.input.name().display(),
                self.fits.pex.name().display()
            );
        }
        self.warn_of_impossible(&rows, console);
        ValidationRow::write(&rows, self.out.clone(), provenance)?;
        Ok(format!("{} counts of {} groups of responses", rows.len(), groups.len()))
    }
}
