//! Figures 10, 11 and 12: probabilities over a measure, with the observed shares; and maps of overturning
//! over PGA and PGV.

use rockfrag_core::fragility::{
    Calibration, Case, Cases, CurveFit, DemandFit, DemandModel, Event, Measure, PLANE, Predictors, Tau, beta,
    lambda, mu,
};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::statistics::numerics::{bisect_first_true, equal_ratios};
use rockfrag_core::statistics::scores::sample_quantile;
use rockfrag_core::statistics::{FitStatus, Range};
use rockfrag_core::units::G_M_S2;

use super::common::{
    Fits, STEPS, called, compare, estimate, label, motions, name, observed_shares, order, ratio_bins, rocked,
    short_labels,
};
use crate::chart::text::minus;
use crate::chart::{Axis, Dash, Figure, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Symbol, Words};
use crate::number;
use crate::table::rows::by;

/// The most bins of observed shares, and cases for each on average.
const BINS: usize = 14;
const CASES: usize = 8;
/// Quantiles of IM3 at which P_ex is drawn.
const SHARES: [(f64, Dash); 3] = [(0.1, Dash::Solid), (0.5, Dash::Long), (0.9, Dash::Short)];
const CONFIDENCE: f64 = 0.95;
/// The probabilities of which a map has lines.
const LEVELS: [(f64, Dash); 4] =
    [(0.02, Dash::Short), (0.1, Dash::Mixed), (0.5, Dash::Solid), (0.9, Dash::Long)];

/// Figure 10: probability of exceeding the limit state in safe rocking; a panel a group.
pub fn exceedance(fits: &Fits, groups: &[&Cases]) -> Figure {
    let panels = groups.iter().map(|cases| exceeding(fits, cases)).collect();
    let caption = format!(
        "Probability that |*θ*|_{{max}} exceeds {} *α* in safe rocking, by the two planes at quantiles of \
         IM3, and by IM4 alone if it has a curve; bands: 95 %. *P*_{{ex}} jumps, and may fall, where IM4 \
         passes from one plane to the other.",
        number::plain(fits.limit_state)
    );
    let title = "Exceeding the limit state in safe rocking";
    Figure::new("exceedance", title, 2, 118.0, panels).explained(compare(&caption, "Figure 10"))
}

/// P_ex by the planes at quantiles of IM3, and by IM4 alone, each over the IM4 of its cases.
fn exceeding(fits: &Fits, cases: &Cases) -> Panel {
    let curve = |name: &str, ink: Ink, dash: Dash, fit: &DemandFit, im3: f64| {
        let p = |im4: f64| {
            let measures = IntensityMeasures::from_peaks(im4, im4 / im3);
            Some(estimate(im4, fit.p_exceeding(&measures, fits.limit_state, CONFIDENCE)?))
        };
        let range = fit.ranges.im_x.low.zip(fit.ranges.im_x.high).into_iter();
        let im4 = range.flat_map(|(low, high)| equal_ratios(low, high, STEPS));
        Layer::new(name, ink, MarkStyle::Line(dash), im4.filter_map(p))
    };
    let sample = cases.sample(&PLANE, Case::ln_demand);
    let mut layers = Vec::new();
    for (number, (share, dash)) in SHARES.into_iter().enumerate() {
        let Some(ln_im3) = sample_quantile(sample.ln_im[1].clone(), share) else { continue };
        let name = format!("IM3 at its {} % quantile", number::plain(100.0 * share));
        let planes = fits.demand(cases, DemandModel::Biplanar);
        layers.extend(planes.map(|fit| curve(&name, Ink::Data(number), dash, fit, ln_im3.exp())));
    }
    let alone = fits.demand(cases, DemandModel::Univariate).filter(|fit| fit.im_x == Measure::Im4);
    layers.extend(alone.map(|fit| curve("IM4 alone", Ink::Muted, Dash::Mixed, fit, 1.0)));
    Panel::new(&name(cases), Axis::log(label(&Measure::Im4)), Axis::fraction("*P*_{ex}"), layers)
}

const CURVES: &str = "*μ* = ln *θ*, *θ* the median, *β* the dispersion (where *P*_{ro} falls, of the inverse \
                      measure). Curves that fall with a measure of strength have the wrong sign and are not \
                      drawn. Dots: observed fractions. Bands and bars: 95 %.";

