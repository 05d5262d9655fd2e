"""Which options of the pipeline bring the planes of combined motions nearer to Table II, without touching any of them.

    python scripts/paper_options.py target/release/rockfrag FOLDER [SEEDS]

Runs each variant below with a few seeds (3; a quarter of an hour of one core) and prints for each of the four planes Hotelling's T2 of the
published ln a, b1, b2 and R2 about the mean of the variant, by the covariance of data/seed_spread.csv and the rounding of data/paper.csv:
some 5 is chance, 30 is not. FOLDER keeps the responses, so that what was run is not run again. Needs numpy and polars.
"""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
import polars as pl

PROGRAM, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
SEEDS = range(1, 1 + int(sys.argv[3] if len(sys.argv) > 3 else 3))
DATA = Path(__file__).resolve().parent.parent / "data"
NUMBERS = ["ln_a", "b1", "b2", "r2"]
PLANES = [(structure, side) for structure in ("frame", "electrical-equipment") for side in ("low", "high")]

# Each variant: what differs from pipeline.yaml in the options of sample-scenarios, synthesize-motions and fit-pex, and in the structures.
MOTIONS = [
    "--dt 0.01", "--dt 0.02", "--difference signed", "--difference clamp", "--difference none", "--epoch pga", "--epoch pgv",
    "--site soil", "--site none", "--kappa 0.02", "--kappa 0.04", "--kappa 0.05", "--fmax 10", "--fmax 15", "--fmax 10 --kappa 0.01",
    "--fmax 15 --kappa 0.01", "--fmax 15 --kappa 0.04", "--low-cut 0.2",
]  # fmt: skip
TOGETHER = [
    f"{difference}{epoch}{kappa}{fmax}"
    for difference in ("", " --difference clamp")
    for epoch in ("", " --epoch pga")
    for kappa in ("", " --kappa 0.02")
    for fmax in (" --fmax 15", " --fmax 20", " --fmax 30")
    if difference or epoch or kappa
]
VARIANTS = (
    [{}]
    + [{"pex": f"--demand-floor {floor}"} for floor in ("1e-7", "1e-6", "1e-5", "1e-4")]
    + [{"motions": options} for options in MOTIONS]
    + [{"scenarios": options} for options in ("--re 2.5:17.5:2.5", "--re 7.5:22.5:2.5", "--design random")]
    + [{"structures": structures} for structures in ((0.149, 0.19, 0.92), (0.15, 0.20, 0.90), (0.15, 0.20, 0.94))]
    + [{"motions": options.strip()} for options in TOGETHER]
    + [{"motions": options.strip(), "pex": "--demand-floor 1e-6"} for options in MOTIONS + TOGETHER]
)


def run(folder, stage, options, produces):
    if not (folder / produces).exists():
        command = [PROGRAM, stage, "--quiet", "--threads", "1", *options.split()]
        subprocess.run(command, cwd=folder, check=True, capture_output=True)


def planes(seed, variant):
    """The numbers of the four planes with a seed."""
    scenarios, motions, pex = (variant.get(stage, "") for stage in ("scenarios", "motions", "pex"))
    frame, equipment, eta = variant.get("structures", (0.15, 0.20, 0.92))
    name = f"{seed} {scenarios} {motions} {frame} {equipment} {eta}".replace(" ", "_").replace(":", "-")
    folder = FOLDER / name
    folder.mkdir(parents=True, exist_ok=True)
    text = f"name,p,alpha,eta\nframe,1.0,{frame},{eta}\nelectrical-equipment,2.5,{equipment},{eta}\n"
    (folder / "structures.csv").write_text(text)
    if not (folder / "responses.parquet").exists():
        run(folder, "sample-scenarios", f"--seed {seed} --out scenarios.parquet {scenarios}", "scenarios.parquet")
        run(folder, "synthesize-motions", f"--in scenarios.parquet --suite csgm --seed {seed} {motions}", "motions.parquet")
        run(folder, "simulate", "--in motions.parquet --structures structures.csv", "responses.parquet")
        (folder / "motions.parquet").unlink()
    fits = folder / f"pex{pex.replace(' ', '_')}.parquet"
    run(folder, "fit-pex", f"--in responses.parquet --out {fits.name} --transition 1.3 {pex}", fits.name)
    rows = pl.read_parquet(fits).filter(pl.col("model") == "biplanar").rows(named=True)
    row = {(row["structure"], "high" if row["range_high"] is None else "low"): row for row in rows}
    return {plane: [row[plane][number] for number in NUMBERS] for plane in PLANES}


def uncommented(path):
    return csv.DictReader(line for line in path.open() if not line.startswith("#"))


def main():
    spread, published = {}, {}
    for row in uncommented(DATA / "seed_spread.csv"):
        spread.setdefault((row["quantity"], row["suite"], row["structure"]), []).append(float(row["value"]))
    for row in uncommented(DATA / "paper.csv"):
        published[row["quantity"], row["suite"], row["structure"]] = row
    print(f"{'':76}" + "".join(f"{structure[:5]} {side:6}" for structure, side in PLANES))
    for variant in VARIANTS:
        name = " ".join(str(options) for options in variant.values()) or "as shipped"
        seeds = [planes(seed, variant) for seed in SEEDS]
        t2s = []
        for plane in PLANES:
            structure, side = plane
            keys = [(f"{side}_{number}", "csgm", structure) for number in NUMBERS]
            rows = [published[key] for key in keys]
            rounding = [float(row["print_high"]) - float(row["print_low"]) for row in rows]
            covariance = (1 + 1 / len(seeds)) * np.cov([spread[key] for key in keys]) + np.diag(np.square(rounding) / 12)
            off = [float(row["published"]) for row in rows] - np.mean([seed[plane] for seed in seeds], axis=0)
            t2s.append(off @ np.linalg.solve(covariance, off))
        print(f"{name:76}" + "".join(f"{t2:<12.1f}" for t2 in t2s), flush=True)


main()
