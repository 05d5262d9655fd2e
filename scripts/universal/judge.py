"""Prints how well the surface does, as tables in Markdown: python judge.py SURFACE.csv FOLDER"""

import sys

import numpy as np
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

import cases as of
from calibration import NODES, WEIGHTS, apply, calibrate, logistic
from fit import monotone_logistic
from make import LIMIT, chosen
from surface import KINDS, LIMITS, Surface, magnitude, some

_, path, FOLDER = sys.argv
surface = Surface(path)
rng = np.random.default_rng(1)
CLASSES = {"all": (0, 9), "below 5.5": (0, 5.5), "5.5 to 6.4": (5.5, 6.4), "6.4 and more": (6.4, 9)}
WIDE = (0.0, 0.0, 0.0, 5.0, 5.0, 5.0)
CUTS = np.array([0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95])


def table(title, head, rows):
    cell = lambda v: str(v) if isinstance(v, (str, int)) else f"{v:.4f}"
    print(f"\n{title}\n\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    print("\n".join("| " + " | ".join(map(cell, row)) + " |" for row in rows), flush=True)


def log_scores(p, happened):
    p = np.clip(p, 1e-6, 1 - 1e-6)
    return np.where(happened, np.log(p), np.log1p(-p))


def at(parts, which):
    return tuple(part[which] for part in parts)


def counts(happened, expected):
    return f"{happened.sum():.0f}/{expected.sum():.0f}" + (
        f" = {happened.sum() / expected.sum():.2f}" if expected.sum() >= 20 else ""
    )


def lines(cases):
    return np.stack([np.ones_like(cases["im4"]), np.log(cases["im4"]), np.log(cases["im3"])], axis=1)


def own(event, kind, cases, few):
    """What is fitted to one's own cases, as functions of cases; `few` are the motions of the last one."""
    cases, happened = chosen(event, cases)
    parts = lambda c: surface.parts(event, kind, c, LIMIT)
    prior, few = surface.prior(event, kind, LIMIT), np.isin(cases["motion_id"], few)
    bent = lambda c: np.stack([*lines(c).T, *(lines(c)[:, [1, 1, 2]] * lines(c)[:, [1, 2, 2]]).T], axis=1)
    quadratic = monotone_logistic(bent(cases), happened.astype(float), np.zeros((0, 6)), 0.01)
    probit = lambda b: -log_ndtr(np.where(happened, 1, -1) * (lines(cases) @ b)).sum()
    straight = minimize(probit, [0.0, 1.0, -1.0], method="BFGS").x
    calibrated = lambda b: lambda c: logistic(apply(b, parts(c)))
    return {
        "share": lambda c: np.full(len(c["im4"]), (happened.sum() + 0.5) / (len(happened) + 1)),
        "probit of IM4, IM3": lambda c: ndtr(lines(c) @ straight),
        "quadratic": lambda c: logistic(bent(c) @ quadratic),
        "surface": calibrated(prior[:3]),
        "calibrated": calibrated(calibrate(parts(cases), happened, prior)[0]),
        "of few": calibrated(calibrate(at(parts(cases), few), happened[few], prior)[0]),
    }


def held_out(event):
    cases, _ = chosen(event, of.read([f"{FOLDER}/test.parquet"]))
    rows = {"M known": [], "M unknown": []}
    for kind in KINDS[1:]:
        c, limits = some(cases, cases["kind"] == kind), LIMITS if event == "pex" else LIMITS[:1]
        happened = [c["edp"] > limit if event == "pex" else c["overturned"] for limit in limits]
        for name, mw in (("M known", c["mw"]), ("M unknown", np.full(len(c["mw"]), np.nan))):
            z = [surface.z(event, kind, c | {"mw": mw}, limit) for limit in limits]
            rows[name].append(log_scores(logistic(np.concatenate(z)), np.concatenate(happened)).mean())
    title = f"{event}: 64 structures and a seed held out, mean log score"
    table(title, ["", *KINDS[1:]], [(name, *row) for name, row in rows.items()])


def own_responses(event):
    rows = {}
    for kind in KINDS[1:]:
        study = [of.read([f"{FOLDER}/study_{seed}.parquet"], 1.0, kind) for seed in (101, 102, 103)]
        for number in range(22):
            fitted, *judged = [some(cases, cases["structure"] == number) for cases in study]
            _, happened = chosen(event, fitted)
            few = rng.permutation(np.unique(study[0]["motion_id"]))[:350]
            models = own(event, kind, fitted, few)
            band = np.array(["< 5 %", "5-20 %", "> 20 %"])[np.searchsorted([0.05, 0.2], happened.mean())]
            judged = [chosen(event, cases) for cases in judged]
            each = [np.mean([log_scores(model(c), y).mean() for c, y in judged]) for model in models.values()]
            rows.setdefault((kind, str(band)), []).append(each)
    body = [(*key, len(v), *np.mean(v, axis=0)) for key, v in sorted(rows.items())]
    title = f"Own responses, {event}: fitted to 3500 motions (few: 350), mean log score on two other seeds"
    table(title, ["kind", "share", "structures", *models], body)


def left_out(event):
    """Each earthquake of the table predicted by c, ln s and m of the others, of both sources: with magnitude,
    and without."""
    cases, happened = chosen(event, of.read([f"{FOLDER}/records.parquet"]))
    parts = surface.parts(event, "recorded", cases, LIMIT)
    unknown = cases | {"mw": np.full(len(happened), np.nan)}
    expected = magnitude(unknown, surface.magnitude["recorded"])
    ours = np.char.find(cases["motion_id"].astype(str), "field") < 0
    models = {"with M": np.full(len(happened), np.nan), "M unknown": np.full(len(happened), np.nan)}
    for earthquake in np.unique(cases["cluster"][ours]):
        test = cases["cluster"] == earthquake
        b, _ = calibrate(at(parts, ~test), happened[~test], WIDE)
        models["with M"][test] = apply(b, at(parts, test))
        models["M unknown"][test] = apply(b, at((parts[0], expected, parts[2]), test))
    rows = []
    for name, (low, high) in CLASSES.items():
        k = ours & (cases["mw"] >= low) & (cases["mw"] < high)
        y = happened[k]
        each = [(log_scores(logistic(z[k]), y).mean(), y.sum() / logistic(z[k]).sum()) for z in models.values()]
        rows.append((name, int(k.sum()), *(number for pair in each for number in pair)))
    head = [f"{name}: {what}" for name in models for what in ("score", "observed/expected")]
    table(f"Records, {event}: earthquakes left out", ["M", "cases", *head], rows)
    for name, z in models.items():
        p, y = logistic(z[ours]), happened[ours]
        bins = [np.digitize(p, CUTS) == k for k in range(9)]
        rows = [("predicted", *(p[k].mean() for k in bins)), ("observed", *(y[k].mean() for k in bins))]
        table(f"Records, {event}, {name}: nine bins", ["", *map(str, CUTS), "1"], rows)
    coverage(event, "recorded", models["with M"][ours], happened[ours], some(cases, ours))


def coverage(event, kind, z, happened, cases):
    """How often the count in a structure and cluster is one that limits of 95 % allow, with tau and without:
    a count allows for chance, so that it lies between the 2.5 and 97.5 % quantiles of its distribution."""
    tau = surface.calibration[kind, event][6]
    groups = np.char.add(cases["structure"].astype(str), np.char.add(" ", cases["cluster"].astype(str)))
    names, which = np.unique(groups, return_inverse=True)
    order = np.argsort(which, kind="stable")
    rows = {}
    for group in np.split(order, np.cumsum(np.bincount(which))[:-1]):
        p = logistic(z[group]).mean()
        if len(group) < 5 or not 0.01 < p < 0.99:
            continue
        held = []
        for sd in (tau, 0.0):
            tails = [poisson_binomial(logistic(z[group] + sd * node)) for node in NODES]
            share = np.average(tails, axis=0, weights=WEIGHTS)
            below = share[: happened[group].sum()].sum()
            held.append(below < 0.975 and below + share[happened[group].sum()] > 0.025)
        rows.setdefault(int(np.digitize(p, [0.1, 0.3, 0.7, 0.9])), []).append(held)
    bands = [".01-.1", ".1-.3", ".3-.7", ".7-.9", ".9-.99"]
    rows = [(bands[k], len(held), *np.mean(held, axis=0)) for k, held in sorted(rows.items())]
    title = f"Coverage at one motion, {event}, {kind}: structure and cluster"
    table(title, ["P", "groups", "with tau", "without"], rows)


def poisson_binomial(p):
    """Probabilities of 0 to n events of n with these probabilities."""
    share = np.ones(1)
    for one in p:
        share = np.append(share, 0.0) * (1 - one) + np.append(0.0, share) * one
    return share


def cells_left_out(event):
    """Coverage of synthetic motions: each structure calibrated on half of its clusters, judged on the others."""
    for kind in KINDS[1:]:
        cases, happened = chosen(event, of.read([f"{FOLDER}/study_101.parquet"], 1.0, kind))
        z, parts = np.full(len(happened), np.nan), surface.parts(event, kind, cases, LIMIT)
        for number in np.unique(cases["structure"]):
            mine = cases["structure"] == number
            half = rng.permutation(np.unique(cases["cluster"][mine]))[::2]
            for side in (True, False):
                fitted = mine & (np.isin(cases["cluster"], half) == side)
                b, _ = calibrate(at(parts, fitted), happened[fitted], surface.prior(event, kind, LIMIT))
                other = mine & (np.isin(cases["cluster"], half) != side)
                z[other] = apply(b, at(parts, other))
        coverage(event, kind, z, happened, cases)


def few_records(event):
    """Own records of 60 blocks, by magnitude: coverage of the truth (all components of the class), without
    tau; mean width of limits; score on the other components."""
    cases = of.read([f"{FOLDER}/blocks.parquet"])
    cases, happened = chosen(event, some(cases, np.char.endswith(cases["motion_id"].astype(str), "x1")))
    parts, prior = surface.parts(event, "recorded", cases, LIMIT), surface.prior(event, "recorded", LIMIT)
    rows = []
    for name, (low, high) in list(CLASSES.items())[2:]:
        for n in (8, 15, 40):
            seen = {"all": [], "no event": [], "all events": []}
            scores = []
            for block in range(60):
                mine = (cases["structure"] == block) & (cases["mw"] >= low) & (cases["mw"] < high)
                mine = np.flatnonzero(mine)
                if min(happened[mine].sum(), (~happened[mine]).sum()) < 5 or len(mine) < 2 * n:
                    continue
                truth, _ = calibrate(at(parts, mine), happened[mine], (*prior[:3], 2.0, 1.0, 0.5))
                pool = mine[np.abs(apply(truth, at(parts, mine))) < 3.9]
                for _ in range(4):
                    drawn = rng.choice(mine, n, replace=False)
                    b, v = calibrate(at(parts, drawn), happened[drawn], prior, cases["cluster"][drawn])
                    points = at(parts, rng.choice(pool, 8))
                    tangent = np.stack([np.ones(8), np.exp(b[1]) * points[0], points[1]], axis=1)
                    half = 1.96 * np.sqrt(np.einsum("ij,jk,ik->i", tangent, v, tangent))
                    z = apply(b, points)
                    holds = np.abs(z - apply(truth, points)) < half
                    width = logistic(z + half) - logistic(z - half)
                    events = happened[drawn].sum()
                    seen["all"].append((holds.mean(), width.mean()))
                    if events in (0, n):
                        seen["all events" if events else "no event"].append((holds.mean(), width.mean()))
                    others = np.setdiff1d(mine, drawn)
                    each = [log_scores(logistic(apply(c, at(parts, others))), happened[others]) for c in (prior, b)]
                    scores.append([score.mean() for score in each])
            of_all = [np.mean(seen[which], axis=0) if seen[which] else (np.nan, np.nan) for which in seen]
            rows.append((name, n, *np.concatenate(of_all), *np.mean(scores, axis=0)))
    head = ["M", "records", "holds", "width", "no event: holds", "width", "all events: holds", "width"]
    table(f"Few records of one's own, {event}", [*head, "score as shipped", "calibrated"], rows)


def by_limit():
    cases = of.read([f"{FOLDER}/records.parquet"])
    safe = some(cases, ~cases["overturned"])
    row = lambda limit: (safe["edp"] > limit, logistic(surface.z("pex", "recorded", safe, limit)))
    limits = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9)
    table("Records, observed/expected by limit state", [*map(str, limits)], [[counts(*row(k)) for k in limits]])


