"""Motions on floors: python floors.py AT2_FOLDER COMPONENTS.csv OUT.parquet

Each component at eight floors of buildings drawn (T1 log-uniform .1 to 3 s, level uniform .1 to 1), .5 to 2.5 times as
strong; its id is NAME|earthquake|magnitude|PGA|PGV of the ground|T1|level."""

import sys

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

import motions

FLOORS = 8


def main():
    folder, components, out = sys.argv[1:]
    rng = np.random.default_rng(42)
    writer = None
    for name, earthquake, mw, ground, dt in motions.records(folder, components):
        ids, samples = [], []
        for _ in range(FLOORS):
            period, level = np.exp(rng.uniform(np.log(0.1), np.log(3.0))), rng.uniform(0.1, 1.0)
            a = np.exp(rng.uniform(np.log(0.5), np.log(2.5))) * ground
            pga, pgv = motions.peaks(a, dt)
            rest = np.zeros(int(3 * period / (2 * np.pi * 0.05) / dt))
            samples.append(motions.floors(np.concatenate([a, rest]), dt, period, [level])[0].astype(np.float32))
            ids.append(f"{name}|{earthquake}|{mw}|{pga:.6g}|{pgv:.6g}|{period:.6g}|{level:.6g}")
        table = pa.table({"motion_id": ids, "dt_s": [float(dt)] * len(ids), "mw": [mw] * len(ids), "acceleration_m_s2": samples})
        writer = writer or pq.ParquetWriter(out, table.schema, compression="zstd")
        writer.write_table(table)
    writer.close()


if __name__ == "__main__":
    main()
