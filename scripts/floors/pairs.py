"""How often an object falls in either of two directions under both components of a record: python pairs.py

FEMA P695's 50 pairs at eight scales; widths and depths of 12 objects; the annual rate over scales of a hazard that falls
with the power 2.2: of either direction, over the sum of both. Needs numba."""

import math

import numpy as np

import motions
from two_sided import TAIL_S, overturns

OBJECTS = [(0.3, 0.4, 0.9), (0.3, 0.3, 1.2), (0.4, 0.6, 1.6), (0.5, 0.5, 1.8), (0.6, 0.8, 1.8), (0.6, 0.6, 2.2), (0.8, 0.8, 2.2), (0.8, 1.0, 2.4), (1.0, 1.0, 3.0), (1.0, 1.2, 4.0), (0.25, 0.35, 0.8), (1.5, 1.5, 5.0)]
SCALES = np.geomspace(0.25, 3.0, 8)


def block(side, height):
    alpha = math.atan(side / height)
    p = math.sqrt(3 * 9.81 / (4 * 0.5 * math.hypot(side, height)))
    return np.array([(alpha, p, 1 - 1.5 * math.sin(alpha) ** 2)] * 2)


def main():
    records = [(np.concatenate([a, np.zeros(int(TAIL_S / dt))]), dt) for *_, a, dt in motions.fema()]
    pairs = list(zip(records[::2], records[1::2]))
    weights = SCALES**-2.2
    weights = -np.diff(np.append(weights, 0.0))
    logs = []
    for width, depth, height in OBJECTS:
        sides = block(width, height), block(depth, height)
        fell = np.zeros((len(pairs), len(SCALES), 2, 2), dtype=bool)
        for i, pair in enumerate(pairs):
            for k, scale in enumerate(SCALES):
                for c, (a, dt) in enumerate(pair):
                    for s, side in enumerate(sides):
                        fell[i, k, c, s] = overturns(scale * a, dt, side)
        either = 0.5 * ((fell[..., 0, 0] | fell[..., 1, 1]).mean(axis=0) + (fell[..., 0, 1] | fell[..., 1, 0]).mean(axis=0))
        one = fell.mean(axis=2).mean(axis=0)
        sums, inclusion = one.sum(axis=1), one.sum(axis=1) - one.prod(axis=1)
        rate = lambda p: (weights * p).sum()
        small = (one.max(axis=1) < 0.05) & (either > 0)
        logs.append((rate(sums) / rate(either), rate(inclusion) / rate(either)))
        print(width, depth, height, f"sum of rates over that of either {logs[-1][0]:.2f}, independent {logs[-1][1]:.2f}", f"P < .05: {sums[small].sum() / max(either[small].sum(), 1e-9):.2f}")
    print("all:", *(f"{np.exp(np.mean(np.log(column))):.2f} ({min(column):.2f} to {max(column):.2f})" for column in zip(*logs)))


if __name__ == "__main__":
    main()
