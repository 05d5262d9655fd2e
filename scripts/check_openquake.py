"""Holds an export for OpenQuake against `evaluate`: python check_openquake.py ROCKFRAG OUT

ROCKFRAG is the binary and OUT the folder of a run. OpenQuake's own reader takes the NRML, its own fragility functions give
the probabilities, and these must equal ours to 1e-5 at 20 intensities, of PGA and of PGV, and be exactly 0 below uplift.
Needs openquake.engine (scripts/check_exports.sh makes a place for it).
"""

import pathlib
import sys
import tempfile

import numpy as np
from openquake.hazardlib import nrml
from openquake.risklib import read_nrml  # noqa: F401, registers the reader of fragility models

from exports import G, P, UPLIFT_G, reached, run

for im in ["pga", "pgv"]:
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "fragility.xml"
        run("export", "--to=openquake", f"--im={im}", f"--out={file}")
        model = nrml.to_python(str(file))
    ((imt, _), functions), = model.items()
    assert imt == im.upper(), imt
    pga_g = np.geomspace(0.5 * UPLIFT_G, 7 * UPLIFT_G, 20)
    own = pga_g if im == "pga" else 0.4 * pga_g * G / P
    worst = 0.0
    for intensity, expected in zip(own, reached(im, own.tolist())):
        iml = np.array([intensity if im == "pga" else 100 * intensity])
        for function in functions.build(model.limitStates):
            theirs = float(function(iml)[0])
            if im == "pga" and intensity < UPLIFT_G and theirs != 0:
                sys.exit(f"{im}: {function.limit_state} is {theirs} below uplift")
            worst = max(worst, abs(theirs - expected[model.limitStates.index(function.limit_state)]))
    print(f"openquake {im}: largest difference {worst:.1e} at 20 intensities")
    if worst > 1e-5:
        sys.exit("OpenQuake and rockfrag differ by more than 1e-5")
