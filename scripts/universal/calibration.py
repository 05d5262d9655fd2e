"""logit P = c + s L, L the logit of the surface: c and ln s by maximum a posteriori, their covariance and tau."""

import numpy as np
from scipy.optimize import minimize_scalar

LEAST_CLUSTERS = 10
NODES, WEIGHTS = np.polynomial.hermite_e.hermegauss(15)


def logistic(z):
    return 1.0 / (1.0 + np.exp(-np.clip(z, -500, 500)))


def derivatives(b, logit, happened, prior):
    """Returns the negative log posterior, its gradient and Hessian, and the scores of the cases (n x 2)."""
    c0, ln_s0, sd_c, sd_ln_s = prior
    s_logit = np.exp(b[1]) * logit
    z = b[0] + s_logit
    p, away, weight = logistic(z), b - [c0, ln_s0], 1.0 / np.square([sd_c, sd_ln_s])
    loss = (np.logaddexp(0, z) - happened * z).sum() + 0.5 * (weight * away) @ away
    tangent = np.stack([np.ones_like(z), s_logit], axis=1)
    scores = tangent * (p - happened)[:, None]
    hessian = tangent.T @ (tangent * (p * (1 - p))[:, None]) + np.diag(weight)
    hessian[1, 1] += (s_logit * (p - happened)).sum()
    return loss, scores.sum(axis=0) + weight * away, hessian, scores


def calibrate(logit, happened, prior, clusters=None):
    """Returns (c, ln s) and their covariance: the inverse Hessian H^-1 of the posterior; of ten clusters or more
    H^-1 (M + P) H^-1, M = G/(G-1) (n-1)/(n-2) times the sum over the G clusters of u u', u the sum of the scores of their
    n cases in all, P the precision of the prior (so that without any information the covariance is that of the prior)."""
    b = np.array(prior[:2], dtype=float)
    happened = happened.astype(float)
    for _ in range(100):
        loss, gradient, hessian, scores = derivatives(b, logit, happened, prior)
        if np.abs(gradient).max() < 1e-9:
            break
        values, vectors = np.linalg.eigh(hessian)
        step = -vectors @ (vectors.T @ gradient / np.maximum(np.abs(values), 1e-3))
        size = min(1.0, 2.0 / np.abs(step).max())
        while derivatives(b + size * step, logit, happened, prior)[0] > loss and size > 1e-9:
            size /= 2
        b = b + size * step
    covariance = np.linalg.inv(hessian)
    if clusters is not None:
        _, at = np.unique(clusters, return_inverse=True)
        n, of = len(logit), at.max(initial=-1) + 1
        if of >= LEAST_CLUSTERS:
            sums = np.stack([np.bincount(at, column, of) for column in scores.T], axis=1)
            precision = np.diag(1.0 / np.square(prior[2:4]))
            meat = of / (of - 1) * (n - 1) / (n - 2) * sums.T @ sums + precision
            covariance = covariance @ meat @ covariance
    return b, covariance


def apply(b, logit):
    return b[0] + np.exp(b[1]) * logit


def standard_error(b, covariance, logit):
    """Of the calibrated logit, without tau."""
    tangent = np.stack([np.ones_like(logit), np.exp(b[1]) * logit], axis=1)
    return np.sqrt(np.einsum("ni,ij,nj->n", tangent, covariance, tangent))


def spread(groups, mean, start=(0.5, 0.15)):
    """Standard deviations of c and ln s between groups, each (logits, happened): by expectation-maximisation, where the
    posterior of a group is normal about its maximum."""
    sd = np.array(start)
    for _ in range(30):
        fits = [calibrate(logit, happened, (*mean, *sd)) for logit, happened in groups]
        new = np.sqrt(np.mean([(b - mean) ** 2 + np.diag(v) for b, v in fits], axis=0))
        done = np.abs(new - sd).max() < 0.002
        sd = new
        if done:
            break
    return sd


def between(logit, happened, clusters):
    """tau: the standard deviation of the logit between clusters, by maximum likelihood (logit is the calibrated one)."""
    _, at = np.unique(clusters, return_inverse=True)

    def loss(tau):
        each = [np.bincount(at, -np.logaddexp(0, np.where(happened, -1, 1) * (logit + tau * node))) for node in NODES]
        each = np.stack(each, axis=1) + np.log(WEIGHTS)
        largest = each.max(axis=1, keepdims=True)
        return -(largest[:, 0] + np.log(np.exp(each - largest).sum(axis=1))).sum()

    return minimize_scalar(loss, bounds=(0.0, 3.0), method="bounded").x
