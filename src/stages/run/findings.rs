//! What a run found, in sentences: how the numbers of the paper compare, and a probability at one intensity.

use std::path::PathBuf;

use crate::fragility::p_no_rocking;
use crate::motion::IntensityMeasures;
use crate::pipeline::declare::Declare;
use crate::pipeline::stage::Stage;
use crate::rocking::Structure;
use crate::stages::compare_paper::ComparePaper;
use crate::stages::fit_pex::FitPex;
use crate::stages::fit_pro::FitPro;
use crate::stages::shared::answers::Answers;
use crate::stages::shared::chosen_fits::{ChosenFits, Line};
use crate::stages::shared::fits::{FitFiles, FitsOptions};
use crate::table::paper::PaperRow;
use crate::table::row::ReadRow;
use crate::units::G_M_S2;

/// The intensity at which the probability is stated: PGA in g and PGV in m/s, those of the first example of the README.
const PGA_G: f64 = 0.5;
const PGV_M_S: f64 = 0.6;
/// More structures than this are a table, not a sentence.
const MOST_STRUCTURES: usize = 4;
/// A published number beyond so many standard deviations is not reproduced.
const DEVIATIONS: f64 = 2.0;
/// A number that varies less than this over seeds does not come from them.
const ROUNDING: f64 = 1e-9;
/// A published plane whose probability is below this is not reproduced.
const LEAST_P: f64 = 0.05;

/// What the files of these stages say; of the published numbers, only if the stages are of the paper's set-up, as the spread over
/// seeds is.
///
/// # Errors
/// If one cannot be read.
pub fn of(stages: &[Box<dyn Stage>], is_of_paper: bool) -> anyhow::Result<Vec<String>> {
    let output = |name: &str| stages.iter().find(|stage| stage.name() == name)?.outputs().pop();
    let mut findings = Vec::new();
    if let Some(paper) = output(ComparePaper::NAME).filter(|_| is_of_paper) {
        findings.extend(of_paper(&PaperRow::read(paper)?));
    }
    if let (Some(pex), Some(pro)) = (output(FitPex::NAME), output(FitPro::NAME)) {
        findings.extend(of_fits(pex, pro)?);
    }
    Ok(findings)
}

/// How many published numbers and planes are reproduced.
fn of_paper(rows: &[PaperRow]) -> Option<String> {
    let compared: Vec<&PaperRow> = rows
        .iter()
        .filter(|row| row.published.is_some() && row.spread_sd.is_some_and(|sd| sd > ROUNDING))
        .collect();
    let deviations: Vec<f64> = compared.iter().filter_map(|row| row.z).collect();
    let within = deviations.iter().filter(|z| z.abs() <= DEVIATIONS).count();
    // Without z, the print leaves open more than the seeds do, and ours lies in it.
    let open = match compared.len() - deviations.len() {
        0 => String::new(),
        open => format!("; {open} more are printed with too few digits for a z"),
    };
    let planes: Vec<f64> = rows.iter().filter_map(|row| row.t2_p).collect();
    let matched = planes.iter().filter(|p| **p > LEAST_P).count();
    let seeds = compared.first()?.seeds;
    Some(format!(
        "{within} of {} published numbers lie within {DEVIATIONS} standard deviations of our mean over {seeds} seeds (column z{open}); \
         of the {} planes of Table II, {matched} are reproduced (T2_p above {LEAST_P})",
        deviations.len(),
        planes.len(),
    ))
}

/// How likely each structure is to overturn at one intensity, under the last suite, the one with high frequencies in the paper.
fn of_fits(pex: PathBuf, pro: PathBuf) -> anyhow::Result<Option<String>> {
    let files = FitFiles { pex: pex.into(), pro: pro.into(), options: FitsOptions::default() };
    let fits: Vec<ChosenFits> = files.choose_each()?.into_iter().filter_map(|(_, fits)| fits.ok()).collect();
    let Some(suite) = fits.last().map(|fits| fits.suite.clone()) else { return Ok(None) };
    let of_suite = fits.iter().filter(|fits| fits.suite == suite);
    let words: Vec<String> = of_suite.filter_map(probability).take(MOST_STRUCTURES).collect();
    let under = suite.map_or(String::new(), |suite| format!(" under {suite} motions"));
    Ok((!words.is_empty()).then(|| {
        format!(
            "at PGA {PGA_G} g and PGV {PGV_M_S} m/s{under}, the probability of overturning is {}",
            words.join("; ")
        )
    }))
}

/// The probability of overturning of the structure that was simulated, with what speaks against it.
fn probability(fits: &ChosenFits) -> Option<String> {
    let block = fits.block?;
    let (name, eta) = (fits.structure.clone(), fits.model.eta);
    let structure = Structure { name, p_rad_s: block.p_rad_s, alpha_rad: block.alpha_rad, eta };
    let measures = IntensityMeasures::new(&structure, PGA_G * G_M_S2, PGV_M_S, None, None);
    if p_no_rocking(measures.im4) == 1.0 {
        return Some(format!("0 for {}, which does not rock", structure.name));
    }
    let p = fits.probabilities(&structure, &measures).given_rocking?.p_ro;
    let doubts = [
        fits.misfit.as_ref().map(|misfit| match misfit.answer {
            Line::Bent => "by a curve that bends: its tests reject the straight one",
            Line::Straight => "its tests reject the curve",
        }),
        fits.model.out_of_range(&measures).next().map(|_| "outside of its data"),
    ];
    let doubts = doubts.into_iter().flatten().map(str::to_string).chain(fits.doubt_of_events());
    let doubts: String = doubts.map(|doubt| format!("; {doubt}")).collect();
    let [value, low, high] = [p.value, p.low, p.high].map(short);
    Some(format!("{value} for {} ({low} to {high}{doubts})", structure.name))
}

/// A probability with the digits that a sentence needs.
fn short(p: f64) -> String {
    if p < 0.01 { format!("{p:.0e}") } else { format!("{p:.2}") }
}
