"""Makes data/universal.csv: python make.py OUT.csv MOTIONS RECORDS RECORDS_RESPONSES RESPONSES..."""

import sys

import numpy as np
import polars as pl

import cases as of
import fit
from calibration import apply, between, calibrate, spread
from surface import KINDS, TERMS, Surface, some

LIMIT = 0.1
WIDE = (0.0, 0.0, 5.0, 5.0)
HEAD = """\
# The universal fragility surface: P_ro and P_ex of every rocking structure. Made by scripts/universal/make.sh.
# From {structures} structures and {motions} synthetic motions on rock: {cases} cases of rocking; and {records} records.
# logit P = sum of coefficients, each times a function. FUNCTION is 1 or a product of features, a feature^k is its power.
# Features: x = ln(ln IM4 + 0.2); w = ln IM5 in P_ro, ln IM5 - 0.4 limit in P_ex; r = ln IM3;
# eta = (eta - 0.85)/0.1; p = ln(p/2), p in rad/s; limit = ln(limit state/0.2), in P_ex only.
# domain,NAME,LOW,HIGH: 0.1 % and 99.9 % quantiles of the measures; ranges of the structures and limit states.
# term,pro|pex,FUNCTION,csgm,pulse,hfc: coefficients for each kind of motion; recorded has those of hfc.
# calibration,KIND,pro|pex,c,ln_s,sd_c,sd_ln_s,tau: logit = c + s L; priors; sd of the logit between cells or earthquakes.
# peaks,KIND,pga|pgv,intercept,slope,sd: ln(PGV/PGA) = intercept + slope ln(peak), SI units, and the sd about it.
"""


def chosen(event, cases):
    """Returns the cases that count and whether the event happened, P_ex at the limit of the calibration."""
    if event == "pro":
        return cases, cases["overturned"]
    safe = some(cases, ~cases["overturned"])
    return safe, safe["edp"] > LIMIT


def groups(values, logit, happened):
    return [(logit[values == value], happened[values == value]) for value in np.unique(values)]


def priors(surface, kind, event, cases):
    """c, ln s, their sds between structures (of records also between sets of motions) and tau."""
    cases, happened = chosen(event, some(cases, cases["kind"] == kind))
    logit = surface.logit(event, kind, cases, LIMIT)
    mean = calibrate(logit, happened, WIDE)[0] if kind == "recorded" else np.zeros(2)
    of_structures = groups(cases["structure"], logit, happened)
    sd = spread(of_structures, mean)
    if kind == "recorded":
        sets = np.array([name.split()[0] for name in cases["motion_id"]])
        sd = np.hypot(sd, spread(groups(sets, logit, happened), mean))
        return [*mean, *sd, between(apply(mean, logit), happened, cases["cluster"])]
    own = {k: calibrate(*group, (*mean, *sd))[0] for k, group in zip(np.unique(cases["structure"]), of_structures)}
    b = np.array([own[k] for k in cases["structure"]])
    calibrated = b[:, 0] + np.exp(b[:, 1]) * logit
    both = np.char.add(cases["structure"].astype(str), np.char.add(" ", cases["cluster"].astype(str)))
    return [*mean, *sd, between(calibrated, happened, both)]


def peak_lines(motions):
    """ln(PGV/PGA) on the logarithm of either peak: a straight line and the standard deviation about it."""
    pga, pgv = (np.log(motions[name].to_numpy()) for name in ("pga_m_s2", "pgv_m_s"))
    for name, peak in (("pga", pga), ("pgv", pgv)):
        slope, intercept = np.polyfit(peak, pgv - pga, 1)
        yield name, intercept, slope, np.std(pgv - pga - intercept - slope * peak, ddof=2)


def main():
    out, motions, records_responses, *files = sys.argv[1:]
    cases = of.read(files, 0.25)
    recorded = of.read([records_responses])
    number = lambda name: len(np.unique(cases[name]))
    with open(out, "w") as file:
        file.write(HEAD.format(structures=number("structure"), motions=number("motion_id"), cases=len(cases["im4"]),
                               records=len(np.unique(recorded["motion_id"]))))  # fmt: skip
        for name in ("im4", "im5", "im3"):
            low, high = np.quantile(cases[name], [0.001, 0.999])
            file.write(f"domain,{name},{1.0 if name == 'im4' else low:.4g},{high:.4g}\n")
        file.write("domain,p,0.4,8\ndomain,eta,0.7,0.999\ndomain,alpha,0.04,0.5\ndomain,limit,0.02,0.5\n")
        for event in ("pro", "pex"):
            for term, b in zip(TERMS[event], fit.surface(event, cases)):
                file.write(f"term,{event},{term}," + ",".join(f"{value:.6g}" for value in b) + "\n")
    surface = Surface(out)
    with open(out, "a") as file:
        for kind in ("recorded", *KINDS):
            for event in ("pro", "pex"):
                row = priors(surface, kind, event, recorded if kind == "recorded" else cases)
                file.write(f"calibration,{kind},{event}," + ",".join(f"{value:.3f}" for value in row) + "\n")
        synthetic = pl.read_parquet(motions, columns=["suite", "pga_m_s2", "pgv_m_s"])
        of_records = pl.read_parquet(records_responses, columns=["motion_id", "pga_m_s2", "pgv_m_s"]).unique("motion_id")
        for kind in ("recorded", *KINDS):
            for name, *line in peak_lines(of_records if kind == "recorded" else synthetic.filter(pl.col("suite") == kind)):
                file.write(f"peaks,{kind},{name}," + ",".join(f"{value:.4f}" for value in line) + "\n")


if __name__ == "__main__":
    main()
