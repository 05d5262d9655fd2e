"""Holds exports against `evaluate`: python check_exports.py ROCKFRAG openquake|pelicun

OpenQuake's own reader and fragility functions give the probabilities, which must equal those of `evaluate`,
averaged over PGV/PGA, to 1e-5 at 20 levels of PGA and of PGV that any motion has, and be 0 below uplift. At
each of 8 levels pelicun draws 100,000 capacities; the shares of the damage states must equal our
probabilities within five standard errors. All this on the ground and, falling both ways, on a roof. Needs
openquake.engine or pelicun (scripts/check_exports.sh makes a place for each).
"""

import csv
import functools
import itertools
import json
import math
import pathlib
import re
import sys
import tempfile
import warnings

import numpy as np
import pandas as pd
from common import call

ALPHA, SAMPLES, UNITS = 0.20, 100_000, {"PGA": "g", "PGV": "mps"}
GROUND = [f"--structure=name=equipment,p=2.5,alpha={ALPHA},eta=0.92"]
ROOF = ["--width=0.5", "--depth=0.4", "--height=1.9", "--period=0.6", "--level=1"]
rockfrag, program = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
run = functools.partial(call, rockfrag)


def reached(place, im, intensity):
    """The probability of reaching LS1, LS2 and LS3 at this PGA (g) or PGV (m/s)."""
    (row,) = csv.DictReader(run("evaluate", *place, f"--{im}={intensity!r}", "--format=csv").splitlines())
    return [float(row[f"p_{state}"] or 0) for state in ("rocking", "failure", "overturning")]


def openquake(place, im, folder):
    """The largest difference at 20 levels and two intensities below uplift."""
    from openquake.hazardlib import nrml
    from openquake.risklib import read_nrml  # noqa: F401, registers the reader of fragility models

    file = folder / f"{im}.xml"
    run("export", *place, "--to=openquake", f"--over={im}", f"--out={file}", "--force")
    model = nrml.to_python(str(file))
    ((imt, _), functions), = model.items()
    assert imt == im.upper(), imt
    difference = 0.0
    unit, most = (1, 4.4) if im == "pga" else (100, 4.9)
    levels = np.array(re.search("<imls[^>]*>([^<]*)<", file.read_text())[1].split(), dtype=float) / unit
    levels = levels[levels < most]
    below = [0.5 * levels[0], 0.99 * levels[0]]
    for intensity in [*below, *levels[np.linspace(1, len(levels) - 1, 20).astype(int)]]:
        expected = dict(zip(["LS1", "LS2", "LS3"], reached(place, im, float(intensity))))
        for function in functions.build(model.limitStates):
            theirs = float(function(np.array([unit * intensity]))[0])
            if intensity < levels[0] and theirs != 0:
                sys.exit(f"{file.name}: {function.limit_state} is {theirs} below uplift")
            difference = max(difference, abs(theirs - expected[function.limit_state]))
    if difference > 1e-5:
        sys.exit("OpenQuake and rockfrag differ by more than 1e-5")
    return f"largest difference {difference:.1e} at 20 levels"


def theirs(table, component, peak, intensity):
    """The share of each damage state in a run of pelicun, all motions of the same intensity."""
    from pelicun import assessment, file_io

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


def pelicun(place, im, folder):
    """The largest difference in standard errors."""
    table = folder / f"{im}.csv"
    run("export", *place, "--to=pelicun", f"--over={im}", f"--out={table}", "--force")
    component = next(name for name in json.loads(table.with_suffix(".json").read_text()) if name[0] != "_")
    (row,) = csv.DictReader(table.read_text().splitlines())
    levels = [float(level) for level in row["LS2-Theta_0"].split("|")[0].split(",")]
    worst = 0.0
    for im4 in [0.9, 1.05, 1.2, 1.4, 2.0, 3.0, 4.0, 6.0]:
        # Motions have some 1 m/s for each g.
        intensity = min(levels, key=lambda level: abs(level - im4 * math.tan(ALPHA)))
        states = [1.0, *reached(place, im, intensity), 0.0]
        ours = [here - further for here, further in zip(states, states[1:])]
        shares = theirs(table, component, im.upper(), intensity)
        for state, (share, p) in enumerate(zip(shares, ours)):
            error = math.sqrt(max(p * (1 - p), 1 / SAMPLES) / SAMPLES)
            worst = max(worst, abs(share - p) / error)
            if abs(share - p) > 5 * error:
                sys.exit(f"{im}, im4 {im4}: pelicun finds {share} in damage state {state}, {p} is expected")
    return f"shares of {SAMPLES} within {worst:.1f} standard errors at 8 intensities"


warnings.simplefilter("ignore")
with tempfile.TemporaryDirectory() as scratch:
    for place, peak in itertools.product((GROUND, ROOF), UNITS):
        check = {"openquake": openquake, "pelicun": pelicun}[program]
        print(program, peak, check(place, peak.lower(), pathlib.Path(scratch)))
