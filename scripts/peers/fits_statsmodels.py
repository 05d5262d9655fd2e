"""The fits of the paper by statsmodels, with bootstrap replicates in a loop.

    python fits_statsmodels.py responses.parquet --replicates 20 --out fits.csv

For each suite and structure: the demand in safe rocking, ln EDP on each of the six ln IM, on (ln IM4, ln IM3)
over all cases and on either side of the transition (OLS); overturning of rocking cases on each ln IM and on
the hybrids (probit). A replicate draws the cases of the group anew with replacement. Replicates ask
statsmodels for the coefficients only: no summary, no covariance, no check of the rank, and the probit starts
from the estimate of the whole sample.
"""

import argparse
import csv
import time
import warnings

import numpy as np
import pyarrow.parquet as pq
import statsmodels
import statsmodels.api as sm

from common import Stopwatch, print_report

SCALARS = ("im1", "im2", "im3", "im4", "im5", "im6")
LEAST_EVENTS = 5


class Fit:
    """A regression: its columns, its cases, and how statsmodels fits it."""

    def __init__(self, name, measures, ln_im, response, chosen):
        self.name = name
        self.design = sm.add_constant(np.column_stack([ln_im[measure] for measure in measures]))
        self.response = response
        self.chosen = chosen & np.isfinite(self.design).all(axis=1) & np.isfinite(response)

    def sample(self, cases):
        """Response and design of those of `cases` (row numbers, perhaps repeated) that count here."""
        cases = cases[self.chosen[cases]]
        return self.response[cases], self.design[cases]


class Demand(Fit):
    """ln EDP in safe rocking by ordinary least squares."""

    def coefficients(self, cases):
        return sm.OLS(*self.sample(cases)).fit().params

    def estimate(self, cases):
        fit = sm.OLS(*self.sample(cases)).fit()
        b = dict(zip(("ln_a", "b1", "b2"), fit.params))
        return {**b, "r2": fit.rsquared, "beta": np.sqrt(fit.mse_resid), "n": int(fit.nobs)}


class Overturning(Fit):
    """Overturning given rocking by probit; coefficients converted to (lambda, mu, beta)."""

    start = None

    def coefficients(self, cases):
        event, design = self.sample(cases)
        if min(event.sum(), event.size - event.sum()) < LEAST_EVENTS:
            return np.full(design.shape[1], np.nan)
        options = {"method": "newton", "disp": 0, "skip_hessian": True, "warn_convergence": False}
        model = sm.Probit(event, design, check_rank=False)
        return model.fit(start_params=self.start, **options).params

    def estimate(self, cases):
        event, design = self.sample(cases)
        fit = sm.Probit(event, design).fit(method="newton", disp=0, maxiter=100, tol=1e-10)
        self.start = fit.params
        slope = fit.params[1:].sum()
        curve = {
            "mu": -fit.params[0] / slope,
            "beta": 1.0 / slope,
            "log_likelihood": fit.llf,
            "n": int(fit.nobs),
        }
        return {"lambda": fit.params[1] / fit.params[2], **curve} if len(fit.params) == 3 else curve


def fits_of(group, transition, pairs):
    """All regressions of one suite and structure."""
    ln_im = {name: np.log(group[name]) for name in SCALARS}
    ln_im["im3_inv"] = -ln_im["im3"]
    outcome = group["outcome"]
    safe, rocking = outcome == "safe_rocking", outcome != "no_rocking"
    ln_edp = np.log(group["edp"])
    event = (outcome == "overturning").astype(float)
    low = group["im4"] < transition
    plane = ("im4", "im3")
    return [
        *(Demand(f"demand {name}", [name], ln_im, ln_edp, safe) for name in SCALARS),
        Demand("demand plane", plane, ln_im, ln_edp, safe & (group["im4"] >= 1.0)),
        Demand("demand low plane", plane, ln_im, ln_edp, safe & low & (group["im4"] >= 1.0)),
        Demand("demand high plane", plane, ln_im, ln_edp, safe & ~low),
        *(Overturning(f"overturning {name}", [name], ln_im, event, rocking) for name in SCALARS),
        *(Overturning(f"overturning {'+'.join(pair)}", pair, ln_im, event, rocking) for pair in pairs),
    ]


def read_groups(path):
    """The columns of each suite and structure."""
    names = ["suite", "structure", "outcome", "edp", *SCALARS]
    table = pq.read_table(path, columns=names)
    columns = {name: table[name].to_numpy() for name in names}
    keys = list(zip(columns["suite"], columns["structure"]))
    for key in dict.fromkeys(keys):
        rows = np.array([other == key for other in keys])
        yield key, {name: column[rows] for name, column in columns.items()}


def bootstrap(fit, cases, replicates, random):
    """The coefficients of each replicate."""
    return np.array([fit.coefficients(random.choice(cases, cases.size)) for _ in range(replicates)])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("responses", help="Parquet file of responses")
    parser.add_argument("--out", help="CSV of the estimates and bootstrap standard errors to write")
    parser.add_argument("--replicates", type=int, default=20)
    parser.add_argument("--scale-to", type=int, default=2000, help="replicates to which the time is scaled")
    parser.add_argument("--transition", type=float, default=1.3, help="IM4 at which the two planes meet")
    parser.add_argument("--pairs", nargs="*", default=["im4:im3_inv"], help="hybrid measures")
    parser.add_argument("--seed", type=int, default=42)
    options = parser.parse_args()
    # A replicate may be separated, or an EDP be 0 outside safe rocking: neither stops the others.
    warnings.simplefilter("ignore")
    np.seterr(all="ignore")
    random = np.random.default_rng(options.seed)
    pairs = [pair.split(":") for pair in options.pairs]

    rows, wall, cpu = [], Stopwatch(time.perf_counter), Stopwatch()
    for (suite, structure), group in read_groups(options.responses):
        cases = np.arange(group["edp"].size)
        for fit in fits_of(group, options.transition, pairs):
            with wall("estimates"), cpu("estimates"):
                estimate = fit.estimate(cases)
            kind = f"{fit.name.split()[0]} replicates"
            with wall(kind), cpu(kind):
                replicates = bootstrap(fit, cases, options.replicates, random)
            errors = {f"bootstrap_se_b{k}": se for k, se in enumerate(np.nanstd(replicates, axis=0, ddof=1))}
            rows.append({"suite": suite, "structure": structure, "fit": fit.name, **estimate, **errors})
    if options.out:
        with open(options.out, "w", newline="") as file:
            names = dict.fromkeys(name for row in rows for name in row)
            writer = csv.DictWriter(file, names, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    scale = options.scale_to / options.replicates
    scaled = [
        sum(s * (1.0 if part == "estimates" else scale) for part, s in w.seconds.items()) for w in (wall, cpu)
    ]
    print_report(
        statsmodels=statsmodels.__version__,
        fits=len(rows),
        replicates=options.replicates,
        seconds=wall.seconds,
        cpu_seconds=cpu.seconds,
        scaled_to_replicates=options.scale_to,
        scaled_seconds=scaled[0],
        scaled_cpu_seconds=scaled[1],
        note=f"timed with {options.replicates} replicates, scaled linearly to {options.scale_to}",
    )


if __name__ == "__main__":
    main()
