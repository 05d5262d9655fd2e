"""The table of speeds, rockfrag beside its peers, as Markdown: python scripts/peers/table.py ROCKFRAG

Needs numpy, numba, statsmodels and pyarrow, and taskset. Medians of five runs, both sides in turns. The solver runs by
`cargo bench --bench speed`. Of a peer: table.py PEER FILE.
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
from scipy.stats import norm

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
    """Milliseconds a motion of a scalar solver by Numba, once it is compiled: the paper's electrical equipment
    under all motions."""
    from rocking import FREE, demand

    sides, names = np.array([[0.20, 2.5, 0.92]] * 2), ["dt_s", "acceleration_m_s2"]
    columns = (column.to_pylist() for column in pq.read_table(file, columns=names).columns)
    motions = [(np.array(acceleration) / 9.81, dt) for dt, acceleration in zip(*columns)]
    demand(*motions[0], sides, FREE)  # compiles
    start = time.process_time()
    for motion in motions:
        demand(*motion, sides, FREE)
    return 1e3 * (time.process_time() - start) / len(motions)


def fits(file):
    """Seconds of the fits by suite and structure: the demand in safe rocking on each measure and on both planes
    (OLS), overturning on each measure and on the hybrid (probit), with covariance by cells of magnitude and distance
    and the mean log score of ten folds of cells."""
    import statsmodels.api as sm

    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    names = ["suite", "structure", "outcome", "edp", "mw", "re_km", *MEASURES]
    columns = {name: column.to_numpy() for name, column in zip(names, pq.read_table(file, columns=names).columns)}
    groups = np.char.add(columns["suite"].astype(str), columns["structure"].astype(str))
    cells = np.unique(np.column_stack([columns["mw"], columns["re_km"]]), axis=0, return_inverse=True)[1].ravel()

    def fit(model, y, measures, chosen, options, score):
        design = sm.add_constant(np.column_stack([ln[name] for name in measures]))
        chosen = chosen & np.isfinite(design).all(axis=1) & np.isfinite(y)
        y, design, cell = y[chosen], design[chosen], cells[rows][chosen]
        model(y, design).fit(**options, cov_type="cluster", cov_kwds={"groups": cell}).cov_params()
        left_out = [(cell % 10 == fold, cell % 10 != fold) for fold in range(10)]
        fits = ((out, model(y[kept], design[kept]).fit(**options)) for out, kept in left_out)
        return np.mean(np.concatenate([score(fitted, y[out], design[out] @ fitted.params) for out, fitted in fits]))

    normal = lambda fitted, y, mean: norm.logpdf(y, mean, np.sqrt(fitted.scale))
    binary = lambda fitted, y, z: norm.logcdf(np.where(y == 1.0, z, -z))
    start = time.perf_counter()
    for group in np.unique(groups):
        rows = groups == group
        ln = {name: np.log(columns[name][rows].astype(float)) for name in ("edp", *MEASURES)}
        outcome, below = columns["outcome"][rows], ln["im4"] < np.log(1.3)
        safe, rocks = outcome == "safe_rocking", outcome != "no_rocking"
        sides, alone = [(ln["im4"] >= 0) & below, ~below], [(name,) for name in MEASURES]
        planes = [(("im4", "im3"), safe & side) for side in sides]
        for measures, chosen in [(one, safe) for one in alone] + planes:
            fit(sm.OLS, ln["edp"], measures, chosen, {}, normal)
        overturns = (outcome == "overturning").astype(float)
        for measures in [*alone, ("im4", "im3")]:
            fit(sm.Probit, overturns, measures, rocks, {"disp": 0, "maxiter": 100}, binary)
    return time.perf_counter() - start


def run(*command, environment=None):
    """Wall time of a command, s, and what it prints."""
    start = time.perf_counter()
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, env=environment, check=True)
    return time.perf_counter() - start, done.stdout


def peer(name, file):
    """The figure of a peer, in a process of its own."""
    one_core = ([], None) if name == "read" else (["taskset", "-c", 0], ONE_THREAD)
    return float(run(*one_core[0], sys.executable, __file__, name, file, environment=one_core[1])[1])


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
    tool("sample-scenarios", "scenarios", "--samples=20")
    csgm("motions")
    print("| work | rockfrag | against | theirs | theirs / ours |\n|---|---|---|---|---|")
    bench = lambda: json.loads(run("cargo", "bench", "--bench", "speed")[1].splitlines()[-1])["solver_us"] / 1e3
    pairs = [(bench(), peer("rocking", at("motions"))) for _ in range(REPEAT)]
    row("solver, one core, a motion", "ms", "our scalar solver by Numba", pairs)
    tool("sample-scenarios", "scenarios", "--samples=100")
    csgm("motions")
    pairs = [(simulate("motions")[0], peer("read", at("motions"))) for _ in range(REPEAT)]
    row("simulate, whole command, all cores", "s", "pyarrow, the read alone, all cores", pairs)
    tool("simulate", "paper", "--structures=paper", "--in", at("motions"))
    fit = lambda name: tool(name, name, "--all", "--threads=1", "--in", at("paper"))[0]
    pairs = [(fit("fit-pex") + fit("fit-pro"), peer("fits", at("paper"))) for _ in range(REPEAT)]
    row("all fits with held-out scores, whole commands, one core", "s", "statsmodels, the fits alone", pairs)
