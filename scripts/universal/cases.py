"""Responses that rock, with what the curves need: read a share of them into memory."""

import numpy as np
import polars as pl

SUITES = {"pulse": 0, "csgm": 1, "hfc": 2}


def read(files, motions, share=1.0):
    """Records have neither suite nor cell: of them `motions` is none."""
    if motions:
        cells = pl.read_parquet(motions, columns=["motion_id", "cell"]).with_columns(pl.col("cell").cast(pl.Int16))
    parts = []
    for seed, file in enumerate(files):
        rows = pl.scan_parquet(file).filter((pl.col("outcome") != "no_rocking") & (pl.col("im4") > 1.0))
        rows = rows.select("motion_id", "suite", "structure", "p_rad_s", "alpha_rad", "eta", "outcome", "edp", "im3", "im4", "im5").collect()
        rows = rows.sample(fraction=share, seed=seed)
        rows = rows.join(cells, on="motion_id") if motions else rows.drop("motion_id", "suite").with_columns(suite=pl.lit("none"))
        parts.append(rows.with_columns(
            pl.col("suite").replace_strict(SUITES, default=-1, return_dtype=pl.Int8),
            overturned=pl.col("outcome") == "overturning",
            structure=pl.col("structure").str.extract(r"(\d+)").cast(pl.Int16).fill_null(-1),
        ))  # fmt: skip
    rows = pl.concat(parts)
    return {name: rows[name].to_numpy() for name in rows.columns if name != "outcome"}


def some(cases, which):
    return {name: values[which] for name, values in cases.items()}


def columns_of(cases, limit=0.2):
    import surface

    of_structure = (cases[name] for name in ("eta", "alpha_rad", "p_rad_s"))
    pulse, hfc = (1.0 * (cases["suite"] == SUITES[kind]) for kind in ("pulse", "hfc"))
    return surface.coordinates(cases["im4"], cases["im3"], *of_structure, limit, pulse, hfc)


def knots_of(cases):
    """Knots at quantiles, rounded; the same for both curves but for those of the limit state, which only one has."""
    u = columns_of(cases)
    five = [np.round(np.quantile(u[k], [0.02, 0.25, 0.5, 0.75, 0.98]), 2).tolist() for k in (0, 1)]
    return [*five, [], [], [], np.round(np.log(np.array([0.02, 0.15, 0.5]) / 0.2), 4).tolist(), [], []]
