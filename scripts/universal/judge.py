"""Tests fits like the surface on 60 structures and all cells that they have not seen, both at once:
python judge.py MOTIONS EQUIPMENT OUT.json RESPONSES..."""

import json
import sys

import numpy as np
from scipy.special import ndtr

import cases as of
import fit
import surface

FOLDS = 5
FIRST_TEST = 260
EVENTS = [None, 0.1, 0.3, 0.5]
NAMES = {None: "overturning", 0.1: "exceeding 0.1", 0.3: "exceeding 0.3", 0.5: "exceeding 0.5"}


def quadratic(cases):
    x, y = np.log(cases["im4"]), np.log(cases["im4"] / cases["im3"])
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)


def event(cases, limit):
    return cases["overturned"] if limit is None else cases["edp"] > limit


def own_scores(cases, happened, by_suite):
    """Log scores of each structure's own share, and of its own bent curve, both from the other cells."""
    share, own = np.full(len(happened), np.nan), np.full(len(happened), np.nan)
    q = quadratic(cases)
    groups = cases["structure"] * 10 + (cases["suite"] if by_suite else 0)
    for group in np.unique(groups):
        for fold in range(FOLDS):
            here = groups == group
            test, train = here & (cases["cell"] % FOLDS == fold), here & (cases["cell"] % FOLDS != fold)
            if not test.any() or not train.any():
                continue
            b = surface.fit(q[train], happened[train], penalty=np.full(6, 0.1))
            own[test] = surface.log_score(q[test] @ b, happened[test])
            p = np.clip(happened[train].mean(), 1e-4, 1 - 1e-4)
            share[test] = np.where(happened[test], np.log(p), np.log1p(-p))
    return share, own


def shares(scores, share, own, structures):
    known = np.isfinite(scores) & np.isfinite(own)
    unique = np.unique(structures[known])
    add = lambda v: np.array([v[known & (structures == s)].sum() for s in unique])
    n = add(np.ones_like(scores))
    a, b, c = add(scores), add(share), add(own)
    told = (c - b) / n > 0.01
    each = ((a - b) / (c - b))[told]
    return {
        "structures": int(told.sum()), "median": float(np.median(each)), "worst_tenth": float(np.quantile(each, 0.1)),
        "worst": float(each.min()), "all": float((a - b).sum() / (c - b).sum()),
        "log_score": float(a.sum() / n.sum()), "own": float(c.sum() / n.sum()), "share": float(b.sum() / n.sum()),
    }  # fmt: skip


def reliability(p, happened):
    rows = []
    for k in range(10):
        here = (p >= k / 10) & (p < (k + 1) / 10 + (k == 9))
        if here.sum() > 200:
            rows.append([k / 10, int(here.sum()), float(p[here].mean()), float(happened[here].mean())])
    return rows, max(abs(row[2] - row[3]) for row in rows)


BANDS = [0.0, 0.02, 0.1, 0.3, 0.7, 0.9, 0.98, 1.0]


def coverage(index, happened, unit, spread):
    """By band of probability, the share of the counts of units that lie where 95 % should, if the index of each unit is off by a
    normal number of this standard deviation. Counts that are tied with the end of the range lie in it by chance, so that the share is
    0.95 where all is right."""
    rng = np.random.default_rng(3)
    band = np.digitize(1 / (1 + np.exp(-index)), BANDS[1:-1])
    out = []
    for k in range(len(BANDS) - 1):
        here = band == k
        _, at = np.unique(unit[here], return_inverse=True)
        big = np.bincount(at) >= 5
        if big.sum() < 20:
            continue
        below, tied = np.zeros(len(big)), np.zeros(len(big))
        seen = np.bincount(at, happened[here])
        for _ in range(400):
            shifted = 1 / (1 + np.exp(-(index[here] + spread * rng.standard_normal(len(big))[at])))
            count = np.bincount(at, rng.random(len(at)) < shifted)
            below += count < seen
            tied += count == seen
        rank = (below + rng.random(len(big)) * tied) / 400
        out.append([BANDS[k], BANDS[k + 1], int(big.sum()), float(((rank > 0.025) & (rank < 0.975))[big].mean())])
    return out


