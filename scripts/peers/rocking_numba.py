"""The rocking problem by numba, as a careful Python programmer would write it for speed (scripts/rocking.py): python
rocking_numba.py MOTIONS.parquet

The paper's electrical equipment under all motions, each with rest behind it. Prints the time of the solver alone, on
one thread, once it is compiled, and how many motions end in each outcome.
"""

import collections
import json
import pathlib
import sys
import time

import numpy as np
import pyarrow.parquet as pq

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from rocking import FREE, demand, rested  # noqa: E402

SIDES = np.array([[0.20, 2.5, 0.92]] * 2)

table = pq.read_table(sys.argv[1], columns=["dt_s", "acceleration_m_s2"])
columns = (table[name].to_pylist() for name in table.column_names)
motions = [(rested(np.array(acceleration) / 9.81, dt), dt) for dt, acceleration in zip(*columns)]
demand(*motions[0], SIDES, FREE)  # compiles
start = time.process_time()
demands = [demand(*motion, SIDES, FREE) for motion in motions]
seconds = time.process_time() - start
outcome_of = lambda of: "overturning" if of == np.inf else "safe_rocking" if of else "no_rocking"
json.dump({"ms_a_motion": 1e3 * seconds / len(motions), **collections.Counter(map(outcome_of, demands))}, sys.stdout)
