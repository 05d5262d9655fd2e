"""What the checks of exports share: the structure, and our probabilities of reaching LS1, LS2 and LS3 along one peak.

Called with ROCKFRAG OUT, the program and the folder of the paper's run.
"""

import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import pyarrow.parquet as pq

G = 9.81
P, ALPHA, ETA = 2.5, 0.20, 0.92
UPLIFT_G = math.tan(ALPHA)
NODES = [-5 + 0.01 * k for k in range(1001)]
WEIGHTS = [0.01 * math.exp(-(z**2) / 2) / math.sqrt(2 * math.pi) for z in NODES]

rockfrag, out = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
fits = [f"--fits={out}", "--suite=csgm", f"--p={P}", f"--alpha={ALPHA}", f"--eta={ETA}"]


def run(subcommand, *arguments):
    """What rockfrag prints."""
    call = [rockfrag, subcommand, *fits, *map(str, arguments), "--quiet"]
    return subprocess.run(call, check=True, capture_output=True, text=True).stdout


def ratio_given(peak):
    """Intercept, slope and standard deviation of ln(PGV/PGA) given ln of a peak, pga (m/s2) or pgv (m/s)."""
    rows = pq.read_table(out / "pro.calibration.parquet").to_pylist()
    return next(row for row in rows if row["suite"] == "csgm" and row["p_rad_s"] == P)[f"ratio_given_{peak}"]


def reached(peak, intensities):
    """Our probabilities at intensities (PGA in g or PGV in m/s): those of `evaluate`, averaged over PGV/PGA."""
    intercept, slope, sd = ratio_given(peak)
    with tempfile.TemporaryDirectory() as folder:
        table, answers = (pathlib.Path(folder) / name for name in ("points.csv", "answers.csv"))
        lines = ["pga_m_s2,pgv_m_s"]
        for intensity in intensities:
            own = intensity * G if peak == "pga" else intensity
            for z in NODES:
                ratio = math.exp(intercept + slope * math.log(own) + sd * z)
                lines.append(f"{own!r},{own * ratio!r}" if peak == "pga" else f"{own / ratio!r},{own!r}")
        table.write_text("\n".join(lines) + "\n")
        run("evaluate", f"--in={table}", f"--out={answers}", "--progress=never")
        rows = list(csv.DictReader(answers.open()))
    number = lambda text: float(text) if text else 0.0
    states = [(1 - float(row["p_nr"]), number(row["p_f"]), (1 - float(row["p_nr"])) * number(row["p_ro"])) for row in rows]
    means = lambda part: [sum(w * state[k] for w, state in zip(WEIGHTS, part)) for k in range(3)]
    return [means(states[at : at + len(NODES)]) for at in range(0, len(states), len(NODES))]
