"""Keeps what matters of universality.parquet as CSV: python universality_summary.py IN.parquet OUT.csv (make universality). A first line
after # says what made it."""

import sys

import polars as pl

COLUMNS = [
    "suite", "event", "structure", "p_rad_s", "alpha_rad", "eta", "n", "seen", "expected", "chance_low", "chance_high",
    "calibration", "calibration_slope", "log_score_own", "log_score_transferred", "loss", "se_loss", "log_score_share", "share_lost",
    "mean_error", "worst_over", "worst_under", "log_score_line", "log_score_curved", "log_score_restitution",
    "log_score_structure", "status", "verdict",
]  # fmt: skip

version = pl.read_parquet_metadata(sys.argv[1])["rockfrag.version"]
with open(sys.argv[2], "w") as out:
    out.write(f"# rockfrag {version}: make universality (rockfrag run data/universality.yaml, seed 42)\n")
    pl.read_parquet(sys.argv[1]).select(COLUMNS).write_csv(out, float_precision=4)
