"""The rocking problem by numba or scipy: python solvers.py numba|scipy MOTIONS.parquet [COUNT]

A peer does the work of a stage as a careful Python programmer would write it for speed, and prints one JSON object
with its figures. Of the paper's electrical equipment under all motions, or COUNT evenly spaced ones, each with rest
behind it; the time is that of the solver alone, on one thread, once it is compiled. By numba: scripts/rocking.py. By
scipy: solve_ivp, RK45, from event to event; its right-hand side works on Python floats, not on arrays of two, and no
step is longer than a sample, because the steps that fail at the kinks of the ground acceleration cost more.
"""

import bisect
import collections
import json
import math
import pathlib
import sys
import time

import numpy as np
import pyarrow.parquet as pq
from scipy.integrate import solve_ivp

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from rocking import FREE, demand, rested  # noqa: E402

P, ALPHA, ETA = 2.5, 0.20, 0.92
RTOL, ATOL = 1e-6, 1e-10  # of r (rad) and of dr/d(p t)
REST_VELOCITY = 1e-6  # after an impact, a velocity below this share of p counts as none


def by_numba(dt, ground):
    """|theta|max / alpha, infinite where it overturns, of the acceleration over g."""
    return demand(ground, dt, np.array([[ALPHA, P, ETA]] * 2), FREE)


def by_scipy(dt, acceleration_over_g):
    """The same, in x = p t and r = |theta| on the side to which the structure leans."""
    tan, sin, cos = math.tan(ALPHA), math.sin, math.cos
    step = P * dt
    ground = acceleration_over_g.tolist()
    last = len(ground) - 1
    end = last * step
    # The intervals in which a structure at rest uplifts.
    above = np.abs(acceleration_over_g) >= tan
    lifting = np.flatnonzero(above[:-1] | above[1:]).tolist()

    def acceleration(x):
        position = x / step
        index = min(int(position), last - 1)
        start = ground[index]
        return start + (position - index) * (ground[index + 1] - start)

    def derivative(x, state):
        r, v = state.tolist()
        angle = ALPHA - r
        return v, -(sin(angle) + side * acceleration(x) * cos(angle))

    def impact(x, state):
        return state[0]

    def overturning(x, state):
        return state[0] - 0.5 * math.pi

    impact.terminal = overturning.terminal = True
    impact.direction = -1

    def uplift(x):
        """When a structure that rests at x uplifts, and to which side; None if it rests to the end."""
        start = min(int(x / step), last - 1)
        for index in lifting[bisect.bisect_left(lifting, start) :]:
            now, then = acceleration(x) if index == start else ground[index], ground[index + 1]
            if abs(now) > tan:
                return max(x, index * step), -math.copysign(1.0, now)
            if abs(then) > tan:
                share = (math.copysign(tan, then) - ground[index]) / (then - ground[index])
                return (index + share) * step, -math.copysign(1.0, then)
        return None

    x, r, v, side, peak = 0.0, 0.0, 0.0, 0.0, 0.0
    options = {"events": (impact, overturning), "rtol": RTOL, "atol": ATOL, "max_step": step}
    while x < end:
        if side == 0.0:
            lifted = uplift(x)
            if lifted is None:
                break
            (x, side), r, v = lifted, 0.0, 0.0
        flight = solve_ivp(derivative, (x, end), (r, v), "RK45", **options)
        x, (r, v), peak = float(flight.t[-1]), flight.y[:, -1].tolist(), max(peak, float(flight.y[0].max()))
        if flight.t_events[1].size:
            return math.inf
        if flight.t_events[0].size:
            r, v, side = 0.0, -ETA * v, -side
            if v < REST_VELOCITY:
                side = 0.0
    return peak / ALPHA


table, count = pq.read_table(sys.argv[2], columns=["dt_s", "acceleration_m_s2"]), [int(word) for word in sys.argv[3:]]
if count:
    table = table.take(np.linspace(0, table.num_rows - 1, *count).round().astype(int))
columns = (table[name].to_pylist() for name in table.column_names)
motions = [(dt, rested(np.array(acceleration) / 9.81, dt)) for dt, acceleration in zip(*columns)]
respond = {"numba": by_numba, "scipy": by_scipy}[sys.argv[1]]
by_numba(*motions[0])  # compiles
start = time.process_time()
demands = [respond(*motion) for motion in motions]
seconds = time.process_time() - start
outcome_of = lambda of: "overturning" if of == math.inf else "safe_rocking" if of else "no_rocking"
kinds = collections.Counter(map(outcome_of, demands))
json.dump({"ms_a_motion": 1e3 * seconds / len(motions), **kinds}, sys.stdout)