/// Figure 11: probability of overturning over single measures; a panel a structure and measure.
pub fn overturning(fits: &Fits, groups: &[&Cases]) -> Figure {
    let caption = format!("Lognormal curves over single measures (Eq. 20): {CURVES}");
    let panels = over(fits, groups, |predictors| predictors.im_y.is_none());
    Figure::new("overturning", "Overturning over single measures", 2, 100.0, panels)
        .explained(compare(&caption, "Figure 11"))
}

/// Figure 12: probability of overturning over hybrid measures (Eq. 23); a panel a structure, pair and suite.
pub fn hybrids(fits: &Fits, groups: &[&Cases]) -> Figure {
    let caption = format!(
        "Lognormal curves over hybrid measures, each with its *λ*: IM_{{x}}^{{*λ*/(1+*λ*)}} \
         IM_{{y}}^{{1/(1+*λ*)}} (Eqs. 23 and 24): {CURVES} As IM5 = IM4 / IM3, the hybrids of any two of \
         these three are one model."
    );
    let panels = over(fits, groups, |predictors| predictors.im_y.is_some());
    Figure::new("hybrid", "Overturning over hybrid measures", 2, 118.0, panels)
        .explained(compare(&caption, "Figure 12"))
}

/// P_ro over measures that are wanted, a panel for each structure and, as a hybrid is of one fit, its suites.
fn over(fits: &Fits, groups: &[&Cases], is_wanted: fn(&Predictors) -> bool) -> Vec<Panel> {
    let pairs = groups.iter().flat_map(|cases| {
        let its = fits.curves.iter().filter(|fit| fit.group() == cases.group());
        its.filter(|fit| is_wanted(&fit.predictors())).map(|fit| (fit, *cases))
    });
    let panel = |(fit, cases): (&CurveFit, &Cases)| {
        let suite = fit.im_y.as_ref().map(|_| cases.suite.clone());
        (cases.structure.name.clone(), fit.predictors(), suite)
    };
    by(pairs, panel).into_iter().map(over_measure).collect()
}

/// Curves of suites of a structure, with their parameters in the corner that the first leaves free.
fn over_measure(curves: Vec<(&CurveFit, &Cases)>) -> Panel {
    let (first, cases) = curves[0];
    let (of, x) = match first.im_y {
        Some(_) => (name(cases), "hybrid measure (Eq. 23)"),
        None => (called(&cases.structure), label(&first.im_x)),
    };
    let title = format!("{of}: {}", short_labels(&first.predictors()));
    let mut panel = Panel::new(&title, Axis::log(x), Axis::fraction("*P*_{ro}"), Vec::new());
    for (fit, cases) in &curves {
        panel.layers.extend(overturned(fit, cases));
    }
    let span = Range::over(panel.layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.x));
    let (x, position) = match beta(&first.coefficients).value < 0.0 {
        true => (span.high, LabelPosition::Left),
        false => (span.low, LabelPosition::Right),
    };
    panel.words.extend(curves.iter().zip(0_i32..).map(|((fit, cases), line)| {
        let (text, ink) = (format!("{}: {}", motions(cases), parameters(fit)), Ink::Data(order(cases)));
        Words { x, y: 0.95 - 0.1 * f64::from(line), text, position, ink }
    }));
    panel
}

fn parameters(fit: &CurveFit) -> String {
    if fit.status == FitStatus::WrongSign {
        return "wrong sign".to_string();
    }
    let b = &fit.coefficients;
    let written = |value: f64| minus(number::significant(value, 2));
    let (mu, beta) = (mu(b).value, beta(b).value);
    let mut words = format!("*μ* {} (*θ* {}), *β* {}", written(mu), written(mu.exp()), written(beta.abs()));
    words.extend(fit.im_y.as_ref().map(|_| format!(", *λ* {}", written(lambda(b).value))));
    words + if beta < 0.0 { ", falls" } else { "" }
}

