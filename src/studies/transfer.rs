//! The curves of a structure on their own: fitted to its cases, and asked about those of another.

use crate::fragility::case::{Case, Event, Measure};
use crate::fragility::demand::regressions::PLANE;
use crate::fragility::model::{DemandLaw, DemandModel, has_no_data};
use crate::fragility::overturning::curves::{CurveModel, fit_overturning};
use crate::fragility::predictor::Predictor;
use crate::fragility::probability::ProbitIndex;
use crate::fragility::sample::Sample;
use crate::motion::IntensityMeasures;
use crate::statistics::FitStatus;

/// On what the curves of all structures depend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveForm {
    /// On one measure.
    Scalar(Measure),
    /// P_ro on the hybrid of IM4 and p PGV / PGA, P_ex on IM4 and IM3 in two planes.
    Hybrid {
        /// The IM4 at which the planes meet.
        transition: f64,
    },
}

/// What is fitted to each structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveSubject {
    /// The event whose probability it gives.
    pub event: Event,
    /// On what it depends.
    pub form: CurveForm,
    /// The demand |theta|max / alpha that P_ex is about.
    pub limit: f64,
}

/// A fitted curve.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "few are held at once")]
pub enum Curve {
    /// P_ro.
    Overturning(Predictor),
    /// P_ex.
    Exceeding {
        /// The demand in safe rocking.
        demand: DemandModel,
        /// The demand that is exceeded.
        limit: f64,
    },
}

impl CurveSubject {
    /// The measures that it takes.
    pub fn measures(&self) -> Vec<Measure> {
        match (self.form, self.event) {
            (CurveForm::Scalar(measure), _) => vec![measure],
            (CurveForm::Hybrid { .. }, Event::Exceeding) => PLANE.to_vec(),
            (CurveForm::Hybrid { .. }, _) => vec![Measure::Im4, Measure::Im3Inverse],
        }
    }

    /// The ranges of the first measure of which each has a law of its own.
    pub fn parts(&self) -> Vec<std::ops::Range<f64>> {
        match (self.form, self.event) {
            (CurveForm::Hybrid { transition }, Event::Exceeding) => {
                vec![0.0..transition, transition..f64::INFINITY]
            }
            _ => vec![0.0..f64::INFINITY],
        }
    }

    /// Whether the event happened in a case; none if the case does not count.
    pub fn happened(&self, case: &Case) -> Option<bool> {
        self.event.happened(case, self.limit)
    }

    /// The curve of these cases.
    ///
    /// # Errors
    /// With the status that says why there is none.
    pub fn fit(&self, cases: &[Case]) -> Result<Curve, FitStatus> {
        let measures = self.measures();
        match self.event {
            Event::Exceeding => {
                let law = |range: std::ops::Range<f64>| -> Result<DemandLaw, FitStatus> {
                    let sample = Sample::of_demands(cases, &measures, range);
                    let fit = sample.fit()?;
                    Ok(DemandLaw {
                        ln_median: Predictor::new(
                            &measures,
                            &fit.values(),
                            &fit.covariance,
                            &sample.ranges(),
                        ),
                        beta: fit.residual_sd,
                        degrees: (fit.n - fit.coefficients.len()) as f64,
                    })
                };
                let laws: Vec<_> = self.parts().into_iter().map(law).collect();
                let demand = match (self.form, &laws[..]) {
                    (CurveForm::Hybrid { transition }, &[Ok(low), Ok(high)]) => {
                        DemandModel::Biplanar { transition, low, high }
                    }
                    // A slender structure has hardly a motion below the transition, a stocky one hardly any above.
                    (_, &[Err(FitStatus::TooFewCases), only] | &[only, Err(FitStatus::TooFewCases)]) => {
                        DemandModel::Everywhere(only?)
                    }
                    (_, &[first, ..]) => DemandModel::Everywhere(first?),
                    (_, []) => return Err(FitStatus::TooFewCases),
                };
                Ok(Curve::Exceeding { demand, limit: self.limit })
            }
            _ => {
                let sample = Sample::of_events(cases, &measures, |case| self.happened(case));
                let fit = fit_overturning(&sample, &CurveModel::default())?.regression;
                Ok(Curve::Overturning(Predictor::new(
                    &measures,
                    &fit.coefficients,
                    &fit.covariance,
                    &sample.ranges(),
                )))
            }
        }
    }
}

impl Curve {
    /// The probit index of the probability at an intensity; none where a measure is missing.
    pub fn index(&self, measures: &IntensityMeasures) -> Option<ProbitIndex> {
        match self {
            Curve::Overturning(curve) => {
                let index = curve.at(measures)?;
                Some(ProbitIndex { value: index.value, standard_error: index.variance.sqrt() })
            }
            Curve::Exceeding { demand, limit } => demand.law(measures).exceeding(measures, *limit),
        }
    }

    /// Whether a measure lies outside of the range of the data.
    pub fn is_extrapolated(&self, measures: &IntensityMeasures) -> bool {
        let predictor = match self {
            Curve::Overturning(curve) => curve,
            Curve::Exceeding { demand, .. } => &demand.law(measures).ln_median,
        };
        predictor.out_of_range(measures).any(|out| has_no_data(&out))
    }
}
