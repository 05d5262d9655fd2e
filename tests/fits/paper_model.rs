//! A fragility as the paper has it, for tests.

use rockfrag::fragility::{DemandLaw, DemandModel, FragilityModel, Measure, Predictor};
use rockfrag::rocking::Structure;

/// The paper's electrical equipment.
pub fn equipment() -> Structure {
    Structure::new("equipment", 2.5, 0.20, 0.92).unwrap()
}

/// A law on IM4 and IM3 with independent coefficients.
fn plane(coefficients: [f64; 3], errors: [f64; 3], range_x: [f64; 2]) -> DemandLaw {
    let [a, b, c] = errors.map(|error| error * error);
    let ln_median = Predictor {
        im_x: Measure::Im4,
        im_y: Some(Measure::Im3),
        coefficients,
        covariance: [[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]],
        ranges: [range_x, [0.8, 20.0]],
        bend: None,
        spread: 0.0,
    };
    DemandLaw { ln_median, beta: 1.0, degrees: 400.0 }
}

pub const LAMBDA: f64 = 1.5;
pub const MU: f64 = 0.18;
pub const BETA: f64 = 0.17;

/// Near to what the paper's electrical equipment has under combined motions (Table II).
pub fn model() -> FragilityModel {
    let weight = LAMBDA / (1.0 + LAMBDA);
    let overturning = Predictor {
        im_x: Measure::Im4,
        im_y: Some(Measure::Im3Inverse),
        coefficients: [-MU / BETA, weight / BETA, (1.0 - weight) / BETA],
        covariance: [[0.015, -0.009, 0.005], [-0.009, 0.026, 0.011], [0.005, 0.011, 0.013]],
        ranges: [[1.0, 7.4], [0.05, 1.1]],
        bend: None,
        spread: 0.0,
    };
    let demand = DemandModel::Biplanar {
        transition: 1.3,
        low: plane([-11.39, 30.39, -0.072], [0.29, 1.0, 0.17], [1.0, 1.3]),
        high: plane([-2.765, 2.954, -0.942], [0.08, 0.08, 0.05], [1.3, 7.4]),
    };
    FragilityModel { demand, limit: 0.1, overturning, eta: 0.92 }
}
