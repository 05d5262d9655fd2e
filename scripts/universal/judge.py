"""Prints how well the surface does, as tables in Markdown: python judge.py SURFACE.csv FOLDER [synthetic]"""

import sys

import numpy as np
import polars as pl
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

import cases as of
from calibration import apply, calibrate, logistic, spread, tangent
from fit import monotone_logistic
from make import CLASSES, held, of_cells_left_out, of_records_left_out, shift
from surface import CORRECTED, KINDS, LIMIT, TERMS, Surface, design, uplift

_, path, FOLDER, *only_synthetic = sys.argv
surface = Surface(open(path))
rng = np.random.default_rng(1)
OF_M = pl.col("mw").cut([5.5, 6.4], labels=["below 5.5", "5.5 to 6.4", "6.4 and more"], left_closed=True)
BINS = pl.col("p").cut([0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95])


def show(title, frame):
    wide = {"tbl_rows": -1, "tbl_cols": -1, "tbl_width_chars": 250, "tbl_hide_column_data_types": True}
    with pl.Config(tbl_formatting="MARKDOWN", float_precision=4, **wide, tbl_hide_dataframe_shape=True):
        print(f"\n{title}\n\n{frame}", flush=True)


def score():
    p = pl.col("p").clip(1e-6, 1 - 1e-6)
    return pl.when("happened").then(p.log()).otherwise((1 - p).log()).mean()


def scored(frame, **by):
    """Cases, observed and expected events, their ratio and mean log score, by groups."""
    sums = {"observed": pl.col("happened").sum(), "expected": pl.col("p").sum()}
    ratio = sums["observed"] / sums["expected"]
    return frame.group_by(**by).agg(cases=pl.len(), **sums, ratio=ratio, score=score()).sort(*by)


LIMITS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9)


def demand_left_out():
    """A demand above each limit state: each earthquake of the table by what the others tell (make.shift)."""
    logit = lambda cases: surface.parts("pex", "recorded", cases)[:, 0]
    of_table, judged = RECORDS.filter(~pl.col("motion_id").str.contains("field")), []
    for (earthquake,), mine in of_table.group_by("cluster", maintain_order=True):
        b = shift("pex", logit, RECORDS.filter(pl.col("cluster") != earthquake))
        for limit in LIMITS:
            cases = of.counted("pex", mine, limit)
            _, m, _ = surface.parts("pex", "recorded", cases).T
            z = b[0] + np.exp(b[1]) * (logit(cases) + design(CORRECTED["pex"], cases) @ b[7:])
            z += b[2] * m + b[3] * np.log(1.1 - limit) + uplift(cases, np.exp(b[4:7]))
            judged.append(cases.with_columns(p=pl.Series(logistic(z)), z=pl.Series(z)))
    judged = pl.concat(judged)
    sums = judged.group_by("limit", "cluster").agg(pl.col("happened", "p").sum()).sort("limit", "cluster")
    drawn = rng.integers(0, sums["cluster"].n_unique(), (2000, sums["cluster"].n_unique()))
    for (limit,), of_limit in sums.group_by("limit", maintain_order=True):
        ratios = np.divide(*(of_limit[name].to_numpy()[drawn].sum(axis=1) for name in ("happened", "p")))
        print(limit, "observed/expected by drawn earthquakes:", np.quantile(ratios, [0.025, 0.975]).round(2))
    show("Records, demand, earthquakes left out, by limit state", scored(judged, limit="limit"))
    by = {"limit": pl.col("limit"), "p_of": pl.col("p_rad_s").cut([1.5, 2.5])}
    by["is_chi_chi"] = pl.col("cluster") == "CHICHI"
    show("The same by p", scored(judged, **by).select(*by, "observed", "ratio"))
    coverage("pex", "recorded", judged.filter(limit=LIMIT))


def earthquakes_left_out(event):
    """Each earthquake of the table predicted by c, ln s and m of the others, of both sources."""
    for name, mw in {"with M": pl.col("mw"), "M unknown": pl.lit(None, pl.Float64)}.items():
        judged = of_records_left_out(surface, event, RECORDS, mw)
        judged = judged.with_columns(p=pl.Series(logistic(judged["z"].to_numpy())))
        for by in ({"M": pl.lit("all")}, {"M": OF_M}, {"p": BINS}):
            show(f"Records, {event}, earthquakes left out, {name}", scored(judged, **by))
        if name == "with M":
            coverage(event, "recorded", judged)


def coverage(event, kind, frame):
    """How often 95 % limits at one motion, with tau and without, allow the count in a group (make.held)."""
    tau = surface.numbers["calibration", kind, event][6]
    rows = [(CLASSES[k], *holds.astype(float)) for k, holds in held(frame, [tau, 0.0])]
    means = pl.DataFrame(rows, ["P from", "with tau", "without"], orient="row").group_by("P from")
    means = means.agg(pl.len().alias("groups"), pl.all().mean())
    show(f"Coverage at one motion, {event}, {kind}, tau {tau}", means.sort("P from"))


