"""Prints how well the surface does, as tables in Markdown: python judge.py SURFACE.csv HAZARD.csv FOLDER [TABLE...]"""

import sys
from functools import cache

import numpy as np
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

import cases as of
from calibration import apply, calibrate, logistic, standard_error
from fit import monotone_logistic
from make import LIMIT, WIDE, chosen
from surface import KINDS, LIMITS, Surface, log_score, scaled, some

SURFACE, HAZARD, FOLDER, *TABLES = sys.argv[1:]
surface = Surface(SURFACE)
rng = np.random.default_rng(1)


def table(title, head, rows):
    cell = lambda v: v if isinstance(v, str) else str(v) if isinstance(v, (int, np.integer)) else f"{v:.4f}"
    print(f"\n{title}\n\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
    print("\n".join("| " + " | ".join(map(cell, row)) + " |" for row in rows), flush=True)


@cache
def study(seed, kind):
    return of.read([f"{FOLDER}/study_{seed}.parquet"], 1.0, kind)


def of_structure(cases, number):
    return some(cases, cases["structure"] == number)


def lines(cases):
    return np.stack([np.ones(len(cases["im4"])), np.log(cases["im4"]), np.log(cases["im3"])], axis=1)


def bent(cases):
    _, x, y = lines(cases).T
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)


def probit(cases, happened):
    """The paper's curve: coefficients, and their covariance between clusters."""
    columns, sign = lines(cases), np.where(happened, 1.0, -1.0)
    loss = lambda b: -log_ndtr(sign * (columns @ b)).sum()
    b = minimize(loss, [0.0, 1.0, -1.0], method="BFGS", options={"gtol": 1e-7}).x
    z = sign * (columns @ b)
    mills = np.exp(-z * z / 2 - log_ndtr(z)) / np.sqrt(2 * np.pi)
    bread = np.linalg.pinv(columns.T @ (columns * (mills * (z + mills))[:, None]))
    _, at = np.unique(cases["cluster"], return_inverse=True)
    sums = np.stack([np.bincount(at, column) for column in (columns * (sign * mills)[:, None]).T], axis=1)
    g, n = len(sums), len(z)
    return b, bread @ (g / (g - 1) * (n - 1) / (n - 3) * sums.T @ sums) @ bread


def planes(cases):
    """The paper's two planes of the demand, as a function that gives P_ex at the limit."""
    columns, demand, out = lines(cases), np.log(cases["edp"]), []
    low = cases["im4"] < 1.3
    for side in (low, ~low):
        b, *_ = np.linalg.lstsq(columns[side], demand[side], rcond=None)
        out.append((b, np.std(demand[side] - columns[side] @ b, ddof=3) if side.sum() > 3 else 1.0))
    at = lambda c, b, sd: ndtr((lines(c) @ b - np.log(LIMIT)) / sd)
    return lambda c: np.where(c["im4"] < 1.3, at(c, *out[0]), at(c, *out[1]))


def quadratic(cases, happened):
    b = monotone_logistic(bent(cases), happened.astype(float), np.zeros((0, 6)))
    return lambda c: logistic(bent(c) @ b)


def own(event, kind, cases, few=None):
    """What is fitted to one's own cases: functions of cases that give probabilities, by name."""
    cases, happened = chosen(event, cases)
    share = (happened.sum() + 0.5) / (len(happened) + 1)
    logit = lambda c: surface.logit(event, kind, c, LIMIT)
    prior, shipped = surface.calibration[kind, event][:4], surface.calibration[kind, event][:2]
    b, _ = calibrate(logit(cases), happened, prior)
    b_few = b if few is None else calibrate(logit(some(cases, few(cases))), happened[few(cases)], prior)[0]
    paper = planes(cases) if event == "pex" else (lambda b: lambda c: ndtr(lines(c) @ b))(probit(cases, happened)[0])
    return {"share": lambda c: np.full(len(c["im4"]), share), "paper": paper, "quadratic": quadratic(cases, happened),
            "surface": lambda c: logistic(apply(shipped, logit(c))), "calibrated": lambda c: logistic(apply(b, logit(c))),
            "of 350": lambda c: logistic(apply(b_few, logit(c)))}  # fmt: skip


def score(p, happened):
    p = np.clip(p, 1e-6, 1 - 1e-6)
    return np.where(happened, np.log(p), np.log1p(-p)).mean()


