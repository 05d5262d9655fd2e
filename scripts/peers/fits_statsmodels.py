"""The fits of the paper by statsmodels: python fits_statsmodels.py RESPONSES.parquet

For each suite and structure: the demand in safe rocking on each of the six measures and on both planes (OLS), overturning
on each measure and on the hybrid (probit), with covariance. Prints the seconds of the fits alone.
"""

import json
import sys
import time
import warnings

import numpy as np
import pyarrow.parquet as pq
import statsmodels.api as sm

MEASURES = ("im1", "im2", "im3", "im4", "im5", "im6")
warnings.simplefilter("ignore")
np.seterr(all="ignore")
table = pq.read_table(sys.argv[1], columns=["suite", "structure", "outcome", "edp", *MEASURES])
columns = {name: table[name].to_numpy(zero_copy_only=False) for name in table.column_names}
groups = np.char.add(columns["suite"].astype(str), columns["structure"].astype(str))
start = time.perf_counter()
for group in np.unique(groups):
    rows = groups == group
    ln = {name: np.log(columns[name][rows].astype(float)) for name in MEASURES}
    outcome, ln_edp = columns["outcome"][rows], np.log(columns["edp"][rows].astype(float))
    safe, rocks = outcome == "safe_rocking", outcome != "no_rocking"
    sides = [(ln["im4"] >= 0) & (ln["im4"] < np.log(1.3)), ln["im4"] >= np.log(1.3)]
    for measures, chosen in [((name,), safe) for name in MEASURES] + [(("im4", "im3"), safe & side) for side in sides]:
        design = sm.add_constant(np.column_stack([ln[name] for name in measures]))
        chosen = chosen & np.isfinite(design).all(axis=1) & np.isfinite(ln_edp)
        sm.OLS(ln_edp[chosen], design[chosen]).fit().cov_params()
    for measures in [(name,) for name in MEASURES] + [("im4", "im3")]:
        design = sm.add_constant(np.column_stack([ln[name] for name in measures]))
        chosen = rocks & np.isfinite(design).all(axis=1)
        event = (outcome[chosen] == "overturning").astype(float)
        sm.Probit(event, design[chosen]).fit(disp=0, maxiter=100).cov_params()
json.dump({"fits_s": time.perf_counter() - start}, sys.stdout)
