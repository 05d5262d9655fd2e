"""How often bodies with the centre of mass off the middle overturn, and the symmetric block of their weaker
side: python two_sided.py

Both edges in turn (theta'' = -p_i^2 (sin(alpha_i - |theta|) + ...), impacts by conservation of angular
momentum about the new edge), by Runge-Kutta in small steps, and 200 cases again by scipy's DOP853 with
events. FEMA P695's 100 components, both polarities, four scales, 12 bodies, offsets of .1 to .4 of the half
width. Needs numba.
"""

import itertools
import math

import numpy as np
from numba import njit

import motions

SIZES = [(0.2, 0.6), (0.25, 0.75), (0.3, 0.9), (0.35, 1.6), (0.4, 1.2), (0.4, 1.8), (0.5, 2.0), (0.6, 1.2),
         (0.6, 1.8), (0.8, 2.2), (1.0, 3.0), (1.5, 4.0)]  # fmt: skip
OFFSETS = [0.1, 0.2, 0.3, 0.4]
SCALES = [0.5, 1.0, 1.5, 2.5]
SUBSTEPS, TAIL_S = 4, 8.0


def body(width, height, offset):
    """(alpha, p, eta of the impact onto it) of the edge that the centre of mass is nearer to, and the other."""
    b, h, inertia = width / 2, height / 2, (width**2 + height**2) / 12
    near, far = b - offset * b, b + offset * b
    sides = []
    for here, other in ((near, far), (far, near)):
        eta = (inertia + h * h - here * other) / (inertia + here * here + h * h)
        radius = math.hypot(here, h)
        sides.append((math.atan(here / h), math.sqrt(9.81 * radius / (inertia + radius**2)), eta))
    return sides


def weaker(width, height, offset):
    (alpha, p, eta), (_, _, other) = body(width, height, offset)
    return [(alpha, p, math.sqrt(eta * other))] * 2


@njit(cache=True)
def overturns(a, dt, sides):
    """sides: 2 x (alpha, p, eta); theta > 0 turns about side 0."""
    n = len(a)
    h = dt / SUBSTEPS
    theta, v, resting = 0.0, 0.0, True
    limits = (np.tan(sides[0, 0]) * 9.81, np.tan(sides[1, 0]) * 9.81)
    for k in range(n - 1):
        slope = (a[k + 1] - a[k]) / dt
        # Positive ground acceleration turns it to negative theta.
        if resting and max(-a[k], -a[k + 1]) <= limits[0] and max(a[k], a[k + 1]) <= limits[1]:
            continue
        for s in range(SUBSTEPS):
            here = a[k] + slope * h * s
            if resting:
                if -here > limits[0]:
                    theta, v, resting, side = 1e-12, 0.0, False, 0
                elif here > limits[1]:
                    theta, v, resting, side = -1e-12, 0.0, False, 1
                else:
                    continue
            sign = 1.0 if theta > 0 else -1.0
            side = 0 if theta > 0 else 1
            alpha, p2 = sides[side, 0], sides[side, 1] ** 2
            r, w = sign * theta, sign * v
            middle, end = sign * (here + slope * h / 2) / 9.81, sign * (here + slope * h) / 9.81
            start = sign * here / 9.81
            k1 = -p2 * (np.sin(alpha - r) + start * np.cos(alpha - r))
            r2 = r + h / 2 * w
            k2 = -p2 * (np.sin(alpha - r2) + middle * np.cos(alpha - r2))
            r3 = r + h / 2 * (w + h / 2 * k1)
            k3 = -p2 * (np.sin(alpha - r3) + middle * np.cos(alpha - r3))
            r4 = r + h * (w + h / 2 * k2)
            k4 = -p2 * (np.sin(alpha - r4) + end * np.cos(alpha - r4))
            r_new = r + h * w + h * h / 6 * (k1 + k2 + k3)
            w_new = w + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            if r_new > np.pi / 2:
                return True
            if r_new < 0:
                share = r / (r - r_new)
                at = w + share * (w_new - w)
                other = 1 - side
                # The speed goes on in the same direction: to the other edge.
                w_after = -at * sides[other, 2]
                rest = (1 - share) * h
                if w_after < 1e-5:
                    theta, v, resting = 0.0, 0.0, True
                else:
                    theta, v = -sign * max(w_after * rest, 1e-15), -sign * w_after
            else:
                theta, v = sign * r_new, sign * w_new
    return False


def main():
    records = [(motions.rested(a, dt, TAIL_S), dt) for *_, a, dt in motions.components()]
    counts = np.zeros((len(SIZES), len(OFFSETS), len(SCALES), 2))
    for (i, size), (j, offset), (k, scale) in itertools.product(*map(enumerate, (SIZES, OFFSETS, SCALES))):
        two, one = np.array(body(*size, offset)), np.array(weaker(*size, offset))
        for a, dt in records:
            found = [overturns(sign * scale * a, dt, two) for sign in (1.0, -1.0)]
            counts[i, j, k] += sum(found), 2 * overturns(scale * a, dt, one)
    share = counts[..., 0] / (2 * len(records))
    for low, high in ((0.2, 0.95), (0.05, 0.2), (0.005, 0.05)):
        within = (share >= low) & (share < high)
        of_offset = [counts[:, j][within[:, j]].sum(axis=0) for j in range(len(OFFSETS))]
        two, one = sum(of_offset)
        print(f"P {low} to {high}: weaker side over body {one / two:.2f}; offsets",
              *(f"{offset}: {one / two:.2f}" for offset, (two, one) in zip(OFFSETS, of_offset)))


if __name__ == "__main__":
    main()
