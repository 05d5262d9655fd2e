"""The seven claims of the paper, in numbers over twenty seeds: python scripts/claims.py ROCKFRAG [SEEDS]

Runs pipeline.yaml, and 40 structures under the same motions. Writes core/data/claims.csv, from it the tables of
docs/review/claims.md, and docs/review/universality.svg. Needs polars, scipy and statsmodels.

Low and high are the limits of one more seed, mean -+ t sd sqrt(1 + 1/n), 95 %. A number is for its claim if the limits
of the mean over seeds, mean -+ t sd / sqrt(n), lie in what is claimed, against if outside, else undecided. A claim holds
if no number is against and most are for, in part if at least half are for, else it does not.
"""

import itertools
import pathlib
import re
import shutil
import sys
import tempfile

import numpy as np
import polars as pl
import statsmodels.api as sm
from polars import col
from scipy.special import log_ndtr, logit, ndtr
from scipy.stats import t

from common import ROOT, call

CLAIMS = pl.DataFrame(
    [
        ("a", "Bivariate measures beat univariate ones", "quality"),
        ("b", "Demand is biplanar", "planes"),
        ("c", "The planes meet at a PGA of 1.3 g tan α", "planes"),
        ("d", "Curves are approximately universal in p and α", "universality"),
        ("e", "Overturning is a matter of velocity", "overturning"),
        ("f", "Pulses of the same PGV overturn more often and with less scatter", "overturning"),
        ("g", "High frequencies make rocking, not overturning, more likely", "demand"),
    ],
    schema=["letter", "claim", "figure"], orient="row",
)  # fmt: skip
SUITES, LEAST_EVENTS, SEEDS = ("pulse", "csgm"), 10, range(1, 1 + int((sys.argv[2:] or [20])[0]))
TRANSITION, LIMIT, ROTATION_FLOOR = np.log(1.3), np.log(0.1), 1e-6
MANY = itertools.product(np.geomspace(0.5, 6, 8).round(2), np.linspace(0.1, 0.4, 5).round(3))
# The exponent of the hybrid is that of the paper's worked example, lambda = 1.5.
HYBRID = 0.6 * col("im4").log() - 0.4 * col("im3").log()
MEASURES = {"PGV": col("pgv_m_s").log(), "IM5": col("im5").log(), "the hybrid": HYBRID}
found = []


def note(letter, quantity, claimed, of, *values):
    found.extend((letter, quantity, claimed, *of, float(value)) for value in values)


def responses(path):
    """By suite and structure."""
    happened = {"rocks": col("outcome") != "no_rocking", "overturns": col("outcome") == "overturning"}
    floor = pl.max_horizontal("edp", ROTATION_FLOOR / col("alpha_rad"))
    rows = pl.read_parquet(path).with_columns(edp=floor, **happened, **MEASURES)
    rows = rows.select("suite", "structure", "im4", "im3", "edp", *happened, *MEASURES)
    return rows.partition_by("suite", "structure", as_dict=True)


def safe(rows):
    """ln of IM4, IM3 and demand in safe rocking."""
    rows = rows.filter(col("rocks") & ~col("overturns") & (col("im4") > 1))
    return np.log(rows.select("im4", "im3", "edp").to_numpy().T)


def plane(first, here, there):
    """Squares of the errors of ln demand, and log scores of a demand above the limit, by a fit to other cases."""
    columns, judged = (np.stack([np.ones_like(im4), first(im4), im3], axis=1) for im4, im3, _ in (here, there))
    b = np.linalg.lstsq(columns, here[2], rcond=None)[0]
    median, sd = judged @ b, np.std(here[2] - columns @ b)
    side = np.where(there[2] > LIMIT, 1, -1)
    return np.stack([(there[2] - median) ** 2, log_ndtr(side * (median - LIMIT) / sd)])


def planes(here, there):
    sides = [[of[:, (of[0] < TRANSITION) == low] for of in (here, there)] for low in (True, False)]
    return np.concatenate([plane(lambda im4: im4, *side) for side in sides], axis=1)


def probit(rows, measure):
    """mu and beta (Eq. 20)."""
    b0, b1 = sm.Probit(rows["overturns"].to_numpy(), sm.add_constant(rows[measure].to_numpy())).fit(disp=0).params
    return -b0 / b1, 1 / b1


