"""The figure of docs/universal.md: P(overturning) of three blocks over PGA and PGV, by the surface, and outcomes of motions that it has not seen:
python lecture.py ROCKFRAG OUT.svg
"""

import pathlib
import re
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np
import polars as pl

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, NullFormatter

BLOCKS = [(0.3, 1.0), (0.6, 2.4), (1.2, 6.0)]
LEVELS = [0.02, 0.1, 0.5, 0.9]
POINTS = 220
PGA, PGV = np.geomspace(0.15, 3.0, 50), np.geomspace(0.1, 3.0, 50)

rockfrag, out = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
plt.rcParams.update({"svg.hashsalt": "rockfrag", "svg.fonttype": "none", "font.family": "sans-serif", "font.size": 9})


def call(folder, *arguments):
    subprocess.run([rockfrag, "--quiet", *map(str, arguments)], cwd=folder, check=True)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    call(folder, "sample-scenarios", "--mw", "5.5:7.5:0.5", "--re", "5:20:2.5", "--samples", 20, "--seed", 2025)
    call(folder, "synthesize-motions", "--suite", "csgm", "--dt", 0.005, "--seed", 2025)
    # As strong as they are, and up to three times.
    motions = pl.read_parquet(folder / "motions.parquet", columns=["motion_id", "suite", "dt_s", "acceleration_m_s2"])
    factors = np.exp(np.random.default_rng(1).uniform(0, np.log(3), motions.height))
    scaled = [a.to_numpy() * f for a, f in zip(motions["acceleration_m_s2"], factors)]
    motions.with_columns(pl.Series("acceleration_m_s2", scaled, dtype=pl.List(pl.Float32))).write_parquet(folder / "m.parquet")
    a, v = np.meshgrid(PGA, PGV)
    pl.DataFrame({"pga_m_s2": a.ravel() * 9.81, "pgv_m_s": v.ravel()}).write_parquet(folder / "grid.parquet")
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.4), sharey=True, layout="constrained")
    for axis, (width, height) in zip(axes, BLOCKS):
        block = ["--width", width, "--height", height]
        call(folder, "evaluate", "--model", "universal", *block, "--in", "grid.parquet", "--out", "answers.parquet", "--force")
        p = pl.read_parquet(folder / "answers.parquet")["p_ro"].fill_null(0.0).to_numpy().reshape(a.shape)
        lines = axis.contour(a, v, p, LEVELS, colors="black", linewidths=[0.7, 0.9, 1.4, 0.9])
        axis.clabel(lines, fmt="%g", fontsize=7)
        call(folder, "simulate", "--in", "m.parquet", "--out", "responses.parquet", *block, "--force")
        seen = pl.read_parquet(folder / "responses.parquet").filter(pl.col("outcome") != "no_rocking")
        seen = seen.with_columns(pgv=pl.col("im5") * 9.81 * pl.col("alpha_rad").tan() / pl.col("p_rad_s")).sample(min(POINTS, seen.height), seed=1)
        for outcome, style in (("safe_rocking", {"facecolors": "none", "edgecolors": "#3a6ea5"}), ("overturning", {"color": "#b3261e"})):
            these = seen.filter(pl.col("outcome") == outcome)
            axis.scatter(these["pga_m_s2"] / 9.81, these["pgv"], s=7, linewidths=0.6, label=outcome.replace("_", " "), **style)
        axis.axvline(width / height, color="grey", linewidth=0.8, linestyle="--")
        axis.set(xscale="log", yscale="log", xlim=PGA[[0, -1]], ylim=PGV[[0, -1]], xlabel="PGA (g)", title=f"{width} m x {height} m")
        for one in (axis.xaxis, axis.yaxis):
            one.set_major_locator(FixedLocator([0.1, 0.2, 0.5, 1.0, 2.0]))
            one.set_major_formatter("{x:g}")
            one.set_minor_formatter(NullFormatter())
    axes[0].set_ylabel("PGV (m/s)")
    axes[0].legend(loc="lower right", fontsize=7, framealpha=0.9)
    figure.savefig(out, metadata={"Date": None})
# A tenth of a point is enough, and half the size.
lines = pathlib.Path(out).read_text().splitlines()
short = [line if "<text" in line else re.sub(r"(-?\d+\.\d)\d+", r"\1", line) for line in lines]
pathlib.Path(out).write_text("\n".join(line.rstrip() for line in short) + "\n")
print(pathlib.Path(out).stat().st_size, "bytes")
