"""Makes core/data/universal.csv: python make.py OUT.csv MOTIONS RECORDS_RESPONSES STUDY STUDY RESPONSES...

If RECORDS_RESPONSES is -, the domain and all that is of recorded motions stay as they are in OUT.csv."""

import re
import sys

import numpy as np
import polars as pl
from scipy.optimize import minimize

import cases as of
import fit
from calibration import WIDE, allowed, left_out, logistic, spread
from surface import (
    CORRECTED, DOMAIN, KINDS, LIMIT, MOST_IM4, SYNTHETIC, TERMS, Surface, design, features, magnitude, uplift,
)  # fmt: skip

MW = {"recorded": (5.0, 7.6)}
# Sds of c, ln s and m of recorded motions, by coverage and score of few records (judge.py).
SD = {"pro": (0.6, 0.25, 0.4), "pex": (0.65, 0.28, 0.4)}
# Classes of P, and the coverage to which tau brings all of them nearest.
TAUS, CLASSES, COVERAGE = np.arange(0.05, 2.0, 0.05), [0.01, 0.1, 0.3, 0.7, 0.9, 0.99], 0.94
KNOT = 0.9
HEAD = """\
# The universal fragility surface: P_ro and P_ex of any rocking structure, by scripts/universal/make.sh.
# From {structures} structures, {motions} synthetic motions on rock ({cases} cases), {records} components of
# {earthquakes} earthquakes, as recorded and twice as strong.
# logit P = c + s L + m (M - 6.9) - (d/((IM4 - 1) IM5^k))^n.
# L is a sum of coefficients, each times a function: 1, or a product of features, a feature^k is its power.
# Features: x = ln(ln IM4 + 0.2); r = ln(ratio/p); w = ln IM4 - r in P_ro, w - 0.4 limit in P_ex;
# eta = (eta - 0.85)/0.1; p = ln(p/2), p in rad/s; limit = ln(limit state/0.2) and end = ln(1.1 - limit state), in
# P_ex only. PGA is held where IM4 ends in its domain, then ratio = PGA/PGV (1/s), p, eta and limit within theirs.
# domain,NAME,LOW,HIGH: of IM4 and IM5 99.9 % (0.1 %) quantiles; ranges of the others.
# term,pro|pex,FUNCTION,recorded,csgm,pulse,hfc: coefficients for each kind of motion. Those of recorded are
# fitted to hfc without magnitude; limit and p of pex are then corrected by the records.
# uplift,KIND,pro|pex,n,d,k
# magnitude,KIND,intercept,slope,sd,low,high: M = intercept + slope ln(PGV/PGA), in s, where it is unknown; M is
# held between low and high.
# calibration,KIND,pro|pex,c,ln_s,m,sd_c,sd_ln_s,sd_m,tau,h: means and sds of the priors, c + h end in P_ex;
# tau, the sd of the logit between cells or earthquakes, by which limits of one motion hold what they say.
# peaks,KIND,pga|pgv,intercept,slope,knot,bend,sd_below,sd_above: ln(PGV/PGA) = intercept + slope u
# + bend max(u - knot, 0), u = ln(peak) in SI units; normal about it, with one sd below and one above.
"""


def shift(event, logit_of, cases):
    """c, ln s, m, h, ln n, d, k of recorded motions, and what CORRECTED gain, of greatest likelihood."""
    cases = fit.sample(event, cases)
    logit, m = logit_of(cases), magnitude(cases, (0, 0, 0, *MW["recorded"]))
    end = cases.select(features()["end"]).to_series().to_numpy() * (event == "pex")
    happened, columns = cases["happened"].to_numpy().astype(float), design(CORRECTED[event], cases)

    def loss(b):
        added = b[2] * m + b[3] * end + uplift(cases, np.exp(b[4:7]))
        z = b[0] + np.exp(b[1]) * (logit + columns @ b[7:]) + added
        return fit.loss_of(z, happened) + fit.weak(b[4:7])

    start = [0.0, 0.0, 0.0, 0.0, *fit.SOUGHT, *np.zeros(len(CORRECTED[event]))]
    return minimize(loss, start, method="BFGS", options={"gtol": 0.3}).x


