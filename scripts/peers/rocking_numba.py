"""The rocking problem by numba: RK4 at the record's time step, bisection on impacts, all in machine code.

    python rocking_numba.py MOTIONS.parquet

One thread, strict floating-point arithmetic (no fastmath); the time is that of the solver alone, once it is
compiled.
"""

import math
import sys

import numba
import numpy as np

from common import ALPHA, ETA, HALF_PI, P, REST_VELOCITY, free_rocking, peak_between, read_motions, report

HALVINGS = 34  # of the step in which an impact lies: to 6e-11 of it
OUTCOMES = ("no_rocking", "safe_rocking", "overturning")

free_rocking = numba.njit(free_rocking)
peak_between = numba.njit(peak_between)


@numba.njit(inline="always")
def curvature(r, w, alpha):
    """r'' = -(sin(alpha - r) + w cos(alpha - r)); w: ground acceleration over g, above 0 towards the base."""
    return -(math.sin(alpha - r) + w * math.cos(alpha - r))


@numba.njit
def rk4(r, v, w, slope, h, alpha):
    """Rotation and velocity after a step of h in p t, through which w grows by `slope` per unit."""
    half = 0.5 * h
    a1 = curvature(r, w, alpha)
    v2 = v + half * a1
    a2 = curvature(r + half * v, w + half * slope, alpha)
    v3 = v + half * a2
    a3 = curvature(r + half * v2, w + half * slope, alpha)
    v4 = v + h * a3
    a4 = curvature(r + h * v3, w + h * slope, alpha)
    return r + h / 6.0 * (v + 2.0 * (v2 + v3) + v4), v + h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4)


@numba.njit
def impact_time(r, v, w, slope, h, alpha):
    """When, before h, the rotation returns to 0: the last time found at which it has not."""
    low, high = 0.0, h
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if rk4(r, v, w, slope, middle, alpha)[0] < 0.0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


@numba.njit
def respond(ground, step, alpha, eta):
    """Number of the outcome and |theta|max; `ground` is the acceleration over g at samples `step` = p dt apart."""
    tan = math.tan(alpha)
    r, v, side = 0.0, 0.0, 0.0
    peak, rocked = 0.0, False
    for index in range(ground.size - 1):
        start, end = ground[index], ground[index + 1]
        if side == 0.0 and abs(start) < tan and abs(end) < tan:
            continue
        slope = (end - start) / step
        x = 0.0
        while x < step:
            w = start + slope * x
            if side == 0.0:
                if abs(w) <= tan:
                    if abs(end) <= tan:
                        break
                    w = math.copysign(tan, end)
                    x = (w - start) / slope
                side, rocked = -math.copysign(1.0, w), True
                r, v = 0.0, 0.0
            h = step - x
            r1, v1 = rk4(r, v, side * w, side * slope, h, alpha)
            struck = r1 < 0.0
            if struck:
                h = impact_time(r, v, side * w, side * slope, h, alpha)
                r1, v1 = rk4(r, v, side * w, side * slope, h, alpha)
                x += h
            else:
                x = step
            peak = max(peak, peak_between(r, v, r1, v1, h))
            r, v = r1, v1
            if r >= HALF_PI:
                return 2, HALF_PI
            if struck:
                r, v, side = 0.0, -eta * v, -side
                if v < REST_VELOCITY:
                    side = 0.0
    if not rocked:
        return 0, 0.0
    if side != 0.0:
        overturns, later = free_rocking(r, v, alpha, eta)
        if overturns:
            return 2, HALF_PI
        peak = max(peak, later)
    return 1, peak


def answer(dt, ground):
    outcome, peak = respond(ground, P * dt, ALPHA, ETA)
    return OUTCOMES[outcome], peak / ALPHA


motions = read_motions(sys.argv[1])
answer(*motions[0])  # compiles
report(answer, motions)
