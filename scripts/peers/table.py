"""The table of speeds, rockfrag beside its peers, as Markdown: python scripts/peers/table.py ROCKFRAG

Needs numpy, numba, statsmodels and pyarrow, and GNU time. Medians of five runs, both sides in turns; peers and the
solver run on one core, the solver by `cargo bench --bench speed`.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent
ROCKFRAG = pathlib.Path(sys.argv[1]).resolve()
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
REPEAT = 5
# The first read in a process pays for the memory that it gets from the system.
READ = """
import sys, time, pyarrow.dataset, pyarrow.parquet
start = time.perf_counter()
pyarrow.parquet.read_table(sys.argv[1])
print(time.perf_counter() - start)
"""


def run(*command, environment=None):
    """Wall time of a command, s, what it prints, and its largest resident set, MB."""
    start = time.perf_counter()
    command = ["/usr/bin/time", "-f", "%M", *map(str, command)]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    return time.perf_counter() - start, done.stdout, int(done.stderr.split()[-1]) / 1e3


def peer(name, *arguments):
    """The figures of a peer."""
    script = ["-c", READ] if name == "pyarrow" else [HERE / f"{name}.py"]
    return json.loads(run("taskset", "-c", 0, sys.executable, *script, *arguments, environment=ONE_THREAD)[1])


def row(work, ours, against, theirs, ratio):
    print(f"| {work} | {ours} | {against} | {theirs} | {ratio:.3g} |")


with tempfile.TemporaryDirectory() as folder:
    at = lambda name: pathlib.Path(folder) / f"{name}.parquet"
    make = lambda samples, name: (
        run(ROCKFRAG, "sample-scenarios", "--samples", samples, "--out", at("scenarios"), "--force"),
        run(ROCKFRAG, "synthesize-motions", "--suite", "csgm", "--in", at("scenarios"), "--out", at(name)),
    )
    simulate = lambda name: run(
        ROCKFRAG, "simulate", "--p=2.5", "--alpha=.2", "--eta=.92", "--in", at(name), "--out", at("responses"), "--force"
    )
    make(100, "motions")
    print("| work | rockfrag | against | theirs | ratio |\n|---|---|---|---|---|")
    pairs = [(simulate("motions")[0], peer("pyarrow", at("motions"))) for _ in range(REPEAT)]
    ours, theirs = (statistics.median(side) for side in zip(*pairs))
    row("simulate, whole command", f"{ours:.3f} s", "pyarrow, the read alone", f"{theirs:.3f} s", ours / theirs)
    solver_us = json.loads(run("cargo", "bench", "--bench", "speed")[1].splitlines()[-1])["solver_us"]
    theirs = peer("rocking_numba", at("motions"))["ms_a_motion"]
    ours = solver_us / 1e3
    row("solver, one core, a motion", f"{ours:.4f} ms", "Numba, Taylor series", f"{theirs:.3f} ms", theirs / ours)
    run(ROCKFRAG, "simulate", "--structures", "paper", "--in", at("motions"), "--out", at("paper"))
    fit = lambda name: run(ROCKFRAG, name, "--all", "--threads=1", "--in", at("paper"), "--out", at(name), "--force")[0]
    pairs = [(fit("fit-pex") + fit("fit-pro"), peer("fits_statsmodels", at("paper"))["fits_s"]) for _ in range(REPEAT)]
    ours, theirs = (statistics.median(side) for side in zip(*pairs))
    row("all fits, one core", f"{ours:.3f} s", "statsmodels, the fits alone", f"{theirs:.3f} s", theirs / ours)
    small = simulate("motions")[2]
    make(1000, "ten")
    large = simulate("ten")[2]
    row("simulate 35,000 motions, memory", f"{large:.0f} MB", "3500 motions", f"{small:.0f} MB", large / small)
