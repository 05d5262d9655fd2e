//! The responses of one structure to one suite of motions, as columns in memory.

use std::collections::BTreeMap;

use super::measure::Measure;
use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::rocking::{Outcome, Response, Structure};

/// The most cases of one structure and suite.
pub(crate) const MOST_CASES: usize = 20_000_000;

keywords! {
    /// The event whose probability is fitted.
    pub enum Event {
        /// Overturning given rocking: P_ro.
        Overturning = "overturning",
        /// Rocking: 1 - P_nr.
        Rocking = "rocking",
        /// A demand above the limit state in safe rocking: P_ex.
        Exceeding = "exceeding",
        /// Failure given rocking: overturning, or a demand above the limit state (Eq. 12).
        Failure = "failure",
    }
}

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

/// The suite and the structure that responses, and rows of fits, are of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Group<'a> {
    /// Suite of the motions, if they have one.
    pub suite: Option<&'a str>,
    /// Name of the structure.
    pub structure: &'a str,
}

/// Implements `group` for rows with a suite and a structure.
macro_rules! grouped {
    ($($row:ty),* $(,)?) => {$(
        impl $row {
            /// Returns the suite and the structure that it is of.
            pub fn group(&self) -> $crate::fragility::Group<'_> {
                $crate::fragility::Group { suite: self.suite.as_deref(), structure: &self.structure }
            }
        }
    )*};
}
pub(crate) use grouped;

/// What the motions of cases share, so that the cases may depend on each other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cluster {
    /// Name of the earthquake.
    Earthquake(String),
    /// Magnitude and distance, as the bits of these numbers.
    Cell([u64; 2]),
}

impl Cluster {
    /// Returns that of a motion: its earthquake, else its magnitude and distance (km); NaN where unknown.
    /// `None` for a motion that shares nothing.
    pub fn of(earthquake: Option<&str>, mw: f64, re_km: f64) -> Option<Cluster> {
        match earthquake {
            Some(name) => Some(Cluster::Earthquake(name.to_string())),
            // Both are positive, so that the bits are in the order of the values.
            None => (!mw.is_nan() && !re_km.is_nan()).then(|| Cluster::Cell([mw, re_km].map(f64::to_bits))),
        }
    }
}

/// The responses of one structure to one suite; all columns have the same length.
#[derive(Debug, Clone, PartialEq)]
pub struct Cases {
    /// Suite of the motions, if they have one.
    pub suite: Option<String>,
    /// The structure.
    pub structure: Structure,
    /// Whether it rocked, and overturned.
    pub outcome: Vec<Outcome>,
    /// Demand |theta|max / alpha (Eq. 7); NaN where it overturned.
    pub edp: Vec<f64>,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: Vec<f64>,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: Vec<f64>,
    /// Magnitude; NaN where unknown.
    pub mw: Vec<f64>,
    /// Number of the cluster, from 0: cases of one cluster may depend on each other.
    pub cluster: Vec<u32>,
    /// Further measures by name; NaN where unknown.
    pub candidates: Vec<(String, Vec<f64>)>,
    /// The measures of Eq. 13, in the order of [`Measure::SCALAR`]; NaN where unknown.
    im: [Vec<f64>; Measure::SCALAR.len()],
    /// The numbers of the known clusters, and the next number.
    clusters: BTreeMap<Cluster, u32>,
    next_cluster: u32,
}

impl Cases {
    /// Begins without a case.
    pub fn new(suite: Option<&str>, structure: Structure) -> Cases {
        Cases {
            suite: suite.map(str::to_string),
            structure,
            outcome: Vec::new(),
            edp: Vec::new(),
            pga_m_s2: Vec::new(),
            pgv_m_s: Vec::new(),
            mw: Vec::new(),
            cluster: Vec::new(),
            candidates: Vec::new(),
            im: Default::default(),
            clusters: BTreeMap::new(),
            next_cluster: 0,
        }
    }

    /// Adds the response to a motion with these measures, PGA (m/s2), PGV (m/s) and cluster, of unknown
    /// magnitude.
    pub fn push(
        &mut self,
        response: &Response,
        measures: &IntensityMeasures,
        [pga_m_s2, pgv_m_s]: [f64; 2],
        cluster: Option<Cluster>,
    ) {
        let overturned = response.outcome == Outcome::Overturning;
        self.outcome.push(response.outcome);
        self.edp.push(if overturned { f64::NAN } else { response.edp });
        self.pga_m_s2.push(pga_m_s2);
        self.pgv_m_s.push(pgv_m_s);
        self.mw.push(f64::NAN);
        for measure in Measure::SCALAR {
            self.column_mut(measure).push(measure.raw_value_of(measures).unwrap_or(f64::NAN));
        }
        self.push_cluster(cluster);
    }

    /// Adds the cluster of the next case: the number of a known one, or the next.
    pub fn push_cluster(&mut self, cluster: Option<Cluster>) {
        let next = self.next_cluster;
        let number = cluster.map_or(next, |cluster| *self.clusters.entry(cluster).or_insert(next));
        self.next_cluster = next.max(number + 1);
        self.cluster.push(number);
    }

    /// Numbers the clusters in an order that does not depend on that of the cases, and those of one motion
    /// after them.
    pub fn sort_clusters(&mut self) {
        let mut numbers = vec![None; self.next_cluster as usize];
        for (number, known) in (0..).zip(self.clusters.values_mut()) {
            numbers[*known as usize] = Some(number);
            *known = number;
        }
        let mut alone = self.clusters.len() as u32..;
        for cluster in &mut self.cluster {
            *cluster = *numbers[*cluster as usize].get_or_insert_with(|| alone.next().unwrap_or(u32::MAX));
        }
    }

    /// Returns a measure of Eq. 13 of each case; NaN where unknown.
    pub fn column(&self, measure: Measure) -> &[f64] {
        &self.im[measure as usize]
    }

    /// Returns the same, to change it.
    pub fn column_mut(&mut self, measure: Measure) -> &mut Vec<f64> {
        &mut self.im[measure as usize]
    }

    /// Returns the suite and the structure.
    pub fn group(&self) -> Group<'_> {
        Group { suite: self.suite.as_deref(), structure: &self.structure.name }
    }

    /// Returns the number of cases.
    pub fn len(&self) -> usize {
        self.outcome.len()
    }

    /// Returns whether there is no case.
    pub fn is_empty(&self) -> bool {
        self.outcome.is_empty()
    }

    /// Returns the magnitude of the motion of a case, where it is known.
    pub fn magnitude(&self, case: usize) -> Option<f64> {
        Some(self.mw[case]).filter(|mw| !mw.is_nan())
    }

    /// Returns the measures of a case.
    pub fn measures(&self, case: usize) -> IntensityMeasures {
        let value = |measure: Measure| self.column(measure)[case];
        let known = |measure: Measure| Some(value(measure)).filter(|value| !value.is_nan());
        IntensityMeasures {
            im1: known(Measure::Im1),
            im2: known(Measure::Im2),
            im3: known(Measure::Im3),
            im4: value(Measure::Im4),
            im5: value(Measure::Im5),
            im6: known(Measure::Im6),
        }
    }

    /// Returns whether an event happened in a case; `None` if it is undefined for this outcome.
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

/// Logarithms of measures, and what was observed, of the cases of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample<Y> {
    /// ln IM, a column for each measure.
    pub ln_im: Vec<Vec<f64>>,
    /// What was observed.
    pub y: Vec<Y>,
    /// Number of the cluster of each case.
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
