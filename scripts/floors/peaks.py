"""Fits the peaks of floors to those of the ground: python peaks.py AT2.parquet

u = ln(T1/Tg), Tg = 2 pi PGV/PGA, u_i = u - ln(2i - 1), G_i the participation of mode i:
r_i = 1/(1 + exp(k (u_i - b))), D_i = d/(exp(-l (u_i - e)) + exp(h (u_i - e))),
A = 1 - sum G_i (1 - r_i), B = sum G_i^2 D_i^2,
ln(floor/ground) = ln(A^2 + B)/2 with an sd of s sqrt(B/(A^2 + B)).
"""

import sys

import numpy as np
import polars as pl
from scipy.optimize import minimize

import motions

PERIODS = np.geomspace(0.1, 3.0, 12)
LEVELS = [0.2, 0.4, 0.6, 0.8, 1.0]
LEAST_SD, FOLDS = 0.08, 10
START = {"pfa": [-0.090, 3.430, 3.635, 0.112, 0.434, 1.494, 0.284],
         "pfv": [0.930, 3.199, 3.569, -0.225, 1.574, 0.637, 0.314]}  # fmt: skip


def rows(imported):
    """Of each component, period and level."""
    for _, earthquake, _, a, dt in motions.records(imported):
        pga, pgv = motions.peaks(a, dt)
        for period in PERIODS:
            pfa, pfv = motions.peaks(motions.floors(a, dt, period, LEVELS), dt)
            u = np.log(period * pga / (2 * np.pi * pgv))
            for z, fa, fv in zip(LEVELS, pfa, pfv):
                yield earthquake, z, u, np.log(fa / pga), np.log(fv / pgv)


def median(b, u, level):
    """ln(floor/ground) and the resonant share B/(A^2 + B): n each. u, level: n."""
    beta, k, d, e, l, h = b[:6]
    shares, ui = motions.participation(level[:, None]), u[:, None] - np.log(2 * np.arange(1, 6) - 1)
    D = d / (np.exp(-l * (ui - e)) + np.exp(h * (ui - e)))
    r = 1 / (1 + np.exp(np.clip(k * (ui - beta), -500, 500)))
    A, B = 1 - (shares * (1 - r)).sum(axis=1), (shares**2 * D**2).sum(axis=1)
    return 0.5 * np.log(A**2 + B), B / (A**2 + B)


def fit(u, level, y, start):
    def loss(b):
        mean, share = median(b, u, level)
        sd = np.hypot(b[6] * np.sqrt(share), LEAST_SD)
        return (0.5 * ((y - mean) / sd) ** 2 + np.log(sd)).mean()

    b = minimize(loss, start, method="L-BFGS-B").x
    b = minimize(loss, b, method="BFGS", options={"gtol": 1e-6}).x
    mean, share = median(b, u, level)
    b[6] = np.sqrt(np.mean((y - mean) ** 2) / share.mean())
    return b


def main():
    names = ["earthquake", "level", "u", "pfa", "pfv"]
    table = pl.DataFrame(list(rows(sys.argv[1])), names, orient="row")
    earthquakes = table["earthquake"].unique().sort()
    print(len(table) // len(PERIODS) // len(LEVELS), "components of", len(earthquakes), "earthquakes")
    drawn = np.random.default_rng(1).permutation(earthquakes)
    fold = table["earthquake"].replace_strict({name: k % FOLDS for k, name in enumerate(drawn)}).to_numpy()
    u, level, off = table["u"].to_numpy(), table["level"].to_numpy(), []
    for peak, start in START.items():
        y = table[peak].to_numpy()
        b = fit(u, level, y, start)
        mean, share = median(b, u, level)
        off.append((y - mean) / np.sqrt(share))
        print(peak, *map("{} {:.3f}".format, "bkdelhs", b), f"sd {np.std(y - mean):.3f}")
        left = np.zeros(len(y))
        for k in range(FOLDS):
            out = fold == k
            bk = fit(u[~out], level[~out], y[~out], start)
            left[out] = y[out] - median(bk, u[out], level[out])[0]
        print(f"   earthquakes left out: bias {left.mean():.3f}, sd {left.std():.3f}")
    print("correlation", f"{np.corrcoef(*off)[0, 1]:.2f}")


if __name__ == "__main__":
    main()
