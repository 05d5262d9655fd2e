//! Annual rates over the hazard of a site.

use std::path::Path;

use rayon::prelude::*;
use serde_json::json;

use super::answer::Answer;
use super::options::HazardOptions;
use crate::fragility::universal::Scenarios;
use crate::fragility::{
    Fragility, FragilityModel, LimitState, Peak, PeaksDoubt, Placed, Probability, STRONGEST_PGA_M_S2,
    doubt_of_peaks, doubt_of_ratio,
};
use crate::hazard::{CountedRate, HazardCurve, JointHazard, PairOfPeaks, probability_in_years};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::check;
use crate::rocking::Structure;
use crate::stages::shared::answers::Answers;
use crate::stages::shared::counts;
use crate::stages::shared::fits::FitFiles;
use crate::stages::shared::groups;
use crate::stages::shared::hazard::Hazard;
use crate::stages::shared::line::{Line, terms};
use crate::stages::shared::structures::{words, words_of_friction};
use crate::statistics::Limits;
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
    fn of(sums: [f64; 9]) -> Rates {
        let rate = |k: usize| Probability { value: sums[k], low: sums[k + 1], high: sums[k + 2] };
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

/// The annual rate of each limit state over the hazard of a site. By the delta method the limits are those of the probabilities at
/// every intensity at once, as if all were too high or too low together; by resamples, those of the rate itself.
pub fn answer(
    options: &HazardOptions,
    path: &Path,
    hazard: Hazard,
    answers: &dyn Answers,
    structure: &Structure,
    fits: Option<&FitFiles>,
    console: &Console,
) -> anyhow::Result<Answer> {
    let years = options.years;
    check(years > 0.0 && years.is_finite(), "years", years, "a time above 0")?;
    let mut words_of_ratio = String::new();
    let mut words_of_count = String::new();
    let hazard_shown = recorded(path, &hazard);
    let surface = answers.surface(Scenarios::Many);
    let surface = surface.as_ref().map(|surface| surface as &dyn Fragility);
    let mut peaks_of_fits = "";
    let (rates, by_surface) = match hazard {
        Hazard::Curve(peak, curve) => {
            let line = Line::new(options.ratio, structure, peak, answers)?;
            options.ratio.and_then(doubt_of_ratio).into_iter().for_each(|doubt| console.warn(&doubt));
            let rates = along_line(&line, &curve, answers, console)?;
            words_of_ratio = self::words_of_ratio(&line, &curve, answers);
            if line.is_distributed() {
                peaks_of_fits = ", over PGV / PGA as in the motions of the fits, not as in its own";
            }
            if let (true, Some(fits)) = (line.is_distributed(), fits) {
                words_of_count = words_of_count_beside(&rates, fits, path, &line, &curve, answers, console);
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
        match answers.doubt_of_rates() {
            Some(doubt) => console.warn(&format!("{doubt}; {words}")),
            None if !(low..=high).contains(&rates.overturning.value) => console.warn(&words),
            None => {}
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
    let notes = [words_of_ratio, words_of_surface, words_of_count, words_of_limits];
    let notes = notes.iter().flat_map(|words| words.lines()).map(str::to_string).collect::<Vec<_>>();
    Ok(Answer {
        table: RATES,
        rows: evaluated::rates(&rows)?,
        heading: format!(
            "{}\nstructure of {}, {}, over {}\n{}\n",
            answers.words(),
            words(structure),
            words_of_friction(structure),
            path.display(),
            notes.join("\n")
        ),
        shown: json!(RecordedHazard { notes, ..hazard_shown }),
    })
}

/// Beside the rates those that are counted among the motions of the fits, without any curve; a warning where one of the fits lies
/// outside of its limits.
fn words_of_count_beside(
    rates: &Rates,
    fits: &FitFiles,
    hazard: &Path,
    line: &Line,
    curve: &HazardCurve,
    answers: &dyn Answers,
    console: &Console,
) -> String {
    let structure = &line.slice.structure;
    let Some(fitted) = answers.fitted() else { return String::new() };
    if answers.is_other_block(structure) || answers.is_other_structure(structure) {
        return String::new();
    }
    let groups = counts::responses_beside(&fits.pro).and_then(|path| Some((groups::read(&path).ok()?, path)));
    let (peak, (unit, size)) = (line.slice.peak, line.slice.peak.usual_unit());
    let counted = groups.and_then(|(groups, path)| {
        let group = groups.iter().find(|group| (group.suite.as_deref(), &*group.structure) == fitted)?;
        let happened = |case: &Placed| Some(counts::happened(case, answers.limit()));
        Some((counts::count(group, peak, curve, happened)?, path))
    });
    let Some((count, path)) = counted else {
        return format!(
            "not counted without a curve, since no file beside {} holds the responses of these fits: rockfrag validate --in RESPONSES --hazard {} --pex {} --pro {} counts\n",
            fits.pro.name().display(),
            hazard.display(),
            fits.pex.name().display(),
            fits.pro.name().display()
        );
    };
    let beyond = count.strongest / size;
    let states = [LimitState::Failure, LimitState::Overturning];
    let outside = |(state, rate): (LimitState, CountedRate)| {
        let of_fits = rates.of_state(state).value;
        let is_within = (rate.limits.low..=rate.limits.high).contains(&of_fits);
        (!is_within).then(|| format!("{} {of_fits:.1e} for {}", state.as_str(), words_of_counted(&rate)))
    };
    let outside: Vec<String> = states.into_iter().zip(count.rates).filter_map(outside).collect();
    if !outside.is_empty() {
        let within = up_to(count.strongest, line, curve, answers.model()).overturning.value;
        let [all, extrapolated] = [rates.overturning.value, rates.overturning.value - within];
        console.warn(&format!(
            "annual rates lie outside of what a count of the fits' own motions gives: {}; {extrapolated:.1e} of the {all:.1e} of overturning \
             is above {beyond:.2} {unit}, beyond all these motions. Strong motions are few, weigh little in a fit and carry the rate: take \
             the count rather, compare the universal surface, or fit to more strong motions (more samples, larger magnitudes, shorter \
             distances)",
            outside.join(", ")
        ));
    }
    let [failure, overturning] = count.rates.map(|rate| words_of_counted(&rate));
    format!(
        "counted without a curve in {} motions of {}, weighted to have the hazard's rates: overturning {overturning}, with failure {failure}; \
         motions above {beyond:.2} {unit}, the strongest, come {:.1e} times a year and count as those just below\n",
        count.motions,
        path.display(),
        count.rate_beyond
    )
}

fn words_of_counted(CountedRate { value, limits: Limits { low, high } }: &CountedRate) -> String {
    format!("{value:.1e} ({low:.1e} to {high:.1e})")
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

/// Times uplift: where words tell how the ratio has changed.
const FAR: f64 = 4.0;

/// Where the ratio comes from, and what another one would change.
fn words_of_ratio(line: &Line, curve: &HazardCurve, answers: &dyn Answers) -> String {
    if !line.is_distributed() {
        return "p PGV / PGA is the one of --ratio at all intensities; low and high do not hold its error\n"
            .to_string();
    }
    let overturning =
        |deviations| over_curve(&line.quantile(deviations), curve, answers.model()).overturning.value;
    let [low, median, high] = [-1.0, 0.0, 1.0].map(overturning);
    let peak = line.slice.peak;
    let (unit, size) = peak.usual_unit();
    let uplift = line.slice.intensity_at_im4(1.0);
    let end = curve.ends()[1].0.min(FAR * uplift).max(uplift);
    let (at_uplift, at_end) = (line.median_ratio(uplift), line.median_ratio(end));
    let name = peak.as_str().to_uppercase();
    let changes = match at_end < at_uplift {
        true => "falls",
        false => "rises",
    };
    format!(
        "p PGV / PGA {changes} with {name}, as in the motions {}: its median is {at_uplift:.2} at uplift and {at_end:.2} at {:.2} {unit}\n\
         if every motion had the median of its {name}, the annual rate of overturning would be {median:.1e}; one standard deviation lower or \
         higher, {low:.1e} or {high:.1e}; --ratio sets one value at all intensities instead\n",
        answers.words_of_motions(),
        end / size
    )
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
    Rates::of(curve.mean_annual_rates(&model.jumps(&line.slice), |intensity| line.terms(model, intensity)))
}

/// The rates of motions up to an intensity alone.
fn up_to(intensity: f64, line: &Line, curve: &HazardCurve, model: &dyn Fragility) -> Rates {
    let mut breaks = model.jumps(&line.slice);
    breaks.push(intensity);
    Rates::of(curve.mean_annual_rates(
        &breaks,
        |im| {
            if im > intensity { [0.0; 9] } else { line.terms(model, im) }
        },
    ))
}

fn over_bins(structure: &Structure, joint: &JointHazard, model: &dyn Fragility) -> Rates {
    Rates::of(joint.mean_annual_rates(|bin| {
        terms(model.of_structure(structure, &measures_of(structure, bin)).limit_states())
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
