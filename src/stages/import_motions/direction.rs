use std::fmt;
use std::str::FromStr;

/// Where a pair of components is rotated to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    /// An azimuth, degrees.
    Azimuth(f64),
    /// That of the strongest wavelet (Shahi & Baker 2014).
    StrongestPulse,
}

impl FromStr for Direction {
    type Err = String;

    fn from_str(text: &str) -> Result<Direction, String> {
        let azimuth = || text.parse().ok().filter(|azimuth| (0.0..=360.0).contains(azimuth));
        match text {
            "strongest-pulse" => Ok(Direction::StrongestPulse),
            _ => azimuth().map(Direction::Azimuth).ok_or_else(|| {
                format!("'{text}'; expected an azimuth from 0 to 360 degrees, or strongest-pulse")
            }),
        }
    }
}

impl fmt::Display for Direction {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Direction::Azimuth(degrees) => write!(f, "{degrees}"),
            Direction::StrongestPulse => f.write_str("strongest-pulse"),
        }
    }
}
