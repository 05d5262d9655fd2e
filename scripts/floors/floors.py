"""Motions on floors: python floors.py AT2.parquet OUT.parquet

Each component at eight floors of buildings drawn (T1 log-uniform .1 to 3 s, level uniform .1 to 1), .5 to 2.5
times as strong; its id is NAME|earthquake|magnitude|PGA|PGV of the ground|T1|level."""

import sys

import numpy as np
import polars as pl

import motions

imported, out = sys.argv[1:]
rng = np.random.default_rng(42)


def on_floors():
    for name, earthquake, mw, ground, dt in motions.records(imported):
        for _ in range(8):
            period, level = np.exp(rng.uniform(np.log(0.1), np.log(3.0))), rng.uniform(0.1, 1.0)
            a = np.exp(rng.uniform(np.log(0.5), np.log(2.5))) * ground
            pga, pgv = motions.peaks(a, dt)
            a = motions.rested(a, dt, 3 * period / (2 * np.pi * 0.05))
            motion_id = f"{name}|{earthquake}|{mw}|{pga:.6g}|{pgv:.6g}|{period:.6g}|{level:.6g}"
            yield motion_id, float(dt), mw, motions.floors(a, dt, period, [level])[0].astype(np.float32)


columns = dict(zip(["motion_id", "dt_s", "mw", "acceleration_m_s2"], zip(*on_floors())))
pl.DataFrame(columns).write_parquet(out)
