//! The responses of one structure to one suite of motions, as columns in memory.

use std::collections::BTreeMap;

use super::measure::Measure;
use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::rocking::{Outcome, Structure};

/// The most cases of one structure and suite.
pub const MOST_CASES: usize = 20_000_000;

/// The event whose probability is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// Overturning given rocking: P_ro.
    Overturning,
    /// Rocking: 1 - P_nr.
    Rocking,
    /// A demand above the limit state in safe rocking: P_ex.
    Exceeding,
    /// Failure given rocking: overturning, or a demand above the limit state (Eq. 12).
    Failure,
}

keywords!(Event {
    Overturning = "overturning",
    Rocking = "rocking",
    Exceeding = "exceeding",
    Failure = "failure",
});

impl Event {
    /// Returns whether it happened in a response with this outcome and demand; none where the response does
    /// not count.
    pub fn happened(self, outcome: Outcome, edp: f64, limit_state: f64) -> Option<bool> {
        let overturned = outcome == Outcome::Overturning;
        match (self, outcome) {
            (Event::Rocking, outcome) => Some(outcome != Outcome::NoRocking),
            (_, Outcome::NoRocking) | (Event::Exceeding, Outcome::Overturning) => None,
            (Event::Overturning, _) => Some(overturned),
            (Event::Exceeding | Event::Failure, _) => Some(overturned || edp > limit_state),
        }
    }
}

/// What the responses of a cluster share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SharedBy {
    Earthquake,
    /// Magnitude and distance.
    Cell,
    /// Nothing: each motion is a cluster of its own.
    Nothing,
}

keywords!(SharedBy { Earthquake = "earthquake", Cell = "cell", Nothing = "nothing" });

/// One response, as [`CasesBuilder`] takes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaseRow<'a> {
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    pub eta: f64,
    pub outcome: Outcome,
    /// Demand |theta|max / alpha (Eq. 7); none where it overturned.
    pub edp: Option<f64>,
    pub measures: IntensityMeasures,
    pub pga_m_s2: f64,
    pub pgv_m_s: f64,
    pub mw: Option<f64>,
    pub re_km: Option<f64>,
    pub earthquake: Option<&'a str>,
    /// Values of the candidate measures, in the order of their names; NaN where unknown.
    pub candidates: &'a [f64],
}

/// Why a response cannot be added.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CasesError {
    #[error(
        "structure '{structure}': {parameter} is {value} in one row and {first} in another; give each structure its own name"
    )]
    OtherStructure { structure: String, parameter: &'static str, value: f64, first: f64 },
    #[error("structure '{structure}': more than {MOST_CASES} responses; take a sample of the rows")]
    TooMany { structure: String },
}

/// The responses of one structure to one suite; all columns are as long.
#[derive(Debug, Clone, PartialEq)]
pub struct Cases {
    pub suite: Option<String>,
    pub structure: Structure,
    pub outcome: Vec<Outcome>,
    /// Demand |theta|max / alpha (Eq. 7); NaN where it overturned.
    pub edp: Vec<f64>,
    /// IM1 to IM6 (Eq. 13); NaN where unknown.
    pub im: [Vec<f64>; 6],
    pub pga_m_s2: Vec<f64>,
    pub pgv_m_s: Vec<f64>,
    /// Magnitude; NaN where unknown.
    pub mw: Vec<f64>,
    /// Distance, km; NaN where unknown.
    pub re_km: Vec<f64>,
    /// Number of the cluster: cases of one cluster may depend on each other.
    pub cluster: Vec<u32>,
    pub shared_by: SharedBy,
    /// Further measures by name; NaN where unknown.
    pub candidates: Vec<(String, Vec<f64>)>,
}

/// What makes cases one cluster, in the order of the numbers of clusters.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
enum ClusterKey {
    Earthquake(String),
    /// Bits of magnitude and distance: these are positive, so that the bits are in the order of the values.
    Cell(u64, u64),
}

/// Number of a case that shares nothing, until all have come.
const ALONE: u32 = u32::MAX;

/// Makes [`Cases`], response by response.
#[derive(Debug)]
pub struct CasesBuilder {
    cases: Cases,
    /// The number under which each cluster first came.
    clusters: BTreeMap<ClusterKey, u32>,
}

impl CasesBuilder {
    /// Starts without a case, with these names of candidate measures.
    pub fn new(suite: Option<&str>, structure: Structure, candidates: &[String]) -> CasesBuilder {
        let cases = Cases {
            suite: suite.map(str::to_string),
            structure,
            outcome: Vec::new(),
            edp: Vec::new(),
            im: Default::default(),
            pga_m_s2: Vec::new(),
            pgv_m_s: Vec::new(),
            mw: Vec::new(),
            re_km: Vec::new(),
            cluster: Vec::new(),
            shared_by: SharedBy::Nothing,
            candidates: candidates.iter().map(|name| (name.clone(), Vec::new())).collect(),
        };
        CasesBuilder { cases, clusters: BTreeMap::new() }
    }

