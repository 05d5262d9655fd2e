use std::path::Path;

use super::answer::Answer;
use super::answering::{Answering, Model};
use super::options::HazardOptions;
use crate::fragility::{LimitState, Probability, Slice};
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks, probability_in_years};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::check;
use crate::rocking::Structure;
use crate::stages::evaluate::hazard::{self, Hazard};
use crate::stages::shared::structures::words;
use crate::table::evaluated::{self, RATES, RateRow};
use rayon::prelude::*;

/// Value, lower and upper limit of each limit state in turn.
type Rates = [f64; 9];

/// The annual rate of each limit state over the hazard of a site. By the delta method the limits are those of the probabilities at
/// every intensity at once, as if all were too high or too low together; by resamples, those of the rate itself.
pub fn answer(
    options: &HazardOptions,
    path: &Path,
    answering: &Answering,
    structure: &Structure,
    console: &Console,
) -> anyhow::Result<Answer> {
    let years = options.years;
    check(years > 0.0 && years.is_finite(), "years", years, "a time above 0")?;
    let rates = match hazard::read(path)? {
        Hazard::Curve(peak, curve) => {
            let Some(ratio) = options.ratio else {
                return Err(UsageError::because(format!(
                    "a hazard of {} alone needs --ratio, the p PGV / PGA of its motions",
                    peak.as_str()
                )));
            };
            check(ratio > 0.0 && ratio.is_finite(), "ratio", ratio, "a p PGV / PGA above 0")?;
            let slice = Slice { structure: structure.clone(), peak, ratio };
            let rates = along_slice(&slice, &curve, answering, console)?;
            with_limits(rates, answering, |model| over_curve(&slice, &curve, model))
        }
        Hazard::Joint(joint) => {
            let rates = over_pairs(structure, &joint, answering, console)?;
            with_limits(rates, answering, |model| over_bins(structure, &joint, model))
        }
    };
    let row = |(index, &state): (usize, &LimitState)| {
        let annual_rate = [0, 1, 2].map(|part| rates[3 * index + part]);
        let probability = annual_rate.map(|rate| probability_in_years(rate, years));
        RateRow { state, annual_rate, years, probability, meaning: answering.meaning(state) }
    };
    let rows: Vec<RateRow> = LimitState::ALL.iter().enumerate().map(row).collect();
    Ok(Answer {
        table: RATES,
        rows: evaluated::rates(&rows)?,
        heading: format!(
            "{}\nstructure of {}, over {}\n",
            answering.words(),
            words(structure),
            path.display()
        ),
    })
}

fn along_slice(
    slice: &Slice,
    curve: &HazardCurve,
    answering: &Answering,
    console: &Console,
) -> anyhow::Result<Rates> {
    let (model, [(first, _), (last, rate_beyond)]) = (answering.model(), curve.ends());
    let Some(at_last) = limit_states(slice, model, last) else { return Err(periods_needed()) };
    let rates = over_curve(slice, curve, model);
    answering.warn_of_slice(slice, last, "the hazard: ", console);
    let (uplift, (unit, size)) = (slice.intensity_at_im4(1.0), slice.peak.usual_unit());
    if first > uplift {
        console.warn(&format!(
            "the hazard begins at {:.4} {unit}, above uplift at {:.4} {unit}: motions between are not counted",
            first / size,
            uplift / size
        ));
    }
    let [.., overturning, _, _] = rates;
    let uncounted = rate_beyond * (1.0 - at_last[2].value);
    if uncounted > 0.01 * overturning {
        console.warn(&format!(
            "the hazard ends at {:.4} {unit}; stronger motions count as this one, and could add {uncounted:.1e} a year",
            last / size
        ));
    }
    Ok(rates)
}

fn over_pairs(
    structure: &Structure,
    joint: &JointHazard,
    answering: &Answering,
    console: &Console,
) -> anyhow::Result<Rates> {
    let model = answering.model();
    let measures = |bin: &PairOfPeaks| measures_of(structure, bin);
    let states = |bin: &PairOfPeaks| model.probabilities(structure, &measures(bin)).limit_states();
    if joint.bins.iter().any(|bin| states(bin).is_none()) {
        return Err(periods_needed());
    }
    let is_outside = |bin: &&PairOfPeaks| !model.out_of_range(&measures(bin)).is_empty();
    let outside = joint.bins.iter().filter(is_outside).count();
    if outside > 0 {
        let all = joint.bins.len();
        console.warn(&format!("{outside} of {all} bins lie outside of the data: extrapolated"));
    }
    Ok(over_bins(structure, joint, model))
}

fn over_curve(slice: &Slice, curve: &HazardCurve, model: Model) -> Rates {
    curve.mean_annual_rates(&model.jumps(slice), |intensity| flat(limit_states(slice, model, intensity)))
}

fn over_bins(structure: &Structure, joint: &JointHazard, model: Model) -> Rates {
    joint.mean_annual_rates(|bin| {
        flat(model.probabilities(structure, &measures_of(structure, bin)).limit_states())
    })
}

/// The rates with limits from those of each resample, if there are any.
fn with_limits(rates: Rates, answering: &Answering, rates_of: impl Fn(Model) -> Rates + Sync) -> Rates {
    let Some(resampled) = answering.resampled() else { return rates };
    let replicates: Vec<Option<Rates>> =
        resampled.replicates.par_iter().map(|model| model.as_ref().map(Model::Fits).map(&rates_of)).collect();
    let mut limited = rates;
    // Of rocking, which is certain from uplift on, the limits are the rate itself.
    for (k, state) in limited.chunks_exact_mut(3).enumerate().skip(1) {
        let values: Vec<Option<f64>> = replicates.iter().map(|rates| Some(rates.as_ref()?[3 * k])).collect();
        let Probability { low, high, .. } = resampled.about(state[0], &values);
        (state[1], state[2]) = (low, high);
    }
    limited
}

fn limit_states(slice: &Slice, model: Model, intensity: f64) -> Option<[Probability; 3]> {
    model.probabilities(&slice.structure, &slice.measures(intensity)).limit_states()
}

fn measures_of(structure: &Structure, bin: &PairOfPeaks) -> IntensityMeasures {
    IntensityMeasures::new(structure, bin.pga_m_s2, bin.pgv_m_s, None, None)
}

fn flat(states: Option<[Probability; 3]>) -> Rates {
    let parts = states.map(|states| states.map(|p| [p.value, p.low, p.high]));
    let mut flat = [f64::NAN; 9];
    flat.iter_mut().zip(parts.iter().flatten().flatten()).for_each(|(cell, part)| *cell = *part);
    flat
}

fn periods_needed() -> anyhow::Error {
    UsageError::because(
        "these fits need the period of each motion, or a velocity above 0; a hazard has none: use the bivariate model, or --measure im4 or im5",
    )
}
