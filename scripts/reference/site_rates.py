"""Judges rates of evaluate --hazard at the sites of sites.py: python site_rates.py FOLDER ROCKFRAG

The truth is the sum over the joint hazard of a site of its rates times P_ro, each earthquake by its own magnitude. The
table has, for each route, the rates over the truth, and how often the 95 % limits hold truths whose c, ln s and eta are
drawn from their distributions.
"""

import csv
import io
import json
import pathlib
import subprocess
import sys

import numpy as np
from scipy.special import expit, logit

import sites as S

OBJECTS = {"cabinet": (0.8, 2.2), "rack": (0.6, 2.0), "statue": (0.45, 1.7), "shelf": (0.35, 1.5)}
SD_OF_LOSS = 0.4
DRAWS = 40
# The magnitude that the level of the surface is for, and within which it counts.
MIDDLE, RANGE = 6.9, (5.0, 7.6)
LN_LOSS = np.linspace(-1.2, 1.2, 7)
folder, binary = pathlib.Path(sys.argv[1]), sys.argv[2]
root = pathlib.Path(__file__).resolve().parents[2]
data = np.load(folder / "sites.npz")
names, joint, mean_mw = data["names"], data["joint"], data["mw"]
ln_pga = 0.5 * (S.LN_PGA[1:] + S.LN_PGA[:-1])
ln_pgv = 0.5 * (S.LN_PGV[1:] + S.LN_PGV[:-1])
random = np.random.default_rng(1)


def call(*options):
    run = subprocess.run([binary, "evaluate", *map(str, options), "--quiet"], capture_output=True, text=True, check=True)
    return run.stdout


def calibration():
    """c, ln s, m and their standard deviations, of P_ro under recorded motions."""
    rows = csv.reader(line for line in open(root / "data/universal.csv") if line.startswith("calibration,recorded,pro"))
    return next([float(cell) for cell in row[3:9]] for row in rows)


def surface(width, height, eta, mw):
    """Logits of P_ro at the bins of PGA and PGV; -inf below uplift."""
    a, v = np.meshgrid(ln_pga, ln_pgv, indexing="ij")
    p, alpha = np.sqrt(3 * 9.81 / (2 * np.hypot(width, height))), np.arctan(width / height)
    keep = (np.exp(a) > 9.81 * np.tan(alpha)) & (np.exp(a) <= 4.5 * 9.81) & (np.exp(v) <= 5)
    table = np.column_stack([np.exp(a)[keep], np.exp(v)[keep], np.full(keep.sum(), mw)])
    np.savetxt(folder / "grid.csv", table, delimiter=",", header="pga_m_s2,pgv_m_s,mw", comments="")
    call("--in", folder / "grid.csv", "--p", p, "--alpha", alpha, "--eta", eta, "--out", folder / "out.csv", "--force")
    p_ro = np.array([float(row["p_ro"]) for row in csv.DictReader(open(folder / "out.csv"))])
    result = np.full(a.shape, -np.inf)
    result[keep] = logit(p_ro)
    return result


class Truth:
    """Logits of P_ro of an object, by what they depend on."""

    def __init__(self, width, height):
        housner = 1 - 1.5 * np.sin(np.arctan(width / height)) ** 2
        self.c, _, self.m, *self.sds = calibration()
        self.tan_alpha = width / height
        etas = 1 - (1 - housner) * np.exp(LN_LOSS)
        self.logits = np.array([surface(width, height, eta, MIDDLE) for eta in etas])
        self.rocks = np.isfinite(self.logits[0])

    def rate(self, rates, c=0.0, ln_s=0.0, m=0.0, loss=0.0):
        """Of a site, with c, ln s, m and ln(1 - eta) off by so much."""
        at = np.clip((loss - LN_LOSS[0]) / (LN_LOSS[1] - LN_LOSS[0]), 0, len(LN_LOSS) - 1.001)
        low, share = int(at), at - int(at)
        z = (1 - share) * self.logits[low][self.rocks] + share * self.logits[low + 1][self.rocks]
        z = self.c + c + np.exp(ln_s) * (z - self.c)
        of = lambda mw: (self.m + m) * (np.clip(mw, *RANGE) - MIDDLE)
        return sum(expit(z + of(mw)) @ rates[k][self.rocks] for k, mw in enumerate(S.MAGNITUDES))


