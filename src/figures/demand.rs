//! Figures 3, 4, 7 and 8: the demand over peak velocity, period and the measures of Eq. 13.

use std::f64::consts::TAU;

use rockfrag_core::fragility::{
    Case, Cases, DemandFit, DemandModel, Group, Measure, Predictors, ln_median_demand,
};
use rockfrag_core::rocking::Structure;
use rockfrag_core::statistics::Range;

use super::common::{DEMAND, Fits, by, compare, demands, label, name, rocked, short_label};
use crate::chart::text::file_words;
use crate::chart::{Axis, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::number;

type CaseValue = fn(&Structure, &Case) -> Option<f64>;

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
    let mut panels = Vec::new();
    for cases in groups {
        let top = TOP * demands(cases).map(|(_, edp)| edp).fold(1.0, f64::max);
        for (label, value) in over {
            let at = |case: &Case, y: f64| Some(Mark::new(value(&cases.structure, case)?, y));
            let safe = demands(cases).filter_map(|(case, edp)| at(case, edp));
            let fallen = rocked(cases).filter(|(_, overturned)| *overturned);
            let fallen = fallen.filter_map(|(case, _)| at(case, top));
            let layers = vec![
                Layer::points("safe rocking", Ink::Data(0), safe),
                Layer::points("overturning, at the top", Ink::Data(1), fallen),
            ];
            let y = Axis::log(DEMAND).over(LEAST, 1.3 * top);
            panels.push(Panel::new(&name(cases), Axis::log(label), y, layers));
        }
    }
    let caption = format!(
        "Each point is a motion in which the structure rocks. The right-hand panels omit motions \
         without a pulse period; demands below {LEAST} are not drawn."
    );
    Figure::new("demand", "Demand over peak velocity and pulse period", 2, 105.0, panels)
        .explained(compare(&caption, "Figures 3 and 4"))
}

/// The modified dispersion beta / b; none where the demand falls with the measure.
fn zeta(fit: &DemandFit) -> Option<f64> {
    let b = fit.coefficients[1];
    Some(fit.beta? / b).filter(|_| b > 0.0)
}

/// Figure 7: the demand in safe rocking over each measure, with its regression, ln EDP = ln a + b ln IM
/// (Eq. 16), if there is one; nothing without any regression.
pub fn regressions(fits: &Fits, cases: &Cases) -> Figure {
    let laws = fits.demand(cases, DemandModel::Univariate);
    let laws: Vec<&DemandFit> = laws.filter(|fit| Measure::SCALAR.contains(&fit.im_x)).collect();
    let mut panels = Vec::new();
    for measure in Measure::SCALAR.into_iter().filter(|_| !laws.is_empty()) {
        let mark = |(case, edp): (&Case, f64)| Some(Mark::new(measure.value_of(&case.measures)?, edp));
        let points: Vec<Mark> = demands(cases).filter_map(mark).collect();
        let Range { low, high } = Range::over(points.iter().map(|point| point.x));
        let mut layers = vec![Layer::points("safe rocking", Ink::Data(0), points)];
        let mut title = short_label(&measure);
        if let Some(fit) = laws.iter().find(|fit| fit.im_x == measure && low < high) {
            let line = [low, high].map(|im| Mark::new(im, ln_median_demand(&fit.coefficients, &[im]).exp()));
            layers.push(Layer::line("regression", Ink::Data(1), line));
            let zeta = zeta(fit).map_or("none".to_string(), |zeta| number::significant(zeta, 3));
            let [r2, beta] = [fit.r2, fit.beta].map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
            title += &format!("\u{2003}*R*^{{2}} {r2}\u{2002}*β* {beta}\u{2002}*ζ* {zeta}");
        }
        panels.push(Panel::new(&title, Axis::log(label(&measure)), Axis::log(DEMAND), layers));
    }
    let group = name(cases);
    let caption = "Demand in safe rocking over each measure of Eq. 13, with ln EDP = ln *a* + *b* ln IM. *β* \
                   is the dispersion and *ζ* = *β*/*b*, which a falling regression does not have.";
    let file = format!("regressions-{}", file_words(&group));
    Figure::new(&file, &format!("Demand over one measure: {group}"), 3, 90.0, panels)
        .explained(compare(caption, "Figure 7"))
}

/// Figure 8: R2, beta and zeta of the regressions of each group over all cases, and how well its curves of
/// overturning predict held-out cases.
pub fn quality(fits: &Fits, groups: &[&Cases]) -> Figure {
    let laws = fits.demand.iter().filter(|fit| fit.model != DemandModel::Biplanar && fit.r2.is_some());
    let panel = |value: fn(&DemandFit) -> Option<f64>, label: &str| {
        let all = laws.clone().map(|fit| (fit.group(), row_label(&fit.predictors()), value(fit)));
        let all: Vec<Quality> = all.collect();
        let range = Range::over(all.iter().filter_map(|(_, _, value)| *value));
        let most = 1.08 * range.high.min(MOST_ZETA * range.low.max(0.2));
        dots(all, Axis::linear(label).over(0.0, most), groups)
    };
    let scores = fits.curves.iter();
    let scores = scores.map(|fit| (fit.group(), row_label(&fit.predictors()), fit.held_out_log_score));
    let score = Axis::linear("log score of overturning on held-out cases (more is better)");
    let panels = [
        panel(|fit| fit.r2, "*R*^{2} (more is better)"),
        panel(|fit| fit.beta, "*β* (less is better)"),
        panel(zeta, "*ζ* = *β* / *b* (less is better)"),
        dots(scores.collect(), score, groups),
    ];
    let caption = "Of the regressions of the demand over all cases, and of the lognormal curves of \
                   overturning. A measure without a dot has no such number, or one far to the right.";
    let figure =
        Figure::new("quality", "Quality of the measures", 2, 0.0, panels.into_iter().flatten().collect());
    figure.explained(compare(caption, "Figure 8"))
}

/// The number of a fit, of which group, and the label of its measures.
type Quality<'a> = (Group<'a>, String, Option<f64>);

fn row_label(predictors: &Predictors) -> String {
    predictors.measures().map(short_label).collect::<Vec<_>>().join(", ")
}

/// A panel with a row for each set of measures and a dot for each group; none without a dot.
fn dots(all: Vec<Quality>, x: Axis, groups: &[&Cases]) -> Option<Panel> {
    let names: Vec<String> = by(&all, |(_, name, _)| name).iter().map(|same| same[0].1.clone()).collect();
    let mut layers = Vec::new();
    for (number, cases) in groups.iter().enumerate() {
        let apart = (number as f64 - 0.5 * (groups.len() as f64 - 1.0)) * 0.6 / groups.len() as f64;
        let its = all.iter().filter(|(group, _, _)| *group == cases.group());
        let marks = its.filter_map(|(_, name, value)| {
            let row = names.iter().position(|other| other == name)?;
            Some(Mark::new((*value)?, row as f64 + apart))
        });
        layers.push(Layer::new(&name(cases), Ink::Data(number), MarkStyle::Estimates, marks));
    }
    layers.retain(|layer| !layer.marks.is_empty());
    (!layers.is_empty()).then(|| Panel::new("", x, Axis::names(names), layers))
}
