use std::f64::consts::TAU;
use std::path::Path;

use super::answer::Answer;
use super::answering::{Answering, Model};
use super::options::HazardOptions;
use crate::fragility::universal::Scenarios;
use crate::fragility::{DOUBTFUL_PEAKS, JointPeaks, LimitState, Peak, Probability, Slice, are_doubtful};
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks, probability_in_years};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::check;
use crate::rocking::Structure;
use crate::stages::evaluate::hazard::Hazard;
use crate::stages::shared::structures::words;
use crate::table::evaluated::{self, RATES, RateRow};
use rayon::prelude::*;

/// Value, lower and upper limit of each limit state in turn.
type Rates = [f64; 9];
/// The place of the rate of overturning among them.
const OVERTURNING: usize = 6;

/// The annual rate of each limit state over the hazard of a site. By the delta method the limits are those of the probabilities at
/// every intensity at once, as if all were too high or too low together; by resamples, those of the rate itself.
pub fn answer(
    options: &HazardOptions,
    path: &Path,
    hazard: Hazard,
    answering: &Answering,
    structure: &Structure,
    console: &Console,
) -> anyhow::Result<Answer> {
    let years = options.years;
    check(years > 0.0 && years.is_finite(), "years", years, "a time above 0")?;
    let mut words_of_ratio = String::new();
    let universal = answering.beside_misfit(Scenarios::Many);
    let rates = match hazard {
        Hazard::Curve(peak, curve) => {
            let line = Line::new(options.ratio, structure, peak, answering)?;
            let rates = along_line(&line, &curve, answering, console)?;
            words_of_ratio = line.words(&curve, answering);
            if let Some(model) = &universal {
                warn_of_universal(&over_curve(&line, &curve, Model::Universal(model)), console);
            }
            with_limits(rates, answering, |model| over_curve(&line, &curve, model))
        }
        Hazard::Joint(joint) => {
            let rates = over_pairs(structure, &joint, answering, console)?;
            if let Some(model) = &universal {
                warn_of_universal(&over_bins(structure, &joint, Model::Universal(model)), console);
            }
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
            "{}\nstructure of {}, over {}\n{words_of_ratio}low and high are 95 % limits of confidence, {}; they do not hold the hazard's own error\n",
            answering.words(),
            words(structure),
            path.display(),
            answering.words_of_limits()
        ),
    })
}

fn warn_of_universal([.., rate, low, high]: &Rates, console: &Console) {
    console.warn(&format!(
        "by the universal surface (--model universal) the annual rate of overturning is {rate:.1e} ({low:.1e} to {high:.1e})"
    ));
}

/// Motions of one peak, and what their other peak is.
struct Line {
    /// The slice of the motions' median p PGV / PGA at uplift, or of the only one.
    slice: Slice,
    ratio: Ratio,
}

/// The p PGV / PGA of motions.
#[derive(Clone, Copy)]
enum Ratio {
    Single(f64),
    /// Distributed as in the motions of the fits, given the intensity.
    Distributed(JointPeaks),
    /// So many standard deviations above the median of that distribution.
    Quantile(JointPeaks, f64),
}

/// The widest step and the last node of the integral over the distribution, in standard deviations: the trapezoidal rule of a
/// smooth function under a normal density is exact to 1e-8 with these.
const STEP: f64 = 0.5;
const LAST_NODE: i32 = 12;

impl Line {
    fn new(
        ratio: Option<f64>,
        structure: &Structure,
        peak: Peak,
        answering: &Answering,
    ) -> anyhow::Result<Line> {
        let ratio = match (ratio, answering.peaks()) {
            (Some(ratio), _) => {
                check(ratio > 0.0 && ratio.is_finite(), "ratio", ratio, "a p PGV / PGA above 0")?;
                Ratio::Single(ratio)
            }
            (None, Some(peaks)) => Ratio::Distributed(peaks),
            (None, None) => {
                return Err(UsageError::because(format!(
                    "a hazard of {} alone needs --ratio, the p PGV / PGA of its motions: what answers does not know it",
                    peak.as_str()
                )));
            }
        };
        let mut line = Line { slice: Slice { structure: structure.clone(), peak, ratio: 1.0 }, ratio };
        line.slice.ratio = line.quantile(0.0).ratios(line.slice.intensity_at_im4(1.0))[0].0;
        Ok(line)
    }

