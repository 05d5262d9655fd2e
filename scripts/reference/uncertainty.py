"""Other programs' answers for links, errors, limits and tests: python uncertainty.py tests/reference/fits

Reads cases.csv (of fits.py; 20 rows make a cell) and writes uncertainty_answers.csv (each number), smooth.csv (cases of a
smooth transition) and bootstrap_distribution.csv (the replicates behind the BCa limits). Needs numpy, scipy, statsmodels, pyFragility, firthmodels
and mpmath.
"""

import csv
import pathlib
import sys

import numpy as np
import pyFragility as pf
import statsmodels.api as sm
from firthmodels import FirthLogisticRegression
from mpmath import mp
from scipy import optimize, stats
from scipy.interpolate import CubicSpline
from statsmodels.stats.diagnostic import linear_reset
from statsmodels.stats.diagnostic_gen import test_chisquare_binning

folder = pathlib.Path(sys.argv[1])
x, y, demand, event = np.loadtxt(folder / "cases.csv", delimiter=",", skiprows=1).T
n = len(x)
cell = np.arange(n) // 20
designs = {"x": sm.add_constant(x), "xy": sm.add_constant(np.column_stack([x, y]))}
families = sm.families.links
links = {"probit": families.Probit(), "logit": families.Logit(), "cloglog": families.CLogLog()}
answers = {}


def glm(link, design, outcome, **options):
    model = sm.GLM(outcome, design, family=sm.families.Binomial(link=links[link]), **options)
    return model.fit(tol=1e-15, maxiter=300, tol_criterion="params")


# Each link: coefficients, observed-information and clustered errors, Hosmer-Lemeshow.
for link in links:
    for name, design in designs.items():
        key, fit = f"{link}_{name}", glm(link, design, event)
        observed = np.linalg.inv(-fit.model.hessian(fit.params, observed=True))
        im = np.exp(design[:, 1:])
        other = pf.fit_binomial(im, event, np.ones(n), link=link, parametrization="glm", cluster=cell)
        assert np.allclose(other.params, fit.params, rtol=1e-7)
        clustered = np.sqrt(np.diag(other.covariance("sandwich", small_sample=True)))
        for k in range(design.shape[1]):
            answers[f"{key}_b{k}"] = fit.params[k]
            answers[f"{key}_se{k}"] = np.sqrt(observed[k, k])
            answers[f"{key}_clustered{k}"] = clustered[k]
        answers[f"{key}_llf"] = fit.llf
        both = np.column_stack([event, 1 - event])
        expected = np.column_stack([fit.fittedvalues, 1 - fit.fittedvalues])
        test = test_chisquare_binning(both, expected, sort_var=fit.fittedvalues, bins=10, sort_method="stable")
        answers[f"{key}_hosmer_lemeshow"], answers[f"{key}_hosmer_lemeshow_p"] = test.statistic, test.pvalue

# A regression and its curve with other weights: row k counts (k^2 + 1) mod 3 times.
weights = (np.arange(n) ** 2 + 1) % 3
for name, design in designs.items():
    repeated = np.repeat(np.arange(n), weights)
    for k, b in enumerate(glm("probit", design[repeated], event[repeated]).params):
        answers[f"weighted_probit_{name}_b{k}"] = b
    ols = sm.OLS(demand[repeated], design[repeated]).fit()
    for k, b in enumerate(ols.params):
        answers[f"weighted_ols_{name}_b{k}"] = b
    answers[f"weighted_ols_{name}_sd"] = np.sqrt(ols.mse_resid)

# Least squares: clustered errors, and Ramsey's test with squares and cubes.
for name, design in designs.items():
    ols = sm.OLS(demand, design).fit()
    robust = ols.get_robustcov_results("cluster", groups=cell)
    for k in range(design.shape[1]):
        answers[f"ols_{name}_clustered{k}"] = robust.bse[k]
    each_alone = ols.get_robustcov_results("HC1")
    answers[f"ols_{name}_hc1_1"] = each_alone.bse[1]
    reset = linear_reset(ols, power=3, test_type="fitted", use_f=True)
    answers[f"ols_{name}_reset"], answers[f"ols_{name}_reset_p"] = reset.fvalue, reset.pvalue

