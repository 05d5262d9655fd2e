"""The rocking problem by numba: python rocking_numba.py MOTIONS.parquet

RK4 at the record's time step and bisection on impacts, all in machine code, as a careful Python programmer would write
it for speed, for the paper's electrical equipment. One thread, strict floating-point arithmetic (no fastmath). Prints
the time of the solver alone, once it is compiled, and the outcomes.
"""

import collections
import json
import math
import sys
import time

import numba
import pyarrow.parquet as pq

G = 9.81  # m/s2
P, ALPHA, ETA = 2.5, 0.20, 0.92  # rad/s, rad
REST_VELOCITY = 1e-6  # after an impact, a velocity below this share of p counts as none
HALF_PI = 0.5 * math.pi
HALVINGS = 34  # of the step in which an impact lies: to 6e-11 of it
OUTCOMES = ("no_rocking", "safe_rocking", "overturning")


@numba.njit
def free_rocking(rotation, velocity, alpha, eta):
    """Whether a structure that leaves the record in this state overturns, and its largest rotation to come.

    The velocity is per unit of p t. Between impacts v^2/2 + cos(alpha - r) is constant; an impact leaves
    eta^2 of the kinetic energy.
    """
    energy = 0.5 * velocity**2 + 2.0 * math.sin(alpha - 0.5 * rotation) * math.sin(0.5 * rotation)
    barrier = 2.0 * math.sin(0.5 * alpha) ** 2
    if rotation > alpha and (velocity >= 0.0 or energy <= barrier):
        return True, HALF_PI
    if velocity < 0.0:
        energy *= eta**2
    if energy > barrier:
        return True, HALF_PI
    # cos(alpha - r) = cos(alpha) + energy, without cancellation for small r.
    a = math.sin(0.5 * alpha)
    b = math.sqrt(max(a * a - 0.5 * energy, 0.0))
    sine = 0.5 * energy / (a * math.sqrt(1.0 - b * b) + b * math.sqrt(1.0 - a * a))
    return False, 2.0 * math.asin(min(sine, 1.0))


@numba.njit
def peak_between(r0, v0, r1, v1, h):
    """The largest rotation over a step of length h, of the states at its ends (cubic Hermite)."""
    largest = max(r0, r1)
    if v0 > 0.0 > v1:
        # The root of the derivative v0 h + 2 c s + 3 d s^2 in s, 0 to 1, without cancellation.
        c = 3.0 * (r1 - r0) - (2.0 * v0 + v1) * h
        d = 2.0 * (r0 - r1) + (v0 + v1) * h
        s = v0 * h / (math.sqrt(max(c * c - 3.0 * d * v0 * h, 0.0)) - c)
        largest = max(largest, r0 + s * (v0 * h + s * (c + s * d)))
    return largest


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


table = pq.read_table(sys.argv[1], columns=["dt_s", "acceleration_m_s2"])
samples = (motion.values.to_numpy(zero_copy_only=False).astype(float) / G for motion in table["acceleration_m_s2"])
motions = list(zip(table["dt_s"].to_pylist(), samples))
respond(motions[0][1], P * motions[0][0], ALPHA, ETA)  # compiles
start = time.process_time()
outcomes = collections.Counter(OUTCOMES[respond(ground, P * dt, ALPHA, ETA)[0]] for dt, ground in motions)
seconds = time.process_time() - start
json.dump({"ms_a_motion": 1e3 * seconds / len(motions), **outcomes}, sys.stdout)
