"""Fits what a floor adds to the surface: python surface.py UNIVERSAL.csv GROUND_RESPONSES FLOOR_RESPONSES

logit P = c + s L + m (M - 6.9) + f (a + b ln(p T1)), L the logit of the surface at the floor's own peaks, f the resonant
share of the floor's velocity; on the ground f is 0."""

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


def fit(logit, cases, happened, with_floor, with_magnitude):
    columns = np.stack([cases["share"], cases["share"] * np.log(cases["p_rad_s"] * cases["period"]), cases["mw"] - 6.9])
    columns = columns[[k for k, on in enumerate((with_floor, with_floor, with_magnitude)) if on]]

    def loss(b):
        z = b[0] + np.exp(b[1]) * logit + b[2:] @ columns
        p = 1 / (1 + np.exp(-z))
        gradient = p - happened
        return (np.logaddexp(0, z) - happened * z).mean() + 1e-6 * b @ b, np.concatenate(
            [[gradient.mean(), (gradient * np.exp(b[1]) * logit).mean()], columns @ gradient / len(z)]
        ) + 2e-6 * b

    return minimize(loss, np.zeros(2 + len(columns)), jac=True, method="BFGS").x


def score(z, happened):
    return -(np.logaddexp(0, z) - happened * z).mean()


def main():
    surface = Surface(sys.argv[1])
    cases = read(*sys.argv[2:4])
    names = sorted(set(cases["cluster"]))
    place = dict(zip(names, np.random.default_rng(2).permutation(len(names)) % FOLDS))
    fold = np.array([place[name] for name in cases["cluster"]])
    for event, limit in (("pro", 0.2), ("pex", 0.1), ("pex", 0.05), ("pex", 0.2), ("pex", 0.5)):
        of = cases if event == "pro" else some(cases, ~cases["overturned"])
        folds = fold if event == "pro" else fold[~cases["overturned"]]
        logit = surface.logit(event, "recorded", of, limit)
        happened = (of["overturned"] if event == "pro" else of["edp"] > limit).astype(float)
        floor = of["level"] > 0
        for with_floor, with_magnitude in ((False, False), (False, True), (True, False), (True, True)):
            z = np.zeros(len(logit))
            for k in range(FOLDS):
                train = folds != k
                b = fit(logit[train], some(of, train), happened[train], with_floor, with_magnitude)
                z[~train] = apply(b, logit[~train], some(of, ~train), with_floor, with_magnitude)
            b = fit(logit, of, happened, with_floor, with_magnitude)
            print(f"{event} {limit} floor {with_floor} magnitude {with_magnitude}:", np.round(b, 3), f"left out: ground {score(z[~floor], happened[~floor]):.4f}, floors {score(z[floor], happened[floor]):.4f}, observed/expected {happened[floor].sum() / (1 / (1 + np.exp(-z[floor]))).sum():.3f}")


def apply(b, logit, cases, with_floor, with_magnitude):
    columns = np.stack([cases["share"], cases["share"] * np.log(cases["p_rad_s"] * cases["period"]), cases["mw"] - 6.9])
    columns = columns[[k for k, on in enumerate((with_floor, with_floor, with_magnitude)) if on]]
    return b[0] + np.exp(b[1]) * logit + b[2:] @ columns


if __name__ == "__main__":
    main()