def of_fits(of, pro, pex):
    """Scores are those of the files, of cells that are left out in turns."""
    score = {(fit["model"], fit["im_x"]): fit["held_out_log_score"] for fit in pex}
    one, two = score["plane", "im4"], score["biplanar", "im4"]
    best = max(of_model for (model, _), of_model in score.items() if model == "univariate")
    note("a", "log score of ln demand, one plane less best measure", "> 0", of, one - best)
    note("b", "log score of ln demand, two planes less one", "> 0", of, two - one)
    note("c", "IM4 at which the planes meet", "1.25 to 1.35", of, max(fit["transition_found"] or 0 for fit in pex))
    fits = {fit["im_x"] + (fit["im_y"] or ""): fit for fit in pro if fit["held_out_log_score"]}
    if {"im4", "im5", "im4im3_inv"} <= fits.keys():
        score = {name: fit["held_out_log_score"] for name, fit in fits.items()}
        best = max(score[name] for name, fit in fits.items() if not fit["im_y"])
        note("a", "log score of P_ro, hybrid less best measure", "> 0", of, score["im4im3_inv"] - best)
        note("e", "log score of P_ro, IM5 less IM4", "> 0", of, score["im5"] - score["im4"])
        note("e", "AUC, IM5 less IM4", "> 0", of, fits["im5"]["auc"] - fits["im4"]["auc"])


def of_seeds(of, here, there):
    """The rival, one plane in ln(ln IM4), by a fit to one seed and the cases of another."""
    two, one = planes(here, there).mean(axis=1), plane(np.log, here, there).mean(axis=1)
    note("b", "rms of ln demand, one plane in ln(ln IM4) less two", "", of, one[0] ** 0.5 - two[0] ** 0.5)
    note("b", "log score of P_ex, two planes less one in ln(ln IM4)", "", of, two[1] - one[1])


def of_suites(structure, pulse, csgm):
    both, suites = ("csgm less pulse", structure), (csgm, pulse)
    for which, its in ("rocking motions", [rows.filter("rocks") for rows in suites]), ("all motions", suites):
        if min(rows["overturns"].sum() for rows in its) >= LEAST_EVENTS / 2:
            mu, beta = np.subtract(*(probit(rows, "IM5") for rows in its))
            note("f", f"ln median IM5, {which}", "> 0", both, mu)
            note("f", f"dispersion over IM5, {which}", "> 0", both, beta)
    for event, claimed in ("rocks", "> 0"), ("overturns", "<= 0"):
        shares = [rows[event].mean() for rows in suites]
        note("g", f"share that {event}", claimed, both, shares[0] - shares[1])
    of_rocking = [rows.filter("rocks")["overturns"].mean() for rows in suites]
    note("g", "share of what rocks that overturns", "", both, of_rocking[0] - of_rocking[1])


def universality(of, runs):
    """`runs` has responses by structure, for each seed."""
    is_fitted = lambda rows: LEAST_EVENTS <= rows["overturns"].sum() <= rows["rocks"].sum() - LEAST_EVENTS
    names = [name for name in runs[0] if all(is_fitted(run[name]) for run in runs)]
    note("d", "structures with a curve in all seeds", "", of, *[len(names)] * len(runs))
    for measure in MEASURES:
        curves = [[probit(run[name].filter("rocks"), measure) for name in names] for run in runs]
        mu, beta = np.moveaxis(curves, 2, 0)
        spread, middle = mu.std(axis=1, ddof=1), mu.mean(axis=1, keepdims=True)
        note("d", f"sd of ln θ, {measure}", "", of, *spread)
        if measure != "PGV":
            note("d", f"sd of ln θ of one, between seeds, {measure}", "", of, *(mu - mu.mean(axis=0)).std(axis=1))
            note("d", f"sd of ln θ / mean β, {measure}", "< 0.5", of, *spread / beta.mean(axis=1))
        logits = logit(ndtr((middle - mu) / beta)).std(axis=1)
        note("d", f"sd, between structures, of logit P_ro at the mean median, {measure}", "", of, *logits)
    for run in runs:
        cases = [safe(run[name]) for name in names]
        own, whole = np.concatenate([planes(one, one)[0] for one in cases]), np.concatenate(cases, axis=1)
        ratio = (planes(whole, whole)[0].mean() / own.mean()) ** 0.5
        note("d", "rms of ln demand by planes of all / by own", "< 1.12", of, ratio)


