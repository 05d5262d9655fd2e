"""Judges rates of evaluate --hazard at the sites of sites.py or worlds.py: python site_rates.py FOLDER
ROCKFRAG

The truth is the sum over the joint hazard of a site of its rates times P_ro, each earthquake by its own
magnitude. The table has, for each route, the rates over the truth, and how often the 95 % limits hold truths
whose c, ln s, m and eta are drawn. A second table tells how far the mean magnitude of the motions that
overturn lies above those of the disaggregation of PGA and of SA(1.0 s), a third what PGV/PGA tells less, that
mean and its sd within a site.
"""

import itertools
import json
import pathlib
import sys

import numpy as np
import pandas as pd
from scipy.interpolate import interp1d
from scipy.special import expit

import sites as S
from outcomes import PRIOR, SURFACE, apply, call, parts

OBJECTS = {"cabinet": (0.8, 2.2), "rack": (0.6, 2.0), "statue": (0.45, 1.7), "shelf": (0.35, 1.5)}
SD_OF_LOSS, DRAWS = 0.4, 40
# The magnitude that the level of the surface is for, and within which it counts.
MIDDLE, RANGE = 6.9, (5.0, 7.6)
LN_LOSS = np.linspace(-1.2, 1.2, 7)
folder, binary = pathlib.Path(sys.argv[1]), sys.argv[2]
data = np.load(folder / "sites.npz")
names, joint = data["names"], data["joint"]
random = np.random.default_rng(1)


def surface(width, height, eta, mw):
    """Logits of P_ro at the bins of PGA and PGV; -inf below uplift."""
    pga, pgv = np.exp(np.meshgrid(S.X, S.Y, indexing="ij"))
    keep = (pga > 9.81 * width / height) & (pga <= 4.5 * 9.81) & (pgv <= 5)
    cases = pd.DataFrame({"pga_m_s2": pga[keep], "pgv_m_s": pgv[keep]})
    result = np.full(pga.shape, -np.inf)
    result[keep] = apply(PRIOR, parts(cases.assign(width=width, height=height, eta=eta, mw=mw)))
    return result


class Truth:
    """Logits of P_ro of an object, by what they depend on."""

    def __init__(self, width, height):
        self.c, _, self.m, *self.sds = PRIOR
        etas = 1 - 1.5 * np.sin(np.arctan(width / height)) ** 2 * np.exp(LN_LOSS)
        self.logits = np.array([surface(width, height, eta, MIDDLE) for eta in etas])
        self.rocks = np.isfinite(self.logits[0])

    def rate(self, rates, c=0.0, ln_s=0.0, m=0.0, loss=0.0):
        """Of a site, with c, ln s, m and ln(1 - eta) off by so much."""
        by_loss = interp1d(LN_LOSS, self.logits[:, self.rocks], axis=0)
        z = self.c + c + np.exp(ln_s) * (by_loss(np.clip(loss, *LN_LOSS[[0, -1]])) - self.c)
        of = lambda mw: (self.m + m) * (np.clip(mw, *RANGE) - MIDDLE)
        return sum(expit(z + of(mw)) @ rates[k][self.rocks] for k, mw in enumerate(S.MAGNITUDES))


def write(k):
    """The files of a site as an engineer has them."""
    headings = {"pga": ("pga_g", 9.81), "pgv": ("pgv_m_s", 1), "sa": ("SA(1.0) (g)", 9.81)}
    for name, (heading, unit) in headings.items():
        levels, rates = data[name][k].T
        curve = pd.DataFrame({heading: levels / unit, "annual_rate_of_exceedance": rates})
        curve[(rates > 1e-9) & (rates < 0.5)].to_csv(folder / f"{name}.csv", index=False)
        for years in (975, 2475):
            level = np.minimum(levels, S.inverse(levels, rates, 1 / years)) / unit
            cut = pd.DataFrame({heading: level, "annual_rate_of_exceedance": np.maximum(rates, 1 / years)})
            cut[rates < 0.5].drop_duplicates().to_csv(folder / f"{name}{years}.csv", index=False)