def near_uplift(event):
    rows = []
    for kind in KINDS:
        files = ["records.parquet"] if kind == "recorded" else [f"training_{part}.parquet" for part in range(5)]
        cases = [of.read([f"{FOLDER}/{file}"], 1.0, None if kind == "recorded" else kind) for file in files]
        cases = {name: np.concatenate([each[name][each["im4"] < 1.25] for each in cases]) for name in cases[0]}
        counted, happened = chosen(event, cases)
        p = logistic(surface.z(event, kind, counted, LIMIT))
        for low, high in ((0, 1.5), (1.5, 3), (3, 99)) if kind in ("pulse", "csgm") else ((0, 99),):
            of_im5 = (counted["im5"] >= low) & (counted["im5"] < high)
            within = [of_im5 & (counted["im4"] >= 1 + k / 20) & (counted["im4"] < 1.05 + k / 20) for k in range(4)]
            rows.append((kind, f"{low} to {high}", *(counts(happened[k], p[k]) for k in within)))
    head = ["kind", "IM5", "IM4 1 to 1.05", "to 1.1", "to 1.15", "to 1.2"]
    table(f"Near uplift, {event}: observed/expected", head, rows)


by_limit()
for event in ("pro", "pex"):
    left_out(event)
    near_uplift(event)
    few_records(event)
    held_out(event)
    cells_left_out(event)
    own_responses(event)
