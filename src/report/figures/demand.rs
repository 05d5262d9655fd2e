//! Figures 3, 4, 7 and 8: the demand over peak velocity, period and the measures of Eq. 13.

use super::{Group, RockingCase, compare, demand_axis, file_words, label, name};
use crate::fragility::Measure;
use crate::number;
use crate::report::figure::{Axis, Estimate, Figure, Ink, Layer, Panel};

type CaseValue = fn(&RockingCase) -> Option<f64>;
type FitValue = fn(&MeasureFit) -> Option<f64>;

/// The least demand of Figures 3 and 4: what is below hardly rocks.
const LEAST: f64 = 1e-3;
/// Where overturned structures stand: so many times the largest demand, or 1.
const TOP: f64 = 2.0;
/// Largest zeta of Figure 8, over the least: what lies beyond predicts nothing.
const MOST_ZETA: f64 = 5.0;

/// The regression of the demand on one measure, ln EDP = ln a + b ln IM (Eq. 16).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasureFit {
    pub ln_a: f64,
    pub b: f64,
    pub r2: f64,
    /// Dispersion.
    pub beta: f64,
}

impl MeasureFit {
    /// Returns the modified dispersion beta / b; none where the demand falls with the measure.
    fn zeta(&self) -> Option<f64> {
        (self.b > 0.0).then_some(self.beta / self.b)
    }
}

/// Figures 3 and 4: the demand over peak velocity and pulse period, one row of panels a group.
pub fn demand(groups: &[Group]) -> Figure {
    let over: [(&str, CaseValue); 2] =
        [("PGV (m/s)", |case| Some(case.pgv_m_s)), ("*T*_{p} (s)", |case| case.tp_s)];
    let panels = groups.iter().flat_map(|group| {
        let top = TOP * group.cases.iter().filter_map(RockingCase::demand).fold(1.0, f64::max);
        over.map(|(label, value)| {
            let safe = group.cases.iter().filter_map(|case| Some([value(case)?, case.demand()?]));
            let fallen = group.cases.iter().filter(|case| case.edp.is_none());
            let fallen = fallen.filter_map(|case| Some([value(case)?, top]));
            Panel {
                title: group.name.clone(),
                x: Axis::log(label),
                y: demand_axis().over(LEAST, 1.3 * top),
                layers: vec![
                    Layer::points("safe rocking", Ink::Data(0), safe),
                    Layer::points("overturning, at the top", Ink::Data(1), fallen),
                ],
                notes: Vec::new(),
            }
        })
    });
    Figure {
        name: "demand".to_string(),
        title: "Demand over peak velocity and pulse period".to_string(),
        caption: format!(
            "Each point is a motion in which the structure rocks. Motions without a pulse period are not at the right; demands below {LEAST} are not drawn. {}",
            compare("Figures 3 and 4")
        ),
        columns: 2,
        height: 105.0,
        panels: panels.collect(),
    }
}

/// Figure 7: the demand in safe rocking over each measure, with its regression if there is one.
pub fn regressions(group: &Group, fits: &[Option<MeasureFit>]) -> Figure {
    let panels = Measure::SCALAR.into_iter().zip(fits).map(|(measure, fit)| {
        let points: Vec<[f64; 2]> = group
            .cases
            .iter()
            .filter_map(|case| Some([measure.value_of(&case.measures)?, case.demand()?]))
            .collect();
        let [low, high] =
            points.iter().fold([f64::INFINITY, 0.0_f64], |[low, high], [x, _]| [low.min(*x), high.max(*x)]);
        let mut layers = vec![Layer::points("safe rocking", Ink::Data(0), points)];
        let mut title = name(measure);
        if let Some(fit) = fit.filter(|_| low < high) {
            let line = [low, high].map(|im| [im, (fit.ln_a + fit.b * im.ln()).exp()]);
            layers.push(Layer::line("regression", Ink::Data(1), line.to_vec()));
            let zeta = fit.zeta().map_or("none".to_string(), |zeta| number::significant(zeta, 3));
            let [r2, beta] = [fit.r2, fit.beta].map(|value| number::fixed(value, 2));
            title = format!("{title}\u{2003}*R*^{{2}} {r2}\u{2002}*β* {beta}\u{2002}*ζ* {zeta}");
        }
        Panel { title, x: Axis::log(label(measure)), y: demand_axis(), layers, notes: Vec::new() }
    });
    Figure {
        name: format!("regressions-{}", file_words(&group.name)),
        title: format!("Demand over one measure: {}", group.name),
        caption: format!(
            "Demand in safe rocking over each measure of Eq. 13, with ln EDP = ln *a* + *b* ln IM. *β* is the dispersion and *ζ* = *β*/*b*, which a falling regression does not have. {}",
            compare("Figure 7")
        ),
        columns: 3,
        height: 90.0,
        panels: panels.collect(),
    }
}

/// Figure 8: R2, beta and zeta of the regressions of each group.
pub fn quality(groups: &[(String, Vec<Option<MeasureFit>>)]) -> Figure {
    let qualities: [(&str, &str, FitValue); 3] = [
        ("More is better", "*R*^{2}", |fit| Some(fit.r2)),
        ("Less is better", "*β*", |fit| Some(fit.beta)),
        ("Less is better", "*ζ* = *β* / *b*", MeasureFit::zeta),
    ];
    let panels = qualities.map(|(title, label, value)| {
        let values = |fits: &[Option<MeasureFit>]| -> Vec<Option<f64>> {
            fits.iter().map(|fit| fit.as_ref().and_then(value)).collect()
        };
        let all = || groups.iter().flat_map(|(_, fits)| values(fits)).flatten();
        let [least, largest] = [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)];
        let layers = groups.iter().enumerate().map(|(group, (name, fits))| {
            let apart = (group as f64 - 0.5 * (groups.len() as f64 - 1.0)) * 0.6 / groups.len() as f64;
            let estimate = |(row, value): (usize, Option<f64>)| {
                let y = row as f64 + apart;
                Some(Estimate { x: value?, y, low: f64::NAN, high: f64::NAN, n: f64::NAN })
            };
            Layer::estimates(
                name,
                Ink::Data(group),
                values(fits).into_iter().enumerate().filter_map(estimate).collect(),
            )
        });
        Panel {
            title: title.to_string(),
            x: Axis::linear(label).over(0.0, 1.08 * largest.min(MOST_ZETA * least.max(0.2))),
            y: Axis::names(Measure::SCALAR.into_iter().map(name)),
            layers: layers.collect(),
            notes: Vec::new(),
        }
    });
    Figure {
        name: "quality".to_string(),
        title: "Quality of the measures".to_string(),
        caption: format!(
            "Of the regressions of the demand on one measure. A measure without a dot has no such number, or one far to the right. {}",
            compare("Figure 8")
        ),
        columns: 3,
        panels: panels.to_vec(),
        ..Figure::default()
    }
}
