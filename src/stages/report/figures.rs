//! The figures of motions, responses and fits.

use crate::fragility::{Calibration, Cases, DemandFit, DemandModel, Event, JointPeaks, Measure};
use crate::fragility::{OverturningFit, Peak, Scenarios, beta, lambda, logit_overturning};
use crate::fragility::{Probability, hybrid_measure};
use crate::keyword::Keyword;
use crate::motion::{IntensityMeasures, Suite, intensity};
use crate::report::Estimate;
use crate::report::Figure;
use crate::report::figures::{
    Curve, Group, GroupPlanes, History, MEASURES, MeasureFit, Motion, ProbabilityPanel, RockingCase,
    StructureCurves, calibrated, demand, equal_ratios, exceedance, hybrids, motion, observed_shares,
    overturning, planes, quality, regressions, similarity,
};
use crate::report::text::number;
use crate::rocking::{Outcome, Record, Structure, trace, with_tail};
use crate::stages::report::studies;
use crate::stages::report::tables::Tables;
use crate::statistics::scores::log_score;
use crate::studies::wilson_limits;
use crate::table::motions::Motion as MotionRow;
use crate::units::G_M_S2;

/// The most suites and structures that are drawn, and structures in one panel.
const MOST_GROUPS: usize = 4;
const MOST_STRUCTURES: usize = 6;
/// Number of points of a curve, and of bins of the observed shares.
const STEPS: usize = 120;
const BINS: usize = 14;
/// Quantiles of IM3 at which P_ex is drawn.
const SHARES: [f64; 3] = [0.1, 0.5, 0.9];
const CONFIDENCE: f64 = 0.95;

/// Draws all figures of the tables that are there.
pub fn all(tables: &Tables) -> anyhow::Result<Vec<Figure>> {
    let groups: Vec<&Cases> = tables.groups.iter().filter(rocks).take(MOST_GROUPS).collect();
    let mut figures = studies::figures(tables);
    figures.extend(a_motion(&tables.motions));
    if !groups.is_empty() {
        figures.push(demand(&groups.iter().map(|cases| group(cases)).collect::<Vec<_>>()));
    }
    figures.extend(similar(tables)?);
    let fits: Vec<(&Cases, [Option<MeasureFit>; 6])> =
        groups.iter().map(|cases| (*cases, measure_fits(tables, cases))).collect();
    let fitted = || fits.iter().filter(|(_, fits)| fits.iter().any(Option::is_some));
    figures.extend(fitted().map(|(cases, fits)| regressions(&group(cases), fits)));
    if fitted().next().is_some() {
        figures.push(quality(&fitted().map(|(cases, fits)| (name(cases), *fits)).collect::<Vec<_>>()));
    }
    let biplanar: Vec<GroupPlanes> = groups.iter().filter_map(|cases| group_planes(tables, cases)).collect();
    if !biplanar.is_empty() {
        figures.push(planes(&biplanar));
    }
    let suites = suites(tables);
    let panels = |of: &dyn Fn(&[&Cases]) -> Option<ProbabilityPanel>| -> Vec<ProbabilityPanel> {
        suites.iter().filter_map(|groups| of(groups)).collect()
    };
    let single = |measure| move |groups: &[&Cases]| over(tables, groups, measure, None);
    let hybrid = |groups: &[&Cases]| over(tables, groups, Measure::Im4, Some(Measure::Im3Inverse));
    let both = [panels(&single(Measure::Im4)), panels(&single(Measure::Im5))].concat();
    let drawn: [(fn(&[ProbabilityPanel]) -> Figure, Vec<ProbabilityPanel>); 4] = [
        (exceedance, panels(&|groups| exceeding(tables, groups))),
        (overturning, both),
        (hybrids, panels(&hybrid)),
        (calibrated, panels(&|groups| over_pga(tables, groups))),
    ];
    figures.extend(drawn.iter().filter(|(_, panels)| !panels.is_empty()).map(|(draw, panels)| draw(panels)));
    Ok(figures)
}

/// Structure and suite.
pub fn name(cases: &Cases) -> String {
    title(&cases.structure.name, cases.suite.as_deref())
}

pub fn title(structure: &str, suite: Option<&str>) -> String {
    suite.map_or(structure.to_string(), |suite| format!("{structure}, {suite}"))
}

