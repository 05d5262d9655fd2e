"""Prints how well the surface does, as tables in Markdown: python judge.py SURFACE.csv HAZARD.csv FOLDER"""

import sys

import numpy as np
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

import cases as of
from calibration import apply, calibrate, logistic, standard_error
from fit import monotone_logistic
from make import LIMIT, WIDE, chosen
from surface import KINDS, LIMITS, Surface, some

surface = Surface(sys.argv[1])
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


def paper(event, cases, happened):
    """The paper's probit of IM4 and IM3, or its two planes of the demand, as a function of cases."""
    columns = lines(cases)
    if event == "pro":
        loss = lambda b: -log_ndtr(np.where(happened, 1, -1) * (columns @ b)).sum()
        b = minimize(loss, [0.0, 1.0, -1.0], method="BFGS").x
        return lambda c: ndtr(lines(c) @ b)
    low, fits = cases["im4"] < 1.3, []
    for side in (low, ~low):
        b, *_ = np.linalg.lstsq(columns[side], np.log(cases["edp"][side]), rcond=None)
        fits.append((b, np.std(np.log(cases["edp"][side]) - columns[side] @ b) if side.sum() > 3 else 1.0))
    at = lambda c, b, sd: ndtr((lines(c) @ b - np.log(LIMIT)) / sd)
    return lambda c: np.where(c["im4"] < 1.3, at(c, *fits[0]), at(c, *fits[1]))


def own(event, kind, cases, few):
    """What is fitted to one's own cases, as functions of cases; `few` are the motions of the last one."""
    cases, happened = chosen(event, cases)
    logit = lambda c: surface.logit(event, kind, c, LIMIT)
    prior, few = surface.calibration[kind, event][:4], np.isin(cases["motion_id"], few)
    bent = lambda c: np.stack([*lines(c).T, *(lines(c)[:, [1, 1, 2]] * lines(c)[:, [1, 2, 2]]).T], axis=1)
    quadratic = monotone_logistic(bent(cases), happened.astype(float), np.zeros((0, 6)), 0.01)
    calibrated = lambda b: lambda c: logistic(apply(b, logit(c)))
    return {
        "share": lambda c: np.full(len(c["im4"]), (happened.sum() + 0.5) / (len(happened) + 1)),
        "paper": paper(event, cases, happened), "quadratic": lambda c: logistic(bent(c) @ quadratic),
        "surface": calibrated(prior[:2]),
        "calibrated": calibrated(calibrate(logit(cases), happened, prior)[0]),
        "of few": calibrated(calibrate(logit(cases)[few], happened[few], prior)[0]),
    }  # fmt: skip


def held_out(folder):
    cases, rows = of.read([f"{folder}/test.parquet"]), []
    for event in ("pro", "pex"):
        each = []
        for kind in KINDS:
            c, _ = chosen(event, some(cases, cases["kind"] == kind))
            limits = LIMITS if event == "pex" else LIMITS[:1]
            happened = [c["edp"] > limit if event == "pex" else c["overturned"] for limit in limits]
            p = [logistic(surface.logit(event, kind, c, limit)) for limit in limits]
            each.append(log_scores(np.concatenate(p), np.concatenate(happened)))
        rows.append((event, *(v.mean() for v in each), np.concatenate(each).mean()))
    table("Held out: 64 structures under motions of another seed, mean log score", ["", *KINDS, "all"], rows)


def own_responses(folder, event):
    rows = {}
    for kind in KINDS:
        study = [of.read([f"{folder}/study_{seed}.parquet"], 1.0, kind) for seed in (101, 102, 103)]
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


def holds(logit, sd, happened, groups):
    """Share of groups of five or more whose number of events is within 95 % of what the logits predict,
    where each group is off by one normal number of standard deviation `sd`; ties count by chance."""
    _, at = np.unique(groups, return_inverse=True)
    n = at.max() + 1
    shifted = (logistic(logit + sd * rng.standard_normal(n)[at]) for _ in range(400))
    more = np.bincount(at, happened, n) - [np.bincount(at, rng.random(len(at)) < p, n) for p in shifted]
    rank = (more > 0).mean(axis=0) + rng.random(n) * (more == 0).mean(axis=0)
    return ((rank > 0.025) & (rank < 0.975))[np.bincount(at) >= 5].mean()


