//! NRML 0.5, the XML of OpenQuake: a fragilityModel. PGA is in g, PGV in cm/s.

use std::fmt::Write;

use super::{FragilityModel, Function};
use crate::fragility::{LimitState, Peak};
use crate::keyword::Keyword;
use crate::units::{CM_PER_M, G_M_S2};

/// Returns the name of a peak in NRML, and the size of its unit in m/s2 or m/s.
fn measure(peak: Peak) -> (&'static str, f64) {
    match peak {
        Peak::Pga => ("PGA", G_M_S2),
        Peak::Pgv => ("PGV", 1.0 / CM_PER_M),
    }
}

/// Writes all limit states as tables, between whose levels OpenQuake draws straight lines. Below the first
/// level, uplift, the no-damage limit makes each probability 0; above the last OpenQuake keeps it.
pub fn discrete(model: &FragilityModel, functions: &[Function]) -> String {
    let states = LimitState::ALL;
    document(model, functions, |function| {
        let (imt, unit) = measure(function.peak);
        let levels: Vec<f64> = function.levels.iter().map(|level| level / unit).collect();
        let mut text =
            format!("    <fragilityFunction id=\"{}\" format=\"discrete\">\n", escaped(&function.id));
        let _ = writeln!(
            text,
            "      <imls imt=\"{imt}\" noDamageLimit=\"{}\">{}</imls>",
            function.range_of_data[0] / unit,
            numbers(levels.into_iter())
        );
        for (index, state) in states.iter().enumerate() {
            let poes = numbers(function.probabilities.iter().map(|p| p[index]));
            let _ = writeln!(text, "      <poes ls=\"{}\">{poes}</poes>", state.as_str());
        }
        text
    })
}

fn document(
    model: &FragilityModel,
    functions: &[Function],
    function: impl Fn(&Function) -> String,
) -> String {
    let states = LimitState::ALL;
    let ranges = functions.iter().map(|function| {
        let (imt, unit) = measure(function.peak);
        let [low, high] = function.range_of_data.map(|intensity| intensity / unit);
        format!("{}: holds from {imt} {low:.4} (uplift) to {high:.4}", function.id)
    });
    let meanings = states.iter().zip(&model.limit_states);
    let meanings = meanings.map(|(state, meaning)| format!("{}: {meaning}", state.as_str()));
    let parts: Vec<String> =
        std::iter::once(model.description.clone()).chain(meanings).chain(ranges).collect();
    let names: Vec<&str> = states.iter().map(|state| state.as_str()).collect();
    let mut text = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<nrml xmlns=\"http://openquake.org/xmlns/nrml/0.5\">\n  <fragilityModel id=\"{}\" assetCategory=\"structures\" lossCategory=\"structural\">\n    <description>{}</description>\n    <limitStates>{}</limitStates>\n",
        escaped(&model.id),
        escaped(&parts.join(". ")),
        names.join(" "),
    );
    for each in functions {
        text += &function(each);
        text += "    </fragilityFunction>\n";
    }
    text + "  </fragilityModel>\n</nrml>\n"
}

/// Writes numbers in full, separated by spaces.
fn numbers(values: impl Iterator<Item = f64>) -> String {
    values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ")
}

/// Escapes the signs that mean something in XML.
fn escaped(text: &str) -> String {
    let sign = |sign: char| match sign {
        '&' => "&amp;".to_string(),
        '<' => "&lt;".to_string(),
        '>' => "&gt;".to_string(),
        '"' => "&quot;".to_string(),
        '\'' => "&apos;".to_string(),
        // XML 1.0 has no place for the other control characters, not even as references.
        sign if sign.is_control() && !"\t\n\r".contains(sign) => " ".to_string(),
        sign => sign.to_string(),
    };
    text.chars().map(sign).collect()
}
