"""What stood and what fell, and calibrations to it: python outcomes.py core/tests/reference/fits

outcomes.csv has four lists of blocks: `town`, of one earthquake; `towns`, of twelve; `stood` and `fell`, in which
all did. outcomes_answers.csv: c, ln s and m of scripts/universal/calibration.py and their covariance, with a shift
for each earthquake. Prints how often 95 % limits of a calibration to 20 outcomes of
a town, half of which fell, hold the probabilities of other stones: 400 draws."""

import pathlib
import sys

import numpy as np
import pandas as pd
import polars as pl

root_folder = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root_folder / "scripts/universal"))
from calibration import apply, calibrate, logistic, tangent  # noqa: E402
from surface import NO_LIMIT, Surface  # noqa: E402

G = 9.81
# Standard deviation of c between structures (docs/review/universal.md).
BETWEEN = 0.71
surface = Surface(open(root_folder / "core/data/universal.csv"))
PRIOR = surface.prior("pro", "recorded")
TAU = surface.numbers["calibration", "recorded", "pro"][6]


def stones(rng, n, earthquakes):
    """Blocks .3 to 1.6 m tall where the motion of one of the earthquakes uplifts them."""
    height, ratio = np.exp(rng.uniform(np.log(0.3), np.log(1.6), n)), rng.uniform(0.15, 0.4, n)
    number = rng.integers(earthquakes, size=n)
    mw = rng.uniform(5.6, 7.4, earthquakes)[number].round(2)
    pga = G * ratio * np.exp(rng.uniform(0.05, 1.2, n))
    pgv = pga * np.exp(rng.normal(-2.4, 0.4, n))
    numbers = {"width": height * ratio, "height": height, "pga_m_s2": pga, "pgv_m_s": pgv}
    return pd.DataFrame(numbers).round(4).assign(mw=mw, earthquake=number)


def parts(rows):
    alpha, r = np.arctan(rows.width / rows.height), np.hypot(rows.width, rows.height) / 2
    p, uplift = np.sqrt(3 * G / (4 * r)), G * np.tan(alpha)
    cases = {"p_rad_s": p, "eta": 1 - 1.5 * np.sin(alpha) ** 2, "im4": rows.pga_m_s2 / uplift}
    cases |= {"im5": p * rows.pgv_m_s / uplift, "mw": rows.mw, "limit": np.full(len(rows), NO_LIMIT)}
    return surface.parts("pro", "recorded", pl.DataFrame({name: np.asarray(of) for name, of in cases.items()}))


def answer(rows):
    b, v = calibrate(parts(rows), rows.fell.to_numpy(), PRIOR, rows.earthquake.to_numpy(), TAU)
    numbers = dict(zip(("c", "ln_s", "m"), b)) | {"n": len(rows), "n_events": int(rows.fell.sum())}
    return numbers | {f"v_{i}{j}": v[i, j] for i in range(3) for j in range(i, 3)}


def lists():
    rng = np.random.default_rng(5)
    for name, n, earthquakes in (("town", 30, 1), ("towns", 120, 12), ("stood", 12, 1), ("fell", 12, 1)):
        rows = stones(rng, n, earthquakes)
        p = logistic(apply(PRIOR[:3], parts(rows)))
        fell = rng.random(n) < p if "town" in name else np.full(n, name == "fell")
        yield rows.assign(list=name, fell=fell.astype(int))


def coverage(rng, draws=400, n=20):
    """A town has its own c, ln s and m, its earthquake and each stone their own shift; its level is such that half
    of its stones fall."""
    held, widths = [], []
    for _ in range(draws):
        town = stones(rng, 200, 1)
        of = parts(town)
        b = PRIOR[:3] + PRIOR[3:] * rng.normal(size=3) * [0, 1, 1]
        z = apply(b, of) + BETWEEN * rng.normal(size=len(of))
        z -= np.median(z[np.isfinite(z)])
        fell = rng.random(len(z)) < logistic(z)
        fitted, v = calibrate(of[:n], fell[:n], PRIOR, np.zeros(n), TAU)
        by, found = tangent(fitted, of[n:]), apply(fitted, of[n:])
        half = 1.96 * np.hypot(np.sqrt(np.einsum("ij,jk,ik->i", by, v, by)), TAU)
        held.append(np.mean(np.abs(found - z[n:]) < half))
        widths.append(np.mean(logistic(found + half) - logistic(found - half)))
    return np.mean(held), np.mean(widths)


folder = pathlib.Path(sys.argv[1])
of_all = list(lists())
pd.concat(of_all).to_csv(folder / "outcomes.csv", index=False)
answers = [{"list": rows.list.iloc[0]} | answer(rows) for rows in of_all]
pd.DataFrame(answers).to_csv(folder / "outcomes_answers.csv", index=False)
print(pd.DataFrame(answers).round(3).to_string())
print("400 draws of 20 of a town: limits hold {:.3f}, mean width {:.2f}".format(*coverage(np.random.default_rng(1))))
