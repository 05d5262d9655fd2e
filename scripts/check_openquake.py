"""Holds exports for OpenQuake against `evaluate`: python check_openquake.py ROCKFRAG OUT

ROCKFRAG is the binary and OUT the folder of a run. OpenQuake's own reader takes the NRML, its own fragility functions give
the probabilities, and these must equal those of `evaluate` to 1e-6 at 20 intensities, of PGA and of PGV, discrete and
continuous, and be exactly 0 below uplift. Needs openquake.engine (scripts/check_exports.sh makes a place for it).
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from openquake.hazardlib import nrml
from openquake.risklib import read_nrml  # noqa: F401, registers the reader of fragility models

G = 9.81
P, ALPHA = 2.5, 0.20
STATES = {"LS1": "p_nr", "LS2": "p_f", "LS3": "p_ro"}

rockfrag, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
fits = [
    f"--pex={out / 'pex.parquet'}", f"--pro={out / 'pro.parquet'}", "--suite=csgm", "--structure=electrical-equipment",
    f"--p={P}", f"--alpha={ALPHA}",
]  # fmt: skip


def run(*arguments):
    return subprocess.run([rockfrag, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def ours(pga_g, pgv):
    """The probability of each limit state, as `evaluate` has it."""
    rows = csv.DictReader(run("evaluate", *fits, f"--pga={pga_g!r}", f"--pgv={pgv!r}", "--format=csv").splitlines())
    answer = {row["quantity"]: float(row["value"] or 0) for row in rows}
    return {state: 1 - answer[name] if state == "LS1" else answer[name] for state, name in STATES.items()}


def worst(to, im, ratio, folder):
    """The largest difference at 20 intensities, in steps equal in logarithm, of which some lie below uplift."""
    file = folder / f"{to}_{im}_{ratio}.xml"
    run("export", *fits, f"--to={to}", f"--im={im}", f"--ratio={ratio}", f"--out={file}")
    model = nrml.to_python(str(file))
    ((imt, _), functions), = model.items()
    assert imt == im.upper(), imt
    largest = 7 * math.tan(ALPHA)
    difference = 0.0
    for pga_g in np.geomspace(0.5 * math.tan(ALPHA), largest, 20):
        pgv = ratio * pga_g * G / P
        iml = np.array([pga_g if im == "pga" else 100 * pgv])
        expected = ours(float(pga_g), float(pgv))
        for function in functions.build(model.limitStates):
            theirs = float(function(iml)[0])
            if pga_g < math.tan(ALPHA) and theirs != 0:
                sys.exit(f"{file.name}: {function.limit_state} is {theirs} below uplift")
            difference = max(difference, abs(theirs - expected[function.limit_state]))
    return difference


with tempfile.TemporaryDirectory() as folder:
    for to in ["openquake", "openquake-continuous"]:
        for im in ["pga", "pgv"]:
            for ratio in [0.2, 0.5]:
                difference = worst(to, im, ratio, pathlib.Path(folder))
                print(f"{to:21} {im} ratio {ratio}: largest difference {difference:.1e} at 20 intensities")
                if difference > 1e-6:
                    sys.exit("OpenQuake and rockfrag differ by more than 1e-6")
