"""Annual rates counted by numpy and scipy, for core/tests/fits/counted_rates.rs: python counted_rates.py
MOTIONS.csv ANSWERS.csv

Motions of 35 cells with a PGA (g) and whether each overturns a structure, in the order of their PGA; annual
rates of overturning at a site where H = 1e-3 PGA^-2.5, in bins of equal numbers of motions; limits from cells
drawn anew 20,000 times, and by Fay & Feuer (1997).
"""

import sys

import numpy as np
import pandas as pd
from scipy.special import ndtr
from scipy.stats import chi2

LEAST, IN_BIN, MOST_BINS = 0.3, 20, 320
rng = np.random.default_rng(5)
cells, each = 35, 60
cell = np.repeat(np.arange(cells), each)
strength = 0.4 * rng.standard_normal(cells)
pga = np.round(0.35 * np.exp(strength[cell] + 0.5 * rng.standard_normal(len(cell))), 6)
shift = 0.4 * rng.standard_normal(cells)
happened = rng.uniform(size=len(cell)) < ndtr(-1.8 + 1.5 * np.log(pga / 0.35) + shift[cell])
order = np.argsort(pga, kind="stable")
pga, cell, happened = pga[order], cell[order], happened[order]
motions = pd.DataFrame({"pga_g": pga, "cell": cell, "overturned": happened.astype(int)})
motions.to_csv(sys.argv[1], index=False, float_format="%.6f")

rocks = pga >= LEAST
pga, cell, happened = pga[rocks], cell[rocks], happened[rocks].astype(float)
bins = min(max(len(pga) // IN_BIN, 1), MOST_BINS)
exceeded = 1e-3 * pga**-2.5


def binned(times):
    """Annual rate, motions and events of each bin."""
    place = ((np.cumsum(times) - 0.5 * times) / times.sum() * bins).astype(int)
    drawn = times > 0
    numbers, first = np.unique(place[drawn], return_index=True)
    edges = exceeded[drawn][first]
    edges[0] = 1e-3 * LEAST**-2.5
    total = lambda values: np.bincount(place[drawn], values[drawn], minlength=bins)[numbers]
    return -np.diff(edges, append=0.0), total(times), total(times * happened)


def rate(times):
    annual, n, events = binned(times)
    return (annual * events / n).sum()


annual, n, events = binned(np.ones(len(pga)))
value, variance, largest = (annual * events / n).sum(), ((annual / n) ** 2 * events).sum(), (annual / n).max()
low = variance / (2 * value) * chi2.ppf(0.025, 2 * value**2 / variance)
above, spread = value + largest, variance + largest**2
high = spread / (2 * above) * chi2.ppf(0.975, 2 * above**2 / spread)
draw = lambda: np.bincount(rng.integers(0, cells, cells), minlength=cells)[cell].astype(float)
drawn = np.quantile([rate(draw()) for _ in range(20_000)], [0.025, 0.975])
names = "value drawn_low drawn_high poisson_low poisson_high".split()
answers = pd.DataFrame([[value, *drawn, low, high]], columns=names)
answers.to_csv(sys.argv[2], index=False, float_format="%.12e")
