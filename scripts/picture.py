"""Draws docs/surface.png: picture.py FILE. Needs the Python package, polars and matplotlib."""

import sys

import matplotlib.pyplot as plt
import numpy as np
import polars as pl

import rockfrag

EQUIPMENT = {"p": 2.5, "alpha": 0.20, "eta": 0.92}
BLUE, ORANGE = "#0072b2", "#d55e00"


def responses(seed):
    """Responses to the paper's combined motions of a seed."""
    motions = rockfrag.synthesize_motions(rockfrag.sample_scenarios(seed=seed), suite="csgm", seed=seed)
    return rockfrag.simulate(motions, **EQUIPMENT)


fitted, unseen = responses(42), responses(7).to_polars().filter(pl.col("outcome") != "no_rocking")
folder, edges = fitted.path.parent, [0.02, 0.05, *np.arange(0.1, 1.0, 0.1)]
rockfrag.fit_pex(fitted, out=folder / "pex.parquet"), rockfrag.fit_pro(fitted, out=folder / "pro.parquet")
plt.rcParams.update({"font.size": 10, "axes.spines.top": False, "axes.spines.right": False})
left, right = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained")[1]
for outcome, colour, label in [("safe_rocking", BLUE, "rocks"), ("overturning", ORANGE, "overturns")]:
    some = unseen.filter(pl.col("outcome") == outcome)
    left.plot(some["pga_m_s2"] / 9.81, some["pgv_m_s"], "o", ms=2.5, mew=0, alpha=0.5, color=colour, label=label)
pga, pgv = np.meshgrid(np.geomspace(0.204, 2.0, 120), np.geomspace(0.05, 2.5, 120))
# Less PGV is refused.
possible, p_ro = pgv > 0.05 * pga, np.full(pga.shape, np.nan)
p_ro[possible] = rockfrag.Object(**EQUIPMENT, fits=folder).probability(pga[possible], pgv[possible]).p_overturning
lines = left.contour(pga, pgv, p_ro, [0.02, 0.1, 0.5, 0.9], colors="black", linewidths=1)
left.clabel(lines, fmt="%g")
left.set(xscale="log", yscale="log", xlabel="PGA (g)", ylabel="PGV (m/s)", xlim=(0.2, 2), ylim=(0.05, 2.5))
for axis in (left.xaxis, left.yaxis):
    axis.set_major_formatter("{x:g}"), axis.set_minor_formatter("")
left.set_xticks([0.2, 0.5, 1, 2]), left.set_yticks([0.05, 0.1, 0.2, 0.5, 1, 2])
left.legend(frameon=False, loc="lower right")
right.plot([0, 1], [0, 1], color="grey", lw=1)
peaks = unseen["pga_m_s2"].to_numpy() / 9.81, unseen["pgv_m_s"].to_numpy()
for options, style, label in [({"suite": "csgm"}, "s", "surface"), ({"fits": folder}, "o", "surface, calibrated")]:
    asked = rockfrag.Object(**EQUIPMENT, **options)
    cases = unseen.with_columns(p=asked.probability(*peaks).p_overturning)
    bins = cases.group_by(pl.col("p").cut(edges).alias("bin")).agg(
        pl.col("p").mean(), n=pl.len(), share=(pl.col("outcome") == "overturning").mean()
    ).filter(pl.col("n") >= 10)  # fmt: skip
    error = ((bins["share"] * (1 - bins["share"])).clip(0.01) / bins["n"]).sqrt()
    right.errorbar(bins["p"], bins["share"], error, fmt=style, color={"s": BLUE, "o": ORANGE}[style], label=label)
right.set(xlabel="predicted probability of overturning", ylabel="share that overturned")
right.legend(frameon=False)
plt.savefig(sys.argv[1], dpi=130)
