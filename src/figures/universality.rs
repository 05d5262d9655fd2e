//! How nearly one curve of overturning holds for structures of any p and alpha.

use rockfrag_core::fragility::{Case, Cases, Measure, beta, hybrid_measure, mu, p_overturning};
use rockfrag_core::paper::EXAMPLE_LAMBDA;
use rockfrag_core::statistics::numerics::equal_ratios;
use rockfrag_core::statistics::{FEW_EVENTS, Range, probit};

use super::common::{called, label, motions_of, order, rocked};
use crate::chart::{Axis, Figure, Ink, Layer, Mark, Panel};
use crate::number;
use crate::table::rows::by;

/// The fewest structures of a suite that are drawn.
const LEAST_STRUCTURES: usize = 10;
const STEPS: usize = 60;
/// Slenderness (rad) at which the colour changes.
const SLENDERNESS: [f64; 2] = [0.15, 0.3];

type Over = fn(&Case) -> Option<f64>;

/// A lognormal curve (Eq. 20) over some measure, and the range of its cases.
struct Curve<'a> {
    cases: &'a Cases,
    mu: f64,
    beta: f64,
    range: Range,
}

impl<'a> Curve<'a> {
    fn fit(cases: &'a Cases, measure: Over) -> Option<Curve<'a>> {
        let known = rocked(cases).filter_map(|(case, overturned)| Some((measure(case)?.ln(), overturned)));
        let (x, events): (Vec<f64>, Vec<bool>) = known.unzip();
        let count = events.iter().filter(|event| **event).count();
        if count.min(events.len() - count) < FEW_EVENTS {
            return None;
        }
        let fit = probit(&[&x], &events).ok()?.fit;
        let [mu, beta] = [mu, beta].map(|of| of(fit.coefficients.as_slice()).value);
        let range = Range::over(x.iter().map(|x| x.exp()));
        (beta > 0.0).then_some(Curve { cases, mu, beta, range })
    }

    fn layer(&self) -> Layer {
        let structure = &self.cases.structure;
        let step = SLENDERNESS.iter().filter(|alpha| structure.alpha_rad > **alpha).count();
        let x = equal_ratios(self.range.low, self.range.high, STEPS);
        let marks = x.map(|x| Mark::new(x, p_overturning(x, self.mu, self.beta)));
        Layer::line(&called(structure), Ink::Step(step), marks).unlisted()
    }
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
    let panels = suites.into_iter().flat_map(|groups| {
        measures.map(|(label, measure)| {
            let curves: Vec<Curve> = groups.iter().filter_map(|cases| Curve::fit(cases, measure)).collect();
            (curves.len() >= LEAST_STRUCTURES).then(|| panel(label, &curves, groups.len()))
        })
    });
    let mut panels: Vec<Panel> = panels.flatten().collect();
    one_width(&mut panels);
    let caption = "Lognormal curves of structures that at least ten of one set (one seed) of motions \
                   overturn and ten do not: their number, and the standard deviation (sd) of ln *θ* between them over \
                   their mean *β*. Over a measure for which curves are universal, all medians *θ* are one.";
    let title = "Universality of the curves of overturning";
    Figure::new("universality", title, 3, 118.0, panels).explained(caption)
}

/// Makes a decade as wide in each panel.
fn one_width(panels: &mut [Panel]) {
    let span = |panel: &Panel| Range::over(panel.drawn().flat_map(|layer| &layer.marks).map(|mark| mark.x));
    let widest = panels.iter().map(|panel| span(panel).high / span(panel).low).fold(1.0, f64::max);
    for panel in panels {
        let (middle, half) = ((span(panel).low * span(panel).high).sqrt(), (1.1 * widest).sqrt());
        panel.x.range = Some([middle / half, middle * half]);
    }
}

fn panel(label: &str, curves: &[Curve], structures: usize) -> Panel {
    let n = curves.len() as f64;
    let mean = |of: fn(&Curve) -> f64| curves.iter().map(of).sum::<f64>() / n;
    let (mu, beta) = (mean(|curve| curve.mu), mean(|curve| curve.beta));
    let sd = (curves.iter().map(|curve| (curve.mu - mu).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    let suite = motions_of(curves[0].cases.suite.as_deref().unwrap_or("motions"));
    let title = format!("{suite}, {n} of {structures}: sd / *β* {}", number::fixed(sd / beta, 2));
    let [low, high] = SLENDERNESS;
    let colours = [format!("*α* ≤ {low} rad"), format!("{low} to {high} rad"), format!("> {high} rad")];
    let keys = colours.iter().enumerate().map(|(step, name)| Layer::line(name, Ink::Step(step), []));
    let layers = keys.chain(curves.iter().map(Curve::layer)).collect();
    Panel::new(&title, Axis::log(label), Axis::fraction("*P*_{ro}"), layers)
}
