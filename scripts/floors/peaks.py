"""Fits the peaks of floors to those of the ground: python peaks.py AT2_FOLDER COMPONENTS.csv

u = ln(T1/Tg), Tg = 2 pi PGV/PGA, u_i = u - ln(2i - 1), G_i the participation of mode i:
r_i = 1/(1 + exp(k (u_i - b))), D_i = d/(exp(-l (u_i - e)) + exp(h (u_i - e))),
A = 1 - sum G_i (1 - r_i), B = sum G_i^2 D_i^2, ln(floor/ground) = ln(A^2 + B)/2 with an sd of s sqrt(B/(A^2 + B)).
"""

import sys

import numpy as np
from scipy.optimize import minimize

import motions

PERIODS = np.geomspace(0.1, 3.0, 12)
LEVELS = [0.2, 0.4, 0.6, 0.8, 1.0]
LEAST_SD = 0.08
START = {"pfa": [-0.090, 3.430, 3.635, 0.112, 0.434, 1.494, 0.284], "pfv": [0.930, 3.199, 3.569, -0.225, 1.574, 0.637, 0.314]}


def table(folder, components):
    """PGA, PGV, T1, z, PFA, PFV, earthquake of each component, period and level."""
    rows = []
    for name, earthquake, magnitude, a, dt in motions.records(folder, components):
        pga, pgv = motions.peaks(a, dt)
        for period in PERIODS:
            pfa, pfv = motions.peaks(motions.floors(a, dt, period, LEVELS), dt)
            rows += [(pga, pgv, period, z, fa, fv, magnitude, earthquake) for z, fa, fv in zip(LEVELS, pfa, pfv)]
    names = ["pga", "pgv", "period", "level", "pfa", "pfv", "magnitude", "earthquake"]
    return {name: np.array(column) for name, column in zip(names, zip(*rows))}


def terms(b, u, shares):
    """A and B: n each. u: n, shares: n x 5."""
    beta, k, d, e, l, h = b[:6]
    ui = u[:, None] - np.log(2 * np.arange(1, 6) - 1)
    r = 1 / (1 + np.exp(np.clip(k * (ui - beta), -500, 500)))
    D = d / (np.exp(-l * (ui - e)) + np.exp(h * (ui - e)))
    return 1 - (shares * (1 - r)).sum(axis=1), (shares**2 * D**2).sum(axis=1)


def predict(b, rows):
    """ln(floor/ground) and its sd."""
    u = np.log(rows["period"] * rows["pga"] / (2 * np.pi * rows["pgv"]))
    shares = np.stack([motions.participation(z) for z in LEVELS])[np.searchsorted(LEVELS, rows["level"])]
    A, B = terms(b, u, shares)
    return 0.5 * np.log(A**2 + B), b[6] * np.sqrt(B / (A**2 + B)), B / (A**2 + B)


def fit(rows, peak):
    y = np.log(rows["pfa"] / rows["pga"] if peak == "pfa" else rows["pfv"] / rows["pgv"])

    def loss(b):
        mean, sd, _ = predict(b, rows)
        sd = np.hypot(sd, LEAST_SD)
        return (0.5 * ((y - mean) / sd) ** 2 + np.log(sd)).mean()

    b = minimize(loss, START[peak], method="L-BFGS-B").x
    b = minimize(loss, b, method="BFGS", options={"gtol": 1e-6}).x
    mean, _, share = predict(b, rows)
    b[6] = np.sqrt(np.mean((y - mean) ** 2) / share.mean())
    return b, y


def some(rows, mask):
    return {name: column[mask] for name, column in rows.items()}


def main():
    rows = table(*sys.argv[1:3])
    off = {}
    for peak in ("pfa", "pfv"):
        b, y = fit(rows, peak)
        mean, sd, f = predict(b, rows)
        off[peak] = (y - mean) / np.sqrt(f)
        print(peak, " ".join(f"{name} {value:.3f}" for name, value in zip("b k d e l h s".split(), b)))
        n = len(y) // len(PERIODS) // len(LEVELS), len(set(rows["earthquake"]))
        print("   fitted to {} components of {} earthquakes:".format(*n), f"sd {np.std(y - mean):.3f}")
        folds = {q: k % 10 for k, q in enumerate(np.random.default_rng(1).permutation(sorted(set(rows["earthquake"]))))}
        fold = np.array([folds[q] for q in rows["earthquake"]])
        left, sds = np.zeros(len(y)), np.zeros(len(y))
        for k in range(10):
            bk, _ = fit(some(rows, fold != k), peak)
            m, s, _ = predict(bk, some(rows, fold == k))
            left[fold == k], sds[fold == k] = y[fold == k] - m, s
        cells = [left[(rows["period"] == t) & (rows["level"] == z)].mean() for t in PERIODS for z in LEVELS]
        print(f"   earthquakes left out: bias {left.mean():.3f}, sd {left.std():.3f}, cells {min(cells):.2f} to {max(cells):.2f}, within 1.96 sd {np.mean(abs(left / sds) < 1.96):.3f}")
    print("correlation", f"{np.corrcoef(off['pfa'], off['pfv'])[0, 1]:.2f}")


if __name__ == "__main__":
    main()
