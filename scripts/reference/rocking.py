"""Answers for a motions file in quadruple precision: python rocking.py MOTIONS.parquet ANSWERS.csv
P:ALPHA:ETA ...

core/tests/reference/rocking/motions.parquet has sixty: velocity pulses, pulses under decaying noise,
half-sine and rectangular pulses, and records that touch the uplift threshold of alpha = 0.15 exactly. Taylor
series of phi = alpha - |theta| of order 20 in steps between samples, events by scanning and bisection, in
numbers of 113 bits. The condition is the relative change of the demand under motions stronger by 1e-15. Needs
gmpy2, numpy and pyarrow; 60 motions and two structures take some minutes.
"""

import sys
from itertools import pairwise

import gmpy2
import pyarrow.parquet as pq
from gmpy2 import acos, cos, mpfr, sin, sqrt, tan
from numpy.polynomial.polynomial import polyder, polyval

gmpy2.get_context().precision = 113
ORDER, PIECES, LONGEST = 20, 16, mpfr(2) / 100
G, HALF_PI, REST_VELOCITY = mpfr(981) / 100, gmpy2.const_pi() / 2, mpfr(1) / 1000000
SHIFT = mpfr(1) / 10**15


def taylor(alpha, r, v, w0, w1):
    """The series of r = |theta| over a step, from phi'' = sin phi + (w0 + w1 x) cos phi in x = p t."""
    f, s, c = [alpha - r, -v], [sin(alpha - r)], [cos(alpha - r)]
    for k in range(ORDER - 1):
        if k > 0:
            s_k = sum(j * f[j] * c[k - j] for j in range(1, k + 1)) / k
            c.append(-sum(j * f[j] * s[k - j] for j in range(1, k + 1)) / k)
            s.append(s_k)
        f.append((s[k] + w0 * c[k] + (w1 * c[k - 1] if k else 0)) / ((k + 1) * (k + 2)))
    return [r, v, *(-a for a in f[2:])]


def bisect(series, low, high):
    positive = polyval(low, series) > 0
    for _ in range(130):
        middle = (low + high) / 2
        low, high = (middle, high) if (polyval(middle, series) > 0) == positive else (low, middle)
    return (low + high) / 2


def first_root(series, h):
    """The first x in (0, h] at which a series, positive after 0, is no longer so; None where it stays so."""
    slope = polyder(series)
    for low, high in pairwise(h * k / PIECES for k in range(PIECES + 1)):
        if polyval(high, series) <= 0:
            return bisect(series, low, high)
        if polyval(low, slope) < 0 < polyval(high, slope):
            least = bisect(slope, low, high)
            if polyval(least, series) <= 0:
                return bisect(series, low, least)
    return None


def largest(series, h):
    """At the ends of the pieces and at the maxima within them."""
    slope = polyder(series)
    for low, high in pairwise(h * k / PIECES for k in range(PIECES + 1)):
        yield polyval(high, series)
        if polyval(low, slope) > 0 >= polyval(high, slope):
            yield polyval(bisect(slope, low, high), series)


def simulate(p, alpha, eta, dt, u):
    """Outcome, |theta|max / alpha and the number of impacts; u: ground acceleration over g."""
    overturned = "overturning", HALF_PI / alpha
    tangent, end = tan(alpha), p * dt
    side, r, v, peak, rocked, impacts = 0, mpfr(0), mpfr(0), mpfr(0), False, 0
    for here, there in zip(u, u[1:]):
        slope, x = (there - here) / end, mpfr(0)
        while x < end:
            now, at_threshold = here + slope * x, False
            if side == 0:
                if abs(now) <= tangent and abs(there) <= tangent:
                    break
                if abs(now) < tangent:
                    now, at_threshold = tangent if there > 0 else -tangent, True
                    x = (now - here) / slope
                side, r, v, rocked = -1 if now > 0 else 1, mpfr(0), mpfr(0), True
            h = min(end - x, LONGEST / sqrt(1 + max(abs(here), abs(there))))
            series = taylor(alpha, r, v, side * (here + slope * x), side * slope)
            if at_threshold:
                # Where uplift begins at its threshold nothing but rounding accelerates the structure yet.
                series[2] = mpfr(0)
            # No rotation within h differs by more from that at the start.
            reach = h * polyval(h, [abs(a) for a in series[1:]])
            # From the base, the roots at the start do not count.
            start = next(k for k, a in enumerate(series) if a != 0)
            impact = first_root(series[start:], h) if r <= reach else None
            until = impact or h
            margin = [HALF_PI - r, *(-a for a in series[1:])]
            if r + reach >= HALF_PI and first_root(margin, until):
                return *overturned, impacts
            if r + reach > peak:
                peak = max(peak, *largest(series, until))
            r, v = polyval(until, series), polyval(until, polyder(series))
            x = end if until == end - x else x + until
            if impact:
                r, v, side, impacts = mpfr(0), -eta * v, -side, impacts + 1
                if v < REST_VELOCITY:
                    side = 0
    if side != 0:
        # After the record v^2/2 + cos(alpha - r) is constant between impacts.
        energy = v * v / 2 + cos(alpha - r)
        if r > alpha and (v >= 0 or energy <= 1):
            return *overturned, impacts
        if v < 0:
            energy = cos(alpha) + eta * eta * (energy - cos(alpha))
        if energy > 1:
            return *overturned, impacts
        peak = max(peak, alpha - acos(energy))
    return "safe_rocking" if rocked else "no_rocking", peak / alpha, impacts


motions, answers, *structures = sys.argv[1:]
with open(answers, "w") as file:
    print("motion_id,p_rad_s,alpha_rad,eta,outcome,edp,impacts,condition", file=file)
    for motion in pq.read_table(motions, columns=["motion_id", "dt_s", "acceleration_m_s2"]).to_pylist():
        u, dt = [mpfr(sample) / G for sample in motion["acceleration_m_s2"]], mpfr(motion["dt_s"])
        for structure in structures:
            numbers = [float(part) for part in structure.split(":")]
            outcome, edp, impacts = simulate(*map(mpfr, numbers), dt, u)
            nearby = simulate(*map(mpfr, numbers), dt, [w * (1 + SHIFT) for w in u])[1]
            condition = abs(nearby / edp - 1) / SHIFT if edp > 0 else mpfr(0)
            of_structure = (f"{number:.17g}" for number in numbers)
            cells = outcome, f"{edp:.20e}", impacts, f"{condition:.3e}"
            print(motion["motion_id"], *of_structure, *cells, sep=",", file=file)
