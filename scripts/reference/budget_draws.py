"""Holds the budget of errors against draws of all unknowns: python budget_draws.py FOLDER ROCKFRAG, after
site_rates.py

Seven cases: routes, objects and sites. 10,000 draws of c, ln s, m, magnitude, level of PGV/PGA and eta give
rates by a quadrature of our own; the distances of their 2.5 and 97.5 % quantiles from the median, in ln,
stand beside those of the limits of evaluate.
"""

import numpy as np
from scipy.interpolate import RegularGridInterpolator
from scipy.optimize import least_squares
from scipy.special import expit
from scipy.stats import norm

import site_rates as R
from sites import X, Y

DRAWS = 10_000
# As core/src/hazard has them: the line of generic sites (level, slope, scatter, rise with magnitude, sd of
# the level), the scatter of a line by two curves and the sds of its level by SA(1.0 s) or not; PGV by SA(1.0 s).
GIVEN_PGA, SCATTER, SD_BY_CURVES = (-2.86, -0.06, 0.58, 0.30, 0.28), 0.42, {False: 0.08, True: 0.12}
BY_SPECTRUM = 0.090, 0.36, 0.13
# Sd of a mean magnitude that PGV/PGA tells.
INFERRED = 0.5
# Mean and sd of an unknown magnitude, the middle of the line; by how much that of what overturns lies above the mean
# of the disaggregation of PGA and of SA(1.0 s), and its sd.
MAGNITUDE, MIDDLE = (6.35, 0.6), 6.3
ABOVE = {"M": (0.45, 0.3), "MS": (0.0, 0.2)}
Z = np.linspace(-5, 5, 31)
WEIGHT = norm.pdf(Z) / norm.pdf(Z).sum()
AT = np.log(0.4 * 9.81)


def thinned(curve):
    return curve[(curve[:, 1] > 1e-9) & (curve[:, 1] < 0.5)]


def exceeds(curve, ln_level):
    return np.exp(np.interp(ln_level, np.log(curve[:, 0]), np.log(curve[:, 1])))


def matched(pga, pgv, scatter):
    """Level and slope by which the curve of PGA has the rates of that of PGV."""
    x = np.linspace(np.log(pga[0, 0]), np.log(pga[-1, 0]), 400)
    weight, middle = -np.diff(exceeds(pga, x)), 0.5 * (x[1:] + x[:-1])
    rates = np.geomspace(min(2e-2, 0.5 * pga[0, 1], pgv[0, 1]), max(1e-6, 2 * pga[-1, 1], pgv[-1, 1]), 16)
    levels = np.interp(-np.log(rates), -np.log(pgv[:, 1]), np.log(pgv[:, 0]))
    off = lambda b: levels[:, None] - middle - b[0] - b[1] * (middle - AT)
    of = lambda b: norm.sf(off(b) / scatter) @ weight + pga[-1, 1]
    return least_squares(lambda b: np.log(of(b) / rates), [-2.9, 0.0]).x


def expected_magnitude():
    """Intercept and slope of magnitude on ln(PGV / PGA)."""
    lines = open(R.ROOT / "core/data/universal.csv").read().splitlines()
    cells = next(line.split(",") for line in lines if line.startswith("magnitude,recorded"))
    return [float(cell) for cell in cells[2:4]]


def surface(truth):
    """Logits less c by ln loss, ln PGA and ln PGV; below uplift they fall off."""
    logits = np.where(np.isfinite(truth.logits), truth.logits - truth.c, -60.0)
    return RegularGridInterpolator((R.LN_LOSS, X, Y), logits)


