"""The paper's set-up with the seeds 1 to 20, and what the published planes are beside them: python
scripts/seed_spread.py ROCKFRAG

Writes core/data/seed_spread.csv, each published number as ours has it (column `ours` of compare-paper), a row a seed; and the
columns t2 and t2_p of core/data/paper.csv: Hotelling's T2 of each published plane of Table II about ours over seeds, whether
its four printed numbers (ln a, b1, b2, R2), which depend on each other, could be those of one more seed. The rounding of
the print counts as an error of variance width^2 / 12. T2 (n - k) / (k (n - 1)) of k numbers and n seeds is F with k and
n - k degrees of freedom (Hotelling 1931, Annals of Mathematical Statistics 2, 360-378). Needs pandas, pyarrow and scipy.
"""

import pathlib
import sys
import tempfile

import numpy as np
import pandas as pd
from scipy import stats

from common import ROOT, call

rockfrag, numbers = pathlib.Path(sys.argv[1]).resolve(), []
with tempfile.TemporaryDirectory() as folder:
    pipeline = (ROOT / "pipeline.yaml").read_text().replace("report: {}", "")
    (pathlib.Path(folder) / "pipeline.yaml").write_text(pipeline)
    for seed in range(1, 21):
        call(rockfrag, "run", f"--seed={seed}", folder=folder)
        ours = pd.read_parquet(f"{folder}/out/paper.parquet").dropna(subset="ours")
        numbers.append(ours.assign(seed=seed).rename(columns={"ours": "value"}))
seeds = pd.concat(numbers)[["quantity", "suite", "structure", "seed", "value"]]
seeds.to_csv(ROOT / "core/data/seed_spread.csv", index=False)

paper = pd.read_csv(ROOT / "core/data/paper.csv", dtype=str, keep_default_na=False)
ours = seeds.pivot(index=["suite", "structure", "seed"], columns="quantity", values="value")
published = paper.set_index(["suite", "structure", "quantity"]).sort_index()
paper[["t2", "t2_p"]] = ""
for row in paper[paper.quantity.isin(["low_plane", "high_plane"])].itertuples():
    quantities = [row.quantity.replace("plane", number) for number in ("ln_a", "b1", "b2", "r2")]
    prints = published.loc[row.suite, row.structure].loc[quantities, ["published", "print_low", "print_high"]]
    values, low, high = prints.astype(float).to_numpy().T
    of_seeds = ours.loc[row.suite, row.structure][quantities]
    n, k = of_seeds.shape
    # One more seed and the mean of ours: (1 + 1/n) times the covariance of one.
    covariance = of_seeds.cov() * (1 + 1 / n) + np.diag(np.square(high - low) / 12)
    difference = values - of_seeds.mean().to_numpy()
    t2 = difference @ np.linalg.solve(covariance, difference)
    p = stats.f.sf(t2 * (n - k) / (k * (n - 1)), k, n - k)
    paper.loc[row.Index, ["t2", "t2_p"]] = repr(float(t2)), repr(float(p))
paper.to_csv(ROOT / "core/data/paper.csv", index=False)
