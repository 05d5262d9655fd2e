"""Fits of fragility curves to plain arrays."""

from __future__ import annotations

import warnings
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from . import _checks
from ._curve import Floats, Link, measures_of
from ._curves import DemandCurve, Estimator, FailureCurve, FragilityCurve
from .errors import OptionError, RockfragWarning

C = TypeVar("C", FragilityCurve, DemandCurve, FailureCurve)


def fit_fragility(
    im: npt.ArrayLike,
    outcome: npt.ArrayLike,
    *,
    link: Link = "probit",
    estimator: Estimator = "ml",
    cluster: npt.ArrayLike | None = None,
    im_name: str = "im",
) -> FragilityCurve:
    """Fits a fragility curve to outcomes: the probability of an event over one measure of intensity, or over two.

    Makes the same fit as :func:`fit_pro`, of any arrays (Eqs. 19 to 24).

    Parameters
    ----------
    im : array_like of shape (n,), (n, 1) or (n, 2)
        Intensity of each case, above 0, in any unit. Two columns make a curve over their hybrid measure (Eq. 23).
    outcome : array_like of shape (n,)
        Whether the event happened: bool, or 0 and 1.
    link : {'probit', 'logit', 'cloglog'}, default 'probit'
        Link between the linear predictor b0 + b1 ln(im) and the probability. The probit makes the lognormal curve.
    estimator : {'ml', 'firth'}, default 'ml'
        ``'ml'`` maximises the likelihood, ``'firth'`` Firth's penalised likelihood. That has a maximum where a measure separates the
        outcomes, and less bias where events are few.
    cluster : array_like of shape (n,), optional
        A label for each case. Cases of one label (an earthquake, a station) may depend on each other; standard errors and bands
        allow for it. Errors by fewer than 20 clusters are too small.
    im_name : str, default 'im'
        Name of the measure in summary and plot.

    Returns
    -------
    FragilityCurve

    Raises
    ------
    OptionError
        If shapes do not match, an intensity is missing or not above 0, an outcome is neither 0 nor 1, or there are no more clusters than
        coefficients.
    FitError
        If there is no curve: too few events, separation, a measure that does not vary.

    Warns
    -----
    RockfragWarning
        If the fit is questionable; ``curve.doubts`` lists the reasons.

    See Also
    --------
    fit_demand : Fits P_ex to demands.
    fit_failure : Fits both together.
    fit_pro : Fits a table of responses, all measures at once.

    Examples
    --------
    >>> import rockfrag
    >>> forty = rockfrag.datasets.load_outcomes()
    >>> curve = rockfrag.fit_fragility(forty["pgv_m_s"], forty["overturned"], im_name="PGV, m/s")
    >>> curve
    FragilityCurve(median=1.066, beta=0.4667, link='probit', events=14, nobs=40, status='ok')
    >>> curve.probability([0.5, 1.0]).round(3)
    array([0.052, 0.446])
    >>> low, high = curve.confidence_band([0.5, 1.0])
    >>> curve.summary()
    FragilityCurve over PGV, m/s: 14 events of 40 cases, probit, ml
           estimate      se  profile low  profile high
    theta     1.066  0.1274       0.8583         1.503
     beta    0.4667  0.1441       0.2765          1.02
    llf -18.1989, aic 40.3978, bic 43.7756, auc 0.830, brier 0.154
    doubt: few events: standard errors of theta and beta are too small; take profile_interval, and confidence_band for probabilities
    """
    measures, happened = _cases(im, outcome)
    curve = FragilityCurve(measures, happened, link=link, estimator=estimator, cluster=cluster, im_name=im_name)
    return _warned(curve)


def fit_demand(
    im: npt.ArrayLike,
    edp: npt.ArrayLike,
    *,
    limit_state: float,
    cluster: npt.ArrayLike | None = None,
    im_name: str = "im",
) -> DemandCurve:
    """Fits the demand in safe rocking, and from it the probability that the demand exceeds a limit (Eqs. 14 to 17).

    Makes the same fit as a univariate one of :func:`fit_pex`, of any arrays. Others call it a cloud analysis.

    Parameters
    ----------
    im : array_like of shape (n,) or (n, 2)
        Intensity of each case, above 0, in any unit.
    edp : array_like of shape (n,)
        Demand of each case, 0 or more. The fit leaves out cases where it is NaN (overturned) or 0 (did not rock).
    limit_state : float
        Demand whose exceedance the probability is about.
    cluster : array_like of shape (n,), optional
        A label for each case. Cases of one label (an earthquake, a station) may depend on each other; standard errors and bands
        allow for it. Without labels the errors are robust to unequal variance (HC1), as those of :func:`fit_pex`.
    im_name : str, default 'im'
        Name of the measure in summary and plot.

    Returns
    -------
    DemandCurve

    Raises
    ------
    OptionError
        If shapes do not match, an intensity or the limit is not above 0, a demand is below 0 or infinite, or there are no more clusters
        than coefficients.
    FitError
        If there is no line: too few cases, or no variation.

    See Also
    --------
    fit_fragility, fit_failure, fit_pex

    Examples
    --------
    >>> import rockfrag
    >>> forty = rockfrag.datasets.load_outcomes()
    >>> curve = rockfrag.fit_demand(forty["pgv_m_s"], forty["edp"], limit_state=0.10)
    >>> curve
    DemandCurve(limit_state=0.1, median=0.5808, beta=1.399, rsquared=0.078, nobs=26, status='ok')
    >>> curve.probability([0.3, 0.6]).round(3)
    array([0.318, 0.509])
    >>> curve.demand([0.3, 0.6]).round(3)
    array([0.074, 0.101])
    """
    limit = _limit(limit_state)
    measures, demand = _demands(im, edp)
    overturned = np.isnan(demand)
    _expect_demands(demand, ~overturned, "cases are below 0 or infinite", "NaN where it overturned")
    return _warned(DemandCurve(measures, demand, demand > 0.0, limit_state=limit, cluster=cluster, im_name=im_name))


