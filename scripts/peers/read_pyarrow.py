"""Reads a motions file into memory by pyarrow, which simulate is measured against: python read_pyarrow.py MOTIONS.parquet

Prints the seconds of the first read in a process, which pays for the memory that it gets from the system.
"""

import json
import sys
import time

import pyarrow.dataset  # noqa: F401, which the read would else import
import pyarrow.parquet as pq

start = time.perf_counter()
pq.read_table(sys.argv[1])
json.dump({"read_s": time.perf_counter() - start}, sys.stdout)