# Curves, also cut at so many years, M or MS (the mean magnitude by PGA or by SA(1.0 s)) and V (Vs30).
ROUTES = [
    "PGA", "PGA, M, V", "PGV", "PGA, SA", "PGA, SA, MS", "PGA, PGV", "PGA, PGV, M", "PGA975", "PGA975, SA975",
    "PGA2475", "PGA2475, SA2475",
]  # fmt: skip
MEANS = {"M": data["mw_pga"], "MS": data["mw_sa"]}


def answers(k, route):
    words = {name: f"--magnitude={of[k]:.2f}" for name, of in MEANS.items()} | {"V": f"--vs30={names[k][3]}"}
    paths = ",".join(str(folder / f"{name.lower()}.csv") for name in route.split(", ") if name not in words)
    chosen = [words[name] for name in route.split(", ") if name in words]
    options = "--hazard", paths, *chosen, "--format=json"
    rows = json.loads(call(binary, "evaluate", "--structures", folder / "objects.csv", *options))
    return {row["structure"]: row for row in rows}


def judged(truths):
    """Of each site, route and object ln(rate/truth), how often limits hold drawn truths, their ln width."""
    for k in np.flatnonzero(np.isin(names[:, 0], ["judge", "magnitude", "world"])):
        write(k)
        sites = names[k, 1 if names[k, 0] == "world" else 0]
        true = {name: truth.rate(joint[k]) for name, truth in truths.items()}
        draw = lambda truth: truth.rate(joint[k], *(random.normal(size=4) * [*truth.sds, SD_OF_LOSS]))
        drawn = {name: [draw(truth) for _ in range(DRAWS)] for name, truth in truths.items()}
        for route in ROUTES:
            for name, row in answers(k, route).items():
                value, low, high = (row[f"overturning_per_year{end}"] for end in ("", "_low", "_high"))
                if value is not None and true[name] > 1e-9:
                    held = np.mean([low <= rate <= high for rate in drawn[name]])
                    yield sites, route, np.log(value / true[name]), held, np.log(high) - np.log(low)


def magnitudes(truths):
    """Of each site and object, how far the mean magnitude of what overturns is above others; mean, sd."""
    intercept, slope, _, *ends = SURFACE.numbers["magnitude", "recorded"]
    tells = np.clip(intercept + slope * (S.Y - S.X[:, None]), *ends)
    for k, truth in itertools.product(range(len(names)), truths.values()):
        rates = np.array([truth.rate(joint[k] * (S.MAGNITUDES == mw)[:, None, None]) for mw in S.MAGNITUDES])
        mw = np.average(S.MAGNITUDES, weights=rates)
        within = np.sqrt(np.average((S.MAGNITUDES - mw) ** 2, weights=rates))
        weights = joint[k].sum(axis=0) * expit(truth.logits[3] + truth.m * (tells - MIDDLE))
        told = np.average(tells, weights=weights)
        site = names[k, 1].rstrip(" 0123456789") or names[k, 1]
        yield *names[k, :1], site, *(mw - of[k] for of in MEANS.values()), mw - told, mw, within


def summary(rows):
    off = rows["off"]
    names, rms = ["n", "geometric mean", "rms ln", "held", "high/low"], np.sqrt((off**2).mean())
    numbers = [len(off), np.exp(off.mean()), rms, rows["held"].mean(), np.exp(rows["width"].mean())]
    return pd.Series(numbers, names)


pd.DataFrame(OBJECTS, ["width", "height"]).T.to_csv(folder / "objects.csv", index_label="name")
of_objects = {name: Truth(*size) for name, size in OBJECTS.items()}
found = pd.DataFrame(judged(of_objects), columns=["sites", "route", "off", "held", "width"])
print(found.groupby(["sites", "route"], sort=False)[found.columns[2:]].apply(summary).round(3).to_string())
columns = ["kind", "sites", "above that of PGA", "that of SA", "that of PGV/PGA", "mean", "within"]
above = pd.DataFrame(magnitudes(of_objects), columns=columns)
print(above.groupby(["kind", "sites"], sort=False)[columns[2:4]].mean().round(2).to_string())
print(above.groupby("kind", sort=False)[columns[4:]].agg(["mean", "std"]).round(2).to_string())
