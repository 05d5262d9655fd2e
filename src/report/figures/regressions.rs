//! Figure 7: the demand in safe rocking over each measure, in logarithms, with its regression.

use crate::fragility::Measure;
use crate::fragility::USEFUL_R2;
use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, demand_label, measure_label};
use crate::report::drawing::{Anchor, Ink, TWO_COLUMNS};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Panel, dot_scale};
use crate::report::text::{Label, number};

/// Draws one figure a group, one panel a measure.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    data.groups.iter().filter(|group| group.safe().next().is_some()).map(figure).collect()
}

fn figure(group: &Group) -> Figure {
    let values = |measure: Measure| -> Vec<[f64; 2]> {
        group.safe().filter_map(|response| Some([measure.of(&response.case)?, response.case.edp])).collect()
    };
    let with_values: Vec<(Measure, Vec<[f64; 2]>)> = Measure::SCALAR
        .map(|measure| (measure, values(measure)))
        .into_iter()
        .filter(|(_, values)| !values.is_empty())
        .collect();
    let grid = Grid { columns: 3, width: TWO_COLUMNS, ..Grid::of(with_values.len(), 105.0) };
    let mut drawing = grid.drawing();
    for (index, (measure, values)) in with_values.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let x = Axis::log_over(values.iter().map(|[x, _]| *x), measure_label(*measure));
        let y = Axis::log_over(values.iter().map(|[_, y]| *y), demand_label());
        let panel = Panel { corner, width, height: grid.panel_height, x, y };
        panel.scatter(
            &mut drawing,
            "safe rocking",
            values,
            0.7 * dot_scale(values.len()),
            Ink::Data(0).thin(0.5),
        );
        let name = Label::plain(format!("IM{}   ", index_of(*measure))).bold();
        let mut title = name.clone();
        if let Some(regression) = group.on(*measure) {
            let law = &regression.law;
            let [ln_a, b, _] = law.ln_median.coefficients;
            let line: Vec<[f64; 2]> =
                panel.x.steps(2).map(|x| [x, libm::exp(ln_a + b * libm::log(x))]).collect();
            panel.curve(&mut drawing, "regression", &line, Ink::Data(1).line(1.2));
            title = Label::marked(&format!(
                "*R*^{{2}} {}  *β* {}  *ζ* {}",
                number::fixed(regression.r2, 2),
                number::fixed(law.beta, 2),
                if b > 0.0 { number::readable(law.beta / b, 3) } else { "none: falls".to_string() }
            ));
            title = name.then(title);
        }
        if group.on(*measure).is_some_and(|regression| regression.r2 < USEFUL_R2) {
            let words = Label::plain("explains next to nothing");
            panel.note(&mut drawing, [0.96, 0.95], Anchor::End, words);
        }
        panel.frame(&mut drawing, title);
    }
    let safe = group.safe().count();
    Figure {
        name: format!("regressions-{}", super::group_file_words(group)),
        title: format!("Demand over one measure: {}", group.name()),
        caption: format!(
            "Demand |θ|max/α of the {} motions in which the structure rocks safely, over each measure of Eq. 13, with its regression ln EDP = ln a + b ln IM; R², dispersion β and modified dispersion ζ = β/b above. {}.{} {}",
            number::count(safe),
            super::structure_words(&group.structure),
            super::without_period(group.safe()).replace("are left out", "have no IM1"),
            super::of_paper("Figure 7")
        ),
        made: String::new(),
        drawing,
    }
}

fn index_of(measure: Measure) -> usize {
    Measure::SCALAR.iter().position(|other| *other == measure).unwrap_or(0) + 1
}
