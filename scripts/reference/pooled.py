"""Curves of several structures at once, by statsmodels: python pooled.py

Writes tests/reference/fits/pooled.csv, eight structures with fifty responses each, and pooled_answers.csv: the coefficients of
each pooled curve with errors clustered by structure, the log score of each structure by the curve of the other seven, and the
slope of a recalibration in log odds.
"""

import pathlib

import numpy as np
import pandas as pd
import statsmodels.api as sm
from scipy.stats import norm

LIMIT = 0.10
folder = pathlib.Path(__file__).parents[2] / "tests" / "reference" / "fits"

random = np.random.default_rng(2015)
rows = []
for k in range(8):
    ln_p, ln_alpha, eta = random.uniform(-1, 0.5), random.uniform(-1, 0.5), random.uniform(-0.12, 0.06)
    x, y = random.uniform(0.3, 2.0, 50), random.uniform(-1.0, 1.0, 50)
    index = -2.0 + 1.8 * x + 0.9 * y - 0.2 * x * x + 3 * eta + 0.2 * ln_p
    overturned = index + random.normal(size=50) > 0
    ln_edp = -4.0 + 1.6 * x + 0.8 * y + 2 * eta + 0.3 * ln_alpha + 0.6 * random.normal(size=50)
    for row in zip(x, y, overturned, ln_edp):
        rows.append((k, ln_p, ln_alpha, eta, np.exp(row[0]), np.exp(-row[1]), int(row[2]), np.exp(row[3])))
cases = pd.DataFrame(rows, columns=["structure", "ln_p", "ln_alpha", "eta", "im4", "im3", "overturned", "edp"])
cases.to_csv(folder / "pooled.csv", index=False)
cases = pd.read_csv(folder / "pooled.csv")


def design(cases, event, terms):
    x = np.log(cases.im4)
    y = np.log(cases.im3) * (1 if event == "exceeding" else -1)
    columns = [np.ones(len(x)), x, y]
    if terms != "line":
        columns += [x * x, x * y, y * y]
    if terms in ("restitution", "structure"):
        columns += [cases.eta]
    if terms == "structure":
        columns += [cases.ln_p, cases.ln_alpha]
    return np.column_stack(columns)


def fitted(event, cases, terms, **how):
    if event == "overturning":
        return sm.Probit(cases.overturned, design(cases, event, terms)).fit(disp=0, tol=1e-13, maxiter=200, **how)
    return sm.OLS(np.log(cases.edp), design(cases, event, terms)).fit(**how)


answers = []
for event in ["overturning", "exceeding"]:
    for terms in ["line", "curved", "restitution", "structure"]:
        counted = cases if event == "overturning" else cases[cases.overturned == 0]
        clusters = {"cov_type": "cluster", "cov_kwds": {"groups": counted.structure}}
        fit = fitted(event, counted, terms, **clusters)
        for k, (b, error) in enumerate(zip(fit.params, fit.bse)):
            answers.append((event, terms, f"coefficient {k}", b))
            answers.append((event, terms, f"error {k}", error))
        for k in range(8):
            others, left = counted[counted.structure != k], counted[counted.structure == k]
            refit = fitted(event, others, terms)
            index = design(left, event, terms) @ np.asarray(refit.params)
            if event == "overturning":
                happened = left.overturned == 1
            else:
                index = (index - np.log(LIMIT)) / np.sqrt(refit.scale)
                happened = left.edp > LIMIT
            answers.append((event, terms, f"log score {k}", norm.logcdf(np.where(happened, index, -index)).mean()))

index = -2.5 + 2.0 * np.log(cases.im4)
log_odds = norm.logcdf(index) - norm.logcdf(-index)
slope = sm.Logit(cases.overturned, sm.add_constant(log_odds)).fit(disp=0, tol=1e-13).params.iloc[1]
answers.append(("overturning", "", "slope", slope))
pd.DataFrame(answers, columns=["event", "terms", "quantity", "value"]).to_csv(folder / "pooled_answers.csv", index=False)
