"""Amplitudes at which one cycle of a sine overturns a slender block: python one_sine.py
core/tests/reference/rocking

With r = amplitude/(g alpha), x = theta/alpha and time in 1/p, x'' = x - s - r sin(w t) on the side s = 1 or
-1 has a closed form; only the times of impact, where x' falls to eta x', are roots. Writes to one_sine.csv by
w/p all r from 1.1 to 12 at which the outcome changes: without an impact, and after one.
"""

import pathlib
import sys

import numpy as np
from scipy.optimize import bisect, brentq

ETA, FREQUENCIES, MOST, STEP = 0.9, (2.0, 3.0, 5.0, 7.0), 12.0, 0.005


class Arc:
    """The motion on one side from a state at rest or after an impact: x and x' at t; w = 0 is free motion."""

    def __init__(self, side, t, x, v, r, w):
        self.side, self.t, self.r, self.w = side, t, r / (1 + w * w), w
        sine, cosine = (self.r * f(w * t) for f in (np.sin, np.cos))
        x, v = x - side - sine, v - w * cosine
        self.rising, self.falling = (x + v) / 2, (x - v) / 2

    def x(self, t):
        d = t - self.t
        return self.side + self.rising * np.exp(d) + self.falling * np.exp(-d) + self.r * np.sin(self.w * t)

    def v(self, t):
        d = t - self.t
        return self.rising * np.exp(d) - self.falling * np.exp(-d) + self.w * self.r * np.cos(self.w * t)


def impact(arc, end):
    """The first return to x = 0 before `end`, or none."""
    times = np.linspace(arc.t, end, 2000)[1:]
    back = np.flatnonzero(arc.side * arc.x(times) < 0)
    # Just after the start x is 0 but for rounding.
    back = back[times[back] > arc.t + 1e-6]
    return brentq(arc.x, times[max(back[0] - 1, 0)], times[back[0]], xtol=1e-14) if len(back) else None


def overturns(r, w):
    """Whether it overturns, and the impacts before."""
    t, end, impacts = np.arcsin(1 / r) / w, 2 * np.pi / w, 0
    arc = Arc(-1, t, 0.0, 0.0, r, w)
    while (hit := impact(arc, end)) is not None:
        impacts += 1
        arc = Arc(-arc.side, hit, 0.0, ETA * arc.v(hit), r, w)
    x, v, side = arc.x(end), arc.v(end), arc.side
    # Free motion: x - s grows as e^t, or the block comes back and may go over on the other side.
    if side * (x - side + v) > 0:
        return True, impacts
    speed = ETA * np.sqrt(v * v + 1 - (x - side) ** 2)
    return speed > 1, impacts + 1


def edges():
    """Rows of w/p, r, whether it overturns above r, and the impacts before."""
    grid = np.arange(1.1, MOST, STEP)
    for w in FREQUENCIES:
        happens = [overturns(r, w)[0] for r in grid]
        for k in np.flatnonzero(np.diff(happens)):
            r = bisect(lambda r: overturns(r, w)[0] - 0.5, grid[k], grid[k + 1], xtol=1e-11)
            over = r + 1e-10 if happens[k + 1] else r - 1e-10
            yield f"{w:g},{r:.9f},{int(happens[k + 1])},{overturns(over, w)[1]}"


if __name__ == "__main__":
    rows = ["w_p,r,overturns_above,impacts", *edges()]
    (pathlib.Path(sys.argv[1]) / "one_sine.csv").write_text("\n".join(rows) + "\n")
