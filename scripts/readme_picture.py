"""Draws the picture of the README from a run: python readme_picture.py OUT docs/fragility.png

The probability of overturning of the electrical equipment over p PGV / (g tan alpha), with binned data as circles, and
the demand in safe rocking over PGA / (g tan alpha). Needs polars, scipy and matplotlib.
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import polars as pl
from scipy.stats import norm

out, picture = pathlib.Path(sys.argv[1]), sys.argv[2]
responses = pl.read_parquet(out / "responses.parquet")
curves = pl.read_parquet(out / "pro.parquet").filter(pl.col("im_x") == "im5")
figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), dpi=150, layout="constrained")

colours = {"pulse": "#0072B2", "csgm": "#D55E00"}
for suite, label in [("pulse", "pulses"), ("csgm", "combined motions")]:
    rocked = responses.filter(
        (pl.col("suite") == suite) & (pl.col("structure") == "electrical-equipment") & (pl.col("outcome") != "no_rocking")
    )
    curve = curves.filter((pl.col("suite") == suite) & (pl.col("structure") == "electrical-equipment")).row(0, named=True)
    im = np.geomspace(0.2, 4, 200)
    left.plot(im, norm.cdf((np.log(im) - curve["mu"]) / curve["beta"]), color=colours[suite], label=label)
    edges = np.geomspace(0.2, 4, 14)
    for low, high in zip(edges, edges[1:]):
        inside = rocked.filter(pl.col("im5").is_between(low, high, closed="left"))
        if inside.height:
            share = (inside["outcome"] == "overturning").mean()
            left.scatter(np.sqrt(low * high), share, s=inside.height / 4, color=colours[suite], alpha=0.35, lw=0)
    safe = rocked.filter(pl.col("outcome") == "safe_rocking")
    right.scatter(safe["im4"], safe["edp"], s=3, color=colours[suite], alpha=0.35, lw=0)
left.set(xscale="log", xlabel="p PGV / (g tan α)", ylabel="P(overturning | rocking)")
left.legend(frameon=False)
right.axvline(1.3, color="0.6", lw=0.8, ls="--")
right.set(xscale="log", yscale="log", xlabel="PGA / (g tan α)", ylabel="|θ|max / α in safe rocking", ylim=(1e-6, 2))
for axes, ticks in [(left, [0.2, 0.5, 1, 2, 4]), (right, [1, 1.3, 2, 4, 8])]:
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.spines[["top", "right"]].set_visible(False)
figure.savefig(picture)
