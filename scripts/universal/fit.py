"""Fits the functions of the surface to each kind of motion, so that no logit falls as a motion is scaled up,
its PGV rises, or a structure becomes narrower, smaller or bouncier."""

import numpy as np
import polars as pl
from scipy.optimize import minimize

from cases import counted
from surface import DOMAIN, MOST_IM4, NO_LIMIT, design, uplift

SLACK, STEP = 1e-3, 1.02
SOUGHT = np.log([2.0, 0.2, 0.5])


def loss_of(z, happened):
    return np.logaddexp(0, z).sum() - happened @ z


def monotone_logistic(columns, happened, rises, ridge=0.5, added=0.0, b=None):
    """Coefficients b of a logistic regression with `rises @ b` >= 0. `added` is a known part of the logit."""
    # A quadratic penalty, ever stronger.
    weights = (0.0, 1e2, 1e4, 1e6, 1e8) if b is None else (1e4, 1e6, 1e8)
    b = np.zeros(columns.shape[1]) if b is None else b
    for weight in weights:

        def loss(b):
            lack = np.minimum(rises @ b - SLACK, 0)
            return loss_of(columns @ b + added, happened) + 0.5 * ridge * b @ b + 0.5 * weight * lack @ lack

        now, gain = loss(b), np.inf
        while gain > 1e-3:
            p, slack = 1.0 / (1.0 + np.exp(-np.clip(columns @ b + added, -500, 500))), rises @ b - SLACK
            held, slack = rises[slack < 0], slack[slack < 0]
            gradient = columns.T @ (p - happened) + ridge * b + weight * held.T @ slack
            hessian = columns.T @ (columns * (p * (1 - p))[:, None]) + weight * held.T @ held
            step = np.linalg.solve(hessian + ridge * np.eye(len(b)), -gradient)
            size = 1.0
            while (then := loss(b + size * step)) > now + 1e-4 * size * (step @ gradient) and size > 1e-6:
                size /= 2
            b, gain, now = b + size * step, now - then, then
    return b


def added_left_out(z, columns, happened, folds):
    """Coefficients of what is added to a logit z, and the logit of each fold with those of all others."""
    of = lambda rows: monotone_logistic(columns[rows], happened[rows], columns[:0], 1e-6, z[rows])
    left = z.copy()
    for fold in np.unique(folds):
        left[folds == fold] += columns[folds == fold] @ of(folds != fold)
    return of(folds >= 0), left


def rises(terms, points=(9, 6, 5)):
    """What a logit gains, per unit of ln, as a motion becomes stronger, PGV alone rises, a structure becomes
    smaller or bouncier, or the limit falls, on a grid over the domain and p beyond it of so many IM4, PGA/PGV
    and p, and the ends of eta, in which all functions are linear. The last column is of magnitude."""
    spaced = lambda ends, n: np.exp(np.linspace(*np.log(ends), n))
    low, high = DOMAIN["ratio"]
    axes = {
        "im4": np.append([1.0, 1.02, 1.05, 1.1, 1.2], spaced((1.4, MOST_IM4 / STEP), points[0])),
        "ratio": spaced((low * STEP, high), points[1]),
        "p_rad_s": np.concatenate([[0.35], spaced(DOMAIN["p"], points[2]), [9.0]]),
        "eta": [0.7, 0.995],
        "limit": [0.02, 0.1, 0.4, 0.88] if "limit" in terms else [NO_LIMIT],
    }
    grid = dict(zip(axes, (axis.ravel() for axis in np.meshgrid(*axes.values(), indexing="ij"))))
    here = pl.DataFrame(grid).with_columns(im5=pl.col("im4") * pl.col("p_rad_s") / pl.col("ratio"))
    faster = here.with_columns(pl.col("im5") * STEP)
    there = [here.with_columns(pl.col("im4", "im5") * STEP), faster, faster.with_columns(pl.col("p_rad_s") * STEP)]
    there += [here.with_columns(pl.col("eta") + 0.003), here.with_columns(pl.col("limit") / STEP)]
    gains = np.concatenate([design(terms, cases) - design(terms, here) for cases in there])
    gains = np.pad(gains / np.log(STEP), ((0, 0), (0, 1)))
    return gains[np.abs(gains).max(axis=1) > 1e-9]


def sample(event, cases):
    """The cases that count, each with a limit state, drawn."""
    low, high = np.log(DOMAIN["limit"])
    cases = cases.filter(~(pl.col("overturned") & (event == "pex")))
    return counted(event, cases, np.exp(np.random.default_rng(1).uniform(low, high, len(cases))))


def uplift_numbers(cases, logit, start):
    """ln n, d and k of greatest likelihood with `logit` given; a weak prior holds what no case tells."""
    near = cases["im4"].to_numpy() < 2.5
    cases, logit = cases.filter(near), logit[near]
    happened, options = cases["happened"].to_numpy().astype(float), {"xatol": 1e-3, "fatol": 1e-3}
    loss = lambda numbers: loss_of(logit + uplift(cases, np.exp(numbers)), happened) + weak(numbers)
    return minimize(loss, start, method="Nelder-Mead", options=options).x


def weak(numbers):
    return 0.5 * np.square(numbers - SOUGHT).sum()


def surface(event, terms, cases, with_magnitude):
    """Returns the coefficients by term, that of M - 6.9, and n, d and k of one kind of motion."""
    cases = sample(event, cases)
    happened, mw = cases["happened"].to_numpy().astype(float), (cases["mw"].to_numpy() - 6.9) * with_magnitude
    columns = np.column_stack([design(terms, cases), mw])
    gains, fine = rises(terms), rises(terms, (24, 25, 10))
    numbers, b = SOUGHT, None
    for _ in range(4):
        b = monotone_logistic(columns, happened, gains, added=uplift(cases, np.exp(numbers)), b=b)
        numbers = uplift_numbers(cases, columns @ b, numbers)
    for _ in range(3):
        gains = np.concatenate([gains, fine[fine @ b < 20 * SLACK]])
        b = monotone_logistic(columns, happened, gains, added=uplift(cases, np.exp(numbers)), b=b)
    return dict(zip(terms, b)), b[-1], np.exp(numbers)
