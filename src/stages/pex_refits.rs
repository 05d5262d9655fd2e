//! The regressions of one group of responses, made anew in resamples of it.

use super::groups::Group;
use super::pex_group::{EVERYWHERE, sample};
use crate::fragility::{DemandRefits, DemandReplicate, DemandSample, PLANE, TransitionSearch};
use crate::resampling::{Resamples, TOGETHER};
use crate::table::pex::{Model, PexReplicate, PexRow};

/// The regressions of a group, to be made anew.
pub struct PexRefits<'a> {
    rows: &'a [PexRow],
    /// The IM4 at which two planes meet, if it is not searched anew.
    transition: Option<f64>,
    search: TransitionSearch,
    refits: Vec<Option<Refit>>,
}

/// How a regression is made anew.
enum Refit {
    /// From cases that stay the same.
    Of(DemandRefits),
    /// Below the break of the resample.
    Below,
    /// Above it.
    Above,
}

/// All fits of one resample.
pub struct Resampled {
    /// The break.
    pub found: Option<f64>,
    /// Of each row.
    pub fits: Vec<Option<PexReplicate>>,
}

impl<'a> PexRefits<'a> {
    /// Of the rows of a group.
    pub fn new(group: &Group, rows: &'a [PexRow], transition: Option<f64>) -> PexRefits<'a> {
        let refit = |row: &PexRow| {
            row.fit.as_ref().ok()?;
            Some(match (row.model, transition, row.range_high) {
                (Model::Biplanar, None, Some(_)) => Refit::Below,
                (Model::Biplanar, None, None) => Refit::Above,
                _ => Refit::Of(DemandRefits::new(&sample(group, row, row.range()))),
            })
        };
        let search = TransitionSearch::new(&DemandSample::new(&group.cases, &PLANE, EVERYWHERE));
        PexRefits { rows, transition, search, refits: rows.iter().map(refit).collect() }
    }

    /// In each of some resamples.
    pub fn resampled(&self, resamples: &Resamples) -> [Resampled; TOGETHER] {
        let breaks = self.search.breaks(resamples);
        let of_all = |refit: &Option<Refit>| match refit {
            Some(Refit::Of(refits)) => refits.replicates(resamples),
            Some(Refit::Below) => breaks.each_ref().map(|at| at.as_ref()?.low.clone()),
            Some(Refit::Above) => breaks.each_ref().map(|at| at.as_ref()?.high.clone()),
            None => [const { None }; TOGETHER],
        };
        let mut fits: Vec<_> = self.refits.iter().map(of_all).collect();
        std::array::from_fn(|resample| {
            let found = breaks[resample].as_ref().map(|at| at.im4);
            let replicate = |(row, fits): (&PexRow, &mut [Option<DemandReplicate>; TOGETHER])| {
                let range = row.range_at(self.transition.or(found))?;
                Some(PexReplicate { range, fit: fits[resample].take()? })
            };
            Resampled { found, fits: self.rows.iter().zip(&mut fits).map(replicate).collect() }
        })
    }
}
