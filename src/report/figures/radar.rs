//! Figure 8: how well each measure predicts the demand, as R2, beta and zeta around a circle.

use std::f64::consts::PI;

use crate::fragility::Measure;
use crate::report::data::{Group, Regression, ReportData};
use crate::report::drawing::{Anchor, Dash, Drawing, Ink, Point, Step, Stroke, TWO_COLUMNS};
use crate::report::figure::Figure;
use crate::report::panel::{Mark, legend};
use crate::report::text::{Label, number};

const RADIUS: f64 = 52.0;
const RINGS: usize = 4;
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::Short, Dash::Mixed];
/// Value of zeta at the rim over the least zeta: what lies beyond predicts nothing.
const RIM_OF_ZETA: f64 = 5.0;

/// A measure of quality, drawn around one circle.
struct Quality {
    title: &'static str,
    of: fn(&Regression) -> Option<f64>,
    rim: f64,
}

/// Draws one figure of three circles, if there are regressions on the measures.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let groups: Vec<&Group> = data.groups.iter().filter(|group| !group.univariate.is_empty()).collect();
    if groups.is_empty() {
        return Vec::new();
    }
    let zeta = |regression: &Regression| {
        let zeta = regression.law.beta / regression.law.ln_median.coefficients[1];
        (regression.rises && zeta > 0.0).then_some(zeta)
    };
    let all = || groups.iter().flat_map(|group| &group.univariate);
    let largest_r2 = all().map(|regression| regression.r2).fold(0.01, f64::max);
    let largest_beta = all().map(|regression| regression.law.beta).fold(0.0, f64::max);
    let least_zeta = all().filter_map(zeta).fold(f64::INFINITY, f64::min);
    let qualities = [
        Quality {
            title: "*R*^{2}: more is better",
            of: |regression| Some(regression.r2),
            rim: nice(largest_r2).min(1.0),
        },
        Quality {
            title: "*β*: less is better",
            of: |regression| Some(regression.law.beta),
            rim: nice(largest_beta),
        },
        Quality {
            title: "*ζ* = *β* / *b*: less is better",
            of: zeta,
            rim: nice(RIM_OF_ZETA * least_zeta.min(1e6)),
        },
    ];
    let rows = groups.len().div_ceil(2) as f64;
    let top = 12.0 * rows + 26.0;
    let mut drawing = Drawing::new(TWO_COLUMNS, top + 2.0 * RADIUS + 33.0);
    for (index, group) in groups.iter().enumerate() {
        let at = [30.0 + 240.0 * (index % 2) as f64, 10.0 + 12.0 * (index / 2) as f64];
        legend(&mut drawing, at, &[(Mark::Line(stroke(index)), Label::plain(group.name()))]);
    }
    for (index, quality) in qualities.iter().enumerate() {
        let middle = [TWO_COLUMNS * (2 * index + 1) as f64 / 6.0, top + RADIUS + 14.0];
        circle(&mut drawing, quality, &groups, middle);
    }
    vec![Figure {
        name: "radar".to_string(),
        title: "Quality of the six measures".to_string(),
        caption: format!(
            "Coefficient of determination R², dispersion β and modified dispersion ζ of the regression of the demand on each measure. ζ is drawn up to {}: what lies beyond stands on the rim, and there is none where the demand falls with the measure. As Figure 8 of the paper.",
            number::plain(qualities[2].rim)
        ),
        drawing,
    }]
}

fn stroke(index: usize) -> Stroke {
    Ink::Data(index).dashed(1.2, DASHES[index % DASHES.len()])
}

/// Rounds up to one digit, or one and a half.
fn nice(value: f64) -> f64 {
    let power = 10_f64.powf(value.log10().floor());
    (2.0 * value / power).ceil() / 2.0 * power
}

fn circle(drawing: &mut Drawing, Quality { title, of, rim }: &Quality, groups: &[&Group], middle: Point) {
    let at = |index: usize, radius: f64| {
        let angle = 2.0 * PI * index as f64 / Measure::SCALAR.len() as f64;
        [middle[0] + radius * angle.sin(), middle[1] - radius * angle.cos()]
    };
    for ring in 1..=RINGS {
        let radius = RADIUS * ring as f64 / RINGS as f64;
        drawing.path(vec![Step::Circle(middle, radius)], None, Some(Ink::Rule.line(0.4)));
    }
    for index in 0..Measure::SCALAR.len() {
        drawing.line(&[middle, at(index, RADIUS)], Ink::Rule.line(0.4));
        let [x, y] = at(index, RADIUS + 11.0);
        drawing.text([x, y + 2.5], Anchor::Middle, 7.5, Ink::Text, Label::plain(format!("IM{}", index + 1)));
    }
    for (index, group) in groups.iter().enumerate() {
        let places: Vec<Option<Point>> = Measure::SCALAR
            .iter()
            .enumerate()
            .map(|(spoke, measure)| {
                let value = group.on(*measure).and_then(of)?;
                Some(at(spoke, RADIUS * (value / rim).min(1.0)))
            })
            .collect();
        for spoke in 0..places.len() {
            if let (Some(from), Some(to)) = (places[spoke], places[(spoke + 1) % places.len()]) {
                drawing.line(&[from, to], stroke(index));
            }
        }
        drawing.dots(places.into_iter().flatten().collect(), 1.6, Ink::Data(index).full());
    }
    for ring in [RINGS / 2, RINGS] {
        let share = ring as f64 / RINGS as f64;
        let at = [middle[0] + 2.0, middle[1] - RADIUS * share + 6.5];
        drawing.text(at, Anchor::Start, 6.5, Ink::Muted, Label::plain(number::plain(rim * share)));
    }
    let above = [middle[0], middle[1] - RADIUS - 21.0];
    drawing.text(above, Anchor::Middle, 8.0, Ink::Text, Label::marked(title).bold());
}
