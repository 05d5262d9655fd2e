//! Hazard as people and agencies give it: a column for each peak and one of rates, probabilities or return
//! periods, or what OpenQuake exports: curves, and ground-motion fields.

mod columns;
mod files;

use std::path::PathBuf;

use anyhow::{Context, bail};

use self::columns::{Intensity, Statistic};
pub use self::columns::{Renamed, headings, peak, rename};
use self::files::{Contents, Found, contents};
use crate::fragility::Peak;
use crate::hazard::{Hazard, JointHazard, PeakHazard};
use crate::hazard::{Velocity, VelocitySource, velocity_of_spectrum};
use crate::plausibility::judge_hazard;
use crate::sheet::Sheet;
use crate::units::G_M_S2;

/// Reads the hazard of a site: a file, or a file for each of its curves. `effective_years` is the time that
/// ground-motion fields stand for. Also returns the headings of columns that are not used.
pub fn read(
    paths: &[PathBuf],
    renamed: &[Renamed],
    effective_years: Option<f64>,
) -> anyhow::Result<(Hazard, Vec<String>)> {
    let (mut curves, mut joint, mut unused) = (Vec::new(), Vec::new(), renamed.to_vec());
    let mut unused_headings = Vec::new();
    for path in paths {
        let mut contents = || {
            let mut sheet = Sheet::parse(&std::fs::read(path)?)?;
            let is_here = |wanted: &&Renamed| sheet.headings.iter().any(|found| found.text == wanted.heading);
            let here: Vec<Renamed> = match paths {
                [_] => renamed.to_vec(),
                _ => renamed.iter().filter(is_here).cloned().collect(),
            };
            rename(&mut sheet, &here)?;
            unused.retain(|wanted| !here.contains(wanted));
            contents(&sheet, path, effective_years)
        };
        match contents().with_context(|| path.display().to_string())? {
            Contents::Curves(found, unused) => {
                curves.extend(found);
                unused_headings.extend(unused);
            }
            Contents::Joint(hazard) => joint.push(hazard),
        }
    }
    if let Some(wanted) = unused.first() {
        bail!("no heading '{}' in any file of the hazard", wanted.heading);
    }
    match (joint.pop(), paths) {
        (Some(joint), [path]) => {
            judge_joint(&joint).with_context(|| path.display().to_string())?;
            Ok((Hazard::Joint(joint), unused_headings))
        }
        (Some(_), _) => bail!("a hazard of PGA and PGV together among others; expected it alone"),
        (None, _) => Ok((joined(curves)?, unused_headings)),
    }
}

/// The hazard of one peak, with what the other curves tell of it.
fn joined(curves: Vec<Found>) -> anyhow::Result<Hazard> {
    for found in &curves {
        let name = found.intensity.name();
        let is_same =
            |other: &&Found| (other.intensity, other.statistic) == (found.intensity, found.statistic);
        if let [first, second, ..] = curves.iter().filter(is_same).collect::<Vec<_>>()[..] {
            bail!("two curves of {name}: {} and {}; expected one", first.file, second.file);
        }
        judge_curve(found)?;
    }
    let of = |intensity: Intensity, statistic: Statistic| {
        let is_it = |found: &&Found| (found.intensity, found.statistic) == (intensity, statistic);
        curves.iter().find(is_it).map(|found| &found.curve)
    };
    let mean = |intensity: Intensity| of(intensity, Statistic::Mean).or(of(intensity, Statistic::Median));
    let [pga, pgv, spectral] =
        [Intensity::Peak(Peak::Pga), Intensity::Peak(Peak::Pgv), Intensity::Spectral].map(mean);
    let (peak, curve, velocity) = match (pga, pgv, spectral) {
        (Some(pga), Some(pgv), _) => {
            (Peak::Pga, pga, Some(Velocity::of_curves(pga, pgv, VelocitySource::Velocity)?))
        }
        (Some(pga), None, Some(spectral)) => {
            let pgv = velocity_of_spectrum(pga, spectral);
            (Peak::Pga, pga, Some(Velocity::of_curves(pga, &pgv, VelocitySource::Spectrum)?))
        }
        (Some(pga), None, None) => (Peak::Pga, pga, None),
        (None, _, Some(_)) => bail!("SA(1.0 s) without PGA; expected the curve of PGA too"),
        (None, Some(pgv), None) => (Peak::Pgv, pgv, None),
        (None, None, None) => bail!("fractiles alone; expected the mean curve too"),
    };
    let fractile = |statistic: Statistic| of(Intensity::Peak(peak), statistic).cloned();
    let fractiles = fractile(Statistic::Low).zip(fractile(Statistic::High)).map(|(low, high)| [low, high]);
    Ok(Hazard::Curve(PeakHazard { peak, curve: curve.clone(), fractiles, velocity }))
}

fn judge_curve(found: &Found) -> anyhow::Result<()> {
    let unit = match found.intensity {
        Intensity::Peak(Peak::Pgv) => 1.0,
        _ => G_M_S2,
    };
    let points: Vec<(f64, f64)> = found.curve.points().iter().map(|(im, rate)| (im / unit, *rate)).collect();
    judge_hazard(found.intensity == Intensity::Peak(Peak::Pgv), &points).with_context(|| found.file.clone())
}

fn judge_joint(joint: &JointHazard) -> anyhow::Result<()> {
    judge_hazard(false, &joint.exceedance(|bin| bin.pga_m_s2 / G_M_S2))?;
    Ok(judge_hazard(true, &joint.exceedance(|bin| bin.pgv_m_s))?)
}
