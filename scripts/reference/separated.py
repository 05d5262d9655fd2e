"""Firth's penalised likelihood of separated cases: python separated.py tests/reference/fits

Makes 150 sets of 6 to 25 cases, with one measure or two (`y` is empty), separated completely or but for a point that has both
outcomes (separated.csv), and finds the largest penalised log-likelihood of each under each link by scipy, from 40 random starts and
some others (separated_answers.csv; `optima` counts maxima within 2 of the largest). Needs numpy and scipy.
"""

import csv
import pathlib
import sys

import numpy as np
from scipy import optimize, special, stats

SETS, STARTS, SEED = 150, 40, 20151
folder = pathlib.Path(sys.argv[1])
random = np.random.default_rng(SEED)


def separated_set(number):
    n, measures, quasi = int(random.integers(6, 25)), 1 + number % 2, number // 2 % 2
    x = random.normal(0, random.uniform(0.2, 1.5), (n, measures)) + random.uniform(-2, 2, measures)
    # Distinct scores, of which three decimals are written.
    x = np.unique(np.round(x, 3), axis=0)
    weights = np.round(random.normal(size=measures), 1)
    score = x @ (weights if weights.any() else weights + 1)
    order = np.argsort(score)
    cut = order[int(random.integers(1, len(x)))]
    event = score >= score[cut]
    if event.all():
        event = score > score[cut]
    if quasi:
        x, event = np.vstack([x, x[cut]]), np.append(event, not event[cut])
    return x, event


def ln_likelihood(link, index, event):
    if link == "probit":
        return special.log_ndtr(np.where(event, index, -index)).sum()
    if link == "logit":
        return special.log_expit(np.where(event, index, -index)).sum()
    hazard = np.exp(np.minimum(index, 700))
    return np.where(event, np.log(np.maximum(-np.expm1(-hazard), 1e-320)), -hazard).sum()


def ln_weight(link, index):
    if link == "probit":
        return 2 * stats.norm.logpdf(index) - special.log_ndtr(index) - special.log_ndtr(-index)
    if link == "logit":
        return special.log_expit(index) + special.log_expit(-index)
    hazard = np.exp(np.minimum(index, 700))
    return 2 * index - np.where(hazard < 30, np.log(np.expm1(np.minimum(hazard, 30))), hazard)


def minus_penalised(b, design, event, link):
    index = design @ b
    weight = np.exp(ln_weight(link, index))
    sign, logarithm = np.linalg.slogdet(design.T @ (design * weight[:, None]))
    value = ln_likelihood(link, index, event) + 0.5 * logarithm
    return -value if sign > 0 and np.isfinite(value) else 1e10


def maxima(x, event, link, starts):
    sd = x.std(0)
    design = np.column_stack([np.ones(len(x)), (x - x.mean(0)) / sd])
    found = []
    for start in starts[:, : design.shape[1]]:
        if minus_penalised(start, design, event, link) >= 1e9:
            continue
        options = dict(xatol=1e-9, fatol=1e-12, maxiter=3000)
        best = optimize.minimize(minus_penalised, start, (design, event, link), "Nelder-Mead", options=options)
        # The determinant of the information of the measures as they are.
        found.append(-best.fun + np.log(sd).sum())
    return sorted(found, reverse=True)


flat = [[s, 0, 0] for s in (-3, -1, 0, 1, 2)]
starts = np.vstack([flat, random.normal(size=(STARTS, 3)) * random.choice([1, 3, 9], (STARTS, 1))])
sets = [separated_set(number) for number in range(SETS)]
with open(folder / "separated.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["set", "x", "y", "event"])
    for number, (x, event) in enumerate(sets):
        for row, happened in zip(x, event):
            writer.writerow([number, f"{row[0]:.3f}", f"{row[1]:.3f}" if len(row) > 1 else "", int(happened)])
with open(folder / "separated_answers.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["set", "link", "penalised", "optima"])
    for number, (x, event) in enumerate(sets):
        for link in ("probit", "logit", "cloglog"):
            values = maxima(x, event, link, starts)
            optima = len({round(value, 3) for value in values if value > values[0] - 2})
            writer.writerow([number, link, f"{values[0]:.9f}", optima])
            file.flush()
