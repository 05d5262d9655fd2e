"""Hazards of PGA, PGV and SA(1.0 s) at sites of ground-motion models: python sites.py FOLDER

Sources around a site, a ground-motion model of OpenQuake's hazardlib and Vs30 give the joint rates of PGA,
PGV and magnitude, and the curves. The sites `fit` give the lines of sites in general
(core/src/hazard/pgv_pga.rs), `check` how far sites lie from them; `judge` judge both; `magnitude` tell which
magnitude is to be given. Writes FOLDER/sites.npz and, to core/tests/reference/fits, the levels of the first
two by Vs30 and the means of the first three once in 2475 years, and prints the lines. Needs openquake.engine
(scripts/check_exports.sh tells how).
"""

import itertools
import pathlib
import sys

import numpy as np
from openquake.hazardlib import valid
from openquake.hazardlib.contexts import ContextMaker
from scipy.stats import norm

G = 9.81
IMTS = ["PGA", "PGV", "SA(1.0)"]
# Edges of bins, ln of m/s2 and m/s.
LN_PGA = np.log(0.02 * G) + 0.1 * np.arange(54)
LN_PGV = np.log(0.003) + 0.1 * np.arange(77)
# Their middles.
X, Y = (0.5 * (edges[1:] + edges[:-1]) for edges in (LN_PGA, LN_PGV))
MAGNITUDES = np.arange(4.875, 9.2, 0.25)
LEVELS_G = np.geomspace(0.01, 4, 40)
# Geometric mean of the sites, m/s.
USUAL_VS30 = 440.0


def area(rate, least, most, b, farthest, nearest=0.0):
    """Magnitudes (Gutenberg-Richter, truncated) and epicentres spread evenly over a ring: (mw, rjb km, rate)."""
    mw = np.arange(least + 0.05, most, 0.1)
    share = 10 ** (-b * mw)
    share /= share.sum()
    edges = np.linspace(nearest, farthest, 31)
    of_ring = np.diff(edges**2) / (farthest**2 - nearest**2)
    middle = np.sqrt((edges[1:] ** 2 + edges[:-1] ** 2) / 2)
    # Half of the rupture's length points towards the site in the mean.
    rjb = np.maximum(middle[None, :] - 0.3 * 10 ** (-2.57 + 0.62 * mw)[:, None], 0)
    return np.column_stack([np.repeat(mw, 30), rjb.ravel(), (rate * share[:, None] * of_ring).ravel()])


def fault(rate, mean, distance, sd=0.15, small=0.0):
    """A fault with characteristic earthquakes, and `small` times as many of M 5 to its largest but .5 along it."""
    mw = mean + sd * np.linspace(-2, 2, 9)
    share = norm.pdf(np.linspace(-2, 2, 9))
    rows = np.column_stack([mw, np.full(9, distance), rate * share / share.sum()])
    if not small:
        return rows
    return np.concatenate([rows, area(small * rate, 5.0, mean - 0.5, 0.9, max(3 * distance, 30.0), distance)])


FIT = {
    "small and near": [area(0.05, 5.0, 6.5, 1.0, 30)],
    "fault at 5 km": [fault(1 / 300, 6.8, 5, small=20), area(0.03, 5.0, 6.5, 1.0, 60)],
    "fault at 15 km": [fault(1 / 200, 7.1, 15, small=30)],
    "great and far": [fault(1 / 60, 7.3, 70, sd=0.2), fault(1 / 100, 7.5, 110)],
    "area": [area(0.15, 5.0, 7.0, 1.0, 100)],
    "quiet area": [area(0.03, 5.0, 6.8, 0.9, 150)],
}
CHECK = {
    "Apennines": [area(0.08, 4.8, 6.6, 1.05, 40), fault(1 / 800, 6.7, 8)],
    "two faults": [fault(1 / 150, 7.6, 25, small=10), fault(1 / 700, 6.5, 3, small=15)],
    "Anatolia": [fault(1 / 250, 7.4, 10, small=8), area(0.05, 5.0, 6.8, 0.95, 80)],
    "far fault, quiet area": [fault(1 / 120, 7.7, 60), area(0.02, 5.0, 6.5, 1.0, 80)],
    "swarm": [area(0.2, 4.9, 6.0, 1.1, 25)],
    "craton": [area(0.01, 5.0, 7.2, 0.85, 200)],
}


