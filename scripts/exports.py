"""What the checks of exports share: the structure, its fits, and what `evaluate` says of them. Called with ROCKFRAG OUT."""

import csv
import pathlib
import subprocess
import sys

G = 9.81
P, ALPHA = 2.5, 0.20

rockfrag, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
fits = [
    f"--pex={out / 'pex.parquet'}", f"--pro={out / 'pro.parquet'}", "--suite=csgm", "--structure=electrical-equipment",
    f"--p={P}", f"--alpha={ALPHA}",
]  # fmt: skip


def run(subcommand, *arguments):
    """What rockfrag prints."""
    call = [rockfrag, subcommand, *fits, *map(str, arguments)]
    return subprocess.run(call, check=True, capture_output=True, text=True).stdout


def reached(pga_g, pgv, *more):
    """The probability of reaching LS1, LS2 and LS3, as `evaluate` has it."""
    rows = csv.DictReader(run("evaluate", f"--pga={pga_g!r}", f"--pgv={pgv!r}", "--format=csv", *more).splitlines())
    answer = {row["quantity"]: float(row["value"] or 0) for row in rows}
    return [1 - answer["p_nr"], answer["p_f"], answer["p_ro"]]
