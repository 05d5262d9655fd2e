"""Bent curves by statsmodels, for tests/fits/bent.rs: python bent.py CASES.csv ANSWERS.csv

Cases whose index bends and whose cells differ. Answers: the index of each case with its clustered standard error by statsmodels (a probit on
patsy's natural splines and the product, without the small penalty), the same by scipy with the penalty; and of indices that are given the
standard deviation between cells of greatest likelihood, by adaptive quadrature.
"""

import sys

import numpy as np
import patsy
import statsmodels.api as sm
from scipy.integrate import quad
from scipy.optimize import minimize, minimize_scalar
from scipy.special import log_ndtr

PENALTY = 0.1
rng = np.random.default_rng(17)
cells, each = 24, 50
cell = np.repeat(np.arange(cells), each)
x = rng.uniform(0.0, 1.6, cells * each)
y = -0.9 + 0.5 * rng.standard_normal(cells * each)
shift = 0.4 * rng.standard_normal(cells)
true = -1.0 + 4.5 * x - 2.0 * x * x + 1.6 * y + shift[cell]
event = rng.standard_normal(len(x)) < true

knots = [np.quantile(v, [0.1, 0.5, 0.9]) for v in (x, y)]


def spline(u, knots):
    a, b, c = knots
    cube = lambda k: np.where(u > k, u - k, 0.0) ** 3
    return (cube(a) - cube(b) * (c - a) / (c - b) + cube(c) * (b - a) / (c - b)) / (c - a) ** 2


design = np.stack([np.ones_like(x), x, y, spline(x, knots[0]), spline(y, knots[1]), x * y], axis=1)
centred = (x - x.mean()) * (y - y.mean())
penalty = PENALTY * np.array([0, 0, 0, design[:, 3].var(), design[:, 4].var(), centred.var()])
sign = np.where(event, 1.0, -1.0)
loss = lambda b: -log_ndtr(sign * (design @ b)).sum() + 0.5 * (penalty * b * b).sum()
start = sm.Probit(event, design[:, :3]).fit(disp=0).params
best = minimize(loss, np.r_[start, 0, 0, 0], method="BFGS", options={"gtol": 1e-9})
best = minimize(loss, best.x, method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-13, "maxiter": 40000, "maxfev": 40000})

bases = [patsy.dmatrix(f"cr(v, knots=[{k[1]}], lower_bound={k[0]}, upper_bound={k[2]}) - 1", {"v": np.clip(v, k[0], k[2])}) for v, k in ((x, knots[0]), (y, knots[1]))]
# patsy refuses values outside of its bounds: of the same space is a line, and the cubic function that is straight outside.
whole = sm.GLM(event.astype(float), design, family=sm.families.Binomial(sm.families.links.Probit()))
fitted = whole.fit(cov_type="cluster", cov_kwds={"groups": cell, "use_correction": True})
inside = [np.linalg.lstsq(basis, spline(np.clip(v, k[0], k[2]), k), rcond=None) for basis, v, k in zip(bases, (x, y), knots)]
assert all(np.abs(basis @ b - spline(np.clip(v, k[0], k[2]), k)).max() < 1e-10 for basis, (b, *_), v, k in zip(bases, inside, (x, y), knots))
error = np.sqrt(np.einsum("ij,jk,ik->i", design, fitted.cov_params(), design))

given = -1.0 + 4.5 * x - 2.0 * x * x + 1.6 * y


def likelihood(spread):
    total = 0.0
    for k in range(cells):
        here = cell == k
        each_shift = lambda u: np.exp(log_ndtr(sign[here] * (given[here] + u)).sum() + 30.0) * np.exp(-0.5 * (u / spread) ** 2) / spread
        total += np.log(quad(each_shift, -4, 4, limit=200)[0])
    return -total


spread = minimize_scalar(likelihood, bounds=(0.05, 1.5), method="bounded").x
np.savetxt(sys.argv[1], np.stack([np.exp(x), np.exp(-y), cell, event, given], axis=1), delimiter=",", header="im4,im3,cell,overturned,given", comments="", fmt="%.12g")
answers = np.stack([design @ best.x, fitted.params @ design.T, error, np.full(len(x), spread)], axis=1)
np.savetxt(sys.argv[2], answers[::10], delimiter=",", header="index,unpenalised,standard_error,spread", comments="", fmt="%.10g")
print("spread", spread, "largest effect of the penalty", np.abs(answers[:, 0] - answers[:, 1]).max())
