"""What the peers share: reading motions, constants and tail of the rocking problem, judging responses.

A peer is a Python program that does the work of one stage the way a careful Python programmer would write it
for speed. Each prints one JSON object with its figures.
"""

import argparse
import csv
import dataclasses
import json
import math
import platform
import time

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

G = 9.81  # m/s2
REST_VELOCITY = 1e-6  # after an impact, a velocity below this share of p counts as none
HALF_PI = 0.5 * math.pi


@dataclasses.dataclass(frozen=True)
class Structure:
    """Frequency parameter (rad/s), slenderness (rad) and coefficient of restitution."""

    p: float
    alpha: float
    eta: float


@dataclasses.dataclass
class Motion:
    """A ground motion: its accelerations over g, `dt` seconds apart."""

    motion_id: object
    dt: float
    ground: np.ndarray


@dataclasses.dataclass
class Response:
    """Outcome, |theta|max / alpha and the impacts within the record."""

    outcome: str
    edp: float
    impacts: int


def rocking_arguments(description):
    """The command line of a rocking peer: which motions, which structure, where to write."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("motions", help="Parquet file with motion_id, dt_s and acceleration_m_s2")
    parser.add_argument("--out", help="responses to write, Parquet or CSV by the ending")
    parser.add_argument("--ids", nargs="*", default=[], help="motions by their id")
    parser.add_argument(
        "--count", type=int, help="so many motions, evenly spaced over the file (default: all)"
    )
    parser.add_argument("--p", type=float, default=2.5, help="frequency parameter, rad/s")
    parser.add_argument("--alpha", type=float, default=0.20, help="slenderness, rad")
    parser.add_argument("--eta", type=float, default=0.92, help="coefficient of restitution")
    parser.add_argument(
        "--answers", help="CSV of exact responses to compare with, as in tests/reference/rocking"
    )
    return parser


def read_motions(path, ids=(), count=None):
    """The motions of these ids, else `count` evenly spaced ones, else all."""
    table = pq.read_table(path, columns=["motion_id", "dt_s", "acceleration_m_s2"])
    if ids:
        names = [str(name) for name in table["motion_id"].to_pylist()]
        missing = set(ids).difference(names)
        if missing:
            raise SystemExit(f"{path}: no motion {', '.join(sorted(missing))}")
        table = table.take([names.index(name) for name in ids])
    elif count:
        table = table.take(np.unique(np.linspace(0, table.num_rows - 1, count).round().astype(int)))
    columns = zip(table["motion_id"].to_pylist(), table["dt_s"].to_pylist(), table["acceleration_m_s2"])
    return [
        Motion(name, dt, samples.values.to_numpy(zero_copy_only=False).astype(float) / G)
        for name, dt, samples in columns
    ]


def free_rocking(rotation, velocity, alpha, eta):
    """Whether a structure that leaves the record in this state overturns, and its largest rotation to come.

    The velocity is per unit of p t. Between impacts v^2/2 + cos(alpha - r) is constant; an impact leaves
    eta^2 of the kinetic energy.
    """
    energy = 0.5 * velocity**2 + 2.0 * math.sin(alpha - 0.5 * rotation) * math.sin(0.5 * rotation)
    barrier = 2.0 * math.sin(0.5 * alpha) ** 2
    if rotation > alpha and (velocity >= 0.0 or energy <= barrier):
        return True, HALF_PI
    if velocity < 0.0:
        energy *= eta**2
    if energy > barrier:
        return True, HALF_PI
    # cos(alpha - r) = cos(alpha) + energy, without cancellation for small r.
    a = math.sin(0.5 * alpha)
    b = math.sqrt(max(a * a - 0.5 * energy, 0.0))
    sine = 0.5 * energy / (a * math.sqrt(1.0 - b * b) + b * math.sqrt(1.0 - a * a))
    return False, 2.0 * math.asin(min(sine, 1.0))


def peak_between(r0, v0, r1, v1, h):
    """The largest rotation over a step of length h, of the states at its ends (cubic Hermite)."""
    largest = max(r0, r1)
    if v0 > 0.0 > v1:
        # The root of the derivative v0 h + 2 c s + 3 d s^2 in s, 0 to 1, without cancellation.
        c = 3.0 * (r1 - r0) - (2.0 * v0 + v1) * h
        d = 2.0 * (r0 - r1) + (v0 + v1) * h
        s = v0 * h / (math.sqrt(max(c * c - 3.0 * d * v0 * h, 0.0)) - c)
        largest = max(largest, r0 + s * (v0 * h + s * (c + s * d)))
    return largest


def write_responses(path, motions, responses, structure):
    """A row for each motion, as Parquet or CSV by the ending of the path."""
    columns = {
        "motion_id": [motion.motion_id for motion in motions],
        "p_rad_s": [structure.p] * len(motions),
        "alpha_rad": [structure.alpha] * len(motions),
        "eta": [structure.eta] * len(motions),
        "outcome": [response.outcome for response in responses],
        "edp": [response.edp for response in responses],
        "impacts": [response.impacts for response in responses],
    }
    if str(path).endswith(".csv"):
        with open(path, "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(columns)
            writer.writerows(zip(*columns.values()))
    else:
        pq.write_table(pa.table(columns), path)


def accuracy(path, motions, responses, structure):
    """How far responses are from the exact ones in a CSV file: outcomes, and EDPs where both rock safely."""
    exact = {}
    with open(path) as file:
        for row in csv.DictReader(file):
            parameters = Structure(*(float(row[name]) for name in ("p_rad_s", "alpha_rad", "eta")))
            if parameters == structure:
                exact[row["motion_id"]] = (row["outcome"], float(row["edp"]))
    pairs = [
        (response, *exact[str(m.motion_id)])
        for m, response in zip(motions, responses)
        if str(m.motion_id) in exact
    ]
    errors = [
        abs(response.edp / edp - 1.0)
        for response, outcome, edp in pairs
        if response.outcome == outcome == "safe_rocking" and edp > 0.0
    ]
    quantiles = np.quantile(errors, [0.5, 0.9, 1.0]) if errors else [math.nan] * 3
    return {
        "compared": len(pairs),
        "outcomes_wrong": sum(response.outcome != outcome for response, outcome, _ in pairs),
        "both_safe": len(errors),
        **{f"edp_error_{name}": float(q) for name, q in zip(("median", "p90", "largest"), quantiles)},
        "edp_error_above_1e-6": sum(error > 1e-6 for error in errors),
        "edp_error_above_3_percent": sum(error > 0.03 for error in errors),
    }


def timed(work):
    """What `work` returns, and its wall and processor time, s."""
    wall, cpu = time.perf_counter(), time.process_time()
    result = work()
    return result, (time.perf_counter() - wall, time.process_time() - cpu)


class Stopwatch:
    """Adds up time by part, processor time unless told otherwise: `with stopwatch("fft"): ...`"""

    def __init__(self, clock=time.process_time):
        self.clock, self.seconds = clock, {}

    def __call__(self, part):
        self.part = part
        return self

    def __enter__(self):
        self.start = self.clock()

    def __exit__(self, *_):
        elapsed = self.clock() - self.start
        self.seconds[self.part] = self.seconds.get(self.part, 0.0) + elapsed


def print_report(**figures):
    """The figures of a peer, and what it ran on, as JSON."""
    print(json.dumps({**figures, "python": platform.python_version(), "numpy": np.__version__}, indent=2))


def report_rocking(solver, options, structure, motions, responses, seconds, **more):
    """Writes the responses if asked to, and prints time and accuracy of a rocking peer."""
    if options.out:
        write_responses(options.out, motions, responses, structure)
    outcomes = [response.outcome for response in responses]
    wall, cpu = seconds
    print_report(
        solver=solver,
        **dataclasses.asdict(structure),
        motions=len(motions),
        samples_a_motion=float(np.mean([len(motion.ground) for motion in motions])),
        ms_a_motion=1e3 * wall / len(motions),
        cpu_ms_a_motion=1e3 * cpu / len(motions),
        **more,
        outcomes={outcome: outcomes.count(outcome) for outcome in sorted(set(outcomes))},
        impacts_a_motion=float(np.mean([response.impacts for response in responses])),
        **({"accuracy": accuracy(options.answers, motions, responses, structure)} if options.answers else {}),
    )
