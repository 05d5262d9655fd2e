//! The universal surface: L and g of logit P = c + s L + m (M - 6.9) + g, P_ro or P_ex of any structure.
//! data/universal.csv has its coefficients; scripts/universal fits them.

use std::sync::LazyLock;

use super::joint_peaks::{JointPeaks, RatioGiven};
use super::magnitude::{AssumedMagnitude, MagnitudeSource};
use crate::motion::{IntensityMeasures, Peaks, Suite};
use crate::rocking::Structure;
use crate::spelling::unknown_word;
use crate::statistics::Range;

/// Kinds of motion that the surface was fitted to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[derive(Default)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<MotionKind>)]
pub enum MotionKind {
    #[default]
    Recorded,
    /// Combined synthetic motions on rock: pulse and high frequencies.
    Csgm,
    Pulse,
    Hfc,
}

impl MotionKind {
    /// By the word of a suite in tables, on the ground or a floor; recorded without a known word.
    pub fn from_suite(suite: Option<&str>) -> MotionKind {
        match suite.and_then(|word| word.trim_end_matches(Suite::ON_FLOOR).parse().ok()) {
            Some(Suite::Pulse) => MotionKind::Pulse,
            Some(Suite::Csgm) => MotionKind::Csgm,
            Some(Suite::Hfc) => MotionKind::Hfc,
            Some(Suite::Record) | None => MotionKind::Recorded,
        }
    }

    pub fn description(self) -> &'static str {
        match self {
            MotionKind::Recorded => "recorded motions",
            MotionKind::Csgm => "synthetic near-fault motions on rock",
            MotionKind::Pulse => "synthetic pulses alone",
            MotionKind::Hfc => "synthetic motions without a pulse",
        }
    }
}

/// The surface for one structure, limit state and magnitude: a function of IM4 and PGV / PGA.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StructureSurface {
    /// Coefficients of x^i w^j r^k: at `[i][j][k]`.
    coefficients: [[[f64; POWERS]; POWERS]; POWERS_OF_X],
    /// ln IM5 - w.
    w_shift: f64,
    /// ln p of the structure, and within the domain.
    ln_p: f64,
    ln_p_held: f64,
    uplift_term: UpliftTerm,
    pub magnitude: ExpectedMagnitude,
}

impl StructureSurface {
    /// P_ex at a limit state, P_ro without one. An unknown magnitude is inferred from PGV / PGA.
    pub fn new(
        kind: MotionKind,
        structure: &Structure,
        limit_state: Option<f64>,
        mw: Option<f64>,
    ) -> StructureSurface {
        let (domain, branch) = (&SURFACE.domain, SURFACE.branch(kind, limit_state));
        let [limit, end] = limits(limit_state);
        let p = domain.p.clamp(structure.p_rad_s);
        // In front of a wall the rebound stands for eta.
        let eta = structure.rebound.map_or(domain.eta.clamp(structure.eta), |_| 0.85);
        let fixed = [(eta - 0.85) / 0.1, (p / 2.0).ln(), limit, end];
        let mut coefficients = [[[0.0; POWERS]; POWERS]; POWERS_OF_X];
        for Term { coefficient, powers: [x, w, r, others @ ..] } in &branch.terms {
            let others = fixed.iter().zip(others).map(|(value, power)| value.powi(*power as i32));
            coefficients[*x][*w][*r] += coefficient * others.product::<f64>();
        }
        if let Some(rebound) = structure.rebound {
            let [a, b, c, d] = if limit_state.is_some() { EXCEEDING_AT_WALL } else { OVERTURNING_AT_WALL };
            coefficients[0][0][0] += a + b * rebound * rebound + d * fixed[1];
            coefficients[1][0][0] += c;
        }
        let expected = SURFACE.kinds[kind as usize].magnitude;
        let given = |mw| ExpectedMagnitude { intercept: mw, slope: 0.0, sd: 0.0, ..expected };
        StructureSurface {
            coefficients,
            w_shift: 0.4 * limit,
            ln_p: structure.p_rad_s.ln(),
            ln_p_held: p.ln(),
            uplift_term: branch.uplift_term,
            magnitude: mw.map_or(expected, given),
        }
    }

    /// M - 6.9 of motions with this ln(PGV / PGA), s.
    pub fn magnitude(&self, ln_pgv_pga: f64) -> f64 {
        self.magnitude.mean(ln_pgv_pga) - REFERENCE_MAGNITUDE
    }

