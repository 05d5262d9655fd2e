"""PGV/PGA of motions as recorded, and the fragility by it: python recorded_peaks.py COMPONENTS RESPONSES

COMPONENTS (CSV) has the earthquake, magnitude, pga_m_s2 and pgv_m_s of components as recorded; the line of
core/src/hazard/pgv_pga.rs is fitted to them with a random level for each earthquake. RESPONSES (Parquet, of
simulate, with the earthquake) tells what each overturns. Medians of the fragility over PGA stand beside
medians of probit fits to the counts, by magnitude: each earthquake is predicted by a line fitted without it.
"""

import itertools
import sys

import numpy as np
import pandas as pd
import statsmodels.api as sm
import statsmodels.formula.api as smf
from scipy.stats import norm

from fragility import G, LEVEL_AT, probabilities

BANDS = [(5.0, 5.95), (5.95, 6.45), (6.45, 8.0)]
# The least count of overturnings, and of others, of a structure in a band.
LEAST, Z = 8, np.linspace(-4, 4, 41)


def line(components):
    """Level at .4 g and M 6.3, slope by ln PGA, scatter, rise with magnitude; sd between earthquakes."""
    fit = smf.mixedlm("ratio ~ pga + mw", components, groups=components["earthquake"]).fit()
    b = fit.params
    return (b["Intercept"], b["pga"], np.sqrt(fit.scale), b["mw"]), np.sqrt(fit.cov_re.iloc[0, 0])


def overturning(structure, ln_pga, mw, of_line):
    level, slope, sd, per_magnitude = of_line
    median = level + slope * (ln_pga - np.log(LEVEL_AT["pga"])) + per_magnitude * (mw - 6.3)
    pga, pgv = np.repeat(np.exp(ln_pga), len(Z)), np.exp(np.add.outer(ln_pga + median, sd * Z)).ravel()
    p = probabilities(structure, pga, pgv, mw)[1]
    return np.average(p.reshape(-1, len(Z)), axis=1, weights=norm.pdf(Z))


def median(ln_pga, p):
    """Of the probit fit, and its dispersion."""
    fit = sm.GLM(p, sm.add_constant(ln_pga), sm.families.Binomial(sm.families.links.Probit())).fit()
    return -fit.params[0] / fit.params[1], 1 / fit.params[1]


def judged(components, responses):
    quakes = components["earthquake"].unique()
    lines = {quake: line(components[components["earthquake"] != quake])[0] for quake in quakes}
    for (low, high), (_, of_structure) in itertools.product(BANDS, responses.groupby("structure")):
        rows = of_structure[of_structure["magnitude"].between(low, high, "left")]
        fell, ln_pga = (rows["outcome"] == "overturning").astype(float), np.log(rows["pga_m_s2"].to_numpy())
        if min(fell.sum(), (1 - fell).sum()) < LEAST:
            continue
        (counted, beta), (least, most) = median(ln_pga, fell.to_numpy()), np.quantile(ln_pga, [0.03, 0.97])
        if not (least < counted < most and 0 < beta < 1.5):
            continue
        structure = tuple(rows[["p_rad_s", "alpha_rad", "eta"]].iloc[0])
        grid = np.linspace(np.log(G * np.tan(structure[1])) + 1e-3, np.log(4.5 * G), 40)
        p = np.zeros(len(rows))
        for quake in rows["earthquake"].unique():
            of_quake = (rows["earthquake"] == quake).to_numpy()
            found = overturning(structure, grid, rows["magnitude"].mean(), lines[quake])
            p[of_quake] = np.interp(ln_pga[of_quake], grid, found)
        yield f"M {low} to {high}", np.exp(median(ln_pga, p)[0] - counted)


tables = pd.read_csv(sys.argv[1]), pd.read_parquet(sys.argv[2])
components, responses = (table.replace("CHI-CHI TAIWAN", "CHI-CHI 09/20/99") for table in tables)
components["ratio"] = np.log(components["pgv_m_s"] / components["pga_m_s2"])
components["pga"] = np.log(components["pga_m_s2"] / LEVEL_AT["pga"])
components["mw"] = components["magnitude"] - 6.3
found, between = line(components)
print("level, slope, scatter, per magnitude, sd between earthquakes:", *np.round([*found, between], 2))
table = pd.DataFrame(judged(components, responses), columns=["magnitudes", "median over counted"])
print(table.groupby("magnitudes").agg(["median", "size"]).round(2).to_string())
