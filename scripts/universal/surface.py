"""The universal surface: logits of P_ro and P_ex as sums of products of features, and what is added near
uplift (core/data/universal.csv defines both). Cases have p_rad_s, eta, im4, im5, mw (null where it is
unknown) and limit.
"""

from functools import reduce
from operator import mul

import numpy as np
import polars as pl

KINDS = ["recorded", "csgm", "pulse", "hfc"]
BOTH = ["1", "x", "w", "x^2", "eta", "p", "x*p", "x*eta", "x*r^2", "w^3"]
TERMS = {"pro": [*BOTH, "r^2", "r^3"], "pex": [*BOTH, "limit", "end", "x*w", "x^2*r", "eta*p"]}
# Of synthetic motions alone: under recorded ones these cost .002 of the score on earthquakes left out.
SYNTHETIC = {"pro": ["x*w", "x^2*eta", "eta*p"], "pex": ["r^2", "x^2*eta", "w*limit"]}
# Whose coefficients under recorded motions are not those of high frequencies alone: .003 of the score of P_ex
# at .1 on earthquakes left out. In P_ro p costs .003.
CORRECTED = {"pro": [], "pex": ["limit", "p"]}
DOMAIN = {"p": (0.4, 8.0), "eta": (0.7, 0.999), "alpha": (0.04, 0.5)}
DOMAIN |= {"limit": (0.02, 0.9), "ratio": (1.0, 45.0)}
MOST_IM4 = 18.61
# The limit state at which P_ex is calibrated; at that of P_ro its features are 0.
LIMIT, NO_LIMIT = 0.1, 0.2
# Those to which is fitted what a floor and a wall add.
LIMITS = {"pro": [NO_LIMIT], "pex": [0.05, 0.1, 0.2, 0.5]}
# PGA is held where IM4 ends.
RATIO = pl.col("im4").clip(upper_bound=MOST_IM4) / pl.col("im5") * pl.col("p_rad_s")


def features():
    """All but IM4 at its lower end are held at the rim of the domain."""
    held = lambda name, value: value.clip(*DOMAIN[name])
    p, limit = held("p", pl.col("p_rad_s")), held("limit", pl.col("limit"))
    r, ln_im4 = (held("ratio", RATIO) / p).log(), pl.col("im4").clip(1.0, MOST_IM4).log()
    ln_limit = (limit / NO_LIMIT).log()
    return {
        "x": (ln_im4 + 0.2).log(), "w": ln_im4 - r - 0.4 * ln_limit, "r": r, "p": (p / 2.0).log(),
        "eta": (held("eta", pl.col("eta")) - 0.85) / 0.1, "limit": ln_limit, "end": (1.1 - limit).log(),
    }  # fmt: skip


def design(terms, cases):
    """Returns the n x k matrix of the functions at n cases."""
    known, columns = cases.select(**features()), []
    for term in terms:
        powers = [factor.partition("^") for factor in term.split("*") if factor != "1"]
        product = reduce(mul, (known[name].to_numpy() ** int(power or 1) for name, _, power in powers), 1.0)
        columns.append(np.broadcast_to(product, len(cases)))
    return np.stack(columns, axis=1) if terms else np.zeros((len(cases), 0))


def uplift(cases, numbers):
    """-(d/((IM4 - 1) IM5^k))^n of (n, d, k), which goes to minus infinity at uplift."""
    n, d, k = numbers
    with np.errstate(divide="ignore"):
        power = n * (np.log(d) - np.log(cases["im4"].to_numpy() - 1.0) - k * np.log(cases["im5"].to_numpy()))
    return -np.exp(np.minimum(power, 20.0))


def magnitude(cases, line):
    """M - 6.9, held within the data; if unknown by `line`: intercept, slope, sd, low and high of M."""
    intercept, slope, _, low, high = line
    known = pl.col("mw").fill_null(intercept - slope * RATIO.log()).clip(low, high)
    return cases.select(known - 6.9).to_series().to_numpy()


class Surface:
    """What the lines of core/data/universal.csv hold: numbers by words, such as ("uplift", "csgm", "pro")."""

    def __init__(self, lines):
        self.numbers = {}
        for cells in (line.split(",") for line in lines if not line.startswith("#")):
            words = 2 if cells[0] in ("domain", "magnitude") else 3
            self.numbers[tuple(cells[:words])] = [float(cell) for cell in cells[words:]]

    def parts(self, event, kind, cases):
        """Of each case L, M - 6.9, and what is added near uplift: n x 3."""
        terms = [*TERMS[event], *SYNTHETIC[event]]
        b = [self.numbers["term", event, term][KINDS.index(kind)] for term in terms]
        m, added = self.numbers["magnitude", kind], self.numbers["uplift", kind, event]
        return np.stack([design(terms, cases) @ b, magnitude(cases, m), uplift(cases, added)], axis=1)

    def prior(self, event, kind, limit=LIMIT):
        """Means and sds of c, ln s and m; c at this limit state."""
        c, *five, _, by_limit = self.numbers["calibration", kind, event]
        return np.array([c + by_limit * np.log(1.1 - limit), *five])
