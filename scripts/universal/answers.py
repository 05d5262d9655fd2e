"""Answers that the tests of the program compare with: python answers.py SURFACE.csv STUDY RECORDS_RESPONSES
OUT_FOLDER (RECORDS_RESPONSES -: the records' cases as they are there)

universal_answers.csv: at 60 points of the domain and beyond it L, M - 6.9 (of a third with M unknown, mw -1)
and what is added near uplift. calibration_cases.csv: cases of one structure under csgm and under records (edp
-1 where it overturned); calibration_answers.csv: c, ln s and m (P_ex at 0.1), the upper triangle of their
covariance with clusters (clustered) and as one cluster (v), by the priors of SURFACE.csv.
"""

import sys

import numpy as np
import polars as pl

import cases as of
from calibration import calibrate
from surface import KINDS, LIMIT, NO_LIMIT, TERMS, Surface

N = 60
CASES = "kind structure p_rad_s alpha_rad eta pga_m_s2 pgv_m_s im3 im4 im5 mw cluster".split()
RANGES = {"p_rad_s": (0.3, 12), "alpha_rad": (0.04, 0.5), "eta": (0.68, 0.999), "ratio": (0.6, 60)}
RANGES |= {"im4": (1.001, 30), "limit_state": (0.02, 0.9), "mw": (4.5, 8.0)}


def points(surface):
    rng = np.random.default_rng(11)
    drawn = {name: np.exp(rng.uniform(*np.log(ends), N)).round(6) for name, ends in RANGES.items()}
    kind, unknown = [KINDS[k % 4] for k in range(N)], pl.int_range(N) % 3 == 0
    im3 = pl.col("ratio") / pl.col("p_rad_s")
    drawn = pl.DataFrame(drawn).with_columns(kind=pl.Series(kind), im3=im3, im5=pl.col("im4") / im3)
    drawn = drawn.with_columns(mw=pl.when(~unknown).then("mw")).drop("ratio")
    for event, limit in (("pro", pl.lit(NO_LIMIT)), ("pex", pl.col("limit_state"))):
        cases = drawn.with_columns(limit=limit)
        parts = np.concatenate([surface.parts(event, kind[k], cases[k]) for k in range(N)]).T
        columns = zip((f"logit_{event}", "magnitude", f"added_{event}"), parts)
        drawn = drawn.with_columns(**{name: pl.Series(values) for name, values in columns})
    return drawn.with_columns(pl.col("mw").fill_null(-1.0))


def calibration(surface, event, cases):
    """The answers of one structure."""
    kind, cases = cases["kind"][0], of.counted(event, cases, LIMIT)
    happened, clusters = cases["happened"], cases["cluster"].to_numpy()
    prior, tau = surface.prior(event, kind), surface.numbers["calibration", kind, event][6]
    known = surface.parts(event, kind, cases), happened.to_numpy(), prior
    (b, clustered), (_, plain) = (calibrate(*known, of, tau) for of in (clusters, np.zeros(len(cases))))
    out = {"kind": kind, "structure": cases["structure"][0], "event": event, "n": len(cases)}
    out |= {"n_events": happened.sum(), "n_clusters": len(set(clusters)), **dict(zip(("c", "ln_s", "m"), b))}
    for name, v in (("v", plain), ("clustered", clustered)):
        out |= {f"{name}_{row}{column}": v[row, column] for row in range(3) for column in range(row, 3)}
    return out


path, study, records, folder = sys.argv[1:]
surface = Surface(open(path))
points(surface).write_csv(f"{folder}/universal_answers.csv")
if records == "-":
    recorded = pl.read_csv(f"{folder}/calibration_cases.csv").filter(kind="recorded")
    recorded = recorded.with_columns(pl.col("overturned") == 1, pl.when(pl.col("edp") >= 0).then("edp"))
else:
    recorded = of.read([records]).filter(structure=5).gather_every(9)
parts = [of.read([study], 1.0, "csgm").filter(structure=1).gather_every(8), recorded]
columns = *CASES, pl.col("overturned").cast(pl.Int8), pl.col("edp").fill_null(-1.0)
pl.concat(parts, how="diagonal_relaxed").select(columns).write_csv(f"{folder}/calibration_cases.csv")
answers = [calibration(surface, event, part) for part in parts for event in TERMS]
pl.DataFrame(answers).write_csv(f"{folder}/calibration_answers.csv")
