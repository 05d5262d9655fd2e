//! Annual rates over the hazard of a site.

use std::f64::consts::TAU;
use std::path::Path;

use rayon::prelude::*;
use serde_json::json;

use super::answer::Answer;
use super::hazard::Hazard;
use super::options::HazardOptions;
use crate::fragility::universal::Scenarios;
use crate::fragility::{
    Fragility, FragilityModel, JointPeaks, LimitState, Lognormal, Peak, PeaksDoubt, Probability,
    STRONGEST_PGA_M_S2, Slice, doubt_of_peaks, doubt_of_ratio,
};
use crate::hazard::{HazardCurve, JointHazard, PairOfPeaks, probability_in_years};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::check;
use crate::rocking::Structure;
use crate::stages::shared::answers::Answers;
use crate::stages::shared::structures::words;
use crate::table::evaluated::{self, RATES, RateRow, RecordedCurve, RecordedHazard};
use crate::table::store::folder::file_name;

/// The annual rate of each limit state, with its limits.
#[derive(Clone, Copy)]
struct Rates {
    rocking: Probability,
    failure: Probability,
    overturning: Probability,
}

impl Rates {
    /// Of the sums over a hazard.
    fn of(parts: [f64; 9]) -> Rates {
        let rate = |k: usize| Probability { value: parts[k], low: parts[k + 1], high: parts[k + 2] };
        Rates { rocking: rate(0), failure: rate(3), overturning: rate(6) }
    }

    fn of_state(&self, state: LimitState) -> Probability {
        match state {
            LimitState::Rocking => self.rocking,
            LimitState::Failure => self.failure,
            LimitState::Overturning => self.overturning,
        }
    }
}

/// The terms of those sums: value and limits of each limit state in turn.
fn parts(states: Option<[Probability; 3]>) -> [f64; 9] {
    states.map_or([f64::NAN; 9], |states| {
        let mut parts = [0.0; 9];
        let all = states.into_iter().flat_map(|p| [p.value, p.low, p.high]);
        parts.iter_mut().zip(all).for_each(|(part, value)| *part = value);
        parts
    })
}

/// The annual rate of each limit state over the hazard of a site. By the delta method the limits are those of the probabilities at
/// every intensity at once, as if all were too high or too low together; by resamples, those of the rate itself.
pub fn answer(
    options: &HazardOptions,
    path: &Path,
    hazard: Hazard,
    answers: &dyn Answers,
    structure: &Structure,
    console: &Console,
) -> anyhow::Result<Answer> {
    let years = options.years;
    check(years > 0.0 && years.is_finite(), "years", years, "a time above 0")?;
    let mut words_of_ratio = String::new();
    let hazard_shown = recorded(path, &hazard);
    let surface = answers.surface(Scenarios::Many);
    let surface = surface.as_ref().map(|surface| surface as &dyn Fragility);
    let mut peaks_of_fits = "";
    let (rates, by_surface) = match hazard {
        Hazard::Curve(peak, curve) => {
            let line = Line::new(options.ratio, structure, peak, answers)?;
            options.ratio.and_then(doubt_of_ratio).into_iter().for_each(|doubt| console.warn(&doubt));
            let rates = along_line(&line, &curve, answers, console)?;
            words_of_ratio = line.words(&curve, answers);
            if let Ratio::Distributed(_) = line.ratio {
                peaks_of_fits = ", over PGV / PGA as in the motions of the fits, not as in its own";
            }
            let of = |model: &dyn Fragility| over_curve(&line, &curve, model);
            (with_limits(rates, answers, of), surface.map(of))
        }
        Hazard::Joint(joint) => {
            let rates = over_pairs(structure, &joint, answers, console)?;
            let of = |model: &dyn Fragility| over_bins(structure, &joint, model);
            (with_limits(rates, answers, of), surface.map(of))
        }
    };
    let words_of_surface = by_surface.map_or(String::new(), |Rates { overturning: Probability { value, low, high }, .. }| {
        let words = format!(
            "by the universal surface (--model universal) the annual rate of overturning is {value:.1e} ({low:.1e} to {high:.1e}){peaks_of_fits}"
        );
        if !(low..=high).contains(&rates.overturning.value) {
            console.warn(&words);
        }
        words + "\n"
    });
    let row = |&state: &LimitState| {
        let Probability { value, low, high } = rates.of_state(state);
        let annual_rate = [value, low, high];
        let probability = annual_rate.map(|rate| probability_in_years(rate, years));
        let meaning = match state {
            LimitState::Rocking => format!("{}, from the hazard alone", answers.meaning(state)),
            _ => answers.meaning(state),
        };
        RateRow { state, annual_rate, years, probability, meaning }
    };
    let rows: Vec<RateRow> = LimitState::ALL.iter().map(row).collect();
    let words_of_limits = format!(
        "low and high are 95 % confidence limits, {}; they do not cover the hazard's own error",
        answers.words_of_limits()
    );
    let notes = [words_of_ratio, words_of_surface, words_of_limits];
    let notes = notes.iter().flat_map(|words| words.lines()).map(str::to_string).collect::<Vec<_>>();
    Ok(Answer {
        table: RATES,
        rows: evaluated::rates(&rows)?,
        heading: format!(
            "{}\nstructure of {}, over {}\n{}\n",
            answers.words(),
            words(structure),
            path.display(),
            notes.join("\n")
        ),
        shown: json!(RecordedHazard { notes, ..hazard_shown }),
    })
}

