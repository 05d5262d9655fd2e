"""Accelerations of floors by scipy.signal.lsim: python floors.py core/tests/reference

Ten motions of rocking/motions.parquet, each with 10 s of rest behind it, on nine floors of a uniform shear
beam, by state space with all five modes, of 5 % damping, at once; every hundredth sample and the largest, m/s2:
records/floors.csv.
"""

import itertools
import pathlib
import sys

import numpy as np
import pyarrow.parquet as pq
from scipy.signal import StateSpace, lsim

folder = pathlib.Path(sys.argv[1])
rows = pq.read_table(folder / "rocking/motions.parquet").to_pylist()[:10]


def beam(period, level):
    """Ground acceleration to the absolute acceleration of a floor."""
    odd = np.arange(1, 10, 2)
    w, share = 2 * np.pi * odd / period, 4 / (odd * np.pi) * np.sin(odd * np.pi * level / 2)
    a = np.block([[np.zeros((5, 5)), np.eye(5)], [np.diag(-w * w), np.diag(-0.1 * w)]])
    b = np.concatenate([np.zeros(5), -np.ones(5)])[:, None]
    c = np.concatenate([-share * w * w, -share * 0.1 * w])[None, :]
    return StateSpace(a, b, c, [[1 - share.sum()]])


with open(folder / "records/floors.csv", "w") as file:
    for row, period, level in itertools.product(rows, (0.3, 0.8, 2.0), (0.25, 0.6, 1.0)):
        ground = np.concatenate([row["acceleration_m_s2"], np.zeros(round(10 / row["dt_s"]))])
        floor = lsim(beam(period, level), ground, row["dt_s"] * np.arange(len(ground)))[1]
        some = [f"{a:.9g}" for a in (np.abs(floor).max(), *floor[::100])]
        print(row["motion_id"], period, level, *some, sep=",", file=file)