    /// M - 6.9 in the middle of the magnitudes of the data.
    pub fn middle_magnitude(&self) -> f64 {
        0.5 * (self.magnitude.range.low + self.magnitude.range.high) - REFERENCE_MAGNITUDE
    }

    /// L at an IM4, a cubic in r = ln IM3, by Horner's rule in w = ln IM4 - r - 0.4 limit.
    pub fn at(&self, at: &Im4Terms) -> SurfaceAtIm4 {
        let Im4Terms { ln_im4, held, x, ln_above } = *at;
        let ([a, b, c], w_at_r_0) = (&self.coefficients, held - self.w_shift);
        let mut cubic = [0.0; POWERS];
        for w in (0..POWERS).rev() {
            for r in (0..POWERS - w).rev() {
                let one_power_less = if r > 0 { cubic[r - 1] } else { 0.0 };
                let by_x = a[w][r] + x * (b[w][r] + x * c[w][r]);
                cubic[r] = w_at_r_0 * cubic[r] - one_power_less + by_x;
            }
        }
        let UpliftTerm { n, ln_d, k } = self.uplift_term;
        let ln_uplift_term = n * (ln_d - ln_above - k * (self.ln_p + ln_im4));
        SurfaceAtIm4 {
            cubic,
            excess: ln_im4 - held,
            ln_p: self.ln_p_held,
            ln_pga_pgv: SURFACE.ln_pga_pgv,
            ln_uplift_term,
            slope: -n * k,
        }
    }
}

/// An IM4, with what the surfaces of all structures need of it.
pub(super) struct Im4Terms {
    ln_im4: f64,
    /// ln IM4, held at the end of its domain: beyond, the polynomial means nothing, and PGV alone counts, so
    /// that P does not fall as PGV / PGA falls.
    held: f64,
    /// ln(held + 0.2).
    x: f64,
    /// ln(IM4 - 1).
    ln_above: f64,
}

impl Im4Terms {
    pub fn new(im4: f64, ln_im4: f64) -> Im4Terms {
        let held = SURFACE.ln_im4.clamp(ln_im4);
        Im4Terms { ln_im4, held, x: (held + 0.2).ln(), ln_above: (im4 - 1.0).max(0.0).ln() }
    }
}

/// The surface of a structure at one IM4: a function of ln(PGV / PGA), s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SurfaceAtIm4 {
    /// L by powers of ln IM3.
    cubic: [f64; POWERS],
    /// ln of PGA over the PGA at which it is held.
    pub excess: f64,
    /// ln p, and the range of ln(PGA / PGV), within the domain.
    ln_p: f64,
    ln_pga_pgv: Range,
    /// ln -g where PGV / PGA is 1 s, and its slope.
    ln_uplift_term: f64,
    slope: f64,
}

impl SurfaceAtIm4 {
    /// L, with PGA / PGV held within the domain.
    pub fn logit(&self, ln_pgv_pga: f64) -> f64 {
        let ln_im3 = self.ln_pga_pgv.clamp(-ln_pgv_pga - self.excess) - self.ln_p;
        self.cubic.iter().rev().fold(0.0, |sum, coefficient| sum * ln_im3 + coefficient)
    }

    /// g = -(d / ((IM4 - 1) IM5^k))^n.
    pub fn uplift_term(&self, ln_pgv_pga: f64) -> f64 {
        -(self.ln_uplift_term + self.slope * ln_pgv_pga).exp()
    }
}

pub(super) fn inferred_magnitude(kind: MotionKind, motion: Peaks) -> AssumedMagnitude {
    let expected = SURFACE.kinds[kind as usize].magnitude;
    let mw = expected.mean((motion.pgv_m_s / motion.pga_m_s2).ln());
    AssumedMagnitude { mw, sd: expected.sd, source: MagnitudeSource::Inferred }
}

/// The PGA (m/s2) at which IM4 is held, the end of its domain.
pub(super) fn held_pga_m_s2(structure: &Structure) -> f64 {
    structure.uplift_acceleration_m_s2() * SURFACE.domain.im4.high
}

/// The values of ln(PGV / PGA), s, at which the surface bends: the ends of its domain and, where the
/// magnitude is inferred, of the magnitudes of the data.
pub(super) fn bends(kind: MotionKind, mw: Option<f64>) -> Vec<f64> {
    let ExpectedMagnitude { intercept, slope, range, .. } = SURFACE.kinds[kind as usize].magnitude;
    let by_domain = [-SURFACE.ln_pga_pgv.low, -SURFACE.ln_pga_pgv.high];
    let by_magnitude = [range.low, range.high].map(|mw| (mw - intercept) / slope);
    by_domain.into_iter().chain(by_magnitude.into_iter().filter(|_| mw.is_none())).collect()
}

