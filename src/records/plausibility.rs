//! Whether an acceleration can be that of an earthquake: a wrong unit, a wrong time step and damaged samples give motions that
//! no instrument has ever recorded.

use crate::motion::intensity::{peak, velocity};
use crate::units::G_M_S2;

/// Time steps of records, s: from instruments of 200 to 500 samples a second down to film digitised by hand, with a margin.
const STEPS_S: (f64, f64) = (1e-4, 0.1);
/// The fewest samples of a motion that rises, peaks and dies away: half a second at the longest steps of film.
const FEWEST_SAMPLES: usize = 25;
/// The largest recorded PGA is that of Iwate-Miyagi 2008, IWTH25: 4278 cm/s2 as the vector of all three components (Yamada, Mori & Heaton
/// 2009, The slapdown phase in high-acceleration records of large earthquakes, Seismological Research Letters 80), and so less of one;
/// with a margin, m/s2.
const LARGEST_PGA_M_S2: f64 = 5.0 * G_M_S2;
/// Chi-Chi 1999 reached a PGV of 3.18 m/s (Wikipedia, "1999 Jiji earthquake"; no source was found that none was larger); with a margin, m/s.
const LARGEST_PGV_M_S: f64 = 5.0;
/// Above these a motion is rare enough to ask for its unit: one in m/s2 under a heading that says g is ten times too strong, and PGV/PGA
/// does not show it; m/s2 and m/s.
const RARE_PGA_M_S2: f64 = 2.0 * G_M_S2;
const RARE_PGV_M_S: f64 = 2.5;
/// The range of PGV/PGA, s: sines of 30 Hz have 0.005; the records of FEMA P695 have 0.06 to 0.47, and records with the longest pulses about
/// 0.9 (from memory, without a source).
const PGV_PGA_S: (f64, f64) = (0.005, 1.0);
/// The highest mean frequency, Hz: the ground damps what is faster, on the hardest rock above some 20 Hz; the records of FEMA
/// P695 have 1.5 to 14.
const HIGHEST_FREQUENCY_HZ: f64 = 30.0;
/// A spike: one sample that holds this share of the sum of squares, while its neighbours are below this share of it. In the
/// records of FEMA P695 the largest sample holds 0.044 at most, and its neighbours reach 0.79 of it at least.
const SPIKE: (f64, f64) = (0.02, 0.25);
/// The ground is at rest when a record ends: a velocity above this, m/s, that is also above this share of PGV is a drift. The
/// records of FEMA P695 end at 0.015 m/s and 0.025 of PGV at most.
const DRIFT: (f64, f64) = (0.1, 0.5);
/// Accelerographs resolve some 1e-4 g, and a motion of 1e-3 g rocks nothing that stands; m/s2.
const WEAKEST_PGA_M_S2: f64 = 1e-3 * G_M_S2;

/// Why a motion can hardly be one of an earthquake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Doubt {
    /// What was found, such as `PGA 598 g`.
    pub found: String,
    /// What is known of records, and which slip it may be.
    pub reason: &'static str,
    /// Whether no record was ever like this, rather than few that matter.
    pub is_impossible: bool,
}

