//! The capacities of each suite and structure, counted while they come.

use crate::fragility::{KnownCapacity, fit_capacities};
use crate::rocking::{CapacityStatus, Outcome, Scan};
use crate::table::ida::{CapacityRow, FragilityRow, LevelCount, StripeRow};

/// What has come so far, of each suite and structure in the order of their first.
#[derive(Debug, Default)]
pub struct Counts {
    groups: Vec<Group>,
}

/// Of one suite and structure.
#[derive(Debug)]
struct Group {
    suite: Option<String>,
    structure: String,
    measure: &'static str,
    /// Those that overturn at each level.
    overturned: Vec<usize>,
    capacities: Vec<KnownCapacity>,
    with_windows: usize,
}

impl Counts {
    /// Of the stripes and the capacities of some motions.
    pub fn of(scan: &Scan, stripes: &[StripeRow], capacities: &[CapacityRow]) -> Counts {
        let mut counts = Counts::default();
        for (row, stripes) in capacities.iter().zip(stripes.chunks(scan.levels().len())) {
            counts.add(Group::of(scan, row, stripes));
        }
        counts
    }

    /// With what came later.
    pub fn append(&mut self, later: Counts) {
        later.groups.into_iter().for_each(|group| self.add(group));
    }

    fn add(&mut self, later: Group) {
        let is_same = |group: &&mut Group| group.suite == later.suite && group.structure == later.structure;
        let Some(group) = self.groups.iter_mut().find(is_same) else { return self.groups.push(later) };
        group.overturned.iter_mut().zip(later.overturned).for_each(|(count, more)| *count += more);
        group.capacities.extend(later.capacities);
        group.with_windows += later.with_windows;
    }

    /// The fragility of each suite and structure.
    pub fn rows(self, scan: &Scan) -> Vec<FragilityRow> {
        self.groups.into_iter().map(|group| group.row(scan.levels())).collect()
    }
}

impl Group {
    /// Of one motion.
    fn of(scan: &Scan, row: &CapacityRow, stripes: &[StripeRow]) -> Group {
        let overturns = |stripe: &StripeRow| stripe.response.outcome == Outcome::Overturning;
        let capacity = match (row.capacity.status, row.capacity.overturning) {
            (CapacityStatus::Overturns, Some(intensity)) => KnownCapacity::At(intensity),
            (CapacityStatus::Below, _) => KnownCapacity::Below(scan.lowest()),
            _ => KnownCapacity::Above(scan.highest()),
        };
        Group {
            suite: row.suite.map(str::to_string),
            structure: row.structure.name.clone(),
            measure: row.measure,
            overturned: stripes.iter().map(|stripe| usize::from(overturns(stripe))).collect(),
            capacities: vec![capacity],
            with_windows: usize::from(!row.capacity.windows.is_empty()),
        }
    }

    fn row(self, levels: &[f64]) -> FragilityRow {
        let count = |is: &dyn Fn(&KnownCapacity) -> bool| self.capacities.iter().filter(|c| is(c)).count();
        let level = |(&intensity, &overturned)| LevelCount {
            intensity,
            overturned,
            overturned_up_to: count(&|capacity| match capacity {
                KnownCapacity::At(capacity) => *capacity <= intensity,
                KnownCapacity::Below(_) => true,
                KnownCapacity::Above(_) => false,
            }),
        };
        FragilityRow {
            n: self.capacities.len(),
            n_safe: count(&|capacity| matches!(capacity, KnownCapacity::Above(_))),
            n_below: count(&|capacity| matches!(capacity, KnownCapacity::Below(_))),
            n_with_windows: self.with_windows,
            levels: levels.iter().zip(&self.overturned).map(level).collect(),
            fit: fit_capacities(&self.capacities),
            suite: self.suite,
            structure: self.structure,
            measure: self.measure,
        }
    }
}
