//! The answer over PGA and PGV: lines of equal probability of overturning, and what came of each motion.

use rockfrag_core::fragility::{Calibration, Cases, MotionKind, Tau};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::statistics::Range;
use rockfrag_core::statistics::numerics::{bisect_first_true, equal_ratios};
use rockfrag_core::units::G_M_S2;

use super::common::{Fits, called, name, rocked};
use crate::chart::{Axis, Dash, Figure, Ink, Layer, Mark, MarkStyle, Panel};

/// The probabilities of which lines are drawn.
const LEVELS: [(f64, Dash); 4] =
    [(0.02, Dash::Short), (0.1, Dash::Mixed), (0.5, Dash::Solid), (0.9, Dash::Long)];
/// Number of points of a line.
const STEPS: usize = 120;

/// Maps of overturning, one panel per suite: of its first structure, with a line for each of the others.
pub fn maps(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let caption = "Each point is a motion in which the structure rocks. Lines join motions of equal \
                   probability of overturning by the model, calibrated with these responses; coloured lines \
                   are those of probability 0.5 of other structures.";
    let panels = suites.iter().filter_map(|groups| Some(panel(fits, groups.split_first()?)));
    Figure::new("map", "Overturning over PGA and PGV", 2, 150.0, panels.collect()).explained(caption)
}

fn panel(fits: &Fits, (cases, others): (&&Cases, &[&Cases])) -> Panel {
    let mut layers = Vec::new();
    for (label, ink, event) in [("rocks", Ink::Data(0), false), ("overturns", Ink::Data(1), true)] {
        let its = rocked(cases).filter(|(_, overturned)| *overturned == event);
        let its = its.map(|(case, _)| Mark::new(case.peaks.pga_m_s2 / G_M_S2, case.peaks.pgv_m_s));
        layers.push(Layer::points(label, ink, its));
    }
    let all = Range::over(cases.all.iter().map(|case| case.peaks.pga_m_s2));
    let pga = Range { low: all.low.max(cases.structure.uplift_acceleration_m_s2()), high: all.high };
    let pgv = Range::over(cases.all.iter().map(|case| case.peaks.pgv_m_s));
    let pgv = Range { high: 1.5 * pgv.high, ..pgv };
    for (level, dash) in LEVELS {
        let line = line(fits, cases, level, pga, pgv);
        layers.push(Layer::new(&format!("probability {level}"), Ink::Text, MarkStyle::Line(dash), line));
    }
    for (number, other) in (2..).zip(others) {
        let label = format!("{}, 0.5", called(&other.structure));
        layers.push(Layer::line(&label, Ink::Data(number), line(fits, other, 0.5, pga, pgv)));
    }
    Panel::new(&name(cases), Axis::log("PGA (g)"), Axis::log("PGV (m/s)"), layers)
}

/// The motions under which a structure overturns with this probability, within these PGA and PGV (m/s2 and
/// m/s): PGV of each PGA by bisection, as more PGV never lowers the probability.
fn line(fits: &Fits, cases: &Cases, level: f64, pga: Range, pgv: Range) -> Vec<Mark> {
    let structure = &cases.structure;
    let uncalibrated =
        || Calibration::uncalibrated(MotionKind::from_suite(cases.suite.as_deref()), structure, None);
    let calibration = fits.calibration(cases).cloned().unwrap_or_else(uncalibrated);
    let reaches = |pga: f64, ln_pgv: f64| {
        let peaks = Peaks { pga_m_s2: pga, pgv_m_s: ln_pgv.exp() };
        let measures = IntensityMeasures::new(structure, peaks, None, None);
        let p = calibration.probability(structure, &measures, None, Tau::Included);
        p.is_some_and(|p| p.value >= level && measures.im4 >= 1.0)
    };
    let (least, most) = (pgv.low.ln(), pgv.high.ln());
    let mut marks = Vec::new();
    for pga in equal_ratios(pga.low, pga.high, STEPS) {
        let is_crossed = reaches(pga, most) && !reaches(pga, least);
        let ln_pgv = is_crossed.then(|| bisect_first_true(least, most, |ln_pgv| reaches(pga, ln_pgv)));
        marks.push(Mark::new(pga / G_M_S2, ln_pgv.map_or(f64::NAN, f64::exp)));
    }
    marks
}
