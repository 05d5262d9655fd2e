//! From scenarios to a fragility curve, without a file: motions and responses of the paper's grid.

use rockfrag_core::fragility::{Case, Cases, Cluster, Event, Measure, fit_curve};
use rockfrag_core::motion::{
    Design, IntensityMeasures, MeasurePlan, MotionModel, Peaks, ScenarioGrid, Suite, Synthesizer,
};
use rockfrag_core::rocking::{Record, Structure, simulate};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let cabinet = Structure::new("electrical-equipment", 2.5, 0.20, 0.92)?;
    let (mw, re_km) = (vec![5.5, 6.0, 6.5, 7.0, 7.5], vec![5.0, 10.0, 15.0, 20.0]);
    let grid = ScenarioGrid { mw, re_km, samples: 20, design: Design::Lhs, seed: 42 };
    let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
    let mut cases = Cases::new(Some("csgm"), cabinet.clone());
    for scenario in (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)) {
        let motion = synthesizer.synthesize(&scenario);
        let of = MeasurePlan::default().measure(&motion.combined, motion.dt_s);
        let peaks = Peaks { pga_m_s2: of.pga_m_s2, pgv_m_s: of.pgv_m_s };
        let measures = IntensityMeasures::new(&cabinet, peaks, Some(scenario.tp_s), of.tm_s);
        let outcome = simulate(&cabinet, &Record::new(&motion.combined, motion.dt_s)?).outcome;
        let mw = Some(scenario.mw);
        let case = Case { outcome, measures, peaks, mw, cluster: 0 };
        cases.push(case, Cluster::new(None, mw, Some(scenario.re_km)));
    }
    let fit = fit_curve(&cases, Event::Overturning, Measure::Im5, None);
    println!("{} of {} that rocked overturned", fit.n_events, fit.n);
    for row in fit.parameters(0.95) {
        println!("{} {:.3} ({:.3} to {:.3})", row.parameter, row.value, row.low, row.high);
    }
    Ok(())
}
