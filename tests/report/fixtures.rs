//! Answers, responses, fits and traces of which the tests draw figures and pages.

use rockfrag::answer::{
    Answer, AnswerTable, AtSite, Detail, FragilityColumns, ObjectColumns, RateColumns, StateColumns,
    UncertaintyColumns,
};
use rockfrag::chart::Figure;
use rockfrag::document::response::{self, Trace};
use rockfrag::document::{Document, compare};
use rockfrag::figures::*;
use rockfrag::table::motions::MotionRow;
use rockfrag::table::responses::TraceRow;
use rockfrag_core::fragility::{
    Case, Cases, DemandFit, Event, LimitStates, Measure, MotionKind, Peak, Predictors, fit_curve, fit_law,
    fit_planes,
};
use rockfrag_core::hazard::{FragilityPoint, Hazard, HazardCurve, Site};
use rockfrag_core::motion::IntensityMeasures;
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::rocking::{Outcome, SolverEvent, Structure};
use rockfrag_core::statistics::Interval;
use rockfrag_core::studies::ReliabilityBin;
use serde_json::json;

const PLANES: [[f64; 3]; 2] = [[-6.0, 30.0, -2.0], [0.5, 1.5, -2.0]];

/// Responses whose demand lies on the planes; the name of the structure must be escaped.
pub fn cases(p_rad_s: f64, count: usize) -> Cases {
    let name = format!("{p_rad_s}<b & \"c\"\u{1}");
    let structure = Structure::new(&name, p_rad_s, 0.15, 0.92).unwrap();
    let mut cases = Cases::new(Some("csgm"), structure);
    for k in 0..count {
        let (im4, im3) = (1.02 + 0.01 * k as f64, 5.0 + (k % 7) as f64);
        let [ln_a, b1, b2] = PLANES[usize::from(im4 >= 1.3)];
        let demand = (ln_a + b1 * im4.ln() + b2 * im3.ln()).exp();
        let outcome = if k < 90 { Outcome::SafeRocking(demand) } else { Outcome::Overturned };
        let measures = IntensityMeasures::from_peaks(im4, im4 / im3);
        let im1 = k.is_multiple_of(2).then_some(6.0);
        let measures = IntensityMeasures { im1, im2: Some(2.0), im6: Some(0.0), ..measures };
        let peaks = measures.peaks(&cases.structure);
        cases.push(Case { outcome, measures, peaks, mw: None, cluster: 0 }, None);
    }
    cases
}

/// Two structures with their fits.
pub fn tables(count: usize) -> (Vec<Cases>, Fits) {
    let (mut groups, mut tables) = (Vec::new(), Fits { limit_state: 0.1, ..Fits::default() });
    for p_rad_s in [1.0, 2.5] {
        let all = cases(p_rad_s, 100);
        let with = |fit: DemandFit, b: &[f64]| DemandFit { coefficients: b.to_vec(), ..fit };
        tables.demand.extend(fit_planes(&all, 1.3).into_iter().zip(PLANES).map(|(fit, b)| with(fit, &b)));
        let laws = [Measure::Im3, Measure::Im4]
            .map(|measure| with(fit_law(&all, Predictors::one(measure)), &[-2.0, 1.5]));
        tables.demand.extend(laws);
        for (im_x, im_y) in
            [(Measure::Im4, Some(Measure::Im3Inverse)), (Measure::Im4, None), (Measure::Im5, None)]
        {
            let mut fit = fit_curve(&all, Event::Overturning, im_x, im_y.clone());
            fit.coefficients = [-2.0, 1.5, 0.5][..2 + usize::from(im_y.is_some())].to_vec();
            fit.covariance = vec![0.01; fit.coefficients.len().pow(2)];
            tables.curves.push(fit);
        }
        groups.push(cases(p_rad_s, count));
    }
    (groups, tables)
}

pub fn limited(value: f64) -> Interval<Option<f64>> {
    Interval { value, low: 0.3 * value, high: 3.0 * value }.into()
}

/// Answers for so many objects, one on a floor, with all that a page of one shows.
pub fn answers(count: usize, rate: f64) -> AnswerTable {
    let answer = |row: usize| Answer {
        object: ObjectColumns {
            structure: format!("fra*me*{row} {}", "rack ".repeat(9)),
            floor_level: (row == 1).then_some(0.6),
            floor_period_s: Some(0.5),
            p_rad_s: Some(2.7),
            ..ObjectColumns::default()
        },
        p: StateColumns { p_overturning: limited(50.0 * rate / (1 + row) as f64), ..StateColumns::default() },
        rates: RateColumns {
            overturning_per_year: limited(rate),
            years: Some(50.0),
            target: Some(0.01),
            ..RateColumns::default()
        },
        uncertainty: UncertaintyColumns {
            error_eta: Some(0.4),
            error_velocity: Some(0.3),
            ..UncertaintyColumns::default()
        },
        ..Answer::default()
    };
    let rows: Vec<Answer> = (0..count).map(answer).collect();
    let variant = |words: &str, p: f64| Answer {
        variant: Some(words.to_string()),
        p: StateColumns { p_overturning: limited(p), ..StateColumns::default() },
        ..rows.first().cloned().unwrap_or_default()
    };
    let variants = vec![variant("as it is", 0.02), variant("base of 0.60 m", 0.01)];
    let details = vec![Detail { variants, ..Detail::default() }];
    AnswerTable { rows, details, ..AnswerTable::default() }
}

