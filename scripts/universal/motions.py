"""All motions in one file, and each a second time 0.5 to 3 times as strong: python motions.py ROCK.parquet SOIL.parquet OUT.parquet"""

import sys

import numpy as np
import polars as pl

COLUMNS = ["suite", "cell", "mw", "re_km", "tp_s", "tm_s", "dt_s", "pga_m_s2", "pgv_m_s", "acceleration_m_s2"]

motions = pl.concat([pl.read_parquet(file, columns=COLUMNS) for file in sys.argv[1:3]])
rng = np.random.default_rng(2015)
factors = np.exp(rng.uniform(np.log(0.5), np.log(3), motions.height)).astype("f4")
accelerations = [a.to_numpy() * factor for a, factor in zip(motions["acceleration_m_s2"], factors)]
scaled = motions.with_columns(
    pl.col("pga_m_s2", "pgv_m_s") * pl.Series(factors),
    pl.Series("acceleration_m_s2", accelerations, dtype=pl.List(pl.Float32)),
)
both = pl.concat([motions, scaled]).with_row_index("motion_id").with_columns(pl.col("motion_id").cast(pl.Int64))
both.write_parquet(sys.argv[3], row_group_size=256)