/// The responses of each suite.
fn suites(tables: &Tables) -> Vec<Vec<&Cases>> {
    let mut suites: Vec<Vec<&Cases>> = Vec::new();
    for cases in tables.groups.iter().filter(rocks) {
        match suites.iter_mut().find(|groups| groups[0].suite == cases.suite) {
            Some(groups) if groups.len() < MOST_STRUCTURES => groups.push(cases),
            Some(_) => {}
            None => suites.push(vec![cases]),
        }
    }
    suites.truncate(MOST_GROUPS);
    suites
}

fn rocks(cases: &&Cases) -> bool {
    cases.outcome.iter().any(|outcome| *outcome != Outcome::NoRocking)
}

fn group(cases: &Cases) -> Group {
    let case = |k: usize| {
        let measures = cases.measures(k);
        RockingCase {
            pgv_m_s: cases.pgv_m_s[k],
            tp_s: measures.im1.map(|im1| std::f64::consts::TAU / (im1 * cases.structure.p_rad_s)),
            im: Measure::SCALAR.map(|measure| measure.among(&measures)),
            edp: (cases.outcome[k] == Outcome::SafeRocking).then(|| cases.edp[k]),
        }
    };
    let rocking = (0..cases.len()).filter(|&k| cases.outcome[k] != Outcome::NoRocking);
    Group { name: name(cases), cases: rocking.map(case).collect() }
}

/// Figure 1: a combined motion that has its pulse beside it, else any.
fn a_motion(motions: &[MotionRow]) -> Option<Figure> {
    let is = |motion: &&MotionRow, suite: Suite| motion.suite.as_deref() == Some(suite.as_str());
    let same = |a: &MotionRow, b: &MotionRow| (a.mw, a.re_km, a.tp_s) == (b.mw, b.re_km, b.tp_s);
    let pulse =
        |whole: &MotionRow| motions.iter().find(|other| is(other, Suite::Pulse) && same(whole, other));
    let pair = motions
        .iter()
        .filter(|motion| is(motion, Suite::Csgm))
        .find_map(|whole| Some((whole, pulse(whole)?)));
    let (whole, pulse) = match pair {
        Some((whole, pulse)) => (whole, Some(pulse)),
        None => (motions.first()?, None),
    };
    let velocity = |motion: &MotionRow| intensity::velocity(&motion.acceleration_m_s2, motion.dt_s);
    let padded = |mut values: Vec<f64>| {
        values.resize(whole.acceleration_m_s2.len(), 0.0);
        values
    };
    Some(motion(&Motion {
        words: words(whole),
        dt_s: whole.dt_s,
        acceleration_m_s2: whole.acceleration_m_s2.clone(),
        velocity_m_s: velocity(whole),
        pulse: pulse.map(|pulse| [pulse.acceleration_m_s2.clone(), velocity(pulse)].map(padded)),
    }))
}

/// What is known of a motion.
fn words(motion: &MotionRow) -> String {
    let known = [
        ("magnitude", motion.mw, ""),
        ("distance", motion.re_km, " km"),
        ("pulse period", motion.tp_s, " s"),
    ];
    let known = known.into_iter().filter(|(_, value, _)| !value.is_nan());
    let known = known.map(|(what, value, unit)| format!("{what} {}{unit}", number::significant(value, 3)));
    let words = known.collect::<Vec<_>>().join(", ");
    if words.is_empty() { format!("motion {}", motion.motion_id) } else { words }
}

/// Figure 5: of the first two structures, under the motion in which the first rocks furthest without overturning.
fn similar(tables: &Tables) -> anyhow::Result<Option<Figure>> {
    let mut structures = tables.groups.iter().map(|cases| &cases.structure);
    let Some(first) = structures.next() else { return Ok(None) };
    let Some(second) = structures.find(|other| other.p_rad_s != first.p_rad_s) else { return Ok(None) };
    let second = Structure { eta: first.eta, ..second.clone() };
    let faster = second.p_rad_s / first.p_rad_s;
    let stronger = second.alpha_rad.tan() / first.alpha_rad.tan();
    let mut furthest: Option<(f64, &MotionRow, [History; 2])> = None;
    for motion in &tables.motions {
        let scaled: Vec<f64> = motion.acceleration_m_s2.iter().map(|sample| stronger * sample).collect();
        let runs = [
            history(first, &motion.acceleration_m_s2, motion.dt_s)?,
            history(&second, &scaled, motion.dt_s / faster)?,
        ];
        let [Some((edp, one)), Some((_, other))] = runs else { continue };
        if furthest.as_ref().is_none_or(|(most, ..)| edp > *most) {
            furthest = Some((edp, motion, [one, other]));
        }
    }
    let rocks = furthest.filter(|(edp, ..)| *edp > 0.0);
    Ok(rocks.map(|(_, motion, histories)| similarity(&histories, &format!("a motion ({})", words(motion)))))
}

