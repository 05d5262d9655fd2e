"""One plane in ln(ln IM4) and ln IM3 against the paper's two, on seeds that the fit left out: python
scripts/one_plane.py RESPONSES RESPONSES...

Each file has the responses of the paper's set-up with another seed. Prints the root mean square of ln demand in
safe rocking and the mean log score of a demand above 0.1, one plane and two, in means over fits and seeds.
"""

import itertools
import sys

import numpy as np
import polars as pl
from scipy.stats import norm

TRANSITION, LIMIT = np.log([1.3, 0.1])


def data(path, suite, structure):
    """ln of IM4, IM3 and demand in safe rocking."""
    of = (pl.col("suite") == suite) & (pl.col("structure") == structure) & (pl.col("outcome") == "safe_rocking")
    rows = pl.read_parquet(path).filter(of & (pl.col("edp") > 0) & (pl.col("im4") > 1))
    return np.log(rows.select("im4", "im3", "edp").to_numpy().T)


def plane(first, here, there):
    """Root mean square and log score of cases by a plane that is fitted to others; `first` makes its first measure."""
    columns, judged = (np.stack([np.ones_like(im4), first(im4), im3], axis=1) for im4, im3, _ in (here, there))
    b = np.linalg.lstsq(columns, here[2], rcond=None)[0]
    median, sd = judged @ b, np.std(here[2] - columns @ b)
    side = np.where(there[2] > LIMIT, 1, -1)
    return np.stack([(there[2] - median) ** 2, norm.logcdf(side * (median - LIMIT) / sd)])


for suite, structure in itertools.product(("pulse", "csgm"), ("frame", "electrical-equipment")):
    scores = []
    for files in itertools.permutations(sys.argv[1:], 2):
        here, there = (data(file, suite, structure) for file in files)
        sides = [[of[:, (of[0] < TRANSITION) == low] for of in (here, there)] for low in (True, False)]
        two = np.concatenate([plane(lambda im4: im4, *side) for side in sides], axis=1)
        square, score = np.transpose([of.mean(axis=1) for of in (plane(np.log, here, there), two)])
        scores.append([*np.sqrt(square), *score])
    print(suite, structure, "rms {:.3f}, {:.3f}; score {:.3f}, {:.3f}".format(*np.mean(scores, axis=0)))
