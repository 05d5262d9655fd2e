"""Probabilities at one peak, averaged over PGV/PGA of generic sites by scipy: python fragility.py >
core/tests/reference/fits/fragility_answers.csv

The line of PGV/PGA given PGA is that of recorded_peaks.py, that given PGV that of sites.py. Without a
magnitude it is that of the motions that overturn, with its scatter. Intensities are PGA in g or PGV in m/s.
"""

import itertools
import pathlib
import sys

import numpy as np
import polars as pl
from scipy.integrate import simpson
from scipy.special import expit
from scipy.stats import norm

root = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(root / "scripts/universal"))
from surface import Surface  # noqa: E402

G = 9.81
# ln(PGV/PGA) at 0.4 g or 0.4 m/s and M 6.3, its slope over ln of the peak, its scatter, its rise with magnitude.
LINES = {"pga": (-2.58, -0.15, 0.43, 0.49), "pgv": (-2.21, 0.25, 0.50, 0.33)}
# Mean and scatter of the magnitude of the motions that overturn (site_rates.py).
MAGNITUDE = 6.65, 0.3
LEVEL_AT = {"pga": 0.4 * G, "pgv": 0.4}
STRUCTURES = [(2.2, 0.25, 0.91), (1.5, 0.15, 0.95), (3.5, 0.35, 0.85)]
INTENSITIES = {"pga": (0.3, 0.5, 0.8, 1.5, 3.0), "pgv": (0.15, 0.4, 0.9, 2.5)}
# That at which the features of P_ro are 0, so that both events have it.
LIMIT_STATE = 0.2
surface = Surface(open(root / "core/data/universal.csv"))


def branch(event, cases):
    """P_ro or P_ex."""
    c, ln_s, m, *_ = surface.prior(event, "recorded", LIMIT_STATE if event == "pex" else 0.1)
    logit, magnitude, added = surface.parts(event, "recorded", cases).T
    return expit(c + np.exp(ln_s) * logit + m * magnitude + added)


def probabilities(structure, pga, pgv, mw):
    """Of failure and of overturning, where the structure is uplifted."""
    p, alpha, eta = structure
    im4, im5 = np.array([pga, p * pgv]) / (G * np.tan(alpha))
    cases = pl.DataFrame({"im4": im4, "im5": im5, "p_rad_s": p, "eta": eta, "mw": mw, "limit": LIMIT_STATE})
    overturns = branch("pro", cases)
    return np.array([overturns + (1 - overturns) * branch("pex", cases), overturns])


def averaged(over, structure, intensity, mw):
    level, slope, sd, per_magnitude = LINES[over]
    if mw is None:
        mw, sd = MAGNITUDE[0], np.hypot(sd, per_magnitude * MAGNITUDE[1])
    median = level + slope * np.log(intensity / LEVEL_AT[over]) + per_magnitude * (mw - 6.3)
    over_uplift = intensity / (G * np.tan(structure[1]))
    if over == "pga" and over_uplift <= 1:
        return 0.0, 0.0
    # Motions with more than this have too little PGA to uplift the structure.
    last = np.inf if over == "pga" else (np.log(over_uplift) - median) / sd - 1e-9
    z = np.linspace(-9.0, min(last, 9.0), 40_001)
    ratio, held = np.exp(median + sd * z), np.full(z.shape, intensity)
    peaks = (held, held * ratio) if over == "pga" else (held / ratio, held)
    return simpson(probabilities(structure, *peaks, mw) * norm.pdf(z), x=z)


if __name__ == "__main__":
    print("over,p_rad_s,alpha_rad,eta,mw,intensity,p_failure,p_overturning")
    for over, structure, mw in itertools.product(LINES, STRUCTURES, (None, 7.4)):
        for intensity in INTENSITIES[over]:
            answer = averaged(over, structure, intensity * (G if over == "pga" else 1.0), mw)
            print(over, *structure, mw or "", intensity, *(f"{p:.9e}" for p in answer), sep=",")
