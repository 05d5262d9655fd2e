//! Every column of every file, once: name, type, unit, meaning. A table takes columns from here by the names of its fields.

use super::column::{Column, Kind, columns};

// Earthquake scenarios.
columns! {
    scenario_id: Int64, "1", "scenario: cell x samples + sample";
    cell: Int32, "1", "cell of the magnitude-distance grid";
    sample: Int32, "1", "sample within the cell";
    mw: Float64, "1", "moment magnitude";
    re_km: Float64, "km", "distance from the rupture";
    vp_m_s: Float64, "m/s", "amplitude of the velocity pulse";
    pulse_tp_s = "tp_s": Float64, "s", "period of the velocity pulse";
    gamma: Float64, "1", "number of half cycles of the pulse";
    nu_rad: Float64, "rad", "phase of the pulse";
}

// Ground motions.
columns! {
    motion_id: Int64, "1", "ground motion, unique in the file";
    suite: Text, "1", "kind of motion: pulse, csgm, hfc, record or residual";
    dt_s: Float64, "s", "time between samples";
    acceleration_m_s2: Samples, "m/s2", "ground acceleration, linear between samples";
    pga_m_s2: Float64, "m/s2", "peak ground acceleration";
    pgv_m_s: Float64, "m/s", "peak ground velocity";
    pgd_m: Float64, "m", "peak ground displacement";
    tm_s: Float64, "s", "mean period (Rathje et al.)";
    tp_s: Float64, "s", "predominant period: that of the pulse";
    arias_m_s: Float64, "m/s", "Arias intensity";
    cav_m_s: Float64, "m/s", "cumulative absolute velocity";
    d5_75_s: Float64, "s", "significant duration, 5 to 75 % of the Arias intensity";
    d5_95_s: Float64, "s", "significant duration, 5 to 95 % of the Arias intensity";
    housner_m: Float64, "m", "Housner intensity, 0.1 to 2.5 s at 5 % damping";
    spectral_acceleration = "sa_*_m_s2": Float64, "m/s2", "pseudo-spectral acceleration at 5 % damping";
    motion_name = "motion_id": Text, "1", "ground motion, unique in the file: the name of its file";
    name: Text, "1", "earthquake, station and component in the words of the file";
    earthquake: Text, "1", "earthquake in the words of the file";
    station: Text, "1", "station in the words of the file";
    component: Text, "1", "component in the words of the file";
    azimuth_deg: Float64, "deg", "direction of positive acceleration, clockwise from north; null if vertical or unknown";
    source_file: Text, "1", "file that the motion comes from";
    source_blake3: Text, "1", "BLAKE3 hash of that file";
    scale: Float64, "1", "factor by which the record is scaled";
    rotd50_pga_m_s2: Float64, "m/s2", "median over all directions of the peak acceleration of a pair";
    rotd100_pga_m_s2: Float64, "m/s2", "largest over all directions of the peak acceleration of a pair";
    rotd50_pgv_m_s: Float64, "m/s", "median over all directions of the peak velocity of a pair";
    rotd100_pgv_m_s: Float64, "m/s", "largest over all directions of the peak velocity of a pair";
    pulse_indicator: Float64, "1", "pulse indicator of Baker (2007), from 0 to 1: above 0.85 a pulse";
    pulse_verdict: Text, "1", "pulse, no_pulse, late (indicated, but not early) or weak (indicated, but PGV below 0.3 m/s)";
    pulse_wavelet_s: Float64, "s", "period of the strongest wavelet (Baker 2007)";
    pulse_amplitude_m_s: Float64, "m/s", "A of the fitted pulse (Eq. 1)";
    t0_s: Float64, "s", "middle of the fitted pulse, from the first sample";
    pulse_r2: Float64, "1", "share of the squared velocity that the fitted pulse explains";
}

