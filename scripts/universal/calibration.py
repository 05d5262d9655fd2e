"""logit P = c + s L + m (M - 6.9) + what is added near uplift: c, ln s and m by maximum a posteriori, their
covariance and tau. L, M - 6.9 and what is added are `parts` of n cases, n x 3 (Surface.parts). A prior is k means
and k standard deviations: of c, ln s and m, and of the shifts of clusters, if any."""

import numpy as np

MANY_CLUSTERS = 30
WIDE = np.array([0.0, 0.0, 0.0, 5.0, 5.0, 5.0])
NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(15)


def logistic(z):
    return 1.0 / (1.0 + np.exp(-np.clip(z, -500, 500)))


def tangent(b, parts):
    """Derivatives of the logit by c, ln s and m: n x 3."""
    return np.stack([np.ones(len(parts)), np.exp(b[1]) * parts[:, 0], parts[:, 1]], axis=1)


def apply(b, parts):
    return b[0] + np.exp(b[1]) * parts[:, 0] + b[2] * parts[:, 1] + parts[:, 2]


def derivatives(b, parts, happened, prior, shifted):
    """The negative log posterior, gradient, Hessian and scores. `shifted`: the shift of a case, n x (k - 3)."""
    away, precision = b - prior[: len(b)], 1.0 / np.square(prior[len(b) :])
    z, by = apply(b, parts) + shifted @ b[3:], np.hstack([tangent(b, parts), shifted])
    p = logistic(z)
    loss = (np.logaddexp(0, z) - happened * z).sum() + 0.5 * (precision * away) @ away
    scores = by * (p - happened)[:, None]
    hessian = by.T @ (by * (p * (1 - p))[:, None]) + np.diag(precision)
    hessian[1, 1] += scores[:, 1].sum()
    return loss, scores.sum(axis=0) + precision * away, hessian, scores


def calibrate(parts, happened, prior, clusters=None, tau=None):
    """Returns (c, ln s, m) and their covariance: its part of the inverse Hessian H^-1 of the posterior, in which
    each of fewer than 30 clusters has a shift of standard deviation tau; of 30 or more H^-1 (M + P) H^-1,
    M = G/(G-1) (n-1)/(n-3) times the sum over the G clusters of u u', u the sum of the scores of their cases, n in
    all, P the precision of the prior (without data the covariance is that of the prior)."""
    happened = happened.astype(float)
    kinds, at = np.unique(clusters if clusters is not None else [], return_inverse=True)
    shifted = np.equal.outer(clusters, kinds) if 0 < len(kinds) < MANY_CLUSTERS else np.zeros((len(happened), 0))
    shifts = np.ones(shifted.shape[1])
    prior = np.concatenate([prior[:3], 0.0 * shifts, prior[3:6], (tau or 0.0) * shifts])
    b = prior[: 3 + len(shifts)]
    for _ in range(100):
        loss, gradient, hessian, scores = derivatives(b, parts, happened, prior, shifted)
        if np.abs(gradient).max() < 1e-9:
            break
        values, vectors = np.linalg.eigh(hessian)
        step = -vectors @ (vectors.T @ gradient / np.maximum(np.abs(values), 1e-3))
        size = min(1.0, 2.0 / np.abs(step).max())
        while derivatives(b + size * step, parts, happened, prior, shifted)[0] > loss + 1e-12 * (1 + loss):
            size /= 2
        b = b + size * step
    covariance = np.linalg.inv(hessian)[:3, :3]
    if len(kinds) >= MANY_CLUSTERS:
        sums, g, n = np.stack([np.bincount(at, column) for column in scores.T], 1), len(kinds), len(happened)
        meat = g / (g - 1) * (n - 1) / (n - 3) * sums.T @ sums + np.diag(1.0 / np.square(prior[3:6]))
        covariance = covariance @ meat @ covariance
    return b[:3], covariance


def spread(groups, mean):
    """Sds of c, ln s and m between groups, each (parts, happened), by expectation-maximisation."""
    sd, last = np.array([0.5, 0.15, 0.3]), np.zeros(3)
    while np.abs(sd - last).max() > 0.002:
        fits = [calibrate(*group, np.array([*mean, *sd])) for group in groups]
        sd, last = np.sqrt(np.mean([(b - mean) ** 2 + np.diag(v) for b, v in fits], axis=0)), sd
    return sd


def left_out(parts, happened, folds, prior, judged=None):
    """The logit of the cases of each fold, calibrated to all others; `judged`: parts to apply it to."""
    judged, z = parts if judged is None else judged, np.empty(len(happened))
    for fold in np.unique(folds):
        out = folds == fold
        z[out] = apply(calibrate(parts[~out], happened[~out], prior)[0], judged[out])
    return z


def allowed(z, happened, taus):
    """Whether 95 % limits with each tau allow the count of a group, of cases with a common normal shift."""
    p = logistic(z + np.multiply.outer(taus, NODES)[..., None])
    share = np.eye(1, len(z) + 1) * np.ones((*p.shape[:2], 1))
    for k in range(len(z)):
        share = share * (1 - p[..., k, None]) + np.roll(share, 1, axis=-1) * p[..., k, None]
    within = np.average(share, axis=1, weights=WEIGHTS).cumsum(axis=1)
    below = within[:, happened.sum() - 1] if happened.any() else 0.0
    return (below < 0.975) & (within[:, happened.sum()] > 0.025)