def of_synthetic(event, kind, cases):
    """Coefficients by term, c, ln s, m and h, and n, d, k."""
    terms = [*TERMS[event], *SYNTHETIC[event]]
    b, m, numbers = fit.surface(event, terms, cases.filter(kind=kind), True)
    return b, [0.0, 0.0, m, 0.0], numbers


def of_recorded(event, cases, recorded):
    """The same of recorded motions, from those of high frequencies alone."""
    b, _, _ = fit.surface(event, TERMS[event], cases.filter(kind="hfc"), False)
    shifted = shift(event, lambda c: design(b, c) @ [*b.values()], recorded)
    corrected = {term: b[term] + gain for term, gain in zip(CORRECTED[event], shifted[7:])}
    return b | corrected, shifted[:4], np.exp(shifted[4:7])


def held(frame, taus):
    """Groups of five and more cases of a structure and cluster: class of P, and whether limits with each tau
    allow the count. The frame has z, the logit of cases left out, and happened."""
    for _, group in frame.group_by("structure", "cluster", maintain_order=True):
        z, happened = group["z"].to_numpy(), group["happened"].to_numpy()
        p = logistic(z).mean()
        if len(z) >= 5 and CLASSES[0] < p < CLASSES[-1]:
            yield np.digitize(p, CLASSES) - 1, allowed(z, happened, taus)


def tau_of(*frames):
    """That by which the coverage of all classes of P is nearest to what it should be."""
    classes, holds = map(np.array, zip(*(group for frame in frames for group in held(frame, TAUS))))
    shares = np.array([holds[classes == k].mean(axis=0) for k in np.unique(classes)])
    return TAUS[np.abs(shares - COVERAGE).max(axis=0).argmin()]


def of_records_left_out(surface, event, cases, mw=pl.col("mw")):
    """Cases with z of all structures together, each earthquake of the table by all others."""
    cases = of.counted(event, cases, LIMIT)
    parts, judged = (surface.parts(event, "recorded", frame) for frame in (cases, cases.with_columns(mw=mw)))
    z = left_out(parts, cases["happened"].to_numpy(), cases["cluster"].to_numpy(), WIDE, judged)
    return cases.with_columns(z=z).filter(~pl.col("motion_id").str.contains("field"))


def of_cells_left_out(surface, event, kind, cases, prior):
    """Cases with z: a structure is calibrated on half of its clusters and judged on the other, in turns."""
    rng, judged = np.random.default_rng(1), []
    for _, own in of.counted(event, cases, LIMIT).group_by("structure", maintain_order=True):
        half = rng.permutation(own["cluster"].unique().sort().to_numpy())[::2]
        folds = own["cluster"].is_in(half.tolist()).to_numpy()
        z = left_out(surface.parts(event, kind, own), own["happened"].to_numpy(), folds, prior)
        judged.append(own.with_columns(z=z))
    return pl.concat(judged)


def priors(surface, event, kind, cases, recorded, studies, mean):
    """Sds of c, ln s and m between structures, and tau, which needs all responses of a structure."""
    if kind == "recorded":
        return *SD[event], tau_of(of_records_left_out(surface, event, recorded))
    groups = of.counted(event, cases.filter(kind=kind), LIMIT).partition_by("structure")
    sd = spread([(surface.parts(event, kind, group), group["happened"].to_numpy()) for group in groups], mean)
    prior = np.array([*mean, *sd])
    of_kind = (study.filter(kind=kind) for study in studies)
    return *sd, tau_of(*(of_cells_left_out(surface, event, kind, study, prior) for study in of_kind))


def peak_line(motions, name):
    """ln(PGV/PGA) on the logarithm of a peak, pga or pgv: a line with one bend."""
    pga, pgv = np.log(motions.select("pga_m_s2", "pgv_m_s").to_numpy().T)
    peak = {"pga": pga, "pgv": pgv}[name]
    knot = np.quantile(peak, KNOT)
    columns = np.stack([np.ones_like(peak), peak, np.maximum(peak - knot, 0)], axis=1)
    b, *_ = np.linalg.lstsq(columns, pgv - pga)
    off = pgv - pga - columns @ b
    sds = (np.sqrt(np.mean(off[side] ** 2)) for side in (off < 0, off > 0))
    return *b[:2], knot, b[2], *sds


