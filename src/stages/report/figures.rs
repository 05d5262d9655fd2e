//! The figures of what a folder holds.

use std::f64::consts::TAU;

use super::studies;
use super::tables::{Tables, name};
use crate::fragility::{Calibration, Cases, CurveFit, DemandFit, DemandModel, Event, Kind, Measure};
use crate::fragility::{Probability, Scenarios};
use crate::keyword::Keyword;
use crate::motion::{IntensityMeasures, Suite, measures};
use crate::number;
use crate::report::figures::{self as draw, MeasureFit, ProbabilityPanel, StructureCurves};
use crate::report::text::minus;
use crate::report::{Estimate, Figure};
use crate::rocking::{Outcome, Record, Structure, simulate, trace, with_tail};
use crate::statistics::numerics::first;
use crate::statistics::scores::sample_quantile;
use crate::studies::{log_score_on, measure_of, motion_at};
use crate::table::motions::Motion;
use crate::units::G_M_S2;

/// The most pairs of suite and structure that are drawn, and structures in one panel.
const MOST_GROUPS: usize = 4;
const MOST_STRUCTURES: usize = 6;
/// Number of points of a curve; the most bins of observed shares, and cases for each on average.
const STEPS: usize = 120;
const BINS: usize = 14;
const CASES: usize = 8;
/// Quantiles of IM3 at which P_ex is drawn.
const SHARES: [f64; 3] = [0.1, 0.5, 0.9];
const CONFIDENCE: f64 = 0.95;

/// Draws all figures of the tables that are there, in the order of the page.
pub fn all(tables: &Tables) -> anyhow::Result<Vec<Figure>> {
    let rocking: Vec<&Cases> = tables.groups.iter().filter(|cases| rocked(cases).next().is_some()).collect();
    let groups = &rocking[..rocking.len().min(MOST_GROUPS)];
    let motions = tables.motions()?;
    let fits: Vec<_> = groups.iter().map(|cases| (*cases, measure_fits(tables, cases))).collect();
    let fits: Vec<_> = fits.into_iter().filter(|(_, fits)| fits.iter().any(Option::is_some)).collect();
    let suites = suites(&rocking);
    let panels = |of: &dyn Fn(&[&Cases]) -> Option<ProbabilityPanel>| -> Vec<ProbabilityPanel> {
        suites.iter().filter_map(|groups| of(groups)).collect()
    };
    let over = |im_x, im_y| panels(&|groups: &[&Cases]| over(tables, groups, im_x, im_y));
    let single = [over(Measure::Im4, None), over(Measure::Im5, None)].concat();
    let regressions = fits.iter().map(|(cases, fits)| draw::regressions(&group(cases), fits));
    let figures = [
        drawn(draw::list, studies::objects(tables)),
        drawn(draw::rates, studies::states(tables)),
        drawn(draw::ida, studies::analyses(tables)?),
        drawn(draw::hybrids, over(Measure::Im4, Some(Measure::Im3Inverse))),
        drawn(draw::maps, suites.iter().filter_map(|groups| map(tables, groups)).collect()),
        drawn(draw::validation, studies::tests(tables)?),
        drawn(draw::ranking, studies::targets(tables)?),
        a_motion(&motions),
        similar(tables, &motions)?,
        drawn(draw::planes, groups.iter().filter_map(|cases| planes(tables, cases)).collect()),
        drawn(draw::exceedance, panels(&|groups| exceeding(tables, groups))),
        drawn(draw::overturning, single),
        drawn(draw::demand, groups.iter().map(|cases| group(cases)).collect()),
        drawn(draw::quality, fits.iter().map(|(cases, fits)| (name(cases), fits.clone())).collect()),
    ];
    Ok(figures.into_iter().flatten().chain(regressions).collect())
}

fn drawn<T>(draw: fn(&[T]) -> Figure, data: Vec<T>) -> Option<Figure> {
    (!data.is_empty()).then(|| draw(&data))
}

/// The responses of each suite.
fn suites<'a>(all: &[&'a Cases]) -> Vec<Vec<&'a Cases>> {
    let is_first = |place: usize| all[..place].iter().all(|other| other.suite != all[place].suite);
    let firsts = (0..all.len()).filter(|&place| is_first(place)).take(MOST_GROUPS);
    let same = |place: usize| all.iter().copied().filter(move |other| other.suite == all[place].suite);
    firsts.map(|place| same(place).take(MOST_STRUCTURES).collect()).collect()
}

/// The cases that rocked, and whether they overturned.
fn rocked(cases: &Cases) -> impl Iterator<Item = (usize, bool)> {
    (0..cases.len()).filter_map(|k| Some((k, cases.happened(k, Event::Overturning, f64::INFINITY)?)))
}

