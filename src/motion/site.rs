//! Site amplification V(f) of the stochastic method (section 2.1.2).

/// Amplification from the source to the surface, as a function of frequency.
///
/// ```
/// use rockfrag::motion::SiteAmplification;
/// let site = SiteAmplification::table(vec![(0.1, 1.0), (10.0, 2.0)])?;
/// assert_eq!((site.amplification(0.01), site.amplification(20.0)), (1.0, 2.0));
/// # Ok::<(), rockfrag::motion::site::SiteTableError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum SiteAmplification {
    /// Generic rock (Boore & Joyner 1997).
    Rock,
    /// Generic soil (Boore & Joyner 1997).
    Soil,
    /// No amplification, V = 1.
    None,
    /// Frequencies, Hz, and factors of the user.
    Table(Vec<(f64, f64)>),
}

/// An invalid table of amplification. `row` counts from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message says it")]
pub enum SiteTableError {
    #[error("site table: {0} row(s); expected 2 or more of frequency in Hz and amplification")]
    TooShort(usize),
    #[error(
        "site table, row {row}: frequency {frequency_hz} Hz, amplification {amplification}; expected \
             rising frequencies and factors above 0"
    )]
    Row { row: usize, frequency_hz: f64, amplification: f64 },
}

/// Frequency (Hz), amplification of generic rock and of generic soil.
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
    /// Makes a table of frequencies (Hz) and factors.
    ///
    /// # Errors
    /// If there are fewer than two rows, frequencies do not rise, or a number is not positive.
    pub fn table(rows: Vec<(f64, f64)>) -> Result<SiteAmplification, SiteTableError> {
        if rows.len() < 2 {
            return Err(SiteTableError::TooShort(rows.len()));
        }
        let mut last_hz = 0.0;
        for (row, &(frequency_hz, amplification)) in rows.iter().enumerate() {
            let fine = frequency_hz > last_hz && amplification > 0.0;
            if !(fine && frequency_hz.is_finite() && amplification.is_finite()) {
                return Err(SiteTableError::Row { row, frequency_hz, amplification });
            }
            last_hz = frequency_hz;
        }
        Ok(SiteAmplification::Table(rows))
    }

    /// Interpolates V(f) at a frequency (Hz): ln V is linear in the frequency, constant beyond the ends.
    pub fn amplification(&self, frequency_hz: f64) -> f64 {
        match self {
            SiteAmplification::None => 1.0,
            SiteAmplification::Rock => interpolate(&GENERIC.map(|(f, rock, _)| (f, rock)), frequency_hz),
            SiteAmplification::Soil => interpolate(&GENERIC.map(|(f, _, soil)| (f, soil)), frequency_hz),
            SiteAmplification::Table(rows) => interpolate(rows, frequency_hz),
        }
    }
}

fn interpolate(rows: &[(f64, f64)], frequency_hz: f64) -> f64 {
    let above = rows.partition_point(|&(f, _)| f <= frequency_hz);
    if above == 0 {
        return rows[0].1;
    }
    let (f0, v0) = rows[above - 1];
    let Some(&(f1, v1)) = rows.get(above) else { return v0 };
    let share = (frequency_hz - f0) / (f1 - f0);
    v0 * (v1 / v0).powf(share)
}
