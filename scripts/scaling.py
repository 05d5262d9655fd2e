"""Time and memory over sizes and threads, as Markdown: python scripts/scaling.py ROCKFRAG [MOTIONS [OBJECTS]]

Of 10^2 motions up to 10^5: their synthesis, their read by pyarrow alone, simulate with a structure so wide that hardly any
motion rocks it (what is left is the reader) and with the paper's two; of the first 105 ida. Of 10^2 objects up to 10^4:
evaluate at a site. Medians of three runs (one from 10^5 on), in turns. Memory is the largest resident set. Needs pyarrow.
"""

import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from common import ROOT

READ = """import sys, time, pyarrow, pyarrow.parquet as pq, pyarrow.dataset
pyarrow.set_cpu_count(int(sys.argv[2]))
start = time.perf_counter(), time.process_time()
pq.read_table(sys.argv[1], use_threads=sys.argv[2] != "1")
print(time.perf_counter() - start[0], time.process_time() - start[1])"""
CELLS = 35


def measure(*command):
    """Wall and processor time, s, which Python prints itself, and the largest resident set, MB."""
    start = time.perf_counter()
    child = subprocess.Popen(map(str, command), stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    printed = child.stdout.read()
    _, status, used = os.wait4(child.pid, 0)
    assert status == 0, command
    times = time.perf_counter() - start, used.ru_utime + used.ru_stime
    return *(map(float, printed.split()) if command[0] == sys.executable else times), used.ru_maxrss / 1e3


def rows(count, works):
    """A row of each work on 1 and 2 threads, of the command without their number."""
    calls = [(work, threads) for work in works for threads in (1, 2)]
    turns = [[measure(*works[work], threads) for work, threads in calls] for _ in range(3 if count < 1e5 else 1)]
    for (work, threads), runs in zip(calls, zip(*turns)):
        wall, processor, memory = (statistics.median(column) for column in zip(*runs))
        each = 1e3 * processor / count
        print(f"| {work} | {count} | {threads} | {wall:.3g} | {processor:.3g} | {each:.3g} | {memory:.0f} |", flush=True)


ROCKFRAG = pathlib.Path(sys.argv[1]).resolve()
SIZES = 100, 1000, 10_000, 100_000, 1_000_000
MOTIONS, OBJECTS = (float(word) for word in (sys.argv[2:] + ["1e5", "1e4"][len(sys.argv) - 2 :]))
stage = lambda name, *options: [ROCKFRAG, name, "--force", "--quiet", *options, "--threads"]
machine = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
print(f"{machine[0]}, {len(machine)} processors\n\n| work | of | threads | wall, s | processor, s | each, ms | MB |")
print("|---|---|---|---|---|---|---|")
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for cell in [round(size / CELLS) for size in SIZES if size <= MOTIONS]:
        measure(*stage("sample-scenarios", "--samples", cell), 2)
        works = {
            "synthesize-motions": stage("synthesize-motions", "--suite=csgm"),
            "pyarrow, the read alone": [sys.executable, "-c", READ, "motions.parquet"],
            "simulate, hardly any rocks": stage("simulate", "--p=2.5", "--alpha=0.785", "--eta=0.92"),
            "simulate, two structures": stage("simulate", "--structures=paper"),
        }
        ida = {"ida": stage("ida", "--p=2.5", "--alpha=0.2", "--eta=0.92")}
        rows(CELLS * cell, works if cell > 3 else works | ida)
    for size in [size for size in SIZES if size <= OBJECTS]:
        lines = [f"\nobject {k},{0.3 + 0.6 * k / size:.5f},{1 + k % 7 / 5:.1f}" for k in range(size)]
        pathlib.Path("list.csv").write_text("name,width,height" + "".join(lines))
        at_site = "--structures=list.csv", f"--hazard={ROOT / 'data/hazard.csv'}", "--out=list.parquet"
        rows(size, {"evaluate, a list at a site": stage("evaluate", *at_site)})