fn group(cases: &Cases) -> draw::Group {
    let case = |(k, overturned): (usize, bool)| {
        let measures = cases.measures(k);
        draw::RockingCase {
            pgv_m_s: cases.pgv_m_s[k],
            tp_s: measures.im1.map(|im1| TAU / (im1 * cases.structure.p_rad_s)),
            measures,
            edp: Some(cases.edp[k]).filter(|_| !overturned),
        }
    };
    draw::Group { name: name(cases), cases: rocked(cases).map(case).collect() }
}

/// Figure 1: a combined motion that has its pulse beside it, else any.
fn a_motion(motions: &[Motion]) -> Option<Figure> {
    let is = |motion: &&Motion, suite: Suite| motion.suite.as_deref() == Some(suite.as_str());
    let same = |a: &Motion, b: &Motion| (a.mw, a.re_km, a.tp_s) == (b.mw, b.re_km, b.tp_s);
    let pulse = |whole: &Motion| motions.iter().find(|other| is(other, Suite::Pulse) && same(whole, other));
    let mut combined = motions.iter().filter(|motion| is(motion, Suite::Csgm));
    let whole = combined.find(|whole| pulse(whole).is_some()).or(motions.first())?;
    let velocity = |motion: &Motion| measures::velocity(&motion.acceleration_m_s2, motion.dt_s);
    Some(draw::motion(&draw::Motion {
        words: words(whole),
        dt_s: whole.dt_s,
        acceleration_m_s2: whole.acceleration_m_s2.clone(),
        velocity_m_s: velocity(whole),
        pulse: pulse(whole).map(|pulse| [pulse.acceleration_m_s2.clone(), velocity(pulse)]),
    }))
}

fn words(motion: &Motion) -> String {
    match motion.mw.is_nan() || motion.re_km.is_nan() {
        true => format!("motion {}", motion.motion_id),
        false => format!("magnitude {}, distance {} km", motion.mw, motion.re_km),
    }
}

/// Figure 5: of two structures, under the motion in which the first rocks furthest without overturning.
fn similar(tables: &Tables, motions: &[Motion]) -> anyhow::Result<Option<Figure>> {
    let mut structures = tables.groups.iter().map(|cases| &cases.structure);
    let Some(first) = structures.next() else { return Ok(None) };
    let Some(second) = structures.find(|other| other.p_rad_s != first.p_rad_s) else { return Ok(None) };
    let demand = |motion: &Motion| {
        let response = simulate(first, &Record::new(&motion.acceleration_m_s2, motion.dt_s).ok()?);
        Some(response.edp).filter(|_| response.outcome == Outcome::SafeRocking)
    };
    let demands = motions.iter().filter_map(|motion| Some((demand(motion)?, motion)));
    let Some((_, motion)) = demands.max_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(None) };
    let faster = second.p_rad_s / first.p_rad_s;
    let stronger = second.alpha_rad.tan() / first.alpha_rad.tan();
    let scaled: Vec<f64> = motion.acceleration_m_s2.iter().map(|sample| stronger * sample).collect();
    let second = Structure { eta: first.eta, ..second.clone() };
    let histories = [
        history(first, &motion.acceleration_m_s2, motion.dt_s)?,
        history(&second, &scaled, motion.dt_s / faster)?,
    ];
    Ok(Some(draw::similarity(&histories, &format!("a motion ({})", words(motion)))))
}

/// The rotation over time.
fn history(structure: &Structure, samples: &[f64], dt_s: f64) -> anyhow::Result<draw::History> {
    /// Free rocking that is shown, in 1 / p.
    const TAIL: f64 = 5.0;
    let Structure { p_rad_s, alpha_rad, .. } = *structure;
    let ended = with_tail(&Record::new(samples, dt_s)?, TAIL / p_rad_s);
    let (_, points) = trace(structure, &Record::new(&ended, dt_s)?);
    let samples = points.iter().filter(|point| point.solver_event.is_none());
    Ok(draw::History { p_rad_s, alpha_rad, dt_s, theta_rad: samples.map(|point| point.theta_rad).collect() })
}

/// The regressions of the demand of some cases, of one form.
fn regressions<'a>(
    all: &'a Tables,
    of: &'a Cases,
    model: DemandModel,
) -> impl Iterator<Item = &'a DemandFit> {
    let its = all.demand.iter().filter(|fit| fit.group() == of.group());
    its.filter(move |fit| fit.model == model && !fit.coefficients.is_empty())
}

