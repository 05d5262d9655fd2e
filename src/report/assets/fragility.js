// The tree of Eq. 12 from the fitted coefficients: the same formulas as `rockfrag evaluate`.
const fragility = (() => {
  const Z_95 = 1.959963984540054;

  /** p (rad/s) and alpha (rad) of a solid rectangular block of this width and height (m). */
  const block = (g, width, height) => ({
    p: Math.sqrt((3 * g) / (4 * 0.5 * Math.hypot(width, height))),
    alpha: Math.atan(width / height),
  });

  /** The measures of Eq. 13, of a PGA in m/s2; null where a period, or the motion, is missing. */
  const measures = (g, { p, alpha, pga, pgv, tp, tm }) => {
    const uplift = g * Math.tan(alpha);
    const circular = (period) => (period > 0 ? (2 * Math.PI) / period : null);
    const [wp, wm] = [circular(tp), circular(tm)];
    const im3 = pgv > 0 ? pga / (p * pgv) : null;
    return {
      im1: wp === null ? null : wp / p,
      im2: wm === null ? null : wm / p,
      im3,
      im4: pga / uplift,
      im5: (p * pgv) / uplift,
      im6: wm === null ? null : (wm * pgv) / uplift,
      im3_inv: im3 === null ? null : 1 / im3,
    };
  };

  const usable = (value) => (value !== null && Number.isFinite(value) && value > 0 ? value : null);

  /** The cubic functions that let a line in one value bend, none of fewer than three knots: restricted_splines in Rust. */
  const bends = (u, knots) => {
    if (knots.length < 3) return [];
    const [first, before, last] = [knots[0], knots[knots.length - 2], knots[knots.length - 1]];
    const cube = (knot) => Math.max(u - knot, 0) ** 3;
    const width = (last - first) * (last - first);
    return knots.slice(0, -2).map((knot) => {
      const [a, b] = [(last - knot) / (last - before), (before - knot) / (last - before)];
      return (cube(knot) - a * cube(before) + b * cube(last)) / width;
    });
  };

  /** b0 + b1 ln IMx + b2 ln IMy, the bend if there is one, and its variance; null where a measure is missing. */
  const predict = ({ x, y, b, covariance, knots }, of) => {
    const [imX, imY] = [usable(of[x]), y === null ? 1 : usable(of[y])];
    if (imX === null || imY === null) return null;
    const [lnX, lnY] = [Math.log(imX), Math.log(imY)];
    const bend = knots === null ? [] : y === null ? [...bends(lnX, knots[0]), 0, 0] : [...bends(lnX, knots[0]), ...bends(lnY, knots[1]), lnX * lnY];
    const row = [1, lnX, lnY, ...bend];
    const dot = (a) => a.reduce((sum, value, k) => sum + value * row[k], 0);
    return { value: dot(b), variance: dot(covariance.map(dot)) };
  };

  const lawAt = (demand, of) => demand.all ?? (of.im4 < demand.transition ? demand.low : demand.high);

  /** The index of P_ex (Eq. 14) and its standard error. */
  const exceeding = ({ median, beta, degrees }, of, limit) => {
    const predicted = predict(median, of);
    if (predicted === null) return null;
    const value = (predicted.value - Math.log(limit)) / beta;
    return { value, error: Math.sqrt(predicted.variance / (beta * beta) + (value * value) / (2 * degrees)) };
  };

  const probability = ({ value, error }) => ({
    value: normal.cdf(value),
    low: normal.cdf(value - Z_95 * error),
    high: normal.cdf(value + Z_95 * error),
  });

  const lnSurvival = (p) => Math.max(Math.log1p(-p), Math.log(2.2250738585072014e-308));

  /** Failure given rocking, P_ro + (1 - P_ro) P_ex, with limits by the recovery of variances, as in the program. */
  const failure = (pRo, pEx) => {
    const [ro, ex] = [pRo, pEx].map((p) => ({ value: lnSurvival(p.value), low: lnSurvival(p.low), high: lnSurvival(p.high) }));
    const further = (limit) => Math.hypot(ro[limit] - ro.value, ex[limit] - ex.value);
    const value = pRo.value + (1 - pRo.value) * pEx.value;
    const low = -Math.expm1(ro.value + ex.value + further("low"));
    const high = -Math.expm1(ro.value + ex.value - further("high"));
    return { value, low: Math.min(Math.max(low, pRo.low, pEx.low), value), high: Math.max(high, pRo.high, pEx.high, value) };
  };

  const exact = (value) => ({ value, low: value, high: value });

  /** P_nr, P_ex, P_ro, P_f|r and P_f with their limits; null where they do not exist or a measure is missing. */
  const evaluate = (model, of) => {
    const rocks = of.im4 >= 1;
    const answer = { p_nr: exact(rocks ? 0 : 1), p_ex: null, p_ro: null, p_f_r: null, p_f: rocks ? null : exact(0) };
    if (!rocks) return answer;
    const demand = exceeding(lawAt(model.demand, of), of, model.limit);
    const index = predict(model.overturning, of);
    if (demand === null || index === null) return answer;
    const [p_ex, p_ro] = [probability(demand), probability({ value: index.value, error: Math.sqrt(index.variance) })];
    const p_f_r = failure(p_ro, p_ex);
    return { ...answer, p_ex, p_ro, p_f_r, p_f: p_f_r };
  };

  /** The measures that lie outside of the data of the fits. */
  const outOfRange = (model, of) => {
    if (!(of.im4 >= 1)) return [];
    const found = new Map();
    for (const { x, y, ranges } of [lawAt(model.demand, of).median, model.overturning]) {
      [x, y].forEach((name, at) => {
        const value = name === null ? null : usable(of[name]);
        if (value === null) return;
        const [least, largest] = ranges[at];
        if ((value < least && name !== "im4") || value > largest) found.set(name, { name, value, least, largest });
      });
    }
    return [...found.values()];
  };

  return { block, measures, bends, evaluate, outOfRange };
})();