def recorded(folder, event):
    """Half of the earthquakes and half of the blocks left out together, 40 times."""
    cases, happened = chosen(event, of.read([f"{folder}/blocks.parquet"]))
    logit, tau = surface.logit(event, "recorded", cases, LIMIT), surface.calibration["recorded", event][4]
    sets, parts = np.array([name.split()[0] for name in cases["motion_id"]]), []
    for _ in range(40):
        half = lambda name: np.isin(cases[name], rng.permutation(np.unique(cases[name]))[::2])
        quakes, blocks = half("cluster"), half("structure")
        train, test = np.flatnonzero(quakes & blocks), np.flatnonzero(~quakes & ~blocks)
        b, v = calibrate(logit[train], happened[train], WIDE, cases["cluster"][train])
        sd = np.hypot(standard_error(b, v, logit[test]), tau)
        held = holds(apply(b, logit[test]), sd, happened[test], cases["cluster"][test])
        parts.append((test, apply(b, logit[test]), [*b, held]))
    at, z = (np.concatenate([part[k] for part in parts]) for k in (0, 1))
    p, y, before = logistic(z), happened[at], logistic(logit[at])
    cuts = np.array([0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95])
    bins = [np.digitize(p, cuts) == k for k in range(9)]
    rows = [("predicted", *(p[k].mean() for k in bins)), ("observed", *(y[k].mean() for k in bins))]
    table(f"Records, {event}: earthquakes and blocks left out, nine bins", ["", *map(str, cuts), "1"], rows)
    of_sets = {"all": at >= 0} | {str(name): sets[at] == name for name in np.unique(sets)}
    rows = [(name, *(log_scores(q[k], y[k]).mean() for q in (before, p)), p[k].mean(), y[k].mean())
            for name, k in of_sets.items()]  # fmt: skip
    table(f"Records, {event}: mean log score", ["", "surface", "calibrated", "predicted", "observed"], rows)
    c, ln_s, held = np.mean([part[2] for part in parts], axis=0)
    print(f"\nc {c:.2f}, ln s {ln_s:.2f}; limits hold the events of {held:.3f} of the earthquakes")


def hazard_weights(hazard, least, most):
    """60 values of ln PGA (m/s2), none above `most`, and their annual rates, straight between logarithms."""
    rows = [line.split(",") for line in open(hazard) if line[0].isdigit()]
    pga, rate = np.log(np.array(rows, dtype=float).T)
    edges = np.append(np.linspace(least, most, 60), np.inf)
    rates = np.exp(np.interp(edges[:-1], pga + np.log(9.81), rate))
    return np.append((edges[1:-1] + edges[:-2]) / 2, most), -np.diff(np.append(rates, 0.0))


def rates(folder, hazard):
    """Annual rates of overturning by calibrations to 3500 motions, and the count of all 35,000."""
    study = [of.read([f"{folder}/study_{seed}.parquet"], 1.0, "csgm") for seed in range(101, 111)]
    nodes, weights = np.polynomial.hermite_e.hermegauss(9)
    intercept, slope, knot, bend, *sd = surface.peaks["csgm", "pga"]
    rows, held = [], []
    for number in range(30):
        each = [some(cases, cases["structure"] == number) for cases in study]
        events = np.mean([cases["overturned"].sum() for cases in each])
        if not 5 <= events <= 500 or len(rows) == 10:
            continue
        every = {name: np.concatenate([cases[name] for cases in each]) for name in each[0]}
        p, alpha, eta, uplift = (
            *(every[k][0] for k in ("p_rad_s", "alpha_rad", "eta")),
            9.81 * np.tan(every["alpha_rad"][0]),
        )
        peak = np.log(every["pga_m_s2"])
        ln_pga, annual = hazard_weights(hazard, np.log(uplift), peak.max())
        at = np.abs(peak[:, None] - ln_pga).argmin(axis=1)
        count, fell = (np.bincount(at, w, len(ln_pga)) for w in (None, every["overturned"]))
        truth = annual @ np.interp(ln_pga, ln_pga[count > 0], (fell / np.maximum(count, 1))[count > 0])
        line = intercept + slope * ln_pga + bend * np.maximum(ln_pga - knot, 0)
        ratio = np.exp(line[:, None] + np.where(nodes > 0, sd[1], sd[0]) * nodes).ravel()
        im4, weight = (
            np.repeat(np.exp(ln_pga) / uplift, len(nodes)),
            np.outer(annual, weights / weights.sum()).ravel(),
        )
        one = np.ones_like(im4)
        grid = {
            "im4": im4,
            "im5": im4 * p * ratio,
            "im3": 1 / (p * ratio),
            "p_rad_s": p * one,
            "eta": eta * one,
        }
        logit = surface.logit("pro", "csgm", grid)
        rate, ratios = lambda b: weight @ logistic(apply(b, logit)), []
        for cases in each:
            own_logit, prior = surface.logit("pro", "csgm", cases), surface.calibration["csgm", "pro"][:4]
            b, v = calibrate(own_logit, cases["overturned"], prior, cases["cluster"])
            tangent = np.array([np.log(rate(b + h) / rate(b - h)) / 2e-4 for h in 1e-4 * np.eye(2)])
            ratios.append(rate(b) / truth)
            held.append(abs(np.log(ratios[-1])) <= 1.96 * np.sqrt(tangent @ v @ tangent))
        ratios = [rate(np.zeros(2)) / truth, np.exp(np.mean(np.log(ratios))), min(ratios), max(ratios)]
        name = f"{p:.2f}, {alpha:.3f}, {eta:.3f}"
        rows.append((name, round(events), f"{truth:.2e}", *ratios, f"{sum(held[-10:])} of 10"))
    head = [
        "p, alpha, eta",
        "events",
        "rate, counted",
        "surface",
        "calibrated",
        "least",
        "largest",
        "limits hold",
    ]
    table(
        "Annual rates of overturning, ratio to the count of 35,000 motions; calibrated: mean of ten seeds",
        head,
        rows,
    )
    print(f"\n95 % limits hold {sum(held)} of {len(held)}")


if __name__ == "__main__":
    _, _, hazard, folder = sys.argv
    held_out(folder)
    for event in ("pro", "pex"):
        own_responses(folder, event)
        recorded(folder, event)
    rates(folder, hazard)
