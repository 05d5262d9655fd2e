"""Some 70 numbers of the paper's run by the tree at 6769d62: python paper_run.py OUT tests/reference

OUT is the folder that `rockfrag run` filled at that commit (seed 42). Writes paper_run.csv: name, suite,
structure, value. Needs polars.
"""

import pathlib
import sys

import polars as pl

out, folder = map(pathlib.Path, sys.argv[1:])
pex = pl.read_parquet(out / "pex.parquet").filter(pl.col("model") == "biplanar")
pro = pl.read_parquet(out / "pro.parquet")

tables = [
    ("low", pex.filter(pl.col("range_high").is_not_null()), ["ln_a", "b1", "b2", "r2"]),
    ("high", pex.filter(pl.col("range_high").is_null()), ["ln_a", "b1", "b2", "r2", "beta"]),
    ("im5", pro.filter(pl.col("im_x") == "im5", pl.col("im_y").is_null()), ["mu", "beta", "log_likelihood"]),
    ("hybrid", pro.filter(pl.col("im_y").is_not_null()), ["lambda", "mu", "log_likelihood", "auc", "brier", "se_mu_clustered"]),
]
lines = ["name,suite,structure,value"]
for prefix, table, columns in tables:
    for row in table.iter_rows(named=True):
        lines += [f"{prefix}_{column},{row['suite']},{row['structure']},{row[column]!r}" for column in columns]
(folder / "paper_run.csv").write_text("\n".join(lines) + "\n")
