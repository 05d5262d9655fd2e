"""Holds exports for OpenQuake against `evaluate`: python check_openquake.py ROCKFRAG OUT

ROCKFRAG is the binary and OUT the folder of a run. OpenQuake's own reader takes the NRML, its own fragility functions give
the probabilities, and these must equal those of `evaluate` to 1e-6 at 20 intensities, of PGA and of PGV, discrete and
continuous, and be exactly 0 below uplift. Needs openquake.engine (scripts/check_exports.sh makes a place for it).
"""

import math
import pathlib
import sys
import tempfile

import numpy as np
from openquake.hazardlib import nrml
from openquake.risklib import read_nrml  # noqa: F401, registers the reader of fragility models

from exports import ALPHA, G, P, reached, run


def worst(to, im, ratio, folder):
    """The largest difference at 20 intensities, in steps equal in logarithm, of which some lie below uplift."""
    file = folder / f"{to}_{im}_{ratio}.xml"
    # Only the paper's straight line is lognormal.
    form = "--model=paper" if to == "openquake-continuous" else "--model=bivariate"
    run("export", form, f"--to={to}", f"--im={im}", f"--ratio={ratio}", f"--out={file}")
    model = nrml.to_python(str(file))
    ((imt, _), functions), = model.items()
    assert imt == im.upper(), imt
    largest = 7 * math.tan(ALPHA)
    difference = 0.0
    for pga_g in np.geomspace(0.5 * math.tan(ALPHA), largest, 20):
        pgv = ratio * pga_g * G / P
        iml = np.array([pga_g if im == "pga" else 100 * pgv])
        expected = dict(zip(["LS1", "LS2", "LS3"], reached(float(pga_g), float(pgv), form)))
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
