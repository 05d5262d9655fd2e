"""Hazards of PGA, PGV and SA(1.0 s) at sites of ground-motion models: python sites.py FOLDER

Sources around a site, a ground-motion model of OpenQuake's hazardlib and Vs30 give the joint rates of PGA, PGV and
magnitude, and the curves of PGA, PGV and SA(1.0 s). The sites `fit` give the lines of sites in general
(src/hazard/pgv_pga.rs), the sites `check`, of other sources and models, how far sites lie from them; the sites
`judge`, of yet others, judge both, and nothing is chosen by them. Writes FOLDER/sites.npz and the levels of the first
two by Vs30, and the means of all at the rate of once in 2475 years, to tests/reference/fits, and prints their lines.
Needs openquake.engine (scripts/check_exports.sh tells how).
"""

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
MAGNITUDES = np.arange(4.875, 8.2, 0.25)
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
    rows = [(m, distance, rate * s / share.sum()) for m, s in zip(mw, share)]
    rows = np.array(rows)
    if small:
        others = area(small * rate, 5.0, mean - 0.5, 0.9, max(3 * distance, 30.0), distance)
        rows = np.concatenate([rows, others])
    return rows


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


def drawn(uniform):
    """Sources that are drawn, so that nobody chose them."""
    log = lambda low, high: np.exp(uniform(np.log(low), np.log(high)))
    near = lambda: area(log(0.02, 0.15), 5.0, uniform(6.2, 6.6), uniform(0.9, 1.1), uniform(20, 35))
    wide = lambda: area(log(0.02, 0.2), 5.0, uniform(6.6, 7.1), uniform(0.85, 1.1), uniform(70, 160))
    far = lambda: fault(1 / uniform(60, 200), uniform(7.0, 7.6), uniform(50, 120), sd=0.2)
    at = lambda km: fault(1 / uniform(200, 600), uniform(6.5, 7.2), km * uniform(0.7, 1.3), small=uniform(10, 30))
    return {
        "near 1": [near()], "near 2": [near()], "5 km and area": [at(5), wide()], "5 km": [at(5)], "15 km": [at(15)],
        "far": [far(), far()], "far and area": [far(), wide()], "area": [wide()],
    }


JUDGE = drawn(np.random.default_rng(20261123).uniform)
FIT_MODELS = ["BooreEtAl2014", "BindiEtAl2014Rjb", "AkkarEtAlRjb2014", "ChiouYoungs2014"]
CHECK_MODELS = ["CampbellBozorgnia2014", "AbrahamsonEtAl2014", "LanzanoEtAl2019_RJB_OMO", "KothaEtAl2020"]
JUDGE_MODELS = ["CauzziEtAl2014", "DerrasEtAl2014", "KaleEtAl2015Turkey"]
SETS = {
    "fit": (FIT, FIT_MODELS, [270.0, 400.0, 760.0], 0.74),
    "check": (CHECK, CHECK_MODELS, [230.0, 350.0, 550.0, 900.0], 0.70),
    "judge": (JUDGE, JUDGE_MODELS, [250.0, 320.0, 500.0, 850.0], 0.733),
}


def motions(model, vs30, ruptures):
    """Means and standard deviations of ln IM, m/s2, m/s and m/s2, of each rupture: two arrays of 3 x n."""
    gsim = valid.gsim(model)
    maker = ContextMaker("*", [gsim], {"imtls": {imt: [1.0] for imt in IMTS}})
    mw, rjb, _ = ruptures.T
    ctx = maker.new_ctx(len(mw))
    ztor = np.clip(8.0 - 2.5 * (mw - 5.0), 0.5, 8.0)
    width = 10 ** (-1.01 + 0.32 * mw)
    depth = np.clip(ztor + width / 2, 5, 15)
    rrup = np.hypot(rjb, ztor)
    values = {
        "mag": mw, "rjb": rjb, "rrup": rrup, "rx": rjb, "ry0": 0.0, "rake": 0.0, "dip": 90.0, "ztor": ztor,
        "width": width, "hypo_depth": depth, "rhypo": np.hypot(rjb, depth), "repi": rjb, "vs30": vs30,
        "vs30measured": True, "z1pt0": np.exp(-7.15 / 4 * np.log((vs30**4 + 571**4) / (1360**4 + 571**4))),
        "z2pt5": np.exp(7.089 - 1.144 * np.log(vs30)), "sids": 0,
    }
    for name in ctx.dtype.names:
        if name in values:
            ctx[name] = values[name]
    mean, sd = maker.get_mean_stds([ctx])[:2, 0]
    unit = np.log([G, 0.01, G])[:, None]
    return mean + unit, sd


