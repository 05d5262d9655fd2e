"""Bodies with the centre of mass off the middle and the block of their weaker side; falls in either of two
directions under both components of a record: python two_sided.py

FEMA P695's 100 components, both polarities, four scales, 12 bodies, offsets of .1 to .4 of the half width. Its 50
pairs, 12 objects (width, depth, height): over eight scales of a hazard that falls with the power 2.2 the rate of falls
in both directions as if independent, over that of either. Needs numba.
"""

import itertools

import numpy as np

import motions
from rocking import FREE, body, demand, rested

SIZES = [(0.2, 0.6), (0.25, 0.75), (0.3, 0.9), (0.35, 1.6), (0.4, 1.2), (0.4, 1.8), (0.5, 2.0), (0.6, 1.2),
         (0.6, 1.8), (0.8, 2.2), (1.0, 3.0), (1.5, 4.0)]  # fmt: skip
OFFSETS = [0.1, 0.2, 0.3, 0.4]
SCALES = [0.5, 1.0, 1.5, 2.5]
OBJECTS = [(0.3, 0.4, 0.9), (0.3, 0.3, 1.2), (0.4, 0.6, 1.6), (0.5, 0.5, 1.8), (0.6, 0.8, 1.8),
           (0.6, 0.6, 2.2), (0.8, 0.8, 2.2), (0.8, 1.0, 2.4), (1.0, 1.0, 3.0), (1.0, 1.2, 4.0),
           (0.25, 0.35, 0.8), (1.5, 1.5, 5.0)]  # fmt: skip
OF_PAIRS = np.geomspace(0.25, 3.0, 8)


records = [(rested(a / 9.81, dt), dt) for *_, dt, a in motions.fema()]
counts = np.zeros((len(SIZES), len(OFFSETS), len(SCALES), 2))
for (i, size), (j, offset), (k, scale) in itertools.product(*map(enumerate, (SIZES, OFFSETS, SCALES))):
    two = body(*size, offset)
    # The weaker side, with the mean of both etas.
    one = np.array([(*two[0, :2], np.sqrt(two[0, 2] * two[1, 2]))] * 2)
    for a, dt in records:
        found = [np.isinf(demand(sign * scale * a, dt, two, FREE)) for sign in (1.0, -1.0)]
        counts[i, j, k] += sum(found), 2 * np.isinf(demand(scale * a, dt, one, FREE))
share = counts[..., 0] / (2 * len(records))
for low, high in ((0.2, 0.95), (0.05, 0.2), (0.005, 0.05)):
    within = (share >= low) & (share < high)
    of_offset = [counts[:, j][within[:, j]].sum(axis=0) for j in range(len(OFFSETS))]
    print(f"P {low} to {high}: weaker side over body, by offsets", *(f"{one / two:.2f}" for two, one in of_offset))

weights, ratios = -np.diff(OF_PAIRS**-2.2, append=0.0), []
for width, depth, height in OBJECTS:
    sides = [body(side, height, 0.0) for side in (width, depth)]
    of_scale = lambda a, dt, scale: [np.isinf(demand(scale * a, dt, side, FREE)) for side in sides]
    fell = np.array([[of_scale(a, dt, scale) for scale in OF_PAIRS] for a, dt in records])
    # Of each scale: pair, component and side.
    fell = fell.reshape(-1, 2, len(OF_PAIRS), 2).transpose(2, 0, 1, 3)
    one_way, other_way = fell[..., 0, 0] | fell[..., 1, 1], fell[..., 0, 1] | fell[..., 1, 0]
    of_side = fell.mean(axis=(1, 2))
    independent = of_side.sum(axis=1) - of_side.prod(axis=1)
    ratios.append(2 * weights @ independent / (weights @ (one_way.mean(axis=1) + other_way.mean(axis=1))))
print(f"independent over either: {min(ratios):.2f} to {max(ratios):.2f}")