/// The most points of a curve that a file of rates holds for a report.
const MOST_POINTS: usize = 400;

/// What the file of the rates says of the hazard.
fn recorded(path: &Path, hazard: &Hazard) -> RecordedHazard {
    let curve = |peak: Peak, points: &[(f64, f64)]| {
        let each = points.len().div_ceil(MOST_POINTS).max(1);
        let last = points.last().filter(|_| !(points.len() - 1).is_multiple_of(each));
        let points = points.iter().step_by(each).chain(last).copied().collect();
        RecordedCurve { peak: peak.as_str().to_string(), points }
    };
    let (rows, curves) = match hazard {
        Hazard::Curve(peak, known) => (known.points().len(), vec![curve(*peak, known.points())]),
        Hazard::Joint(joint) => {
            let pga = joint.exceedance(|bin| bin.pga_m_s2);
            let pgv = joint.exceedance(|bin| bin.pgv_m_s);
            (joint.bins.len(), vec![curve(Peak::Pga, &pga), curve(Peak::Pgv, &pgv)])
        }
    };
    let file = file_name(path);
    RecordedHazard { file, rows, curves, notes: Vec::new() }
}

/// Motions of one peak, and what their other peak is.
pub struct Line {
    /// The slice of the motions' median p PGV / PGA at uplift, or of the only one.
    pub slice: Slice,
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
    /// Of one ratio, or of those that motions of an intensity have.
    ///
    /// # Errors
    /// If the ratio is none, or what answers does not know those of its motions.
    pub fn new(
        ratio: Option<f64>,
        structure: &Structure,
        peak: Peak,
        answers: &dyn Answers,
    ) -> anyhow::Result<Line> {
        let ratio = match (ratio, answers.peaks()) {
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
                    (p * peaks.pgv_over_pga(peak, intensity, z), STEP * libm::exp(-0.5 * z * z) / TAU.sqrt())
                })
                .collect(),
        }
    }

    /// The probabilities of the limit states at an intensity with their limits, over the ratios.
    fn parts(&self, model: &dyn Fragility, intensity: f64) -> [f64; 9] {
        let (mut slice, mut mean) = (self.slice.clone(), [0.0; 9]);
        for (ratio, weight) in self.ratios(intensity) {
            slice.ratio = ratio;
            let states = parts(model.limit_states(&slice, intensity));
            mean.iter_mut().zip(states).for_each(|(mean, state)| *mean += weight * state);
        }
        mean
    }

    /// The probabilities of the limit states at an intensity, over the ratios; NaN where a measure is missing.
    pub fn limit_states(&self, model: &dyn Fragility, intensity: f64) -> [f64; 3] {
        let parts = self.parts(model, intensity);
        // The weights of the ratios are a quadrature's.
        [parts[0], parts[3], parts[6]].map(|p| if p > 1.0 { 1.0 } else { p })
    }

    /// Overturning along the line, where it is lognormal in the intensity.
    pub fn lognormal(&self, model: &dyn Fragility) -> Option<Lognormal> {
        matches!(self.ratio, Ratio::Single(_)).then(|| model.lognormal(&self.slice))?
    }

    /// Where the ratio comes from, and what another one would change.
    fn words(&self, curve: &HazardCurve, answers: &dyn Answers) -> String {
        let Ratio::Distributed(_) = self.ratio else {
            return "p PGV / PGA is the one of --ratio at all intensities; low and high do not hold its error\n".to_string();
        };
        let overturning =
            |deviations| over_curve(&self.quantile(deviations), curve, answers.model()).overturning.value;
        let [low, median, high] = [-1.0, 0.0, 1.0].map(overturning);
        let at_uplift = |deviations| self.quantile(deviations).ratios(self.slice.intensity_at_im4(1.0))[0].0;
        format!(
            "p PGV / PGA is distributed as in the motions {}: {:.2} at uplift, {:.2} to {:.2} in two of three motions; with these ratios alone, overturning would have the annual rates {median:.1e}, {low:.1e} and {high:.1e} (--ratio takes one)\n",
            answers.words_of_motions(),
            at_uplift(0.0),
            at_uplift(-1.0),
            at_uplift(1.0)
        )
    }
}

