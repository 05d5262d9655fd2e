"""The paper's set-up with the seeds 1 to 20: python scripts/seed_spread.py ROCKFRAG

Writes core/data/seed_spread.csv, each published number as ours has it (column `ours` of compare-paper), a row a seed.
compare-paper tests what is published against their mean. Needs pandas and pyarrow.
"""

import pathlib
import sys
import tempfile

import pandas as pd

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
