//! What is drawn of an object at a site.

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Fragility, Hazard, HazardCurve, RateByIntensity, Site, exceedance};
use rockfrag_core::object::RockingObject;

/// Return periods whose intensities are marked, years: those of the earthquakes that codes design for and
/// consider.
pub const USUAL_YEARS: [f64; 2] = [475.0, 2475.0];
const BINS: usize = 60;

/// Its fragility there, how often an intensity is exceeded, and where the rate of overturning comes from.
#[derive(Debug, Clone)]
pub struct AtSite {
    pub peak: Peak,
    pub curve: HazardCurve,
    pub parts: RateByIntensity,
    pub fragility: Option<Fragility>,
}

impl AtSite {
    /// None for pairs of peaks that make no curve.
    pub fn new(site: &Site, object: &RockingObject) -> Option<AtSite> {
        let (peak, curve) = match &site.hazard {
            Hazard::Curve(hazard) => (hazard.peak, hazard.curve.clone()),
            Hazard::Joint(pairs) => {
                (Peak::Pga, HazardCurve::new(exceedance(pairs, |pair| pair.peaks.pga_m_s2)).ok()?)
            }
        };
        let parts = site.rate_by_intensity(object, BINS);
        Some(AtSite { peak, curve, parts, fragility: site.fragility(object) })
    }

    /// Usual return periods, years, and their intensities in the unit of the label, as far as the curve goes.
    pub fn usual(&self) -> impl Iterator<Item = (f64, f64)> {
        let [(_, often), (_, rarely)] = self.curve.ends();
        let known = USUAL_YEARS.into_iter().filter(move |years| rarely < 1.0 / years && 1.0 / years <= often);
        let unit = self.peak.name_and_unit().1;
        known.map(move |years| (years, self.curve.intensity(1.0 / years) / unit))
    }
}
