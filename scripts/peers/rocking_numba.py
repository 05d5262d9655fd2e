"""The rocking problem by numba: RK4 at the record's time step, bisection on impacts, all in machine code.

    python rocking_numba.py MOTIONS.parquet --out responses.parquet

One thread, strict floating-point arithmetic (no fastmath); the time is that of the solver alone, once it is
compiled.
"""

import math

import numba
import numpy as np

from common import (
    HALF_PI,
    REST_VELOCITY,
    Response,
    Structure,
    free_rocking,
    peak_between,
    read_motions,
    report_rocking,
    rocking_arguments,
    timed,
)

HALVINGS = 34  # of the step in which an impact lies: to 6e-11 of it
OUTCOMES = ("no_rocking", "safe_rocking", "overturning")
NO_ROCKING, SAFE_ROCKING, OVERTURNING = range(3)

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
    """Outcome, |theta|max and impacts; `ground` is the acceleration over g at samples `step` = p dt apart."""
    tan = math.tan(alpha)
    r, v, side = 0.0, 0.0, 0.0
    peak, impacts, rocked = 0.0, 0, False
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
                return OVERTURNING, HALF_PI, impacts
            if struck:
                impacts += 1
                r, v, side = 0.0, -eta * v, -side
                if v < REST_VELOCITY:
                    side = 0.0
    if not rocked:
        return NO_ROCKING, 0.0, 0
    if side != 0.0:
        overturns, later = free_rocking(r, v, alpha, eta)
        if overturns:
            return OVERTURNING, HALF_PI, impacts
        peak = max(peak, later)
    return SAFE_ROCKING, peak, impacts


def main():
    parser = rocking_arguments(__doc__.splitlines()[0])
    parser.add_argument(
        "--repeat", type=int, default=5, help="runs over all motions, of which the median counts"
    )
    options = parser.parse_args()
    structure = Structure(options.p, options.alpha, options.eta)
    motions = read_motions(options.motions, options.ids, options.count)

    def run(motions):
        return [respond(m.ground, structure.p * m.dt, structure.alpha, structure.eta) for m in motions]

    _, (compilation, _) = timed(lambda: run(motions[:1]))
    answers, times = zip(*(timed(lambda: run(motions)) for _ in range(options.repeat)))
    responses = [
        Response(OUTCOMES[outcome], peak / structure.alpha, impacts) for outcome, peak, impacts in answers[0]
    ]
    report_rocking(
        "numba RK4",
        options,
        structure,
        motions,
        responses,
        np.median(times, axis=0),
        compilation_s=compilation,
    )


if __name__ == "__main__":
    main()