def bivariate(x_edges, y_edges, mean, sd, rho, rate, mw):
    """Rates of the bins of magnitude, x and y of bivariate normal variables: given x, y is normal too."""
    x = 0.5 * (x_edges[1:] + x_edges[:-1])
    in_x = np.diff(norm.cdf((x_edges[:, None] - mean[0]) / sd[0]), axis=0) * rate
    at = np.abs(MAGNITUDES[:, None] - mw).argmin(axis=0)
    bins = np.zeros((len(MAGNITUDES), len(x), len(y_edges) - 1))
    for k in range(len(x)):
        given = mean[1] + rho * sd[1] * (x[k] - mean[0]) / sd[0]
        in_y = np.diff(norm.cdf((y_edges[:, None] - given) / (sd[1] * np.sqrt(1 - rho**2))), axis=0)
        np.add.at(bins[:, k], at, (in_y * in_x[k]).T)
    return bins


def inverse(levels, rates, wanted):
    """The level that is exceeded at a rate, linear in the logarithms."""
    keep = rates > 1e-12
    return np.exp(np.interp(-np.log(wanted), -np.log(rates[keep]), np.log(levels[keep])))


def site(model, vs30, sources, rho):
    ruptures = np.concatenate(sources)
    mean, sd = motions(model, vs30, ruptures)
    rate, mw = ruptures[:, 2], ruptures[:, 0]
    exceeds = lambda k, levels: norm.sf((np.log(levels)[:, None] - mean[k]) / sd[k]) @ rate
    pga = LEVELS_G * G
    pgv = np.geomspace(0.005, 6, 40)
    curves = [exceeds(0, pga), exceeds(1, pgv), exceeds(2, pga)]
    at_2475 = inverse(pga, curves[0], 1 / 2475)
    weight = norm.sf((np.log(at_2475) - mean[0]) / sd[0]) * rate
    return {
        "joint": bivariate(LN_PGA, LN_PGV, mean, sd, rho, rate, mw),
        "pga": np.column_stack([pga, curves[0]]),
        "pgv": np.column_stack([pgv, curves[1]]),
        "sa1": np.column_stack([pga, curves[2]]),
        "mw": (weight @ mw) / weight.sum(),
    }


def all_sites():
    for name, (geometries, models, soils, rho) in SETS.items():
        for geometry, sources in geometries.items():
            for model in models:
                for vs30 in soils:
                    yield name, geometry, model, vs30, site(model, vs30, sources, rho)


def line(joints, mean_mw, vs30, peak):
    """ln(PGV/PGA) at 0.4 g or 0.4 m/s, its slope and its rise with magnitude and ln Vs30, the scatter about it, and the
    sd between sites of one magnitude, of one magnitude and Vs30."""
    x, y = (0.5 * (edges[1:] + edges[:-1]) for edges in (LN_PGA, LN_PGV))
    at, low, high = (x - np.log(0.4 * G), 0.15 * G, 1.5 * G) if peak == "pga" else (y - np.log(0.4), 0.1, 2.0)
    ratio, axis = y[None, :] - x[:, None], 1 if peak == "pga" else 0
    rows, means, variances, places = [], [], [], []
    for k, joint in enumerate(joints):
        rates = joint.sum(axis=0)
        total = rates.sum(axis=axis)
        mean = (rates * ratio).sum(axis=axis) / total
        variance = (rates * ratio**2).sum(axis=axis) / total - mean**2
        level = x if peak == "pga" else y
        for i in np.flatnonzero((np.exp(level) > low) & (np.exp(level) < high) & (total > 1e-7)):
            rows.append([1, at[i], mean_mw[k] - 6.3, np.log(vs30[k] / USUAL_VS30)])
            means.append(mean[i])
            variances.append(variance[i])
            places.append(k)
    rows, means, places = (np.array(of_all) for of_all in (rows, means, places))
    between = []
    for columns in (rows[:, :3], rows):
        b = np.linalg.lstsq(columns, means, rcond=None)[0]
        off = means - columns @ b
        between.append(np.std([off[places == k].mean() for k in set(places)]))
    return [*b, np.sqrt(np.mean(variances)), *between]


