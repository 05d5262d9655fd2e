//! Probability that a block overturns in one motion, and its annual rate at a site.

use rockfrag::fragility::{Kind, Model, Peak, Scenarios};
use rockfrag::hazard::{Hazard, HazardCurve, PeakHazard, Site};
use rockfrag::motion::IntensityMeasures;
use rockfrag::rocking::Structure;
use rockfrag::units::G_M_S2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 0.5 m wide and 2 m high. Failure is a rotation beyond a tenth of its slenderness, or overturning.
    let block = Structure::rectangular_block("block", 0.5, 2.0, None)?;
    let model = Model::shipped(Kind::Recorded, &block, 0.10);
    let motion = IntensityMeasures::new(&block, 0.5 * G_M_S2, 0.6, None, None);
    if let Some(given) = model.probabilities(&block, &motion, None, Scenarios::One).given_rocking {
        let p = given.p_ro;
        println!(
            "PGA 0.5 g, PGV 0.6 m/s: overturns with probability {:.3} ({:.3} to {:.3})",
            p.value, p.low, p.high
        );
    }

    // PGA in g, and how often a year it is exceeded.
    let rates = [(0.1, 1e-2), (0.2, 3e-3), (0.5, 5e-4), (1.0, 8e-5), (2.0, 8e-6), (4.0, 4e-7)];
    let curve = HazardCurve::new(rates.map(|(pga_g, rate)| (pga_g * G_M_S2, rate)).to_vec())?;
    // PGV/PGA is that of an average site, in earthquakes of magnitude 6.5.
    let hazard = Hazard::Curve(PeakHazard { peak: Peak::Pga, curve, fractiles: None, velocity: None });
    let (mw, vs30_m_s) = (Some(6.5), None);
    let site = Site { hazard, mw, vs30_m_s, extrapolate: false, responses: Vec::new() };
    if let [Some(rate), Some(low), Some(high)] = site.rates(&[(block, model)], &[]).overturning {
        println!("overturns {rate:.1e} times a year ({low:.1e} to {high:.1e})");
    }
    Ok(())
}
