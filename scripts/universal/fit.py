"""Fits the functions of the surface to each kind of motion, so that no logit falls as a motion is scaled up,
its PGV rises, or a structure becomes narrower, smaller or bouncier."""

import numpy as np
from scipy.optimize import minimize

from surface import DOMAIN, MOST_IM4, design, scaled, some, uplift

SLACK, STEP = 1e-3, 1.02
SOUGHT = np.log([2.0, 0.2, 0.5])


def monotone_logistic(columns, happened, rises, ridge=0.5, added=0.0, b=None):
    """Returns coefficients b of a logistic regression with `rises @ b` >= 0: a quadratic penalty, ever
    stronger. `added` is a known part of the logit."""
    weights = (0.0, 1e2, 1e4, 1e6, 1e8) if b is None else (1e4, 1e6, 1e8)
    b = np.zeros(columns.shape[1]) if b is None else b
    for weight in weights:

        def loss(b):
            z, lack = columns @ b + added, np.minimum(rises @ b - SLACK, 0)
            return np.logaddexp(0, z).sum() - happened @ z + 0.5 * ridge * b @ b + 0.5 * weight * lack @ lack

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


def rises(event, points=(9, 6, 5)):
    """What a logit gains, per unit of ln, as a motion becomes stronger, PGV alone rises, a structure becomes
    smaller at the same shape or bouncier, or the limit falls: on a grid over the domain and p beyond it, with
    so many values of IM4, PGA/PGV and p, and the ends of eta, in which all functions are linear."""
    spaced = lambda ends, n: np.exp(np.linspace(*np.log(ends), n))
    im4 = np.append([1.0, 1.02, 1.05, 1.1, 1.2], spaced((1.4, MOST_IM4 / STEP), points[0]))
    p = np.concatenate([[0.35], spaced(DOMAIN["p"], points[2]), [9.0]])
    limits = [0.02, 0.1, 0.4, 0.88] if event == "pex" else [0.2]
    low, high = DOMAIN["ratio"]
    axes = im4, spaced((low * STEP, high), points[1]), p, [0.7, 0.995], limits
    im4, ratio, p, eta, limit = (axis.ravel() for axis in np.meshgrid(*axes, indexing="ij"))
    here = {"im4": im4, "im5": im4 * p / ratio, "p_rad_s": p, "eta": eta}
    at = lambda limit=limit, **changed: design(event, here | changed, limit)
    faster, smaller = here["im5"] * STEP, p * STEP
    gains = [at(**scaled(here, STEP)), at(im5=faster), at(im5=faster, p_rad_s=smaller)]
    gains += [at(eta=eta + 0.003), at(limit / STEP)]
    gains = np.concatenate([gain - at() for gain in gains]) / np.log(STEP)
    return gains[np.abs(gains).max(axis=1) > 1e-9]


def sample(event, cases):
    """Returns the cases that count, a limit state for each, drawn, and whether the event happened."""
    cases = some(cases, ~(cases["overturned"] & (event == "pex")))
    low, high = np.log(DOMAIN["limit"])
    limit = np.exp(np.random.default_rng(1).uniform(low, high, len(cases["im4"])))
    return cases, limit, (cases["overturned"] if event == "pro" else cases["edp"] > limit).astype(float)


def uplift_numbers(cases, happened, logit, start=SOUGHT):
    """ln n, d and k of greatest likelihood with `logit` given; a weak prior holds what no case tells."""
    near = cases["im4"] < 2.5
    cases, happened, logit = some(cases, near), happened[near], logit[near]

    def loss(numbers):
        z = logit + uplift(cases, np.exp(numbers))
        return np.logaddexp(0, z).sum() - happened @ z + 0.5 * np.square(numbers - SOUGHT).sum()

    return minimize(loss, start, method="Nelder-Mead", options={"xatol": 1e-3, "fatol": 1e-3}).x


def surface(event, cases, with_magnitude):
    """Returns the coefficients, that of M - 6.9, and n, d and k of one kind of motion."""
    cases, limit, happened = sample(event, cases)
    columns, gains, fine = design(event, cases, limit), rises(event), rises(event, (24, 25, 10))
    if with_magnitude:
        columns = np.column_stack([columns, cases["mw"] - 6.9])
        gains, fine = (np.column_stack([rows, np.zeros(len(rows))]) for rows in (gains, fine))
    numbers, b = SOUGHT, None
    for _ in range(4):
        b = monotone_logistic(columns, happened, gains, added=uplift(cases, np.exp(numbers)), b=b)
        numbers = uplift_numbers(cases, happened, columns @ b, numbers)
    for _ in range(3):
        gains = np.concatenate([gains, fine[fine @ b < 20 * SLACK]])
        b = monotone_logistic(columns, happened, gains, added=uplift(cases, np.exp(numbers)), b=b)
    k = gains.shape[1] - with_magnitude
    return b[:k], b[k] if with_magnitude else 0.0, np.exp(numbers)