// Responses of structures, and their traces.
columns! {
    structure: Text, "1", "name of the structure";
    p_rad_s: Float64, "rad/s", "frequency parameter p of the structure";
    alpha_rad: Float64, "rad", "slenderness of the structure";
    eta: Float64, "1", "coefficient of restitution";
    outcome: Text, "1", "no_rocking, safe_rocking or overturning";
    edp: Float64, "1", "largest rotation over slenderness, |theta|max / alpha (Eq. 7); null where it overturns";
    impacts: Int32, "1", "impacts within the duration of the record";
    im1: Float64, "1", "wp / p (Eq. 13)";
    im2: Float64, "1", "wm / p (Eq. 13)";
    im3: Float64, "1", "PGA / (p PGV) (Eq. 13)";
    im4: Float64, "1", "PGA / (g tan alpha) (Eq. 13)";
    im5: Float64, "1", "p PGV / (g tan alpha) (Eq. 13)";
    im6: Float64, "1", "wm PGV / (g tan alpha) (Eq. 13)";
    time_s: Float64, "s", "time from the first sample";
    theta_rad: Float64, "rad", "rotation";
    theta_dot_rad_s: Float64, "rad/s", "angular velocity; at an impact, that after it";
    theta_over_alpha: Float64, "1", "rotation over slenderness";
    ground_m_s2: Float64, "m/s2", "ground acceleration at this moment";
    solver_event: Text, "1", "uplift, impact, rest or overturn; null at a mere sample";
}