def write_curve(name, heading, unit, curve):
    kept = curve[(curve[:, 1] > 1e-9) & (curve[:, 1] < 0.5)]
    lines = [f"{level / unit:.6g},{rate:.6e}" for level, rate in kept]
    (folder / name).write_text("\n".join([f"{heading},annual_rate_of_exceedance", *lines]) + "\n")


def write(k):
    """The files of a site as an engineer has them."""
    write_curve("pga.csv", "pga_g", 9.81, data["pga"][k])
    write_curve("pgv.csv", "pgv_m_s", 1, data["pgv"][k])
    write_curve("sa.csv", "SA(1.0) (g)", 9.81, data["sa1"][k])
    lines = ["pga_m_s2,pgv_m_s,mw,annual_rate_of_occurrence"]
    for m, a, v in np.argwhere(joint[k] > 1e-10):
        lines.append(f"{np.exp(ln_pga[a]):.6g},{np.exp(ln_pgv[v]):.6g},{S.MAGNITUDES[m]},{joint[k][m, a, v]:.6e}")
    (folder / "joint.csv").write_text("\n".join(lines) + "\n")


ROUTES = [
    "PGA", "PGA, M", "PGA, V", "PGA, M, V", "PGV", "PGV, M", "PGV, V", "PGA, SA", "PGA, SA, M", "PGA, PGV", "PGA, PGV, M",
    "joint",
]


def answers(k, route):
    given = route.split(", ")
    paths = ",".join(str(folder / f"{name.lower()}.csv") for name in given if name not in "MV")
    mw = ["--magnitude", f"{mean_mw[k]:.2f}"] if "M" in given else []
    vs30 = ["--vs30", names[k][3]] if "V" in given else []
    rows = json.loads(call("--structures", folder / "objects.csv", "--hazard", paths, *mw, *vs30, "--format", "json"))
    return {row["structure"]: row for row in rows}


def main():
    (folder / "objects.csv").write_text("name,width,height\n" + "".join(f"{n},{w},{h}\n" for n, (w, h) in OBJECTS.items()))
    truths = {name: Truth(*size) for name, size in OBJECTS.items()}
    found = {}
    for k, (kind, *_) in enumerate(names):
        write(k)
        drawn = {}
        for name, truth in truths.items():
            sds = [*truth.sds, SD_OF_LOSS]
            drawn[name] = [truth.rate(joint[k], *(random.normal(size=4) * sds)) for _ in range(DRAWS)]
        for route in ROUTES:
            rows = answers(k, route)
            for name, truth in truths.items():
                true = truth.rate(joint[k])
                if true > 1e-9:
                    low, high = [rows[name][f"overturning_per_year_{end}"] for end in ("low", "high")]
                    value = rows[name]["overturning_per_year"]
                    if value is None:
                        continue
                    held = np.mean([low <= rate <= high for rate in drawn[name]])
                    entry = (np.log(value / true), held, np.log(high / low), names[k][1], names[k][2])
                    found.setdefault((str(kind), route), []).append(entry)

    print(f"{'sites':6} {'route':12} {'n':>4} {'median':>6} {'rms ln':>6} {'in 1.5':>6} {'worst':>6} {'held':>5} {'high/low':>8}")
    for (kind, route), rows in found.items():
        off, held, width = (np.array([row[i] for row in rows]) for i in range(3))
        print(f"{kind:6} {route:12} {len(off):4} {np.exp(np.median(off)):6.2f} {np.sqrt(np.mean(off**2)):6.2f} "
              f"{np.mean(abs(off) < np.log(1.5)):6.2f} {np.exp(abs(off).max()):6.1f} {np.mean(held):5.3f} {np.exp(np.mean(width)):8.1f}")
    json.dump({"|".join(key): rows for key, rows in found.items()}, open(folder / "found.json", "w"))


if __name__ == "__main__":
    main()
