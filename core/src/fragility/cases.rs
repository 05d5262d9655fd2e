//! The responses of one structure to one suite of motions.

use std::collections::BTreeMap;

use super::measure_names::{Measure, has_logarithm};
use crate::motion::{IntensityMeasures, Peaks};
use crate::rocking::{Outcome, Structure};
use crate::spelling::unknown_word;
use crate::statistics::{Bounds, Range};

/// The most cases of one structure and suite: they take about 3 GB of memory.
pub const MOST_CASES: usize = 20_000_000;

/// The event whose probability is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Event>)]
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

impl Event {
    /// Whether it happened in a response; none where the response does not count.
    pub fn happened(self, outcome: Outcome, limit_state: f64) -> Option<bool> {
        match (self, outcome) {
            (Event::Rocking, _) => Some(outcome != Outcome::NoRocking),
            (_, Outcome::NoRocking) | (Event::Exceeding, Outcome::Overturned) => None,
            (Event::Overturning, _) => Some(outcome == Outcome::Overturned),
            _ => Some(outcome.demand().is_none_or(|demand| demand > limit_state)),
        }
    }
}

/// What responses and fits are grouped by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Group<'a> {
    pub suite: Option<&'a str>,
    pub structure: &'a str,
}

impl<'a> Group<'a> {
    pub fn of(suite: &'a Option<String>, structure: &'a str) -> Group<'a> {
        Group { suite: suite.as_deref(), structure }
    }
}

/// What motions share, so that responses to them may depend on each other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cluster {
    Earthquake(String),
    /// Magnitude and distance (km), as the bits of these numbers.
    Cell([u64; 2]),
}

impl Cluster {
    /// By the earthquake, else by magnitude and distance (km); none for a motion that shares neither.
    pub fn new(earthquake: Option<&str>, mw: Option<f64>, re_km: Option<f64>) -> Option<Cluster> {
        match earthquake {
            Some(name) => Some(Cluster::Earthquake(name.to_string())),
            // Both are positive, so that the bits are in the order of the values.
            None => Some(Cluster::Cell([mw?, re_km?].map(f64::to_bits))),
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Case {
    pub outcome: Outcome,
    pub measures: IntensityMeasures,
    pub peaks: Peaks,
    pub mw: Option<f64>,
    /// Number of the cluster, from 0: cases of one cluster may depend on each other.
    pub cluster: u32,
}

impl Case {
    /// None unless the structure rocked safely.
    pub fn ln_demand(&self) -> Option<f64> {
        self.outcome.demand().filter(|demand| *demand > 0.0).map(f64::ln)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Cases {
    pub suite: Option<String>,
    pub structure: Structure,
    pub all: Vec<Case>,
    /// Further measures by the names of their columns, a value for each case; NaN where one is missing.
    pub columns: BTreeMap<String, Vec<f64>>,
    clusters: BTreeMap<Cluster, u32>,
    next_cluster: u32,
}

impl Cases {
    pub fn new(suite: Option<&str>, structure: Structure) -> Cases {
        Cases {
            suite: suite.map(str::to_string),
            structure,
            all: Vec::new(),
            columns: BTreeMap::new(),
            clusters: BTreeMap::new(),
            next_cluster: 0,
        }
    }

    /// The cluster gets the number of a known one, or the next.
    pub fn push(&mut self, case: Case, cluster: Option<Cluster>) {
        let next = self.next_cluster;
        let number = cluster.map_or(next, |cluster| *self.clusters.entry(cluster).or_insert(next));
        self.next_cluster = next.max(number + 1);
        self.all.push(Case { cluster: number, ..case });
    }

    /// Renumbers the clusters independently of the order of the cases; motions without a cluster come last.
    pub fn sort_clusters(&mut self) {
        let mut numbers = vec![None; self.next_cluster as usize];
        for (number, known) in (0..).zip(self.clusters.values_mut()) {
            numbers[*known as usize] = Some(number);
            *known = number;
        }
        let mut alone = self.clusters.len() as u32..;
        for Case { cluster, .. } in &mut self.all {
            *cluster = *numbers[*cluster as usize].get_or_insert_with(|| alone.next().unwrap_or(u32::MAX));
        }
    }

    pub fn group(&self) -> Group<'_> {
        Group::of(&self.suite, &self.structure.name)
    }

    pub fn count(&self, outcome: Outcome) -> usize {
        self.all.iter().filter(|case| case.outcome == outcome).count()
    }

    /// Raises smaller rotations in safe rocking to `floor_rad`, as a solver of finite tolerance does.
    pub fn raise_rotations(&mut self, floor_rad: f64) {
        let floor = floor_rad / self.structure.alpha_rad;
        for case in &mut self.all {
            if let Outcome::SafeRocking(demand) = &mut case.outcome {
                *demand = demand.max(floor);
            }
        }
    }

    /// The cases that have all measures and a `y`.
    pub fn sample<Y>(&self, measures: &[Measure], y: impl Fn(&Case) -> Option<Y>) -> Sample<Y> {
        let mut sample = Sample {
            ln_im: vec![Vec::new(); measures.len()],
            y: Vec::new(),
            clusters: Vec::new(),
            ranges: vec![Range::over([]); measures.len()],
        };
        let columns: Vec<_> = measures.iter().map(|measure| self.columns.get(measure.as_str())).collect();
        for (row, case) in self.all.iter().enumerate() {
            let Some(observed) = y(case) else { continue };
            let values = measures.iter().zip(&columns).map(|(measure, column)| match column {
                Some(column) => Some(column[row]).filter(has_logarithm),
                None => measure.value_of(&case.measures),
            });
            let Some(values) = values.collect::<Option<Vec<f64>>>() else { continue };
            for (k, value) in values.into_iter().enumerate() {
                sample.ln_im[k].push(value.ln());
                sample.ranges[k] = sample.ranges[k].with(value);
            }
            sample.y.push(observed);
            sample.clusters.push(case.cluster);
        }
        sample
    }
}

/// Least and largest value of each measure of a fit among its cases.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MeasureRanges {
    pub im_x: Bounds,
    pub im_y: Bounds,
}

/// Regressors and observations of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample<Y> {
    /// ln IM, a column for each measure.
    pub ln_im: Vec<Vec<f64>>,
    pub y: Vec<Y>,
    pub clusters: Vec<u32>,
    pub ranges: Vec<Range>,
}

impl<Y> Sample<Y> {
    pub(super) fn ranges(&self) -> MeasureRanges {
        let found = |measure: usize| self.ranges.get(measure).filter(|range| range.low.is_finite());
        let [im_x, im_y] = [0, 1].map(|measure| Bounds {
            low: found(measure).map(|range| range.low),
            high: found(measure).map(|range| range.high),
        });
        MeasureRanges { im_x, im_y }
    }

    pub fn x(&self) -> Vec<&[f64]> {
        self.ln_im.iter().map(Vec::as_slice).collect()
    }
}
