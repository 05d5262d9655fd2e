"""Other programs' answers for clustered errors and tests: python uncertainty.py tests/reference/fits

Reads cases.csv (of fits.py; 20 rows make a cell) and writes uncertainty_answers.csv. Needs numpy, scipy, statsmodels and pyFragility.
"""

import csv
import pathlib
import sys

import numpy as np
import pyFragility as pf
import statsmodels.api as sm
from scipy import stats

folder = pathlib.Path(sys.argv[1])
x, y, demand, event = np.loadtxt(folder / "cases.csv", delimiter=",", skiprows=1).T
n = len(x)
cell = np.arange(n) // 20
squares = {"x": [x * x], "xy": [x * x, y * y, x * y]}
answers = {}


def probit(design):
    family = sm.families.Binomial(link=sm.families.links.Probit())
    return sm.GLM(event, design, family=family).fit(tol=1e-15, maxiter=300, tol_criterion="params")


for name, columns in {"x": [x], "xy": [x, y]}.items():
    design = sm.add_constant(np.column_stack(columns))
    wider = np.column_stack([design, *squares[name]])
    # Curves: clustered errors, and the likelihood-ratio test of squares and products.
    fit = probit(design)
    other = pf.fit_binomial(np.exp(design[:, 1:]), event, np.ones(n), link="probit", parametrization="glm", cluster=cell)
    assert np.allclose(other.params, fit.params, rtol=1e-7)
    for k, error in enumerate(np.sqrt(np.diag(other.covariance("sandwich", small_sample=True)))):
        answers[f"probit_{name}_clustered{k}"] = error
    answers[f"probit_{name}_misfit_p"] = stats.chi2.sf(2 * (probit(wider).llf - fit.llf), len(squares[name]))
    # Least squares: the same, and errors of cases that are clusters of their own.
    ols = sm.OLS(demand, design).fit()
    for k, error in enumerate(ols.get_robustcov_results("cluster", groups=cell).bse):
        answers[f"ols_{name}_clustered{k}"] = error
    answers[f"ols_{name}_hc1_1"] = ols.get_robustcov_results("HC1").bse[1]
    answers[f"ols_{name}_misfit_p"] = sm.OLS(demand, wider).fit().compare_f_test(ols)[1]

for name, tail in [("chi_squared", stats.chi2.sf(7.3, 5)), ("chi_squared_even", stats.chi2.sf(21.4, 8))]:
    answers[name] = tail
answers["f"] = stats.f.sf(4.2, 2, 37)

with open(folder / "uncertainty_answers.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["name", "value"])
    writer.writerows([name, repr(float(value))] for name, value in answers.items())
