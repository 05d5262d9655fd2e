"""The universal surface: the logits of P_ro and P_ex as sums of products of features (defined in
data/universal.csv)."""

import numpy as np

KINDS = ("csgm", "pulse", "hfc")
LIMITS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5)
BOTH = ["1", "x", "w", "x^2", "eta", "p", "x*p", "x*eta", "x*r^2", "w^3"]
TERMS = {"pro": [*BOTH, "r^2", "r^3"], "pex": [*BOTH, "limit", "x*w", "x^2*r", "eta*p"]}


def features(event, cases, limit):
    limit, ln_im4 = np.log(limit / 0.2) if event == "pex" else 0.0, np.log(cases["im4"])
    return {
        "x": np.log(ln_im4 + 0.2), "w": np.log(cases["im5"]) - 0.4 * limit, "r": np.log(cases["im3"]),
        "eta": (cases["eta"] - 0.85) / 0.1, "p": np.log(cases["p_rad_s"] / 2.0), "limit": limit,
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


def scaled(cases, factor):
    """The same motions, `factor` times as strong."""
    return cases | {"im4": cases["im4"] * factor, "im5": cases["im5"] * factor}


def some(cases, which):
    return {name: values[which] for name, values in cases.items()}


class Surface:
    """What data/universal.csv holds: numbers by name (domain), by kind and curve or peak (calibration,
    peaks)."""

    def __init__(self, path):
        self.domain, self.calibration, self.peaks, rows = {}, {}, {}, {"pro": [], "pex": []}
        for line in (line for line in open(path) if not line.startswith("#")):
            what, first, *cells = line.strip().split(",")
            if what == "term":
                rows[first].append((cells[0], [float(c) for c in cells[1:]]))
            elif what == "domain":
                self.domain[first] = [float(c) for c in cells]
            else:
                getattr(self, what)[first, cells[0]] = [float(c) for c in cells[1:]]
        self.terms = {event: [term for term, _ in of] for event, of in rows.items()}
        self.coefficients = {event: np.array([b for _, b in of]) for event, of in rows.items()}

    def logit(self, event, kind, cases, limit=0.2):
        """Before calibration: recorded motions have the coefficients of hfc."""
        b = self.coefficients[event][:, KINDS.index("hfc" if kind == "recorded" else kind)]
        return design(event, cases, limit, self.terms[event]) @ b
