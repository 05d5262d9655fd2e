"""Reads every file of a run with polars and with pandas and checks that both see the same: python read_files.py OUT

Needs polars, pandas and pyarrow.
"""

import pathlib
import sys

import numpy as np
import pandas as pd
import polars as pl
import polars.selectors as cs

files = sorted(pathlib.Path(sys.argv[1]).glob("*.parquet"))
if not files:
    sys.exit(f"{sys.argv[1]}: no Parquet file; expected the folder of a run")
for file in files:
    ours, theirs = pl.read_parquet(file), pd.read_parquet(file)
    assert (ours.columns, ours.height) == (list(theirs.columns), len(theirs)), file
    numbers = ours.select(cs.numeric())
    sums = numbers.sum().fill_null(0).row(0), theirs[numbers.columns].sum()
    np.testing.assert_allclose(*sums, rtol=1e-9, atol=1e-9, err_msg=str(file))
    print(f"{file.name:24} {ours.height:8} rows {ours.width:3} columns")
