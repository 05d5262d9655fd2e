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

TRANSITION, LIMIT = 1.3, np.log(0.1)


def design(first, ln_im3):
    return np.stack([np.ones_like(first), first, ln_im3], axis=1)


def fitted(columns, ln_edp):
    b = np.linalg.lstsq(columns, ln_edp, rcond=None)[0]
    return b, np.std(ln_edp - columns @ b)


def judged(ln_edp, median, sd):
    exceeds = np.where(ln_edp > LIMIT, 1, -1)
    return np.sqrt(np.mean((ln_edp - median) ** 2)), norm.logcdf(exceeds * (median - LIMIT) / sd).mean()


def data(path, suite, structure):
    of = (pl.col("suite") == suite) & (pl.col("structure") == structure) & (pl.col("outcome") == "safe_rocking")
    rows = pl.read_parquet(path).filter(of & (pl.col("edp") > 0) & (pl.col("im4") > 1))
    return (np.log(rows[name].to_numpy()) for name in ("im4", "im3", "edp"))


for suite, structure in itertools.product(("pulse", "csgm"), ("frame", "electrical-equipment")):
    scores = []
    for here, there in itertools.permutations(sys.argv[1:], 2):
        im4, im3, edp = data(here, suite, structure)
        low = im4 < np.log(TRANSITION)
        one, sd = fitted(design(np.log(im4), im3), edp)
        two = [fitted(design(im4[side], im3[side]), edp[side]) for side in (low, ~low)]
        im4, im3, edp = data(there, suite, structure)
        low = im4 < np.log(TRANSITION)
        (below, sd_below), (above, sd_above) = two
        median = np.where(low, design(im4, im3) @ below, design(im4, im3) @ above)
        of_one = judged(edp, design(np.log(im4), im3) @ one, sd)
        scores.append([*of_one, *judged(edp, median, np.where(low, sd_below, sd_above))])
    rms_one, score_one, rms_two, score_two = np.mean(scores, axis=0)
    print(f"{suite} {structure}: rms {rms_one:.3f}, {rms_two:.3f}; score {score_one:.3f}, {score_two:.3f}")
