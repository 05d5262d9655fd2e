//! The cases in which intensity measures are ranked.

use crate::fragility::case::{Case, Measure};
use crate::fragility::sample::Sample;
use crate::keyword::{Keyword, keywords};
use crate::rocking::Outcome;

/// What is predicted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// ln EDP in safe rocking, from which P_ex follows.
    Demand,
    /// Overturning given rocking: P_ro.
    Overturning,
}

keywords!(Target { Demand = "p_ex", Overturning = "p_ro" });

impl Target {
    /// Whether a case counts.
    pub fn counts(self, case: &Case) -> bool {
        match self {
            Target::Demand => case.has_demand(),
            Target::Overturning => case.outcome != Outcome::NoRocking,
        }
    }

    /// The two measures that the paper joins, in its form: the plane of Eq. 17, the hybrid of Figure 12.
    pub fn pair_of_paper(self) -> [Measure; 2] {
        match self {
            Target::Demand => [Measure::Im4, Measure::Im3],
            Target::Overturning => [Measure::Im4, Measure::Im3Inverse],
        }
    }

    /// The six of Eq. 13, those of [`Target::pair_of_paper`] first: of sets that are the same model, the first one stands for all.
    pub fn measures_of_paper(self) -> [Measure; 6] {
        let [x, y] = self.pair_of_paper();
        [x, y, Measure::Im5, Measure::Im1, Measure::Im2, Measure::Im6]
    }
}

/// A measure besides those of Eq. 13: its logarithm in each case, where it has one.
#[derive(Debug, Clone, PartialEq)]
pub struct FurtherMeasure {
    /// What it is called.
    pub name: String,
    /// Of all cases.
    pub ln: Vec<Option<f64>>,
}

/// The cases that count for a target, with all measures that every one of them has: only on the same cases are likelihoods
/// comparable.
#[derive(Debug, Clone, PartialEq)]
pub struct RankingSample {
    /// What is predicted.
    pub target: Target,
    /// What the measures are called.
    pub names: Vec<String>,
    /// The logarithms of each.
    pub ln_im: Vec<Vec<f64>>,
    /// Demand in each case.
    pub ln_edp: Vec<f64>,
    /// The demand that P_ex is about.
    pub ln_limit: f64,
    /// Whether it overturned, or in safe rocking exceeded the limit.
    pub happened: Vec<bool>,
    /// The cluster of each case.
    pub clusters: Vec<usize>,
    /// Measures that some cases have and others lack, and in how many they are missing.
    pub incomplete: Vec<(String, usize)>,
}

impl RankingSample {
    /// Of all cases with their clusters and further measures; `limit_state` is the demand that P_ex is about.
    pub fn new(
        target: Target,
        cases: &[Case],
        clusters: &[usize],
        further: &[FurtherMeasure],
        limit_state: f64,
    ) -> RankingSample {
        let rows: Vec<usize> = (0..cases.len()).filter(|&row| target.counts(&cases[row])).collect();
        let of_paper = target.measures_of_paper().map(|measure| FurtherMeasure {
            name: measure.as_str().to_string(),
            ln: cases.iter().map(|case| measure.of(case).map(libm::log)).collect(),
        });
        let ln_limit = libm::log(limit_state);
        let ln_edp: Vec<f64> = rows.iter().map(|&row| libm::log(cases[row].edp)).collect();
        let happened = |&row: &usize| match target {
            Target::Demand => libm::log(cases[row].edp) > ln_limit,
            Target::Overturning => cases[row].outcome == Outcome::Overturning,
        };
        let mut sample = RankingSample {
            target,
            names: Vec::new(),
            ln_im: Vec::new(),
            ln_edp,
            ln_limit,
            happened: rows.iter().map(happened).collect(),
            clusters: rows.iter().map(|&row| clusters[row]).collect(),
            incomplete: Vec::new(),
        };
        for FurtherMeasure { name, ln } in of_paper.iter().chain(further) {
            let values: Vec<f64> = rows.iter().filter_map(|&row| ln[row]).collect();
            if values.len() == rows.len() {
                sample.names.push(name.clone());
                sample.ln_im.push(values);
            } else if !values.is_empty() {
                sample.incomplete.push((name.clone(), rows.len() - values.len()));
            }
        }
        sample
    }

    /// Cases.
    pub fn len(&self) -> usize {
        self.happened.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.happened.is_empty()
    }

    /// The place of a measure of the paper, if all cases have it.
    pub fn place(&self, measure: Measure) -> Option<usize> {
        self.names.iter().position(|name| name == measure.as_str())
    }

    /// The logarithms of some measures.
    pub fn columns(&self, places: &[usize]) -> Vec<Vec<f64>> {
        places.iter().map(|&place| self.ln_im[place].clone()).collect()
    }

    /// The regression of the demand on some measures.
    pub fn demands(&self, places: &[usize]) -> Sample {
        Sample::of_columns(self.columns(places), self.ln_edp.clone())
    }
}