# A natural cubic spline with knots at quantiles, straight beyond the outer ones, and an interaction.
knots = np.quantile(x, [0.05, 0.35, 0.65, 0.95])
cubic = CubicSpline(knots, np.eye(4), bc_type="natural")
inside = np.clip(x, knots[0], knots[-1])
basis = cubic(inside) + (x - inside)[:, None] * cubic(inside, 1)
answers["spline_llf"] = glm("probit", basis, event).llf
answers["spline_xy_llf"] = glm("probit", np.column_stack([basis, y]), event).llf
answers["interaction_llf"] = glm("probit", sm.add_constant(np.column_stack([x, y, x * y])), event).llf
for name, quantile in [("chi_squared", stats.chi2.sf(7.3, 5)), ("chi_squared_even", stats.chi2.sf(21.4, 8))]:
    answers[name] = quantile
answers["f"] = stats.f.sf(4.2, 2, 37)

# Profile-likelihood limits of the median and the dispersion.
for name, rows in [("all", slice(None)), ("few", slice(0, 60))]:
    curve = pf.fit_binomial(np.exp(x[rows]), event[rows], np.ones(len(x[rows])))
    for parameter in ["theta", "beta"]:
        answers[f"profile_{name}_{parameter}"] = curve.params[list(curve.param_names).index(parameter)]
        low, high = curve.profile_interval(parameter)
        answers[f"profile_{name}_{parameter}_low"], answers[f"profile_{name}_{parameter}_high"] = low, high


# Firth: logistic by firthmodels; the other links from the penalised likelihood as it is written, with 30 digits.
mp.dps = 30
distributions = {
    "probit": lambda z: (mp.ncdf(z), mp.ncdf(-z), mp.npdf(z)),
    "cloglog": lambda z: (-mp.expm1(-mp.exp(z)), mp.exp(-mp.exp(z)), mp.exp(z - mp.exp(z))),
}


def penalised(b, link, design, outcome):
    value, information = mp.mpf(0), mp.zeros(len(b))
    for row, happened in zip(design, outcome):
        z = sum(mp.mpf(float(x)) * b for x, b in zip(row, b))
        p, q, f = distributions[link](z)
        value += mp.log(p if happened else q)
        information += mp.matrix(row) * mp.matrix(row).T * (f * f / (p * q))
    return value + mp.log(mp.det(information)) / 2


def firth(link, design, outcome):
    k, h = design.shape[1], mp.mpf(10) ** -7
    unit = [mp.matrix([h if i == j else 0 for i in range(k)]) for j in range(k)]
    value = lambda b: penalised(b, link, design, outcome)
    rough = optimize.minimize(lambda b: -float(value(mp.matrix(b))), np.zeros(k), method="Nelder-Mead", options={"xatol": 1e-3})
    b = mp.matrix(rough.x)
    for _ in range(60):
        gradient = mp.matrix([(value(b + e) - value(b - e)) / (2 * h) for e in unit])
        second = lambda e, f: (value(b + e + f) - value(b + e - f) - value(b - e + f) + value(b - e - f)) / (4 * h * h)
        step = mp.lu_solve(mp.matrix([[-second(e, f) for f in unit] for e in unit]), gradient)
        b += step
        if mp.norm(step) < 1e-13:
            return [float(v) for v in b]
    raise RuntimeError("no maximum")


