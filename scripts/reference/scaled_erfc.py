"""The coefficients of src/normal/tail.rs: exp(y^2) erfc(y) (1 + y) as a polynomial in t = (y - 3) / (y + 3).

    python scaled_erfc.py

Interpolation at Chebyshev nodes with 40 digits, written in powers of t; then the largest relative error of the
polynomial in double precision over random y.
"""

import random

from mpmath import cos, erfc, exp, mp, mpf, pi, sqrt

DEGREE = 23
MIDDLE = mpf(3)


def scaled_erfc(y):
    if y < 30:
        return exp(y * y) * erfc(y)
    u = 1 / (2 * y * y)
    return (1 - u + 3 * u**2 - 15 * u**3 + 105 * u**4 - 945 * u**5) / (y * sqrt(pi))


def of_t(t):
    y = MIDDLE * (1 + t) / (1 - t)
    return scaled_erfc(y) * (1 + y)


def chebyshev_coefficients():
    n = DEGREE + 1
    angles = [pi * (k + mpf(1) / 2) / n for k in range(n)]
    values = [of_t(cos(angle)) for angle in angles]
    return [
        (2 if m else 1) * sum(v * cos(m * a) for v, a in zip(values, angles)) / n for m in range(n)
    ]


def in_powers(chebyshev):
    before, now = [mpf(1)], [mpf(0), mpf(1)]
    total = [chebyshev[0]] + [mpf(0)] * DEGREE
    for coefficient in chebyshev[1:]:
        for power, factor in enumerate(now):
            total[power] += coefficient * factor
        after = [mpf(0)] + [2 * factor for factor in now]
        for power, factor in enumerate(before):
            after[power] -= factor
        before, now = now, after
    return [float(coefficient) for coefficient in total]


def relative_error(coefficients, y):
    t = 1.0 - 6.0 / (y + 3.0)
    value = 0.0
    for coefficient in reversed(coefficients):
        value = value * t + coefficient
    return abs(float(mpf(value / (1.0 + y)) / scaled_erfc(mpf(y)) - 1))


if __name__ == "__main__":
    mp.dps = 40
    coefficients = in_powers(chebyshev_coefficients())
    for coefficient in coefficients:
        print(f"    {coefficient!r},")
    random.seed(1)
    places = [random.uniform(0, 6) for _ in range(3000)] + [10 ** random.uniform(-8, 8) for _ in range(2000)]
    print(f"largest relative error {max(relative_error(coefficients, y) for y in places):.2g}")
