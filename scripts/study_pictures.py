"""Draws the figures of the studies: python study_pictures.py, into docs/studies

universality.png is of data/universality.csv; ranking.png and records.png are of the tables on the pages themselves. Needs
matplotlib.
"""

import csv
import pathlib
import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parents[1]
STUDIES = ROOT / "docs/studies"
BLUE, ORANGE, GREY = "#0072B2", "#D55E00", "0.6"
VERDICTS = {"holds": (BLUE, "o"), "bends": ("#E69F00", "D"), "fails": (ORANGE, "X"), "too_few_events": ("0.8", ".")}


def plain(axes):
    axes.spines[["top", "right"]].set_visible(False)


def save(figure, name):
    figure.savefig(STUDIES / name, dpi=120)


def rows_of(page, cells):
    """The rows of the tables of a page that have so many cells, without heads and rules."""
    lines = [line for line in (STUDIES / page).read_text().splitlines() if line.startswith("|")]
    rows = [[cell.strip().replace("**", "") for cell in line.strip("|").split("|")] for line in lines]
    return [row for row in rows if len(row) == cells and not set("".join(row)) <= set("-: ")]


def universality():
    lines = (ROOT / "data/universality.csv").read_text().splitlines()
    rows = [row for row in csv.DictReader(line for line in lines if not line.startswith("#"))]
    figure, all_axes = plt.subplots(2, 2, figsize=(9, 6), layout="constrained", sharex=True, sharey=True)
    names = {"pulse": "pulses", "csgm": "combined motions", "overturning": "overturning", "exceeding": "exceeding 0.10"}
    for axes, (suite, event) in zip(all_axes.flat, [(s, e) for s in ("pulse", "csgm") for e in ("overturning", "exceeding")]):
        for verdict, (colour, marker) in VERDICTS.items():
            of = [row for row in rows if (row["suite"], row["event"], row["verdict"]) == (suite, event, verdict)]
            # Structures that differ in eta alone are drawn side by side.
            shift = {"0.8000": 0.96, "0.9200": 1.0, "0.9800": 1.04}
            x = [float(row["p_rad_s"]) * shift[row["eta"]] for row in of]
            axes.scatter(x, [float(row["alpha_rad"]) for row in of], c=colour, marker=marker, s=24, label=verdict.replace("_", " "), lw=0)
        axes.set_title(f"{names[suite]}, {names[event]}", fontsize=10)
        axes.set(xscale="log", yscale="log")
        axes.set_xticks([0.5, 1, 2, 4], ["0.5", "1", "2", "4"])
        axes.set_yticks([0.05, 0.1, 0.2, 0.35], ["0.05", "0.1", "0.2", "0.35"])
        axes.minorticks_off()
        plain(axes)
    for axes in all_axes[1]:
        axes.set_xlabel("p, rad/s (left to right in a group: η 0.80, 0.92, 0.98)")
    for axes in all_axes[:, 0]:
        axes.set_ylabel("α, rad")
    figure.legend(*all_axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4, frameon=False)
    save(figure, "universality.png")


def ranking():
    gain = re.compile(r"(.*?) (-?\d+\.\d+) ± (\d+\.\d+)$")
    groups = [row for row in rows_of("ranking.md", 5) if gain.match(row[2])]
    figure, axes = plt.subplots(figsize=(9, 6.2), layout="constrained")
    colours, target = [GREY, BLUE, ORANGE], ""
    for place, row in enumerate(groups):
        target = row[0] or target
        for k, cell in enumerate(row[2:]):
            measures, value, error = gain.match(cell).groups()
            y, value, error = place + (k - 1) * 0.26, float(value), float(error)
            axes.errorbar(value, y, xerr=2 * error, fmt="o", color=colours[k], ms=5, label=["alone", "pair", "triple"][k] if place == 0 else None)
            axes.annotate(measures, (value + 2 * error, y), xytext=(5, 0), textcoords="offset points", va="center", fontsize=7.5)
        axes.annotate(f"{target}, {row[1].split(' (')[0]}", (-0.45, place - 0.42), fontsize=8.5, weight="bold")
    axes.axvline(0, color="0.4", lw=0.8)
    axes.set(yticks=[], xlabel="gain in log score over the paper's model (bars: two standard errors)", xlim=(-0.46, 0.32))
    axes.invert_yaxis()
    figure.legend(*axes.get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False)
    axes.spines["left"].set_visible(False)
    plain(axes)
    save(figure, "ranking.png")


def records():
    count, expected = re.compile(r"(\d+) of (\d+)"), re.compile(r"([\d.]+) \((\d+) to (\d+)\)")
    groups = [row for row in rows_of("records.md", 5) if count.match(row[2])]
    figure, axes = plt.subplots(figsize=(9, 3), layout="constrained")
    for place, row in enumerate(groups):
        seen, of = map(int, count.match(row[2]).groups())
        for k, (cell, colour, label) in enumerate([(row[3], BLUE, "expected by curves of pulses"), (row[4], ORANGE, "by those of combined motions")]):
            mean, low, high = map(float, expected.match(cell).groups())
            y = place + 0.16 * (2 * k - 1)
            axes.plot([low / of, high / of], [y, y], color=colour, lw=6, alpha=0.35, solid_capstyle="butt")
            axes.plot(mean / of, y, "|", color=colour, ms=11, mew=2, label=label if place == 0 else None)
        axes.plot(seen / of, place, "o", color="black", ms=7, label="observed" if place == 0 else None)
    axes.set_yticks(range(len(groups)), [f"{row[0]}: {row[1].split(',')[0]}" for row in groups])
    axes.set(xlabel="share of the components (bands: 95 % of the counts if the curves are right)", xlim=(0, 1.03))
    axes.invert_yaxis()
    figure.legend(*axes.get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    plain(axes)
    save(figure, "records.png")


if __name__ == "__main__":
    universality()
    ranking()
    records()