def held_out():
    cases, rows = of.read([f"{FOLDER}/test.parquet"]), []
    for event in ("pro", "pex"):
        counted, _ = chosen(event, cases)
        limits = LIMITS if event == "pex" else LIMITS[:1]
        each = {}
        for kind in KINDS:
            c = some(counted, counted["kind"] == kind)
            happened = lambda limit: c["overturned"] if event == "pro" else c["edp"] > limit
            each[kind] = np.mean([log_score(surface.logit(event, kind, c, at), happened(at)) for at in limits], axis=0)
        rows.append((event, *(v.mean() for v in each.values()), np.concatenate(list(each.values())).mean()))
    table("Held out: 64 structures and a seed, mean log score", ["", *KINDS, "all"], rows)


def own_responses(event):
    rows, names = {}, ["share", "paper", "quadratic", "surface", "calibrated", "of 350"]
    for kind in KINDS:
        for number in range(22):
            fitted = of_structure(study(101, kind), number)
            judged = [chosen(event, of_structure(study(seed, kind), number)) for seed in (102, 103)]
            _, happened = chosen(event, fitted)
            if happened.sum() == 0 and event == "pex":
                continue
            motions = rng.permutation(np.unique(study(101, kind)["motion_id"]))[:350]
            models = own(event, kind, fitted, lambda c: np.isin(c["motion_id"], motions))
            share = happened.mean()
            band = "< 5 %" if share < 0.05 else "5-20 %" if share < 0.2 else "> 20 %"
            rows.setdefault((kind, band), []).append([np.mean([score(models[n](c), y) for c, y in judged]) for n in names])
    body = [(*key, len(v), *np.mean(v, axis=0)) for key, v in sorted(rows.items())]
    table(f"Own responses, {event}: mean log score on two other seeds", ["kind", "share", "structures", *names], body)


def falls():
    rows = []
    structures = of.structures(128, 100, (0.4, 0.04, 0.7), (8.0, 0.5, 0.999))[:100]
    for kind in KINDS:
        cases = study(102, kind)
        first = np.unique(cases["motion_id"], return_index=True)[1]
        worst = {"surface": 0.0, "c, s": 0.0, "more": 0.0}
        for p, alpha, eta in structures:
            m = some(cases, rng.choice(first, 20))
            n = np.ones(20)
            base = {"p_rad_s": p * n, "eta": eta * n, "im4": m["pga_m_s2"] / (9.81 * np.tan(alpha)),
                    "im5": p * m["pgv_m_s"] / (9.81 * np.tan(alpha)), "im3": m["pga_m_s2"] / (p * m["pgv_m_s"])}  # fmt: skip
            scales = np.exp(np.linspace(np.log(0.25), np.log(4), 57))
            with np.errstate(invalid="ignore", divide="ignore"):
                logit = np.stack([surface.logit("pro", kind, scaled(base, k)) for k in scales])
            rocks = base["im4"] * scales[:, None] > 1.0
            for name, b in (("surface", (0, 0)), ("c, s", (0.5, 0.3)), ("more", (2.0, -0.3))):
                p_ro = np.where(rocks, logistic(apply(b, logit)), 0.0)
                worst[name] = max(worst[name], (np.maximum.accumulate(p_ro, axis=0) - p_ro).max())
        rows.append((kind, *worst.values()))
    table("Largest fall of P_ro as a motion is scaled 0.25 to 4 times", ["kind", "surface", "c 0.5, ln s 0.3", "c 2, ln s -0.3"], rows)


def hazard():
    rows = [line.split(",") for line in open(HAZARD) if line[0] in "0123456789"]
    pga, rate = np.array(rows, dtype=float).T
    return np.log(9.81 * pga), np.log(rate)


