"""Data for the fits and the scores of measures, and other programs' answers: python fits.py
core/tests/reference/fits

cases.csv has two measures, a demand and an event, 20 rows a cell; nearly_separated.csv classes that barely
overlap; capacities.csv overturning intensities, and the limits of their median and dispersion by Student's t
and chi squared. In the scores the measures are im4 = exp(x) and im3 = exp(y), cell c falls into fold c mod
10, and the demand breaks at IM4 = 1.3. Needs scipy, statsmodels and pyFragility.
"""

import pathlib
import sys

import numpy as np
import pandas as pd
import pyFragility as pf
import statsmodels.api as sm
from scipy import stats

folder = pathlib.Path(sys.argv[1])


def write(name, columns):
    pd.DataFrame(columns).to_csv(folder / name, index=False)


def write_answers(name, answers):
    pd.Series(answers, name="value").to_csv(folder / name, index_label="name")


def newton(event, design):
    return sm.Probit(event, design).fit(method="newton", tol=1e-14, maxiter=500, disp=0)


def scoring(event, design):
    family = sm.families.Binomial(link=sm.families.links.Probit())
    return sm.GLM(event, design, family=family).fit(tol=1e-15, maxiter=300, tol_criterion="params")


n = 400
random = np.random.default_rng(14)
x = random.normal(0.4, 0.5, n)
y = random.normal(-0.2, 0.4, n) + 0.3 * x
demand = -2.3 + 2.6 * x - 1.4 * y + random.normal(0, 0.8, n)
event = (1.5 * x - 1.0 * y - 1.0 + random.normal(0, 0.6, n) > 0).astype(int)
cell = np.arange(n) // 20
write("cases.csv", {"x": x, "y": y, "demand": demand, "event": event})

answers, of_clusters = {}, {}
for name, columns in [("x", [x]), ("xy", [x, y])]:
    design = sm.add_constant(np.column_stack(columns))
    ols, probit, fit = sm.OLS(demand, design).fit(), newton(event, design), scoring(event, design)
    for k, numbers in enumerate(zip(ols.params, ols.bse, *ols.conf_int(0.05).T)):
        answers |= dict(zip((f"ols_{name}_{what}{k}" for what in ("b", "se", "low", "high")), numbers))
    answers |= {f"ols_{name}_r2": ols.rsquared, f"ols_{name}_sd": np.sqrt(ols.mse_resid)}
    for k, (b, se) in enumerate(zip(probit.params, probit.bse)):
        answers |= {f"probit_{name}_b{k}": b, f"probit_{name}_se{k}": se}
    answers[f"probit_{name}_llf"] = probit.llf
    # Curves: clustered errors.
    options = {"link": "probit", "parametrization": "glm", "cluster": cell}
    other = pf.fit_binomial(np.exp(design[:, 1:]), event, np.ones(n), **options)
    assert np.allclose(other.params, fit.params, rtol=1e-7)
    errors = np.sqrt(np.diag(other.covariance("sandwich", small_sample=True)))
    of_clusters |= {f"probit_{name}_clustered{k}": error for k, error in enumerate(errors)}
    # Least squares: the same, and errors of cases that are clusters of their own.
    errors = ols.get_robustcov_results("cluster", groups=cell).bse
    of_clusters |= {f"ols_{name}_clustered{k}": error for k, error in enumerate(errors)}
    of_clusters[f"ols_{name}_hc1_1"] = ols.get_robustcov_results("HC1").bse[1]
write_answers("answers.csv", answers)
write_answers("uncertainty_answers.csv", of_clusters | {"f": stats.f.sf(4.2, 2, 37)})

LN_BREAK, FOLDS = np.log(1.3), 10
fold, scores = cell % FOLDS, {}


def curve(design, rows):
    """Log scores and indices of all cases by a fit to some."""
    index = design @ scoring(event[rows], design[rows]).params
    return stats.norm.logcdf(np.where(event == 1, index, -index)), index


def law(design, rows, sides):
    score = np.full(n, np.nan)
    for side in sides:
        fit = sm.OLS(demand[rows & side], design[rows & side]).fit()
        score[side] = stats.norm.logpdf(demand[side], design[side] @ fit.params, np.sqrt(fit.scale))
    return score


def left_out(forecast):
    """Of each case that by a fit to the other folds."""
    return np.array([forecast(fold != k) for k in range(FOLDS)])[fold, ..., np.arange(n)]


low = x < LN_BREAK
designs = {"im4": sm.add_constant(x), "im4:im3": sm.add_constant(np.column_stack([x, y]))}
for name, design in designs.items():
    score, index = left_out(lambda rows: curve(design, rows)).T
    area = stats.mannwhitneyu(index[event == 1], index[event == 0]).statistic / (event.sum() * (1 - event).sum())
    brier, line = np.mean((stats.norm.cdf(index) - event) ** 2), scoring(event, sm.add_constant(index)).params
    names = "log_score", "unseen_auc", "intercept", "slope", "unseen_brier"
    of_curve = zip(names, (score.mean(), area, *line, brier))
    scores |= {f"p_ro_{name}_single_{what}": number for what, number in of_curve}
    means = left_out(lambda rows: design @ sm.OLS(demand[rows], design[rows]).fit().params)
    scores[f"p_ex_{name}_single_slope"] = sm.OLS(demand, sm.add_constant(means)).fit().params[1]
    for form, sides in {"single": [low | ~low], "broken": [low, ~low]}.items():
        scores[f"p_ex_{name}_{form}_log_score"] = left_out(lambda rows: law(design, rows, sides)).mean()
write_answers("score_answers.csv", scores)

random = np.random.default_rng(15)
x, y = random.normal(0, 1, 300), random.normal(0, 1, 300)
event = (x + y + random.normal(0, 0.05, 300) > 0).astype(int)
write("nearly_separated.csv", {"x": x, "y": y, "event": event})
fit = newton(event, sm.add_constant(np.column_stack([x, y])))
b, se = ({f"{what}{k}": v for k, v in enumerate(of)} for what, of in [("b", fit.params), ("se", fit.bse)])
write_answers("nearly_separated_answers.csv", b | se | {"llf": fit.llf})

drawn = lambda sd, n: np.exp(sd * np.random.default_rng(n).standard_normal(n)).round(4).tolist()
samples, rows = {"few": [0.7, 1.1, 1.3, 2.9], "thirteen": drawn(0.4, 13), "many": drawn(0.3, 200)}, []
for name, capacities in samples.items():
    n, mean, sd = len(capacities), np.log(capacities).mean(), np.log(capacities).std(ddof=1)
    theta = np.exp([mean, *stats.t(n - 1, mean, sd / np.sqrt(n)).ppf([0.025, 0.975])])
    beta = sd * np.sqrt((n - 1) / stats.chi2(n - 1).ppf([0.975, 0.025]))
    rows.append([name, *theta, sd, *beta, " ".join(map(str, capacities))])
names = "sample theta theta_low theta_high beta beta_low beta_high capacities".split()
pd.DataFrame(rows, columns=names).to_csv(folder / "capacities.csv", index=False)