// Regressions of the demand in safe rocking.
columns! {
    model: Text, "1", "univariate, plane, biplanar, or smooth (two planes that pass into one another)";
    im_x: Text, "1", "first intensity measure";
    im_y: Text, "1", "second intensity measure";
    range_low: Float64, "1", "im_x from which the fit holds";
    range_high: Float64, "1", "im_x up to which the fit holds";
    limit_state: Float64, "1", "demand |theta|max / alpha that P_ex is about";
    ln_a: Float64, "1", "intercept of ln EDP (Eqs. 15 and 17)";
    b1: Float64, "1", "slope on ln im_x";
    b2: Float64, "1", "slope on ln im_y";
    r2: Float64, "1", "coefficient of determination";
    r2_pooled: Float64, "1", "R2 of both planes together, each about the mean on its own side";
    r2_overall: Float64, "1", "R2 of both planes together about the mean of all cases";
    transition_found: Float64, "1", "im4 of the least pooled residual of two planes; of smooth, where both count the same";
    beta: Float64, "1", "dispersion: residual standard deviation of ln EDP, or that of the curve P_ro";
    zeta: Float64, "1", "modified dispersion beta / b1";
    n: Int64, "1", "cases used";
    se_ln_a: Float64, "1", "standard error of ln_a";
    se_b1: Float64, "1", "standard error of b1";
    se_b2: Float64, "1", "standard error of b2";
    ln_a_low: Float64, "1", "lower limit of ln_a";
    ln_a_high: Float64, "1", "upper limit of ln_a";
    b1_low: Float64, "1", "lower limit of b1";
    b1_high: Float64, "1", "upper limit of b1";
    b2_low: Float64, "1", "lower limit of b2";
    b2_high: Float64, "1", "upper limit of b2";
    cov_ln_a_b1: Float64, "1", "covariance of ln_a and b1";
    cov_ln_a_b2: Float64, "1", "covariance of ln_a and b2";
    cov_b1_b2: Float64, "1", "covariance of b1 and b2";
    ratio_given_pga: Numbers, "1", "ln(PGV / PGA), s, of the motions of the cases given ln PGA, m/s2: three knots, the coefficients of 1, ln PGA and its natural spline, and the standard deviation";
    ratio_given_pgv: Numbers, "1", "the same given ln PGV, m/s";
    clustered_covariance: Numbers, "1", "covariance of the coefficients, row by row, robust to dependence within a cell or earthquake";
    cell_spread: Float64, "1", "standard deviation of the index between cells or earthquakes, none of which the fit has seen";
    fitted_p_rad_s = "p_rad_s": Float64, "rad/s", "frequency parameter p of the structure, if all cases share it";
    fitted_alpha_rad = "alpha_rad": Float64, "rad", "slenderness of the structure, if all cases share it";
    im_x_low: Float64, "1", "least im_x of the cases";
    im_x_high: Float64, "1", "largest im_x of the cases";
    im_y_low: Float64, "1", "least im_y of the cases";
    im_y_high: Float64, "1", "largest im_y of the cases";
    se_ln_a_clustered: Float64, "1", "standard error of ln_a, robust to dependence within a cell or earthquake";
    se_b1_clustered: Float64, "1", "standard error of b1, robust to dependence within a cell or earthquake";
    se_b2_clustered: Float64, "1", "standard error of b2, robust to dependence within a cell or earthquake";
    confidence: Float64, "1", "probability with which the limits hold the truth";
    replicates: Int64, "1", "bootstrap replicates that have a fit";
    ln_a_percentile_low: Float64, "1", "lower percentile limit of ln_a";
    ln_a_percentile_high: Float64, "1", "upper percentile limit of ln_a";
    ln_a_bca_low: Float64, "1", "lower BCa limit of ln_a";
    ln_a_bca_high: Float64, "1", "upper BCa limit of ln_a";
    b1_percentile_low: Float64, "1", "lower percentile limit of b1";
    b1_percentile_high: Float64, "1", "upper percentile limit of b1";
    b1_bca_low: Float64, "1", "lower BCa limit of b1";
    b1_bca_high: Float64, "1", "upper BCa limit of b1";
    b2_percentile_low: Float64, "1", "lower percentile limit of b2";
    b2_percentile_high: Float64, "1", "upper percentile limit of b2";
    b2_bca_low: Float64, "1", "lower BCa limit of b2";
    b2_bca_high: Float64, "1", "upper BCa limit of b2";
    beta_percentile_low: Float64, "1", "lower percentile limit of beta";
    beta_percentile_high: Float64, "1", "upper percentile limit of beta";
    beta_bca_low: Float64, "1", "lower BCa limit of beta";
    beta_bca_high: Float64, "1", "upper BCa limit of beta";
    transition_low: Float64, "1", "lower limit of transition_found: Hansen's of a break, linearised of a smooth one";
    transition_high: Float64, "1", "upper limit of transition_found, likewise";
    transition_width: Float64, "1", "width d of a smooth transition: the share of the upper plane is 1 - im4^(-1/d)";
    se_transition_width: Float64, "1", "standard error of transition_width";
    reset: Float64, "1", "Ramsey's F: whether squares and cubes of the fitted values are missing";
    reset_p: Float64, "1", "probability of as large a reset if the regression holds";
    transition_percentile_low: Float64, "1", "lower percentile limit of transition_found";
    transition_percentile_high: Float64, "1", "upper percentile limit of transition_found";
    replicate: Int64, "1", "resample: the same in all fits of the same responses and seed";
    status: Text, "1", "ok, falling (with the measure), or why there is no fit";
    transition: Float64, "1", "im4 at which the two planes meet";
    pooled_rss: Float64, "1", "residual sum of squares of both planes";
    n_low: Int64, "1", "cases below the transition";
    n_high: Int64, "1", "cases above the transition";
}

