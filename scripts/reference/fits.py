"""Data for the fits and statsmodels' answers: python fits.py tests/reference/fits

Writes cases.csv (two measures, a demand, an event) and answers.csv (each number that statsmodels gives). Needs numpy and
statsmodels.
"""

import csv
import pathlib
import sys

import numpy as np
import statsmodels.api as sm

folder = pathlib.Path(sys.argv[1])
random = np.random.default_rng(14)
n = 400
x = random.normal(0.4, 0.5, n)
y = random.normal(-0.2, 0.4, n) + 0.3 * x
demand = -2.3 + 2.6 * x - 1.4 * y + random.normal(0, 0.8, n)
event = (1.5 * x - 1.0 * y - 1.0 + random.normal(0, 0.6, n) > 0).astype(int)

with open(folder / "cases.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["x", "y", "demand", "event"])
    writer.writerows([repr(float(a)), repr(float(b)), repr(float(d)), int(e)] for a, b, d, e in zip(x, y, demand, event))

answers = {}
for name, columns in [("x", [x]), ("xy", [x, y])]:
    design = sm.add_constant(np.column_stack(columns))
    ols = sm.OLS(demand, design).fit()
    limits = ols.conf_int(0.05)
    for k in range(design.shape[1]):
        answers[f"ols_{name}_b{k}"] = ols.params[k]
        answers[f"ols_{name}_se{k}"] = ols.bse[k]
        answers[f"ols_{name}_low{k}"] = limits[k][0]
        answers[f"ols_{name}_high{k}"] = limits[k][1]
    answers[f"ols_{name}_r2"] = ols.rsquared
    answers[f"ols_{name}_sd"] = np.sqrt(ols.mse_resid)
    probit = sm.Probit(event, design).fit(method="newton", tol=1e-14, maxiter=200, disp=0)
    for k in range(design.shape[1]):
        answers[f"probit_{name}_b{k}"] = probit.params[k]
        answers[f"probit_{name}_se{k}"] = probit.bse[k]
    answers[f"probit_{name}_llf"] = probit.llf
    answers[f"probit_{name}_aic"] = probit.aic
    answers[f"probit_{name}_bic"] = probit.bic

with open(folder / "answers.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["name", "value"])
    writer.writerows([name, repr(float(value))] for name, value in answers.items())

# Classes that barely overlap: the slope is steep and Newton's steps are long.
random = np.random.default_rng(15)
x = random.normal(0, 1, 300)
y = random.normal(0, 1, 300)
event = (x + y + random.normal(0, 0.05, 300) > 0).astype(int)
with open(folder / "nearly_separated.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["x", "y", "event"])
    writer.writerows([repr(float(a)), repr(float(b)), int(e)] for a, b, e in zip(x, y, event))
probit = sm.Probit(event, sm.add_constant(np.column_stack([x, y]))).fit(method="newton", tol=1e-14, maxiter=500, disp=0)
with open(folder / "nearly_separated_answers.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["name", "value"])
    writer.writerows([f"b{k}", repr(float(v))] for k, v in enumerate(probit.params))
    writer.writerows([f"se{k}", repr(float(v))] for k, v in enumerate(probit.bse))
    writer.writerow(["llf", repr(float(probit.llf))])