def equipment_curves(equipment, motions):
    """The forms of the paper, fitted to its equipment: hybrid probit of overturning, planes of the demand."""
    from scipy.optimize import minimize
    from scipy.special import log_ndtr

    cases = of.read([equipment], motions)
    cases = of.some(cases, (cases["suite"] == 1) & (cases["motion_id"] < 4200))
    lines = lambda c: np.stack([np.ones_like(c["im4"]), np.log(c["im4"]), np.log(c["im3"])], axis=1)
    d, y = lines(cases), cases["overturned"]
    pro = minimize(lambda b: -log_ndtr(np.where(y, 1, -1) * (d @ b)).sum(), np.array([0.0, 1.0, -1.0]), method="BFGS").x
    safe = ~y
    planes = []
    for side in (cases["im4"] < 1.3, cases["im4"] >= 1.3):
        x, z = d[safe & side], np.log(cases["edp"][safe & side])
        b, *_ = np.linalg.lstsq(x, z, rcond=None)
        planes.append((b, np.std(z - x @ b, ddof=3)))

    def probability(c, limit):
        if limit is None:
            return ndtr(lines(c) @ pro)
        (low, s_low), (high, s_high) = planes
        at = lambda b, s: ndtr((lines(c) @ b - np.log(limit)) / s)
        return np.where(c["im4"] < 1.3, at(low, s_low), at(high, s_high))

    return probability


def main():
    motions, equipment, out, *files = sys.argv[1:]
    train = of.read(files, motions, 0.08)
    train = of.some(train, train["structure"] < FIRST_TEST)
    test = of.read(files[-1:], motions)
    test = of.some(test, test["structure"] >= FIRST_TEST)
    knots = of.knots_of(train)
    paper_probability = equipment_curves(equipment, motions)
    index = {limit: np.full(len(test["im4"]), np.nan) for limit in EVENTS}
    starts = (None, None)
    for fold in range(FOLDS):
        curves = fit.both(of.some(train, train["cell"] % FOLDS != fold), knots, None, starts)
        starts = tuple(curve.coefficients for curve in curves)
        here = test["cell"] % FOLDS == fold
        for limit in EVENTS:
            curve = curves[0] if limit is None else curves[1]
            index[limit][here] = curve.index(of.columns_of(of.some(test, here), limit or 0.2))
        print("fold", fold, flush=True)
    result = {}
    for limit in EVENTS:
        which = np.ones(len(test["im4"]), bool) if limit is None else ~test["overturned"]
        cases, eta = of.some(test, which), index[limit][which]
        happened = event(cases, limit)
        scores = surface.log_score(eta, happened)
        said = {}
        for by_suite in (False, True):
            share, own = own_scores(cases, happened, by_suite)
            key = "own curve of each suite" if by_suite else "own curve"
            said[key] = shares(scores, share, own, cases["structure"])
            p = np.clip(paper_probability(cases, limit), 1e-6, 1 - 1e-6)
            paper_scores = np.where(happened, np.log(p), np.log1p(-p))
            if by_suite:
                for name, code in of.SUITES.items():
                    of_suite = cases["suite"] == code
                    masked = np.where(of_suite, scores, np.nan)
                    said[f"{key}: {name}"] = shares(masked, share, own, cases["structure"])
                masked = np.where(cases["suite"] == of.SUITES["csgm"], paper_scores, np.nan)
                said["equipment: csgm"] = shares(masked, share, own, cases["structure"])
            else:
                said["equipment"] = shares(paper_scores, share, own, cases["structure"])
        said["reliability"], said["largest gap"] = reliability(1 / (1 + np.exp(-eta)), happened)
        for name, code in of.SUITES.items():
            here = cases["suite"] == code
            said[f"reliability: {name}"], said[f"largest gap: {name}"] = reliability(1 / (1 + np.exp(-eta[here])), happened[here])
        said["equipment gap"] = reliability(p, happened)[1]
        alone = cases["motion_id"] < 4200
        independent, eta, happened = of.some(cases, alone), eta[alone], happened[alone]
        s, c, u = (independent[k].astype(np.int64) for k in ("structure", "cell", "suite"))
        units = {"structure, suite": 10 * s + u, "cell, suite": 10 * c + u, "structure, cell, suite": 1000 * s + 10 * c + u}
        for name, unit in units.items():
            for spread in (0.0, *fit.SPREADS[limit is not None]):
                said[f"coverage {name}, spread {spread}"] = coverage(eta, happened, unit, spread)
        result[NAMES[limit]] = said
        print(NAMES[limit], json.dumps(said, indent=1), flush=True)
    json.dump(result, open(out, "w"), indent=1)


if __name__ == "__main__":
    main()
