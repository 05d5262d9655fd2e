"""Rocking about two edges in turn, by Taylor series in small steps (theta'' = -p_i^2 (sin(alpha_i - |theta|) + ...),
impacts by conservation of angular momentum about the new edge), in machine code of numba."""

import numpy as np
from numba import njit

FREE, LONGEST_S, REST, TAIL_S = -1.0, 0.005, 1e-5, 8.0


def body(width, height, offset):
    """(alpha, p, eta of the impact onto it) of the edge that the centre of mass is nearer to, and the other."""
    h, inertia = height / 2, (width**2 + height**2) / 12
    here = width / 2 * np.array([1 - offset, 1 + offset])
    eta = (inertia + h * h - here * here[::-1]) / (inertia + here * here + h * h)
    radius = np.hypot(here, h)
    return np.stack([np.arctan(here / h), np.sqrt(9.81 * radius / (inertia + radius**2)), eta], axis=1)


@njit(cache=True)
def after(r, w, g, dg, ddg, x):
    turned = r + x * (w - x * (g / 2.0 + x * (dg / 6.0 + x * ddg / 24.0)))
    return turned, w - x * (g + x * (dg / 2.0 + x * ddg / 6.0))


@njit(cache=True)
def impact(r, w, g, dg, ddg, h):
    """The time at which the base is struck; h where it is not."""
    if after(r, w, g, dg, ddg, h)[0] > 0.0:
        return h
    low, high = 0.0, h
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if after(r, w, g, dg, ddg, middle)[0] > 0.0 else (low, middle)
    return low


@njit(cache=True)
def demand(a, dt, sides, rebound):
    """|theta|max / alpha, infinite where it overturns. a: acceleration over g; sides: 2 x (alpha, p, eta), theta > 0
    turns about side 0. With a wall, an impact turns the velocity w of side 0 into -rebound w."""
    low, high, peak, side, r, w = -np.tan(sides[0, 0]), np.tan(sides[1, 0]), 0.0, -1, 0.0, 0.0
    for k in range(len(a) - 1):
        t, slope = 0.0, (a[k + 1] - a[k]) / dt
        while t < dt:
            if side < 0:
                # From rest, at the root of the threshold.
                first, last = a[k] + slope * t, a[k + 1]
                start = min(max(last, low), high) if low <= first <= high else first
                if start == last or (rebound != FREE and start > 0.0):
                    break
                side, t = 0 if start < 0.0 else 1, t if start == first else t + (start - first) / slope
            alpha, p2, sign = sides[side, 0], sides[side, 1] ** 2, 1.0 - 2.0 * side
            h = min(dt - t, LONGEST_S)
            u, du = sign * (a[k] + slope * t), sign * slope
            # g = sin(alpha - r) + u cos(alpha - r) with its derivatives by time: r and w by Taylor series.
            s, c = np.sin(alpha - r), np.cos(alpha - r)
            g, dg = s + u * c, c * (du - w) + u * s * w
            ddg = p2 * g * (c - u * s) + 2.0 * du * s * w - (s + u * c) * w * w
            x = impact(r, w, p2 * g, p2 * dg, p2 * ddg, h)
            r, w = after(r, w, p2 * g, p2 * dg, p2 * ddg, x)
            t = dt if x == dt - t else t + x
            peak = max(peak, r / alpha)
            if r > np.pi / 2:
                return np.inf
            if x < h:
                side = 1 - side if rebound == FREE else side
                r, w = 0.0, -w * (sides[side, 2] if rebound == FREE else rebound)
                if w < REST:
                    side, w, t = -1, 0.0, t + REST
    return peak


def rested(acceleration, dt, seconds=TAIL_S):
    """With rest behind it."""
    return np.append(acceleration, np.zeros(int(seconds / dt)))