    /// Adds a response.
    ///
    /// # Errors
    /// If its structure is another one, or there are [`MOST_CASES`] already.
    pub fn push(&mut self, row: &CaseRow) -> Result<(), CasesError> {
        let cases = &mut self.cases;
        let Structure { name, p_rad_s, alpha_rad, eta } = &cases.structure;
        let parameters =
            [("p", row.p_rad_s, *p_rad_s), ("alpha", row.alpha_rad, *alpha_rad), ("eta", row.eta, *eta)];
        if let Some(&(parameter, value, first)) = parameters.iter().find(|(_, value, first)| value != first) {
            return Err(CasesError::OtherStructure { structure: name.clone(), parameter, value, first });
        }
        if cases.len() == MOST_CASES {
            return Err(CasesError::TooMany { structure: name.clone() });
        }
        let key = match (row.earthquake, row.mw, row.re_km) {
            (Some(earthquake), ..) => Some(ClusterKey::Earthquake(earthquake.to_string())),
            (None, Some(mw), Some(re_km)) => Some(ClusterKey::Cell(mw.to_bits(), re_km.to_bits())),
            _ => None,
        };
        let next = self.clusters.len() as u32;
        cases.cluster.push(key.map_or(ALONE, |key| *self.clusters.entry(key).or_insert(next)));
        let IntensityMeasures { im1, im2, im3, im4, im5, im6 } = row.measures;
        let values = [im1, im2, im3, Some(im4), Some(im5), im6];
        cases.im.iter_mut().zip(values).for_each(|(column, im)| column.push(im.unwrap_or(f64::NAN)));
        cases.outcome.push(row.outcome);
        cases.edp.push(row.edp.unwrap_or(f64::NAN));
        cases.pga_m_s2.push(row.pga_m_s2);
        cases.pgv_m_s.push(row.pgv_m_s);
        cases.mw.push(row.mw.unwrap_or(f64::NAN));
        cases.re_km.push(row.re_km.unwrap_or(f64::NAN));
        cases.candidates.iter_mut().zip(row.candidates).for_each(|((_, column), value)| column.push(*value));
        Ok(())
    }

    /// Numbers the clusters, in an order that does not depend on that of the rows, and those of one motion
    /// after them.
    pub fn finish(self) -> Cases {
        let CasesBuilder { mut cases, clusters } = self;
        let mut numbers = vec![0; clusters.len()];
        clusters.values().zip(0..).for_each(|(&came, number)| numbers[came as usize] = number);
        let mut alone = clusters.len() as u32..;
        for cluster in &mut cases.cluster {
            *cluster =
                if *cluster == ALONE { alone.next().unwrap_or(ALONE) } else { numbers[*cluster as usize] };
        }
        cases.shared_by = match clusters.keys().next() {
            Some(ClusterKey::Earthquake(_)) => SharedBy::Earthquake,
            Some(ClusterKey::Cell(..)) => SharedBy::Cell,
            None => SharedBy::Nothing,
        };
        cases
    }
}

/// Logarithms of measures, and what was observed, of the cases of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample<Y> {
    /// ln IM, a column for each measure.
    pub ln_im: Vec<Vec<f64>>,
    pub y: Vec<Y>,
    pub clusters: Vec<u32>,
    /// Least and largest value of each measure.
    pub ranges: Vec<[f64; 2]>,
}

impl<Y> Sample<Y> {
    /// Returns the least (0) or largest (1) value of a measure; none without cases or such a measure.
    pub(super) fn end(&self, measure: usize, end: usize) -> Option<f64> {
        Some(self.ranges.get(measure)?[end]).filter(|end| end.is_finite())
    }

    /// Returns the columns of ln IM.
    pub fn x(&self) -> Vec<&[f64]> {
        self.ln_im.iter().map(Vec::as_slice).collect()
    }
}

impl Cases {
    /// Returns the number of cases.
    pub fn len(&self) -> usize {
        self.outcome.len()
    }

    /// Returns whether there is no case.
    pub fn is_empty(&self) -> bool {
        self.outcome.is_empty()
    }

    /// Returns the measures of a case.
    pub fn measures(&self, case: usize) -> IntensityMeasures {
        let [im1, im2, im3, im4, im5, im6] = self.im.each_ref().map(|column| column[case]);
        let known = |im: f64| Some(im).filter(|im| !im.is_nan());
        IntensityMeasures { im1: known(im1), im2: known(im2), im3: known(im3), im4, im5, im6: known(im6) }
    }

    /// Returns whether an event happened in a case; none where the case does not count.
    pub fn happened(&self, case: usize, event: Event, limit_state: f64) -> Option<bool> {
        event.happened(self.outcome[case], self.edp[case], limit_state)
    }

    /// Returns ln EDP where the structure rocked safely, with a demand that has a logarithm.
    pub fn ln_demand(&self, case: usize) -> Option<f64> {
        let counts = self.outcome[case] == Outcome::SafeRocking && self.edp[case] > 0.0;
        counts.then(|| self.edp[case].ln())
    }

    /// Raises smaller demands in safe rocking to `floor`, as a solver of finite tolerance does.
    pub fn raise_demands(&mut self, floor: f64) {
        let safe =
            self.outcome.iter().zip(&mut self.edp).filter(|(outcome, _)| **outcome == Outcome::SafeRocking);
        safe.for_each(|(_, edp)| *edp = edp.max(floor));
    }

    /// Returns the cases that have all measures and a `y`.
    pub fn sample<Y>(&self, measures: &[Measure], y: impl Fn(usize) -> Option<Y>) -> Sample<Y> {
        let mut sample = Sample {
            ln_im: vec![Vec::new(); measures.len()],
            y: Vec::new(),
            clusters: Vec::new(),
            ranges: vec![[f64::INFINITY, f64::NEG_INFINITY]; measures.len()],
        };
        for case in 0..self.len() {
            let Some(observed) = y(case) else { continue };
            let values = self.measures(case);
            let values: Option<Vec<f64>> = measures.iter().map(|measure| measure.value_of(&values)).collect();
            let Some(values) = values else { continue };
            for (k, value) in values.into_iter().enumerate() {
                sample.ln_im[k].push(value.ln());
                let [least, largest] = &mut sample.ranges[k];
                (*least, *largest) = (least.min(value), largest.max(value));
            }
            sample.y.push(observed);
            sample.clusters.push(self.cluster[case]);
        }
        sample
    }
}
