"""The rocking problem by scipy: solve_ivp, RK45, with impacts and overturning as events.

    python rocking_scipy.py MOTIONS.parquet COUNT

One call of solve_ivp from event to event. What makes it as fast as it gets: the right-hand side works on
Python floats, not on arrays of two; no step is longer than a sample, because the steps that fail at the kinks
of the ground acceleration cost more; peaks come from the steps themselves, not from a third event.
"""

import bisect
import math
import sys

import numpy as np
from scipy.integrate import solve_ivp

from common import ALPHA, ETA, HALF_PI, P, REST_VELOCITY, free_rocking, peak_between, read_motions, report


RTOL, ATOL = 1e-6, 1e-10  # of r (rad) and of dr/d(p t)


def respond(dt, acceleration_over_g):
    """Outcome and demand, in x = p t and r = |theta| on the side to which the structure leans."""
    alpha, eta = ALPHA, ETA
    tan, sin, cos = math.tan(alpha), math.sin, math.cos
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
        angle = alpha - r
        return v, -(sin(angle) + side * acceleration(x) * cos(angle))

    def impact(x, state):
        return state[0]

    def overturning(x, state):
        return state[0] - HALF_PI

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

    x, r, v, side = 0.0, 0.0, 0.0, 0.0
    peak, rocked = 0.0, False
    while x < end:
        if side == 0.0:
            lifted = uplift(x)
            if lifted is None:
                break
            (x, side), r, v, rocked = lifted, 0.0, 0.0, True
        options = {"events": (impact, overturning), "rtol": RTOL, "atol": ATOL, "max_step": step}
        flight = solve_ivp(derivative, (x, end), (r, v), "RK45", **options)
        times, rotations, velocities = flight.t.tolist(), *flight.y.tolist()
        for k in np.flatnonzero((flight.y[1, :-1] > 0.0) & (flight.y[1, 1:] < 0.0)).tolist():
            ends = rotations[k], velocities[k], rotations[k + 1], velocities[k + 1]
            peak = max(peak, peak_between(*ends, times[k + 1] - times[k]))
        x, r, v = times[-1], rotations[-1], velocities[-1]
        peak = max(peak, r)
        if flight.t_events[1].size:
            return "overturning", HALF_PI / alpha
        if flight.t_events[0].size:
            r, v, side = 0.0, -eta * v, -side
            if v < REST_VELOCITY:
                side = 0.0
    if not rocked:
        return "no_rocking", 0.0
    if side != 0.0:
        overturns, later = free_rocking(r, v, alpha, eta)
        if overturns:
            return "overturning", HALF_PI / alpha
        peak = max(peak, later)
    return "safe_rocking", peak / alpha


report(respond, read_motions(sys.argv[1], int(sys.argv[2])))