/// The demand and the rotation over time; none if it overturns.
fn history(structure: &Structure, samples: &[f64], dt_s: f64) -> anyhow::Result<Option<(f64, History)>> {
    /// Free rocking that is shown, in 1 / p.
    const TAIL: f64 = 5.0;
    let ended = with_tail(&Record::new(samples, dt_s)?, TAIL / structure.p_rad_s);
    let (response, points) = trace(structure, &Record::new(&ended, dt_s)?);
    let theta_rad = points.iter().filter(|point| point.solver_event.is_none()).map(|point| point.theta_rad);
    let Structure { p_rad_s, alpha_rad, .. } = *structure;
    let history = History { p_rad_s, alpha_rad, dt_s, theta_rad: theta_rad.collect() };
    Ok((response.outcome != Outcome::Overturning).then_some((response.edp, history)))
}

/// The regressions of the demand of some cases, of one form.
fn regressions_of<'a>(
    tables: &'a Tables,
    cases: &Cases,
    model: DemandModel,
) -> impl Iterator<Item = &'a DemandFit> {
    let (suite, structure) = (cases.suite.clone(), cases.structure.name.clone());
    let fits = tables.demand.iter().filter(move |fit| fit.suite == suite && fit.structure == structure);
    fits.filter(move |fit| fit.model == model && !fit.coefficients.is_empty())
}

fn measure_fits(tables: &Tables, cases: &Cases) -> [Option<MeasureFit>; 6] {
    Measure::SCALAR.map(|measure| {
        let fit = regressions_of(tables, cases, DemandModel::Univariate).find(|fit| fit.im_x == measure)?;
        Some(MeasureFit { ln_a: fit.coefficients[0], b: fit.coefficients[1], r2: fit.r2?, beta: fit.beta? })
    })
}

fn group_planes(tables: &Tables, cases: &Cases) -> Option<GroupPlanes> {
    let mut planes = regressions_of(tables, cases, DemandModel::Biplanar);
    let (low, high) = (planes.next()?, planes.next()?);
    let plane = |fit: &DemandFit| <[f64; 3]>::try_from(fit.coefficients.as_slice()).ok();
    Some(GroupPlanes {
        group: group(cases),
        transition: high.range_low?,
        planes: [plane(low)?, plane(high)?],
    })
}

/// Values in equal ratios from the first to the last.
fn ratios([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..=STEPS).map(move |k| low * (high / low).powf(k as f64 / STEPS as f64))
}

/// A curve with its band, broken where it has no value.
fn curve(label: &str, points: impl Iterator<Item = (f64, Option<Probability>)>) -> Curve {
    let value = |(x, p): (f64, Option<Probability>)| match p {
        Some(Probability { value, low, high }) => ([x, value], [low, high]),
        None => ([f64::NAN; 2], [f64::NAN; 2]),
    };
    let (points, band) = points.map(value).unzip();
    Curve { label: label.to_string(), points, band }
}

fn panel(groups: &[&Cases], measure: &str, structures: Vec<StructureCurves>) -> Option<ProbabilityPanel> {
    let title = groups[0].suite.clone().unwrap_or_default();
    let is_drawn = structures.iter().any(|structure| !structure.curves.is_empty());
    is_drawn.then(|| ProbabilityPanel { title, measure: measure.to_string(), structures, notes: Vec::new() })
}

