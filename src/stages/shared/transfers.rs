//! How curves did on other structures than their own, in the shipped study of universality, and what that says of an answer.

use serde::Deserialize;

use crate::rocking::{Block, Structure};

/// What `rockfrag universality` found: the curves of one structure on 61 others.
const STUDY: &str = include_str!("../../../data/universality.csv");
/// The structure whose curves were taken to the others.
const REFERENCE: &str = "electrical-equipment";

/// Bounds of |ln(ratio)| of slenderness, |ln(ratio)| of p, and difference in eta, that divide transfers into near and far ones.
const BANDS: [&[f64]; 3] = [&[0.3, 0.75], &[0.5, 1.0], &[0.005]];
/// A difference in the logarithm of p or alpha that the response hardly feels.
const SAME: f64 = 0.01;

/// A row of the study.
#[derive(Debug, Deserialize)]
struct Transfer {
    suite: String,
    event: String,
    structure: String,
    p_rad_s: f64,
    alpha_rad: f64,
    eta: f64,
    worst_over: Option<f64>,
    worst_under: Option<f64>,
    verdict: String,
}

/// |ln(ratio)| of slenderness and of p.
fn ln_ratios(block: Block, other: Block) -> [f64; 2] {
    let ln_ratio = |a: f64, b: f64| libm::log(a / b).abs();
    [ln_ratio(block.alpha_rad, other.alpha_rad), ln_ratio(block.p_rad_s, other.p_rad_s)]
}

/// How far a structure is from the one that was fitted: the band of slenderness, of p and of eta.
fn distance((block, eta): (Block, f64), (other, other_eta): (Block, f64)) -> [usize; 3] {
    let [alpha, p] = ln_ratios(block, other);
    let differences = [alpha, p, (eta - other_eta).abs()];
    std::array::from_fn(|axis| BANDS[axis].iter().filter(|&&bound| differences[axis] > bound).count())
}

/// Whether a structure has another slenderness or size than the one that was fitted.
pub fn is_other_block(fitted: Block, structure: &Structure) -> bool {
    ln_ratios(fitted, structure.block()).iter().any(|difference| *difference > SAME)
}

/// What the study found for curves of overturning taken as far as from the fitted structure to this one, in words; none if it is
/// the same block, whatever its eta.
pub fn words(suite: Option<&str>, fitted: (Block, f64), structure: &Structure) -> Option<String> {
    if !is_other_block(fitted.0, structure) {
        return None;
    }
    let asked = distance(fitted, (structure.block(), structure.eta));
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(STUDY.as_bytes());
    let study: Vec<Transfer> = reader.deserialize().collect::<Result<_, _>>().ok()?;
    let at = |row: &Transfer| (Block { p_rad_s: row.p_rad_s, alpha_rad: row.alpha_rad }, row.eta);
    let reference = at(study.iter().find(|row| row.structure == REFERENCE)?);
    let judged = |row: &&Transfer| {
        row.event == "overturning" && suite.is_none_or(|suite| suite == row.suite) && row.worst_over.is_some()
    };
    let as_far = |row: &&Transfer| distance(reference, at(row)) == asked;
    let transfers: Vec<&Transfer> = study.iter().filter(judged).filter(as_far).collect();
    let mut worst: Vec<f64> =
        transfers.iter().filter_map(|row| Some(row.worst_over?.max(row.worst_under?))).collect();
    worst.sort_by(f64::total_cmp);
    let held = transfers.iter().filter(|row| row.verdict == "holds").count();
    let found = match (&worst[..], transfers.len()) {
        ([only], _) => format!(
            "the one curve taken as far {}, with errors in probability up to {only:.2}",
            if held == 1 { "held" } else { "failed" }
        ),
        ([least, .., largest], all) => format!(
            "of {all} curves taken as far, {held} held, with errors in probability up to {least:.2} in the best case and {largest:.2} in the worst"
        ),
        ([], _) => "no curve was taken as far".to_string(),
    };
    let of = |Block { p_rad_s, alpha_rad }: Block, eta: f64| {
        format!("p {p_rad_s:.3} rad/s, alpha {alpha_rad:.3}, eta {eta:.2}")
    };
    Some(format!(
        "the curves are of {}, this structure has {}: in the study of universality, {found}; simulate and fit this structure",
        of(fitted.0, fitted.1),
        of(structure.block(), structure.eta)
    ))
}
