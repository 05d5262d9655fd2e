//! What is drawn of an object at a site.

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Fragility, Hazard, HazardCurve, RateByIntensity, Site, exceedance};
use rockfrag_core::object::RockingObject;

/// Return periods whose intensities are marked, years: those of the earthquakes that codes design for and
/// consider.
const USUAL_YEARS: [f64; 2] = [475.0, 2475.0];
/// Bins of intensity.
const BINS: usize = 60;

/// What is drawn of an object at a site: its fragility there, how often an intensity is exceeded, and where the
/// rate of overturning comes from.
#[derive(Debug, Clone)]
pub struct AtSite {
    pub peak: Peak,
    pub curve: HazardCurve,
    pub parts: RateByIntensity,
    pub fragility: Option<Fragility>,
}

/// An intensity that comes once in so many years.
pub struct Usual {
    pub intensity: f64,
    pub years: f64,
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

    /// The intensities of usual return periods, as far as the curve has them, in the unit of the label.
    pub fn usual(&self) -> impl Iterator<Item = Usual> {
        let [(_, often), (_, rarely)] = self.curve.ends();
        let known = USUAL_YEARS.into_iter().filter(move |years| rarely < 1.0 / years && 1.0 / years <= often);
        known.map(|years| {
            let intensity = self.curve.intensity(1.0 / years) / self.peak.name_and_unit().1;
            Usual { intensity, years }
        })
    }
}