/// Figure 10: P_ex by the planes at quantiles of IM3, and by IM4 alone.
fn exceeding(tables: &Tables, groups: &[&Cases]) -> Option<ProbabilityPanel> {
    let safe = |cases: &Cases, k: usize| cases.ln_demand(k).map(|_| [cases.im[3][k], cases.im[2][k]]);
    let all = groups.iter().flat_map(|cases| (0..cases.len()).filter_map(|k| safe(cases, k)));
    let (im4, mut im3): (Vec<f64>, Vec<f64>) =
        all.filter(|[_, im3]| !im3.is_nan()).map(|[a, b]| (a, b)).unzip();
    im3.sort_unstable_by(f64::total_cmp);
    let range = [1.0, im4.iter().copied().fold(1.5, f64::max)];
    let p = |fit: &DemandFit, im4: f64, im3: f64| {
        let measures =
            IntensityMeasures { im1: None, im2: None, im3: Some(im3), im4, im5: im4 / im3, im6: None };
        fit.p_exceeding(&measures, tables.limit_state, CONFIDENCE)
    };
    let structure = |cases: &&Cases| {
        let planes: Vec<&DemandFit> = regressions_of(tables, cases, DemandModel::Biplanar).collect();
        let at_share = |share: f64| {
            let at = *im3.get((share * im3.len() as f64) as usize)?;
            let transition = planes.last()?.range_low?;
            let below = ratios([range[0], transition.min(range[1])]).map(|im4| (im4, p(planes[0], im4, at)));
            let above =
                ratios([transition, range[1].max(transition)]).map(|im4| (im4, p(planes[1], im4, at)));
            let label = format!("IM3 at its {} % quantile", number::plain(100.0 * share));
            Some(curve(&label, below.chain([(transition, None)]).chain(above)))
        };
        let alone =
            regressions_of(tables, cases, DemandModel::Univariate).find(|fit| fit.im_x == Measure::Im4);
        let alone = alone.map(|fit| curve("IM4 alone", ratios(range).map(|im4| (im4, p(fit, im4, 1.0)))));
        let both = SHARES.into_iter().filter(|_| planes.len() == 2).filter_map(at_share);
        StructureCurves {
            name: cases.structure.name.clone(),
            curves: both.chain(alone).collect(),
            shares: Vec::new(),
        }
    };
    panel(groups, MEASURES[3], groups.iter().map(structure).collect())
}

/// A paper's curve over its measure, or over its hybrid measure at the median of the second.
struct Fitted<'a> {
    fit: &'a OverturningFit,
    cases: &'a Cases,
    /// Value, whether it overturned, and measures of the cases that rocked.
    rocked: Vec<(f64, bool, IntensityMeasures)>,
}

impl<'a> Fitted<'a> {
    fn new(fit: &'a OverturningFit, cases: &'a Cases) -> Fitted<'a> {
        let rocked = (0..cases.len()).filter_map(|k| {
            let event = cases.happened(k, Event::Overturning, f64::INFINITY)?;
            let measures = cases.measures(k);
            let x = fit.im_x.among(&measures)?;
            let value = match fit.im_y {
                Some(im_y) => hybrid_measure(x, im_y.among(&measures)?, lambda(&fit.coefficients).0),
                None => x,
            };
            Some((value, event, measures))
        });
        Fitted { fit, cases, rocked: rocked.collect() }
    }

    fn curves(&self) -> StructureCurves {
        let Fitted { fit, cases, rocked } = self;
        let shares: Vec<(f64, bool)> = rocked.iter().map(|(value, event, _)| (*value, *event)).collect();
        let ends = ends(&shares);
        let mut second: Vec<f64> =
            rocked.iter().filter_map(|(.., measures)| fit.im_y?.among(measures)).collect();
        second.sort_unstable_by(f64::total_cmp);
        let median = second.get(second.len() / 2).copied();
        let at = |value: f64| fit.p_overturning(&self.measures(value, median), CONFIDENCE);
        let curves = vec![curve("", ratios(ends).map(|value| (value, at(value))))];
        StructureCurves { name: cases.structure.name.clone(), curves, shares: binned(&shares) }
    }

    /// Measures with this value of the (hybrid) measure, and this second one.
    fn measures(&self, value: f64, second: Option<f64>) -> IntensityMeasures {
        let b = &self.fit.coefficients;
        let first = second.map_or(value, |y| (((b[1] + b[2]) * value.ln() - b[2] * y.ln()) / b[1]).exp());
        let of = |measure: Measure| if self.fit.im_x == measure { Some(first) } else { None };
        let im3 = second.map(|inverse| 1.0 / inverse);
        let missing = f64::NAN;
        let [im4, im5] = [Measure::Im4, Measure::Im5].map(|measure| of(measure).unwrap_or(missing));
        IntensityMeasures { im1: None, im2: None, im3, im4, im5, im6: None }
    }

    /// Mean log score of this curve on the cases of another structure.
    fn score_on(&self, other: &Fitted) -> f64 {
        let p = |measures: &IntensityMeasures| Some(self.fit.p_overturning(measures, CONFIDENCE)?.value);
        let cases = other.rocked.iter().filter_map(|(_, event, measures)| Some((p(measures)?, *event)));
        let (p, events): (Vec<f64>, Vec<bool>) =
            cases.map(|(p, event)| (p.clamp(1e-12, 1.0 - 1e-12), event)).unzip();
        log_score(&p, &events)
    }
}

