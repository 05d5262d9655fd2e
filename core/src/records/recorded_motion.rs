use crate::units::Unit;

/// Where a record is from, as named in its file.
#[derive(Debug, Clone, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Origin {
    pub earthquake: Option<String>,
    pub mw: Option<f64>,
    /// Distance from the rupture, km.
    pub re_km: Option<f64>,
    pub station: Option<String>,
    pub component: Option<String>,
    /// Direction of positive acceleration, degrees clockwise from north; `None` for a vertical component.
    pub azimuth_deg: Option<f64>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct RecordedMotion {
    pub dt_s: f64,
    pub acceleration_m_s2: Vec<f64>,
    pub origin: Origin,
    /// Whether the instrument is in a borehole: no object stands there.
    pub is_in_borehole: bool,
    pub header_pga: Option<HeaderPga>,
    pub format: &'static str,
    /// Unit of the samples in the file.
    pub unit: Unit,
}

impl RecordedMotion {
    pub fn new(dt_s: f64, samples: Vec<f64>, unit: Unit, origin: Origin) -> RecordedMotion {
        RecordedMotion {
            dt_s,
            acceleration_m_s2: samples.into_iter().map(|value| value * unit.si).collect(),
            origin,
            is_in_borehole: false,
            header_pga: None,
            format: "",
            unit,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeaderPga {
    /// Absolute value, m/s2.
    pub m_s2: f64,
    /// Half a unit of its last digit, m/s2.
    pub rounding_m_s2: f64,
}
