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
}

/// Annual rates of occurrence (not of exceedance) of bins of PGA and PGV that do not overlap.
#[derive(Debug, Clone, PartialEq)]
pub struct JointHazard {
    /// The bins in any order; those without motions may be left out.
    pub bins: Vec<PairOfPeaks>,
}

impl JointHazard {
    /// Sums the mean annual rates of events that have these probabilities at a PGA and PGV: the sum over the bins of rate times
    /// probability.
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
