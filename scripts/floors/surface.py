"""Fits what a floor adds to the surface: python surface.py UNIVERSAL.csv FLOOR_RESPONSES

logit P = Z + f (a + b ln(p T1)), of P_ex also + f h ln(limit/0.1): Z the logit as shipped at the floor's own
peaks and the magnitude, f the resonant share of the floor's velocity. The responses are those to the motions
of floors.py."""

import pathlib
import sys

import numpy as np
import polars as pl
from scipy.optimize import minimize

import peaks

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "universal"))
from calibration import apply  # noqa: E402
from cases import counted  # noqa: E402
from surface import NO_LIMIT, Surface  # noqa: E402

FOLDS = 8


def read(file):
    """Cases that rock, with the earthquake and the floor that the id of a motion names."""
    part = lambda k: pl.col("motion_id").str.split("|").list.get(k)
    cases = pl.read_parquet(file).filter(pl.col("im4") > 1.0).with_columns(
        cluster=part(1), mw=part(2).cast(float), period=part(5).cast(float), level=part(6).cast(float),
        overturned=pl.col("outcome") == "overturning", pga=part(3).cast(float), pgv=part(4).cast(float),
    )  # fmt: skip
    u = (pl.col("period") * pl.col("pga") / (2 * np.pi * pl.col("pgv"))).log()
    u, level = cases.select(u=u, level="level").to_numpy().T
    return cases.with_columns(share=peaks.median(peaks.START["pfv"], u, level)[1])


def of_limit(surface, event, cases, limit):
    cases = counted(event, cases, limit)
    z = apply(surface.prior(event, "recorded", limit), surface.parts(event, "recorded", cases))
    return cases.with_columns(z=z)


def terms(event, cases):
    """f, f ln(p T1) and, of P_ex, f ln(limit/0.1): n x 2 or 3."""
    narrow, limit = (pl.col("p_rad_s") * pl.col("period")).log(), (pl.col("limit") / 0.1).log()
    columns = {"a": pl.lit(1.0), "b": narrow} | ({"h": limit} if event == "pex" else {})
    return cases.select(**{name: pl.col("share") * factor for name, factor in columns.items()}).to_numpy()


def fit(event, cases):
    z, happened, columns = cases["z"].to_numpy(), cases["happened"].to_numpy(), terms(event, cases)
    loss = lambda b: -score(z + columns @ b, happened) + 1e-9 * b @ b
    return minimize(loss, np.zeros(columns.shape[1]), method="BFGS").x


def score(z, happened):
    return -(np.logaddexp(0, z) - happened * z).mean()


surface, floors = Surface(open(sys.argv[1])), read(sys.argv[2])
names = floors["cluster"].unique().sort()
fold_of = dict(zip(names, np.random.default_rng(2).permutation(len(names)) % FOLDS))
for event, limits in {"pro": [NO_LIMIT], "pex": [0.05, 0.1, 0.2, 0.5]}.items():
    cases = pl.concat([of_limit(surface, event, floors, limit) for limit in limits])
    cases = cases.filter(pl.col("z").is_finite()).with_columns(fold=pl.col("cluster").replace_strict(fold_of))
    left = cases["z"].to_numpy().copy()
    for k in range(FOLDS):
        out = cases["fold"].to_numpy() == k
        left[out] += terms(event, cases.filter(out)) @ fit(event, cases.filter(~out))
    z, happened = cases["z"].to_numpy(), cases["happened"].to_numpy()
    print(event, fit(event, cases).round(3), "log score as on the ground and with earthquakes left out:",
          score(z, happened).round(4), score(left, happened).round(4))
