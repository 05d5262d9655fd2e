"""Runs the paper's set-up with the seeds 1 to 20 and writes data/seed_spread.csv: python scripts/seed_spread.py ROCKFRAG

Each published number as ours has it (column `ours` of compare-paper), a row a seed. Needs nothing but the program.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile

rockfrag, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(__file__).resolve().parents[1]
numbers = []
with tempfile.TemporaryDirectory() as folder:
    pipeline = (root / "pipeline.yaml").read_text().replace("report: {}", "")
    (pathlib.Path(folder) / "pipeline.yaml").write_text(pipeline)
    for seed in range(1, 21):
        subprocess.run([rockfrag, "run", "--quiet", f"--seed={seed}"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        show = [rockfrag, "inspect", "out/paper.parquet", "--head=1000", "--format=csv"]
        rows = csv.DictReader(subprocess.run(show, cwd=folder, check=True, capture_output=True, text=True).stdout.splitlines())
        keys = ["quantity", "suite", "structure"]
        numbers += [[*(row[key] for key in keys), seed, row["ours"]] for row in rows if row["ours"]]
with open(root / "data/seed_spread.csv", "w", newline="") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["quantity", "suite", "structure", "seed", "value"])
    writer.writerows(sorted(numbers, key=lambda row: row[3]))
