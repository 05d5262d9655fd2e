"""Writes made-up records to try import-motions on: example_records.py FOLDER [NUMBER]

Each is a velocity pulse (Mavroeidis & Papageorgiou 2003) with high frequencies on it, in the AT2 format of
PEER. They are of no earthquake: for figures of a publication take real records.
"""

import math
import pathlib
import random
import sys

DT = 0.01
SAMPLES = 2000
G = 9.81


def pulse(t, amplitude, period, gamma, phase):
    """Velocity of the pulse (Eq. 1), m/s, whose middle is at 8 s."""
    x = 2 * math.pi * (t - 8) / period
    if abs(x) > math.pi * gamma:
        return 0.0
    return amplitude / 2 * (1 + math.cos(x / gamma)) * math.cos(x + phase)


def acceleration(rng):
    """Samples in g, with no velocity left at the end."""
    amplitude, period = math.exp(rng.uniform(math.log(0.3), math.log(2.0))), rng.uniform(1.0, 4.0)
    gamma, phase = rng.uniform(1.2, 2.5), rng.uniform(0, 2 * math.pi)
    rest = rng.uniform(0.3, 1.2)
    waves = [(2 * math.pi * rng.uniform(2, 12), rng.uniform(0, 2 * math.pi)) for _ in range(30)]
    # Its envelope is 1 at 8 s, and 0 with its slope at both ends.
    shape = lambda t: math.exp(-(((t - 8) / 3) ** 2))
    shake = lambda t: shape(t) * sum(rest / w**2 * math.sin(w * t + start) for w, start in waves)
    noise = [shake(DT * i) for i in range(-1, SAMPLES + 1)]
    speed = [pulse(DT * (i - 0.5), amplitude, period, gamma, phase) for i in range(SAMPLES + 1)]
    bend = lambda i: (noise[i] - 2 * noise[i + 1] + noise[i + 2]) / DT**2
    return [(bend(i) + (speed[i + 1] - speed[i]) / DT) / G for i in range(SAMPLES)]


HEAD = """MADE-UP RECORD, OF NO EARTHQUAKE
Example {}, 1/1/2000, Nowhere, 0
ACCELERATION TIME SERIES IN UNITS OF G
NPTS= {}, DT= {:.4f} SEC
"""
folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
for index in range(1, int(sys.argv[2]) + 1 if len(sys.argv) > 2 else 41):
    samples = acceleration(random.Random(index))
    rows = [f"{value:15.6E}" + "\n" * (k % 5 == 4) for k, value in enumerate(samples)]
    (folder / f"example-{index:02}.AT2").write_text(HEAD.format(index, SAMPLES, DT) + "".join(rows))
