"""Makes data/universal.csv: python make.py OUT.csv MOTIONS RECORDS_RESPONSES RESPONSES..."""

import sys

import numpy as np
import polars as pl
from scipy.optimize import minimize

import cases as of
import fit
from calibration import apply, between, calibrate, spread
from surface import DOMAIN, KINDS, MOST_IM4, TERMS, Surface, design, features, magnitude, some, uplift

LIMIT = 0.1
MW = {"recorded": (5.0, 7.6)}
# Sds of c, ln s and m: by coverage and score of few records (judge.py). Spread between structures is .63 in z.
SD = {"recorded": (0.6, 0.25, 0.4)}
KNOT, LEAST_TO_BEND = 0.9, 300
HEAD = """\
# The universal fragility surface: P_ro and P_ex of any rocking structure, by scripts/universal/make.sh.
# From {structures} structures, {motions} synthetic motions on rock ({cases} cases), {records} components of
# {earthquakes} earthquakes, as recorded and twice as strong.
# logit P = c + s L + m (M - 6.9) + ln(1 - exp(-((IM4 - 1) IM5^k/d)^n)).
# L is a sum of coefficients, each times a function: 1, or a product of features, a feature^k is its power.
# Features: x = ln(ln IM4 + 0.2); r = ln(ratio/p); w = ln IM4 - r in P_ro, w - 0.4 limit in P_ex;
# eta = (eta - 0.85)/0.1; p = ln(p/2), p in rad/s; limit = ln(limit state/0.2) and end = ln(1.1 - limit state), in
# P_ex only. IM4 is held below the end of its domain, ratio = PGA/PGV (1/s), p, eta and limit within theirs.
# domain,NAME,LOW,HIGH: of IM4 and IM5 99.9 % (0.1 %) quantiles; ranges of the others.
# term,pro|pex,FUNCTION,recorded,csgm,pulse,hfc: coefficients for each kind of motion. Those of recorded are
# fitted to hfc without magnitude.
# uplift,KIND,pro|pex,n,d,k
# magnitude,KIND,intercept,slope,sd,low,high: M = intercept + slope ln(PGV/PGA), in s, where it is unknown; M is
# held between low and high.
# calibration,KIND,pro|pex,c,ln_s,m,sd_c,sd_ln_s,sd_m,tau,h: means and sds of the priors, c + h end in P_ex;
# tau, the sd of the logit between cells or earthquakes.
# peaks,KIND,pga|pgv,intercept,slope,knot,bend,sd_below,sd_above: ln(PGV/PGA) = intercept + slope u
# + bend max(u - knot, 0), u = ln(peak) in SI units; normal about it, with one sd below and one above.
"""


def chosen(event, cases):
    """Returns the cases that count and whether the event happened, P_ex at the limit of the calibration."""
    if event == "pro":
        return cases, cases["overturned"]
    safe = some(cases, ~cases["overturned"])
    return safe, safe["edp"] > LIMIT


def groups(values, parts, happened):
    of = lambda value: (tuple(part[values == value] for part in parts), happened[values == value])
    return {value: of(value) for value in np.unique(values)}


def shift(event, logit, cases):
    """c, ln s, m, h and ln n, d, k of recorded motions, together, of greatest likelihood."""
    cases, limit, happened = fit.sample(event, cases)
    logit, m, by_limit = logit(cases, limit), magnitude(cases, (0, 0, 0, *MW["recorded"])), features(event, cases, limit)["end"]

    def loss(b):
        s, numbers = np.exp(b[1]), b[4:]
        z = b[0] + s * logit + b[2] * m + b[3] * by_limit + uplift(cases, np.exp(numbers))
        weak = 0.5 * np.square(numbers - fit.SOUGHT).sum()
        return np.logaddexp(0, z).sum() - happened @ z + weak

    return minimize(loss, np.array([0.0, 0.0, 0.0, 0.0, *fit.SOUGHT]), method="BFGS", options={"gtol": 0.3}).x


def priors(surface, kind, event, cases, whole, mean):
    """Sds of c, ln s and m between structures, and tau, which needs all responses of some structures:
    `whole`."""
    parts = lambda c: surface.parts(event, kind, c, LIMIT)
    cases, happened = chosen(event, some(cases, cases["kind"] == kind))
    if kind in SD:
        return *SD[kind], between(apply(mean, parts(cases)), happened, cases["cluster"])
    sd = spread(list(groups(cases["structure"], parts(cases), happened).values()), mean)
    cases, happened = chosen(event, some(whole, whole["kind"] == kind))
    own = groups(cases["structure"], parts(cases), happened)
    own = {number: calibrate(*each, (*mean, *sd))[0] for number, each in own.items()}
    b = np.stack([own[number] for number in cases["structure"]], axis=1)
    clusters = np.char.add(cases["structure"].astype(str), np.char.add(" ", cases["cluster"].astype(str)))
    return *sd, between(apply(b, parts(cases)), happened, clusters)


