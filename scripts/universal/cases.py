"""Cases of rocking as arrays; and the structures that they are of: python cases.py training|study|blocks OUT.csv"""

import sys

import numpy as np
import polars as pl
from scipy.stats import qmc

COLUMNS = ["structure", "p_rad_s", "alpha_rad", "eta", "edp", "im3", "im4", "im5", "pga_m_s2", "pgv_m_s"]


def read(files, share=1.0, suite=None):
    """Returns columns by name: the measures and parameters, `kind`, `overturned`, `structure` (a number) and
    `cluster`: the cell of magnitude and distance, or the earthquake of a record (motion_id: its set, a blank, EARTHQUAKE/component)."""
    parts = []
    for seed, file in enumerate(files):
        rows = pl.scan_parquet(file).filter((pl.col("outcome") != "no_rocking") & (pl.col("im4") > 1.0))
        rows = rows if suite is None else rows.filter(pl.col("suite") == suite)
        earthquake = pl.col("motion_id").cast(pl.String).str.extract(r" (\w+)/")
        cluster = pl.coalesce(earthquake, pl.format("{} {}", "mw", "re_km"))
        kind = pl.col("suite").fill_null("recorded")
        overturned = pl.col("outcome") == "overturning"
        rows = rows.select("motion_id", *COLUMNS, cluster=cluster, kind=kind, overturned=overturned).collect()
        parts.append(rows.sample(fraction=share, seed=seed).with_columns(pl.col("motion_id").cast(pl.String)))
    rows = pl.concat(parts).with_columns(pl.col("structure").str.extract(r"(\d+)").cast(pl.Int16))
    return {name: rows[name].to_numpy() for name in rows.columns}


def structures(n, seed, low, high, first=()):
    """Sobol points between `low` and `high` of p, alpha (both in logarithms) and eta."""
    low, high = ([np.log(at[0]), np.log(at[1]), at[2]] for at in (low, high))
    points = qmc.scale(qmc.Sobol(3, scramble=True, seed=seed).random(512)[:n], low, high)
    return [*first, *((np.exp(p), np.exp(alpha), eta) for p, alpha, eta in points)]


def housner(of):
    return [(p, alpha, 1.0 - 1.5 * np.sin(alpha) ** 2) for p, alpha, _ in of]


if __name__ == "__main__":
    LOW, HIGH = (0.4, 0.04, 0.7), (8.0, 0.5, 0.999)
    chosen = {
        "training": lambda: structures(320, 2015, LOW, HIGH),
        "test": lambda: structures(64, 777, LOW, HIGH),
        "study": lambda: structures(20, 22, (0.8, 0.07, 0.78), (6.0, 0.35, 0.97), [(1.0, 0.15, 0.92), (2.5, 0.20, 0.92)]),
        "blocks": lambda: housner(structures(60, 60, (1.0, 0.08, 0.7), (6.0, 0.4, 0.999))),
    }
    with open(sys.argv[2], "w") as file:
        file.write("name,p,alpha,eta\n")
        file.writelines(f"s{i:03d},{p:.5f},{a:.5f},{e:.5f}\n" for i, (p, a, e) in enumerate(chosen[sys.argv[1]]()))
