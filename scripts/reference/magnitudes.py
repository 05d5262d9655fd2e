"""The magnitude that evaluate should be told at a site: python magnitudes.py FOLDER ROCKFRAG

36 sites of twelve geometries that are drawn, three ground-motion models and Vs30 of 270, 440 or 760 m/s (sites.py).
By geometry: how far the mean magnitude of the motions that overturn the objects of site_rates.py lies above the mean
of the disaggregation of PGA, and of SA(1.0 s). By route: geometric mean and rms of ln of rate over truth. Half an
hour on one core. Needs openquake.engine, as sites.py does.
"""

import itertools
import pathlib
import sys

import numpy as np
import pandas as pd

import sites as S

MODELS, SOILS = ["CauzziEtAl2014", "ChiouYoungs2014", "CampbellBozorgnia2014"], [270.0, 440.0, 760.0]
ROUTES = {"PGA": "PGA, M", "PGA + SA": "PGA, SA, M", "PGA + PGV": "PGA, PGV, M", "PGV": "PGV, M"}


def drawn(uniform):
    log = lambda low, high: np.exp(uniform(np.log(low), np.log(high)))
    wide = lambda: S.area(log(0.01, 0.2), 5.0, uniform(6.6, 7.3), uniform(0.85, 1.1), uniform(70, 200))
    near = lambda: S.area(log(0.02, 0.15), 5.0, uniform(6.2, 6.6), uniform(0.9, 1.1), uniform(20, 35))
    at = lambda km: S.fault(1 / uniform(200, 600), uniform(6.5, 7.3), km * uniform(0.7, 1.3), small=uniform(10, 30))
    far = lambda: S.fault(1 / uniform(60, 200), uniform(7.0, 7.6), uniform(50, 120), sd=0.2)
    geometries = {f"area {k}": [wide()] for k in range(6)} | {f"near {k}": [near()] for k in range(2)}
    return geometries | {"5 km": [at(5)], "12 km and area": [at(12), wide()], "far": [far()], "far and area": [far(), wide()]}


def make(folder):
    rng = np.random.default_rng(56)
    geometries = itertools.product(drawn(rng.uniform).items(), MODELS)
    chosen = [(name, sources, model, SOILS[rng.integers(3)]) for (name, sources), model in geometries]
    made = [S.site(model, vs30, sources, 0.73) for _, sources, model, vs30 in chosen]
    names = [("own", name, model, str(vs30)) for name, _, model, vs30 in chosen]
    data = {name: np.array([of_site[name] for of_site in made]) for name in made[0]}
    np.savez_compressed(folder / "sites.npz", names=np.array(names), **data)


def judged():
    import site_rates as R

    R.write_objects()
    truths = {name: R.Truth(*size) for name, size in R.OBJECTS.items()}
    of_pga, of_sa = R.data["mw"], R.data["mw_sa"]
    for k, (_, geometry, *_) in enumerate(R.names):
        R.write(k)
        kind = geometry.rstrip(" 0123456789") or geometry
        true = {name: truth.rate(R.joint[k]) for name, truth in truths.items()}
        for name, truth in truths.items():
            alone = lambda j: truth.rate(np.where(np.arange(len(S.MAGNITUDES))[:, None, None] == j, R.joint[k], 0))
            rates = np.array([alone(j) for j in range(len(S.MAGNITUDES))])
            mw = rates @ S.MAGNITUDES / rates.sum()
            yield from ((kind, f"M above that of {of}", mw - mean[k]) for of, mean in (("PGA", of_pga), ("SA", of_sa)))
        for label, route in ROUTES.items():
            for of, mean in (("PGA", of_pga), ("SA", of_sa)):
                R.mean_mw = mean
                for name, row in R.answers(k, route).items():
                    value = row["overturning_per_year"]
                    if value is not None and true[name] > 1e-9:
                        yield kind, f"{label}, M of {of}", np.log(value / true[name])


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    make(folder)
    found = pd.DataFrame(judged(), columns=["sites", "what", "off"])
    found = pd.concat([found, found.assign(sites="all")])
    off = found.groupby(["what", "sites"], sort=False).off
    table = {"n": off.size(), "mean": off.mean(), "geometric mean": np.exp(off.mean())}
    table["rms"] = off.apply(lambda of: np.sqrt(np.mean(of**2)))
    print(pd.DataFrame(table).round(3).to_string())
