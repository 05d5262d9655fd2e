"""Answers that the tests of the program compare with: python answers.py SURFACE.csv STUDY
RECORDS_RESPONSES OUT_FOLDER

universal_answers.csv: at 60 points of the domain and beyond it L, M - 6.9 (of a third with M unknown, mw
-1) and what is added near uplift. calibration_cases.csv: cases of a structure under csgm and of one under
records (edp -1 where it overturned); calibration_answers.csv: c, ln s and m (P_ex at 0.1), the upper triangle
of their covariance as the inverse Hessian (v) and with clusters (clustered), by the priors of SURFACE.csv
(calibration.py)."""

import sys

import numpy as np
import polars as pl

import cases as of
from calibration import calibrate
from make import LIMIT, chosen
from surface import KINDS, Surface, some

N = 60
CASES = "kind structure p_rad_s alpha_rad eta pga_m_s2 pgv_m_s im3 im4 im5 mw cluster".split()
RANGES = {"p_rad_s": (0.3, 12), "alpha_rad": (0.04, 0.5), "eta": (0.68, 0.999), "ratio": (0.6, 60)}
RANGES |= {"im4": (1.001, 30), "limit_state": (0.02, 0.9), "mw": (4.5, 8.0)}


def points(surface):
    rng = np.random.default_rng(11)
    drawn = {"kind": np.array([KINDS[k % 4] for k in range(N)])}
    for column, (low, high) in RANGES.items():
        drawn[column] = np.exp(rng.uniform(np.log(low), np.log(high), N)).round(6)
    drawn["im3"] = drawn.pop("ratio") / drawn["p_rad_s"]
    drawn["im5"] = drawn["im4"] / drawn["im3"]
    drawn["mw"] = np.where(np.arange(N) % 3 == 0, np.nan, drawn["mw"])
    for event in ("pro", "pex"):
        one = lambda k: surface.parts(event, drawn["kind"][k], some(drawn, [k]), drawn["limit_state"][k])
        logit, magnitude, added = np.array([[part[0] for part in one(k)] for k in range(N)]).T
        drawn |= {f"logit_{event}": logit, "magnitude": magnitude, f"added_{event}": added}
    return pl.DataFrame(drawn).with_columns(pl.col("mw").fill_nan(-1.0))


def calibrations(surface, cases):
    for event in ("pro", "pex"):
        counted, happened = chosen(event, cases)
        kind = cases["kind"][0]
        parts, prior = surface.parts(event, kind, counted, LIMIT), surface.prior(event, kind, LIMIT)
        (c, ln_s, m), plain = calibrate(parts, happened, prior)
        _, clustered = calibrate(parts, happened, prior, counted["cluster"])
        out = {"kind": kind, "structure": int(cases["structure"][0]), "event": event, "n": len(happened)}
        out |= {"n_events": int(happened.sum()), "n_clusters": len(np.unique(counted["cluster"]))}
        out |= {"c": c, "ln_s": ln_s, "m": m}
        for name, v in (("v", plain), ("clustered", clustered)):
            out |= {f"{name}_{row}{column}": v[row, column] for row in range(3) for column in range(row, 3)}
        yield out


path, study, records, folder = sys.argv[1:]
surface = Surface(path)
points(surface).write_csv(f"{folder}/universal_answers.csv")
parts = []
for file, suite, number, every in ((study, "csgm", 1, 8), (records, None, 5, 9)):
    read = of.read([file], 1.0, suite)
    parts.append(some(read, np.flatnonzero(read["structure"] == number)[::every]))
joined = pl.concat([pl.DataFrame(some(part, slice(None))) for part in parts])
edp = pl.col("edp").fill_nan(None).fill_null(-1.0)
joined.select(*CASES, pl.col("overturned").cast(pl.Int8), edp).write_csv(f"{folder}/calibration_cases.csv")
answers = pl.DataFrame([row for part in parts for row in calibrations(surface, part)])
answers.write_csv(f"{folder}/calibration_answers.csv")
