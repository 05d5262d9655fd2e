//! Every column of every file, once: name, unit, meaning.

use std::collections::HashMap;

use arrow_schema::Field;

use crate::fragility::Measure;

/// Name, unit and meaning of each column.
const COLUMNS: &[(&str, &str, &str)] = &[
    // Earthquake scenarios.
    ("scenario_id", "1", "scenario: cell x samples + sample"),
    ("cell", "1", "cell of the magnitude-distance grid"),
    ("sample", "1", "sample within the cell"),
    ("mw", "1", "moment magnitude"),
    ("re_km", "km", "distance from the rupture"),
    ("vp_m_s", "m/s", "amplitude of the velocity pulse"),
    ("tp_s", "s", "period of the velocity pulse"),
    ("gamma", "1", "number of half cycles of the pulse"),
    ("nu_rad", "rad", "phase of the pulse"),
    // Ground motions.
    ("motion_id", "1", "ground motion, unique in the file"),
    ("suite", "1", "kind of motion: pulse, csgm, hfc, record or residual"),
    ("dt_s", "s", "time between samples"),
    ("acceleration_m_s2", "m/s2", "ground acceleration, linear between samples"),
    ("pga_m_s2", "m/s2", "peak ground acceleration"),
    ("pgv_m_s", "m/s", "peak ground velocity"),
    ("pgd_m", "m", "peak ground displacement"),
    ("tm_s", "s", "mean period (Rathje et al.)"),
    ("arias_m_s", "m/s", "Arias intensity"),
    ("cav_m_s", "m/s", "cumulative absolute velocity"),
    ("d5_75_s", "s", "significant duration, 5 to 75 % of the Arias intensity"),
    ("d5_95_s", "s", "significant duration, 5 to 95 % of the Arias intensity"),
    ("housner_m", "m", "Housner intensity, 0.1 to 2.5 s at 5 % damping"),
    ("sa_*_m_s2", "m/s2", "pseudo-spectral acceleration at 5 % damping"),
    ("name", "1", "earthquake, station and component in the words of the file"),
    ("earthquake", "1", "earthquake in the words of the file"),
    ("station", "1", "station in the words of the file"),
    ("component", "1", "component in the words of the file"),
    (
        "azimuth_deg",
        "deg",
        "direction of positive acceleration, clockwise from north; null if vertical or unknown",
    ),
    ("source_file", "1", "file that the motion comes from"),
    ("source_blake3", "1", "BLAKE3 hash of that file"),
    ("scale", "1", "factor by which the record is scaled"),
    ("rotd50_pga_m_s2", "m/s2", "median over all directions of the peak acceleration of a pair"),
    ("rotd100_pga_m_s2", "m/s2", "largest over all directions of the peak acceleration of a pair"),
    ("rotd50_pgv_m_s", "m/s", "median over all directions of the peak velocity of a pair"),
    ("rotd100_pgv_m_s", "m/s", "largest over all directions of the peak velocity of a pair"),
    ("pulse_indicator", "1", "pulse indicator of Baker (2007), from 0 to 1: above 0.85 a pulse"),
    (
        "pulse_verdict",
        "1",
        "pulse, no_pulse, late (indicated, but not early) or weak (indicated, but PGV below 0.3 m/s)",
    ),
    ("pulse_wavelet_s", "s", "period of the strongest wavelet (Baker 2007)"),
    ("pulse_amplitude_m_s", "m/s", "A of the fitted pulse (Eq. 1)"),
    ("t0_s", "s", "middle of the fitted pulse, from the first sample"),
    ("pulse_r2", "1", "share of the squared velocity that the fitted pulse explains"),
    // Responses of structures, and their traces.
    ("structure", "1", "name of the structure"),
    ("p_rad_s", "rad/s", "frequency parameter p of the structure"),
    ("alpha_rad", "rad", "slenderness of the structure"),
    ("eta", "1", "coefficient of restitution"),
    ("outcome", "1", "no_rocking, safe_rocking or overturning"),
    ("edp", "1", "largest rotation over slenderness, |theta|max / alpha (Eq. 7); null where it overturns"),
    ("impacts", "1", "impacts within the duration of the record"),
    ("time_s", "s", "time from the first sample"),
    ("theta_over_alpha", "1", "rotation over slenderness"),
    ("theta_rad", "rad", "rotation"),
    ("theta_dot_rad_s", "rad/s", "angular velocity; at an impact, that after it"),
    ("ground_m_s2", "m/s2", "ground acceleration at this moment"),
    ("solver_event", "1", "uplift, impact, rest or overturn; null at a mere sample"),
    // Regressions of the demand in safe rocking.
    ("model", "1", "what predicts; of a regression univariate, plane or biplanar; of a curve its event"),
    ("im_x", "1", "first intensity measure"),
    ("im_y", "1", "second intensity measure"),
    ("range_low", "1", "im_x from which the fit holds"),
    ("range_high", "1", "im_x up to which the fit holds"),
    ("limit_state", "1", "demand |theta|max / alpha that P_ex is about"),
    ("r2", "1", "coefficient of determination"),
    ("r2_pooled", "1", "R2 of both planes together, each about the mean on its own side"),
    ("r2_overall", "1", "R2 of both planes together about the mean of all cases"),
    ("transition_found", "1", "im4 of the least pooled residual of two planes"),
    ("beta", "1", "dispersion: residual standard deviation of ln EDP, or that of the curve P_ro"),
    ("n", "1", "cases used"),
    (
        "ratio_given_pga",
        "1",
        "ln(PGV/PGA), s, of the motions given ln PGA, m/s2: intercept, slope, knot, bend, sd below and above",
    ),
    ("ratio_given_pgv", "1", "the same given ln PGV, m/s"),
    ("kind", "1", "kind of motion: recorded, csgm, pulse or hfc"),
    ("c", "1", "of logit P = c + s L, L the logit by the universal surface"),
    ("ln_s", "1", "ln of the slope s of logit P = c + s L"),
    ("tau", "1", "standard deviation of logit P between cells or earthquakes"),
    ("pga_low", "m/s2", "least PGA of the cases"),
    ("pga_high", "m/s2", "largest PGA of the cases"),
    ("pgv_low", "m/s", "least PGV of the cases"),
    ("pgv_high", "m/s", "largest PGV of the cases"),
    ("ratio_low", "s", "least PGV/PGA of the cases"),
    ("ratio_high", "s", "largest PGV/PGA of the cases"),
    ("coefficients", "1", "intercept, then the slope on ln im_x and on ln im_y; none without a fit"),
    ("covariance", "1", "covariance of the coefficients (of c and ln_s), row by row"),
    ("is_clustered", "1", "whether covariance allows for dependence within clusters"),
    ("n_clusters", "1", "clusters of the cases: earthquakes, or cells of magnitude and distance"),
    ("degrees", "1", "degrees of freedom of limits; null: normal ones"),
    ("misfit_p", "1", "probability of what squares and products of ln IM add by chance"),
    ("parameter", "1", "ln_a, b1, b2, beta, zeta; lambda, mu, beta, theta"),
    ("im_x_low", "1", "least im_x of the cases"),
    ("im_x_high", "1", "largest im_x of the cases"),
    ("im_y_low", "1", "least im_y of the cases"),
    ("im_y_high", "1", "largest im_y of the cases"),
    ("confidence", "1", "probability with which the limits hold the truth"),
    ("transition_low", "1", "lower limit of transition_found (Hansen's of a break)"),
    ("transition_high", "1", "upper limit of transition_found"),
    ("status", "1", "ok, poor_fit, wrong_sign (it falls with the measure), or why there is no fit"),
    // Curves of overturning and rocking.
    ("event", "1", "overturning, or rocking"),
    ("theta", "1", "median exp(mu)"),
    ("log_likelihood", "1", "log-likelihood at its maximum"),
    ("aic", "1", "Akaike's information criterion"),
    ("bic", "1", "Bayesian information criterion"),
    ("auc", "1", "area under the receiver operating characteristic"),
    ("brier", "1", "Brier score"),
    ("beta_low", "1", "lower limit of beta"),
    ("beta_high", "1", "upper limit of beta"),
    ("theta_low", "1", "lower limit of theta"),
    ("theta_high", "1", "upper limit of theta"),
    // Probabilities and annual rates.
    ("p_nr", "1", "probability of no rocking"),
    ("p_ex", "1", "probability of a demand above the limit state, in safe rocking (Eq. 14)"),
    ("p_ex_low", "1", "lower 95 % limit of p_ex"),
    ("p_ex_high", "1", "upper 95 % limit of p_ex"),
    ("p_ro", "1", "probability of overturning given rocking (Eq. 20; of a hybrid Eq. 24)"),
    ("p_ro_low", "1", "lower 95 % limit of p_ro"),
    ("p_ro_high", "1", "upper 95 % limit of p_ro"),
    ("p_f_r", "1", "probability of failure given rocking (Eq. 12)"),
    ("p_f_r_low", "1", "lower 95 % limit of p_f_r"),
    ("p_f_r_high", "1", "upper 95 % limit of p_f_r"),
    ("p_f", "1", "probability of failure over the whole tree; exactly 0 without rocking"),
    ("quantity", "1", "a probability, or a measure of the intensity"),
    ("value", "1", "best estimate"),
    ("low", "1", "lower 95 % limit"),
    ("high", "1", "upper 95 % limit"),
    ("meaning", "1", "in words"),
    ("years", "a", "time of exposure"),
    ("p", "1", "probability of reaching the limit state in this time"),
    ("width_m", "m", "width of the base"),
    ("height_m", "m", "height"),
    ("friction", "1", "tan(alpha): with less friction it slides in place of rocking"),
    ("warnings", "1", "what speaks against the row; of one that cannot be right, why"),
    ("rocking_per_year", "1/a", "mean annual rate of rocking"),
    ("failure_per_year", "1/a", "mean annual rate of a demand above the limit state, or overturning"),
    ("failure_per_year_low", "1/a", "lower 95 % limit of failure_per_year, or lower bound"),
    ("failure_per_year_high", "1/a", "upper 95 % limit of failure_per_year, or upper bound"),
    ("overturning_per_year", "1/a", "mean annual rate of overturning; null where the hazard ends too early"),
    ("overturning_per_year_low", "1/a", "lower 95 % limit of overturning_per_year, or lower bound"),
    ("overturning_per_year_high", "1/a", "upper 95 % limit of overturning_per_year, or upper bound"),
    ("overturning_per_year_less_velocity", "1/a", "the same with PGV/PGA one standard deviation lower"),
    ("overturning_per_year_more_velocity", "1/a", "the same with PGV/PGA one standard deviation higher"),
    ("return_period_years", "a", "1 / overturning_per_year"),
    ("p_rocking", "1", "probability of rocking in the time of exposure"),
    ("p_failure", "1", "probability of failure in the time of exposure"),
    ("p_failure_low", "1", "lower 95 % limit of p_failure"),
    ("p_failure_high", "1", "upper 95 % limit of p_failure"),
    ("p_overturning", "1", "probability of overturning in the time of exposure"),
    ("p_overturning_low", "1", "lower 95 % limit of p_overturning"),
    ("p_overturning_high", "1", "upper 95 % limit of p_overturning"),
    ("counted_motions", "1", "motions that were counted"),
    (
        "counted_per_year",
        "1/a",
        "mean annual rate of overturning, counted among motions weighted to the hazard",
    ),
    ("counted_per_year_low", "1/a", "lower 95 % limit of counted_per_year"),
    ("counted_per_year_high", "1/a", "upper 95 % limit of counted_per_year"),
    // Forecasts beside what happened.
    ("observed", "1", "cases in which the event happened"),
    ("predicted", "1", "mean probability of the event"),
    ("expected_error", "1", "standard error of observed - expected, by clusters"),
    (
        "calibration_intercept",
        "1",
        "intercept of the probit of the events on Phi^-1 of their probability; 0 is best",
    ),
    ("calibration_slope", "1", "slope of the same; 1 is best, below 1 the probabilities are too sure"),
    ("expected", "1", "events expected: the sum of the probabilities"),
    ("share", "1", "observed over n"),
    ("share_low", "1", "lower 95 % limit of share (Wilson)"),
    ("share_high", "1", "upper 95 % limit of share (Wilson)"),
    (
        "log_score",
        "1",
        "mean logarithm of the probability of what happened; null where a probability of 0 happened",
    ),
    ("terms", "1", "measures in the set"),
    ("standard_error", "1", "standard error of value; cases of a cluster may depend on each other"),
    // Incremental dynamic analysis.
    (
        "measure",
        "1",
        "what intensity is: scale (of the motion as it is), pga (in g), pgv (in m/s), im4, im5 or im6",
    ),
    ("intensity", "1", "the measure of the scaled motion"),
    ("unscaled", "1", "the measure of the motion as it is"),
    (
        "overturning_above",
        "1",
        "share of the intensities from this level to the next, in logarithms, that overturn the structure; null: the last level",
    ),
    (
        "capacity",
        "1",
        "overturns (within the scan), safe (throughout), or below (overturns already at its foot)",
    ),
    (
        "safe_below",
        "1",
        "largest simulated intensity below all that overturn the structure; null: none in the scan",
    ),
    (
        "overturning_intensity",
        "1",
        "least simulated intensity that overturns the structure; null: none in the scan",
    ),
    ("safe_up_to", "1", "largest simulated intensity that it survives; null: none in the scan"),
    ("n_safe", "1", "motions that overturn the structure nowhere in the scan"),
    ("n_below", "1", "motions that overturn it already at its foot"),
    // Rankings of intensity measures.
    ("target", "1", "what is predicted: p_ex (ln EDP in safe rocking), or p_ro (overturning given rocking)"),
    (
        "measures",
        "1",
        "intensity measures, joined by ':'; each enters to a power of its own; none: a constant",
    ),
    ("form", "1", "single, or biplanar: two that meet at the transition"),
    ("loss", "1", "log_score less that of the best set"),
    ("loss_error", "1", "standard error of loss, between clusters"),
    ("rank", "1", "place among the models of as many measures by log_score, from 1"),
    ("n_events", "1", "cases in which the event happened"),
    // Published numbers beside ours.
    ("place", "1", "where the paper prints it"),
    ("published", "1", "the published number"),
    (
        "ours",
        "1",
        "the same number from these files; of a rms, the published plane less ours in ln EDP (over beta) at our cases",
    ),
    ("mean", "1", "mean of ours over seeds"),
    ("sd", "1", "standard deviation of ours over seeds"),
    ("seeds", "1", "number of seeds of the spread"),
    (
        "z",
        "1",
        "(published - mean) / standard deviation; null where the mean lies within the rounding of the print, and that is more than two of these",
    ),
    (
        "t2",
        "1",
        "Hotelling's T2 of the published ln a, b1, b2 and R2 of a plane about ours over seeds, which depend on each other",
    ),
    ("t2_p", "1", "probability of a t2 as large, if the published plane is one more of ours"),
];

/// Returns the names of all columns.
pub fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(name, ..)| *name)
}

/// Unit and meaning of a column; none where the dictionary lacks it.
pub fn entry(column: &str) -> Option<(&'static str, &'static str)> {
    if let Ok(measure) = column.parse::<Measure>() {
        return Some(("1", measure.formula()));
    }
    let is_spectral = column.starts_with("sa_") && column.ends_with("_m_s2");
    let name = if is_spectral { "sa_*_m_s2" } else { column };
    COLUMNS.iter().find(|(other, ..)| *other == name).map(|&(_, unit, meaning)| (unit, meaning))
}

/// The meaning of a column, for messages.
pub fn meaning(column: &str) -> String {
    match entry(column) {
        Some(("1", meaning)) => meaning.to_string(),
        Some((unit, meaning)) => format!("{meaning} ({unit})"),
        None => "it".to_string(),
    }
}

/// The field with its unit and meaning.
pub fn with_meaning(field: Field) -> Field {
    let Some((unit, meaning)) = entry(field.name()) else { return field };
    let pairs = [("unit", unit), ("description", meaning)];
    field.with_metadata(HashMap::from(pairs.map(|(key, value)| (key.to_string(), value.to_string()))))
}