def rates(k, truth, line, scatter, above, draws):
    """The rates of a site for draws of c, ln s, m, magnitude, level and ln loss."""
    curve = thinned(R.data["pga"][k])
    highest = min(np.log(curve[-1, 0]), X[-1] - 1e-9)
    x = np.linspace(np.log(9.81 * truth.tan_alpha) + 1e-3, highest, 60)
    h = exceeds(curve, x)
    ln_pga, weight = np.append(0.5 * (x[1:] + x[:-1]), x[-1]), np.append(-np.diff(h), h[-1])
    of, result, (intercept, slope) = surface(truth), [], expected_magnitude()
    for c, ln_s, m, mw, level, loss in draws:
        ln_pgv = ln_pga[:, None] + line(ln_pga, mw)[:, None] + level + scatter * Z
        ln_pgv = np.clip(ln_pgv, Y[0], np.log(4.9))
        loss = np.clip(loss, R.LN_LOSS[0], R.LN_LOSS[-1])
        z = of(np.stack(np.broadcast_arrays(loss, ln_pga[:, None], ln_pgv), -1))
        # By two curves PGV / PGA tells an unknown magnitude.
        if above is None:
            mw = intercept + slope * (ln_pgv - ln_pga[:, None]) + mw
        else:
            mw = mw + above
        of_mw = (truth.m + m) * (np.clip(mw, *R.RANGE) - R.MIDDLE)
        result.append(weight @ (expit(truth.c + c + np.exp(ln_s) * z + of_mw) @ WEIGHT))
    return np.array(result)


def case(k, name, route, random):
    truth = R.Truth(*R.OBJECTS[name])
    level, slope, scatter, per_mw, sd_level = GIVEN_PGA
    given = route.split(", ")[-1]
    (mw, sd_mw), above = MAGNITUDE, 0.0
    if given in ABOVE:
        mw, (above, sd_mw) = R.MEANS[given][k], ABOVE[given]
    if "PGV" in route or "SA" in route:
        pga, pgv, per_mw, scatter = thinned(R.data["pga"][k]), thinned(R.data["pgv"][k]), 0.0, SCATTER
        sd_level = SD_BY_CURVES["SA" in route]
        if "SA" in route:
            factor, of_pga, per_mw = BY_SPECTRUM
            pgv = thinned(R.data["sa"][k]).copy()
            as_often = np.exp(np.interp(-np.log(pgv[:, 1]), -np.log(pga[:, 1]), np.log(pga[:, 0])))
            pgv[:, 0] = factor * pgv[:, 0] ** (1 - of_pga) * as_often**of_pga
        level, slope = matched(pga, pgv, scatter)
        if given not in ABOVE:
            mw, sd_mw, above = 0.0, INFERRED, None
    # What PGV/PGA leaves open moves the part of PGV/PGA that depends on the magnitude, too.
    known = lambda mw: MAGNITUDE[0] + MAGNITUDE[1] / INFERRED * mw if above is None else mw
    line = lambda ln_pga, mw: level + slope * (ln_pga - AT) + per_mw * (known(mw) - MIDDLE)
    sds = np.array([*truth.sds, sd_mw, sd_level, R.SD_OF_LOSS])
    draws = random.normal(size=(DRAWS, 6)) * sds + [0, 0, 0, mw, 0, 0]
    drawn = np.log(rates(k, truth, line, scatter, above, draws))
    at_medians = np.log(rates(k, truth, line, scatter, above, [[0, 0, 0, mw, 0, 0]])[0])
    R.write(k)
    row = R.answers(k, route)[name]
    value, low, high = (np.log(row[f"overturning_per_year{end}"]) for end in ("", "_low", "_high"))
    least, median, most = np.quantile(drawn, [0.025, 0.5, 0.975])
    below, above = median - least, most - median
    print(name, route, *R.names[k][1:], "rate {:.1e} (ours {:.1e}, median of draws {:.1e})".format(
        *np.exp([value, at_medians, median])), f"limits -{value - low:.2f} +{high - value:.2f}",
        f"draws -{below:.2f} +{above:.2f} ratio {(value - low) / below:.2f} {(high - value) / above:.2f}")


if __name__ == "__main__":
    generator = np.random.default_rng(7)
    R.write_objects()
    for site, thing, way in [
        (14, "cabinet", "PGA"), (50, "shelf", "PGA"), (20, "rack", "PGA, M"), (30, "cabinet", "PGA, SA"),
        (40, "rack", "PGA, SA, MS"), (62, "statue", "PGA, PGV"), (90, "cabinet", "PGA, PGV, M"),
    ]:  # fmt: skip
        case(site, thing, way, generator)