def drawn(seed):
    """Functions that draw sources, so that nobody chose them: near, wide, far, and at a distance."""
    uniform = np.random.default_rng(seed).uniform
    log = lambda low, high: np.exp(uniform(np.log(low), np.log(high)))
    near = lambda: area(log(0.02, 0.15), 5.0, uniform(6.2, 6.6), uniform(0.9, 1.1), uniform(20, 35))
    wide = lambda: area(log(0.02, 0.2), 5.0, uniform(6.6, 7.1), uniform(0.85, 1.1), uniform(70, 160))
    far = lambda: fault(1 / uniform(60, 200), uniform(7.0, 7.6), uniform(50, 120), sd=0.2)
    at = lambda km: fault(1 / uniform(200, 600), uniform(6.5, 7.2), km * uniform(0.7, 1.3), small=uniform(10, 30))
    return near, wide, far, at


near, wide, far, at = drawn(20261123)
JUDGE = {
    "near 1": [near()], "near 2": [near()], "5 km and area": [at(5), wide()], "5 km": [at(5)], "15 km": [at(15)],
    "far": [far(), far()], "far and area": [far(), wide()], "area": [wide()],
}
near, wide, far, at = drawn(56)
OF_MAGNITUDE = {f"area {k}": [wide()] for k in range(6)} | {
    "near 1": [near()], "near 2": [near()], "5 km": [at(5)], "12 km and area": [at(12), wide()], "far": [far()],
    "far and area": [far(), wide()],
}
FIT_MODELS = ["BooreEtAl2014", "BindiEtAl2014Rjb", "AkkarEtAlRjb2014", "ChiouYoungs2014"]
CHECK_MODELS = ["CampbellBozorgnia2014", "AbrahamsonEtAl2014", "LanzanoEtAl2019_RJB_OMO", "KothaEtAl2020"]
JUDGE_MODELS = ["CauzziEtAl2014", "DerrasEtAl2014", "KaleEtAl2015Turkey"]
OF_MAGNITUDE_MODELS = ["CauzziEtAl2014", "ChiouYoungs2014", "CampbellBozorgnia2014"]
pairs = itertools.product
# Sources, models with Vs30, and the correlation of ln PGA and ln PGV.
SETS = {
    "fit": (FIT, pairs(FIT_MODELS, [270.0, 400.0, 760.0]), 0.74),
    "check": (CHECK, pairs(CHECK_MODELS, [230.0, 350.0, 550.0, 900.0]), 0.70),
    "judge": (JUDGE, pairs(JUDGE_MODELS, [250.0, 320.0, 500.0, 850.0]), 0.733),
    "magnitude": (OF_MAGNITUDE, zip(OF_MAGNITUDE_MODELS, [270.0, 440.0, 760.0]), 0.73),
}


def motions(model, vs30, ruptures, top=None):
    """Means and sds of ln IM of each rupture: 3 x n each. `top`: depth of its edge, km, if not crustal."""
    gsim = valid.gsim(model)
    maker = ContextMaker("*", [gsim], {"imtls": {imt: [1.0] for imt in IMTS}})
    mw, rjb, _ = ruptures.T
    ctx = maker.new_ctx(len(mw))
    ztor = np.clip(8.0 - 2.5 * (mw - 5.0), 0.5, 8.0) if top is None else np.full(len(mw), top)
    width = 10 ** (-1.01 + 0.32 * mw)
    depth = np.clip(ztor + width / 2, 5, 15) if top is None else ztor + 5
    rrup = np.hypot(rjb, ztor)
    values = {
        "mag": mw, "rjb": rjb, "rrup": rrup, "rx": rjb, "ry0": 0.0, "rake": 0.0, "dip": 90.0, "ztor": ztor,
        "width": width, "hypo_depth": depth, "rhypo": np.hypot(rjb, depth), "repi": rjb, "vs30": vs30,
        "vs30measured": True, "z1pt0": np.exp(-7.15 / 4 * np.log((vs30**4 + 571**4) / (1360**4 + 571**4))),
        "z2pt5": np.exp(7.089 - 1.144 * np.log(vs30)), "backarc": False, "sids": 0,
    }
    for name in values.keys() & set(ctx.dtype.names):
        ctx[name] = values[name]
    mean, sd = maker.get_mean_stds([ctx])[:2, 0]
    return mean + np.log([G, 0.01, G])[:, None], sd