/// Judges an acceleration (m/s2) at steps of `dt_s`; gives the first doubt.
pub fn doubt(acceleration: &[f64], dt_s: f64) -> Option<Doubt> {
    let impossible = |found: String, reason| Some(Doubt { found, reason, is_impossible: true });
    if !(STEPS_S.0..=STEPS_S.1).contains(&dt_s) {
        return impossible(
            format!("dt {} s", rounded(dt_s)),
            "time steps of records are 0.0001 to 0.1 s; milliseconds, or sample numbers in place of times?",
        );
    }
    if acceleration.len() < FEWEST_SAMPLES {
        return impossible(
            format!("{} samples", acceleration.len()),
            "a motion that rises, peaks and dies away has 25 or more; a part of a record, or another table?",
        );
    }
    let pga = peak(acceleration);
    if pga == 0.0 {
        return impossible("0 throughout".to_string(), "a motion without motion; another column?");
    }
    if let Some(sample) = spike(acceleration, pga) {
        return impossible(
            format!("sample {} of {} g", sample + 1, rounded(pga / G_M_S2)),
            "it is isolated among samples below a quarter of it; a spike or a damaged number?",
        );
    }
    if pga > LARGEST_PGA_M_S2 {
        return impossible(
            format!("PGA {} g", rounded(pga / G_M_S2)),
            "the largest ever recorded is about 4 g; another unit, such as cm/s2?",
        );
    }
    let velocity = velocity(acceleration, dt_s);
    let pgv = peak(&velocity);
    let last = velocity.last().map_or(0.0, |last| last.abs());
    if last > DRIFT.0 && last > DRIFT.1 * pgv {
        return impossible(
            format!("velocity of {} m/s at the end", rounded(last)),
            "the ground comes to rest; an offset or a trend, which import-motions --baseline linear removes, or the end is cut off?",
        );
    }
    if pgv > LARGEST_PGV_M_S {
        return impossible(
            format!("PGV {} m/s", rounded(pgv)),
            "records reach about 3 m/s; another unit or time step, or an offset?",
        );
    }
    if pgv > PGV_PGA_S.1 * pga {
        return impossible(
            format!("PGV/PGA {} s", rounded(pgv / pga)),
            "records have up to about 0.9 s; a time step too long, or velocity in place of acceleration?",
        );
    }
    let frequency = mean_frequency(acceleration, dt_s);
    if frequency > HIGHEST_FREQUENCY_HZ || pgv < PGV_PGA_S.0 * pga {
        return impossible(
            format!("mean frequency {} Hz, PGV/PGA {} s", rounded(frequency), rounded(pgv / pga)),
            "records have up to about 20 Hz, and 0.01 s at least; a time step too short, or noise?",
        );
    }
    let possible = |found: String, reason| Some(Doubt { found, reason, is_impossible: false });
    let pga_g = || format!("PGA {} g", rounded(pga / G_M_S2));
    if pga < WEAKEST_PGA_M_S2 {
        return possible(pga_g(), "too weak to rock anything; another unit, such as g in place of cm/s2?");
    }
    if pga > RARE_PGA_M_S2 {
        return possible(
            pga_g(),
            "few records exceed 2 g; is it in m/s2, where its heading or --unit says g?",
        );
    }
    if pgv > RARE_PGV_M_S {
        let found = format!("PGV {} m/s", rounded(pgv));
        return possible(
            found,
            "few records exceed 2.5 m/s; is it in m/s2, where its heading or --unit says g?",
        );
    }
    None
}

/// The place of the largest sample, if it stands alone.
fn spike(acceleration: &[f64], pga: f64) -> Option<usize> {
    let at = acceleration.iter().position(|a| a.abs() == pga)?;
    let neighbours = [at.checked_sub(1), Some(at + 1)].map(|place| acceleration.get(place?));
    let is_alone = neighbours.into_iter().flatten().all(|a| a.abs() < SPIKE.1 * pga);
    let squares = || acceleration.iter().map(|a| a * a).sum::<f64>();
    (is_alone && pga * pga > SPIKE.0 * squares()).then_some(at)
}

/// The root of the mean square of frequencies, Hz: that of the sine whose steps are as large.
fn mean_frequency(acceleration: &[f64], dt_s: f64) -> f64 {
    let steps: f64 = acceleration.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
    let squares: f64 = acceleration.iter().map(|a| a * a).sum();
    (steps / squares).sqrt() / (std::f64::consts::TAU * dt_s)
}

/// To three digits.
fn rounded(value: f64) -> String {
    let digits = 2 - libm::floor(libm::log10(value.abs().max(1e-300))) as i32;
    match usize::try_from(digits) {
        Ok(decimals) if decimals < 12 => {
            let text = format!("{value:.decimals$}");
            if decimals == 0 { text } else { text.trim_end_matches('0').trim_end_matches('.').to_string() }
        }
        Ok(_) => format!("{value:.2e}"),
        Err(_) => format!("{value:.0}"),
    }
}
