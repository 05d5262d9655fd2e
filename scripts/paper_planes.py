"""Hotelling's T2 of each published plane of Table II about ours over seeds: python scripts/paper_planes.py

Reads data/seed_spread.csv (ours, a value a seed) and writes the columns t2 and t2_p of data/paper.csv, in the rows low_plane and
high_plane: whether the four printed numbers (ln a, b1, b2, R2), which depend on each other, could be those of one more seed. The
rounding of the print counts as an error of variance width^2 / 12. T2 (n - k) / (k (n - 1)) of k numbers and n seeds is F with k and
n - k degrees of freedom (Hotelling 1931, Annals of Mathematical Statistics 2, 360-378). Needs numpy and scipy.
"""

import csv
import pathlib

import numpy as np
from scipy import stats

data = pathlib.Path(__file__).parent.parent / "data"
with open(data / "paper.csv", newline="") as file:
    rows = list(csv.DictReader(file))
with open(data / "seed_spread.csv", newline="") as file:
    seeds = list(csv.DictReader(line for line in file if not line.startswith("#")))


def find(quantity, row):
    return next(r for r in rows if (r["quantity"], r["suite"], r["structure"]) == (quantity, row["suite"], row["structure"]))


def over_seeds(quantity, row):
    key = (quantity, row["suite"], row["structure"])
    values = [s for s in seeds if (s["quantity"], s["suite"], s["structure"]) == key]
    return [float(s["value"]) for s in sorted(values, key=lambda s: int(s["seed"]))]


for row in rows:
    row["t2"] = row["t2_p"] = ""
    side, _, rest = row["quantity"].partition("_")
    if rest != "plane":
        continue
    quantities = [f"{side}_{number}" for number in ("ln_a", "b1", "b2", "r2")]
    printed = [find(quantity, row) for quantity in quantities]
    ours = np.array([over_seeds(quantity, row) for quantity in quantities])
    k, n = ours.shape
    rounding = [float(p["print_high"]) - float(p["print_low"]) for p in printed]
    # One more seed and the mean of ours: (1 + 1/n) times the covariance of one.
    covariance = np.cov(ours) * (1 + 1 / n) + np.diag(np.square(rounding) / 12)
    difference = np.array([float(p["published"]) for p in printed]) - ours.mean(axis=1)
    t2 = difference @ np.linalg.solve(covariance, difference)
    row["t2"] = repr(float(t2))
    row["t2_p"] = repr(float(stats.f.sf(t2 * (n - k) / (k * (n - 1)), k, n - k)))

with open(data / "paper.csv", "w", newline="") as file:
    writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
