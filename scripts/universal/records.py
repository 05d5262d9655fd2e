"""Tests the surface that is shipped on responses to records, for the tables of docs/universal.md:
python records.py MOTIONS EQUIPMENT RESPONSES..."""

import sys
from pathlib import Path

import numpy as np

import cases as of
import surface
import write
from judge import EVENTS, NAMES, equipment_curves, event

SHIPPED = Path(__file__).parents[2] / "data/universal.csv"


def main():
    motions, equipment, *files = sys.argv[1:]
    of_equipment = equipment_curves(equipment, motions)
    shipped, knots, _, _ = write.read(SHIPPED)
    curve = {name: surface.Curve([term for term, _ in terms], knots, np.array([b[0] for _, b in terms])) for name, terms in shipped.items()}
    print(f"{'':40} {'cases':>6} {'observed':>8} {'expected':>8}   log score, of the plain share, of the equipment's curve")
    for file in files:
        every = of.read([file], None)
        for limit in EVENTS:
            cases = every if limit is None else of.some(every, ~every["overturned"])
            happened = event(cases, limit)
            p = 1 / (1 + np.exp(-curve["pro" if limit is None else "pex"].index(of.columns_of(cases, limit or 0.2))))
            share, equipment = np.full(len(p), happened.mean()), of_equipment(cases, limit)
            score = lambda p: np.where(happened, np.log(p), np.log1p(-p)).mean()
            scores = " ".join(f"{score(np.clip(q, 1e-6, 1 - 1e-6)):7.3f}" for q in (p, share, equipment))
            print(f"{Path(file).stem + ' ' + NAMES[limit]:40} {len(p):6} {happened.sum():8} {p.sum():8.0f}   {scores}")


if __name__ == "__main__":
    main()
