"""Fits the functions of the surface, each kind of motion by itself, so that no logit falls as a motion is scaled up."""

import numpy as np

from surface import KINDS, TERMS, design, scaled, some

RIDGE = 0.5


def monotone_logistic(columns, happened, rises):
    """Returns coefficients b of a logistic regression with `rises @ b` >= 0: a quadratic penalty, ever stronger."""
    ridge = np.full(columns.shape[1], RIDGE)
    b = np.zeros(columns.shape[1])
    for weight in (0.0, 1e2, 1e4, 1e6, 1e8):
        def loss(b):
            z = columns @ b
            return np.logaddexp(0, z).sum() - happened @ z + 0.5 * (ridge * b) @ b + weight / 2 * (np.minimum(rises @ b - 1e-3, 0) ** 2).sum()

        now = loss(b)
        for _ in range(60):
            p = 1.0 / (1.0 + np.exp(-columns @ b))
            slack = rises @ b - 1e-3
            held = rises[slack < 0]
            gradient = columns.T @ (p - happened) + ridge * b + weight * held.T @ slack[slack < 0]
            hessian = columns.T @ (columns * (p * (1 - p) + 1e-9)[:, None]) + np.diag(ridge) + weight * held.T @ held
            step = np.linalg.solve(hessian, -gradient)
            size = 1.0
            while (then := loss(b + size * step)) > now + 1e-4 * size * (step @ gradient) and size > 1e-6:
                size /= 2
            b, gain, now = b + size * step, now - then, then
            if gain < 1e-3:
                break
    return b


def rises(event, cases, n=20000, seed=5):
    """What a logit gains as a motion becomes 1.1 times as strong, and P_ex as the limit falls by as much: of cases of
    training, 0.2 to 5 times as strong, half of them with other structures of the domain."""
    rng = np.random.default_rng(seed)
    drawn = some(cases, rng.integers(0, len(cases["im4"]), n)) | {"eta": rng.uniform(0.7, 0.999, n)}
    other = np.exp(rng.uniform(np.log(0.4), np.log(8.0), n))
    drawn["p_rad_s"] = np.where(rng.random(n) < 0.5, other, drawn["p_rad_s"])
    drawn = scaled(drawn, np.exp(rng.uniform(np.log(0.2), np.log(5.0), n)))
    drawn = some(drawn, drawn["im4"] > 1.0)
    limit = np.exp(rng.uniform(np.log(0.02), np.log(0.5), len(drawn["im4"])))
    here = design(event, drawn, limit)
    gains = [design(event, scaled(drawn, 1.1), limit) - here]
    if event == "pex":
        gains.append(here - design(event, drawn, limit * 1.1))
    return np.concatenate(gains)


def surface(event, cases, seed=1):
    """Returns the k x 3 coefficients; each case of P_ex counts at one limit, drawn."""
    out = []
    for kind in KINDS:
        of_kind = some(cases, (cases["kind"] == kind) & ~(cases["overturned"] & (event == "pex")))
        limit = np.exp(np.random.default_rng(seed).uniform(np.log(0.02), np.log(0.5), len(of_kind["im4"])))
        happened = of_kind["overturned"] if event == "pro" else of_kind["edp"] > limit
        columns = design(event, of_kind, limit)
        out.append(monotone_logistic(columns, happened.astype(float), rises(event, of_kind)))
    return np.stack(out, axis=1)
