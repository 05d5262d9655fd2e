"""What freer models would tell more of overturning: python compare.py MOTIONS RESPONSES...

Boosted trees and, on a subsample, a Gaussian process, on structures and cells that none of them has seen.
"""

import sys

import numpy as np
from sklearn.ensemble import HistGradientBoostingClassifier
from sklearn.gaussian_process import GaussianProcessClassifier
from sklearn.gaussian_process.kernels import RBF, ConstantKernel

import cases as of
import fit
import surface


def columns(cases):
    return np.stack([u for k, u in enumerate(of.columns_of(cases)) if k != 5], axis=1)


def main():
    motions, *files = sys.argv[1:]
    cases = of.read(files, motions, 0.05)
    unseen = cases["cell"] % 5 == 0
    train = of.some(cases, (cases["structure"] < 260) & ~unseen)
    test = of.some(cases, (cases["structure"] >= 260) & unseen)
    score = lambda p: np.log(np.clip(np.where(test["overturned"], p, 1 - p), 1e-6, 1)).mean()
    curve = fit.overturning(train, of.knots_of(train))
    index = curve.index(of.columns_of(test))
    print(f"surface {surface.log_score(index, test['overturned']).mean():.4f} of {len(index)}", flush=True)
    for trees in (100, 200, 400):
        boosted = HistGradientBoostingClassifier(max_iter=trees, learning_rate=0.08, max_leaf_nodes=16, min_samples_leaf=200, l2_regularization=1.0)
        boosted.fit(columns(train), train["overturned"])
        print(f"boosting, {trees} trees {score(boosted.predict_proba(columns(test))[:, 1]):.4f}", flush=True)
    few = of.some(train, np.random.default_rng(5).choice(len(train["im4"]), 1500, replace=False))
    x, mean, scale = columns(few), columns(few).mean(axis=0), columns(few).std(axis=0)
    process = GaussianProcessClassifier(ConstantKernel(10.0) * RBF(np.ones(x.shape[1]) * 2.0), max_iter_predict=50)
    process.fit((x - mean) / scale, few["overturned"])
    p = process.predict_proba((columns(test) - mean) / scale)[:, 1]
    curve = fit.overturning(few, of.knots_of(train))
    index = curve.index(of.columns_of(test))
    print(f"Gaussian process of 1500 cases {score(p):.4f}; surface of them {surface.log_score(index, test['overturned']).mean():.4f}")


main()