def between_structures(event):
    groups = of.counted(event, RECORDS, LIMIT).partition_by("structure")
    known = [(surface.parts(event, "recorded", group), group["happened"].to_numpy()) for group in groups]
    sds = spread(known, surface.prior(event, "recorded")[:3])
    print(f"{event}: sds of c, ln s, m between structures", sds.round(2))


def cells_left_out(event):
    for kind in KINDS[1:]:
        study = of.read([f"{FOLDER}/study_102.parquet"], 1.0, kind)
        coverage(event, kind, of_cells_left_out(surface, event, kind, study, surface.prior(event, kind)))


def of_draws(event, mine, n, prior):
    """Four draws of n cases of a block: whether limits of P hold the truth, a calibration to all cases."""
    parts, tau = surface.parts(event, "recorded", mine), surface.numbers["calibration", "recorded", event][6]
    y, clusters = (mine[name].to_numpy() for name in ("happened", "cluster"))
    truth, _ = calibrate(parts, y, np.array([*prior[:3], 2.0, 1.0, 0.5]))
    pool = np.flatnonzero(np.abs(apply(truth, parts)) < 3.9)
    for _ in range(4):
        drawn = rng.choice(len(y), n, replace=False)
        b, v = calibrate(parts[drawn], y[drawn], prior, clusters[drawn], tau)
        points = parts[rng.choice(pool, 8)]
        by, z = tangent(b, points), apply(b, points)
        half = 1.96 * np.sqrt(np.einsum("ij,jk,ik->i", by, v, by))
        yield np.mean(np.abs(z - apply(truth, points)) < half)


def few_records(event):
    """Own records of 60 blocks, by magnitude."""
    cases = of.counted(event, of.read([f"{FOLDER}/blocks.parquet"]).filter(scale="x1"), LIMIT)
    prior, rows = surface.prior(event, "recorded"), []
    for (m, _), mine in cases.with_columns(M=OF_M).group_by("M", "structure", maintain_order=True):
        for n in (8, 15, 40):
            if min(mine["happened"].sum(), (~mine["happened"]).sum()) >= 5 and len(mine) >= 2 * n:
                rows += [(m, n, holds) for holds in of_draws(event, mine, n, prior)]
    draws = pl.DataFrame(rows, ["M", "records", "holds"], orient="row").group_by("M", "records")
    means = draws.agg(pl.len().alias("draws"), pl.all().mean()).sort("M", "records")
    show(f"Few records of one's own, {event}", means)


def own(event, kind, cases):
    """P by what is fitted to one's own cases, as functions of cases; few are 350 of the motions."""
    lines = lambda c: np.stack([np.ones(len(c)), np.log(c["im4"]), np.log(c["im3"])], axis=1)
    bent = lambda c: np.column_stack([lines(c), lines(c)[:, [1, 1, 2]] * lines(c)[:, [1, 2, 2]]])
    y, prior = cases["happened"].to_numpy(), surface.prior(event, kind)
    quadratic = monotone_logistic(bent(cases), y.astype(float), np.zeros((0, 6)), 0.01)
    probit = lambda b: -log_ndtr(np.where(y, 1, -1) * (lines(cases) @ b)).sum()
    straight = minimize(probit, [0.0, 1.0, -1.0], method="BFGS").x
    parts = lambda c: surface.parts(event, kind, c)
    motions = rng.permutation(cases["motion_id"].unique().sort())
    few = cases["motion_id"].is_in(motions[:350].tolist()).to_numpy()
    calibrated = lambda which: calibrate(parts(cases)[which], y[which], prior)[0]
    by_b = lambda b: lambda c: logistic(apply(b, parts(c)))
    return {
        "probit of IM4, IM3": lambda c: ndtr(lines(c) @ straight),
        "quadratic": lambda c: logistic(bent(c) @ quadratic),
        "surface": by_b(prior), "calibrated": by_b(calibrated(y | True)), "of few": by_b(calibrated(few)),
    }  # fmt: skip


def own_responses(event):
    rows = []
    for kind in KINDS[1:]:
        study = [of.read([f"{FOLDER}/study_{seed}.parquet"], 1.0, kind) for seed in (101, 102, 103)]
        for number in range(22):
            fitted, *judged = [of.counted(event, cases.filter(structure=number), LIMIT) for cases in study]
            on_both = lambda p_of: np.mean([c.with_columns(p=p_of(c)).select(score()).item() for c in judged])
            scores = {name: on_both(p_of) for name, p_of in own(event, kind, fitted).items()}
            rows.append({"kind": kind, "share": fitted["happened"].mean()} | scores)
    by = {"kind": "kind", "band": pl.col("share").cut([0.05, 0.2])}
    means = pl.DataFrame(rows).group_by(**by).agg(pl.len().alias("structures"), pl.all().mean()).sort(*by)
    title = f"Own responses, {event}: fitted to 3500 motions (few: 350), mean log score on two other seeds"
    show(title, means.drop("share"))


TABLES = [cells_left_out, own_responses]
if not only_synthetic:
    RECORDS = of.read([f"{FOLDER}/records.parquet"])
    TABLES = [earthquakes_left_out, few_records, between_structures, *TABLES]
    demand_left_out()
for event in TERMS:
    for table in TABLES:
        table(event)
