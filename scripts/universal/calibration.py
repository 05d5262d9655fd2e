"""logit P = c + s L + m (M - 6.9) + what is added near uplift: c, ln s and m by maximum a posteriori, their
covariance and tau. L, M - 6.9 and what is added are `parts` of n cases (Surface.parts)."""

import numpy as np
from scipy.optimize import minimize_scalar

LEAST_CLUSTERS = 10
NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(15)


def logistic(z):
    return 1.0 / (1.0 + np.exp(-np.clip(z, -500, 500)))


def apply(b, parts):
    logit, magnitude, added = parts
    return b[0] + np.exp(b[1]) * logit + b[2] * magnitude + added


def derivatives(b, parts, happened, prior):
    """Returns the negative log posterior, its gradient and Hessian, and the scores of the cases (n x 3)."""
    logit, magnitude, added = parts
    slope, away, precision = np.exp(b[1]) * logit, b - prior[:3], 1.0 / np.square(prior[3:6])
    z = b[0] + slope + b[2] * magnitude + added
    p, tangent = logistic(z), np.stack([np.ones_like(z), slope, magnitude], axis=1)
    loss = (np.logaddexp(0, z) - happened * z).sum() + 0.5 * (precision * away) @ away
    scores = tangent * (p - happened)[:, None]
    hessian = tangent.T @ (tangent * (p * (1 - p))[:, None]) + np.diag(precision)
    hessian[1, 1] += scores[:, 1].sum()
    return loss, scores.sum(axis=0) + precision * away, hessian, scores


def cluster_sums(values, clusters):
    """Sums of the rows of each of G clusters: G x k."""
    _, at = np.unique(clusters, return_inverse=True)
    return np.stack([np.bincount(at, column) for column in values.T], axis=1)


def calibrate(parts, happened, prior, clusters=None):
    """Returns (c, ln s, m) and their covariance: the inverse Hessian H^-1 of the posterior; of ten clusters
    or more H^-1 (M + P) H^-1, M = G/(G-1) (n-1)/(n-3) times the sum over the G clusters of u u', u the sum
    of the scores of their cases, n in all, P the precision of the prior (without data the covariance is
    that of the prior)."""
    prior, happened = np.array(prior, dtype=float), happened.astype(float)
    b = prior[:3].copy()
    for _ in range(100):
        loss, gradient, hessian, scores = derivatives(b, parts, happened, prior)
        if np.abs(gradient).max() < 1e-9:
            break
        values, vectors = np.linalg.eigh(hessian)
        step = -vectors @ (vectors.T @ gradient / np.maximum(np.abs(values), 1e-3))
        size = min(1.0, 2.0 / np.abs(step).max())
        while derivatives(b + size * step, parts, happened, prior)[0] > loss and size > 1e-9:
            size /= 2
        b = b + size * step
    covariance = np.linalg.inv(hessian)
    if clusters is not None and len(sums := cluster_sums(scores, clusters)) >= LEAST_CLUSTERS:
        g, n = len(sums), len(happened)
        meat = g / (g - 1) * (n - 1) / (n - 3) * sums.T @ sums + np.diag(1.0 / np.square(prior[3:6]))
        covariance = covariance @ meat @ covariance
    return b, covariance


def spread(groups, mean):
    """Standard deviations of c, ln s and m between groups, each (parts, happened): by
    expectation-maximisation, where the posterior of a group is normal about its maximum."""
    sd, last = np.array([0.5, 0.15, 0.3]), np.zeros(3)
    while np.abs(sd - last).max() > 0.002:
        fits = [calibrate(parts, happened, (*mean, *sd)) for parts, happened in groups]
        sd, last = np.sqrt(np.mean([(b - mean) ** 2 + np.diag(v) for b, v in fits], axis=0)), sd
    return sd


def between(logit, happened, clusters):
    """tau: the standard deviation of the calibrated logit between clusters, by maximum likelihood."""

    def loss(tau):
        shifted = logit[:, None] + tau * NODES
        each = -np.logaddexp(0, np.where(happened[:, None], -shifted, shifted))
        each = cluster_sums(each, clusters) + np.log(WEIGHTS)
        largest = each.max(axis=1, keepdims=True)
        return -(largest[:, 0] + np.log(np.exp(each - largest).sum(axis=1))).sum()

    return minimize_scalar(loss, bounds=(0.0, 3.0), method="bounded").x