// Curves of overturning and rocking.
columns! {
    fitted_event = "event": Text, "1", "overturning, or rocking";
    lambda: Float64, "1", "exponent of im_x in the hybrid measure (Eq. 23)";
    mu: Float64, "1", "logarithm of the median of the measure at overturning (its mean, for the probit)";
    theta: Float64, "1", "median exp(mu)";
    log_likelihood: Float64, "1", "log-likelihood at its maximum";
    aic: Float64, "1", "Akaike's information criterion";
    bic: Float64, "1", "Bayesian information criterion";
    auc: Float64, "1", "area under the receiver operating characteristic";
    brier: Float64, "1", "Brier score";
    se_lambda: Float64, "1", "standard error of lambda";
    se_mu: Float64, "1", "standard error of mu";
    se_beta: Float64, "1", "standard error of beta";
    se_theta: Float64, "1", "standard error of theta";
    lambda_low: Float64, "1", "lower limit of lambda";
    lambda_high: Float64, "1", "upper limit of lambda";
    mu_low: Float64, "1", "lower limit of mu";
    mu_high: Float64, "1", "upper limit of mu";
    beta_low: Float64, "1", "lower limit of beta";
    beta_high: Float64, "1", "upper limit of beta";
    theta_low: Float64, "1", "lower limit of theta";
    theta_high: Float64, "1", "upper limit of theta";
    estimator: Text, "1", "ml (maximum likelihood), or firth (penalised)";
    se_lambda_clustered: Float64, "1", "standard error of lambda, robust to dependence within a cell or earthquake";
    se_mu_clustered: Float64, "1", "standard error of mu, robust to dependence within a cell or earthquake";
    se_beta_clustered: Float64, "1", "standard error of beta, robust to dependence within a cell or earthquake";
    lambda_profile_low: Float64, "1", "lower profile-likelihood limit of lambda; null: none";
    lambda_profile_high: Float64, "1", "upper profile-likelihood limit of lambda; null: none";
    mu_profile_low: Float64, "1", "lower profile-likelihood limit of mu; null: none";
    mu_profile_high: Float64, "1", "upper profile-likelihood limit of mu; null: none";
    beta_profile_low: Float64, "1", "lower profile-likelihood limit of beta; null: none";
    beta_profile_high: Float64, "1", "upper profile-likelihood limit of beta; null: none";
    hosmer_lemeshow: Float64, "1", "Hosmer-Lemeshow chi squared of ten groups";
    hosmer_lemeshow_p: Float64, "1", "probability of as large a hosmer_lemeshow if the curve holds";
    spline_p: Float64, "1", "likelihood-ratio test against a natural spline of ln im_x: probability if none is needed";
    interaction_p: Float64, "1", "likelihood-ratio test against a term ln im_x ln im_y (or ln im_x squared)";
    gap_straight: Float64, "1", "probability by the curve, and gap_bent by the one that bends, in the case at which 5 % of the cases differ by more";
    gap_bent: Float64, "1", "probability by the curve that bends in the same case";
    held_out_log_score: Float64, "1", "mean log-likelihood of the cases of cells or earthquakes that were left out";
    bent: Numbers, "1", "the curve that bends and answers where tests reject this one: coefficients of 1, ln im_x, ln im_y, the natural spline of each, and their product";
    bent_knots: Numbers, "1", "its knots: three of ln im_x and three of ln im_y";
    bent_covariance: Numbers, "1", "the covariance of its coefficients, row by row, robust as clustered_covariance";
    bent_cell_spread: Float64, "1", "cell_spread of the curve that bends";
    bent_held_out_log_score: Float64, "1", "held_out_log_score of the curve that bends";
    link: Text, "1", "probit, logit or cloglog: the probability is F(b0 + b1 ln im_x + b2 ln im_y)";
    b0: Float64, "1", "intercept of the index";
    index_b1 = "b1": Float64, "1", "slope of the index on ln im_x";
    index_b2 = "b2": Float64, "1", "slope of the index on ln im_y";
    se_b0: Float64, "1", "standard error of b0";
    cov_b0_b1: Float64, "1", "covariance of b0 and b1";
    cov_b0_b2: Float64, "1", "covariance of b0 and b2";
    lambda_percentile_low: Float64, "1", "lower percentile limit of lambda";
    lambda_percentile_high: Float64, "1", "upper percentile limit of lambda";
    lambda_bca_low: Float64, "1", "lower BCa limit of lambda";
    lambda_bca_high: Float64, "1", "upper BCa limit of lambda";
    mu_percentile_low: Float64, "1", "lower percentile limit of mu (and, as its logarithm, of theta)";
    mu_percentile_high: Float64, "1", "upper percentile limit of mu (and, as its logarithm, of theta)";
    mu_bca_low: Float64, "1", "lower BCa limit of mu (and, as its logarithm, of theta)";
    mu_bca_high: Float64, "1", "upper BCa limit of mu (and, as its logarithm, of theta)";
}

