"""An inventory to a page, and to the pieces to anchor first. Run it where `data` is."""

from pathlib import Path

import polars as pl

import rockfrag

inventory = pl.read_csv(Path(__file__).with_name("inventory.csv"))
site = {"hazard": ["data/hazard.csv", "data/hazard_sa.csv"], "magnitude": 6.8}
rockfrag.evaluate(structures=inventory, out="inventory.html", title="Ward C", **site)

# The page is no table: this is. What is anchored or not understood has no rate.
answer = rockfrag.evaluate(structures=inventory, **site).to_polars()
print("item                  pieces  each overturns in 50 years  overturned in all")
for row in answer.sort("p_overturning", descending=True, nulls_last=True).iter_rows(named=True):
    p, low, high = (row[f"p_overturning{end}"] for end in ("", "_low", "_high"))
    known = p is not None and f"{p:6.0%} ({low:.0%} to {high:.0%}) {row['count'] * p:17.1f}"
    print(f"{row['structure']:20} {row['count']:7.0f}  {known or row['warnings']}")
