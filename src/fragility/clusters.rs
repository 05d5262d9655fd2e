//! Which responses may depend on each other.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use crate::keyword::keywords;

/// What the responses of a cluster share.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SharedBy {
    Earthquake,
    /// Magnitude and distance.
    Cell,
    /// Nothing: each response is a cluster of its own.
    Nothing,
}

keywords!(SharedBy { Earthquake = "earthquake", Cell = "cell", Nothing = "nothing" });

/// What is known of a motion that tells which others resemble it. Magnitudes and distances are positive, so that their bits
/// are in the order of their values.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Origin {
    Earthquake(String),
    Cell {
        mw_bits: u64,
        re_km_bits: u64,
    },
    /// The hash of its name: an order that means nothing.
    Motion([u8; 32]),
}

/// The clusters of responses.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Clusters {
    /// The number of the cluster of each response. Numbers do not depend on the order of the responses.
    pub numbers: Vec<usize>,
    /// What those of a cluster share.
    pub shared: SharedBy,
}

impl Clusters {
    /// Those of no responses.
    pub fn none() -> Clusters {
        Clusters { numbers: Vec::new(), shared: SharedBy::Nothing }
    }

    /// Of responses to motions of these names, by the earthquake where it is known, or else by magnitude and distance.
    pub fn new(
        motion_ids: &[String],
        events: &[Option<&str>],
        mw: &[Option<f64>],
        re_km: &[Option<f64>],
    ) -> Clusters {
        let origin = |row: usize| match (events[row], mw[row], re_km[row]) {
            (Some(event), _, _) => Origin::Earthquake(event.to_string()),
            (None, Some(mw), Some(re_km)) => {
                Origin::Cell { mw_bits: mw.to_bits(), re_km_bits: re_km.to_bits() }
            }
            _ => Origin::Motion(*blake3::hash(motion_ids[row].as_bytes()).as_bytes()),
        };
        let origins: Vec<Origin> = (0..motion_ids.len()).map(origin).collect();
        let distinct: BTreeSet<&Origin> = origins.iter().collect();
        let shared = match distinct.first() {
            Some(Origin::Earthquake(_)) => SharedBy::Earthquake,
            Some(Origin::Cell { .. }) => SharedBy::Cell,
            _ => SharedBy::Nothing,
        };
        let numbers: BTreeMap<&Origin, usize> = distinct.into_iter().zip(0..).collect();
        Clusters { numbers: origins.iter().map(|origin| numbers[origin]).collect(), shared }
    }
}

/// Fewer clusters say too little of how they differ: limits that allow for it come out too narrow (Cameron & Miller 2015, section VI).
const MANY: usize = 20;

/// Whether these cases are of many clusters, the clusters being those of all cases.
pub(crate) fn are_many(clusters: &[usize], rows: &[usize]) -> bool {
    let distinct: BTreeSet<usize> = rows.iter().map(|&row| clusters[row]).collect();
    distinct.len() >= MANY
}

/// Numbers the cells of magnitude and distance in the order in which they first appear; responses that have neither are in one cell.
pub fn cells(mw: &[Option<f64>], re_km: &[Option<f64>]) -> Vec<usize> {
    let mut numbers = HashMap::new();
    let bits = |value: &Option<f64>| value.map(f64::to_bits);
    mw.iter()
        .zip(re_km)
        .map(|(mw, re_km)| {
            let next = numbers.len();
            *numbers.entry((bits(mw), bits(re_km))).or_insert(next)
        })
        .collect()
}
