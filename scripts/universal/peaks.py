"""How PGA and PGV go together in the motions of the surface, into its file: python peaks.py SURFACE.csv MOTIONS.parquet...

ln(PGV / PGA) given the logarithm of either peak, of the motions as they were made (not those that were scaled): three knots, the coefficients
of 1, the logarithm and its natural spline, and the standard deviation (src/fragility/peaks.rs).
"""

import sys

import numpy as np
import polars as pl

import surface

path, *files = sys.argv[1:]
motions = pl.concat([pl.read_parquet(file, columns=["suite", "pga_m_s2", "pgv_m_s"]) for file in files])
lines = []
for suite in ("pulse", "csgm", "hfc"):
    of_suite = motions.filter(pl.col("suite") == suite)
    pga, pgv = (np.log(of_suite[name].to_numpy()) for name in ("pga_m_s2", "pgv_m_s"))
    for name, peak in (("pga", pga), ("pgv", pgv)):
        knots = np.quantile(peak, [0.05, 0.5, 0.95])
        design = np.stack(surface.spline(peak, knots), axis=1)
        b, (rss,), *_ = np.linalg.lstsq(design, pgv - pga, rcond=None)
        sd = np.sqrt(rss / (len(peak) - 3))
        lines.append(",".join(["peaks", f"{suite}_{name}", *(f"{value:.6g}" for value in (*knots, *b, sd))]))
old = [line for line in open(path).read().splitlines() if not line.startswith("peaks,")]
first = next(k for k, line in enumerate(old) if line.startswith("spread,"))
open(path, "w").write("\n".join([*old[:first], *lines, *old[first:]]) + "\n")
