//! Figures 3, 4, 7 and 8: the demand over peak velocity, period and the measures of Eq. 13.

use std::f64::consts::TAU;

use super::common::{DEMAND, Fits, compare, demand_fits, demands, ends, label, name, rocked};
use crate::fragility::{Case, Cases, DemandFit, DemandModel, Measure, ln_median_demand};
use crate::keyword::Keyword;
use crate::number;
use crate::report::{Axis, Estimate, Figure, Ink, Layer, Panel};
use crate::rocking::Structure;

type CaseValue = fn(&Structure, &Case) -> Option<f64>;
type FitValue = fn(&DemandFit) -> Option<f64>;

/// The least demand of Figures 3 and 4: what is below hardly rocks.
const LEAST: f64 = 1e-3;
/// Where overturned structures stand: so many times the largest demand, or 1.
const TOP: f64 = 2.0;
/// Largest zeta of Figure 8, over the least: what lies beyond predicts nothing.
const MOST_ZETA: f64 = 5.0;

/// Figures 3 and 4: the demand over peak velocity and pulse period, one row of panels a group.
pub fn demand(groups: &[&Cases]) -> Figure {
    let over: [(&str, CaseValue); 2] = [
        ("PGV (m/s)", |_, case| Some(case.peaks.pgv_m_s)),
        ("*T*_{p} (s)", |structure, case| Some(TAU / (case.measures.im1? * structure.p_rad_s))),
    ];
    let panels = groups.iter().flat_map(|cases| {
        let top = TOP * demands(cases).map(|(_, edp)| edp).fold(1.0, f64::max);
        over.map(|(label, value)| {
            let value = |case: &Case| value(&cases.structure, case);
            let safe = demands(cases).filter_map(|(case, edp)| Some([value(case)?, edp]));
            let fallen = rocked(cases).filter(|(_, overturned)| *overturned);
            let fallen = fallen.filter_map(|(case, _)| Some([value(case)?, top]));
            let layers = vec![
                Layer::points("safe rocking", Ink::Data(0), safe),
                Layer::points("overturning, at the top", Ink::Data(1), fallen),
            ];
            Panel::new(&name(cases), Axis::log(label), Axis::log(DEMAND).over(LEAST, 1.3 * top), layers)
        })
    });
    let caption = format!(
        "Each point is a motion in which the structure rocks. The right-hand panels omit motions \
         without a pulse period; demands below {LEAST} are not drawn."
    );
    let caption = compare(&caption, "Figures 3 and 4");
    Figure::new("demand", "Demand over peak velocity and pulse period", caption, 2, 105.0, panels.collect())
}

/// The regression of the demand on each measure, ln EDP = ln a + b ln IM (Eq. 16), if there is one.
pub fn power_laws<'a>(fits: &'a Fits, cases: &Cases) -> [Option<&'a DemandFit>; Measure::SCALAR.len()] {
    Measure::SCALAR.map(|measure| {
        let fit = demand_fits(fits, cases, DemandModel::Univariate).find(|fit| fit.im_x == measure);
        fit.filter(|fit| fit.r2.is_some() && fit.beta.is_some())
    })
}

/// The modified dispersion beta / b; none where the demand falls with the measure.
fn zeta(fit: &DemandFit) -> Option<f64> {
    let b = fit.coefficients[1];
    Some(fit.beta? / b).filter(|_| b > 0.0)
}

fn name_of(measure: Measure) -> String {
    measure.as_str().to_uppercase()
}

/// Figure 7: the demand in safe rocking over each measure, with its regression if there is one.
pub fn regressions(fits: &Fits, cases: &Cases) -> Figure {
    let panel = |(measure, fit): (Measure, Option<&DemandFit>)| {
        let point = |(case, edp): (&Case, f64)| Some([measure.value_of(&case.measures)?, edp]);
        let points: Vec<[f64; 2]> = demands(cases).filter_map(point).collect();
        let [low, high] = ends(points.iter().map(|point| point[0]));
        let mut layers = vec![Layer::points("safe rocking", Ink::Data(0), points)];
        let mut title = name_of(measure);
        if let Some(fit) = fit.filter(|_| low < high) {
            let line = [low, high].map(|im| [im, ln_median_demand(&fit.coefficients, &[im]).exp()]);
            layers.push(Layer::line("regression", Ink::Data(1), line.to_vec()));
            let zeta = zeta(fit).map_or("none".to_string(), |zeta| number::significant(zeta, 3));
            let [r2, beta] = [fit.r2, fit.beta].map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
            title += &format!("\u{2003}*R*^{{2}} {r2}\u{2002}*β* {beta}\u{2002}*ζ* {zeta}");
        }
        Panel::new(&title, Axis::log(label(measure)), Axis::log(DEMAND), layers)
    };
    let panels = Measure::SCALAR.into_iter().zip(power_laws(fits, cases)).map(panel).collect();
    let group = name(cases);
    let caption = "Demand in safe rocking over each measure of Eq. 13, with ln EDP = ln *a* + *b* ln IM. *β* \
                   is the dispersion and *ζ* = *β*/*b*, which a falling regression does not have.";
    let words = group.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let file = format!("regressions-{}", words.collect::<Vec<_>>().join("-").to_lowercase());
    let title = format!("Demand over one measure: {group}");
    Figure::new(&file, &title, compare(caption, "Figure 7"), 3, 90.0, panels)
}

/// Figure 8: R2, beta and zeta of the regressions of each group.
pub fn quality(fits: &Fits, groups: &[&Cases]) -> Figure {
    let qualities: [(&str, &str, FitValue); 3] = [
        ("More is better", "*R*^{2}", |fit| fit.r2),
        ("Less is better", "*β*", |fit| fit.beta),
        ("Less is better", "*ζ* = *β* / *b*", zeta),
    ];
    let panels = qualities.iter().filter(|_| !groups.is_empty()).map(|&(title, label, value)| {
        let values = |cases: &Cases| power_laws(fits, cases).map(|fit| fit.and_then(value));
        let [least, largest] = ends(groups.iter().flat_map(|cases| values(cases)).flatten());
        let layer = |(number, cases): (usize, &&Cases)| {
            let apart = (number as f64 - 0.5 * (groups.len() as f64 - 1.0)) * 0.6 / groups.len() as f64;
            let estimate = |(row, x): (usize, Option<f64>)| {
                Some(Estimate { x: x?, y: row as f64 + apart, low: f64::NAN, high: f64::NAN, n: f64::NAN })
            };
            let estimates = values(cases).into_iter().enumerate().filter_map(estimate);
            Layer::estimates(&name(cases), Ink::Data(number), estimates)
        };
        let x = Axis::linear(label).over(0.0, 1.08 * largest.min(MOST_ZETA * least.max(0.2)));
        let y = Axis::names(Measure::SCALAR.map(name_of));
        Panel::new(title, x, y, groups.iter().enumerate().map(layer).collect())
    });
    let caption = "Of the regressions of the demand on one measure. A measure without a dot has no such \
                   number, or one far to the right.";
    let caption = compare(caption, "Figure 8");
    Figure::new("quality", "Quality of the measures", caption, 3, 0.0, panels.collect())
}