def rates():
    """Annual rates of overturning: of the calibrated model, against the count of 35,000 motions in bins of 0.05 of ln PGA."""
    ln_pga, ln_rate = hazard()
    rate = lambda at: np.exp(np.interp(at, ln_pga, ln_rate))
    nodes, weights = np.polynomial.hermite_e.hermegauss(9)
    rows, seeds = [], range(101, 111)
    for number in range(30):
        each = [of_structure(study(seed, "csgm"), number) for seed in seeds]
        events = np.mean([c["overturned"].sum() for c in each])
        if not 5 <= events <= 500 or len(rows) == 10:
            continue
        p, alpha, eta = (each[0][name][0] for name in ("p_rad_s", "alpha_rad", "eta"))
        weight = 9.81 * np.tan(alpha)
        edges = np.linspace(np.log(weight), ln_pga[-1], 60)
        middle, share = (edges[1:] + edges[:-1]) / 2, -np.diff(rate(edges))
        share[-1] += rate(edges[-1])
        peak = np.log(np.concatenate([c["pga_m_s2"] for c in each]))
        at = np.clip(np.searchsorted(edges, peak) - 1, 0, len(middle) - 1)
        count = np.bincount(at, minlength=len(middle))
        fell = np.bincount(at, np.concatenate([c["overturned"] for c in each]), len(middle))
        known = count > 0
        truth = (share * np.interp(middle, middle[known], fell[known] / count[known])).sum()
        middle = np.minimum(middle, peak.max())
        intercept, slope, knot, bend, *sd = surface.peaks["csgm", "pga"]
        line = intercept + slope * middle + bend * np.maximum(middle - knot, 0)
        ratio = np.exp(line[:, None] + np.where(nodes > 0, sd[1], sd[0]) * nodes)
        im4 = np.repeat(np.exp(middle) / weight, len(nodes))
        grid = {"p_rad_s": np.full(im4.size, p), "eta": np.full(im4.size, eta), "im4": im4, "im5": im4 * p * ratio.ravel()}
        grid["im3"] = grid["im4"] / grid["im5"]
        logit, of_grid = surface.logit("pro", "csgm", grid), np.outer(share, weights / weights.sum()).ravel()
        predicted, held, ratios = lambda b: (of_grid * logistic(apply(b, logit))).sum(), 0, []
        for c in each:
            own_logit = surface.logit("pro", "csgm", c)
            b, v = calibrate(own_logit, c["overturned"], surface.calibration["csgm", "pro"][:4], c["cluster"])
            steps = [(np.log(predicted(b + h)) - np.log(predicted(b - h))) / 2e-4 for h in 1e-4 * np.eye(2)]
            width = 1.96 * np.sqrt(np.array(steps) @ v @ np.array(steps))
            ratios.append(predicted(b) / truth)
            held += abs(np.log(ratios[-1])) <= width
        rows.append((f"p {p:.2f}, alpha {alpha:.3f}, eta {eta:.3f}", round(events), f"{truth:.2e}", predicted(np.zeros(2)) / truth,
                     np.exp(np.mean(np.log(ratios))), min(ratios), max(ratios), f"{held} of {len(ratios)}"))  # fmt: skip
    head = ["structure", "events of 3500", "rate, counted", "surface", "calibrated, mean of ten", "least", "largest", "limits hold"]
    table("Annual rates of overturning, ratio to the count", head, rows)
    print("\nlimits that hold:", sum(int(r[-1].split()[0]) for r in rows), "of", 10 * len(rows))


@cache
def blocks():
    return of.read([f"{FOLDER}/blocks.parquet"])


def holds(logit, sd, happened, groups):
    """Share of groups (of five cases or more) whose number of events is within 95 % of what the logits predict, if each
    group is off by one normal number of standard deviation `sd`; ties count by chance."""
    _, at = np.unique(groups, return_inverse=True)
    n = at.max() + 1
    seen, below, tied = np.bincount(at, happened, n), np.zeros(n), np.zeros(n)
    for _ in range(400):
        drawn = rng.random(len(at)) < logistic(logit + (sd * rng.standard_normal(n)[at]))
        count = np.bincount(at, drawn, n)
        below, tied = below + (count < seen), tied + (count == seen)
    rank = (below + rng.random(n) * tied) / 400
    return ((rank > 0.025) & (rank < 0.975))[np.bincount(at) >= 5].mean()


def recorded(event):
    """Half of the earthquakes and blocks left out together, 40 times: c and s of the other half."""
    cases, happened = chosen(event, blocks())
    logit, out = surface.logit(event, "recorded", cases, LIMIT), []
    sets, tau = np.array([name.split()[0] for name in cases["motion_id"]]), surface.calibration["recorded", event][4]
    for _ in range(40):
        fitted = [np.isin(cases[name], rng.permutation(np.unique(cases[name]))[::2]) for name in ("cluster", "structure")]
        train, test = fitted[0] & fitted[1], ~fitted[0] & ~fitted[1]
        b, v = calibrate(logit[train], happened[train], WIDE, cases["cluster"][train])
        sd = np.hypot(standard_error(b, v, logit[test]), tau)
        held = holds(apply(b, logit[test]), sd, happened[test], np.char.add(cases["cluster"][test].astype(str), cases["structure"][test].astype(str)))
        by_quake = holds(apply(b, logit[test]), sd, happened[test], cases["cluster"][test])
        out.append((np.flatnonzero(test), apply(b, logit[test]), held, by_quake, b))
    at, z = (np.concatenate([o[k] for o in out]) for k in (0, 1))
    p, y = logistic(z), happened[at]
    cuts = [0, 0.01, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.95, 1]
    bins = [(p >= low) & (p < high) for low, high in zip(cuts, cuts[1:])]
    table(f"Records, {event}: earthquakes and blocks left out, nine bins", ["", *map(str, cuts[1:])],
          [("predicted", *(p[k].mean() for k in bins)), ("observed", *(y[k].mean() for k in bins)),
           ("cases", *(f"{k.sum() / 40:.0f}" for k in bins))])  # fmt: skip
    rows = [(name, int(k.sum() / 40), log_score(logit[at][k], y[k]).mean(), log_score(z[k], y[k]).mean(), p[k].mean(), y[k].mean())
            for name, k in (("all", at >= 0), *((n, sets[at] == n) for n in np.unique(sets)))]
    table(f"Records, {event}: log score", ["set", "cases", "before", "calibrated", "predicted", "observed"], rows)
    print(f"\nc {np.mean([o[4][0] for o in out]):.2f} (sd {np.std([o[4][0] for o in out]):.2f}), ln s {np.mean([o[4][1] for o in out]):.2f};",
          f"limits hold of an earthquake and block {np.nanmean([o[2] for o in out]):.3f}, of an earthquake {np.mean([o[3] for o in out]):.3f}")


