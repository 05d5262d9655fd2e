"""The two curves of the universal surface: what they are functions of, and how they are fitted.

Each is a logistic regression on products of restricted cubic splines (linear outside of their knots) of the coordinates.
"""

import itertools

import numpy as np

COORDINATES = ("im4", "im3", "eta", "alpha", "p", "limit", "pulse", "hfc")
LIMITS = np.array([0.02, 0.05, 0.1, 0.2, 0.3, 0.5])
RIDGE = 0.1


def coordinates(im4, im3, eta, alpha, p, limit=0.2, pulse=0.0, hfc=0.0):
    """The coordinates; src/fragility/universal.rs computes the same. `pulse` and `hfc` are 1 for motions of that kind, and both 0 for
    those that combine the two."""
    one = np.ones_like(im4)
    return [
        np.log(np.log(im4) + 0.05), np.log(im3), (eta - 0.85) / 0.1 * one, np.log(alpha / 0.15) * one,
        np.log(p / 2.0) * one, np.log(limit / 0.2) * one, pulse * one, hfc * one,
    ]  # fmt: skip


def spline(u, knots):
    """1, u, and for k knots k - 2 cubic functions that are linear outside of the knots."""
    out = [np.ones_like(u), u]
    if len(knots) > 2:
        last, before, width = knots[-1], knots[-2], (knots[-1] - knots[0]) ** 2
        cube = lambda knot: np.maximum(u - knot, 0.0) ** 3
        for knot in knots[:-2]:
            a, b = (last - knot) / (last - before), (before - knot) / (last - before)
            out.append((cube(knot) - a * cube(before) + b * cube(last)) / width)
    return out


def products(sizes, keep):
    return [term for term in itertools.product(*map(range, sizes)) if keep(*term)]


def overturning_terms():
    """A surface over both measures; eta and alpha bend it, p (the scale of the motions' frequencies) tilts it; so does the kind of
    motion, on which all of these depend."""

    def keep(x, r, e, a, p, c, pulse, hfc):
        structure, kind, low, tilt = e + a + p, pulse + hfc, x <= 2 and r <= 2, x <= 1 and r <= 1
        if kind == 0:
            return structure == 0 or (structure == 1 and (low if e + a else tilt)) or (x, r, e, a, p) == (0, 0, 1, 1, 0)
        return kind == 1 and ((structure == 0 and low) or (structure == 1 and x + r == 0))

    return products((5, 5, 2, 2, 2, 1, 2, 2), keep)


def exceeding_terms():
    """The same, and how the limit state moves it: by itself and with a spline, at each intensity, structure and kind of motion."""

    def keep(x, r, e, a, p, c, pulse, hfc):
        others, low, tilt = e + a + p + pulse + hfc, x <= 2 and r <= 2, x <= 1 and r <= 1
        return (c == 1 and (others == 0 or (others == 1 and tilt))) or (c == 2 and others == 0 and low)

    return overturning_terms() + products((5, 5, 2, 2, 2, 3, 2, 2), keep)


class Curve:
    def __init__(self, terms, knots, coefficients=None):
        self.terms, self.knots, self.coefficients = terms, knots, coefficients

    def design(self, columns):
        splines = [spline(u, knots) for u, knots in zip(columns, self.knots)]
        out = np.empty((len(columns[0]), len(self.terms)))
        for k, term in enumerate(self.terms):
            out[:, k] = splines[0][term[0]]
            for functions, i in zip(splines[1:], term[1:]):
                if i:
                    out[:, k] *= functions[i]
        return out

    def index(self, columns, step=200_000):
        parts = [[u[i : i + step] for u in columns] for i in range(0, len(columns[0]), step)]
        return np.concatenate([self.design(part) @ self.coefficients for part in parts])


def fit(design, happened, weights=None, start=None, steps=25, penalty=None):
    """Coefficients of a logistic regression with a ridge on standardized columns."""
    weights = np.ones(len(happened)) if weights is None else weights
    penalty = RIDGE * design.var(axis=0) if penalty is None else penalty
    b = np.zeros(design.shape[1]) if start is None else start.copy()
    for _ in range(steps):
        gradient, hessian = -penalty * b, np.diag(penalty + 1e-9)
        for i in range(0, len(design), 50_000):
            part, w = design[i : i + 50_000], weights[i : i + 50_000]
            p = 1.0 / (1.0 + np.exp(-np.clip(part @ b, -30, 30)))
            gradient += part.T @ (w * (happened[i : i + 50_000] - p))
            hessian += part.T @ (part * (w * (p * (1 - p) + 1e-7))[:, None])
        step = np.linalg.solve(hessian, gradient)
        largest = np.abs(design[::97] @ step).max()
        b = b + step * min(1.0, 6.0 / max(largest, 1e-12))
        if step @ gradient < 1e-2:
            break
    return b


def log_score(index, happened):
    return -np.logaddexp(0.0, np.where(happened, -index, index))
