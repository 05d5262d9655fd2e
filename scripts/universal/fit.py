"""Fits the universal surface and its replicates: python fit.py OUT.csv ANSWERS.csv MOTIONS.parquet RESPONSES.parquet..."""

import sys

import numpy as np

import cases as of
import surface

REPLICATES = 50
# Of the index, between structures at one magnitude and distance, and over all of them: with these the limits hold in judge.py, on
# structures and cells not seen.
SPREADS = ((0.75, 0.5), (0.9, 0.5))


def overturning(cases, knots, weights=None, start=None):
    curve = surface.Curve(surface.overturning_terms(), knots)
    design = curve.design(of.columns_of(cases))
    curve.coefficients = surface.fit(design, cases["overturned"], weights, start)
    return curve


def exceeding(cases, knots, weights=None, start=None):
    """Of safe rocking, at all limits at once: the limit is one of the coordinates."""
    curve = surface.Curve(surface.exceeding_terms(), knots)
    design = np.concatenate([curve.design(of.columns_of(cases, limit)) for limit in surface.LIMITS])
    happened = np.concatenate([cases["edp"] > limit for limit in surface.LIMITS])
    weights = None if weights is None else np.tile(weights, len(surface.LIMITS))
    curve.coefficients = surface.fit(design, happened, weights, start)
    return curve


def both(cases, knots, weights=None, starts=(None, None)):
    safe = ~cases["overturned"]
    first = overturning(cases, knots, weights, starts[0])
    safe_cases = of.some(cases, safe)
    return first, exceeding(safe_cases, knots, None if weights is None else weights[safe], starts[1])


def replicates(cases, knots, n, seed=7):
    """Structures and cells drawn anew, both at once; deviations from the fit to the same thinned cases."""
    rng = np.random.default_rng(seed)
    curves = both(cases, knots)
    safe = ~cases["overturned"]
    safe_cases = of.some(cases, safe)
    designs = [curves[0].design(of.columns_of(cases)),
               np.concatenate([curves[1].design(of.columns_of(safe_cases, c)) for c in surface.LIMITS])]  # fmt: skip
    happened = [cases["overturned"], np.concatenate([safe_cases["edp"] > c for c in surface.LIMITS])]
    penalties = [surface.RIDGE * d.var(axis=0) for d in designs]
    structures, cells = np.unique(cases["structure"]), np.unique(cases["cell"])
    at = np.searchsorted(structures, cases["structure"]), np.searchsorted(cells, cases["cell"])
    out = []
    for _ in range(n):
        drawn = [np.bincount(rng.integers(0, len(v), len(v)), minlength=len(v)) for v in (structures, cells)]
        weights = (drawn[0][at[0]] * drawn[1][at[1]]).astype(float)
        each = [weights, np.tile(weights[safe], len(surface.LIMITS))]
        pair = []
        for design, event, w, curve, penalty in zip(designs, happened, each, curves, penalties):
            used = w > 0
            b = surface.fit(design[used], event[used], w[used], curve.coefficients, steps=4, penalty=penalty)
            pair.append(b - curve.coefficients)
        out.append(pair)
    return out


if __name__ == "__main__":
    import write

    out, answers, motions, *files = sys.argv[1:]
    all_cases = of.read(files, motions, 0.25)
    knots = of.knots_of(all_cases)
    print(len(all_cases["im4"]), "cases; knots", knots, flush=True)
    rng = np.random.default_rng(1)
    thin = lambda share: of.some(all_cases, rng.random(len(all_cases["im4"])) < share)
    first = overturning(all_cases, knots)
    print("overturning", flush=True)
    some = thin(0.4)
    second = exceeding(of.some(some, ~some["overturned"]), knots)
    print("exceeding", flush=True)
    deviations = replicates(thin(0.1), knots, REPLICATES)
    write.surface_file(out, (first, second), deviations, all_cases, SPREADS)
    write.answers_file(answers, out)
