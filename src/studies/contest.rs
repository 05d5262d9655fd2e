//! The ranking of measures, step by step: who competes, how each does, and in which order that puts them.

use super::candidate::Candidate;
use super::folds::Folds;
use super::ranking::{Ranked, Standings};
use super::ranking_sample::{RankingSample, Target};
use super::rate_demand::{Breaks, rate_demand};
use super::rate_overturning::rate_overturning;
use super::rating::Rating;
use crate::statistics::FitStatus;

/// How measures are ranked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankingRules {
    /// The most folds of cross-validation.
    pub folds: usize,
    /// The most measures of a candidate.
    pub terms: usize,
    /// The IM4 at which the demand breaks, if not where the pooled residual of two planes is least.
    pub transition: Option<f64>,
}

/// All sets of measures that compete in some cases.
pub struct Contest {
    sample: RankingSample,
    folds: Option<Folds>,
    breaks: Breaks,
    /// Who competes.
    pub candidates: Vec<Candidate>,
}

impl Contest {
    /// In these cases, by these rules.
    pub fn new(sample: RankingSample, rules: &RankingRules) -> Contest {
        let folds = Folds::new(&sample.clusters, rules.folds);
        let breaks = Breaks::new(&sample, folds.as_ref(), rules.transition);
        let candidates = Candidate::all(&sample, rules.terms);
        Contest { sample, folds, breaks, candidates }
    }

    /// How well a candidate predicts.
    ///
    /// # Errors
    /// With the status that says why there is no fit.
    pub fn rate(&self, candidate: &Candidate) -> Result<Rating, FitStatus> {
        let (sample, folds) = (&self.sample, self.folds.as_ref());
        match sample.target {
            Target::Demand => rate_demand(sample, candidate, folds, &self.breaks),
            Target::Overturning => rate_overturning(sample, candidate, folds),
        }
    }

    /// The candidates with the rating of each, by the number of their measures, then by cross-validated log score, the best
    /// first. Those without a score come after them, those without a fit last.
    pub fn rank(&self, ratings: Vec<Result<Rating, FitStatus>>) -> Vec<Ranked> {
        Standings::new(&self.sample, &self.candidates, ratings).ranked()
    }
}
