"""The table of speeds: rockfrag beside its peers, on the same files, in one run.

    cargo build --release && python scripts/peers/table.py > docs/speed.md

Needs numpy, scipy, numba, statsmodels, pandas and pyarrow. Each figure is a median; what is compared runs in
turns, so that both sides see the same machine. Solver times come from `cargo bench`.
"""

import argparse
import json
import os
import pathlib
import platform
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).parent
ROOT = HERE.parent.parent
ONE_THREAD = {name: "1" for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
REPLICATES = 2000
STRUCTURE = ("--p", 2.5, "--alpha", 0.2, "--eta", 0.92)


def run(*command, env=None, core=None):
    """Runs a command, on one core if told so; its wall time, its processor time and what it prints."""
    if core is not None:
        command = ("taskset", "-c", str(core), *command)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.perf_counter()
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, env={**os.environ, **(env or {})}
    )
    wall = time.perf_counter() - start
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, command))}\n{done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def peer(name, *arguments):
    """What a peer reports, on one core."""
    return json.loads(run(sys.executable, HERE / f"{name}.py", *arguments, env=ONE_THREAD, core=0)[2])


def bench_seconds(target, motions, *names):
    """Medians of benchmarks, s."""
    command = ("cargo", "bench", "--bench", target, "--", "--noplot")
    run(*command, env={"ROCKFRAG_MOTIONS": str(motions)}, core=0)
    folder = ROOT / "target" / "criterion"
    medians = {}
    for name in names:
        estimates = folder / name / "new" / "estimates.json"
        if estimates.exists():
            medians[name] = json.loads(estimates.read_text())["median"]["point_estimate"] * 1e-9
    return medians


def peak_memory_mb(*command):
    """The largest resident set of a command, MB."""
    done = subprocess.run(
        ["/usr/bin/time", "-f", "%M", *map(str, command)], capture_output=True, text=True, check=True
    )
    return int(done.stderr.split()[-1]) / 1e3


class Comparison:
    """Rows of the table."""

    def __init__(self):
        self.rows = []

    def add(self, work, ours, against, theirs, asked, ratio):
        """A row: what ours and theirs took, in words, and the ratio."""
        self.rows.append((work, ours, against, theirs, ratio, asked))

    def markdown(self):
        head = ("work", "rockfrag", "against", "theirs", "ratio", "asked")
        lines = [head, ("---",) * len(head), *self.rows]
        return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def in_turns(repeat, *works):
    """The medians of what several functions return, each called in turn."""
    results = [[] for _ in works]
    for _ in range(repeat):
        for result, work in zip(results, works):
            result.append(work())
    return [statistics.median(result) for result in results]


def compare(folder, rockfrag, repeat):
    """All rows, with files in `folder`."""
    table = Comparison()
    scenarios, motions, responses = (
        folder / f"{name}.parquet" for name in ("scenarios", "csgm", "responses")
    )
    run(rockfrag, "sample-scenarios", "--out", scenarios)
    synthesize = (
        rockfrag,
        "synthesize-motions",
        "--in",
        scenarios,
        "--out",
        motions,
        "--suite",
        "csgm",
        "--force",
    )
    run(*synthesize)
    count = 3500

    simulate = (rockfrag, "simulate", *STRUCTURE, "--in", motions, "--out", responses, "--force", "--quiet")
    read = (sys.executable, HERE / "read_pyarrow.py", motions, "--once")
    whole, reading, first = in_turns(
        repeat, lambda: run(*simulate)[0], lambda: run(*read)[0], lambda: float(run(*read)[2])
    )
    work = "simulate, 3500 csgm motions, whole command"
    table.add(
        work,
        f"{whole:.3f} s",
        "pyarrow, whole process",
        f"{reading:.3f} s",
        "<= 1.5",
        f"{whole / reading:.2f}",
    )
    table.add(
        work, f"{whole:.3f} s", "pyarrow, the read alone", f"{first:.3f} s", "<= 1.5", f"{whole / first:.2f}"
    )

    paths = ("scalar", "avx2", "avx512")
    names = [f"solver/{path}" for path in paths] + [
        "structures/grid",
        "structures/one-by-one",
        "processor/multiply-adds",
    ]
    solver = bench_seconds("solver", motions, *names)
    ms = {path: 1e3 * solver[f"solver/{path}"] / count for path in paths if f"solver/{path}" in solver}
    fastest = list(ms)[-1]
    for name, arguments, asked in (("scipy", ("--count", 60), ">= 5000"), ("numba", (), ">= 25")):
        theirs = peer(f"rocking_{name}", motions, *arguments)["cpu_ms_a_motion"]
        table.add(
            f"solver alone, one core, {fastest}",
            f"{ms[fastest]:.4f} ms a motion",
            name,
            f"{theirs:.3f} ms",
            asked,
            f"{theirs / ms[fastest]:.0f}",
        )
    for path, asked in (("avx512", ">= 4"), ("avx2", ">= 2.5")):
        if path in ms:
            ratio = f"{ms['scalar'] / ms[path]:.1f}"
            table.add(
                f"solver alone, {path}",
                f"{ms[path]:.4f} ms",
                "its scalar code",
                f"{ms['scalar']:.4f} ms",
                asked,
                ratio,
            )

    grid, singly = solver["structures/grid"], solver["structures/one-by-one"]
    analyses = 400 * 350
    table.add(
        "400 structures on 350 motions",
        f"{analyses / grid:,.0f} analyses a second",
        "400 single runs",
        f"{analyses / singly:,.0f}",
        ">= 2",
        f"{singly / grid:.2f}",
    )

    if shutil.which("valgrind"):
        flops = json.loads(run(sys.executable, HERE / "flops.py", motions, "--rockfrag", rockfrag)[2])
        operations = flops["flop_an_analysis"] * analyses / grid
        benchmark = ROOT / "target" / "criterion" / "processor" / "multiply-adds" / "new" / "benchmark.json"
        multiply_adds = json.loads(benchmark.read_text())["throughput"]["Elements"]
        peak = 2 * multiply_adds / solver["processor/multiply-adds"]
        table.add(
            "the same, operations",
            f"{flops['flop_an_analysis'] / 1e3:.0f} kflop each, {operations / 1e9:.0f} GFLOP/s",
            "fused multiply-adds alone",
            f"{peak / 1e9:.0f} GFLOP/s",
            "",
            f"{operations / peak:.0%}",
        )

    one_core = lambda: run(*synthesize, "--threads", 1, "--quiet", core=0)[0]
    numpy_motions = folder / "numpy.parquet"
    numpy_wall = lambda: sum(
        json.loads(
            run(
                sys.executable,
                HERE / "synthesize_numpy.py",
                scenarios,
                "--out",
                numpy_motions,
                "--repeat",
                1,
                env=ONE_THREAD,
                core=0,
            )[2]
        )["seconds"].values()
    )
    ours, theirs = in_turns(repeat, one_core, numpy_wall)
    table.add(
        "synthesize-motions, 3500, one core",
        f"{ours:.2f} s",
        "numpy, written too",
        f"{theirs:.2f} s",
        ">= 12",
        f"{theirs / ours:.1f}",
    )
    names = ("motions/synthesis and measures", "motions/transforms")
    seconds = bench_seconds("motions", motions, *names)
    making, transforms = (seconds[name] for name in names)
    table.add(
        "the same, without files",
        f"{making:.3f} s",
        "its transforms alone",
        f"{transforms:.3f} s",
        "<= 2.5",
        f"{making / transforms:.2f}",
    )

    run(rockfrag, "run", ROOT / "pipeline.yaml", "--out", folder / "out")
    paper = folder / "out" / "responses.parquet"
    fits = lambda: sum(
        run(
            rockfrag,
            stage,
            "--in",
            paper,
            "--out",
            folder / f"{stage}.parquet",
            "--bootstrap",
            REPLICATES,
            "--threads",
            1,
            "--force",
            core=0,
        )[0]
        for stage in ("fit-pex", "fit-pro")
    )
    scaled = ("--replicates", 20, "--scale-to", REPLICATES, "--out", folder / "fits.csv")
    statsmodels = lambda: peer("fits_statsmodels", paper, *scaled)["scaled_seconds"]
    ours, theirs = in_turns(repeat, fits, statsmodels)
    table.add(
        f"all fits, {REPLICATES} replicates, one core",
        f"{ours:.2f} s",
        "statsmodels, scaled from 20",
        f"{theirs:.0f} s",
        ">= 100",
        f"{theirs / ours:.0f}",
    )

    many, ten = folder / "many.parquet", folder / "ten.parquet"
    run(rockfrag, "sample-scenarios", "--out", many, "--samples", 1000)
    run(rockfrag, "synthesize-motions", "--in", many, "--out", ten, "--suite", "csgm")
    small = peak_memory_mb(*simulate)
    large = peak_memory_mb(rockfrag, "simulate", *STRUCTURE, "--in", ten, "--out", responses, "--force", "--quiet")
    table.add(
        "simulate, peak memory, 35,000 motions",
        f"{large:.0f} MB",
        "3500 motions",
        f"{small:.0f} MB",
        "<= 1.2, 400 MB",
        f"{large / small:.2f}",
    )
    return table


def stages(folder, rockfrag, repeat):
    """The stages of the whole paper one by one on two threads: seconds, and how busy two cores are."""
    at = lambda name: folder / "stages" / f"{name}.parquet"
    between = lambda stage, source, made: (stage, "--in", at(source), "--out", at(made))
    fitted = ("--pex", at("pex"), "--pro", at("pro"), "--responses", at("responses"))
    commands = [
        ("sample-scenarios", "--out", at("scenarios")),
        between("synthesize-motions", "scenarios", "motions"),
        between("simulate", "motions", "responses"),
        between("fit-pex", "responses", "pex"),
        between("fit-pro", "responses", "pro"),
        ("compare-paper", *fitted, "--out", at("paper")),
        ("report", "--in", folder / "stages", "--out", folder / "stages" / "report.html"),
    ]
    (folder / "stages").mkdir()
    lines = ["| stage | s | of two cores |", "| --- | --- | --- |"]
    for command in commands:
        call = (rockfrag, "--config", ROOT / "pipeline.yaml", "--threads", 2, *command, "--force", "--quiet")
        runs = [run(*call)[:2] for _ in range(repeat)]
        wall, processor = (statistics.median(times) for times in zip(*runs))
        lines.append(f"| {command[0]} | {wall:.2f} | {processor / wall / 2:.0%} |")
    return "\n".join(lines)


def machine():
    """What this was measured on."""
    model = next(
        (line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")),
        platform.processor(),
    )
    return f"{os.cpu_count()} cores of {model}, {platform.system()}, Python {platform.python_version()}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rockfrag", default=ROOT / "target" / "release" / "rockfrag")
    parser.add_argument("--repeat", type=int, default=5, help="runs of each side, of which the median counts")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        table = compare(pathlib.Path(folder), options.rockfrag, options.repeat)
        by_stage = stages(pathlib.Path(folder), options.rockfrag, options.repeat)
    print(f"Measured on {machine()}; medians of {options.repeat} runs.\n")
    print(table.markdown())
    print(f"\n{by_stage}")


if __name__ == "__main__":
    main()
