"""Holds exports for OpenQuake against `evaluate`: python check_openquake.py ROCKFRAG

ROCKFRAG is the binary. OpenQuake's own reader takes the NRML, its own fragility functions give
the probabilities, and these must equal those of `evaluate`, averaged over PGV/PGA, to 1e-5 at 20 levels of PGA and of PGV
that any motion has, and be exactly 0 below uplift. Needs openquake.engine (scripts/check_exports.sh makes a place for it).
"""

import math
import pathlib
import re
import sys
import tempfile

import numpy as np
from openquake.hazardlib import nrml
from openquake.risklib import read_nrml  # noqa: F401, registers the reader of fragility models

from exports import ALPHA, reached, run

UPLIFT_G = math.tan(ALPHA)


def worst(im, folder):
    """The largest difference at 20 levels and, of PGA, two intensities below uplift."""
    file = folder / f"{im}.xml"
    run("export", "--to=openquake", f"--over={im}", f"--out={file}")
    model = nrml.to_python(str(file))
    ((imt, _), functions), = model.items()
    assert imt == im.upper(), imt
    difference = 0.0
    unit, most = (1, 4.4) if im == "pga" else (100, 4.9)
    levels = np.array(re.search("<imls[^>]*>([^<]*)<", file.read_text())[1].split(), dtype=float) / unit
    levels = levels[levels < most]
    below = [0.5 * UPLIFT_G, 0.99 * UPLIFT_G] if im == "pga" else []
    for intensity in [*below, *levels[np.linspace(1, len(levels) - 1, 20).astype(int)]]:
        iml = np.array([unit * intensity])
        expected = dict(zip(["LS1", "LS2", "LS3"], reached(im, float(intensity))))
        for function in functions.build(model.limitStates):
            theirs = float(function(iml)[0])
            if im == "pga" and intensity < UPLIFT_G and theirs != 0:
                sys.exit(f"{file.name}: {function.limit_state} is {theirs} below uplift")
            difference = max(difference, abs(theirs - expected[function.limit_state]))
    return difference


with tempfile.TemporaryDirectory() as folder:
    for im in ["pga", "pgv"]:
        difference = worst(im, pathlib.Path(folder))
        print(f"openquake {im}: largest difference {difference:.1e} at 20 levels")
        if difference > 1e-5:
            sys.exit("OpenQuake and rockfrag differ by more than 1e-5")
