"""Makes data/universal.csv: python make.py OUT.csv MOTIONS RECORDS_RESPONSES RESPONSES..."""

import sys

import numpy as np
import polars as pl

import cases as of
import fit
from calibration import apply, between, calibrate, spread
from surface import KINDS, TERMS, Surface, some

LIMIT = 0.1
WIDE = (0.0, 0.0, 5.0, 5.0)
KNOT, LEAST_TO_BEND = 0.9, 300
HEAD = """\
# The universal fragility surface: P_ro and P_ex of any rocking structure, by scripts/universal/make.sh.
# From {structures} structures, {motions} synthetic motions on rock ({cases} cases), {records} records.
# logit P = sum of coefficients, each times a function: 1, or a product of features, a feature^k is its power.
# Features: x = ln(ln IM4 + 0.2); w = ln IM5 in P_ro, ln IM5 - 0.4 limit in P_ex; r = ln IM3;
# eta = (eta - 0.85)/0.1; p = ln(p/2), p in rad/s; limit = ln(limit state/0.2), in P_ex only.
# domain,NAME,LOW,HIGH: 0.1 % and 99.9 % quantiles of the measures; ranges of the structures and limit states.
# term,pro|pex,FUNCTION,csgm,pulse,hfc: coefficients for each kind of motion; recorded has those of hfc.
# calibration,KIND,pro|pex,c,ln_s,sd_c,sd_ln_s,tau: logit = c + s L with its priors, P_ex at the limit 0.1; sd
# of the logit between cells or earthquakes.
# peaks,KIND,pga|pgv,intercept,slope,knot,bend,sd_below,sd_above: ln(PGV/PGA) = intercept + slope u
# + bend max(u - knot, 0), u = ln(peak) in SI units; normal about it, with one sd below and one above.
domain,p,0.4,8
domain,eta,0.7,0.999
domain,alpha,0.04,0.5
domain,limit,0.02,0.5
"""


def chosen(event, cases):
    """Returns the cases that count and whether the event happened, P_ex at the limit of the calibration."""
    if event == "pro":
        return cases, cases["overturned"]
    safe = some(cases, ~cases["overturned"])
    return safe, safe["edp"] > LIMIT


def groups(values, logit, happened):
    return {value: (logit[values == value], happened[values == value]) for value in np.unique(values)}


def priors(surface, kind, event, cases, whole):
    """c, ln s, their sds between structures (of records also between the three sets, and of the estimates
    themselves) and tau, which needs all responses of some structures: `whole`."""
    logits = lambda c: surface.logit(event, kind, c, LIMIT)
    cases, happened = chosen(event, some(cases, cases["kind"] == kind))
    of_structures = groups(cases["structure"], logits(cases), happened)
    if kind == "recorded":
        mean, covariance = calibrate(logits(cases), happened, WIDE, cases["cluster"])
        sets = np.array([name.split()[0] for name in cases["motion_id"]])
        of_sets = groups(sets, logits(cases), happened)
        sd = np.hypot(*(spread(list(each.values()), mean) for each in (of_structures, of_sets)))
        sd = np.hypot(sd, np.sqrt(np.diag(covariance)))
        return *mean, *sd, between(apply(mean, logits(cases)), happened, cases["cluster"])
    sd = spread(list(of_structures.values()), np.zeros(2))
    cases, happened = chosen(event, some(whole, whole["kind"] == kind))
    own = groups(cases["structure"], logits(cases), happened)
    own = {number: calibrate(*each, (0, 0, *sd))[0] for number, each in own.items()}
    b = np.stack([own[number] for number in cases["structure"]], axis=1)
    clusters = np.char.add(cases["structure"].astype(str), np.char.add(" ", cases["cluster"].astype(str)))
    return 0, 0, *sd, between(apply(b, logits(cases)), happened, clusters)


def peak_lines(motions):
    """ln(PGV/PGA) on the logarithm of either peak: a line, with one bend where there are motions enough."""
    pga, pgv = (np.log(motions[name].to_numpy()) for name in ("pga_m_s2", "pgv_m_s"))
    for name, peak in (("pga", pga), ("pgv", pgv)):
        knot = np.quantile(peak, KNOT)
        columns = [np.ones_like(peak), peak, np.maximum(peak - knot, 0)]
        columns = np.stack(columns[: 3 if len(peak) >= LEAST_TO_BEND else 2], axis=1)
        b, *_ = np.linalg.lstsq(columns, pgv - pga, rcond=None)
        off = pgv - pga - columns @ b
        yield (
            name,
            (*b[:2], knot, sum(b[2:]), *(np.sqrt(np.mean(off[side] ** 2)) for side in (off < 0, off > 0))),
        )


def main():
    out, motions, records_responses, *files = sys.argv[1:]
    cases, whole, recorded = of.read(files, 0.15), of.read(files[:1]), of.read([records_responses])
    n = lambda cases, name: len(np.unique(cases[name]))
    numbers = lambda values, form: ",".join(format(value, form) for value in values) + "\n"
    with open(out, "w") as file:
        file.write(HEAD.format(structures=n(cases, "structure"), motions=n(cases, "motion_id"),
                               cases=len(cases["im4"]), records=n(recorded, "motion_id")))  # fmt: skip
        for name in ("im4", "im5", "im3"):
            low, high = np.quantile(cases[name], [0.001, 0.999])
            file.write(f"domain,{name},{1.0 if name == 'im4' else low:.4g},{high:.4g}\n")
        for event in ("pro", "pex"):
            for term, b in zip(TERMS[event], fit.surface(event, cases)):
                file.write(f"term,{event},{term}," + numbers(b, ".6g"))
    surface = Surface(out)
    peaks = ["motion_id", "suite", "pga_m_s2", "pgv_m_s"]
    synthetic, of_records = (pl.read_parquet(file, columns=peaks) for file in (motions, records_responses))
    with open(out, "a") as file:
        for kind in ("recorded", *KINDS):
            for event in ("pro", "pex"):
                row = priors(surface, kind, event, recorded if kind == "recorded" else cases, whole)
                file.write(f"calibration,{kind},{event}," + numbers(row, ".3f"))
            own = (
                synthetic.filter(pl.col("suite") == kind) if kind in KINDS else of_records.unique("motion_id")
            )
            for name, line in peak_lines(own):
                file.write(f"peaks,{kind},{name}," + numbers(line, ".4f"))


if __name__ == "__main__":
    main()
