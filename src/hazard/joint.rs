//! Joint hazard of PGA and PGV.

/// Motions of one bin of PGA and PGV.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairOfPeaks {
    /// Peak ground acceleration that stands for the bin, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity that stands for the bin, m/s.
    pub pgv_m_s: f64,
    /// Mean number of motions of the bin in a year.
    pub annual_rate: f64,
    /// Moment magnitude of the earthquakes, if it is known.
    pub mw: Option<f64>,
}

/// Annual rates of occurrence (not of exceedance) of bins of PGA and PGV that do not overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct JointHazard {
    /// The bins in any order; those without motions may be left out.
    pub bins: Vec<PairOfPeaks>,
}

impl JointHazard {
    /// Finds the annual rates at which the values of one peak are reached, from the smallest on.
    pub fn exceedance(&self, peak: impl Fn(&PairOfPeaks) -> f64) -> Vec<(f64, f64)> {
        let mut values: Vec<(f64, f64)> = self.bins.iter().map(|bin| (peak(bin), bin.annual_rate)).collect();
        values.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut sum = 0.0;
        for (_, rate) in &mut values {
            sum += *rate;
            *rate = sum;
        }
        values.reverse();
        // Of equal values the first holds the rates of all.
        values.dedup_by_key(|(value, _)| *value);
        values
    }

    /// Sums the mean annual rates of events that have these probabilities at a PGA and PGV: the sum over the
    /// bins of rate times probability.
    pub fn mean_annual_rates<const N: usize>(
        &self,
        probabilities: impl Fn(&PairOfPeaks) -> [f64; N],
    ) -> [f64; N] {
        let mut rates = [0.0; N];
        for bin in &self.bins {
            for (sum, p) in rates.iter_mut().zip(probabilities(bin)) {
                *sum += p * bin.annual_rate;
            }
        }
        rates
    }
}
