//! The responses of each suite and structure, as the fits take them.

use anyhow::Context;
use polars::prelude::{Column, DataFrame};

use crate::fragility::{Case, CaseGroup, Clusters, cells};
use crate::keyword;
use crate::rocking::Structure;
use crate::table::frame::read_frame_of;
use crate::table::responses::MeasureColumns;
use crate::table::schema::{self, IDA_STRIPES, RESPONSES};
use crate::table::source::Source;

/// All responses of one structure to one suite.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// The suite, if known.
    pub suite: Option<String>,
    /// The structure.
    pub structure: String,
    /// Its coefficient of restitution.
    pub eta: f64,
    /// Its responses, in the order of the file.
    pub cases: Vec<Case>,
    /// The frequency parameter, rad/s, in each.
    pub p_rad_s: Vec<f64>,
    /// The slenderness, rad, in each.
    pub alpha_rad: Vec<f64>,
    /// What the motion of each is called.
    pub motion_ids: Vec<String>,
    /// Peak ground acceleration of each, m/s2.
    pub pga_m_s2: Vec<f64>,
    /// The number of the cell of magnitude and distance of each, within which a bootstrap resamples; one cell for all that
    /// have neither.
    pub cells: Vec<usize>,
    /// Which of them may depend on each other.
    pub clusters: Clusters,
}

impl Group {
    /// What the fits take.
    pub fn to_fit(&self) -> CaseGroup<'_> {
        CaseGroup { cases: &self.cases, cells: &self.cells, clusters: &self.clusters.numbers }
    }

    /// The structure of a response.
    pub fn structure_of(&self, row: usize) -> Structure {
        let (p_rad_s, alpha_rad) = (self.p_rad_s[row], self.alpha_rad[row]);
        Structure { name: self.structure.clone(), p_rad_s, alpha_rad, eta: self.eta }
    }
}

/// The groups of a responses file, or of the stripes of ida, in the order in which they first appear.
///
/// # Errors
/// If the file is none of responses or holds an unknown outcome.
pub fn read(source: impl Into<Source>) -> anyhow::Result<Vec<Group>> {
    let source = source.into();
    let responses = read_frame_of(&source, &RESPONSES, &[RESPONSES.stage, IDA_STRIPES.stage])?;
    let groups = responses.partition_by_stable([schema::SUITE.name, schema::STRUCTURE.name], true)?;
    groups.iter().map(|group| of(group).with_context(|| source.name().display().to_string())).collect()
}

fn of(frame: &DataFrame) -> anyhow::Result<Group> {
    let number = |column: schema::Column| -> anyhow::Result<Vec<Option<f64>>> {
        Ok(frame.column(column.name)?.f64()?.iter().collect())
    };
    let finite = |column| -> anyhow::Result<Vec<f64>> {
        Ok(number(column)?.into_iter().map(|value| value.unwrap_or(f64::NAN)).collect())
    };
    let first_number = |column: schema::Column| -> anyhow::Result<f64> {
        Ok(frame.column(column.name)?.f64()?.get(0).unwrap_or(f64::NAN))
    };
    let outcomes = frame.column(schema::OUTCOME.name)?.str()?;
    let edp = finite(schema::EDP)?;
    let measures = MeasureColumns::read(number, finite)?;
    let case = |(row, outcome): (usize, Option<&str>)| {
        let outcome = keyword::parse(outcome.unwrap_or_default()).context("column 'outcome'")?;
        Ok(Case { outcome, edp: edp[row], measures: measures.of_row(row) })
    };
    let motion_ids = names(frame.column(schema::MOTION_ID.name)?)?;
    let events: Vec<Option<&str>> = frame.column(schema::EARTHQUAKE.name)?.str()?.iter().collect();
    let (mw, re_km) = (number(schema::MW)?, number(schema::RE_KM)?);
    Ok(Group {
        suite: first_text(frame.column(schema::SUITE.name)?)?,
        structure: first_text(frame.column(schema::STRUCTURE.name)?)?.unwrap_or_default(),
        eta: first_number(schema::ETA)?,
        cases: outcomes.iter().enumerate().map(case).collect::<anyhow::Result<_>>()?,
        cells: cells(&mw, &re_km),
        clusters: Clusters::new(&motion_ids, &events, &mw, &re_km),
        p_rad_s: finite(schema::P_RAD_S)?,
        alpha_rad: finite(schema::ALPHA_RAD)?,
        motion_ids,
        pga_m_s2: finite(schema::PGA_M_S2)?,
    })
}

/// Names, or numbers as such.
fn names(column: &Column) -> anyhow::Result<Vec<String>> {
    if let Ok(names) = column.str() {
        return Ok(names.iter().map(|name| name.unwrap_or_default().to_string()).collect());
    }
    let numbers = column.i64()?.iter();
    Ok(numbers.map(|number| number.map_or(String::new(), |number| number.to_string())).collect())
}

fn first_text(column: &Column) -> anyhow::Result<Option<String>> {
    Ok(column.str()?.get(0).map(str::to_string))
}
