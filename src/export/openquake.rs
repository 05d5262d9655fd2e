//! NRML 0.5, the XML of OpenQuake: a fragilityModel. PGA is in g, PGV in cm/s.

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
    let names = LimitState::ALL.iter().map(|state| state.as_str());
    let meanings = names.clone().zip(&model.limit_states);
    let mut description: Vec<String> =
        meanings.map(|(state, meaning)| format!("{state}: {meaning}")).collect();
    let mut tables = String::new();
    for function in functions {
        let (imt, unit) = measure(function.peak);
        let [low, high] = [function.uplift(), function.end_of_data].map(|intensity| intensity / unit);
        let (id, what) = (&function.id, &function.description);
        description.push(format!("{id}: {what}, from {imt} {low:.4} (uplift) to {high:.4}"));
        let levels = numbers(function.levels.iter().map(|level| level / unit));
        let id = escaped(&function.id);
        tables += &format!("    <fragilityFunction id=\"{id}\" format=\"discrete\">\n");
        tables += &format!("      <imls imt=\"{imt}\" noDamageLimit=\"{low}\">{levels}</imls>\n");
        for state in LimitState::ALL {
            let poes = numbers(function.probabilities.iter().map(|p| p.get(*state)));
            tables += &format!("      <poes ls=\"{state}\">{poes}</poes>\n");
        }
        tables += "    </fragilityFunction>\n";
    }
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
  <fragilityModel id="{}" assetCategory="structures" lossCategory="structural">
    <description>{}</description>
    <limitStates>{}</limitStates>
{tables}  </fragilityModel>
</nrml>
"#,
        escaped(&model.id),
        escaped(&description.join(". ")),
        names.collect::<Vec<_>>().join(" "),
    )
}

/// Writes numbers in full, separated by spaces.
fn numbers(values: impl Iterator<Item = f64>) -> String {
    values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ")
}

/// Escapes the signs that mean something in XML.
fn escaped(text: &str) -> String {
    // XML 1.0 has no place for the other control characters, not even as references.
    let clean = text.replace(|sign: char| sign.is_control() && !"\t\n\r".contains(sign), " ");
    let clean = clean.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    clean.replace('"', "&quot;").replace('\'', "&apos;")
}
