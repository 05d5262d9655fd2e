"""SciPy's limits of lognormal samples: python capacities.py tests/reference/fits

Writes capacities.csv: samples of overturning intensities, and the median and dispersion with their 95 % limits by Student's t
and chi squared. Needs numpy and scipy.
"""

import csv
import pathlib
import sys

import numpy as np
from scipy import stats

samples = {
    "few": [0.7, 1.1, 1.3, 2.9],
    "thirteen": np.round(np.exp(0.4 * np.random.default_rng(13).standard_normal(13)), 4).tolist(),
    "many": np.round(np.exp(0.3 * np.random.default_rng(200).standard_normal(200)), 4).tolist(),
}
with open(pathlib.Path(sys.argv[1]) / "capacities.csv", "w", newline="") as file:
    rows = csv.writer(file, lineterminator="\n")
    rows.writerow(["sample", "theta", "theta_low", "theta_high", "beta", "beta_low", "beta_high", "capacities"])
    for name, capacities in samples.items():
        logs = np.log(capacities)
        n, mean, sd = len(logs), logs.mean(), logs.std(ddof=1)
        theta = stats.t(n - 1, mean, sd / np.sqrt(n)).ppf([0.025, 0.975])
        beta = sd * np.sqrt((n - 1) / stats.chi2(n - 1).ppf([0.975, 0.025]))
        rows.writerow([name, *map(repr, map(float, [np.exp(mean), *np.exp(theta), sd, *beta])), " ".join(map(str, capacities))])
