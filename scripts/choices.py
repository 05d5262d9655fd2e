"""What the paper leaves open, and what each choice does to the distance from its Table II: python
scripts/choices.py ROCKFRAG

A reading is a choice of the options below. Its distance is the sum over the eight planes of T2: the four
published numbers of a plane beside the mean of ours over seeds, by the covariance of one more seed and of the
mean, and of an error of print of variance width^2 / 12. One covariance serves all readings: that within
readings, pooled over those of the second round. Round 1: all readings with seed 1; round 2: the nearest with
seeds 1 to 10, and one option at a time other than the nearest with seed 1. The nearest is judged on seeds 21 to 30
beside the options of Boore (2003) and Atkinson & Silva (2000); +- is the sd of a sum, or of a gain, over seeds
(jackknife). Prints the numbers of docs/review/choices.md. Needs pandas, pyarrow and numpy.
"""

import itertools
import pathlib
import sys
import tempfile

import numpy as np
import pandas as pd

from common import ROOT, call

rockfrag = pathlib.Path(sys.argv[1]).resolve()
FACTORS = {
    "difference": ("clamp", "none"),
    "window": (1, 2),
    "crust": ((0.03, 3.5), (0.035, 3.7), (0.04, 3.5)),  # kappa in s, shear-wave velocity in km/s
    "fmax": (15, 20, 1e6),
}
LITERATURE = {"difference": "clamp", "window": 2, "kappa": 0.03, "shear-velocity": 3.5, "fmax": 1e6}
OTHERS = [
    {"difference": "clamp"}, {"difference": "none"}, {"window": 1}, {"window": 2}, {"kappa": 0.03},
    {"kappa": 0.035}, {"kappa": 0.04}, {"shear-velocity": 3.5}, {"shear-velocity": 3.7}, {"fmax": 15},
    {"fmax": 20}, {"fmax": 1e6}, {"epoch": "pga"}, {"epoch": "pgv"}, {"design": "random"}, {"site": "soil"},
    {"low-cut": 0.1}, {"alpha": (0.149, 0.19)},
]  # fmt: skip
FLOORS = 0.0, 1e-7, 1e-6, 1e-5, 1e-4
CHOSEN_FROM = 0.0, 1e-6
SUITES = "pulse", "csgm"
CASES = list(itertools.product(SUITES, ("frame", "electrical-equipment"), ("below", "above")))
NUMBERS = "ln_a", "b1", "b2", "r2"
paper = pd.read_csv(ROOT / "core/data/paper.csv").set_index(["suite", "structure", "quantity"]).sort_index()
PRINTS = np.array([
    paper.loc[suite, name].loc[[f"{side}_{number}" for number in NUMBERS]]
    [["published", "print_low", "print_high"]].to_numpy(float).T for suite, name, side in CASES
])  # fmt: skip
known, folder = {}, tempfile.TemporaryDirectory()


def made(suite, reading, seed):
    """Of each floor the numbers of the four planes of a suite, and how many motions overturn either structure."""
    options = {**reading}
    alphas, design = options.pop("alpha", (0.15, 0.20)), options.pop("design", "lhs")
    options = {} if suite == "pulse" else options
    key = suite, repr(sorted(options.items())), alphas, design, seed
    if key in known:
        return known[key]
    at, flags = folder.name, [f"--{name}={value}" for name, value in options.items()]
    call(rockfrag, "sample-scenarios", f"--seed={seed}", f"--design={design}", folder=at)
    call(rockfrag, "synthesize-motions", f"--seed={seed}", f"--suite={suite}", *flags, folder=at)
    structures = zip(("frame", "electrical-equipment"), (1.0, 2.5), alphas)
    named = [f"--structure=name={name},p={p},alpha={alpha},eta=0.92" for name, p, alpha in structures]
    call(rockfrag, "simulate", *named, folder=at)
    responses = pd.read_parquet(f"{at}/responses.parquet", columns=["structure", "outcome"])
    fell = responses[responses.outcome.eq("overturning")].structure.value_counts()
    planes = []
    for floor in FLOORS:
        call(rockfrag, "fit-pex", f"--rotation-floor={floor}", folder=at)
        fits = pd.read_parquet(f"{at}/pex.parquet").query("model == 'biplanar'")
        fits["side"] = np.where(fits.range_high.notna(), "below", "above")
        fits = fits.astype({"structure": str}).set_index(["structure", "side"])
        planes.append([[*fits.coefficients[case[1:]], fits.r2[case[1:]]] for case in CASES[:4]])
    known[key] = np.array(planes), np.array([fell.get("frame", 0), fell.get("electrical-equipment", 0)])
    print(".", end="", file=sys.stderr, flush=True)
    return known[key]


