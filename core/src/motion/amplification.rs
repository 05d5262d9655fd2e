//! Site amplification V(f) of the stochastic method (section 2.1.2).

/// Amplification from the source to the surface: rising frequencies, Hz, and factors.
///
/// ```
/// use rockfrag_core::motion::SiteAmplification;
/// let site = SiteAmplification::table(vec![(0.1, 1.0), (10.0, 2.0)])?;
/// assert_eq!((site.amplification(0.01), site.amplification(20.0)), (1.0, 2.0));
/// # Ok::<(), rockfrag_core::motion::amplification::SiteTableError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SiteAmplification(Vec<(f64, f64)>);

/// An invalid table of amplification. `row` counts from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("site table, row {row}: expected rising frequencies in Hz and factors above 0, in 2 rows or more")]
pub struct SiteTableError {
    pub row: usize,
}

/// Frequency (Hz), amplification of generic rock and of generic soil (Boore & Joyner 1997).
const GENERIC: [(f64, f64, f64); 11] = [
    (0.01, 1.00, 1.00),
    (0.09, 1.10, 1.34),
    (0.16, 1.18, 1.57),
    (0.51, 1.42, 2.24),
    (0.84, 1.58, 2.57),
    (1.25, 1.74, 2.76),
    (2.26, 2.06, 2.98),
    (3.17, 2.25, 2.95),
    (6.05, 2.58, 3.05),
    (16.6, 3.13, 3.18),
    (61.2, 4.00, 3.21),
];

impl SiteAmplification {
    pub fn none() -> SiteAmplification {
        SiteAmplification(vec![(0.0, 1.0)])
    }

    pub fn rock() -> SiteAmplification {
        SiteAmplification(GENERIC.map(|(f, rock, _)| (f, rock)).to_vec())
    }

    pub fn soil() -> SiteAmplification {
        SiteAmplification(GENERIC.map(|(f, _, soil)| (f, soil)).to_vec())
    }

    /// # Errors
    /// If there are fewer than two rows, frequencies do not rise, or a number is not positive.
    pub fn table(rows: Vec<(f64, f64)>) -> Result<SiteAmplification, SiteTableError> {
        let mut last_hz = 0.0;
        for (row, &(frequency_hz, factor)) in rows.iter().enumerate() {
            let is_fine = frequency_hz > last_hz && frequency_hz.is_finite() && factor > 0.0;
            if !(is_fine && factor.is_finite()) {
                return Err(SiteTableError { row });
            }
            last_hz = frequency_hz;
        }
        if rows.len() < 2 { Err(SiteTableError { row: rows.len() }) } else { Ok(SiteAmplification(rows)) }
    }

    /// Interpolates V(f) at a frequency (Hz): ln V is linear in the frequency, constant beyond the ends.
    pub fn amplification(&self, frequency_hz: f64) -> f64 {
        let above = self.0.partition_point(|&(f, _)| f <= frequency_hz);
        if above == 0 {
            return self.0[0].1;
        }
        let (f0, v0) = self.0[above - 1];
        let Some(&(f1, v1)) = self.0.get(above) else { return v0 };
        let share = (frequency_hz - f0) / (f1 - f0);
        v0 * (v1 / v0).powf(share)
    }
}
