"""Fits what a floor adds to the surface: python surface.py motions AT2.parquet OUT.parquet; fit UNIVERSAL.csv RESPONSES

The motions are each component at eight floors of buildings drawn (T1 log-uniform .1 to 3 s, level uniform .1 to 1), .5
to 2.5 times as strong; their ids are NAME|earthquake|magnitude|PGA|PGV of the ground|T1|level. To their responses is
fitted logit P = Z + f (a + b ln(p T1)), of P_ex also + f h ln(limit/0.1): Z the logit as shipped at the floor's own
peaks and the magnitude, f the resonant share of the floor's velocity."""

import pathlib
import sys

import numpy as np
import polars as pl

import motions
import peaks

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "universal"))
from calibration import apply  # noqa: E402
from cases import counted  # noqa: E402
from fit import added_left_out, loss_of  # noqa: E402
from surface import LIMITS, Surface  # noqa: E402

FOLDS = 8


def on_floors(imported, out):
    rng, rows = np.random.default_rng(42), []
    for name, earthquake, mw, ground, dt in motions.records(imported):
        for _ in range(8):
            period, level = np.exp(rng.uniform(np.log(0.1), np.log(3.0))), rng.uniform(0.1, 1.0)
            a = np.exp(rng.uniform(np.log(0.5), np.log(2.5))) * ground
            pga, pgv = motions.peaks(a, dt)
            a = motions.rested(a, dt, 3 * period / (2 * np.pi * 0.05))
            motion_id = f"{name}|{earthquake}|{mw}|{pga:.6g}|{pgv:.6g}|{period:.6g}|{level:.6g}"
            (floor,) = motions.floors(a, dt, period, [level])
            rows.append((motion_id, float(dt), mw, floor.astype(np.float32)))
    columns = ["motion_id", "dt_s", "mw", "acceleration_m_s2"]
    pl.DataFrame(dict(zip(columns, zip(*rows)))).write_parquet(out)


def read(file):
    """Cases that rock, with the earthquake and the floor that the id of a motion names."""
    cluster, *numbers = (pl.col("motion_id").str.split("|").list.get(k) for k in range(1, 7))
    numbers = {name: of.cast(float) for name, of in zip(("mw", "pga", "pgv", "period", "level"), numbers)}
    cases = pl.read_parquet(file).filter(pl.col("im4") > 1.0).with_columns(cluster=cluster, **numbers)
    u = (pl.col("period") * pl.col("pga") / (2 * np.pi * pl.col("pgv"))).log()
    u, level = cases.select(u=u, level="level").to_numpy().T
    share, overturned = peaks.median(peaks.START["pfv"], u, level)[1], pl.col("outcome") == "overturning"
    return cases.with_columns(share=share, overturned=overturned)


def of_limit(surface, event, cases, limit):
    cases = counted(event, cases, limit)
    z = apply(surface.prior(event, "recorded", limit), surface.parts(event, "recorded", cases))
    return cases.with_columns(z=z).filter(pl.col("z").is_finite())


def terms(event, cases):
    """f, f ln(p T1) and, of P_ex, f ln(limit/0.1): n x 2 or 3."""
    p, period, limit, f = cases.select("p_rad_s", "period", "limit", "share").to_numpy().T
    terms = [f, f * np.log(p * period), f * np.log(limit / 0.1)]
    return np.stack(terms if event == "pex" else terms[:2], axis=1)


def fit(table, responses):
    surface, floors = Surface(open(table)), read(responses)
    names = floors["cluster"].unique().sort()
    fold_of = dict(zip(names, np.random.default_rng(2).permutation(len(names)) % FOLDS))
    for event, limits in LIMITS.items():
        cases = pl.concat([of_limit(surface, event, floors, limit) for limit in limits])
        z, happened = cases["z"].to_numpy(), cases["happened"].to_numpy()
        b, left = added_left_out(z, terms(event, cases), happened, cases["cluster"].replace_strict(fold_of).to_numpy())
        scores = (np.round(-loss_of(logit, happened) / len(z), 4) for logit in (z, left))
        print(event, b.round(3), "log score as on the ground and with earthquakes left out:", *scores)


what, *files = sys.argv[1:]
{"motions": on_floors, "fit": fit}[what](*files)
