"""Rates on floors, predicted over counted: python rates.py ROCKFRAG AT2_FOLDER COMPONENTS.csv FOLDER [yielding]

Every fourth component scaled to PGA of .1 to 1.6 g, filtered to ten floors; twelve objects; a hazard that falls with the
power 2.2 of PGA. With the yielding beams of `yielding` too where numba is installed."""

import pathlib
import subprocess
import sys

import numpy as np
import polars as pl

import motions

FLOORS = [(t, z) for t in (0.2, 0.4, 0.7, 1.1, 1.8) for z in (0.5, 1.0)]
STRONGEST_M_S = 5.0
LEVELS_G = np.geomspace(0.1, 1.6, 8)
OBJECTS = [(0.3, 0.9), (0.3, 1.2), (0.4, 1.6), (0.5, 1.8), (0.6, 1.8), (0.6, 2.2), (0.8, 2.2), (0.8, 2.6), (1.0, 3.0), (1.2, 4.0), (0.25, 0.8), (0.45, 2.0)]


def write(path, ids, steps, samples):
    pl.DataFrame({"motion_id": ids, "dt_s": steps, "acceleration_m_s2": samples}, schema_overrides={"acceleration_m_s2": pl.List(pl.Float32)}).write_parquet(path)


def rate(p_of_levels):
    edges = np.append(LEVELS_G**-2.2, 0.0)
    return -(np.diff(edges) * p_of_levels).sum()


def main():
    rockfrag, at2, components, folder = sys.argv[1:5]
    floors_of = motions.floors if len(sys.argv) < 6 else __import__("yielding").floors
    folder = pathlib.Path(folder)
    folder.mkdir(exist_ok=True)
    call = lambda *arguments: subprocess.run([rockfrag, *map(str, arguments), "--quiet", "--force"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    records = list(motions.records(at2, components))[::4]
    ground, rows = [], []
    for number, (name, _, mw, a, dt) in enumerate(records):
        for k, level in enumerate(LEVELS_G):
            scaled = a * level * 9.81 / np.abs(a).max()
            pga, pgv = motions.peaks(scaled, dt)
            if pgv > STRONGEST_M_S:
                continue
            ground.append((scaled, float(dt)))
            rows.append((f"{number}-{k}", k, pga, pgv, mw))
    pl.DataFrame(rows, ["motion_id", "k", "pga_m_s2", "pgv_m_s", "mw"], orient="row").write_parquet(folder / "peaks.parquet")
    pl.DataFrame({"name": [f"o{i}" for i in range(len(OBJECTS))], "width": [w for w, _ in OBJECTS], "height": [h for _, h in OBJECTS]}).write_csv(folder / "objects.csv")
    k_of = np.array([row[1] for row in rows])
    logs = {"floor": [], "ground": []}
    for period, z in FLOORS:
        samples = [floors_of(np.concatenate([a, np.zeros(int(10 / dt))]), dt, period, [z])[0].astype(np.float32) for a, dt in ground]
        write(folder / "floor.parquet", [row[0] for row in rows], [dt for _, dt in ground], samples)
        call("simulate", "--in", folder / "floor.parquet", "--structures", folder / "objects.csv", "--out", folder / "responses.parquet")
        responses = pl.read_parquet(folder / "responses.parquet")
        for i, (width, height) in enumerate(OBJECTS):
            of = responses.filter(pl.col("structure") == f"o{i}")
            fell = dict(zip(of["motion_id"].cast(str), of["outcome"].cast(str) == "overturning"))
            counted = rate([np.mean([fell[row[0]] for row in rows if row[1] == k]) for k in range(len(LEVELS_G))])
            for which, place in (("floor", ("--period", period, "--level", z)), ("ground", ())):
                call("evaluate", "--in", folder / "peaks.parquet", "--width", width, "--height", height, *place, "--out", folder / "p.parquet")
                p = pl.read_parquet(folder / "p.parquet")
                p = (p["p_ro"].fill_null(0.0) * (1 - p["p_nr"])).to_numpy()
                predicted = rate([p[k_of == k].mean() for k in range(len(LEVELS_G))])
                logs[which].append((np.log(predicted / counted) if counted > 0 else np.nan, period, z))
        here = [log for log, t, level in logs["floor"] if (t, level) == (period, z)]
        print(period, z, "predicted over counted:", " ".join(f"{np.exp(log):.2f}" for log in here), flush=True)
    for which, of in logs.items():
        log = np.array([log for log, *_ in of if np.isfinite(log)])
        print(f"{which}: rms ln {np.sqrt(np.mean(log**2)):.2f}, median {np.exp(np.median(log)):.2f}, within 1.5 {np.mean(abs(log) < np.log(1.5)):.2f}, within 2 {np.mean(abs(log) < np.log(2)):.2f}, worst {np.exp(abs(log).max()):.1f}, n {len(log)}")


if __name__ == "__main__":
    main()
