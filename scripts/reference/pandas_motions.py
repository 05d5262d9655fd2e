"""Writes motions as pandas has them, int32, float32 and an index: python pandas_motions.py
tests/reference/files/pandas.parquet"""

import sys

import numpy as np
import pandas as pd

motions = pd.DataFrame({"motion_id": np.array([1, 2, 3], dtype=np.int32), "dt_s": np.float32([0.0625, 0.0625, 0.0625])})
motions["acceleration_m_s2"] = [np.float32([0.0, k, -k, 0.0]) for k in (1.0, 3.0, 5.0)]
motions.index = [7, 8, 9]
motions.to_parquet(sys.argv[1])
