"""Recorded motions, and what a linear building makes of them.

The records are FEMA P695's and those that scripts/universal/make.sh imports (at2.parquet)."""

import pathlib
import sys

import numpy as np
import polars as pl
from scipy.signal import cont2discrete, lfilter, ss2tf

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from common import fema, peaks  # noqa: E402, F401
from rocking import rested  # noqa: E402, F401


def records(imported):
    """(name, earthquake by one name in both sources, magnitude, acceleration in m/s2, time step) of all."""
    columns = "motion_id", "earthquake", "mw", "dt_s", "acceleration_m_s2"
    of_fema, others = (of[1:] for of in fema()), pl.read_parquet(imported).select(columns).rows()
    for name, earthquake, mw, dt, a in [*of_fema, *others]:
        yield name, f"{earthquake[:4].upper()} {mw:.1f}", mw, np.asarray(a), dt


def absolute(acceleration, dt, period):
    """Absolute acceleration of an oscillator at rest, damped by 5 %, under lines between samples."""
    w = 2 * np.pi / period
    pull = [-w * w, -0.1 * w]
    system = [np.array(matrix, float) for matrix in ([[0, 1], pull], [[0], [-1]], [pull], [[0]])]
    b, a = ss2tf(*cont2discrete(system, dt, method="foh")[:4])
    return lfilter(b[0], a, acceleration)


def participation(level, modes=5):
    odd = 2 * np.arange(1, modes + 1) - 1
    return 4 / (odd * np.pi) * np.sin(odd * np.pi * level / 2)


def floors(acceleration, dt, period, levels, modes=5):
    """Accelerations of the floors of a uniform shear beam of first period `period`: levels x samples."""
    shares = participation(np.array(levels)[:, None], modes)
    of_modes = np.stack([absolute(acceleration, dt, period / (2 * i + 1)) for i in range(modes)])
    return (1 - shares.sum(axis=1))[:, None] * acceleration + shares @ of_modes