// Probabilities and annual rates.
columns! {
    p_nr: Float64, "1", "probability of no rocking";
    p_ex: Float64, "1", "probability of a demand above the limit state, in safe rocking (Eq. 14)";
    p_ex_low: Float64, "1", "lower 95 % limit of p_ex";
    p_ex_high: Float64, "1", "upper 95 % limit of p_ex";
    p_ro: Float64, "1", "probability of overturning given rocking (Eq. 20; of a hybrid Eq. 24)";
    p_ro_low: Float64, "1", "lower 95 % limit of p_ro";
    p_ro_high: Float64, "1", "upper 95 % limit of p_ro";
    p_f_r: Float64, "1", "probability of failure given rocking (Eq. 12)";
    p_f_r_low: Float64, "1", "lower 95 % limit of p_f_r";
    p_f_r_high: Float64, "1", "upper 95 % limit of p_f_r";
    p_f: Float64, "1", "probability of failure over the whole tree; exactly 0 without rocking";
    out_of_range: Text, "1", "a measure outside of the range of the data of the fits";
    distance: Float64, "1", "how far the question is from the middle of the data (0) to their rim (1) and beyond, in the coordinate in which it is farthest";
    p_ro_universal: Float64, "1", "p_ro by the universal surface; null where it answers itself";
    im_hybrid: Float64, "1", "hybrid measure of P_ro: im_x^(lambda/(1 + lambda)) im_y^(1/(1 + lambda)) (Eq. 23)";
    asked = "quantity": Text, "1", "a probability, or a measure of the intensity";
    value: Float64, "1", "best estimate";
    low: Float64, "1", "lower 95 % limit";
    high: Float64, "1", "upper 95 % limit";
    meaning: Text, "1", "in words";
    state: Text, "1", "limit state";
    annual_rate: Float64, "1/a", "mean annual rate of reaching the limit state";
    annual_rate_low: Float64, "1/a", "that of the lower 95 % limits of the probabilities";
    annual_rate_high: Float64, "1/a", "that of the upper 95 % limits of the probabilities";
    years: Float64, "a", "time of exposure";
    p: Float64, "1", "probability of reaching the limit state in this time";
    p_low: Float64, "1", "that of annual_rate_low";
    p_high: Float64, "1", "that of annual_rate_high";
}

// Forecasts beside what happened.
columns! {
    fits_suite: Text, "1", "suite of motions that the curves were fitted to";
    predicted = "event": Text, "1", "overturning given rocking (P_ro), exceeding the limit state given safe rocking (P_ex), or failure given rocking, the one or the other (Eq. 12)";
    n_predicted = "n": Int64, "1", "cases with a forecast: those that rock, or rock safely";
    seen: Int64, "1", "cases in which the event happened";
    expected: Float64, "1", "the same as predicted: the sum of the probabilities";
    expected_low: Float64, "1", "sum of the lower 95 % limits of the probabilities: the error of the fits";
    expected_high: Float64, "1", "sum of the upper 95 % limits of the probabilities";
    chance_low: Int64, "1", "lower 95 % limit of the count if the probabilities are right and the cases independent (Poisson-binomial)";
    chance_high: Int64, "1", "upper 95 % limit of the count, likewise";
    chance_p: Float64, "1", "probability of a count as far out as the seen one, in either tail, likewise";
    share: Float64, "1", "seen over n";
    share_low: Float64, "1", "lower 95 % limit of share (Wilson)";
    share_high: Float64, "1", "upper 95 % limit of share (Wilson)";
    log_score: Float64, "1", "mean logarithm of the probability of what happened; null (minus infinity) if there are impossible cases";
    impossible: Int64, "1", "cases in which happened what has a probability of exactly 0 in double precision";
    log_score_expected: Float64, "1", "what log_score would be in the mean if the probabilities are right";
    calibration: Float64, "1", "calibration in the large: by how much all log odds must rise for the expected count to be the seen one; null where no event, or nothing else, was seen";
    extrapolated: Int64, "1", "cases with a measure outside of the range of the data of the fit (of failure, of either)";
    without_measure: Int64, "1", "cases without a forecast, for want of a measure";
    counted_rate: Float64, "1/a", "annual rate of the event, counted in the motions that are weighted to have the rates of the hazard; null without a hazard";
    counted_rate_low: Float64, "1/a", "lower 95 % limit of counted_rate";
    counted_rate_high: Float64, "1/a", "upper 95 % limit of counted_rate";
    expected_rate: Float64, "1/a", "the same rate by the probabilities of the curves at the same motions; null without a hazard";
}

