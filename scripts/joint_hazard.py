"""Makes data/hazard_sa.csv, an example, from data/hazard.csv: python joint_hazard.py data

PGV/PGA is lognormal: median 0.10 s, standard deviation of ln 0.5. SA(1.0 s) is exceeded as often as the PGV that it
stands for: PGV = SA(1.0 s) 1 s / (2 pi) / 1.65 (Newmark & Hall 1982).
"""

import pathlib
import sys

import numpy as np
from scipy.stats import norm

MEDIAN_S, SIGMA = 0.10, 0.5
SA_G = np.array([0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0])
HEAD = """\
# An example, of the site of hazard.csv: annual rates at which a spectral acceleration at 1 s is exceeded.
# scripts/joint_hazard.py makes it.
SA(1.0) (g),annual_rate_of_exceedance
"""
data = pathlib.Path(sys.argv[1])
curve = np.loadtxt(data / "hazard.csv", delimiter=",", skiprows=2)
levels = np.geomspace(curve[0, 0], curve[-1, 0], int(100 * np.log(curve[-1, 0] / curve[0, 0])) + 1)
# Linear between the points of the curve in the logarithms of both.
rates = -np.diff(np.exp(np.interp(np.log(levels), *np.log(curve).T)), append=0)
pga = np.append(np.sqrt(levels[1:] * levels[:-1]), levels[-1])
with open(data / "hazard_sa.csv", "w") as file:
    file.write(HEAD)
    for sa, pgv in zip(SA_G, SA_G * 9.81 / (2 * np.pi) / 1.65):
        file.write(f"{sa},{norm.cdf(np.log(pga * 9.81 * MEDIAN_S / pgv) / SIGMA) @ rates:.3e}\n")
