"""The universal surface: logits of P_ro and P_ex as sums of products of features, and what is added to them
near uplift (data/universal.csv defines both)."""

import numpy as np

KINDS = ("recorded", "csgm", "pulse", "hfc")
LIMITS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5)
BOTH = ["1", "x", "w", "x^2", "eta", "p", "x*p", "x*eta", "x*r^2", "w^3"]
TERMS = {"pro": [*BOTH, "r^2", "r^3"], "pex": [*BOTH, "limit", "end", "x*w", "x^2*r", "eta*p"]}
DOMAIN = {"p": (0.4, 8.0), "eta": (0.7, 0.999), "alpha": (0.04, 0.5), "limit": (0.02, 0.9), "ratio": (1.0, 45.0)}
MOST_IM4 = 18.61
NOWHERE = {"im4": 1.0, "im5": 1.0, "p_rad_s": 1.0, "eta": 0.9}


def features(event, cases, limit):
    """All but IM4 at its lower end are held at the rim of the domain."""
    held = lambda name, values: np.clip(values, *DOMAIN[name])
    p, ln_im4 = held("p", cases["p_rad_s"]), np.log(np.clip(cases["im4"], 1.0, MOST_IM4))
    r = np.log(held("ratio", cases["im4"] / cases["im5"] * cases["p_rad_s"]) / p)
    limit = held("limit", limit) if event == "pex" else 0.2
    end, limit = np.log(1.1 - limit) * (event == "pex"), np.log(limit / 0.2)
    return {
        "x": np.log(ln_im4 + 0.2), "w": ln_im4 - r - 0.4 * limit, "r": r, "p": np.log(p / 2.0),
        "eta": (held("eta", cases["eta"]) - 0.85) / 0.1, "limit": limit, "end": end,
    }  # fmt: skip


def design(event, cases, limit=0.2, terms=None):
    """Returns the n x k matrix of the functions at n cases; of P_ro, `limit` does not count."""
    known, columns = features(event, cases, limit), []
    for term in terms or TERMS[event]:
        column = np.ones(len(cases["im4"]))
        for factor in term.split("*") if term != "1" else ():
            name, _, power = factor.partition("^")
            column = column * known[name] ** int(power or 1)
        columns.append(column)
    return np.stack(columns, axis=1)


def uplift(cases, numbers):
    """ln(1 - exp(-((IM4 - 1) IM5^k/d)^n)) of (n, d, k), which goes to minus infinity at uplift."""
    n, d, k = numbers
    with np.errstate(divide="ignore"):
        power = n * (np.log(cases["im4"] - 1.0) + k * np.log(cases["im5"]) - np.log(d))
        return np.where(power < -30, power, np.log(-np.expm1(-np.exp(np.minimum(power, 5.0)))))


def magnitude(cases, line):
    """M - 6.9, held within the data; where it is unknown that of `line`: (intercept, slope, sd, low, high) of
    M on ln(PGV/PGA)."""
    intercept, slope, _, low, high = line
    known = cases.get("mw", np.full(len(cases["im4"]), np.nan))
    mean = intercept + slope * np.log(cases["im5"] / cases["im4"] / cases["p_rad_s"])
    return np.clip(np.where(np.isnan(known), mean, known), low, high) - 6.9


def scaled(cases, factor):
    """The same motions, `factor` times as strong."""
    return cases | {"im4": cases["im4"] * factor, "im5": cases["im5"] * factor}


def some(cases, which):
    return {name: values[which] for name, values in cases.items()}


class Surface:
    """What data/universal.csv holds: numbers by name (domain), kind (magnitude), kind and curve or peak."""

    def __init__(self, path):
        self.domain, self.magnitude, self.calibration, self.uplift, self.peaks = {}, {}, {}, {}, {}
        rows = {"pro": [], "pex": []}
        for line in (line for line in open(path) if not line.startswith("#")):
            what, first, *cells = line.strip().split(",")
            if what == "term":
                rows[first].append((cells[0], [float(c) for c in cells[1:]]))
            elif what in ("domain", "magnitude"):
                getattr(self, what)[first] = [float(c) for c in cells]
            else:
                getattr(self, what)[first, cells[0]] = [float(c) for c in cells[1:]]
        self.terms = {event: [term for term, _ in of] for event, of in rows.items()}
        self.coefficients = {event: np.array([b for _, b in of]) for event, of in rows.items()}

    def logit(self, event, kind, cases, limit=0.2):
        """L, before calibration."""
        b = self.coefficients[event][:, KINDS.index(kind)]
        return design(event, cases, limit, self.terms[event]) @ b

    def parts(self, event, kind, cases, limit=0.2):
        """L, M - 6.9, and what is added near uplift."""
        added = uplift(cases, self.uplift[kind, event])
        return self.logit(event, kind, cases, limit), magnitude(cases, self.magnitude[kind]), added

    def prior(self, event, kind, limit=0.1):
        """Means and sds of c, ln s and m; c at this limit state."""
        *six, _, by_limit = self.calibration[kind, event]
        return (six[0] + by_limit * features(event, NOWHERE, limit)["end"], *six[1:])

    def z(self, event, kind, cases, limit=0.2):
        """The logit as shipped."""
        logit, m, added = self.parts(event, kind, cases, limit)
        c, ln_s, of_m, *_ = self.prior(event, kind, limit)
        return c + np.exp(ln_s) * logit + of_m * m + added
