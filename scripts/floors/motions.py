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


def components():
    """(name, earthquake, magnitude, acceleration in m/s2, time step in s) of each component of FEMA P695."""
    return ((name, key(earthquake, mw), mw, a, dt) for _, name, earthquake, mw, dt, a in fema())


def records(imported):
    """The same of these and of the imported ones."""
    yield from components()
    columns = "motion_id", "earthquake", "mw", "acceleration_m_s2", "dt_s"
    for name, earthquake, mw, a, dt in pl.read_parquet(imported).select(columns).rows():
        yield name, key(earthquake, mw), mw, np.asarray(a), dt


def key(earthquake, magnitude):
    """One name of an earthquake in both sources."""
    return f"{earthquake[:4].upper()} {magnitude:.1f}"


def absolute(acceleration, dt, period, damping=0.05):
    """Absolute acceleration of an oscillator at rest under lines between samples."""
    w = 2 * np.pi / period
    pull = [-w * w, -2 * damping * w]
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