/// Figures 11 and 12: P_ro over a measure or a hybrid one, and how well the curves of two structures predict each other.
fn over(
    tables: &Tables,
    groups: &[&Cases],
    im_x: Measure,
    im_y: Option<Measure>,
) -> Option<ProbabilityPanel> {
    let fitted = groups.iter().filter_map(|cases| {
        let is_its = |fit: &&OverturningFit| {
            (&fit.suite, &fit.structure) == (&cases.suite, &cases.structure.name)
                && (fit.im_x, fit.im_y) == (im_x, im_y)
                && !fit.coefficients.is_empty()
                && beta(&fit.coefficients).0 > 0.0
        };
        Some(Fitted::new(tables.curves.iter().find(is_its)?, cases))
    });
    let fitted: Vec<Fitted> = fitted.filter(|fitted| !fitted.rocked.is_empty()).collect();
    let place = Measure::SCALAR.iter().position(|measure| *measure == im_x)?;
    let measure = if im_y.is_some() { "hybrid measure" } else { MEASURES[place] };
    let mut panel = panel(groups, measure, fitted.iter().map(Fitted::curves).collect())?;
    if let [one, other] = &fitted[..] {
        let row = |of: &Fitted, by: &Fitted| {
            let [own, others] = [of.score_on(of), by.score_on(of)].map(|score| number::fixed(score, 2));
            format!("{}: {own}, {others}", of.cases.structure.name)
        };
        panel.notes =
            vec!["log score by own curve, by the other's".to_string(), row(one, other), row(other, one)];
    }
    Some(panel)
}

/// The calibration of some cases.
pub fn calibration<'a>(tables: &'a Tables, cases: &Cases) -> Option<&'a Calibration> {
    let is_its = |row: &&Calibration| row.suite == cases.suite && row.structure == cases.structure.name;
    tables.calibrations.iter().find(is_its)
}

/// The calibrated curve over PGA along the motions' median PGV/PGA, and the surface.
fn over_pga(tables: &Tables, groups: &[&Cases]) -> Option<ProbabilityPanel> {
    let peaks = JointPeaks::of(&groups[0].pga_m_s2, &groups[0].pgv_m_s)?;
    let structure = |cases: &&Cases| {
        let calibration = calibration(tables, cases)?;
        let of_surface = Calibration { c: 0.0, ln_s: 0.0, ..calibration.clone() };
        let event = |k: usize| cases.happened(k, Event::Overturning, f64::INFINITY);
        let shares: Vec<(f64, bool)> =
            (0..cases.len()).filter_map(|k| Some((cases.pga_m_s2[k] / G_M_S2, event(k)?))).collect();
        let ends = ends(&shares);
        let p = |row: &Calibration, pga_g: f64| {
            let pga_m_s2 = pga_g * G_M_S2;
            let pgv_m_s = pga_m_s2 * peaks.pgv_over_pga(Peak::Pga, pga_m_s2, 0.0);
            let measures = IntensityMeasures::new(&cases.structure, pga_m_s2, pgv_m_s, None, None);
            let logit = logit_overturning(row.kind, &cases.structure, &measures)?;
            Some(row.probability(logit, Scenarios::Many))
        };
        let own = curve("calibrated", ratios(ends).map(|pga| (pga, p(calibration, pga))));
        let surface = curve("surface", ratios(ends).map(|pga| (pga, p(&of_surface, pga))));
        let curves = vec![own, Curve { band: Vec::new(), ..surface }];
        Some(StructureCurves { name: cases.structure.name.clone(), curves, shares: binned(&shares) })
    };
    panel(groups, "PGA (g)", groups.iter().filter_map(structure).collect())
}

fn ends(cases: &[(f64, bool)]) -> [f64; 2] {
    let ends = |[low, high]: [f64; 2], (value, _): &(f64, bool)| [low.min(*value), high.max(*value)];
    cases.iter().fold([f64::INFINITY, 0.0], ends)
}

/// Shares of events in bins of equal ratio, with Wilson's limits.
fn binned(cases: &[(f64, bool)]) -> Vec<Estimate> {
    /// Cases for each bin, on average.
    const CASES: usize = 8;
    let bins = (cases.len() / CASES).clamp(4, BINS);
    observed_shares(cases, equal_ratios(ends(cases), bins), |events, n| {
        let limits = wilson_limits(events, n);
        [limits.low, limits.high]
    })
}