fn measure_fits(tables: &Tables, cases: &Cases) -> Vec<Option<MeasureFit>> {
    let fit = |measure: Measure| {
        let fit = regressions(tables, cases, DemandModel::Univariate).find(|fit| fit.im_x == measure)?;
        Some(MeasureFit { ln_a: fit.coefficients[0], b: fit.coefficients[1], r2: fit.r2?, beta: fit.beta? })
    };
    Measure::SCALAR.into_iter().map(fit).collect()
}

fn planes(tables: &Tables, cases: &Cases) -> Option<draw::GroupPlanes> {
    let planes: Vec<&DemandFit> = regressions(tables, cases, DemandModel::Biplanar).collect();
    let [low, high] = planes[..] else { return None };
    let plane = |fit: &DemandFit| [0, 1, 2].map(|k| fit.coefficients[k]);
    let planes = [plane(low), plane(high)];
    Some(draw::GroupPlanes { group: group(cases), transition: high.range_low?, planes })
}

/// Values in equal ratios from the first to the last.
fn ratios([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |k| low * (high / low).powf(k as f64 / STEPS as f64))
}

/// A curve with its band, broken where it has no value.
fn curve(label: &str, x: impl Iterator<Item = f64>, p: impl Fn(f64) -> Option<Probability>) -> draw::Curve {
    let point = |x: f64| match p(x) {
        Some(Probability { value, low, high }) => ([x, value], [low, high]),
        None => ([f64::NAN; 2], [f64::NAN; 2]),
    };
    let (points, band) = x.map(point).unzip();
    draw::Curve { label: label.to_string(), points, band }
}

/// Structures over a measure; none without a curve.
fn panel(groups: &[&Cases], measure: &str, structures: Vec<StructureCurves>) -> Option<ProbabilityPanel> {
    let title = groups[0].suite.clone().unwrap_or_default();
    let has_curves = structures.iter().any(|structure| !structure.curves.is_empty());
    has_curves.then(|| ProbabilityPanel {
        title,
        measure: measure.to_string(),
        structures,
        notes: Vec::new(),
    })
}

/// The measures of a motion with these IM4 and IM3.
fn measures(im4: f64, im3: f64) -> IntensityMeasures {
    IntensityMeasures::of_peaks(im4, im4 / im3)
}

/// Figure 10: P_ex by the planes at quantiles of IM3, and by IM4 alone.
fn exceeding(tables: &Tables, groups: &[&Cases]) -> Option<ProbabilityPanel> {
    let safe = |cases: &&Cases, measure: Measure| -> Vec<f64> {
        let column = cases.column(measure);
        (0..cases.len()).filter(|&k| cases.ln_demand(k).is_some()).map(|k| column[k]).collect()
    };
    let all = |measure| groups.iter().flat_map(|cases| safe(cases, measure)).collect::<Vec<f64>>();
    let (im3, most) = (all(Measure::Im3), all(Measure::Im4).into_iter().fold(1.5, f64::max));
    let limit_state = tables.limit_state;
    let structure = |cases: &&Cases| {
        let planes: Vec<&DemandFit> = regressions(tables, cases, DemandModel::Biplanar).collect();
        let at_share = |share: f64| {
            let (im3, transition) = (sample_quantile(im3.clone(), share)?, planes.last()?.range_low?);
            let below = ratios([1.0, transition * (1.0 - 1e-9)]).chain([f64::NAN]);
            let p = |im4: f64| {
                let plane = planes.iter().find(|fit| fit.holds_at(im4))?;
                plane.p_exceeding(&measures(im4, im3), limit_state, CONFIDENCE)
            };
            let label = format!("IM3 at its {} % quantile", number::plain(100.0 * share));
            Some(curve(&label, below.chain(ratios([transition, most])), p))
        };
        let alone = regressions(tables, cases, DemandModel::Univariate).find(|fit| fit.im_x == Measure::Im4);
        let p = |fit: &DemandFit, im4: f64| fit.p_exceeding(&measures(im4, 1.0), limit_state, CONFIDENCE);
        let alone = alone.map(|fit| curve("IM4 alone", ratios([1.0, most]), |im4| p(fit, im4)));
        let curves = SHARES.into_iter().filter_map(at_share).chain(alone).collect();
        StructureCurves { name: cases.structure.name.clone(), curves, shares: Vec::new() }
    };
    panel(groups, draw::label(Measure::Im4), groups.iter().map(structure).collect())
}