def magnitude_line(motions, low, high):
    """M on ln(PGV/PGA)."""
    ratio = np.log(motions["pgv_m_s"] / motions["pga_m_s2"]).to_numpy()
    mw = motions["mw"].clip(low, high).to_numpy()
    slope, intercept = np.polyfit(ratio, mw, 1)
    return intercept, slope, np.std(mw - intercept - slope * ratio), low, high


def of_records(lines):
    """What lines have of recorded motions, as it is written: the domain, rows, and the first number of terms."""
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    rows = [row[:4] if row[0] == "term" else row for row in rows]
    return [row for row in rows if row[0] in ("term", "domain") or row[1] == "recorded"]


def shipped(lines):
    """How many components and earthquakes, coefficients of recorded motions by event, and rows to keep."""
    numbers = Surface(lines).numbers
    b = {event: {term: numbers["term", event, term][0] for term in TERMS[event]} for event in TERMS}
    rows = {words: row for words, row in numbers.items() if words[0] == "domain" or words[1] == "recorded"}
    return re.search(r"(\d+) components of\n# (\d+) earthquakes", "\n".join(lines)).groups(), b, rows


def main():
    out, motions, records_responses, *studies = sys.argv[1:6]
    synthetic = pl.read_parquet(motions, columns=["suite", "pga_m_s2", "pgv_m_s", "mw"])
    cases, studies = of.read(sys.argv[6:], 0.15), [of.read([file]) for file in studies]
    motions_of = {kind: synthetic.filter(suite=kind) for kind in KINDS}
    if records_responses == "-":
        before = open(out).read().splitlines()
        recorded, (counts, b, kept) = None, shipped(before)
        found = {(event, "recorded"): (b[event], [0.0] * 4, None) for event in TERMS}
    else:
        recorded, kept = of.read([records_responses]), {}
        motions_of["recorded"] = recorded.filter(scale="x1").unique("motion_id").sort("motion_id")
        counts = len(motions_of["recorded"]), recorded["cluster"].n_unique()
        found = {(event, "recorded"): of_recorded(event, cases, recorded) for event in TERMS}
    unique = {"structures": cases["structure"].n_unique(), "motions": cases["motion_id"].n_unique()}
    lines = HEAD.format(**unique, cases=len(cases), records=counts[0], earthquakes=counts[1]).splitlines()

    def put(numbers, form, *words):
        """Of the table that is there is kept what is not made anew."""
        numbers = kept[words] if words in kept else numbers()
        lines.append(",".join([*words, *(format(number, form) for number in numbers)]))

    of_im5 = np.quantile(cases["im5"], [0.001, 0.999])
    for name, ends in (DOMAIN | {"im4": (1.0, MOST_IM4), "im5": of_im5}).items():
        put(lambda: ends, ".4g", "domain", name)
    found |= {(event, kind): of_synthetic(event, kind, cases) for event in TERMS for kind in KINDS[1:]}
    by_event = [(event, kind) for event in TERMS for kind in KINDS]
    for event, terms in TERMS.items():
        for term in [*terms, *SYNTHETIC[event]]:
            row = [found[event, kind][0].get(term, 0.0) for kind in KINDS]
            put(lambda: row, ".6g", "term", event, term)
    for event, kind in by_event:
        put(lambda: found[event, kind][2], ".4g", "uplift", kind, event)
    for kind, of_kind in motions_of.items():
        ends = MW.get(kind, (5.5, 7.5))
        put(lambda: magnitude_line(of_kind, *ends), ".4g", "magnitude", kind)
        for name in ("pga", "pgv"):
            put(lambda: peak_line(of_kind, name), ".4f", "peaks", kind, name)
    surface = Surface(lines)
    for event, kind in by_event:
        *mean, h = found[event, kind][1]
        spreads = lambda: priors(surface, event, kind, cases, recorded, studies, mean)
        put(lambda: (*mean, *spreads(), h), ".3f", "calibration", kind, event)
    assert recorded is not None or of_records(lines) == of_records(before)
    with open(out, "w") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
