"""Time and peak memory of what comes after simulate, by the number of responses, beside DuckDB and statsmodels.

    python flat.py rockfrag responses.parquet --rows 1e5 1e6 1e7 [--groups 60] [--statsmodels 1e6]

The responses are those of one structure under one suite, again and again: each copy has motions a few percent stronger or
weaker, and numbers of its own. With --groups copies go to so many structures in turns. DuckDB reads the columns that the fits read and
takes mean and covariance of their logarithms; statsmodels fits the curves alone (seven probits, no limits and tests), up to so many rows.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

MEASURES = ("im1", "im2", "im3", "im4", "im5", "im6")

DUCKDB = """
import sys, duckdb
duckdb.execute("set threads to 2")
ln = lambda m: f"ln({m})"
sums = ", ".join(f"covar_samp(ln({a}), ln({b}))" for i, a in enumerate(MEASURES) for b in MEASURES[: i + 1])
duckdb.sql(f"select structure, count(*), avg(ln(edp)), {sums} from '{sys.argv[1]}' where im4 > 1 and edp > 0 group by structure").fetchall()
"""

STATSMODELS = """
import sys, numpy as np, pyarrow.parquet as pq, statsmodels.api as sm
table = pq.read_table(sys.argv[1], columns=["outcome", *MEASURES])
outcome = table["outcome"].to_numpy(zero_copy_only=False)
rocks, over = outcome != "no_rocking", outcome == "overturning"
ln = {m: np.log(table[m].to_numpy()) for m in MEASURES}
for measures in [*((m,) for m in MEASURES), ("im4", "im3")]:
    design = sm.add_constant(np.column_stack([ln[m][rocks] for m in measures]))
    sm.Probit(over[rocks].astype(float), design).fit(disp=0)
"""


def replicate(source, out, rows, groups):
    """Writes so many responses, 100,000 or so at a time."""
    table = pq.read_table(source)
    random = np.random.default_rng(1)
    schema = table.schema.with_metadata(None)
    writer = pq.ParquetWriter(out, schema, compression="zstd", compression_level=1)
    waiting = []
    for first in range(0, rows, table.num_rows):
        some = table.slice(0, min(table.num_rows, rows - first))
        column = {name: some[name].combine_chunks() for name in some.column_names}
        pga, pgv, demand = (np.exp(size * random.standard_normal(len(some))) for size in (0.02, 0.02, 0.05))
        factors = {"pga_m_s2": pga, "im4": pga, "pgv_m_s": pgv, "im5": pgv, "im6": pgv, "im3": pga / pgv, "edp": demand}
        numbers = np.arange(first, first + len(some))
        for name, factor in factors.items():
            values = column[name].to_numpy(zero_copy_only=False)
            changed = values * factor
            if name == "im4":  # what rocks goes on to rock
                changed = np.where((values > 1) == (changed > 1), changed, values)
            column[name] = pa.array(changed, from_pandas=True)
        column["motion_id"] = pa.array(numbers)
        if groups > 1:
            column["structure"] = pa.array([f"s{first // table.num_rows % groups}"] * len(some))
        waiting.append(pa.table(list(column.values()), schema=schema))
        if len(waiting) * table.num_rows >= 100_000 or first + len(some) == rows:
            writer.write_table(pa.concat_tables(waiting), row_group_size=len(waiting) * table.num_rows)
            waiting = []
    writer.close()


def measured(*command):
    """Wall time (s), processor time (s) and peak memory (MB) of a command; of its own, since a fork counts the memory of Python."""
    command = ["/usr/bin/time", "-f", "%e %U %S %M", *(str(word) for word in command)]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    wall, user, system, peak = map(float, done.stderr.split("\n")[-2].split())
    return wall, user + system, peak / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rockfrag")
    parser.add_argument("responses")
    parser.add_argument("--rows", nargs="+", type=float, default=[1e5, 1e6])
    parser.add_argument("--groups", type=int, default=1)
    parser.add_argument("--stages", nargs="+", default=["fit-pex", "fit-pro", "validate"])
    parser.add_argument("--statsmodels", type=float, default=0, metavar="ROWS")
    parser.add_argument("--folder", help="where the files go while it runs")
    given = parser.parse_args()
    print(f"{'rows':>10} {'':12} {'wall s':>8} {'cpu s':>8} {'peak MB':>8} {'us a row':>8}")
    with tempfile.TemporaryDirectory(dir=given.folder) as folder:
        folder = pathlib.Path(folder)
        for rows in map(int, given.rows):
            file = folder / "responses.parquet"
            replicate(given.responses, file, rows, given.groups)
            fits = ("--pex", folder / "pex.parquet", "--pro", folder / "pro.parquet")
            commands = {
                stage: (given.rockfrag, "--quiet", stage, "--in", folder if stage == "report" else file)
                + (fits if stage == "validate" else ("--reference", "s0") if stage == "universality" else ())
                for stage in given.stages
            }
            python = lambda code: (sys.executable, "-c", f"MEASURES = {MEASURES}\n{code}", file)
            commands["duckdb"] = python(DUCKDB)
            if rows <= given.statsmodels:
                commands["statsmodels"] = python(STATSMODELS)
            for name, command in commands.items():
                wall, cpu, peak = measured(*command)
                print(f"{rows:10} {name:12} {wall:8.2f} {cpu:8.2f} {peak:8.0f} {1e6 * cpu / rows:8.2f}", flush=True)
            for stale in folder.iterdir():
                stale.unlink() if stale.is_file() else None


if __name__ == "__main__":
    main()