/// Figures 11 and 12: P_ro over a measure, or over a hybrid one at the median IM3, and how well the curves of
/// two structures predict each other.
fn over(
    tables: &Tables,
    groups: &[&Cases],
    im_x: Measure,
    im_y: Option<Measure>,
) -> Option<ProbabilityPanel> {
    let fit = |cases: &Cases| {
        let mut its = tables.curves.iter().filter(|fit| fit.group() == cases.group());
        its.find(|fit| {
            (fit.im_x, fit.im_y) == (im_x, im_y) && fit.coefficients[1..].iter().sum::<f64>() > 0.0
        })
    };
    let structure = |cases: &&Cases| {
        let name = cases.structure.name.clone();
        let Some(fit) = fit(cases) else { return StructureCurves { name, ..StructureCurves::default() } };
        let value = |k: usize| measure_of(fit, &cases.measures(k));
        let shares: Vec<(f64, bool)> =
            rocked(cases).filter_map(|(k, event)| Some((value(k)?, event))).collect();
        let im3 = sample_quantile(cases.column(Measure::Im3).to_vec(), 0.5).unwrap_or(1.0);
        let p = |value: f64| fit.probability(&motion_at(fit, value, im3), CONFIDENCE);
        StructureCurves {
            name,
            curves: vec![curve("", ratios(ends(shares.iter().map(|share| share.0))), p)],
            shares: binned(&shares),
        }
    };
    let measure = if im_y.is_some() { "hybrid measure" } else { draw::label(im_x) };
    let mut panel = panel(groups, measure, groups.iter().map(structure).collect())?;
    if let [a, b] = groups
        && let (Some(of_a), Some(of_b)) = (fit(a), fit(b))
    {
        let row = |cases: &Cases, own: &CurveFit, other: &CurveFit| {
            let [own, other] = [own, other].map(|fit| minus(number::fixed(log_score_on(fit, cases), 2)));
            format!("{}: {own}, {other}", cases.structure.name)
        };
        let head = "log score by own curve, by the other's".to_string();
        panel.notes = vec![head, row(a, of_a, of_b), row(b, of_b, of_a)];
    }
    Some(panel)
}

/// The map of the first structure of a suite, and the lines of the others.
fn map(tables: &Tables, groups: &[&Cases]) -> Option<draw::Map> {
    let (cases, others) = groups.split_first()?;
    let mut map = draw::Map { title: name(cases), ..draw::Map::default() };
    for (k, overturned) in rocked(cases) {
        let point = [cases.pga_m_s2[k] / G_M_S2, cases.pgv_m_s[k]];
        if overturned { map.overturns.push(point) } else { map.rocks.push(point) }
    }
    let [low, high] = ends(cases.pga_m_s2.iter().copied());
    let pga = [low.max(cases.structure.uplift_acceleration_m_s2()), high];
    let [least, most] = ends(cases.pgv_m_s.iter().copied());
    let pgv = [least, 1.5 * most];
    map.lines = draw::LEVELS.map(|level| line(tables, cases, level, pga, pgv));
    map.others = others
        .iter()
        .map(|cases| (cases.structure.name.clone(), line(tables, cases, 0.5, pga, pgv)))
        .collect();
    Some(map)
}

/// The motions under which a structure overturns with this probability, between these PGA and PGV (m/s2 and
/// m/s): PGV of each PGA by bisection, as more PGV never lowers the probability.
fn line(tables: &Tables, cases: &Cases, level: f64, pga: [f64; 2], [least, most]: [f64; 2]) -> Vec<[f64; 2]> {
    let structure = &cases.structure;
    let fitted = tables.calibrations.iter().find(|row| row.group() == cases.group());
    let shipped = || Calibration::shipped(kind_of(cases), structure, None);
    let calibration = fitted.cloned().unwrap_or_else(shipped);
    let reaches = |pga: f64, ln_pgv: f64| {
        let measures = IntensityMeasures::new(structure, pga, ln_pgv.exp(), None, None);
        let of = calibration.predictor(structure, &measures, None).filter(|_| measures.im4 >= 1.0);
        of.is_some_and(|of| calibration.probability(&of, Scenarios::One).value >= level)
    };
    let mut points = Vec::new();
    for pga in ratios(pga) {
        let is_crossed = reaches(pga, most.ln()) && !reaches(pga, least.ln());
        let ln_pgv = is_crossed.then(|| first(least.ln(), most.ln(), |ln_pgv| reaches(pga, ln_pgv)));
        points.push([pga / G_M_S2, ln_pgv.map_or(f64::NAN, f64::exp)]);
    }
    points
}

fn kind_of(cases: &Cases) -> Kind {
    Kind::of_word(cases.suite.as_deref())
}

fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, 0.0], |[low, high], value| [low.min(value), high.max(value)])
}

/// Shares of events in bins of equal ratio, with Wilson's limits.
fn binned(cases: &[(f64, bool)]) -> Vec<Estimate> {
    let bins = (cases.len() / CASES).clamp(4, BINS);
    draw::observed_shares(
        cases,
        draw::equal_ratios(ends(cases.iter().map(|case| case.0)), bins),
        studies::wilson,
    )
}
