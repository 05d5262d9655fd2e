//! The responses of each suite and structure, as the fits take them.

use std::collections::HashMap;
use std::sync::Arc;

use anyhow::anyhow;
use rayon::prelude::*;

use crate::fragility::{Case, CaseTable, Clusters, JointPeaks, Placed, SharedBy};
use crate::pipeline::console::Console;
use crate::rocking::Block;
use crate::rocking::Structure;
use crate::statistics::columns::{Columns, Scratch};
use crate::studies::MOST_CASES;
use crate::table::TableError;
use crate::table::ida::IDA_STRIPES;
use crate::table::responses::{RESPONSES, ResponseCase};
use crate::table::row::Row;
use crate::table::store::reader::{Batch, Batches};
use crate::table::store::source::{Source, with_part};

/// All responses of one structure to one suite.
#[derive(Debug)]
pub struct Group {
    /// The suite, if known.
    pub suite: Option<String>,
    /// The structure.
    pub structure: String,
    /// Its coefficient of restitution.
    pub eta: f64,
    /// Its responses, in the order of the file.
    pub cases: CaseTable,
    /// The logarithms of PGA (m/s2) and PGV (m/s) of each.
    peaks: Columns,
    /// The frequency parameter, rad/s, and the slenderness, rad, of each.
    blocks: Columns,
    /// Of the first one.
    first: Block,
    /// Whether all share it.
    is_one_block: bool,
    /// What responses share that may depend on each other.
    pub shared: SharedBy,
}

impl Group {
    /// The size and slenderness, if all responses share them.
    pub fn block(&self) -> Option<Block> {
        self.is_one_block.then_some(self.first)
    }

    /// How PGA and PGV go together in its motions.
    pub fn peaks(&self) -> Option<JointPeaks> {
        JointPeaks::of_logarithms(&self.peaks)
    }

    /// The structure of the first response.
    pub fn structure(&self) -> Structure {
        let Block { p_rad_s, alpha_rad } = self.first;
        Structure { name: self.structure.clone(), p_rad_s, alpha_rad, eta: self.eta }
    }

    /// That of each response, by its number; if they differ, all are held in memory.
    pub fn structure_of(&self) -> impl Fn(usize) -> Structure + Sync {
        let blocks = if self.is_one_block {
            [0, 0].map(|_| Vec::new())
        } else {
            [0, 1].map(|k| self.blocks.column(k))
        };
        let first = self.structure();
        move |row| match &blocks {
            [p, alpha] if !p.is_empty() => {
                Structure { p_rad_s: p[row], alpha_rad: alpha[row], ..first.clone() }
            }
            _ => first.clone(),
        }
    }
}

/// The cases of each group that a study takes, and says so where these are not all.
pub fn spread(groups: &[Group], console: &Console) -> Vec<Vec<Placed>> {
    let spread = |group: &Group| group.cases.spread(MOST_CASES / groups.len());
    let cases: Vec<Vec<Placed>> = groups.iter().map(spread).collect();
    let (all, taken): (usize, usize) =
        (groups.iter().map(|group| group.cases.len()).sum(), cases.iter().map(Vec::len).sum());
    if taken < all {
        console.note(&format!("{taken} of {all} responses are taken, spread over all of them"));
    }
    cases
}

/// The groups of a responses file, or of the stripes of ida, in the order in which they first appear.
///
/// # Errors
/// If the file is none of responses or holds an unknown outcome.
pub fn read(source: impl Into<Source>) -> anyhow::Result<Vec<Group>> {
    read_each(source, |_, _| {})
}

/// Batches whose rows are made at once.
const AT_ONCE: usize = 4;

/// The same; `look` is shown each response before it is added, with the number of its group, and may change it.
///
/// # Errors
/// As [`read`].
pub fn read_each(
    source: impl Into<Source>,
    mut look: impl FnMut(usize, &mut ResponseCase),
) -> anyhow::Result<Vec<Group>> {
    let mut groups: Vec<Builder> = Vec::new();
    let mut places: HashMap<(Option<Arc<str>>, Arc<str>), usize> = HashMap::new();
    let stages = [RESPONSES.stage, IDA_STRIPES.stage];
    let mut batches = Batches::open_whole(source, &ResponseCase::TABLE, &stages)?;
    let scratch = Arc::default();
    loop {
        let some: Vec<Batch> = batches.by_ref().take(AT_ONCE).collect::<Result<_, TableError>>()?;
        if some.is_empty() {
            return Ok(groups.into_iter().map(Builder::finish).collect());
        }
        let rows: Vec<Result<Vec<ResponseCase>, TableError>> =
            some.par_iter().map(|batch| ResponseCase::checked(&batch.columns())).collect();
        for rows in rows {
            for mut row in rows.map_err(name_stripes)? {
                let place = *places.entry((row.suite.clone(), row.structure.clone())).or_insert(groups.len());
                if place == groups.len() {
                    groups.push(Builder::of(&row, &scratch));
                }
                look(place, &mut row);
                groups[place].add(&row);
            }
        }
    }
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
    clusters: Clusters,
}

impl Builder {
    fn of(first: &ResponseCase, scratch: &Arc<Scratch>) -> Builder {
        let group = Group {
            suite: first.suite.as_deref().map(str::to_string),
            structure: first.structure.to_string(),
            eta: first.eta,
            cases: CaseTable::new(scratch),
            peaks: Columns::new(2, scratch),
            blocks: Columns::new(2, scratch),
            first: first.structure().block(),
            is_one_block: true,
            shared: SharedBy::Nothing,
        };
        Builder { group, clusters: Clusters::default() }
    }

    fn add(&mut self, row: &ResponseCase) {
        let Builder { group, clusters } = self;
        let &ResponseCase { mw, re_km, p_rad_s, alpha_rad, pga_m_s2, .. } = row;
        let cluster = clusters.cluster(row.earthquake.as_deref(), mw, re_km, || row.motion_id.to_string());
        let case: Case = row.case();
        group.cases.push(&case, clusters.cell(mw, re_km), cluster);
        let block = Block { p_rad_s, alpha_rad };
        let structure = Structure { name: String::new(), p_rad_s, alpha_rad, eta: row.eta };
        let pgv_m_s = case.measures.im5 * structure.uplift_acceleration_m_s2() / p_rad_s;
        group.peaks.push(&[libm::log(pga_m_s2), libm::log(pgv_m_s)]);
        group.blocks.push(&[p_rad_s, alpha_rad]);
        group.is_one_block &= block == group.first;
    }

    fn finish(self) -> Group {
        let Builder { mut group, clusters } = self;
        group.cases.renumber(clusters.in_order());
        Group { shared: clusters.shared(), ..group }
    }
}
