"""Answers that the tests of the program compare with: python answers.py SURFACE.csv STUDY
RECORDS_RESPONSES OUT_FOLDER

universal_answers.csv: logits before calibration at 60 points of the domain. calibration_cases.csv: cases
of a structure under csgm and of one under records (edp -1 where it overturned); calibration_answers.csv:
c, ln s (P_ex at 0.1), their covariance as the inverse Hessian (v) and with clusters (clustered), by the
priors of SURFACE.csv (calibration.py)."""

import sys

import numpy as np
import polars as pl

import cases as of
from calibration import calibrate
from make import LIMIT, chosen
from surface import KINDS, Surface, some

N = 60
CASES = "kind structure p_rad_s alpha_rad eta pga_m_s2 pgv_m_s im3 im4 im5 cluster".split()
NAMES = ["p_rad_s", "alpha_rad", "eta", "im3", "im4", "im5", "limit_state"]


def points(surface):
    rng = np.random.default_rng(11)
    drawn = {"kind": np.array([("recorded", *KINDS)[k % 4] for k in range(N)])}
    for column in NAMES:
        low, high = np.log(surface.domain[column.split("_")[0]])
        drawn[column] = np.exp(rng.uniform(low, high, N)).round(6) + 0.01 * (column == "im4")
    drawn["im5"] = drawn["im4"] / drawn["im3"]
    for event in ("pro", "pex"):
        logit = lambda k: surface.logit(event, drawn["kind"][k], some(drawn, [k]), drawn["limit_state"][k])[0]
        drawn[f"logit_{event}"] = np.array([logit(k) for k in range(N)])
    return pl.DataFrame(drawn)


def calibrations(surface, cases):
    for event in ("pro", "pex"):
        counted, happened = chosen(event, cases)
        kind, logit = cases["kind"][0], surface.logit(event, cases["kind"][0], counted, LIMIT)
        prior = surface.calibration[kind, event][:4]
        (c, ln_s), plain = calibrate(logit, happened, prior)
        _, clustered = calibrate(logit, happened, prior, counted["cluster"])
        out = {"kind": kind, "structure": int(cases["structure"][0]), "event": event, "n": len(logit)}
        out |= {"n_events": int(happened.sum()), "n_clusters": len(np.unique(counted["cluster"]))}
        out |= {"c": c, "ln_s": ln_s}
        for name, v in (("v", plain), ("clustered", clustered)):
            out |= {f"{name}_cc": v[0, 0], f"{name}_cs": v[0, 1], f"{name}_ss": v[1, 1]}
        yield out


path, study, records, folder = sys.argv[1:]
surface = Surface(path)
points(surface).write_csv(f"{folder}/universal_answers.csv")
parts = []
for file, suite, number, every in ((study, "csgm", 1, 8), (records, None, 5, 1)):
    read = of.read([file], 1.0, suite)
    parts.append(some(read, np.flatnonzero(read["structure"] == number)[::every]))
joined = pl.concat([pl.DataFrame(some(part, slice(None))) for part in parts])
edp = pl.col("edp").fill_nan(None).fill_null(-1.0)
joined.select(*CASES, pl.col("overturned").cast(pl.Int8), edp).write_csv(f"{folder}/calibration_cases.csv")
answers = pl.DataFrame([row for part in parts for row in calibrations(surface, part)])
answers.write_csv(f"{folder}/calibration_answers.csv")
