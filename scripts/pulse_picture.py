"""Draws the velocity of a recorded motion and the pulse fitted to it: python pulse_picture.py MOTIONS.parquet MOTION_ID OUT.png

Needs numpy, pyarrow and matplotlib.
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import pyarrow.parquet as pq

path, motion_id, out = sys.argv[1:]
rows = pq.read_table(path).to_pylist()
row = next(row for row in rows if row["motion_id"] == motion_id)
if row["tp_s"] is None:
    sys.exit(f"{motion_id} holds no pulse ({row['pulse_verdict']})")

acceleration = np.array(row["acceleration_m_s2"])
t = np.arange(len(acceleration)) * row["dt_s"]
velocity = np.concatenate([[0], np.cumsum(0.5 * row["dt_s"] * (acceleration[1:] + acceleration[:-1]))])

# Eq. 1
x = 2 * np.pi / row["tp_s"] * (t - row["t0_s"])
envelope = 0.5 * (1 + np.cos(x / row["gamma"])) * (abs(x) <= np.pi * row["gamma"])
pulse = row["pulse_amplitude_m_s"] * envelope * np.cos(x + row["nu_rad"])

figure, axes = plt.subplots(figsize=(8, 3.2), layout="constrained")
axes.plot(t, velocity, color="0.55", linewidth=1, label="recorded")
axes.plot(t, pulse, color="C3", linewidth=1.8, label="fitted pulse")
axes.set(xlabel="time, s", ylabel="velocity, m/s", xlim=(0, min(t[-1], row["t0_s"] + 4 * row["tp_s"])))
axes.set_title(
    f"{row['name']}: Tp {row['tp_s']:.2f} s, γ {row['gamma']:.2f}, ν {row['nu_rad']:.2f}, A {row['pulse_amplitude_m_s']:.2f} m/s; "
    f"indicator {row['pulse_indicator']:.3f}",
    fontsize=8,
)
axes.legend(frameon=False)
figure.savefig(out, dpi=110)