def levels(joints, mean_mw, vs30):
    """Mean magnitude and mean ln(PGV/PGA) at 0.4 g of the sites of each Vs30."""
    x, y = (0.5 * (edges[1:] + edges[:-1]) for edges in (LN_PGA, LN_PGV))
    at = np.abs(x - np.log(0.4 * G)).argmin()
    given_pga = joints.sum(axis=1)[:, at]
    of_site = given_pga @ y / given_pga.sum(axis=1) - x[at]
    return [(v, mean_mw[vs30 == v].mean(), of_site[vs30 == v].mean()) for v in np.unique(vs30)]


def at_rate(curves, rate):
    """ln of the level of each site that is exceeded at a rate."""
    return np.array([np.log(inverse(curve[:, 0], curve[:, 1], rate)) for curve in curves])


def by_spectrum(data, among):
    """PGV by SA(1.0 s), PGA and magnitude, at equal rates: the factor, the exponent of PGA, the rise with magnitude,
    and the sd between sites, with and without magnitude."""
    rows, off = [], []
    for rate in np.geomspace(2e-3, 1e-5, 12):
        pga, pgv, sa = (at_rate(data[name], rate)[among] for name in ("pga", "pgv", "sa1"))
        rows.append(np.column_stack([np.ones(len(pga)), pga - sa, data["mw"][among] - 6.3]))
        off.append(pgv - sa)
    rows, off = np.array(rows), np.array(off)
    b = np.linalg.lstsq(rows.reshape(-1, 3), off.ravel(), rcond=None)[0]
    sds = [(off - rows[..., :n] @ b[:n]).mean(axis=0).std() for n in (3, 2)]
    return [np.exp(b[0]), *b[1:], *sds]


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    names, data = [], {"joint": [], "pga": [], "pgv": [], "sa1": [], "mw": []}
    for name, geometry, model, vs30, made in all_sites():
        names.append((name, geometry, model, str(vs30)))
        for key, value in made.items():
            data[key].append(value)
        print(name, geometry, model, vs30, round(float(made["mw"]), 2), flush=True)
    data = {name: np.array(of_sites) for name, of_sites in data.items()}
    np.savez_compressed(folder / "sites.npz", names=np.array(names), **data)
    kinds, joints, mean_mw = np.array(names)[:, 0], data["joint"], data["mw"]
    vs30 = np.array(names)[:, 3].astype(float)
    chosen = kinds != "judge"
    for kind, among in {"fit": kinds == "fit", "check": kinds == "check", "both": chosen}.items():
        for peak in ("pga", "pgv"):
            found = line(joints[among], mean_mw[among], vs30[among], peak)
            print(kind, peak, "level, slope, per magnitude, per ln Vs30, scatter, sd between sites, of one Vs30:",
                  *np.round(found, 2))
        print(kind, "PGV by SA(1.0 s): factor, exponent of PGA, per magnitude, sd between sites with and without it:",
              *np.round(by_spectrum(data, among), 3))
    reference = pathlib.Path(__file__).resolve().parents[2] / "tests/reference/fits"
    rows = levels(joints[chosen], mean_mw[chosen], vs30[chosen])
    (reference / "site_levels.csv").write_text(
        "vs30,mw,ln_ratio\n" + "".join(f"{v:.0f},{m:.3f},{level:.4f}\n" for v, m, level in rows))
    peaks = [at_rate(data[name], 1 / 2475) for name in ("pga", "sa1", "pgv")]
    means = [[column[kinds == kind].mean() for column in (mean_mw, *peaks)] for kind in SETS]
    (reference / "site_spectra.csv").write_text(
        "mw,pga_m_s2,sa_1s_m_s2,pgv_m_s\n"
        + "".join(f"{m:.3f},{np.exp(a):.4f},{np.exp(s):.4f},{np.exp(v):.5f}\n" for m, a, s, v in means))
