"""What the checks of exports share: the structure, and what `evaluate` has for it. Called with ROCKFRAG."""

import csv
import pathlib
import subprocess
import sys
import tempfile

ALPHA = 0.20
HEADINGS = {"pga": "pga_g", "pgv": "pgv_m_s"}

rockfrag = pathlib.Path(sys.argv[1]).resolve()
structure = f"--structure=name=equipment,p=2.5,alpha={ALPHA},eta=0.92"


def run(subcommand, *arguments):
    """What rockfrag prints."""
    call = [rockfrag, subcommand, structure, *map(str, arguments)]
    return subprocess.run(call, check=True, capture_output=True, text=True).stdout


def reached(im, intensity):
    """The probability of reaching LS1, LS2 and LS3: the rates over a hazard of this intensity alone, once a year."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as hazard:
        hazard.write(f"{HEADINGS[im]},annual_rate_of_exceedance\n")
        hazard.writelines(f"{intensity * (1 + k * 1e-9)!r},{10.0 ** (-3 * k)!r}\n" for k in range(5))
        hazard.flush()
        (row,) = csv.DictReader(run("evaluate", f"--hazard={hazard.name}", "--format=csv").splitlines())
    return [float(row[f"{state}_per_year"] or 0) for state in ["rocking", "failure", "overturning"]]