// The curve of one structure on others.
columns! {
    reference: Text, "1", "structure whose curve is transferred";
    transferred_slope = "calibration_slope": Float64, "1", "slope of the recalibration in log odds: below 1 where the transferred curve is too sure";
    log_score_own: Float64, "1", "mean logarithm of the probability of what happened by the structure's own curve, in cells that it was not fitted to";
    log_score_transferred: Float64, "1", "the same by the transferred curve, fitted without those cells";
    loss: Float64, "1", "log_score_own less log_score_transferred";
    se_loss: Float64, "1", "standard error of loss; cases of a cell may depend on each other";
    log_score_share: Float64, "1", "log score of the share of events, the same in all cases";
    share_lost: Float64, "1", "loss over log_score_own less log_score_share: how much of what the own curve tells is lost";
    mean_error: Float64, "1", "mean absolute difference of the transferred and the own probability over the cases";
    worst_over: Float64, "1", "the most by which the transferred probability exceeds the own one, over the cases";
    worst_under: Float64, "1", "the most by which it falls short";
    log_score_line: Float64, "1", "log score by one curve of other structures: lognormal";
    log_score_curved: Float64, "1", "the same with squares and products of the logarithms of the measures";
    log_score_restitution: Float64, "1", "the same with eta besides";
    log_score_structure: Float64, "1", "the same with ln p and ln alpha besides";
    verdict: Text, "1", "the transferred curve holds (share_lost below 0.1), bends (below 0.5) or fails; too_few_events for an own curve";
    pooled_terms = "terms": Text, "1", "line, curved, restitution or structure: what the pooled curve consists of";
    term: Text, "1", "what the coefficient multiplies; eta, ln p and ln alpha as differences from the reference";
    coefficient: Float64, "1", "of the probit index of overturning, or of ln EDP in safe rocking";
    standard_error: Float64, "1", "standard error of coefficient; cases of a structure may depend on each other";
}

// Incremental dynamic analysis.
columns! {
    measure: Text, "1", "what intensity is: scale (of the motion as it is), pga (in g), pgv (in m/s), im4, im5 or im6";
    intensity: Float64, "1", "the measure of the scaled motion";
    unscaled: Float64, "1", "the measure of the motion as it is";
    overturning_above: Float64, "1", "share of the intensities from this level to the next, in logarithms, that overturn the structure; null: the last level";
    capacity: Text, "1", "overturns (within the scan), safe (throughout), or below (overturns already at its foot)";
    safe_below: Float64, "1", "largest simulated intensity below all that overturn the structure; null: none in the scan";
    overturning_intensity: Float64, "1", "least simulated intensity that overturns the structure; null: none in the scan";
    safe_windows: Int64, "1", "ranges of larger intensities, as wide as the resolution, of which it survives all that were simulated";
    safe_up_to: Float64, "1", "largest simulated intensity that it survives; null: none in the scan";
    window: Int64, "1", "number of the window (a range of simulated intensities that are all safe), rising with the intensity";
    window_low: Float64, "1", "least intensity of the window";
    window_high: Float64, "1", "largest intensity of the window; null: the scan ends within it";
    overturned: Int64, "1", "motions that overturn the structure at this intensity";
    overturned_up_to: Int64, "1", "motions that do so at this intensity or a lower one";
    lognormal: Float64, "1", "probability of the same by the lognormal distribution of the overturning intensities; null: none";
    capacity_theta = "theta": Float64, "1", "median of the lowest intensities that overturn the structure, in the unit of measure";
    capacity_theta_low = "theta_low": Float64, "1", "lower 95 % limit of theta";
    capacity_theta_high = "theta_high": Float64, "1", "upper 95 % limit of theta";
    capacity_beta = "beta": Float64, "1", "standard deviation of the logarithms of these intensities";
    capacity_beta_low = "beta_low": Float64, "1", "lower 95 % limit of beta";
    capacity_beta_high = "beta_high": Float64, "1", "upper 95 % limit of beta";
    n_safe: Int64, "1", "motions that overturn the structure nowhere in the scan";
    n_below: Int64, "1", "motions that overturn it already at its foot";
    n_with_windows: Int64, "1", "motions with a safe window";
}