/// An object whose site is drawn, as that of a block.
fn drawn() -> AnswerTable {
    let curve = HazardCurve::new(vec![(0.1, 0.1), (10.0, 1e-4)]).unwrap();
    let block = Object::block("block", 0.5, 2.0);
    let rocking = RockingObject::uncalibrated(&block, MotionKind::Recorded, 0.1).unwrap();
    let mut table = answers(1, 1e-3);
    table.details[0].at_site = AtSite::new(&Site::new(Hazard::over(Peak::Pga, curve)), &rocking);
    table
}

/// The figure of answers.
pub fn figure_of(table: &AnswerTable) -> Figure {
    Document::of_answers(table).main_figure().unwrap_or_default()
}

pub fn fragile(count: usize) -> Answer {
    let point = |k: usize| FragilityPoint {
        intensity: 0.981 * (1 + k) as f64,
        p: LimitStates { rocking: 1.0, failure: 0.5, overturning: 0.4 }
            .map(|p| Interval::around(p, 0.1).into()),
    };
    Answer {
        object: ObjectColumns {
            width_m: Some(0.5),
            height_m: Some(2.0),
            alpha_rad: Some(0.2),
            ..Default::default()
        },
        fragility: FragilityColumns { over: Some(Peak::Pga), ..FragilityColumns::default() },
        points: (0..count).map(point).collect(),
        ..Answer::default()
    }
}

/// A block that rocks to one side, strikes, and overturns to the other.
pub fn traced(count: usize) -> Trace {
    let event = |k: usize| match k {
        100 => Some(SolverEvent::Uplift),
        200 => Some(SolverEvent::Impact),
        300 => Some(SolverEvent::Overturn),
        _ => None,
    };
    let row = |k: usize| TraceRow {
        motion_id: "m<1>".to_string(),
        structure: "fra*me*2".to_string(),
        time_s: 0.01 * k as f64,
        theta_rad: 0.0,
        theta_dot_rad_s: 0.0,
        theta_over_alpha: if k < 100 { 0.0 } else { (0.0314 * (k - 100) as f64).sin() },
        ground_acceleration_m_s2: (0.05 * k as f64).sin(),
        ground_velocity_m_s: 0.2,
        solver_event: event(k),
        p_rad_s: 2.0,
        alpha_rad: 0.2,
        eta: 0.9,
        block_width_m: 0.4,
        block_height_m: 2.0,
    };
    Trace((0..=count * 4).map(row).collect())
}

/// All figures, of `count` data, which may be none.
pub fn figures(count: usize) -> Vec<Figure> {
    let (all, tables) = tables(count);
    let groups: Vec<&Cases> = all.iter().take(count).collect();
    let wave: Vec<f64> = (0..50 * count).map(|k| 2.0 * (0.02 * k.min(157) as f64).sin()).collect();
    let record = |suite: &str| MotionRow {
        motion_id: "1".to_string(),
        suite: Some(suite.to_string()),
        earthquake: None,
        scenario_id: None,
        mw: Some(6.5),
        re_km: Some(10.0),
        dt_s: 0.01,
        pga_m_s2: Some(2.0),
        pgv_m_s: Some(2.0),
        tm_s: Some(3.0),
        tp_s: Some(3.0),
        acceleration_m_s2: wave.clone(),
        path: std::path::PathBuf::new(),
        row: 0,
    };
    let motions = [record("csgm"), record("pulse")];
    let motions = &motions[..1 + count.min(1)];
    let [before, after] = [1e-3, 4e-4].map(|rate| answers(count.min(20), rate));
    let fit = json!([{ "structure": "a", "measure": "scale", "n": count, "n_safe": 0, "n_below": 0,
        "theta": { "value": 0.3, "low": null, "high": null }, "beta": { "value": 0.5, "low": null, "high": null }, "status": "ok" }]);
    let capacity = json!({ "motion_id": "1", "structure": "a", "measure": "scale", "unscaled": 1.0,
        "found": { "capacity": "overturns", "overturning_intensity": 0.3 } });
    let stripe =
        |k: usize| json!({ "structure": "a", "intensity": 0.1 * (1 + k) as f64, "outcome": "overturning" });
    let capacities: Vec<_> = serde_json::from_value(json!(vec![capacity; count])).unwrap();
    let stripes: Vec<_> = serde_json::from_value((0..count).map(stripe).collect()).unwrap();
    let analyses: Vec<_> = serde_json::from_value(fit).unwrap();
    let bin = ReliabilityBin {
        suite: None,
        structure: "a".to_string(),
        event: Event::Failure,
        model: "surface".to_string(),
        predicted: 0.2,
        share: 0.25,
        share_low: 0.0,
        share_high: f64::NAN,
        n: 4,
        observed: 1,
    };
    let fragile = AnswerTable { rows: vec![fragile(count); count.min(9)], ..AnswerTable::default() };
    let compared =
        compare::document(&[before.clone(), after]).and_then(|document| document.main_figure().ok());
    vec![
        motion(motions),
        demand(&groups),
        similarity(&all, motions).unwrap_or_default(),
        regressions(&tables, &all[0]),
        quality(&tables, &groups),
        planes(&tables, &groups),
        exceedance(&tables, &groups),
        overturning(&tables, &groups),
        universality(&(0..count.min(10)).map(|k| cases((0.1 * k as f64).exp(), 200)).collect::<Vec<_>>()),
        hybrids(&tables, &groups),
        maps(&tables, &groups),
        figure_of(&drawn()),
        figure_of(&before),
        compared.unwrap_or_default(),
        figure_of(&fragile),
        response::figure(&traced(count), 0),
        ida(&analyses, &capacities, &stripes),
        validation(&vec![bin; count]),
    ]
}
