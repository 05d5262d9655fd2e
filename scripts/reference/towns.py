"""Annual rates by a calibration to what fell in a town: python towns.py ROCKFRAG

Each town has its own c, ln s and m and each of its earthquakes a shift, drawn from the prior and tau. fit-pro
calibrates to its stones (outcomes.py). Prints how often the 95 % limits of evaluate hold the rates of other
objects by the numbers of the town, and the rms of ln(rate/truth); of rates without calibration first.
"""

import concurrent.futures
import itertools
import pathlib
import sys
import tempfile

import numpy as np
import pandas as pd

from outcomes import G, PRIOR, TAU, apply, call, logistic, parts, stones

CELLS, TOWNS = [(0, 0), *itertools.product((1, 3, 12), (20, 60, 200, 500))], 300
OBJECTS = pd.DataFrame({"name": ["a", "b", "c"], "width": [0.25, 0.4, 0.6], "height": [0.8, 1.4, 1.9], "eta": 0.85})


def hazard(rng, n=600):
    """n motions, whose PGA is exceeded with the power -2.2."""
    pga = G * np.minimum(0.15 * rng.random(n) ** (-1 / 2.2), 3.0)
    motions = {"pga_m_s2": pga, "pgv_m_s": pga * np.exp(rng.normal(-2.7, 0.5, n)), "mw": rng.uniform(5.6, 7.4, n)}
    return pd.DataFrame(motions).assign(annual_rate_of_occurrence=0.02 / n)


def cell(earthquakes, n, program=sys.argv[1]):
    """Of towns with so many earthquakes and stones, whether the limits hold, and ln of rate over truth."""
    rng = np.random.default_rng([earthquakes, n])
    motions, held, off = hazard(rng), [], []
    uplifting = [motions[motions.pga_m_s2 > G * width / height] for _, width, height, _ in OBJECTS.values]
    of_objects = [parts(of.assign(**OBJECTS.loc[k])) for k, of in enumerate(uplifting)]
    with tempfile.TemporaryDirectory() as name:
        at = lambda file: pathlib.Path(name) / file
        motions.to_csv(at("hazard.csv"), index=False)
        OBJECTS.to_csv(at("objects.csv"), index=False)
        question = "--structures", at("objects.csv"), "--hazard", at("hazard.csv"), "--out", at("out.csv"), "--force"
        for _ in range(TOWNS):
            b, shifts = PRIOR[:3] + PRIOR[3:] * rng.normal(size=3), TAU * rng.normal(size=earthquakes)
            if n > 0:
                town = stones(rng, n, earthquakes)
                town["fell"] = (rng.random(n) < logistic(apply(b, parts(town)) + shifts[town.earthquake])).astype(int)
                town.to_csv(at("town.csv"), index=False)
                call(program, "fit-pro", "--in", at("town.csv"), "--out", at("fits/pro.parquet"), "--force")
            call(program, "evaluate", *question, *(("--fits", at("fits")) if n > 0 else ()))
            rates = pd.read_csv(at("out.csv")).set_index("structure").loc[OBJECTS.name, "overturning_per_year":]
            true = [logistic(apply(b, z)) @ of.annual_rate_of_occurrence for z, of in zip(of_objects, uplifting)]
            held += list((rates.overturning_per_year_low < true) & (true < rates.overturning_per_year_high))
            off += list(np.log(rates.overturning_per_year / true))
    return np.mean(held), np.sqrt(np.mean(np.square(off)))


with concurrent.futures.ThreadPoolExecutor() as pool:
    for of_cell, found in zip(CELLS, pool.map(cell, *zip(*CELLS))):
        print("{} earthquakes, {} stones:".format(*of_cell), "held {:.2f}, rms {:.2f}".format(*found), flush=True)
