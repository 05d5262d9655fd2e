"""Rates on floors, predicted over counted: python rates.py ROCKFRAG AT2.parquet FOLDER

Every fourth component scaled to PGA of .1 to 1.6 g, filtered to ten floors; twelve objects; a hazard that
falls with the power 2.2 of PGA."""

import pathlib
import sys

import numpy as np
import polars as pl

import motions
import common

STRONGEST_M_S = 5.0
LEVELS_G = np.geomspace(0.1, 1.6, 8)
OBJECTS = [(0.3, 0.9), (0.3, 1.2), (0.4, 1.6), (0.5, 1.8), (0.6, 1.8), (0.6, 2.2), (0.8, 2.2), (0.8, 2.6),
           (1.0, 3.0), (1.2, 4.0), (0.25, 0.8), (0.45, 2.0)]  # fmt: skip
rockfrag, imported, folder = (pathlib.Path(word).resolve() for word in sys.argv[1:])


def call(*arguments):
    """What rockfrag writes."""
    common.call(rockfrag, *arguments, "--out", folder / "out.parquet", "--force")
    return pl.read_parquet(folder / "out.parquet")


def rate(p_of_motions):
    of_levels = peaks.with_columns(p=p_of_motions).group_by("k").agg(pl.col("p").mean()).sort("k")
    return -np.diff(LEVELS_G**-2.2, append=0.0) @ of_levels["p"].to_numpy()


def predicted(width, height, *floor):
    p = call("evaluate", "--in", folder / "peaks.parquet", "--width", width, "--height", height, *floor)
    return rate(p["p_overturning"])


def scaled():
    """Of each motion its acceleration, time step, level, peaks and magnitude."""
    for _, _, mw, a, dt in list(motions.records(imported))[::4]:
        for k, level in enumerate(LEVELS_G):
            strong = a * level * 9.81 / np.abs(a).max()
            pga, pgv = motions.peaks(strong, dt)
            if pgv <= STRONGEST_M_S:
                yield motions.rested(strong, dt, 10), float(dt), k, pga, pgv, mw


folder.mkdir(exist_ok=True)
ground, steps, *columns = zip(*scaled())
peaks = pl.DataFrame(columns, ["k", "pga_m_s2", "pgv_m_s", "mw"]).with_row_index("motion_id")
peaks.write_parquet(folder / "peaks.parquet")
objects = pl.DataFrame(OBJECTS, ["width", "height"], orient="row").with_row_index("name")
objects.with_columns(pl.format("o{}", "name")).write_csv(folder / "objects.csv")
logs = []
for period, z in [(t, z) for t in (0.2, 0.4, 0.7, 1.1, 1.8) for z in (0.5, 1.0)]:
    samples = [motions.floors(a, dt, period, [z])[0].astype(np.float32) for a, dt in zip(ground, steps)]
    on_floor = pl.DataFrame({"motion_id": peaks["motion_id"], "dt_s": steps, "acceleration_m_s2": samples})
    on_floor.write_parquet(folder / "floor.parquet")
    responses = call("simulate", "--in", folder / "floor.parquet", "--structures", folder / "objects.csv")
    for i, size in enumerate(OBJECTS):
        of_object = responses.filter(pl.col("structure") == f"o{i}").sort(pl.col("motion_id").cast(int))
        counted = rate((of_object["outcome"] == "overturning").cast(float))
        if counted > 0:
            logs.append(np.log(predicted(*size, "--period", period, "--level", z) / counted))
factors = np.exp(np.abs(logs))
print(f"median {np.exp(np.median(logs)):.2f}, within 1.5 {np.mean(factors < 1.5):.2f}, worst {factors.max():.1f}")
