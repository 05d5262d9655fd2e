"""All motions of the surface in one file: python motions.py ROCK.parquet SOIL.parquet OUT.parquet"""
import sys
import numpy as np
import polars as pl
COLS = ["suite", "cell", "mw", "re_km", "tp_s", "tm_s", "dt_s", "pga_m_s2", "pgv_m_s", "acceleration_m_s2"]
rng = np.random.default_rng(2015)
base = pl.concat([pl.read_parquet(f, columns=COLS) for f in sys.argv[1:3]])
f = np.exp(rng.uniform(np.log(0.5), np.log(3), base.height)).astype("f4")
scaled = base.with_columns(
    pl.col("pga_m_s2", "pgv_m_s") * pl.lit(pl.Series(f)),
    pl.Series("acceleration_m_s2", [a * k for a, k in zip((x.to_numpy() for x in base["acceleration_m_s2"]), f)], dtype=pl.List(pl.Float32)),
)
out = pl.concat([base, scaled]).with_row_index("motion_id").with_columns(pl.col("motion_id").cast(pl.Int64))
out.write_parquet(sys.argv[3], row_group_size=256)
