"""Fits what a floor adds to the surface: python surface.py UNIVERSAL.csv GROUND_RESPONSES FLOOR_RESPONSES

logit P = Z + f (a + b ln(p T1)), of P_ex also + f h ln(limit/0.1): Z the logit as shipped at the floor's own peaks and the
magnitude, f the resonant share of the floor's velocity; on the ground f is 0."""

import pathlib
import sys

import numpy as np
import polars as pl
from scipy.optimize import minimize

import motions
import peaks

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "universal"))
from surface import Surface, some  # noqa: E402

PFV = peaks.START["pfv"]
FOLDS = 8


def read(ground, floor):
    names = ["structure", "p_rad_s", "alpha_rad", "eta", "outcome", "edp", "pga_m_s2", "pgv_m_s"]
    ground = pl.read_parquet(ground).with_columns(mw=pl.col("magnitude").cast(pl.Float64))
    ground = ground.with_columns(
        cluster=pl.col("earthquake").str.slice(0, 4).str.to_uppercase() + pl.format(" {}", pl.col("mw").round(1)),
        period=pl.lit(1.0), level=pl.lit(0.0), ground_pga=pl.col("pga_m_s2"), ground_pgv=pl.col("pgv_m_s"),
    )  # fmt: skip
    parts = pl.col("motion_id").str.split("|").list
    floor = pl.read_parquet(floor).with_columns(
        cluster=parts.get(1), ground_pga=parts.get(3).cast(float), ground_pgv=parts.get(4).cast(float),
        period=parts.get(5).cast(float), level=parts.get(6).cast(float), mw=parts.get(2).cast(float),
    )  # fmt: skip
    columns = [*names, "cluster", "mw", "period", "level", "ground_pga", "ground_pgv"]
    rows = pl.concat([frame.select(columns).cast({pl.Float32: pl.Float64}) for frame in (ground, floor)])
    rows = rows.with_columns(
        im4=pl.col("pga_m_s2") / (9.81 * pl.col("alpha_rad").tan()),
        im5=pl.col("p_rad_s") * pl.col("pgv_m_s") / (9.81 * pl.col("alpha_rad").tan()),
        im3=pl.col("pga_m_s2") / (pl.col("p_rad_s") * pl.col("pgv_m_s")), overturned=pl.col("outcome") == "overturning",
    ).filter(pl.col("im4") > 1.0)  # fmt: skip
    cases = {name: rows[name].to_numpy() for name in rows.columns}
    u = np.log(cases["period"] * cases["ground_pga"] / (2 * np.pi * cases["ground_pgv"]))
    shares = motions.participation(cases["level"][:, None])
    A, B = peaks.terms(np.array(PFV), u, shares)
    cases["share"] = B / (A**2 + B)
    return cases


def columns(cases, limit):
    narrow = np.log(cases["p_rad_s"] * cases["period"])
    return cases["share"] * np.stack([np.ones_like(narrow), narrow, np.full_like(narrow, np.log(limit / 0.1))])


def fit(z, terms, happened):
    """The numbers of the terms that are added to z."""

    def loss(b):
        full = z + b @ terms
        p = 1 / (1 + np.exp(-full))
        return (np.logaddexp(0, full) - happened * full).mean() + 1e-9 * b @ b, terms @ (p - happened) / len(z) + 2e-9 * b

    return minimize(loss, np.zeros(len(terms)), jac=True, method="BFGS").x


def score(z, happened):
    return -(np.logaddexp(0, z) - happened * z).mean()


def main():
    surface = Surface(sys.argv[1])
    cases = read(*sys.argv[2:4])
    cases = some(cases, cases["level"] > 0)
    names = sorted(set(cases["cluster"]))
    place = dict(zip(names, np.random.default_rng(2).permutation(len(names)) % FOLDS))
    for event, limits in (("pro", (0.2,)), ("pex", (0.05, 0.1, 0.2, 0.5))):
        of = cases if event == "pro" else some(cases, ~cases["overturned"])
        fold = np.array([place[name] for name in of["cluster"]])
        z, terms, happened, folds = [], [], [], []
        for limit in limits:
            of_limit = np.full(len(fold), limit)
            z.append(surface.z(event, "recorded", of, limit))
            terms.append(columns(of, limit)[: 2 if event == "pro" else 3])
            happened.append((of["overturned"] if event == "pro" else of["edp"] > limit).astype(float))
            folds.append(fold)
        z, terms, happened, folds = np.concatenate(z), np.concatenate(terms, axis=1), np.concatenate(happened), np.concatenate(folds)
        known = np.isfinite(z)
        z, terms, happened, folds = z[known], terms[:, known], happened[known], folds[known]
        left = z.copy()
        for k in range(FOLDS):
            left[folds == k] += fit(z[folds != k], terms[:, folds != k], happened[folds != k]) @ terms[:, folds == k]
        p = 1 / (1 + np.exp(-left))
        print(event, np.round(fit(z, terms, happened), 3), f"log score as on the ground {score(z, happened):.4f} (observed/expected {happened.sum() / (1 / (1 + np.exp(-z))).sum():.3f}), earthquakes left out {score(left, happened):.4f} ({happened.sum() / p.sum():.3f})")
        for low, high in ((0.1, 0.3), (0.3, 0.7), (0.7, 1.4), (1.4, 3.0)):
            here = np.tile((of["period"] > low) & (of["period"] <= high), len(limits))[known]
            print(f"   T1 {low} to {high} s: observed/expected {happened[here].sum() / p[here].sum():.2f}, as on the ground {happened[here].sum() / (1 / (1 + np.exp(-z[here]))).sum():.2f}")


if __name__ == "__main__":
    main()
