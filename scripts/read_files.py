"""Reads every file of a run with polars and with pandas and checks that both see the same: python read_files.py OUT

Needs polars, pandas and pyarrow.
"""

import pathlib
import sys

import pandas as pd
import polars as pl

files = sorted(pathlib.Path(sys.argv[1]).glob("*.parquet"))
if not files:
    sys.exit(f"{sys.argv[1]}: no Parquet file; expected the folder of a run")
for file in files:
    with_polars, with_pandas = pl.read_parquet(file), pd.read_parquet(file)
    if with_polars.columns != list(with_pandas.columns) or with_polars.height != len(with_pandas):
        sys.exit(f"{file}: polars and pandas see different tables")
    for name, dtype in with_polars.schema.items():
        if dtype.is_numeric():
            ours, theirs = with_polars[name].sum(), with_pandas[name].sum()
            if abs(ours - theirs) > 1e-9 * max(abs(ours), 1.0):
                sys.exit(f"{file}, column {name}: the sum is {ours} with polars, {theirs} with pandas")
    print(f"{file.name:24} {with_polars.height:8} rows {with_polars.width:3} columns")