def forty():
    """Forty of the 100 components, a block at a time, judged on the other sixty."""
    names = ["share", "paper", "quadratic", "surface", "calibrated"]
    rows = []
    for event in ("pro", "pex"):
        scores = []
        for _ in range(6):
            components = rng.permutation(np.unique(blocks()["motion_id"]))
            for number in range(60):
                of_block = of_structure(blocks(), number)
                mine = np.isin(of_block["motion_id"], components[:40])
                _, happened = chosen(event, some(of_block, mine))
                others, judged = chosen(event, some(of_block, ~mine))
                if min(happened.sum(), (~happened).sum()) < 3 or len(judged) == 0:
                    continue
                models = own(event, "recorded", some(of_block, mine))
                scores.append([score(models[name](others), judged) for name in names])
        rows.append((event, len(scores), *np.mean(scores, axis=0), np.mean(np.array(scores)[:, 4] > np.array(scores)[:, 1])))
    table("Forty records of one's own", ["", "cases", *names[:3], "recorded as shipped", names[4], "better than the paper's"], rows)


def pair():
    """95 % limits of P_ro of the paper's curve and of the calibrated surface, of few records."""
    every, rows = of_structure(blocks(), 2), []
    order = rng.permutation(np.unique(every["motion_id"]))
    apart = {name: name for name in order}
    twins = next((a, b) for a in order for b in order if a < b and a[:-3] == b[:-3])
    forty = [*twins, *[name for name in order if name not in twins][:38]]
    fell = [name for name in order if every["overturned"][every["motion_id"] == name].any()]
    stood = [name for name in order if name not in fell]
    prior = surface.calibration["recorded", "pro"][:4]
    for title, chosen_names in (("forty, one pair of one earthquake", forty), ("eight", [*fell[:3], *stood[:5]]),
                                ("forty, none overturning", stood[:40]), ("thirty, all overturning", fell[:30])):  # fmt: skip
        cases = some(every, np.isin(every["motion_id"], chosen_names))
        cases["cluster"] = np.array(["pair" if name in twins else apart[name] for name in cases["motion_id"]])
        logit = surface.logit("pro", "recorded", cases)
        b, v = calibrate(logit, cases["overturned"], prior, cases["cluster"])
        at = np.argsort(logit)[[len(logit) // 4, len(logit) // 2, 3 * len(logit) // 4]]
        with np.errstate(all="ignore"):
            paper, cov = probit(cases, cases["overturned"])
            z, sd = lines(cases)[at] @ paper, np.sqrt(np.einsum("ni,ij,nj->n", lines(cases)[at], cov, lines(cases)[at]))
            before = [f"{ndtr(m):.3f} ({ndtr(m - 1.96 * s):.3f}-{ndtr(m + 1.96 * s):.3f})" for m, s in zip(z, sd)]
        z, sd = apply(b, logit[at]), standard_error(b, v, logit[at])
        now = [f"{logistic(m):.3f} ({logistic(m - 1.96 * s):.3f}-{logistic(m + 1.96 * s):.3f})" for m, s in zip(z, sd)]
        rows += [(title, f"{cases['overturned'].sum()} of {len(logit)}", "paper", *before), ("", "", "calibrated", *now)]
    table("P_ro with 95 % limits (of many earthquakes) at three of the records", ["records", "fell", "", "quarter", "median", "three quarters"], rows)


ALL = {"held_out": held_out, "own_pro": lambda: own_responses("pro"), "own_pex": lambda: own_responses("pex"),
       "recorded_pro": lambda: recorded("pro"), "recorded_pex": lambda: recorded("pex"), "forty": forty, "falls": falls,
       "rates": rates, "pair": pair}  # fmt: skip
for name in TABLES or ALL:
    ALL[name]()