    /// The line along a quantile of the ratio alone.
    fn quantile(&self, deviations: f64) -> Line {
        let ratio = match self.ratio {
            Ratio::Distributed(peaks) | Ratio::Quantile(peaks, _) => Ratio::Quantile(peaks, deviations),
            Ratio::Single(ratio) => Ratio::Single(ratio),
        };
        Line { slice: self.slice.clone(), ratio }
    }

    /// The ratios at an intensity, with their weights.
    fn ratios(&self, intensity: f64) -> Vec<(f64, f64)> {
        let (p, peak) = (self.slice.structure.p_rad_s, self.slice.peak);
        match self.ratio {
            Ratio::Single(ratio) => vec![(ratio, 1.0)],
            Ratio::Quantile(peaks, deviations) => {
                vec![(p * peaks.pgv_over_pga(peak, intensity, deviations), 1.0)]
            }
            Ratio::Distributed(peaks) => (-LAST_NODE..=LAST_NODE)
                .map(|node| STEP * f64::from(node))
                .map(|z| {
                    (p * peaks.pgv_over_pga(peak, intensity, z), STEP * (-0.5 * z * z).exp() / TAU.sqrt())
                })
                .collect(),
        }
    }

    /// Where the ratio comes from, and what another one would change.
    fn words(&self, curve: &HazardCurve, answering: &Answering) -> String {
        let Ratio::Distributed(_) = self.ratio else {
            return "p PGV / PGA is the one of --ratio at all intensities; low and high do not hold its error\n".to_string();
        };
        let overturning =
            |deviations| over_curve(&self.quantile(deviations), curve, answering.model())[OVERTURNING];
        let [low, median, high] = [-1.0, 0.0, 1.0].map(overturning);
        let at_uplift = |deviations| self.quantile(deviations).ratios(self.slice.intensity_at_im4(1.0))[0].0;
        format!(
            "p PGV / PGA is distributed as in the motions of the fits: {:.2} at uplift, {:.2} to {:.2} in two of three motions; with these ratios alone, overturning would have the annual rates {median:.1e}, {low:.1e} and {high:.1e} (--ratio takes one)\n",
            at_uplift(0.0),
            at_uplift(-1.0),
            at_uplift(1.0)
        )
    }
}

fn along_line(
    line: &Line,
    curve: &HazardCurve,
    answering: &Answering,
    console: &Console,
) -> anyhow::Result<Rates> {
    let slice = &line.slice;
    let (model, [(first, _), (last, rate_beyond)]) = (answering.model(), curve.ends());
    let Some(at_last) = limit_states(slice, model, last) else { return Err(periods_needed()) };
    let rates = over_curve(line, curve, model);
    answering.warn_of_slice(slice, last, "the hazard: ", console);
    let (uplift, (unit, size)) = (slice.intensity_at_im4(1.0), slice.peak.usual_unit());
    if first > uplift {
        console.warn(&format!(
            "the hazard begins at {:.4} {unit}, above uplift at {:.4} {unit}: motions between are not counted",
            first / size,
            uplift / size
        ));
    }
    let overturning = rates[OVERTURNING];
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
    let doubtful = joint.bins.iter().filter(|bin| are_doubtful(bin.pga_m_s2, bin.pgv_m_s)).count();
    if doubtful > 0 {
        console.warn(&format!("{doubtful} of {} bins have {DOUBTFUL_PEAKS}", joint.bins.len()));
    }
    Ok(over_bins(structure, joint, model))
}

fn over_curve(line: &Line, curve: &HazardCurve, model: Model) -> Rates {
    curve.mean_annual_rates(&model.jumps(&line.slice), |intensity| {
        let mut slice = line.slice.clone();
        let mut mean = [0.0; 9];
        for (ratio, weight) in line.ratios(intensity) {
            slice.ratio = ratio;
            let states = flat(limit_states(&slice, model, intensity));
            mean.iter_mut().zip(states).for_each(|(mean, state)| *mean += weight * state);
        }
        mean
    })
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