def fitted(reading, seed):
    """Of each floor the numbers of the eight planes, and how many combined motions overturn either structure."""
    pulse, combined = (made(suite, reading, seed) for suite in SUITES)
    return np.concatenate([pulse[0], combined[0]], axis=1), combined[1]


def t2(reading, floor, seeds, covariance):
    """T2 of the eight planes."""
    values, low, high = PRINTS.transpose(1, 0, 2)
    ours = np.mean([fitted(reading, seed)[0][FLOORS.index(floor)] for seed in seeds], axis=0)
    print_error = np.square(high - low)[:, :, None] / 12 * np.eye(4)
    away = (values - ours)[:, :, None]
    return (away * np.linalg.solve(covariance * (1 + 1 / len(seeds)) + print_error, away)).sum(axis=(1, 2))


def pooled(readings, seeds):
    """The covariance within readings of the numbers of each plane: 8 x 4 x 4."""
    of = [[fitted(reading, seed)[0][FLOORS.index(floor)] for seed in seeds] for reading, floor in readings]
    away = np.array(of) - np.mean(of, axis=1, keepdims=True)
    return np.einsum("rskm,rskn->kmn", away, away) / (len(readings) * (len(seeds) - 1))


def jackknife(values):
    """The sd over seeds of what leaves out one seed at a time."""
    return np.sqrt((len(values) - 1) * np.var(values))


def table(title, readings, seeds, covariance):
    """Prints the readings, the nearest first, and returns them so."""
    rows = sorted(((t2(*of, seeds, covariance), of) for of in readings), key=lambda row: row[0].sum())
    print(f"\n{title}: sum of T2; that of each of", *CASES, "; combined motions that overturn the structures")
    for planes, (reading, floor) in rows:
        fell = np.mean([fitted(reading, seed)[1] for seed in seeds], axis=0)
        print(f"{planes.sum():7.1f}", *(f"{one:6.1f}" for one in planes), fell, reading, floor, flush=True)
    return [of for _, of in rows]


def judge(readings, seeds, covariance):
    """Prints the readings, and how much nearer than each other the first is, as it is printed."""
    table("judged, seeds 21 to 30", readings, seeds, covariance)
    sums = lambda seeds: np.array([t2(*of, seeds, covariance).sum() for of in readings])
    leave_out = np.array([sums([other for other in seeds if other != seed]) for seed in seeds])
    whole = sums(seeds)
    for k, of in enumerate(readings):
        gain = jackknife(leave_out[:, k] - leave_out[:, 0])
        sd = jackknife(leave_out[:, k])
        print(f"{whole[k]:.1f} +- {sd:.1f}, gain {whole[k] - whole[0]:.1f} +- {gain:.1f}", *of)


def floors(reading, seeds):
    """Prints b1 and R2 of the four low planes by the floor in rad."""
    print("\nfloors of", reading, "seeds 21 to 30: b1, R2 of the planes below, of", CASES[::2])
    for k, floor in enumerate(FLOORS):
        means = np.mean([fitted(reading, seed)[0][k, ::2] for seed in seeds], axis=0)
        print(f"{floor:7g}", *(f"{one[1]:6.2f} {one[3]:.3f} |" for one in means))


grid = [dict(zip(FACTORS, values)) for values in itertools.product(*FACTORS.values())]
for one in grid:
    one["kappa"], one["shear-velocity"] = one.pop("crust")
ten, held_out = list(range(1, 11)), list(range(21, 31))
of_literature = pooled([(LITERATURE, 0.0)], ten)
with_floors = list(itertools.product(grid, CHOSEN_FROM))
first = table(f"{len(with_floors)} readings, seed 1", with_floors, [1], of_literature)
nearest = [of for of in first[:8] if of[0] != LITERATURE] + [(LITERATURE, floor) for floor in CHOSEN_FROM]
covariance = pooled(nearest, ten)
(best, floor), second = table(f"{len(nearest)} readings, seeds 1 to 10", nearest, ten, covariance)[:2]
today = [(LITERATURE, 0.0), ({**LITERATURE, "difference": "none"}, 0.0)]
judge([(best, floor), second, *today], held_out, covariance)
floors(best, held_out)
others = [({**best, **one}, floor) for one in OTHERS if {**best, **one} != best]
others += [(best, other) for other in FLOORS if other != floor]
table("one option other than the nearest, seed 1", [(best, floor), *others], [1], covariance)
