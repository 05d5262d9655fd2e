"""Makes data/hazard_joint.csv and data/hazard_sa.csv, examples, from data/hazard.csv: python joint_hazard.py data

PGA in bins, in each PGV/PGA lognormal: median 0.10 s, standard deviation of ln 0.5. A bin is at its geometric
mean. SA(1.0 s) is exceeded as often as the PGV that it stands for: PGV = SA(1.0 s) 1 s / (2 pi) / 1.65
(Newmark & Hall 1982).
"""

import pathlib
import sys

import numpy as np
from scipy.stats import norm

MEDIAN_S, SIGMA = 0.10, 0.5
PGA_EDGES = np.array([0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0])
PGV_EDGES = np.linspace(-2.5, 2.5, 11)
SA_G = np.array([0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0])
JOINT = """\
# An example, of no real site: annual rates at which motions occur in bins of peak ground acceleration and velocity.
# scripts/joint_hazard.py makes it from data/hazard.csv.
pga_g,pgv_m_s,annual_rate_of_occurrence
"""
SPECTRAL = """\
# An example, of the site of hazard.csv: annual rates at which a spectral acceleration at 1 s is exceeded.
# scripts/joint_hazard.py makes it.
SA(1.0) (g),annual_rate_of_exceedance
"""
data = pathlib.Path(sys.argv[1])
curve = np.loadtxt(data / "hazard.csv", delimiter=",", skiprows=2)
# Linear between the points of the curve in the logarithms of both.
exceedance = lambda pga: np.exp(np.interp(np.log(pga), *np.log(curve).T))
levels = np.geomspace(curve[0, 0], curve[-1, 0], int(100 * np.log(curve[-1, 0] / curve[0, 0])) + 1)
rates, pga = -np.diff(exceedance(levels), append=0), np.append(np.sqrt(levels[1:] * levels[:-1]), levels[-1])
with open(data / "hazard_sa.csv", "w") as file:
    file.write(SPECTRAL)
    for sa, pgv in zip(SA_G, SA_G * 9.81 / (2 * np.pi) / 1.65):
        file.write(f"{sa},{norm.cdf(np.log(pga * 9.81 * MEDIAN_S / pgv) / SIGMA) @ rates:.3e}\n")
with open(data / "hazard_joint.csv", "w") as file:
    file.write(JOINT)
    shares, middles = np.diff(norm.cdf(PGV_EDGES)), (PGV_EDGES[1:] + PGV_EDGES[:-1]) / 2
    for low, high in zip(PGA_EDGES, PGA_EDGES[1:]):
        pga, rate = np.sqrt(low * high), exceedance(low) - exceedance(high)
        for middle, share in zip(middles, shares):
            file.write(f"{pga:.4g},{pga * 9.81 * MEDIAN_S * np.exp(SIGMA * middle):.4g},{rate * share:.4e}\n")