def fit_failure(
    im: npt.ArrayLike,
    edp: npt.ArrayLike,
    overturned: npt.ArrayLike,
    *,
    limit_state: float,
    estimator: Estimator = "ml",
    cluster: npt.ArrayLike | None = None,
    im_name: str = "im",
) -> FailureCurve:
    """Fits the probability of failure given rocking: overturning, or a demand above a limit (Eq. 12).

    Parameters
    ----------
    im : array_like of shape (n,) or (n, 2)
        Intensity of each case that rocks, above 0, in any unit.
    edp : array_like of shape (n,)
        Demand of each case, 0 or more; ignored where it overturned.
    overturned : array_like of shape (n,)
        Whether it overturned: bool, or 0 and 1.
    limit_state : float
        Demand above which it counts as failed.
    estimator : {'ml', 'firth'}, default 'ml'
        Of the curve of overturning, as in :func:`fit_fragility`.
    cluster : array_like of shape (n,), optional
        A label for each case, for the errors of both curves. Where each case has a label of its own, the limits are those of
        :func:`evaluate` for motions that share no magnitude and distance.
    im_name : str, default 'im'
        Name of the measure in summary and plot.

    Returns
    -------
    FailureCurve
        Holds the curves of both branches, ``overturning`` and ``demand``.

    Raises
    ------
    OptionError
        As :func:`fit_fragility` and :func:`fit_demand`; and if a case that did not overturn has no demand.
    FitError
        If either curve cannot be fitted.

    Warns
    -----
    RockfragWarning
        If either fit is questionable; ``curve.doubts`` lists the reasons.

    Examples
    --------
    >>> import rockfrag
    >>> forty = rockfrag.datasets.load_outcomes()
    >>> curve = rockfrag.fit_failure(forty["pgv_m_s"], forty["edp"], forty["overturned"], limit_state=0.10)
    >>> curve.probability([0.2, 0.5]).round(3)
    array([0.223, 0.486])
    >>> round(curve.overturning.median, 3), round(curve.demand.median, 3)
    (1.066, 0.581)
    """
    limit = _limit(limit_state)
    measures, happened = _cases(im, overturned)
    _, demand = _demands(im, edp)
    _expect_demands(demand, ~happened, "cases did not overturn and are missing, below 0 or infinite", "anything where it overturned")
    overturning = FragilityCurve(measures, happened, link="probit", estimator=estimator, cluster=cluster, im_name=im_name)
    seen = ~happened & (demand > 0.0)
    law = DemandCurve(measures, demand, seen, limit_state=limit, cluster=cluster, im_name=im_name)
    return _warned(FailureCurve(overturning, law, happened | (demand > limit)))


def _warned(curve: C) -> C:
    for doubt in curve.doubts:
        warnings.warn(doubt, RockfragWarning, stacklevel=3)
    return curve


def _limit(limit_state: float) -> float:
    limit = _checks.number("limit_state", limit_state, "a demand above 0, such as 0.1")
    if limit <= 0.0:
        raise _checks.wrong("limit_state", limit, "a demand above 0, such as 0.1")
    return limit


def _expect_demands(demand: Floats, counted: npt.NDArray[np.bool_], words: str, others: str) -> None:
    """That all demands that count are 0 or more, and finite."""
    wrong = np.flatnonzero(counted & ~((demand >= 0.0) & np.isfinite(demand)))
    if wrong.size:
        first = f"the first, case {wrong[0]}, is {demand[wrong[0]]:g}"
        raise OptionError(f"edp: {wrong.size} of {demand.size} {words}; {first}; expected 0 or more, 0 where it did not rock, {others}")


def _columns_of(im: npt.ArrayLike) -> Floats:
    """Intensities of cases: of a single column the column."""
    values = _checks.floats("im", im, "finite numbers above 0")
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _cases(im: npt.ArrayLike, outcome: npt.ArrayLike) -> tuple[Floats, npt.NDArray[np.bool_]]:
    values = _columns_of(im)
    measures, shape = measures_of(values, values.ndim)
    happened = _checks.floats("outcome", outcome, "bool, or 0 and 1", may_be_bool=True)
    if happened.shape != shape or len(shape) != 1:
        raise OptionError(f"im has shape {values.shape}, outcome {happened.shape}; expected (n,) or (n, 2), and (n,)")
    wrong = np.flatnonzero((happened != 0) & (happened != 1))
    if wrong.size:
        found = happened[wrong[0]]
        words = "missing" if np.isnan(found) else f"{found:g}"
        raise OptionError(f"outcome: case {wrong[0]} is {words}; expected bool, or 0 and 1")
    return measures, happened.astype(np.bool_)


def _demands(im: npt.ArrayLike, edp: npt.ArrayLike) -> tuple[Floats, Floats]:
    values, demand = _columns_of(im), _checks.floats("edp", edp, "demands of 0 or more")
    measures, shape = measures_of(values, values.ndim)
    if demand.shape != shape or len(shape) != 1:
        raise OptionError(f"im has shape {values.shape}, edp {demand.shape}; expected (n,) or (n, 2), and (n,)")
    return measures, demand