def bivariate(mean, sd, rho, rate, mw):
    """Rates of the bins of magnitude, ln PGA and ln PGV, bivariate normal: given PGA, PGV is normal too."""
    in_x = np.diff(norm.cdf((LN_PGA[:, None] - mean[0]) / sd[0]), axis=0) * rate
    at = np.abs(MAGNITUDES[:, None] - mw).argmin(axis=0)
    bins = np.zeros((len(MAGNITUDES), len(X), len(Y)))
    for k, x in enumerate(X):
        given = mean[1] + rho * sd[1] * (x - mean[0]) / sd[0]
        in_y = np.diff(norm.cdf((LN_PGV[:, None] - given) / (sd[1] * np.sqrt(1 - rho**2))), axis=0)
        np.add.at(bins[:, k], at, (in_y * in_x[k]).T)
    return bins


def inverse(levels, rates, wanted):
    """The level that is exceeded at a rate, linear in the logarithms."""
    keep = rates > 1e-12
    return np.exp(np.interp(-np.log(wanted), -np.log(rates[keep]), np.log(levels[keep])))


def site(ruptures, mean, sd, rho):
    """Curves, mean magnitudes of the disaggregations of PGA and SA(1.0 s) at 2475 years, and joint rates."""
    (mw, _, rate), made = ruptures.T, {"joint": bivariate(mean, sd, rho, ruptures[:, 2], ruptures[:, 0])}
    accelerations, velocities = LEVELS_G * G, np.geomspace(0.005, 6, 40)
    for k, (name, levels) in enumerate([("pga", accelerations), ("pgv", velocities), ("sa", accelerations)]):
        exceeds = lambda level: norm.sf((np.log(level) - mean[k]) / sd[k])
        rates = exceeds(levels[:, None]) @ rate
        made[name] = np.column_stack([levels, rates])
        made[f"mw_{name}"] = np.average(mw, weights=exceeds(inverse(levels, rates, 1 / 2475)) * rate)
    return made


def line(joints, mean_mw, vs30, peak):
    """ln(PGV/PGA) at 0.4 g or 0.4 m/s, slope, rise with magnitude and ln Vs30, scatter, sds between sites."""
    of_peak = {"pga": (X, 0.4 * G, 0.15 * G, 1.5 * G, 2), "pgv": (Y, 0.4, 0.1, 2.0, 1)}
    level, middle, low, high, axis = of_peak[peak]
    rates, ratio = joints.sum(axis=1), Y - X[:, None]
    with np.errstate(invalid="ignore"):
        total = rates.sum(axis=axis)
        mean = (rates * ratio).sum(axis=axis) / total
        variance = (rates * ratio**2).sum(axis=axis) / total - mean**2
    kept = (np.exp(level) > low) & (np.exp(level) < high) & (total > 1e-7)
    of_site, bins = np.nonzero(kept)
    columns = level[bins] - np.log(middle), mean_mw[of_site] - 6.3, np.log(vs30[of_site] / USUAL_VS30)
    rows = np.column_stack([np.ones(len(bins)), *columns])
    between = []
    for columns in (rows[:, :3], rows):
        b = np.linalg.lstsq(columns, mean[kept], rcond=None)[0]
        off = mean[kept] - columns @ b
        between.append(np.std([off[of_site == k].mean() for k in set(of_site)]))
    return [*b, np.sqrt(variance[kept].mean()), *between]