/// The curve of a fit and the observed shares, over its measure or the hybrid of its two.
fn overturned(fit: &CurveFit, cases: &Cases) -> Vec<Layer> {
    let measures: Vec<Measure> = fit.predictors().measures().cloned().collect();
    let sample = cases.sample(&measures, |case| Event::Overturning.happened(case.outcome, f64::INFINITY));
    let measure = |row: usize| {
        fit.measure_at(&sample.ln_im.iter().map(|column| column[row].exp()).collect::<Vec<f64>>())
    };
    let observed = sample.y.iter().enumerate().map(|(row, event)| (measure(row), *event));
    let observed: Vec<(f64, bool)> = observed.collect();
    let span = Range::over(observed.iter().map(|(value, _)| *value));
    // Of a hybrid, the second measure is at its median.
    let ln_y = sample.ln_im.get(1).and_then(|column| sample_quantile(column.clone(), 0.5));
    let p = |value: f64| {
        let of_hybrid = |ln_y: f64| {
            let lambda = lambda(&fit.coefficients).value;
            vec![(((1.0 + lambda) * value.ln() - ln_y) / lambda).exp(), ln_y.exp()]
        };
        estimate(value, fit.probability_at(&ln_y.map_or(vec![value], of_hybrid), CONFIDENCE))
    };
    let bin = ratio_bins(span, (observed.len() / CASES).clamp(4, BINS));
    let shares = observed_shares(&observed, (observed.len() / 50).clamp(3, 20), bin);
    let (ink, motions) = (Ink::Data(order(cases)), motions(cases));
    let curve = Layer::line(
        &format!("{motions}: lognormal curve"),
        ink,
        equal_ratios(span.low, span.high, STEPS).map(p).filter(|_| fit.status != FitStatus::WrongSign),
    );
    let shares = Layer::new(&format!("{motions}: observed fraction"), ink, MarkStyle::Estimates, shares);
    vec![curve.unlisted(), shares.unlisted()]
}

/// Maps of overturning, a panel a group.
pub fn maps(fits: &Fits, groups: &[&Cases]) -> Figure {
    let caption = "Points: motions in which the structure rocks. Lines: equal probability of overturning by \
                   the calibrated model.";
    let panels = groups.iter().map(|cases| map(fits, cases)).collect();
    Figure::new("map", "Overturning over PGA and PGV", 2, 150.0, panels).explained(caption)
}

fn map(fits: &Fits, cases: &Cases) -> Panel {
    let points = |label: &str, ink, event| {
        let its = rocked(cases).filter(|(_, overturned)| *overturned == event);
        let its = its.map(|(case, _)| Mark::new(case.peaks.pga_m_s2 / G_M_S2, case.peaks.pgv_m_s));
        Layer::points(label, ink, Symbol::Dot, its)
    };
    let mut layers = vec![points("rocks", Ink::Data(0), false), points("overturns", Ink::Data(1), true)];
    let lines = fits.calibration(cases).into_iter().flat_map(|calibration| {
        LEVELS.map(|(level, dash)| {
            let style = MarkStyle::Line(dash);
            Layer::new(&format!("probability {level}"), Ink::Text, style, line(calibration, cases, level))
        })
    });
    layers.extend(lines);
    Panel::new(&name(cases), Axis::log("PGA (g)"), Axis::log("PGV (m/s)"), layers)
}

/// The motions under which a structure overturns with this probability: PGV of each PGA by bisection, as more
/// PGV never lowers the probability.
fn line(calibration: &Calibration, cases: &Cases, level: f64) -> impl Iterator<Item = Mark> {
    let over = |peak: fn(&Case) -> f64| Range::over(rocked(cases).map(|(case, _)| peak(case)));
    let (pga, pgv) = (over(|case| case.peaks.pga_m_s2), over(|case| case.peaks.pgv_m_s));
    let (least, most) = (pgv.low, 1.5 * pgv.high);
    let reaches = move |pga_m_s2: f64, pgv_m_s: f64| {
        let measures = IntensityMeasures::new(&cases.structure, Peaks { pga_m_s2, pgv_m_s }, None, None);
        let p = calibration.probability(&cases.structure, &measures, None, Tau::Included);
        p.is_some_and(|p| p.value >= level)
    };
    equal_ratios(pga.low, pga.high, STEPS).filter_map(move |pga| {
        let is_crossed = reaches(pga, most) && !reaches(pga, least);
        let pgv = is_crossed.then(|| bisect_first_true(least, most, |pgv| reaches(pga, pgv)))?;
        Some(Mark::new(pga / G_M_S2, pgv))
    })
}
