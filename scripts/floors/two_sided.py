"""How often bodies with the centre of mass off the middle overturn, and the symmetric block of their weaker
side: python two_sided.py

FEMA P695's 100 components, both polarities, four scales, 12 bodies, offsets of .1 to .4 of the half width. Needs
numba.
"""

import itertools
import math

import numpy as np

import motions
from rocking import FREE, body, demand, rested

SIZES = [(0.2, 0.6), (0.25, 0.75), (0.3, 0.9), (0.35, 1.6), (0.4, 1.2), (0.4, 1.8), (0.5, 2.0), (0.6, 1.2),
         (0.6, 1.8), (0.8, 2.2), (1.0, 3.0), (1.5, 4.0)]  # fmt: skip
OFFSETS = [0.1, 0.2, 0.3, 0.4]
SCALES = [0.5, 1.0, 1.5, 2.5]


def weaker(width, height, offset):
    (alpha, p, eta), (_, _, other) = body(width, height, offset)
    return [(alpha, p, math.sqrt(eta * other))] * 2


records = [(rested(a / 9.81, dt), dt) for *_, a, dt in motions.components()]
counts = np.zeros((len(SIZES), len(OFFSETS), len(SCALES), 2))
for (i, size), (j, offset), (k, scale) in itertools.product(*map(enumerate, (SIZES, OFFSETS, SCALES))):
    two, one = np.array(body(*size, offset)), np.array(weaker(*size, offset))
    for a, dt in records:
        found = [np.isinf(demand(sign * scale * a, dt, two, FREE)) for sign in (1.0, -1.0)]
        counts[i, j, k] += sum(found), 2 * np.isinf(demand(scale * a, dt, one, FREE))
share = counts[..., 0] / (2 * len(records))
for low, high in ((0.2, 0.95), (0.05, 0.2), (0.005, 0.05)):
    within = (share >= low) & (share < high)
    of_offset = [counts[:, j][within[:, j]].sum(axis=0) for j in range(len(OFFSETS))]
    two, one = sum(of_offset)
    print(f"P {low} to {high}: weaker side over body {one / two:.2f}; offsets",
          *(f"{offset}: {one / two:.2f}" for offset, (two, one) in zip(OFFSETS, of_offset)))
