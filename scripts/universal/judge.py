"""Prints how well the surface does, as tables in Markdown: python judge.py SURFACE.csv FOLDER"""

import sys

import numpy as np
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

import cases as of
from calibration import apply, calibrate, logistic
from fit import monotone_logistic
from make import LIMIT, WIDE, chosen
from surface import KINDS, LIMITS, Surface, some

_, path, FOLDER = sys.argv
surface = Surface(path)
rng = np.random.default_rng(1)


def table(title, head, rows):
    cell = lambda v: str(v) if isinstance(v, (str, int)) else f"{v:.4f}"
    print(f"\n{title}\n\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    print("\n".join("| " + " | ".join(map(cell, row)) + " |" for row in rows), flush=True)


def log_scores(p, happened):
    p = np.clip(p, 1e-6, 1 - 1e-6)
    return np.where(happened, np.log(p), np.log1p(-p))


def lines(cases):
    return np.stack([np.ones_like(cases["im4"]), np.log(cases["im4"]), np.log(cases["im3"])], axis=1)


def own(event, kind, cases, few):
    """What is fitted to one's own cases, as functions of cases; `few` are the motions of the last one."""
    cases, happened = chosen(event, cases)
    logit = lambda c: surface.logit(event, kind, c, LIMIT)
    prior, few = surface.calibration[kind, event][:4], np.isin(cases["motion_id"], few)
    bent = lambda c: np.stack([*lines(c).T, *(lines(c)[:, [1, 1, 2]] * lines(c)[:, [1, 2, 2]]).T], axis=1)
    quadratic = monotone_logistic(bent(cases), happened.astype(float), np.zeros((0, 6)), 0.01)
    probit = lambda b: -log_ndtr(np.where(happened, 1, -1) * (lines(cases) @ b)).sum()
    straight = minimize(probit, [0.0, 1.0, -1.0], method="BFGS").x
    calibrated = lambda b: lambda c: logistic(apply(b, logit(c)))
    return {
        "share": lambda c: np.full(len(c["im4"]), (happened.sum() + 0.5) / (len(happened) + 1)),
        "probit of IM4, IM3": lambda c: ndtr(lines(c) @ straight),
        "quadratic": lambda c: logistic(bent(c) @ quadratic),
        "surface": calibrated(prior[:2]),
        "calibrated": calibrated(calibrate(logit(cases), happened, prior)[0]),
        "of few": calibrated(calibrate(logit(cases)[few], happened[few], prior)[0]),
    }


def held_out(event):
    cases, _ = chosen(event, of.read([f"{FOLDER}/test.parquet"]))
    each = []
    for kind in KINDS:
        c, limits = some(cases, cases["kind"] == kind), LIMITS if event == "pex" else LIMITS[:1]
        happened = [c["edp"] > limit if event == "pex" else c["overturned"] for limit in limits]
        p = [logistic(surface.logit(event, kind, c, limit)) for limit in limits]
        each.append(log_scores(np.concatenate(p), np.concatenate(happened)))
    rows = [("log score", *(v.mean() for v in each), np.concatenate(each).mean())]
    table(f"{event}: 64 structures and a seed held out, mean log score", ["", *KINDS, "all"], rows)


def own_responses(event):
    rows = {}
    for kind in KINDS:
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


def recorded(event):
    """Half of the earthquakes and half of the blocks left out together, 40 times."""
    cases, happened = chosen(event, of.read([f"{FOLDER}/blocks.parquet"]))
    logit = surface.logit(event, "recorded", cases, LIMIT)
    sets, parts = np.array([name.split()[0] for name in cases["motion_id"]]), []
    for _ in range(40):
        half = lambda name: np.isin(cases[name], rng.permutation(np.unique(cases[name]))[::2])
        quakes, blocks = half("cluster"), half("structure")
        train, test = np.flatnonzero(quakes & blocks), np.flatnonzero(~quakes & ~blocks)
        b, _ = calibrate(logit[train], happened[train], WIDE)
        parts.append((test, apply(b, logit[test])))
    at, z = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    p, y, before = logistic(z), happened[at], logistic(logit[at])
    cuts = np.array([0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95])
    bins = [np.digitize(p, cuts) == k for k in range(9)]
    rows = [("predicted", *(p[k].mean() for k in bins)), ("observed", *(y[k].mean() for k in bins))]
    table(f"Records, {event}: earthquakes and blocks left out, nine bins", ["", *map(str, cuts), "1"], rows)
    of_sets = {"all": at >= 0} | {str(name): sets[at] == name for name in np.unique(sets)}
    scores = lambda k: (log_scores(q[k], y[k]).mean() for q in (before, p))
    rows = [(name, *scores(k), p[k].mean(), y[k].mean()) for name, k in of_sets.items()]
    table(f"Records, {event}: mean log score", ["", "surface", "calibrated", "predicted", "observed"], rows)


for event in ("pro", "pex"):
    held_out(event)
    own_responses(event)
    recorded(event)