def levels(joints, mean_mw, vs30):
    """Mean magnitude and mean ln(PGV/PGA) at 0.4 g of the sites of each Vs30."""
    at = np.abs(X - np.log(0.4 * G)).argmin()
    given_pga = joints.sum(axis=1)[:, at]
    of_site = given_pga @ Y / given_pga.sum(axis=1) - X[at]
    return [(v, mean_mw[vs30 == v].mean(), of_site[vs30 == v].mean()) for v in np.unique(vs30)]


def at_rate(curves, rate):
    """ln of the level of each site that is exceeded at a rate."""
    return np.array([np.log(inverse(*curve.T, rate)) for curve in curves])


def by_spectrum(data, among):
    """PGV by SA(1.0 s), PGA and magnitude, at equal rates."""
    rows, off = [], []
    for rate in np.geomspace(2e-3, 1e-5, 12):
        pga, pgv, sa = (at_rate(data[name], rate)[among] for name in ("pga", "pgv", "sa"))
        rows.append(np.column_stack([np.ones(len(pga)), pga - sa, data["mw_pga"][among] - 6.3]))
        off.append(pgv - sa)
    rows, off = np.array(rows), np.array(off)
    b = np.linalg.lstsq(rows.reshape(-1, 3), off.ravel(), rcond=None)[0]
    sds = [(off - rows[..., :n] @ b[:n]).mean(axis=0).std() for n in (3, 2)]
    return [np.exp(b[0]), *b[1:], *sds]


def save(folder, sites):
    """Writes sites.npz of sites, each (names, ruptures, means, standard deviations, correlation): names and data."""
    names, made = zip(*((names, site(*of_site)) for names, *of_site in sites))
    data = {name: np.array([of_site[name] for of_site in made]) for name in made[0]}
    np.savez_compressed(folder / "sites.npz", names=np.array(names), **data)
    return np.array(names), data


def of_sets():
    for kind, (geometries, models, rho) in SETS.items():
        for (geometry, sources), (model, vs30) in itertools.product(geometries.items(), models):
            ruptures = np.concatenate(sources)
            yield (kind, geometry, model, str(vs30)), ruptures, *motions(model, vs30, ruptures), rho


if __name__ == "__main__":
    folder, reference = pathlib.Path(sys.argv[1]), pathlib.Path(__file__).parents[2] / "core/tests/reference/fits"
    names, data = save(folder, of_sets())
    kinds, vs30 = names[:, 0], names[:, 3].astype(float)
    joints, mean_mw, chosen = data["joint"], data["mw_pga"], (kinds == "fit") | (kinds == "check")
    print("lines: level, slope, per magnitude, per ln Vs30, scatter, sd between sites, of one Vs30")
    print("PGV by SA(1.0 s): factor, exponent of PGA, per magnitude, sd between sites with and without it")
    for kind, among in {"fit": kinds == "fit", "check": kinds == "check", "both": chosen}.items():
        for peak in ("pga", "pgv"):
            print(kind, peak, *np.round(line(joints[among], mean_mw[among], vs30[among], peak), 2))
        print(kind, "PGV by SA(1.0 s)", *np.round(by_spectrum(data, among), 3))
    write = lambda name, of, form, names: np.savetxt(reference / name, of, form, header=names, comments="")
    of_vs30 = levels(joints[chosen], mean_mw[chosen], vs30[chosen])
    write("site_levels.csv", of_vs30, "%.0f,%.3f,%.4f", "vs30,mw,ln_ratio")
    columns = np.stack([mean_mw, *(at_rate(data[name], 1 / 2475) for name in ("pga", "sa", "pgv"))])
    means = np.array([columns[:, kinds == kind].mean(axis=1) for kind in ("fit", "check", "judge")])
    means[:, 1:] = np.exp(means[:, 1:])
    write("site_spectra.csv", means, "%.3f,%.4f,%.4f,%.5f", "mw,pga_m_s2,sa_1s_m_s2,pgv_m_s")
