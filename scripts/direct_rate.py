"""The annual rate of overturning without any curve: python direct_rate.py HAZARD.csv RESPONSES.parquet...

The motions of the responses are weighted so that their PGA has the hazard's rates. So many a year overturn the structure. Limits: cells of
magnitude and distance drawn anew, 500 times. Motions stronger than the strongest bin count as this.
"""

import sys

import numpy as np
import polars as pl

BINS = 40
G = 9.81

hazard, *files = sys.argv[1:]
points = np.array([line.split(",") for line in open(hazard) if line[0].isdigit()], float)
ln_rate = lambda pga_g: np.interp(np.log(pga_g), *np.log(points).T)
rows = pl.concat([pl.read_parquet(file).with_columns(seed=pl.lit(k)) for k, file in enumerate(files)])
rows = rows.filter((pl.col("suite") == "csgm") & (pl.col("structure") != "frame"))
pga = rows["pga_m_s2"].to_numpy() / G
uplift = np.tan(rows["alpha_rad"][0])
overturned = (rows["outcome"] == "overturning").to_numpy()
cell = rows.select(pl.struct("mw", "re_km").rank("dense"))["mw"].to_numpy() - 1

edges = np.quantile(pga[pga >= uplift], np.linspace(0, 1, BINS + 1))
edges[0] = uplift
bin_of = np.clip(np.digitize(pga, edges) - 1, -1, BINS - 1)
bin_of[pga < uplift] = -1
above = np.append(np.exp(ln_rate(edges[:-1])), 0.0)
rate_of_bin = above[:-1] - above[1:]
counts = np.zeros((2, cell.max() + 1, BINS))
rocks = bin_of >= 0
np.add.at(counts[0], (cell[rocks], bin_of[rocks]), 1)
np.add.at(counts[1], (cell[rocks], bin_of[rocks]), overturned[rocks])


def rate(weights):
    n, happened = (weights @ part for part in counts)
    return (rate_of_bin * happened / np.maximum(n, 1e-9)).sum()


rng = np.random.default_rng(1)
cells = counts.shape[1]
drawn = [rate(np.bincount(rng.integers(0, cells, cells), minlength=cells)) for _ in range(500)]
each = [rate_of_bin @ (counts[1].sum(0) / counts[0].sum(0))]
low, high = np.quantile(drawn, [0.025, 0.975])
print(f"{len(rows)} motions, up to {pga.max():.2f} g: {each[0]:.3e} a year ({low:.2e} to {high:.2e} with cells drawn anew)")
