"""Quad-precision answers for a motions file: python rocking.py MOTIONS.parquet ANSWERS.csv P:ALPHA:ETA ...

Builds rocking.cpp (g++ with libquadmath) and runs it on every motion and structure. Needs pyarrow.
"""

import pathlib
import subprocess
import sys
import tempfile

import pyarrow.parquet as pq

motions_file, answers_file, *structures = sys.argv[1:]
source = pathlib.Path(__file__).with_name("rocking.cpp")
motions = pq.read_table(motions_file, columns=["motion_id", "dt_s", "acceleration_m_s2"])

lines = [str(len(structures))]
lines += [" ".join(float(part).hex() for part in structure.split(":")) for structure in structures]
lines.append(str(motions.num_rows))
for name, dt, samples in zip(*(column.to_pylist() for column in motions.columns)):
    values = " ".join(float(sample).hex() for sample in samples)
    lines.append(f"{name} {float(dt).hex()} {len(samples)} {values}".replace("\n", " "))

with tempfile.TemporaryDirectory() as folder:
    program = pathlib.Path(folder) / "rocking"
    subprocess.run(["g++", "-std=gnu++17", "-O2", source, "-o", program, "-lquadmath"], check=True)
    done = subprocess.run([program], input="\n".join(lines), text=True, capture_output=True, check=True)
pathlib.Path(answers_file).write_text(done.stdout)