def peak_lines(motions):
    """ln(PGV/PGA) on the logarithm of either peak: a line, with one bend where there are motions enough."""
    pga, pgv = (np.log(motions[name].to_numpy()) for name in ("pga_m_s2", "pgv_m_s"))
    for name, peak in (("pga", pga), ("pgv", pgv)):
        knot = np.quantile(peak, KNOT)
        columns = [np.ones_like(peak), peak, np.maximum(peak - knot, 0)]
        columns = np.stack(columns[: 3 if len(peak) >= LEAST_TO_BEND else 2], axis=1)
        b, *_ = np.linalg.lstsq(columns, pgv - pga, rcond=None)
        off = pgv - pga - columns @ b
        sds = (np.sqrt(np.mean(off[side] ** 2)) for side in (off < 0, off > 0))
        yield name, (*b[:2], knot, sum(b[2:]), *sds)


def magnitude_line(motions, low, high):
    """M on ln(PGV/PGA)."""
    ratio, mw = np.log(motions["pgv_m_s"] / motions["pga_m_s2"]).to_numpy(), motions["mw"].to_numpy()
    columns, mw = np.stack([np.ones_like(ratio), ratio], axis=1), np.clip(mw, low, high)
    line, *_ = np.linalg.lstsq(columns, mw, rcond=None)
    return *line, np.std(mw - columns @ line), low, high


def motions_of(kind, synthetic, records):
    if kind == "recorded":
        return records.unique("motion_id").filter(pl.col("motion_id").str.ends_with("x1")).sort("motion_id")
    return synthetic.filter(pl.col("suite") == kind)


def fitted(event, kind, cases, recorded):
    """Coefficients, c, ln s, m and h, and n, d, k of a kind."""
    of_kind = some(cases, cases["kind"] == ("hfc" if kind == "recorded" else kind))
    b, m, numbers = fit.surface(event, of_kind, kind != "recorded")
    if kind != "recorded":
        return b, (0.0, 0.0, m, 0.0), numbers
    shifted = shift(event, lambda c, limit: design(event, c, limit) @ b, recorded)
    return b, shifted[:4], np.exp(shifted[4:])


def main():
    out, motions, records_responses, *files = sys.argv[1:]
    cases, whole, recorded = of.read(files, 0.15), of.read(files[:1]), of.read([records_responses])
    n = lambda cases, name: len(np.unique(cases[name]))
    numbers = lambda values, form: ",".join(format(value, form) for value in values) + "\n"
    columns = ["motion_id", "suite", "pga_m_s2", "pgv_m_s", "mw"]
    synthetic, of_records = (pl.read_parquet(file, columns=columns) for file in (motions, records_responses))
    with open(out, "w") as file:
        file.write(HEAD.format(
            structures=n(cases, "structure"), motions=n(cases, "motion_id"), cases=len(cases["im4"]),
            records=n(recorded, "motion_id") // 2, earthquakes=n(recorded, "cluster")))  # fmt: skip
        for name, (low, high) in DOMAIN.items():
            file.write(f"domain,{name},{low:g},{high:g}\n")
        low, high = np.quantile(cases["im5"], [0.001, 0.999])
        file.write(f"domain,im4,1,{MOST_IM4:g}\ndomain,im5,{low:.4g},{high:.4g}\n")
        found = {(event, kind): fitted(event, kind, cases, recorded) for event in TERMS for kind in KINDS}
        for event, terms in TERMS.items():
            for row, term in enumerate(terms):
                file.write(f"term,{event},{term}," + numbers((found[event, k][0][row] for k in KINDS), ".6g"))
        for event, kind in found:
            file.write(f"uplift,{kind},{event}," + numbers(found[event, kind][2], ".4g"))
        for kind in KINDS:
            line = magnitude_line(motions_of(kind, synthetic, of_records), *MW.get(kind, (5.5, 7.5)))
            file.write(f"magnitude,{kind}," + numbers(line, ".4g"))
    surface = Surface(out)
    with open(out, "a") as file:
        for kind in KINDS:
            for event in TERMS:
                *mean, h = found[event, kind][1]
                own = recorded if kind == "recorded" else cases
                sds = priors(surface, kind, event, own, whole, np.array(mean))
                file.write(f"calibration,{kind},{event}," + numbers((*mean, *sds, h), ".3f"))
            for name, line in peak_lines(motions_of(kind, synthetic, of_records)):
                file.write(f"peaks,{kind},{name}," + numbers(line, ".4f"))


if __name__ == "__main__":
    main()
