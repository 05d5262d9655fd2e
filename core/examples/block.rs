//! How often a cabinet overturns at a site, and with what probability in one motion.

use rockfrag_core::fragility::{MotionKind, Peak};
use rockfrag_core::hazard::{GroundMotion, Hazard, HazardCurve, Site};
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::units::G_M_S2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // 0.5 m wide and 1.9 m high. Failure is a rotation beyond a tenth of its slenderness, or overturning.
    let cabinet = Object::block("cabinet", 0.5, 1.9);
    let object = RockingObject::uncalibrated(&cabinet, MotionKind::Recorded, 0.10)?;

    // PGA in g, and how often a year it is exceeded.
    let points = [(0.1, 1e-2), (0.2, 3e-3), (0.5, 5e-4), (1.0, 8e-5), (2.0, 8e-6), (4.0, 4e-7)];
    let curve = HazardCurve::new(points.map(|(pga_g, rate)| (pga_g * G_M_S2, rate)).to_vec())?;
    let site = Site { mw: Some(6.5), ..Site::new(Hazard::over(Peak::Pga, curve)) };
    let rate = site.rates(&object).states.overturning;
    match (rate.value, rate.low, rate.high) {
        (Some(value), Some(low), Some(high)) => {
            println!("overturns {value:.1e} times a year ({low:.1e} to {high:.1e})");
        }
        (None, Some(low), Some(high)) => {
            println!("overturns {low:.1e} to {high:.1e} times a year: the curve ends early");
        }
        _ => println!("has no rate of overturning"),
    }

    // PGA 0.5 g and PGV 0.6 m/s.
    let motion = GroundMotion { pga_m_s2: Some(0.5 * G_M_S2), pgv_m_s: Some(0.6), mw: None, vs30_m_s: None };
    if let Some(p) = motion.probabilities(&object).states.overturning.estimate() {
        println!(
            "at 0.5 g and 0.6 m/s overturns with probability {:.3} ({:.3} to {:.3})",
            p.value, p.low, p.high
        );
    }
    Ok(())
}
