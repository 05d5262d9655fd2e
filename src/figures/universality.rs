//! How nearly one curve of overturning holds for structures of any p and alpha.

use rockfrag_core::fragility::{Case, Cases, Measure, beta, hybrid_measure, mu};
use rockfrag_core::paper::EXAMPLE_LAMBDA;
use rockfrag_core::statistics::{FEW_EVENTS, Range, probit};

use super::common::{called, label, lognormal, motions, order, rocked};
use crate::chart::{Axis, Figure, Ink, Layer, Panel};
use crate::number;
use crate::table::rows::by;

/// The fewest structures of a suite that are drawn.
const LEAST_STRUCTURES: usize = 10;
/// How many times the mean median an axis reaches up and down: a decade is as wide in each panel.
const REACH: f64 = 10.0;

type Over = fn(&Case) -> Option<f64>;

/// A lognormal curve (Eq. 20) over some measure, drawn over the range of its cases.
struct Curve {
    mu: f64,
    beta: f64,
    line: Layer,
}

/// None where a structure overturns, or does not, too seldom.
fn fit(cases: &Cases, measure: Over) -> Option<Curve> {
    let known = rocked(cases).filter_map(|(case, overturned)| Some((measure(case)?.ln(), overturned)));
    let (ln_im, events): (Vec<f64>, Vec<bool>) = known.unzip();
    let count = events.iter().filter(|event| **event).count();
    if count.min(events.len() - count) < FEW_EVENTS {
        return None;
    }
    let fit = probit(&[&ln_im], &events).ok()?.fit;
    let [mu, beta] = [mu, beta].map(|of| of(fit.coefficients.as_slice()).value);
    let range = Range::over(ln_im.iter().map(|ln_im| ln_im.exp()));
    let line = Layer::line(&called(&cases.structure), Ink::Data(0), lognormal(range, mu, beta)).unlisted();
    (beta > 0.0).then_some(Curve { mu, beta, line })
}

/// Curves of P_ro over PGV, IM5 and the hybrid measure of the paper's exponent; a row a suite of ten or more.
pub fn universality(groups: &[Cases]) -> Figure {
    let hybrid = format!("hybrid of IM4 and 1/IM3, *λ* = {EXAMPLE_LAMBDA}");
    let measures: [(&str, Over); 3] = [
        ("PGV (m/s)", |case| Some(case.peaks.pgv_m_s)),
        (label(&Measure::Im5), |case| Some(case.measures.im5)),
        (&hybrid, |case| Some(hybrid_measure(case.measures.im4, 1.0 / case.measures.im3?, EXAMPLE_LAMBDA))),
    ];
    let mut suites = by(groups, |cases| &cases.suite);
    suites.sort_by_key(|groups| order(groups[0]));
    let mut panels = Vec::new();
    for groups in suites {
        for (label, measure) in measures {
            let curves: Vec<Curve> = groups.iter().filter_map(|cases| fit(cases, measure)).collect();
            if curves.len() >= LEAST_STRUCTURES {
                panels.push(panel(label, curves, &groups));
            }
        }
    }
    let caption = "Lognormal curves of structures that at least ten of one set (one seed) of motions \
                   overturn and ten do not: their number, and the standard deviation (sd) of ln *θ* between \
                   them over their mean *β*. Over a measure for which curves are universal, all medians *θ* \
                   are one.";
    let title = "Universality of the curves of overturning";
    Figure::new("universality", title, 3, 118.0, panels).explained(caption)
}

fn panel(label: &str, curves: Vec<Curve>, groups: &[&Cases]) -> Panel {
    let n = curves.len() as f64;
    let mean = |of: fn(&Curve) -> f64| curves.iter().map(of).sum::<f64>() / n;
    let (mu, beta) = (mean(|curve| curve.mu), mean(|curve| curve.beta));
    let sd = (curves.iter().map(|curve| (curve.mu - mu).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let ratio = number::fixed(sd / beta, 2);
    let title = format!("{}, {n} of {}: sd / *β* {ratio}", motions(groups[0]), groups.len());
    let layers = curves.into_iter().map(|curve| curve.line).collect();
    let x = Axis::log(label).over(mu.exp() / REACH, mu.exp() * REACH);
    Panel::new(&title, x, Axis::fraction("*P*_{ro}"), layers)
}