pub fn covers_structure(structure: &Structure) -> bool {
    let Domain { p, alpha, eta, .. } = &SURFACE.domain;
    p.has(structure.p_rad_s) && alpha.has(structure.alpha_rad) && eta.has(structure.eta)
}

pub fn covers_motion(structure: &Structure, measures: &IntensityMeasures, limit_state: f64) -> bool {
    let Domain { im4, im5, pga_pgv, limit, .. } = &SURFACE.domain;
    im4.has(measures.im4)
        && im5.has(measures.im5)
        && pga_pgv.has(structure.p_rad_s * measures.im4 / measures.im5)
        && limit.has(limit_state)
}

/// Normal distributions of c, ln s and m over structures under a kind of motion: a row `calibration`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Prior {
    pub mean: [f64; 3],
    pub sd: [f64; 3],
    /// Standard deviation of the logit between cells or earthquakes.
    pub tau: f64,
    /// Rise of c with ln(1.1 - limit state).
    by_limit: f64,
}

pub(super) fn prior(kind: MotionKind, limit_state: Option<f64>) -> Prior {
    let mut prior = SURFACE.branch(kind, limit_state).prior;
    prior.mean[0] += prior.by_limit * limits(limit_state)[1];
    prior
}

pub(super) fn peaks(kind: MotionKind) -> JointPeaks {
    SURFACE.kinds[kind as usize].peaks
}

/// The magnitude at which m has no effect.
const REFERENCE_MAGNITUDE: f64 = 6.9;

/// L is a sum of rows `term,pro|pex,FUNCTION,recorded,csgm,pulse,hfc` of data/universal.csv: FUNCTION, a
/// product such as `x*w^2`, times the coefficient for the kind of motion. The features are
/// x = ln(ln IM4 + 0.2), finite at uplift; r = ln IM3; w = ln IM5 - 0.4 limit; eta = (eta - 0.85)/0.1;
/// p = ln(p/2); and, of a limit state c, limit = ln(c/0.2) and end = ln(1.1 - c), 0 for P_ro. IM4, PGA / PGV,
/// p, eta and c are held within rows `domain,NAME,LOW,HIGH`.
const FEATURES: [&str; 7] = ["x", "w", "r", "eta", "p", "limit", "end"];
/// a, b, c and d of a + b e^2 + c x + d ln(p/2), by which a wall with a rebound e changes L where eta is .85
/// (scripts/wall/wall.py).
const OVERTURNING_AT_WALL: [f64; 4] = [-6.71, 7.75, 6.68, 0.89];
const EXCEEDING_AT_WALL: [f64; 4] = [-6.21, 5.83, 5.45, -0.34];
/// Powers of w and of r, from 0 to the third of both together; powers of x.
const POWERS: usize = 4;
const POWERS_OF_X: usize = 3;

/// The features `limit` and `end`, which falls steeply near overturning.
fn limits(limit_state: Option<f64>) -> [f64; 2] {
    limit_state.map_or([0.0; 2], |limit_state| {
        let held = SURFACE.domain.limit.clamp(limit_state);
        [(held / 0.2).ln(), (1.1 - held).ln()]
    })
}

/// data/universal.csv, read.
struct Surface {
    domain: Domain,
    ln_pga_pgv: Range,
    ln_im4: Range,
    kinds: [KindParameters; 4],
}

/// Ranges of the data: p (rad/s), eta and alpha (rad), limit states, PGA / PGV (1/s), IM4 and IM5.
struct Domain {
    p: Range,
    eta: Range,
    alpha: Range,
    limit: Range,
    pga_pgv: Range,
    im4: Range,
    im5: Range,
}

struct KindParameters {
    magnitude: ExpectedMagnitude,
    /// P_ro and P_ex.
    branches: [BranchSurface; 2],
    peaks: JointPeaks,
}

/// P_ro or P_ex under a kind of motion.
struct BranchSurface {
    terms: Vec<Term>,
    uplift_term: UpliftTerm,
    prior: Prior,
}