fn along_line(
    line: &Line,
    curve: &HazardCurve,
    answers: &dyn Answers,
    console: &Console,
) -> anyhow::Result<Rates> {
    let slice = &line.slice;
    let (model, [(first, _), (last, rate_beyond)]) = (answers.model(), curve.ends());
    let Some(at_last) = model.limit_states(slice, last) else { return Err(periods_needed()) };
    let rates = over_curve(line, curve, model);
    answers.warn_of_slice(slice, last, "the hazard: ", console);
    let (uplift, (unit, size)) = (slice.intensity_at_im4(1.0), slice.peak.usual_unit());
    if first > uplift {
        console.warn(&format!(
            "the hazard begins at {:.4} {unit}, above uplift at {:.4} {unit}: motions between are not counted",
            first / size,
            uplift / size
        ));
    }
    if slice.peak == Peak::Pga && last > STRONGEST_PGA_M_S2 {
        console.warn(&format!(
            "the hazard reaches {:.4} {unit}: {}",
            last / size,
            PeaksDoubt::StrongestEver.words()
        ));
    }
    let overturning = rates.overturning.value;
    let uncounted = rate_beyond * (1.0 - at_last[2].value);
    let ends = format!(
        "the hazard ends at {:.4} {unit}; stronger motions count as this one, and could add {uncounted:.1e} a year",
        last / size
    );
    if uncounted >= overturning {
        console.warn(&format!(
            "{ends} to the {overturning:.1e} of overturning: this annual rate is too low to use; extend the curve to stronger, rarer motions"
        ));
    } else if uncounted > 0.01 * overturning {
        console.warn(&ends);
    }
    Ok(rates)
}

fn over_pairs(
    structure: &Structure,
    joint: &JointHazard,
    answers: &dyn Answers,
    console: &Console,
) -> anyhow::Result<Rates> {
    let model = answers.model();
    let measures = |bin: &PairOfPeaks| measures_of(structure, bin);
    let states = |bin: &PairOfPeaks| model.of_structure(structure, &measures(bin)).limit_states();
    if joint.bins.iter().any(|bin| states(bin).is_none()) {
        return Err(periods_needed());
    }
    let is_outside = |bin: &&PairOfPeaks| !model.outside(&measures(bin)).is_empty();
    let outside = joint.bins.iter().filter(is_outside).count();
    if outside > 0 {
        let all = joint.bins.len();
        console.warn(&format!("{outside} of {all} bins lie outside of the data: extrapolated"));
    }
    for doubt in PeaksDoubt::ALL {
        let is_so = |bin: &&PairOfPeaks| doubt_of_peaks(bin.pga_m_s2, bin.pgv_m_s) == Some(doubt);
        let doubtful = joint.bins.iter().filter(is_so).count();
        if doubtful > 0 {
            console.warn(&format!("{doubtful} of {} bins have {}", joint.bins.len(), doubt.words()));
        }
    }
    Ok(over_bins(structure, joint, model))
}

fn over_curve(line: &Line, curve: &HazardCurve, model: &dyn Fragility) -> Rates {
    Rates::of(curve.mean_annual_rates(&model.jumps(&line.slice), |intensity| line.parts(model, intensity)))
}

fn over_bins(structure: &Structure, joint: &JointHazard, model: &dyn Fragility) -> Rates {
    Rates::of(joint.mean_annual_rates(|bin| {
        parts(model.of_structure(structure, &measures_of(structure, bin)).limit_states())
    }))
}

/// The rates with limits from those of each resample, if there are any.
fn with_limits(
    rates: Rates,
    answers: &dyn Answers,
    rates_of: impl Fn(&dyn Fragility) -> Rates + Sync,
) -> Rates {
    let Some(resampled) = answers.resampled() else { return rates };
    let of = |model: &Option<FragilityModel>| model.as_ref().map(|model| rates_of(model));
    let replicates: Vec<Option<Rates>> = resampled.replicates.par_iter().map(of).collect();
    let limited = |rate_of: fn(&Rates) -> Probability| {
        let values: Vec<Option<f64>> =
            replicates.iter().map(|rates| Some(rate_of(rates.as_ref()?).value)).collect();
        resampled.about(rate_of(&rates).value, &values)
    };
    // Of rocking, which is certain from uplift on, the limits are the rate itself.
    Rates {
        failure: limited(|rates| rates.failure),
        overturning: limited(|rates| rates.overturning),
        ..rates
    }
}

fn measures_of(structure: &Structure, bin: &PairOfPeaks) -> IntensityMeasures {
    IntensityMeasures::new(structure, bin.pga_m_s2, bin.pgv_m_s, None, None)
}

fn periods_needed() -> anyhow::Error {
    UsageError::because(
        "these fits need the period of each motion, or a velocity above 0; a hazard has none: use the bivariate model, or --measure im4 or im5",
    )
}
