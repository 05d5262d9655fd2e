"""What stood and what fell, and calibrations to it: python outcomes.py core/tests/reference/fits

outcomes.csv has four lists of blocks: `town`, of one earthquake; `towns`, of twelve; `stood` and `fell`, in
which all did. outcomes_answers.csv: c, ln s, m and covariance of calibration.py, with a shift for each
earthquake.
"""

import pathlib
import sys

import numpy as np
import pandas as pd
import polars as pl

scripts = pathlib.Path(__file__).resolve().parents[1]
sys.path += [str(scripts), str(scripts / "universal")]
from calibration import apply, calibrate, logistic  # noqa: E402
from common import G, ROOT, call  # noqa: E402, F401
from surface import NO_LIMIT, Surface  # noqa: E402

SURFACE = Surface(open(ROOT / "core/data/universal.csv"))
PRIOR = SURFACE.prior("pro", "recorded")
TAU = SURFACE.numbers["calibration", "recorded", "pro"][6]


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
    """L, M - 6.9 and what is added near uplift of blocks, of Housner's eta where none is given: n x 3."""
    alpha, r = np.arctan(rows.width / rows.height), np.hypot(rows.width, rows.height) / 2
    p, uplift = np.sqrt(3 * G / (4 * r)), G * np.tan(alpha)
    cases = {"p_rad_s": p, "eta": rows.get("eta", 1 - 1.5 * np.sin(alpha) ** 2), "im4": rows.pga_m_s2 / uplift}
    cases |= {"im5": p * rows.pgv_m_s / uplift, "mw": rows.mw, "limit": np.full(len(rows), NO_LIMIT)}
    return SURFACE.parts("pro", "recorded", pl.DataFrame({name: np.asarray(of) for name, of in cases.items()}))


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


if __name__ == "__main__":
    folder, of_all = pathlib.Path(sys.argv[1]), list(lists())
    pd.concat(of_all).to_csv(folder / "outcomes.csv", index=False)
    answers = pd.DataFrame({"list": rows.list.iloc[0]} | answer(rows) for rows in of_all)
    answers.to_csv(folder / "outcomes_answers.csv", index=False)
