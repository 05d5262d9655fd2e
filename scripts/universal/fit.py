"""Fits the functions of the surface to each kind of motion, so that no logit falls as a motion is scaled
up."""

import numpy as np

from surface import KINDS, design, scaled, some

SLACK = 1e-3


def monotone_logistic(columns, happened, rises, ridge=0.5):
    """Returns coefficients b of a logistic regression with `rises @ b` >= 0: a quadratic penalty, ever
    stronger."""
    b = np.zeros(columns.shape[1])
    for weight in (0.0, 1e2, 1e4, 1e6, 1e8):

        def loss(b):
            z, lack = columns @ b, np.minimum(rises @ b - SLACK, 0)
            return np.logaddexp(0, z).sum() - happened @ z + 0.5 * ridge * b @ b + 0.5 * weight * lack @ lack

        now, gain = loss(b), np.inf
        while gain > 1e-3:
            p, slack = 1.0 / (1.0 + np.exp(-columns @ b)), rises @ b - SLACK
            held, slack = rises[slack < 0], slack[slack < 0]
            gradient = columns.T @ (p - happened) + ridge * b + weight * held.T @ slack
            hessian = columns.T @ (columns * (p * (1 - p))[:, None]) + weight * held.T @ held
            step = np.linalg.solve(hessian + ridge * np.eye(len(b)), -gradient)
            size = 1.0
            while (then := loss(b + size * step)) > now + 1e-4 * size * (step @ gradient) and size > 1e-6:
                size /= 2
            b, gain, now = b + size * step, now - then, then
    return b


def rises(event, cases, n=20_000):
    """What a logit gains as a motion becomes 1.1 times as strong, and P_ex as the limit falls by as much:
    of cases of training, 0.2 to 5 or 10,000 times as strong, with another eta, half of them with another p."""
    rng = np.random.default_rng(5)
    log_uniform = lambda low, high, n: np.exp(rng.uniform(np.log(low), np.log(high), n))
    drawn = some(cases, rng.integers(0, len(cases["im4"]), n)) | {"eta": rng.uniform(0.7, 0.999, n)}
    drawn["p_rad_s"] = np.where(rng.random(n) < 0.5, log_uniform(0.4, 8.0, n), drawn["p_rad_s"])
    drawn = scaled(drawn, log_uniform(0.2, np.where(rng.random(n) < 0.5, 5.0, 1e4), n))
    drawn = some(drawn, drawn["im4"] > 1.0)
    limit = log_uniform(0.02, 0.5, len(drawn["im4"]))
    here = design(event, drawn, limit)
    gains = [design(event, scaled(drawn, 1.1), limit) - here, here - design(event, drawn, limit * 1.1)]
    return np.concatenate(gains if event == "pex" else gains[:1])


def surface(event, cases):
    """Returns the k x 3 coefficients; each case of P_ex counts at one limit, drawn."""
    out = []
    for kind in KINDS:
        of_kind = some(cases, (cases["kind"] == kind) & ~(cases["overturned"] & (event == "pex")))
        limit = np.exp(np.random.default_rng(1).uniform(np.log(0.02), np.log(0.5), len(of_kind["im4"])))
        happened = of_kind["overturned"] if event == "pro" else of_kind["edp"] > limit
        columns = design(event, of_kind, limit)
        out.append(monotone_logistic(columns, happened.astype(float), rises(event, of_kind)))
    return np.stack(out, axis=1)
