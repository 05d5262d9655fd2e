"""Answers that the tests of the program compare with: python answers.py SURFACE.csv STUDY RECORDS_RESPONSES OUT_FOLDER

universal_answers.csv: logits of the surface, before calibration, at 60 points of the domain. calibration_cases.csv: some
cases of rocking of a structure under csgm and of one under records; calibration_answers.csv: c, ln s, and their covariance
as the inverse Hessian and with clusters (calibration.py), by the priors of SURFACE.csv."""

import sys

import numpy as np

import cases as of
from calibration import calibrate
from make import LIMIT, chosen
from surface import KINDS, Surface, some


def write(path, columns):
    with open(path, "w") as file:
        file.write(",".join(columns) + "\n")
        for row in zip(*columns.values()):
            file.write(",".join(f"{v:.15g}" if isinstance(v, float) else str(v) for v in row) + "\n")


def main():
    path, study, records, folder = sys.argv[1:]
    surface = Surface(path)
    rng, n = np.random.default_rng(11), 60
    uniform = lambda name: rng.uniform(*surface.domain[name], n).round(6)
    of_log = lambda name: np.exp(rng.uniform(*np.log(np.maximum(surface.domain[name], 1e-3)), n)).round(6)
    points = {"kind": np.array([("recorded", *KINDS)[k % 4] for k in range(n)]), "p_rad_s": of_log("p"),
              "alpha_rad": of_log("alpha"), "eta": uniform("eta"), "im3": of_log("im3"), "im4": of_log("im4") + 0.01}  # fmt: skip
    points |= {"im5": points["im4"] / points["im3"], "limit_state": of_log("limit")}
    for event in ("pro", "pex"):
        one = lambda k: surface.logit(event, points["kind"][k], some(points, slice(k, k + 1)), points["limit_state"][k])[0]
        points[f"logit_{event}"] = np.array([one(k) for k in range(n)])
    write(f"{folder}/universal_answers.csv", points)

    parts, answers = [], []
    for file, suite, structure in ((study, "csgm", 1), (records, None, 5)):
        every = of.read([file], 1.0, suite)
        every = some(every, np.flatnonzero(every["structure"] == structure)[::8 if suite else 1])
        parts.append(every)
        for event in ("pro", "pex"):
            cases, happened = chosen(event, every)
            kind = cases["kind"][0]
            logit, prior = surface.logit(event, kind, cases, LIMIT), surface.calibration[kind, event][:4]
            (c, ln_s), plain = calibrate(logit, happened, prior)
            _, clustered = calibrate(logit, happened, prior, cases["cluster"])
            numbers = (c, ln_s, plain[0, 0], plain[0, 1], plain[1, 1], clustered[0, 0], clustered[0, 1], clustered[1, 1])
            clusters = len(np.unique(cases["cluster"]))
            answers.append((kind, structure, event, len(logit), int(happened.sum()), clusters, *map(float, numbers)))
    names = ["kind", "structure", "p_rad_s", "alpha_rad", "eta", "pga_m_s2", "pgv_m_s", "im3", "im4", "im5", "cluster",
             "overturned", "edp"]  # fmt: skip
    joined = {name: np.concatenate([part[name] for part in parts]) for name in names}
    joined["overturned"], joined["edp"] = joined["overturned"].astype(int), np.nan_to_num(joined["edp"], nan=-1.0)
    write(f"{folder}/calibration_cases.csv", joined)
    names = "kind,structure,event,n,n_events,n_clusters,c,ln_s,v_cc,v_cs,v_ss,clustered_cc,clustered_cs,clustered_ss"
    write(f"{folder}/calibration_answers.csv", dict(zip(names.split(","), zip(*answers))))


if __name__ == "__main__":
    main()