rockfrag, runs, many = pathlib.Path(sys.argv[1]).resolve(), [], []
with tempfile.TemporaryDirectory() as folder:
    at = pathlib.Path(folder)
    (at / "pipeline.yaml").write_text(re.sub("(report|compare-paper): {}", "", (ROOT / "pipeline.yaml").read_text()))
    lines = [f"p {p} α {alpha},{p},{alpha},0.92" for p, alpha in MANY]
    (at / "many.csv").write_text("\n".join(["name,p,alpha,eta", *lines]))
    for seed in SEEDS:
        call(rockfrag, "run", f"--seed={seed}", folder=at)
        files = "--in=out/motions.parquet", "--structures=many.csv", "--out=many/responses.parquet"
        call(rockfrag, "simulate", *files, "--force", folder=at)
        runs.append(responses(at / "out/responses.parquet"))
        many.append(responses(at / "many/responses.parquet"))
        fits = [pl.read_parquet(at / f"out/{name}.parquet") for name in ("pro", "pex")]
        for of in runs[-1]:
            of_fits(of, *(rows.filter(suite=of[0], structure=of[1]).to_dicts() for rows in fits))
    call(rockfrag, "report", "--in=many", folder=at)
    shutil.copy(at / "many/report/universality.svg", ROOT / "docs/review")
for here, there in zip(runs, runs[1:] + runs[:1]):
    for of in here:
        of_seeds(of, safe(here[of]), safe(there[of]))
    for structure in dict.fromkeys(structure for _, structure in here):
        of_suites(structure, *(here[suite, structure] for suite in SUITES))
for suite in SUITES:
    of_suite = [{of[1]: rows for of, rows in run.items() if of[0] == suite} for run in many]
    universality((suite, "40 structures"), of_suite)

keys = ["letter", "quantity", "claimed", "suite", "structure"]
rows = pl.DataFrame(found, schema=[*keys, "value"], orient="row").group_by(keys, maintain_order=True)
rows = rows.agg(mean=pl.mean("value"), sd=pl.std("value"), n=pl.len()).join(CLAIMS, "letter")
rows = rows.sort("letter", "suite", "structure", descending=[False, True, True], maintain_order=True)
of_mean = rows["sd"] * t.ppf(0.975, rows["n"] - 1) / rows["n"].sqrt()
reach = of_mean * (rows["n"] + 1).sqrt()
bounds, side = col("claimed").str.extract_all(r"[\d.]+").cast(pl.List(float)).list, col("claimed").str.head(1)
least = pl.when(side == "<").then(-np.inf).otherwise(bounds.first())
most = pl.when(side == ">").then(np.inf).otherwise(bounds.last())
first, last = col("mean") - of_mean, col("mean") + of_mean
support = pl.when(col("claimed") == "").then(None).when((first >= least) & (last <= most)).then(pl.lit("for"))
support = support.when((last < least) | (first > most)).then(pl.lit("against")).otherwise(pl.lit("undecided"))
rows = rows.with_columns(low=col("mean") - reach, high=col("mean") + reach, support=support)
counts = {of: (col("support") == of).sum().over("letter") for of in ("for", "undecided", "against")}
judged = pl.sum_horizontal(counts.values())
verdict = pl.when((counts["against"] == 0) & (2 * counts["for"] > judged)).then(pl.lit("holds"))
verdict = verdict.when(2 * counts["for"] >= judged).then(pl.lit("holds in part")).otherwise(pl.lit("does not hold"))
rows = rows.with_columns(verdict=verdict, **counts)
columns = "claim", *keys[1:], "mean", "low", "high", "support", "verdict", "figure"
rows.select(columns).write_csv(ROOT / "core/data/claims.csv")


def markdown(rows):
    head, *lines = ["| " + " | ".join(line) + " |" for line in (rows.columns, *rows.rows())]
    return "\n".join([head, "|---" * rows.width + "|", *lines])


places = (1 - np.floor(np.log10(reach.to_numpy() + 1e-9))).clip(0, 4).astype(int)
marks = rows["support"].replace_strict({"undecided": "?", "against": "✗"}, default="")
few = [f" (n={n})" if n < len(SEEDS) else "" for n in rows["n"]]
shown = zip(rows["mean"], reach, places * (reach.to_numpy() > 0), marks, few)
cells = [f"{mean:.{k}f}±{half:.{k}f}{few}{mark}" for mean, half, k, mark, few in shown]
of = pl.format("{}, {}", col("structure").str.replace("electrical-", ""), "suite")
rows = rows.with_columns(pl.Series("cell", cells), of=of)
page = ROOT / "docs/review/claims.md"
verdicts = rows.select(col("letter").alias(""), "claim", "verdict", *[col(of).cast(str) for of in counts], "figure")
text, tables = page.read_text(), {"verdicts": verdicts.unique(maintain_order=True)}
for letter, its in rows.partition_by("letter", as_dict=True).items():
    tables[letter[0]] = its.pivot("of", index=["quantity", "claimed"], values="cell").fill_null("")
for name, of in tables.items():
    text = re.sub(f"(?s)(<!-- {name} -->\n).*?\n(?=<!-- / -->)", lambda mark: f"{mark[1]}\n{markdown(of)}\n\n", text)
page.write_text(text)
