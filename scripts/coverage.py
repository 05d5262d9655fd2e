"""Whether the limits that evaluate prints hold what they say, on magnitudes and distances that the fits have not seen:
python coverage.py ROCKFRAG RESPONSES.parquet [RESAMPLES [MODEL]]

Cells of magnitude and distance are drawn anew, as many as there are, and fitted; of the cells that were not drawn, the events are counted in
each cell and each band of probability. A count lies where 95 % should if its rank lies there among counts drawn with the probabilities that
evaluate says, their index shifted for the whole cell by a normal number of the width of its limits. Counts that are tied with the end of the
range lie in it by chance, so that the share is 0.95 where all is right.
"""

import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import polars as pl
from scipy.special import ndtr, ndtri

BANDS = [0.0, 0.02, 0.1, 0.3, 0.7, 0.9, 0.98, 1.0]
LEAST = 5
DRAWS = 400
QUANTITIES = {"p_ro": lambda r: r["outcome"] == "overturning", "p_ex": None, "p_f_r": lambda r: (r["outcome"] == "overturning") | (r["edp"] > 0.1)}

rockfrag, responses, *rest = sys.argv[1:]
resamples = int(rest[0]) if rest else 500
model = rest[1:2]
rockfrag = pathlib.Path(rockfrag).resolve()
rows = pl.read_parquet(responses).filter(pl.col("outcome") != "no_rocking")
cells = rows.select("mw", "re_km").unique().sort("mw", "re_km").with_row_index("cell")
rows = rows.join(cells, on=["mw", "re_km"], maintain_order="left")
rng = np.random.default_rng(5)
counted = {}


def call(folder, *arguments):
    subprocess.run([rockfrag, "--quiet", "--force", "--threads", "1", *arguments], cwd=folder, check=False, capture_output=True)


def count(key, band, cell, index, error, happened):
    for k in range(len(BANDS) - 1):
        for c in np.unique(cell[band == k]):
            here = (band == k) & (cell == c)
            if here.sum() < LEAST:
                continue
            shifted = index[here] + rng.standard_normal((DRAWS, 1)) * error[here]
            counts = (rng.random(shifted.shape) < ndtr(shifted)).sum(axis=1)
            seen = happened[here].sum()
            rank = ((counts < seen).sum() + rng.random() * (counts == seen).sum()) / DRAWS
            counted.setdefault(key, []).append((k, 0.025 < rank < 0.975))


def probits(answers, name):
    value, low, high = (np.clip(answers[f"{name}{end}"].to_numpy(), 1e-15, 1 - 1e-15) for end in ("", "_low", "_high"))
    return ndtri(value), (ndtri(high) - ndtri(low)) / (2 * 1.96)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for _ in range(resamples):
        drawn = rng.integers(0, cells.height, cells.height)
        # A cell that is drawn twice counts twice, as one cluster.
        copies = pl.DataFrame({"cell": drawn}).with_columns(pl.col("cell").cast(pl.UInt32))
        fitted = copies.join(rows, on="cell").drop("cell").with_columns(motion_id=pl.int_range(pl.len(), dtype=pl.Int64))
        left = rows.filter(~pl.col("cell").is_in(drawn.tolist()))
        fitted.write_parquet(folder / "responses.parquet")
        call(folder, "fit-pex", "--transition", "1.3")
        call(folder, "fit-pro")
        for (suite, structure), group in left.group_by("suite", "structure", maintain_order=True):
            group.write_parquet(folder / "left.parquet")
            (folder / "answers.parquet").unlink(missing_ok=True)
            asked = ["--suite", suite, "--structure", structure, *(["--model", *model] if model else [])]
            call(folder, "evaluate", *asked, "--pex", "pex.parquet", "--pro", "pro.parquet", "--in", "left.parquet", "--out", "answers.parquet")
            if not (folder / "answers.parquet").exists():
                continue
            answers = pl.read_parquet(folder / "answers.parquet")
            for quantity, event in QUANTITIES.items():
                which = np.ones(group.height, bool) if event else (group["outcome"] == "safe_rocking").to_numpy()
                happened = (event(group) if event else group["edp"] > 0.1).fill_null(True).to_numpy()[which]
                index, error = (values[which] for values in probits(answers, quantity))
                band = np.digitize(ndtr(index), BANDS[1:-1])
                count((quantity, suite, structure), band, group["cell"].to_numpy()[which], index, error, happened)

print("share of counts where 95 % should lie, by the probability said;", resamples, "resamples of cells")
print(" " * 44, "all   ", *(f"{low:g}-{high:g}".ljust(12) for low, high in zip(BANDS, BANDS[1:])))
for key, found in sorted(counted.items()):
    found = np.array(found)
    shares = [(found[:, 0] == k) for k in range(len(BANDS) - 1)]
    cells_of = [f"{found[here, 1].mean():.2f} ({here.sum()})".ljust(12) if here.sum() >= 20 else "".ljust(12) for here in shares]
    print(" ".join(key).ljust(44), f"{found[:, 1].mean():.3f}", *cells_of)
