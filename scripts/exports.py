"""What the checks of exports share: the structure, and what `evaluate` has for it. Called with ROCKFRAG."""

import csv
import pathlib
import sys

from common import call

ALPHA = 0.20

rockfrag = pathlib.Path(sys.argv[1]).resolve()
structure = f"--structure=name=equipment,p=2.5,alpha={ALPHA},eta=0.92"


def run(subcommand, *arguments):
    """What rockfrag prints."""
    return call(rockfrag, subcommand, structure, *arguments)


def reached(im, intensity):
    """The probability of reaching LS1, LS2 and LS3 at this PGA (g) or PGV (m/s)."""
    (row,) = csv.DictReader(run("evaluate", f"--{im}={intensity!r}", "--format=csv").splitlines())
    rocking = 1 - float(row["p_nr"])
    return [rocking, float(row["p_f"] or 0), rocking * float(row["p_ro"] or 0)]
