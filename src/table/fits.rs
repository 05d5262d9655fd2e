//! The fits in the rows of pex and pro files, as evaluate, export, validate and the report take them.

use super::pex::PexRow;
use super::pro::ProRow;
use crate::fragility::demand::Form;
use crate::fragility::{Bend, DemandLaw, DemandModel, Event, JointPeaks, Measure, Predictor, RatioGiven};
use crate::keyword::Keyword;
use crate::rocking::Block;
use crate::statistics::{FitStatus, Link};

/// A suite, if it has a name, and a structure: what a fit is of.
pub type GroupKey = (Option<String>, String);

/// A row of a file of fits whose fit cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the fit of {structure} on {im_x}: {column} is {found}; expected {expected}")]
pub struct Unusable {
    structure: String,
    im_x: &'static str,
    column: &'static str,
    found: String,
    expected: &'static str,
}

/// The names of fields with their values.
macro_rules! named {
    ($row:expr; $($field:ident)*) => { [$((stringify!($field), $row.$field)),*] };
}

impl PexRow {
    /// Which suite and structure the regression is of.
    pub fn group(&self) -> GroupKey {
        (self.suite.clone(), self.structure.clone())
    }

    /// Whether there is a regression, and the demand grows with the intensity.
    pub fn is_ok(&self) -> bool {
        self.status == FitStatus::Ok
    }

    /// The demand by this regression (Eqs. 15 and 17).
    ///
    /// # Errors
    /// If a number of it is null.
    pub fn demand(&self) -> Result<DemandLaw, Unusable> {
        let names = (self.structure.as_str(), self.im_x, self.im_y);
        let mut ln_median = predictor(
            names,
            named!(self; ln_a b1 b2 se_ln_a se_b1 se_b2 cov_ln_a_b1 cov_ln_a_b2 cov_b1_b2 im_x_low im_x_high im_y_low im_y_high),
        )?;
        ln_median.covariance = self.clustered_covariance.map_or(ln_median.covariance, |flat| rows(&flat));
        ln_median.spread = self.cell_spread.unwrap_or(0.0) * self.beta.unwrap_or(0.0);
        let degrees = self.n as f64 - 1.0 - ln_median.measures().count() as f64;
        Ok(DemandLaw { ln_median, beta: number(names, ("beta", self.beta))?, degrees })
    }
}

/// The planes below and above the transition among rows of one group, in whatever order: a file may have been sorted elsewhere.
pub fn planes<'r>(rows: impl Iterator<Item = &'r PexRow>) -> Option<[&'r PexRow; 2]> {
    let mut planes: Vec<&PexRow> = rows.filter(|row| row.model == Form::Biplanar).collect();
    let start = |row: &PexRow| row.range_low.unwrap_or(0.0);
    planes.sort_by(|a, b| start(a).total_cmp(&start(b)));
    planes.try_into().ok()
}

/// The two planes as one model, each on its side of the transition (Eqs. 17 and 18).
///
/// # Errors
/// If a number of either is null.
pub fn biplanar([low, high]: [&PexRow; 2]) -> Result<DemandModel, Unusable> {
    let transition = number((&high.structure, high.im_x, high.im_y), ("range_low", high.range_low))?;
    Ok(DemandModel::Biplanar { transition, low: low.demand()?, high: high.demand()? })
}

impl ProRow {
    /// Which suite and structure the curve is of.
    pub fn group(&self) -> GroupKey {
        (self.suite.clone(), self.structure.clone())
    }

    /// The size and slenderness of the structure, if all cases share them.
    pub fn block(&self) -> Option<Block> {
        Some(Block { p_rad_s: self.p_rad_s?, alpha_rad: self.alpha_rad? })
    }

    /// How PGA and PGV go together in the motions of the cases.
    pub fn peaks(&self) -> Option<JointPeaks> {
        Some(JointPeaks {
            given_pga: RatioGiven::of_numbers(self.ratio_given_pga?),
            given_pgv: RatioGiven::of_numbers(self.ratio_given_pgv?),
        })
    }

