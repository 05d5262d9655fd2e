"""Runs the paper's set-up with the seeds 1 to 20 and writes data/seed_spread.csv: python
scripts/seed_spread.py ROCKFRAG

Each published number as ours has it (column `ours` of compare-paper), a row a seed. Needs pandas and pyarrow.
"""

import pathlib
import subprocess
import sys
import tempfile

import pandas as pd

rockfrag, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).resolve().parents[1]
numbers = []
with tempfile.TemporaryDirectory() as folder:
    pipeline = (root / "pipeline.yaml").read_text().replace("report: {}", "")
    (pathlib.Path(folder) / "pipeline.yaml").write_text(pipeline)
    for seed in range(1, 21):
        run = [rockfrag, "run", "--quiet", f"--seed={seed}"]
        subprocess.run(run, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        paper = pd.read_parquet(f"{folder}/out/paper.parquet").dropna(subset="ours")
        numbers.append(paper.assign(seed=seed).rename(columns={"ours": "value"}))
columns = ["quantity", "suite", "structure", "seed", "value"]
pd.concat(numbers)[columns].to_csv(root / "data/seed_spread.csv", index=False)
