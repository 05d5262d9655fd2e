"""Makes the examples of a joint hazard and of a curve of SA(1.0 s) from that of a hazard curve of PGA:
python joint_hazard.py data/hazard.csv > data/hazard_joint.csv; python joint_hazard.py data/hazard.csv sa > data/hazard_sa.csv

PGA in bins, in each PGV/PGA lognormal: median 0.10 s, standard deviation of ln 0.5. A bin is at its geometric mean. SA(1.0 s)
is exceeded as often as the PGV that it stands for: PGV = SA(1.0 s) 1 s / (2 pi) / 1.65 (Newmark & Hall 1982).
"""

import math
import sys
from statistics import NormalDist

MEDIAN_S, SIGMA = 0.10, 0.5
PGA_EDGES = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0]
PGV_EDGES = [-2.5 + 0.5 * k for k in range(11)]
SA_G = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0]

rows = [line.split(",") for line in open(sys.argv[1]) if line[0].isdigit()]
curve = [(float(pga), float(rate)) for pga, rate in rows]
share = NormalDist().cdf


def exceedance(pga):
    """The annual rate of exceedance, linear between the points of the curve in the logarithms of both."""
    low, high = next(pair for pair in zip(curve, curve[1:]) if pair[0][0] <= pga <= pair[1][0])
    return low[1] * (pga / low[0]) ** (math.log(high[1] / low[1]) / math.log(high[0] / low[0]))


def exceedance_of_velocity(pgv):
    """The annual rate at which a PGV (m/s) is exceeded: over PGA in steps of 1 %, the last one for all beyond."""
    steps = int(100 * math.log(curve[-1][0] / curve[0][0]))
    levels = [curve[0][0] * (curve[-1][0] / curve[0][0]) ** (k / steps) * (1 - 1e-12 * (k == steps)) for k in range(steps + 1)]
    rates = [exceedance(level) for level in levels]
    parts = [(math.sqrt(a * b), r - s) for a, b, r, s in zip(levels, levels[1:], rates, rates[1:])]
    exceeds = lambda pga: share(math.log(pga * 9.81 * MEDIAN_S / pgv) / SIGMA)
    return sum(exceeds(pga) * rate for pga, rate in parts + [(levels[-1], rates[-1])])


def joint():
    print("# An example, of no real site: annual rates at which motions occur in bins of peak ground acceleration and velocity.")
    print("# scripts/joint_hazard.py makes it from data/hazard.csv.")
    print("pga_g,pgv_m_s,annual_rate_of_occurrence")
    for low, high in zip(PGA_EDGES, PGA_EDGES[1:]):
        pga, rate = math.sqrt(low * high), exceedance(low) - exceedance(high)
        for near, far in zip(PGV_EDGES, PGV_EDGES[1:]):
            pgv = pga * 9.81 * MEDIAN_S * math.exp(SIGMA * (near + far) / 2)
            print(f"{pga:.4g},{pgv:.4g},{rate * (share(far) - share(near)):.4e}")


def spectral():
    print("# An example, of the site of hazard.csv: annual rates at which a spectral acceleration at 1 s is exceeded.")
    print("# scripts/joint_hazard.py makes it.")
    print("SA(1.0) (g),annual_rate_of_exceedance")
    for sa in SA_G:
        print(f"{sa},{exceedance_of_velocity(sa * 9.81 / (2 * math.pi) / 1.65):.3e}")


spectral() if sys.argv[2:] == ["sa"] else joint()