few, parted = slice(0, 60), x[:30] > 0.4
sets = {"few": (designs["xy"][few], event[few]), "parted": (designs["x"][:30], parted.astype(float))}
for name, (design, outcome) in sets.items():
    logistic = FirthLogisticRegression(max_iter=1000, gtol=1e-12, xtol=1e-12, backend="numpy").fit(design[:, 1:], outcome)
    limits = np.roll(logistic.conf_int(0.05, method="pl", max_iter=1000, tol=1e-9), 1, axis=0)
    coefficients = np.append(logistic.intercept_, logistic.coef_)
    # Its own errors take the information of the augmented data; Heinze and Schemper's, and ours, that of the data.
    p = 1 / (1 + np.exp(-design @ coefficients))
    errors = np.sqrt(np.diag(np.linalg.inv((design * (p * (1 - p))[:, None]).T @ design)))
    for k in range(design.shape[1]):
        answers[f"firth_logit_{name}_b{k}"] = coefficients[k]
        answers[f"firth_logit_{name}_se{k}"] = errors[k]
        answers[f"firth_logit_{name}_low{k}"], answers[f"firth_logit_{name}_high{k}"] = limits[k]
    answers[f"firth_logit_{name}_penalised"] = logistic.loglik_
    for link in ["probit", "cloglog"]:
        for k, b in enumerate(firth(link, design, outcome)):
            answers[f"firth_{link}_{name}_b{k}"] = b

# Two planes that pass into one another, by scipy: 600 cases of a known transition.
random = np.random.default_rng(21)
ln_im4, ln_im3 = random.uniform(0.0, 1.0, 600), random.normal(0.0, 0.3, 600)


def planes(p):
    share = 1 - np.exp(-ln_im4 / p[6])
    return (1 - share) * (p[0] + p[1] * ln_im4 + p[2] * ln_im3) + share * (p[3] + p[4] * ln_im4 + p[5] * ln_im3)


truth = [-8, 15, -2, -1.5, 1.5, -1, 0.15]
ln_edp = planes(truth) + random.normal(0, 0.4, 600)
best = optimize.least_squares(lambda p: planes(p) - ln_edp, truth, x_scale="jac", jac="3-point", xtol=1e-15, ftol=1e-15, gtol=1e-15)
covariance = np.linalg.inv(best.jac.T @ best.jac) * 2 * best.cost / (600 - 7)
for k, name in enumerate(["low0", "low1", "low2", "high0", "high1", "high2", "width"]):
    answers[f"smooth_{name}"], answers[f"smooth_se_{name}"] = best.x[k], np.sqrt(covariance[k, k])
answers["smooth_rss"] = 2 * best.cost
with open(folder / "smooth.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["ln_im4", "ln_im3", "ln_edp"])
    writer.writerows([repr(float(v)) for v in row] for row in zip(ln_im4, ln_im3, ln_edp))

# BCa limits of the slope of the regression and of mu of the curve, resampled within cells.
rows = tuple(np.flatnonzero(cell == c) for c in np.unique(cell))


def slope(*parts):
    chosen = np.concatenate([part.ravel() for part in parts]).astype(int)
    return np.linalg.lstsq(designs["x"][chosen], demand[chosen], rcond=None)[0][1]


def mu(*parts):
    chosen = np.concatenate([part.ravel() for part in parts]).astype(int)
    b = glm("probit", designs["x"][chosen], event[chosen]).params
    return -b[0] / b[1]


replicates_of = {}
for name, statistic, replicates in [("slope", slope, 999), ("mu", mu, 199)]:
    result = stats.bootstrap(rows, statistic, vectorized=False, n_resamples=replicates, method="BCa", rng=np.random.default_rng(4))
    replicates_of[name] = result.bootstrap_distribution
    answers[f"bca_{name}_low"], answers[f"bca_{name}_high"] = result.confidence_interval
    result = stats.bootstrap(rows, statistic, vectorized=False, n_resamples=0, method="percentile", bootstrap_result=result)
    answers[f"percentile_{name}_low"], answers[f"percentile_{name}_high"] = result.confidence_interval
    answers[f"bootstrap_{name}_error"] = result.standard_error

with open(folder / "uncertainty_answers.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["name", "value"])
    writer.writerows([name, repr(float(value))] for name, value in answers.items())
with open(folder / "bootstrap_distribution.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["statistic", "value"])
    writer.writerows([name, repr(float(v))] for name, values in replicates_of.items() for v in values)
