"""Other programs' answers for the ranking of intensity measures: python ranking.py tests/reference/fits

Reads cases.csv (of fits.py; 20 rows make a cell, and cell c falls into fold c mod 10) and writes
ranking_answers.csv. The measures are im4 = exp(x) and im3 = exp(y); the demand breaks at IM4 = 1.3. Needs
numpy, scipy and statsmodels.
"""

import pathlib
import sys

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy import stats

LN_LIMIT, LN_BREAK, FOLDS = np.log(0.1), np.log(1.3), 10

folder = pathlib.Path(sys.argv[1])
x, y, demand, event = np.loadtxt(folder / "cases.csv", delimiter=",", skiprows=1).T
n = len(x)
cell = np.arange(n) // 20
fold = cell % FOLDS
exceeded = (demand > LN_LIMIT).astype(float)
everywhere = np.ones(n, dtype=bool)
answers = {}


def probit(design, outcome):
    family = sm.families.Binomial(link=sm.families.links.Probit())
    return sm.GLM(outcome, design, family=family).fit(tol=1e-15, maxiter=300, tol_criterion="params")


def curve(design, rows):
    fit = probit(design[rows], event[rows])
    index = design @ fit.params
    signed = np.where(event == 1, index, -index)
    return stats.norm.logcdf(signed), index, fit.llf, len(fit.params)


def law(design, rows, sides):
    score, index, log_likelihood = np.full(n, np.nan), np.full(n, np.nan), 0.0
    for side in sides:
        fit = sm.OLS(demand[rows & side], design[rows & side]).fit()
        mean, sd = design[side] @ fit.params, np.sqrt(fit.scale)
        score[side] = stats.norm.logpdf(demand[side], mean, sd)
        index[side] = (mean - LN_LIMIT) / sd
        log_likelihood += fit.llf
    # Coefficients and a variance of each side, and the break.
    return score, index, log_likelihood, len(sides) * (design.shape[1] + 1) + len(sides) - 1


def skill(key, index, outcome):
    u = stats.mannwhitneyu(index[outcome == 1], index[outcome == 0]).statistic
    answers[f"{key}_auc"] = u / (outcome.sum() * (1 - outcome).sum())
    answers[f"{key}_brier"] = np.mean((stats.norm.cdf(index) - outcome) ** 2)


def rate(key, forecast, outcome):
    score, index, log_likelihood, parameters = forecast(everywhere)
    answers[f"{key}_llf"] = log_likelihood
    answers[f"{key}_aic"] = 2 * parameters - 2 * log_likelihood
    answers[f"{key}_bic"] = parameters * np.log(n) - 2 * log_likelihood
    skill(f"{key}_fitted", index, outcome)
    for left_out in range(FOLDS):
        rows = fold == left_out
        of_fold = forecast(~rows)
        score[rows], index[rows] = of_fold[0][rows], of_fold[1][rows]
    answers[f"{key}_log_score"] = score.mean()
    skill(f"{key}_unseen", index, outcome)
    calibration = probit(sm.add_constant(index), outcome)
    answers[f"{key}_intercept"], answers[f"{key}_slope"] = calibration.params
    return score


one, low = [everywhere], x < LN_BREAK
designs = {"im4": sm.add_constant(x), "im4:im3": sm.add_constant(np.column_stack([x, y]))}
scores = {}
for name, design in designs.items():
    scores[f"p_ro_{name}_single"] = rate(f"p_ro_{name}_single", lambda rows: curve(design, rows), event)
    for form, sides in {"single": one, "broken": [low, ~low]}.items():
        key = f"p_ex_{name}_{form}"
        scores[key] = rate(key, lambda rows: law(design, rows, sides), exceeded)

# The mean difference of two scores and its cluster-robust error: a regression on a constant.
for better, worse in [("p_ro_im4:im3_single", "p_ro_im4_single"), ("p_ex_im4_broken", "p_ex_im4:im3_broken")]:
    fit = sm.OLS(scores[better] - scores[worse], np.ones(n))
    clustered = fit.fit(cov_type="cluster", cov_kwds={"groups": cell})
    answers[f"{better}_over"], answers[f"{better}_se"] = clustered.params[0], clustered.bse[0]

pd.Series(answers, name="value").to_csv(folder / "ranking_answers.csv", index_label="name")