/// A row `magnitude`: M is normal about intercept + slope ln(PGV / PGA), s, within the range of the data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ExpectedMagnitude {
    intercept: f64,
    slope: f64,
    pub sd: f64,
    range: Range,
}

impl ExpectedMagnitude {
    fn mean(&self, ln_pgv_pga: f64) -> f64 {
        self.range.clamp(self.intercept + self.slope * ln_pgv_pga)
    }
}

/// The parameters of g = -(d / ((IM4 - 1) IM5^k))^n: a row `uplift`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct UpliftTerm {
    n: f64,
    ln_d: f64,
    k: f64,
}

/// A product of powers of [`FEATURES`].
struct Term {
    coefficient: f64,
    powers: [usize; FEATURES.len()],
}

impl Term {
    /// Reads a product such as `x*w^2`, or 1.
    fn parse(product: &str, coefficient: f64) -> Term {
        let mut powers = [0; FEATURES.len()];
        for factor in product.split('*').filter(|name| *name != "1") {
            let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
            let place = FEATURES.iter().position(|feature| *feature == name).expect(product);
            powers[place] += power.parse::<usize>().expect(product);
        }
        let [x, w, r, ..] = powers;
        assert!(x < POWERS_OF_X && w + r < POWERS, "{product}: of a higher degree than the surface has");
        Term { coefficient, powers }
    }
}

static SURFACE: LazyLock<Surface> =
    LazyLock::new(|| Surface::parse(include_str!("../../data/universal.csv")));

impl Surface {
    /// P_ex has a limit state, P_ro has none.
    fn branch(&self, kind: MotionKind, limit_state: Option<f64>) -> &BranchSurface {
        &self.kinds[kind as usize].branches[usize::from(limit_state.is_some())]
    }

    /// Reads the file that is compiled in. An invalid line is a fault of the build, which tests find.
    fn parse(text: &'static str) -> Surface {
        let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
        let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
        let [p, eta, alpha, limit, pga_pgv, im4, im5] = ["p", "eta", "alpha", "limit", "ratio", "im4", "im5"]
            .map(|name| {
                let [low, high] = numbers(&rows, &["domain", name]);
                Range { low, high }
            });
        Surface {
            ln_pga_pgv: pga_pgv.ln(),
            ln_im4: im4.ln(),
            domain: Domain { p, eta, alpha, limit, pga_pgv, im4, im5 },
            kinds: [MotionKind::Recorded, MotionKind::Csgm, MotionKind::Pulse, MotionKind::Hfc]
                .map(|kind| KindParameters::parse(&rows, kind)),
        }
    }
}

impl KindParameters {
    fn parse(rows: &[Vec<&str>], kind: MotionKind) -> KindParameters {
        let word: &str = kind.into();
        let [intercept, slope, sd, low, high] = numbers(rows, &["magnitude", word]);
        let [given_pga, given_pgv] = ["pga", "pgv"].map(|peak| {
            RatioGiven::from_numbers(&numbers::<6>(rows, &["peaks", word, peak])).expect("six numbers")
        });
        KindParameters {
            magnitude: ExpectedMagnitude { intercept, slope, sd, range: Range { low, high } },
            branches: ["pro", "pex"].map(|name| BranchSurface::parse(rows, kind, name)),
            peaks: JointPeaks { given_pga, given_pgv },
        }
    }
}

impl BranchSurface {
    fn parse(rows: &[Vec<&str>], kind: MotionKind, name: &str) -> BranchSurface {
        let [n, d, k] = numbers(rows, &["uplift", kind.into(), name]);
        let [c, ln_s, m, sd_c, sd_ln_s, sd_m, tau, by_limit] =
            numbers(rows, &["calibration", kind.into(), name]);
        let terms = rows.iter().filter(|row| row.starts_with(&["term", name]));
        BranchSurface {
            terms: terms
                .map(|row| Term::parse(row[2], row[3 + kind as usize].parse().expect("a number")))
                .collect(),
            uplift_term: UpliftTerm { n, ln_d: d.ln(), k },
            prior: Prior { mean: [c, ln_s, m], sd: [sd_c, sd_ln_s, sd_m], tau, by_limit },
        }
    }
}

/// The numbers of the row that begins with these words.
fn numbers<const N: usize>(rows: &[Vec<&str>], words: &[&str]) -> [f64; N] {
    let row = rows.iter().find(|row| row.starts_with(words)).expect("the file has it");
    std::array::from_fn(|k| row[words.len() + k].parse().expect("a number"))
}
