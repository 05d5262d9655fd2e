"""Makes the motions of the solver's reference: python rocking_motions.py OUT.parquet

Sixty motions with a fixed seed: velocity pulses, pulses under decaying noise, half-sine and rectangular
pulses, and records that touch the uplift threshold of alpha = 0.15 exactly. Needs numpy and pyarrow.
"""

import sys

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

random = np.random.default_rng(2015)
motions = []


def add(dt, samples):
    motions.append((dt, np.asarray(samples, dtype=np.float32)))


def pulse(t, peak_velocity, period, gamma, phase, middle):
    x = 2 * np.pi / period * (t - middle)
    velocity = 0.5 * (1 + np.cos(x / gamma)) * np.cos(x + phase) * (abs(x) <= np.pi * gamma)
    return peak_velocity * np.gradient(velocity, t)


def noise(t, pga, start, duration):
    shape = np.clip((t - start) / duration, 0, None)
    envelope = shape**1.25 * np.exp(-6.27 * shape)
    raw = np.fft.rfft(random.normal(size=t.size) * envelope)
    f = np.fft.rfftfreq(t.size, t[1])
    raw *= f**2 / (1 + (f / 0.3) ** 2) * np.exp(-np.pi * 0.03 * f)
    series = np.fft.irfft(raw, t.size)
    return pga * series / abs(series).max()


for k in range(48):
    dt = random.choice([0.005, 0.01])
    period = random.uniform(0.4, 3.0)
    gamma = random.uniform(1.0, 2.5)
    length = min(max(gamma * period + 2.0, random.uniform(4.0, 9.0)), 12.0)
    t = np.arange(0.0, length, dt)
    motion = pulse(t, random.uniform(0.15, 1.2), period, gamma, random.uniform(0, np.pi), 0.5 * gamma * period + 0.5)
    if k % 4:
        motion = motion + noise(t, random.uniform(0.5, 6.0), 0.5, length - 0.5)
    add(dt, motion)

t = np.arange(0.0, 3.0, 0.01)
for amplitude, duration in [(2.0, 0.5), (4.0, 0.5), (6.0, 0.8), (10.0, 0.3)]:
    add(0.01, amplitude * np.sin(np.pi * t / duration) * (t <= duration))
    add(0.01, amplitude * (t <= duration))
threshold = 9.81 * np.tan(0.15)
add(0.01, threshold * (t <= 1.0))
add(0.01, np.minimum(threshold, 3.0 * t) * (t <= 2.0))
add(0.02, 1.05 * threshold * np.sin(7.0 * t))
add(0.1, 8.0 * np.sin(4.0 * t[::10]))

table = {
    "motion_id": pa.array(range(len(motions)), pa.int64()),
    "dt_s": [float(dt) for dt, _ in motions],
    "acceleration_m_s2": [samples for _, samples in motions],
}
encoding = {"acceleration_m_s2.list.element": "BYTE_STREAM_SPLIT", "motion_id": "PLAIN", "dt_s": "PLAIN"}
options = {"compression": "zstd", "use_dictionary": False, "column_encoding": encoding}
pq.write_table(pa.table(table), sys.argv[1], **options)
