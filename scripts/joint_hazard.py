"""Makes the example of a joint hazard from that of a hazard curve: python joint_hazard.py data/hazard.csv > data/hazard_joint.csv

PGA in bins, in each PGV/PGA lognormal: median 0.10 s, standard deviation of ln 0.5. A bin is at its geometric mean."""

import math
import sys
from statistics import NormalDist

MEDIAN_S, SIGMA = 0.10, 0.5
PGA_EDGES = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0]
PGV_EDGES = [-2.5 + 0.5 * k for k in range(11)]

rows = [line.split(",") for line in open(sys.argv[1]) if line[0].isdigit()]
curve = [(float(pga), float(rate)) for pga, rate in rows]


def exceedance(pga):
    """The annual rate of exceedance, linear between the points of the curve in the logarithms of both."""
    low, high = next(pair for pair in zip(curve, curve[1:]) if pair[0][0] <= pga <= pair[1][0])
    return low[1] * (pga / low[0]) ** (math.log(high[1] / low[1]) / math.log(high[0] / low[0]))


print("# An example, of no real site: annual rates at which motions occur in bins of peak ground acceleration and velocity.")
print("# scripts/joint_hazard.py makes it from data/hazard.csv.")
print("pga_g,pgv_m_s,annual_rate_of_occurrence")
share = NormalDist().cdf
for low, high in zip(PGA_EDGES, PGA_EDGES[1:]):
    pga, rate = math.sqrt(low * high), exceedance(low) - exceedance(high)
    for near, far in zip(PGV_EDGES, PGV_EDGES[1:]):
        pgv = pga * 9.81 * MEDIAN_S * math.exp(SIGMA * (near + far) / 2)
        print(f"{pga:.4g},{pgv:.4g},{rate * (share(far) - share(near)):.4e}")
