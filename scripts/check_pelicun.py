"""Runs pelicun on an export and holds its damage states against `evaluate`: python check_pelicun.py ROCKFRAG

ROCKFRAG is the binary. At each of 8 levels, of PGA and of PGV, pelicun draws 100,000 capacities; the shares of the
damage states must equal our probabilities within five standard errors of such a sample.
Needs pelicun (scripts/check_exports.sh makes a place for it).
"""

import csv
import json
import math
import pathlib
import sys
import tempfile
import warnings

import pandas as pd
from pelicun import assessment, file_io

from exports import ALPHA, reached, run

warnings.simplefilter("ignore")

SAMPLES = 100_000
UNITS = {"PGA": "g", "PGV": "mps"}


def ours(im, intensity):
    """The share of each damage state, from the probabilities of reaching the limit states."""
    states = [1.0, *reached(im, intensity), 0.0]
    return [here - further for here, further in zip(states, states[1:])]


def theirs(table, component, peak, intensity):
    """The share of each damage state in a run of pelicun, all motions of the same intensity."""
    run_ = assessment.Assessment({"PrintLog": False, "Seed": 42})
    place = pd.MultiIndex.from_tuples([(peak, "1", "1")])
    demand = {"Theta_0": [intensity], "Family": ["deterministic"], "Units": [UNITS[peak]]}
    run_.demand.load_model({"marginals": pd.DataFrame(demand, index=place)})
    run_.demand.generate_sample({"SampleSize": SAMPLES})
    run_.stories = 1
    quantity = {"Units": ["ea"], "Location": ["1"], "Direction": ["1"], "Theta_0": [1], "Blocks": [1]}
    run_.asset.load_cmp_model({"marginals": pd.DataFrame(quantity, index=[component])})
    run_.asset.generate_cmp_sample(SAMPLES)
    parameters = file_io.load_data(str(table), reindex=False, unit_conversion_factors=run_.unit_conversion_factors)
    run_.damage.load_model_parameters([parameters], {component})
    run_.damage.calculate()
    shares = run_.damage.ds_model.probabilities().iloc[0]
    return [float(shares.get(str(state), shares.get(state, 0.0))) for state in range(4)]


with tempfile.TemporaryDirectory() as folder:
    for im in ["pga", "pgv"]:
        table = pathlib.Path(folder) / f"{im}.csv"
        run("export", "--to=pelicun", f"--over={im}", f"--out={table}")
        component, = (name for name in json.loads(table.with_suffix(".json").read_text()) if not name.startswith("_"))
        (row,) = csv.DictReader(table.read_text().splitlines())
        levels = [float(level) for level in row["LS2-Theta_0"].split("|")[0].split(",")]
        worst = 0.0
        for im4 in [0.9, 1.05, 1.2, 1.4, 2.0, 3.0, 4.0, 6.0]:
            # Motions have some 1 m/s for each g.
            intensity = min(levels, key=lambda level: abs(level - im4 * math.tan(ALPHA)))
            shares = theirs(table, component, im.upper(), intensity)
            for state, (share, p) in enumerate(zip(shares, ours(im, intensity))):
                error = math.sqrt(max(p * (1 - p), 1 / SAMPLES) / SAMPLES)
                worst = max(worst, abs(share - p) / error)
                if abs(share - p) > 5 * error:
                    sys.exit(f"{im}, im4 {im4}: pelicun finds {share} in damage state {state}, {p} is expected")
        print(f"pelicun {im}: shares of {SAMPLES} within {worst:.1f} standard errors at 8 intensities")