// Rankings of intensity measures.
columns! {
    target: Text, "1", "what is predicted: p_ex (ln EDP in safe rocking), or p_ro (overturning given rocking)";
    measures: Text, "1", "intensity measures, joined by ':'; each enters to a power of its own; none: a constant";
    terms: Int64, "1", "how many measures";
    form: Text, "1", "single: one power law; broken: one on each side of a break in im4";
    choice: Text, "1", "why to look at it: paper (the model of the paper), scalar of paper (the best of its six alone), best (of as many measures), step N (of forward selection)";
    rank: Int64, "1", "place among the models of as many measures by log_score, from 1";
    same_as: Text, "1", "measures before it that make the same model: products of powers of one another";
    rank_log_score = "log_score": Float64, "1", "mean ln probability (of p_ex: density of ln EDP) of what happened in clusters left out of the fit; null where a fit without some of them does not exist";
    over_paper: Float64, "1", "log_score over that of the model of the paper";
    se_over_paper: Float64, "1", "standard error of over_paper, paired over clusters";
    over_best: Float64, "1", "log_score over that of the best of as many measures, not above 0";
    se_over_best: Float64, "1", "standard error of over_best, paired over clusters";
    step: Int64, "1", "step of forward selection that arrives here; 0: no measure";
    over_step: Float64, "1", "log_score over that of the step before";
    se_over_step: Float64, "1", "standard error of over_step, paired over clusters";
    event_log_score: Float64, "1", "mean ln probability of whether the event (overturning, or a demand above the limit state) happened, in clusters left out of the fit";
    auc_unseen: Float64, "1", "area under the receiver operating characteristic of the event, in clusters left out of the fit; null without a measure";
    brier_unseen: Float64, "1", "Brier score of the event, in clusters left out of the fit";
    calibration_intercept: Float64, "1", "intercept of the events regressed by a probit on the index predicted for clusters left out; 0 is best";
    calibration_slope: Float64, "1", "slope of it; 1 is best, less: the forecasts are too sure";
    rank_b0 = "b0": Float64, "1", "intercept (of the probit index, or of ln EDP); null for a broken form";
    rank_b1 = "b1": Float64, "1", "power of the first measure; null for a broken form";
    rank_b2 = "b2": Float64, "1", "power of the second measure";
    rank_b3 = "b3": Float64, "1", "power of the third measure";
    n_events: Int64, "1", "cases in which the event happened";
    clustered_by: Text, "1", "what the cases of a cluster share: cell (magnitude and distance), earthquake or nothing";
    group: Int64, "1", "tenth of the cases, from the least probability";
    forecast: Float64, "1", "mean probability of the event predicted for clusters left out of the fit";
}

// Published numbers beside ours.
columns! {
    quantity: Text, "1", "what was published";
    place: Text, "1", "where the paper prints it";
    published: Float64, "1", "the published number";
    ours: Float64, "1", "the same number from these files; of a rms, the published plane less ours in ln EDP (over beta) at our cases";
    spread_mean: Float64, "1", "mean of ours over seeds";
    spread_sd: Float64, "1", "standard deviation of ours over seeds";
    seeds: Int32, "1", "number of seeds of the spread";
    z: Float64, "1", "(published - mean) / standard deviation; null where the mean lies within the rounding of the print, and that is more than two of these";
    seed_rms: Float64, "1", "what ours is between the planes of two of our seeds, root of the mean square";
    t2: Float64, "1", "Hotelling's T2 of the published ln a, b1, b2 and R2 of a plane about ours over seeds, which depend on each other";
    t2_p: Float64, "1", "probability of a t2 as large, if the published plane is one more of ours";
}
