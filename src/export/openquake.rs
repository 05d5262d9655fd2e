//! NRML 0.5, the XML of OpenQuake: a fragilityModel. PGA is in g, PGV in cm/s.

use rockfrag_core::fragility::{LimitState, Peak};
use rockfrag_core::units::{CM_PER_M, G_M_S2};
use strum::VariantArray;

use super::{FragilityModel, Function};
use crate::chart::text::escape;

/// Writes all limit states as tables, between whose levels OpenQuake draws straight lines. Below the first
/// level, uplift, the no-damage limit makes each probability 0; above the last OpenQuake keeps it.
pub fn discrete(model: &FragilityModel) -> String {
    let meanings = LimitState::VARIANTS.iter().zip(&model.limit_states);
    let meanings = meanings.map(|(state, meaning)| format!("{state}: {meaning}"));
    let mut description: Vec<String> = meanings.collect();
    let mut tables = String::new();
    for function in &model.functions {
        let Function { id, peak, description: what, levels, probabilities } = function;
        let (imt, unit) = match peak {
            Peak::Pga => ("PGA", G_M_S2),
            Peak::Pgv => ("PGV", 1.0 / CM_PER_M),
        };
        let [low, high] = [levels[0], levels[levels.len() - 1]].map(|intensity| intensity / unit);
        description.push(format!("{id}: {what}, from {imt} {low:.4} (uplift) to {high:.4}"));
        let levels = numbers(levels.iter().map(|level| level / unit));
        tables += &format!("    <fragilityFunction id=\"{id}\" format=\"discrete\">\n");
        tables += &format!("      <imls imt=\"{imt}\" noDamageLimit=\"{low}\">{levels}</imls>\n");
        for state in LimitState::VARIANTS {
            let poes = numbers(probabilities.iter().map(|p| p.get(*state)));
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
        model.id,
        escape(&description.join(". ")),
        LimitState::VARIANTS.iter().map(LimitState::to_string).collect::<Vec<_>>().join(" "),
    )
}

fn numbers(values: impl Iterator<Item = f64>) -> String {
    values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ")
}
