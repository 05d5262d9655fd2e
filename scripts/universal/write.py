"""The files that the program embeds, and answers that its tests compare with."""

import numpy as np

import cases as of
import surface

HEAD = """\
# The universal fragility surface: P_ro and P_ex of every rocking structure. Made by `make universal`; docs/universal.md tells how.
# From {structures} structures, {cells} cells of magnitude and distance and {motions} motions: {cases} responses that rock.
# A probability is 1/(1 + exp(-index)); the index is a sum of coefficients, each times a product of one function of each coordinate.
# Coordinates: ln(ln IM4 + 0.05), ln IM3, (eta - 0.85)/0.1, ln(alpha/0.15), ln(p/2), ln(limit/0.2), 1 for pulses alone, 1 for high
# frequencies alone. Functions: 0 is 1, 1 the coordinate itself, from 2 on restricted cubic splines over its knots.
# domain: name, least, largest. knots: coordinate, knots. spread: curve, standard deviation between
# structures at one magnitude and distance, and over many.
# peaks: kind of motion and peak, ln(PGV/PGA) given its logarithm: three knots, coefficients of 1, the logarithm and its natural spline,
# standard deviation.
# term: curve, function of each coordinate, coefficient, its deviations in {replicates} fits to resampled structures and cells.
"""


def surface_file(path, curves, deviations, cases, spreads):
    im5 = cases["im4"] / cases["im3"]
    range_of = lambda v: [float(f"{q:.4g}") for q in np.quantile(v, [0.001, 0.999])]
    with open(path, "w") as file:
        count = lambda name: len(np.unique(cases[name]))
        file.write(HEAD.format(structures=count("structure"), cells=count("cell"), motions=count("motion_id"),
                               cases=len(cases["im4"]), replicates=len(deviations)))  # fmt: skip
        for name, bounds in {
            "im4": [1.0, range_of(cases["im4"])[1]], "im3": range_of(cases["im3"]), "im5": range_of(im5), "eta": [0.7, 0.999],
            "alpha": [0.04, 0.5], "p": [0.4, 8.0], "limit": [0.02, 0.5],
        }.items():  # fmt: skip
            file.write(f"domain,{name},{bounds[0]},{bounds[1]}\n")
        for name, knots in zip(surface.COORDINATES, curves[0].knots):
            file.write(",".join(["knots", name, *map(str, knots)]) + "\n")
        for event, (one, many) in zip(("pro", "pex"), spreads):
            file.write(f"spread,{event},{one},{many}\n")
        for k, (event, curve) in enumerate(zip(("pro", "pex"), curves)):
            for i, (term, b) in enumerate(zip(curve.terms, curve.coefficients)):
                each = [f"{pair[k][i]:.4g}" for pair in deviations]
                file.write(",".join(["term", event, *map(str, term), f"{b:.9g}", *each]) + "\n")


def read(path):
    curves, knots, spreads, domain = {"pro": [], "pex": []}, [], {}, {}
    for line in open(path):
        cells = line.strip().split(",")
        if cells[0] == "knots":
            knots.append([float(c) for c in cells[2:]])
        elif cells[0] == "spread":
            spreads[cells[1]] = float(cells[2])
        elif cells[0] == "domain":
            domain[cells[1]] = [float(c) for c in cells[2:]]
        elif cells[0] == "term":
            curves[cells[1]].append(([int(c) for c in cells[2:10]], np.array([float(c) for c in cells[10:]])))
    return curves, knots, spreads, domain


def answers_file(path, source, n=200):
    """Probabilities at points all over the domain, by this reading of the file."""
    curves, knots, spreads, domain = read(source)
    rng = np.random.default_rng(11)
    rows = []
    while len(rows) < n:
        p, alpha = np.exp(rng.uniform(np.log([0.4, 0.04]), np.log([8, 0.5])))
        eta, limit = rng.uniform(0.7, 0.999), np.exp(rng.uniform(np.log(0.02), np.log(0.5)))
        im4, im3 = np.exp(rng.uniform(0, np.log(domain["im4"][1]))), np.exp(rng.uniform(*np.log(domain["im3"])))
        pga = im4 * 9.81 * np.tan(alpha)
        rows.append((p, alpha, eta, limit, len(rows) % 3, pga, pga / (p * im3)))
    p, alpha, eta, limit, kind, pga, pgv = map(np.array, zip(*rows))
    im4, im3 = pga / (9.81 * np.tan(alpha)), pga / (p * pgv)
    columns = surface.coordinates(im4, im3, eta, alpha, p, limit, 1.0 * (kind == 0), 1.0 * (kind == 2))
    out = []
    for event in ("pro", "pex"):
        terms, values = zip(*curves[event])
        design = surface.Curve(terms, knots).design(columns)
        values = np.array(values)
        deviations = design @ values[:, 1:]
        out += [design @ values[:, 0], np.sqrt((deviations**2).mean(axis=1) + spreads[event] ** 2)]
    np.savetxt(path, np.column_stack([p, alpha, eta, limit, kind, pga, pgv, *out]), delimiter=",", comments="", fmt="%.12g",
               header="p_rad_s,alpha_rad,eta,limit,kind,pga_m_s2,pgv_m_s,ro_index,ro_standard_error,ex_index,ex_standard_error")  # fmt: skip
