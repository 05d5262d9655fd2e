//! What the page of one object shows beside its row: data alone.

use crate::hazard::Fragility;
use crate::number::Limited;

/// What a page of one object shows beside its row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Portrait {
    pub outline: Option<Outline>,
    pub fragility: Option<Fragility>,
    pub hazard: Option<HazardCurve>,
    /// What would change the answer, with the probability of overturning; as it is first.
    pub changes: Vec<(String, Limited)>,
}

/// An object in the plane in which it rocks, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outline {
    pub width: f64,
    pub height: f64,
    pub centre_height: f64,
    pub centre_offset: f64,
    pub alpha_rad: f64,
}

/// Annual rates of exceedance, and where the rate of overturning comes from.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct HazardCurve {
    /// What the intensity is, with its unit.
    pub label: String,
    pub points: Vec<[f64; 2]>,
    /// Intensities that come once in so many years.
    pub usual: Vec<(f64, f64)>,
    /// Ends of a bin of intensity, and its share of the rate; that beyond the curve is left out.
    pub shares: Vec<([f64; 2], f64)>,
    /// The share beyond the curve.
    pub beyond: f64,
}