    /// The probit index of the curve that bends; none where there is none, or it does no better on cells left out.
    pub fn bent_probit(&self) -> Option<Predictor> {
        let (terms, knots) = (self.bent?, self.bent_knots?);
        let straight = self.probit().ok()?;
        let bend = Bend {
            knots: rows(&knots),
            coefficients: [terms[3], terms[4], terms[5]],
            covariance: rows(&self.bent_covariance?),
        };
        Some(Predictor {
            coefficients: [terms[0], terms[1], terms[2]],
            bend: Some(bend),
            spread: self.bent_cell_spread.unwrap_or(0.0),
            ..straight
        })
    }

    /// Whether it is a curve of overturning.
    pub fn is_of_overturning(&self) -> bool {
        self.event == Event::Overturning
    }

    /// Whether there is a curve, and it rises with the intensity.
    pub fn is_ok(&self) -> bool {
        self.status.is_usable()
    }

    /// The probit index of this curve: b0 + b1 ln IMx + b2 ln IMy.
    ///
    /// # Errors
    /// If a number of it is null, or the curve has another link.
    pub fn probit(&self) -> Result<Predictor, Unusable> {
        if self.link != Link::Probit {
            return Err(Unusable {
                structure: self.structure.clone(),
                im_x: self.im_x.as_str(),
                column: "link",
                found: self.link.as_str().to_string(),
                expected: "probit: fit with --link probit",
            });
        }
        let mut index = predictor(
            (self.structure.as_str(), self.im_x, self.im_y),
            named!(self; b0 b1 b2 se_b0 se_b1 se_b2 cov_b0_b1 cov_b0_b2 cov_b1_b2 im_x_low im_x_high im_y_low im_y_high),
        )?;
        index.covariance = self.clustered_covariance.map_or(index.covariance, |flat| rows(&flat));
        index.spread = self.cell_spread.unwrap_or(0.0);
        Ok(index)
    }
}

type Names<'r> = (&'r str, Measure, Option<Measure>);

fn number(
    (structure, im_x, _): Names,
    (column, value): (&'static str, Option<f64>),
) -> Result<f64, Unusable> {
    value.ok_or_else(|| Unusable {
        structure: structure.to_string(),
        im_x: im_x.as_str(),
        column,
        found: "null".to_string(),
        expected: "a number: fit again with --force",
    })
}

/// Coefficients, their standard errors, their covariances and the ranges of the measures; what is of the second measure is 0
/// where there is none.
fn predictor(names: Names, numbers: [(&'static str, Option<f64>); 13]) -> Result<Predictor, Unusable> {
    const OF_SECOND: [usize; 6] = [2, 5, 7, 8, 11, 12];
    let (_, im_x, im_y) = names;
    let mut values = [0.0; 13];
    for (index, named) in numbers.into_iter().enumerate() {
        if im_y.is_some() || !OF_SECOND.contains(&index) {
            values[index] = number(names, named)?;
        }
    }
    let [b0, b1, b2, se_0, se_1, se_2, c01, c02, c12, x_low, x_high, y_low, y_high] = values;
    Ok(Predictor {
        im_x,
        im_y,
        coefficients: [b0, b1, b2],
        covariance: [[se_0 * se_0, c01, c02], [c01, se_1 * se_1, c12], [c02, c12, se_2 * se_2]],
        ranges: [[x_low, x_high], [y_low, y_high]],
        bend: None,
        spread: 0.0,
    })
}

/// Numbers as the rows of a matrix.
fn rows<const ALL: usize, const N: usize, const K: usize>(flat: &[f64; ALL]) -> [[f64; K]; N] {
    std::array::from_fn(|row| std::array::from_fn(|column| flat[row * K + column]))
}
