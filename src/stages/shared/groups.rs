//! The responses of each suite and structure, as the fits take them.

use std::collections::HashMap;
use std::sync::Arc;

use anyhow::anyhow;

use crate::fragility::{Case, CaseGroup, Clusters, JointPeaks, cells};
use crate::rocking::Block;
use crate::rocking::Structure;
use crate::table::TableError;
use crate::table::ida::IDA_STRIPES;
use crate::table::responses::{RESPONSES, ResponseCase};
use crate::table::row::Row;
use crate::table::store::reader::Batches;
use crate::table::store::source::{Source, with_part};

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

    /// The size and slenderness, if all responses share them.
    pub fn block(&self) -> Option<Block> {
        let same = |values: &[f64]| {
            values.first().copied().filter(|first| values.iter().all(|value| value == first))
        };
        Some(Block { p_rad_s: same(&self.p_rad_s)?, alpha_rad: same(&self.alpha_rad)? })
    }

    /// How PGA and PGV go together in its motions.
    pub fn peaks(&self) -> Option<JointPeaks> {
        let pgv = |(row, case): (usize, &Case)| {
            let structure = self.structure_of(row);
            case.measures.im5 * structure.uplift_acceleration_m_s2() / structure.p_rad_s
        };
        JointPeaks::of(&self.pga_m_s2, &self.cases.iter().enumerate().map(pgv).collect::<Vec<_>>())
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
    let mut groups: Vec<Builder> = Vec::new();
    let mut places: HashMap<(Option<Arc<str>>, Arc<str>), usize> = HashMap::new();
    let stages = [RESPONSES.stage, IDA_STRIPES.stage];
    for batch in Batches::open_whole(source, &ResponseCase::TABLE, &stages)? {
        for row in ResponseCase::checked(&batch?.columns()).map_err(name_stripes)? {
            let place = *places.entry((row.suite.clone(), row.structure.clone())).or_insert(groups.len());
            match groups.get_mut(place) {
                Some(group) => group.add(row),
                None => groups.push(Builder::of(row)),
            }
        }
    }
    Ok(groups.into_iter().map(Builder::finish).collect())
}

/// Of the files of ida the fits read one.
fn name_stripes(error: TableError) -> anyhow::Error {
    let stripes = match &error {
        TableError::MissingColumn { path, .. } => Some(with_part(path, IDA_STRIPES.name)),
        _ => None,
    };
    match stripes.filter(|stripes| stripes.is_file()) {
        Some(stripes) => anyhow!("{error}; of the files of ida, {} has the responses", stripes.display()),
        None => error.into(),
    }
}

/// A group of which more responses may come.
struct Builder {
    group: Group,
    earthquakes: Vec<Option<Arc<str>>>,
    mw: Vec<Option<f64>>,
    re_km: Vec<Option<f64>>,
}

impl Builder {
    fn of(first: ResponseCase) -> Builder {
        let group = Group {
            suite: first.suite.as_deref().map(str::to_string),
            structure: first.structure.to_string(),
            eta: first.eta,
            cases: Vec::new(),
            p_rad_s: Vec::new(),
            alpha_rad: Vec::new(),
            motion_ids: Vec::new(),
            pga_m_s2: Vec::new(),
            cells: Vec::new(),
            clusters: Clusters::none(),
        };
        let mut builder = Builder { group, earthquakes: Vec::new(), mw: Vec::new(), re_km: Vec::new() };
        builder.add(first);
        builder
    }

    fn add(&mut self, row: ResponseCase) {
        let group = &mut self.group;
        group.cases.push(row.case());
        group.p_rad_s.push(row.p_rad_s);
        group.alpha_rad.push(row.alpha_rad);
        group.motion_ids.push(row.motion_id.to_string());
        group.pga_m_s2.push(row.pga_m_s2);
        self.earthquakes.push(row.earthquake);
        self.mw.push(row.mw);
        self.re_km.push(row.re_km);
    }

    fn finish(self) -> Group {
        let Builder { group, earthquakes, mw, re_km } = self;
        let earthquakes: Vec<Option<&str>> = earthquakes.iter().map(Option::as_deref).collect();
        let clusters = Clusters::new(&group.motion_ids, &earthquakes, &mw, &re_km);
        Group { cells: cells(&mw, &re_km), clusters, ..group }
    }
}
