"""How often an object falls in either of two directions under both components of a record: python pairs.py

FEMA P695's 50 pairs at eight scales; widths and depths of 12 objects; the annual rate over scales of a hazard
that falls with the power 2.2: of falls in both directions, summed or independent, over that of either. Needs
numba."""

import numpy as np

import motions
from rocking import FREE, body, demand, rested

OBJECTS = [(0.3, 0.4, 0.9), (0.3, 0.3, 1.2), (0.4, 0.6, 1.6), (0.5, 0.5, 1.8), (0.6, 0.8, 1.8),
           (0.6, 0.6, 2.2), (0.8, 0.8, 2.2), (0.8, 1.0, 2.4), (1.0, 1.0, 3.0), (1.0, 1.2, 4.0),
           (0.25, 0.35, 0.8), (1.5, 1.5, 5.0)]  # fmt: skip
SCALES = np.geomspace(0.25, 3.0, 8)

records = [(rested(a / 9.81, dt), dt) for *_, a, dt in motions.components()]
weights = -np.diff(SCALES**-2.2, append=0.0)
ratios = []
for width, depth, height in OBJECTS:
    sides = [np.array(body(side, height, 0.0)) for side in (width, depth)]
    of_scale = lambda a, dt, scale: [np.isinf(demand(scale * a, dt, side, FREE)) for side in sides]
    fell = np.array([[of_scale(a, dt, scale) for scale in SCALES] for a, dt in records])
    # Of each scale: pair, component and side.
    fell = fell.reshape(-1, 2, len(SCALES), 2).transpose(2, 0, 1, 3)
    one_way, other_way = fell[..., 0, 0] | fell[..., 1, 1], fell[..., 0, 1] | fell[..., 1, 0]
    either = (one_way.mean(axis=1) + other_way.mean(axis=1)) / 2
    of_side = fell.mean(axis=(1, 2))
    both = of_side.sum(axis=1), of_side.sum(axis=1) - of_side.prod(axis=1)
    ratios.append([weights @ p / (weights @ either) for p in both])
    print(width, depth, height, "sum and independent over either: {:.2f} {:.2f}".format(*ratios[-1]))
for of in np.array(ratios).T:
    print(f"all: {np.exp(np.log(of).mean()):.2f} ({of.min():.2f} to {of.max():.2f})")
