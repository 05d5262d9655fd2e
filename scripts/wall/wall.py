"""Objects in front of a wall: their responses, and what the wall adds to the logits of the surface: python
wall.py respond AT2.parquet OUT.parquet [records|blocks STEP]; fit UNIVERSAL.csv OUT.parquet; cells
OUT.parquet WALL.csv, the falls of blocks by cells of PGA and PGV (core/tests/reference/wall.csv)

One-sided rocking, with the wall in either of both directions, under the records of scripts/universal/make.sh,
whose AT2.parquet is read. Needs numba.
"""

import itertools
import pathlib
import sys

import numpy as np
import polars as pl
from numba import njit

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE.parent / "universal"), str(HERE.parent / "floors")]
import cases as of  # noqa: E402
import motions  # noqa: E402
from calibration import apply, logistic  # noqa: E402
from fit import added_left_out  # noqa: E402
from rocking import FREE, demand  # noqa: E402
from surface import LIMITS, Surface, features  # noqa: E402

REBOUNDS = [0.0, 0.3, 0.5, 0.7, 0.9]
WALLS = [f"{side}{e}" for e in REBOUNDS for side in ("near", "far")]
FOLDS, CLASSES = 8, [0.02, 0.1, 0.3, 0.6, 0.9, 0.98]
TAIL_S = 6.0


@njit(cache=True)
def demands(a, dt, structures, rebounds):
    """n structures x (1 + 2 k): free, then with the wall on either side for each of k rebounds."""
    out = np.zeros((len(structures), 1 + 2 * len(rebounds)))
    for i in range(len(structures)):
        p, alpha, eta = structures[i]
        sides = np.array([[alpha, p, eta], [alpha, p, eta]])
        if np.abs(a).max() > np.tan(alpha):
            out[i, 0] = demand(a, dt, sides, FREE)
            for j, rebound in enumerate(rebounds):
                out[i, 1 + 2 * j : 3 + 2 * j] = demand(a, dt, sides, rebound), demand(-a, dt, sides, rebound)
    return out


def respond(imported, out, which="records", step=3):
    structures, rows = np.array(of.chosen(which))[:: int(step)], []
    for (name, earthquake, mw, a, dt), factor in itertools.product(motions.records(imported), of.FACTORS):
        pga, pgv = motions.peaks(factor * a, dt)
        u = motions.rested(factor * a / 9.81, dt, TAIL_S)
        for structure, found in zip(structures, demands(u, dt, structures, np.array(REBOUNDS))):
            if found[0] > 0.0:
                rows.append((f"{name} x{factor:g}", earthquake, mw, pga, pgv, *structure, *found))
    columns = "motion_id cluster mw pga_m_s2 pgv_m_s p_rad_s alpha_rad eta free".split()
    pl.DataFrame(rows, [*columns, *WALLS], orient="row").write_parquet(out)


def counted(surface, responses, event, limit):
    """Cases with the logit by the surface at eta .85 and what it leaves to the wall: `of`, by columns."""
    uplift = 9.81 * pl.col("alpha_rad").tan()
    ims = {"im4": pl.col("pga_m_s2") / uplift, "im5": pl.col("p_rad_s") * pl.col("pgv_m_s") / uplift}
    rows = responses.with_columns(**ims, eta=0.85, limit=limit).filter(pl.col("im4") > 1.0)
    prior = surface.prior(event, "recorded", limit)
    rows = rows.with_columns(z=apply(prior, surface.parts(event, "recorded", rows)), **features())
    rows = rows.filter(pl.col("z").is_finite())
    rows = rows.unpivot(WALLS, index=["cluster", "z", "x", "p"], variable_name="e", value_name="demand")
    fell, e = pl.col("demand").is_infinite(), pl.col("e").str.strip_chars("nearf").cast(float)
    rows = rows.with_columns(e=e, s=np.exp(prior[1]), h=fell if event == "pro" else pl.col("demand") > limit)
    return rows.filter(~fell | (event == "pro"))


def fit(table, responses):
    """L += a + b e^2 + c x + d ln(p/2), eta at .85; judged on earthquakes left out, in eight parts."""
    surface, responses = Surface(open(table)), pl.read_parquet(responses)
    for event, limits in LIMITS.items():
        cases = pl.concat([counted(surface, responses, event, limit) for limit in limits])
        s, e = pl.col("s"), pl.col("e")
        columns = s, (s * e**2).alias("b"), pl.col("x", "p") * s
        happened, part = cases["h"].to_numpy().astype(float), cases["cluster"].rank("dense").to_numpy() % FOLDS
        b, left = added_left_out(cases["z"].to_numpy(), cases.select(columns).to_numpy(), happened, part)
        print(event, "a, b, c, d", b.round(2))
        cases = cases.with_columns(p=logistic(left), h=happened)
        means = cases.group_by("e", pl.col("p").cut(CLASSES).alias("P")).agg(pl.col("p", "h").mean())
        for (e,), of_e in means.sort("e", "P").group_by("e", maintain_order=True):
            print(e, "foretold/counted", *(f"{p:.3f}/{h:.3f}" for p, h in of_e.select("p", "h").rows()))


def cells(responses, out):
    """Of blocks: means of the motions of a cell, how many, and the share that falls with each rebound."""
    rows, structure = pl.read_parquet(responses), ["p_rad_s", "alpha_rad"]
    bins = [(pl.col(peak).log() / 0.5).floor().alias(f"of_{peak}") for peak in ("pga_m_s2", "pgv_m_s")]
    means = {name: pl.col(name).log().mean().exp() for name in ("pga_m_s2", "pgv_m_s", "mw")}
    fallen = lambda e: pl.mean_horizontal(pl.col(f"near{e}", f"far{e}").is_infinite()).mean()
    falls = {f"p_{e}": fallen(e) for e in REBOUNDS}
    found = rows.group_by(*structure, *bins).agg(**means, n=pl.len(), **falls).select(pl.exclude("^of_.*$"))
    found.filter((pl.col("n") >= 20) & (pl.col("p_0.7") > 0)).sort(pl.all()).write_csv(out, float_precision=4)


what, *arguments = sys.argv[1:]
{"respond": respond, "fit": fit, "cells": cells}[what](*arguments)
