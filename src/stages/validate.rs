//! validate: curves held against responses that they were not fitted to, such as those to recorded motions.

use std::path::PathBuf;

use clap::Args;
use serde_json::{Value, json};

use super::chosen_fits::ChosenFits;
use super::fits::FitsOptions;
use super::groups::{self, Group};
use crate::fragility::Event;
use crate::keyword::Keyword;
use crate::pipeline::console::Console;
use crate::pipeline::stage::Stage;
use crate::studies::{Forecasts, Validation};
use crate::table::provenance::{Provenance, stamp};
use crate::table::row::WriteRow;
use crate::table::source::{Source, Target};
use crate::table::validation::{VALIDATION, ValidationRow};

/// Which curves, against which responses.
#[derive(Debug, Clone, Args)]
pub struct ValidateOptions {
    /// Responses to hold the curves against, such as those to records
    #[arg(long = "in", value_name = "FILE", default_value = "responses.parquet")]
    pub input: PathBuf,
    /// Validation file to write [default: validation.parquet beside the input]
    #[arg(long)]
    pub out: Option<PathBuf>,
    #[command(flatten, next_help_heading = "Fits")]
    fits: FitsOptions,
}

/// The role that responses play here as in the fits.
const RESPONSES_ROLE: &str = "responses";

/// The stage, ready to run.
pub struct Validate {
    fits: Vec<anyhow::Result<ChosenFits>>,
    pex: Source,
    pro: Source,
    input: PathBuf,
    out: PathBuf,
}

impl Validate {
    /// Of the fits in the options, into the file `out`.
    ///
    /// # Errors
    /// If the fits cannot be read or chosen.
    pub fn new(options: &ValidateOptions, out: PathBuf) -> anyhow::Result<Validate> {
        let fits = options.fits.choose_each()?;
        let (pex, pro) = (options.fits.pex.clone(), options.fits.pro.clone());
        Ok(Validate { fits, pex, pro, input: options.input.clone(), out })
    }

    fn usable(&self) -> impl Iterator<Item = &ChosenFits> {
        self.fits.iter().filter_map(|fits| fits.as_ref().ok())
    }

    /// That the curves were fitted to the responses they are held against.
    fn warn_of_own_responses(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<()> {
        let responses = provenance.inputs.get(RESPONSES_ROLE);
        for fits in [&self.pex, &self.pro] {
            let fitted_to =
                stamp(fits.name())?.and_then(|stamp| stamp.provenance.inputs.get(RESPONSES_ROLE).cloned());
            if fitted_to.as_ref() == responses {
                console.note(&format!(
                    "warning: {} was fitted to the very responses of {}: that they agree proves nothing",
                    fits.name().display(),
                    self.input.display()
                ));
            }
        }
        Ok(())
    }

    /// That something happened which the curves hold impossible.
    fn warn_of_impossible(&self, rows: &[ValidationRow], console: &Console) {
        for ValidationRow { structure, fits_suite, event, n, impossible, .. } in rows {
            if *impossible > 0 {
                console.note(&format!(
                    "warning: {structure}: what happened in {} of {} cases has a probability of 0 by the curves of {} \
                     for {}: the log score is minus infinity (null)",
                    impossible,
                    n,
                    fits_suite.as_deref().unwrap_or("no suite"),
                    event.as_str()
                ));
            }
        }
    }

    fn warn(&self, groups: &[Group], console: &Console) {
        for why in self.fits.iter().filter_map(|fits| fits.as_ref().err()) {
            console.note(&format!("warning: left out: {why}"));
        }
        for group in groups {
            let mut of_structure = self.usable().filter(|fits| fits.structure == group.structure).peekable();
            if of_structure.peek().is_none() {
                console.note(&format!("warning: no fits of structure '{}': left out", group.structure));
            } else if of_structure.any(|fits| fits.is_other_eta(group.eta)) {
                let Group { structure, eta, .. } = group;
                console.note(&format!(
                    "warning: {structure} has eta {eta:.4}, and fits that depend on another one"
                ));
            }
        }
    }
}

/// All events of a group by the fits of one suite; those that cannot happen in any case are left out.
fn rows<'a>(group: &'a Group, fits: &'a ChosenFits) -> impl Iterator<Item = ValidationRow> + 'a {
    [Event::Overturning, Event::Exceeding, Event::Failure].into_iter().filter_map(|event| {
        let Forecasts { forecasts, without_measure } = Forecasts::new(&fits.model, &group.cases, event);
        Some(ValidationRow::new(
            group.suite.as_deref(),
            &group.structure,
            fits.suite.as_deref(),
            event,
            fits.model.limit,
            &Validation::of(&forecasts)?,
            without_measure,
        ))
    })
}

impl Stage for Validate {
    fn subcommand(&self) -> &'static str {
        VALIDATION.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("pex", self.pex.clone()), ("pro", self.pro.clone()), (RESPONSES_ROLE, (&self.input).into())]
    }

    fn targets(&self) -> Vec<Target> {
        vec![(&self.out).into()]
    }

    fn parameters(&self) -> Value {
        json!({ "fits": self.usable().map(ChosenFits::words).collect::<Vec<_>>() })
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let groups = groups::read(&self.input)?;
        self.warn(&groups, console);
        self.warn_of_own_responses(provenance, console)?;
        let of_structure = |fits: &&ChosenFits, structure: &str| fits.structure == structure;
        let rows: Vec<ValidationRow> = groups
            .iter()
            .flat_map(|group| {
                let fits = self.usable().filter(move |fits| of_structure(fits, &group.structure));
                fits.flat_map(move |fits| rows(group, fits))
            })
            .collect();
        if rows.is_empty() {
            anyhow::bail!(
                "{}: nothing that the fits of {} foretell; expected rocking responses of the same structures",
                self.input.display(),
                self.pex.name().display()
            );
        }
        self.warn_of_impossible(&rows, console);
        ValidationRow::write(&rows, &self.out, provenance)?;
        Ok(format!("{} counts of {} groups of responses", rows.len(), groups.len()))
    }
}
