"""The table of speeds, rockfrag beside its peers, as Markdown: python scripts/peers/table.py ROCKFRAG

Needs numpy, numba, statsmodels and pyarrow, and GNU time. Medians of five runs, both sides in turns; peers
and the solver run on one core, the solver by `cargo bench --bench speed`. Of a peer: table.py PEER FILE.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
import warnings

import numpy as np
import pyarrow.dataset  # noqa: F401
import pyarrow.parquet as pq

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
REPEAT = 5
MEASURES = ("im1", "im2", "im3", "im4", "im5", "im6")


def read(file):
    """Seconds of the first read in a process, which pays for the memory that it gets from the system."""
    start = time.perf_counter()
    pq.read_table(file)
    return time.perf_counter() - start


def rocking(file):
    """Milliseconds a motion of a solver in Python written for speed, on one thread, once it is compiled: the
    paper's electrical equipment under all motions, each with rest behind it."""
    from rocking import FREE, demand, rested

    sides, names = np.array([[0.20, 2.5, 0.92]] * 2), ["dt_s", "acceleration_m_s2"]
    columns = (column.to_pylist() for column in pq.read_table(file, columns=names).columns)
    motions = [(rested(np.array(acceleration) / 9.81, dt), dt) for dt, acceleration in zip(*columns)]
    demand(*motions[0], sides, FREE)  # compiles
    start = time.process_time()
    for motion in motions:
        demand(*motion, sides, FREE)
    return 1e3 * (time.process_time() - start) / len(motions)


def fits(file):
    """Seconds of the fits by suite and structure: the demand in safe rocking on each measure and on both planes
    (OLS), overturning on each measure and on the hybrid (probit), with covariance."""
    import statsmodels.api as sm

    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    table = pq.read_table(file, columns=["suite", "structure", "outcome", "edp", *MEASURES])
    columns = {name: table[name].to_numpy(zero_copy_only=False) for name in table.column_names}
    groups = np.char.add(columns["suite"].astype(str), columns["structure"].astype(str))
    start = time.perf_counter()
    for group in np.unique(groups):
        rows = groups == group
        ln = {name: np.log(columns[name][rows].astype(float)) for name in ("edp", *MEASURES)}
        outcome, below = columns["outcome"][rows], ln["im4"] < np.log(1.3)
        safe, rocks = outcome == "safe_rocking", outcome != "no_rocking"
        sides, alone = [(ln["im4"] >= 0) & below, ~below], [(name,) for name in MEASURES]
        planes = [(("im4", "im3"), safe & side) for side in sides]
        for measures, chosen in [(one, safe) for one in alone] + planes:
            design = sm.add_constant(np.column_stack([ln[name] for name in measures]))
            chosen = chosen & np.isfinite(design).all(axis=1) & np.isfinite(ln["edp"])
            sm.OLS(ln["edp"][chosen], design[chosen]).fit().cov_params()
        for measures in [*alone, ("im4", "im3")]:
            design = sm.add_constant(np.column_stack([ln[name] for name in measures]))
            chosen = rocks & np.isfinite(design).all(axis=1)
            event = (outcome[chosen] == "overturning").astype(float)
            sm.Probit(event, design[chosen]).fit(disp=0, maxiter=100).cov_params()
    return time.perf_counter() - start


def run(*command, environment=None):
    """Wall time of a command, s, what it prints, and its largest resident set, MB."""
    start = time.perf_counter()
    command = ["/usr/bin/time", "-f", "%M", *map(str, command)]
    done = subprocess.run(command, capture_output=True, text=True, env=environment, check=True)
    return time.perf_counter() - start, done.stdout, int(done.stderr.split()[-1]) / 1e3


def peer(name, file):
    """The figure of a peer, in a process of its own."""
    command = "taskset", "-c", 0, sys.executable, __file__, name, file
    return float(run(*command, environment=ONE_THREAD)[1])


def row(work, unit, peer, pairs):
    """Prints the medians of pairs, ours and theirs."""
    ours, theirs = (statistics.median(side) for side in zip(*pairs))
    print(f"| {work} | {ours:.3g} {unit} | {peer} | {theirs:.3g} {unit} | {theirs / ours:.2g} |")


PEERS = {"read": read, "rocking": rocking, "fits": fits}
if sys.argv[1] in PEERS:
    sys.exit(print(PEERS[sys.argv[1]](sys.argv[2])))
ROCKFRAG = pathlib.Path(sys.argv[1]).resolve()
with tempfile.TemporaryDirectory() as folder:
    at = lambda name: pathlib.Path(folder) / f"{name}.parquet"
    tool = lambda name, out, *options: run(ROCKFRAG, name, "--out", at(out), "--force", *options)
    csgm = lambda name: tool("synthesize-motions", name, "--suite=csgm", "--in", at("scenarios"))
    size = "--p=2.5", "--alpha=.2", "--eta=.92"
    simulate = lambda name: tool("simulate", "responses", *size, "--in", at(name))
    tool("sample-scenarios", "scenarios", "--samples=100")
    csgm("motions")
    print("| work | rockfrag | against | theirs | theirs / ours |\n|---|---|---|---|---|")
    solver_us = json.loads(run("cargo", "bench", "--bench", "speed")[1].splitlines()[-1])["solver_us"]
    pairs = [(solver_us / 1e3, peer("rocking", at("motions")))]
    row("solver, one core, a motion", "ms", "Numba, Taylor series", pairs)
    pairs = [(simulate("motions")[0], peer("read", at("motions"))) for _ in range(REPEAT)]
    row("simulate, whole command", "s", "pyarrow, the read alone", pairs)
    tool("simulate", "paper", "--structures=paper", "--in", at("motions"))
    fit = lambda name: tool(name, name, "--all", "--threads=1", "--in", at("paper"))[0]
    pairs = [(fit("fit-pex") + fit("fit-pro"), peer("fits", at("paper"))) for _ in range(REPEAT)]
    row("all fits of both structures, one core", "s", "statsmodels, the fits alone", pairs)
    small = simulate("motions")[2]
    tool("sample-scenarios", "scenarios", "--samples=1000")
    csgm("ten")
    row("simulate, peak memory, 35,000 motions", "MB", "3500 motions", [(simulate("ten")[2], small)])
