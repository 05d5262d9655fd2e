//! The fragility parameters of pelicun: a row of CSV for each function, and JSON with what the rows mean. PGA
//! is in g, PGV in m/s. pelicun draws one uniform number for all limit states of a component, which keeps
//! each within the one before.

use rockfrag_core::fragility::{LimitState, Peak};
use rockfrag_core::units::G_M_S2;
use serde_json::{Map, Value, json};
use strum::VariantArray;

use super::{FragilityModel, Function, GAP};

const COMMON: [&str; 6] =
    ["ID", "Incomplete", "Demand-Type", "Demand-Unit", "Demand-Offset", "Demand-Directional"];
const STATE: [&str; 4] = ["Family", "Theta_0", "Theta_1", "DamageStateWeights"];

/// Least rise of a probability from one level to the next, else the level is left out: pelicun keeps six
/// digits.
const LEAST_RISE: f64 = 2e-6;

/// Returns the name of a peak in pelicun, its unit there, and the size of that unit in m/s2 or m/s.
fn demand(peak: Peak) -> (&'static str, &'static str, f64) {
    match peak {
        Peak::Pga => ("Peak Ground Acceleration", "g", G_M_S2),
        Peak::Pgv => ("Peak Ground Velocity", "mps", 1.0),
    }
}

/// Writes the rows: on the ground PGA alone decides on rocking, from uplift on; else they have tables of their
/// cumulative distribution, which must rise from 0 (just below uplift) to 1 (just above the last level).
pub fn parameters(model: &FragilityModel) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let states = LimitState::VARIANTS.iter();
    let of_states = states.flat_map(|state| STATE.map(|name| format!("{state}-{name}")));
    writer.write_record(COMMON.map(str::to_string).into_iter().chain(of_states))?;
    for function in &model.functions {
        let (name, unit_name, unit) = demand(function.peak);
        // Directional: the peaks are those of one component of motion, which pelicun must not enlarge to that
        // of two.
        let mut row = [&function.id, "0", name, unit_name, "0", "1"].map(str::to_string).to_vec();
        for state in LimitState::VARIANTS {
            let (family, theta) = match 1.0 - function.probabilities[0].get(*state) <= LEAST_RISE {
                true => ("deterministic", (function.levels[0] / unit).to_string()),
                false => ("multilinear_CDF", cumulative_distribution(function, *state, unit)),
            };
            row.extend([family, &theta, "", ""].map(str::to_string));
        }
        writer.write_record(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Writes the levels, a bar, and the probabilities at them.
fn cumulative_distribution(function: &Function, state: LimitState, unit: f64) -> String {
    let mut points = vec![(function.levels[0] * (1.0 - GAP), 0.0)];
    for (&level, probabilities) in function.levels.iter().zip(&function.probabilities) {
        let (last_level, last) = points[points.len() - 1];
        let p = probabilities.get(state);
        if level >= last_level * (1.0 + GAP) && p - last > LEAST_RISE && 1.0 - p > LEAST_RISE {
            points.push((level, p));
        }
    }
    let (last_level, last) = points[points.len() - 1];
    let end = function.levels[function.levels.len() - 1];
    if end >= last_level * (1.0 + GAP) && 1.0 - last > 2.0 * LEAST_RISE {
        points.push((end, last + LEAST_RISE));
    }
    // pelicun knows a whole distribution or none: what is left stands just beyond the last level.
    points.push((end * (1.0 + GAP), 1.0));
    let texts = points.iter().map(|(level, p)| ((level / unit).to_string(), p.to_string()));
    let (levels, probabilities): (Vec<_>, Vec<_>) = texts.unzip();
    format!("{}|{}", levels.join(","), probabilities.join(","))
}

pub fn metadata(model: &FragilityModel) -> Value {
    let mut all = json!({
        "_GeneralInformation": {
            "ShortName": model.id,
            "Description": "Rocking and overturning of free-standing structures",
            "Version": env!("CARGO_PKG_VERSION"),
            "ComponentGroups": { "Rocking structures": [] },
        },
    });
    let states = (1..).zip(&model.limit_states).map(|(number, meaning)| {
        (format!("LS{number}"), json!({ format!("DS{number}"): { "Description": meaning } }))
    });
    let states: Map<String, Value> = states.collect();
    for Function { id, peak, description, levels, .. } in &model.functions {
        let (name, unit_name, unit) = demand(*peak);
        let [low, high] = [levels[0], levels[levels.len() - 1]].map(|intensity| intensity / unit);
        all[id] = json!({
            "Description": description,
            "Comments": format!(
                "Holds from {low:.4} {unit_name} (uplift) to {high:.4} {unit_name}; beyond them the curves are extrapolated. Capacities above {high:.4} {unit_name}, the last level, are set to it."
            ),
            "SuggestedComponentBlockSize": "1 EA",
            "RoundUpToIntegerQuantity": "True",
            "RangeOfData": { "Demand-Type": name, "Demand-Unit": unit_name, "From": low, "To": high },
            "LimitStates": states,
        });
    }
    all
}
