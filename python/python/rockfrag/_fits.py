"""Fits of fragility curves to plain arrays."""

from __future__ import annotations

import warnings
from typing import TypeVar

import numpy as np
import numpy.typing as npt

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
    """Fits a fragility curve to outcomes: the probability of an event over a measure of intensity, or over two.

    The same fit as :func:`fit_pro`, of any arrays (Eqs. 19 to 24).

    Parameters
    ----------
    im : array_like of shape (n,), (n, 1) or (n, 2)
        Intensity of each case, above 0, in any unit. With two columns the curve is that of their hybrid (Eq. 23).
    outcome : array_like of shape (n,)
        Whether the event happened: bool, or 0 and 1.
    link : {'probit', 'logit', 'cloglog'}, default 'probit'
        Link between the linear predictor b0 + b1 ln(im) and the probability; the probit makes the lognormal curve.
    estimator : {'ml', 'firth'}, default 'ml'
        The likelihood, or Firth's penalised one, which has a maximum where a measure separates the outcomes, and less bias where events
        are few.
    cluster : array_like of shape (n,), optional
        A label for each case; those of one label (an earthquake, a station) may depend on each other. Standard errors and bands allow
        for it.
    im_name : str, default 'im'
        What the measure is called in names, summary and plot.

    Returns
    -------
    FragilityCurve

    Raises
    ------
    OptionError
        If shapes do not match, an intensity is not above 0, or an outcome is neither 0 nor 1.
    FitError
        If there is no curve: too few events, separation, a measure that does not vary.

    Warns
    -----
    RockfragWarning
        If the fit is questionable; ``curve.doubts`` lists the reasons.

    See Also
    --------
    fit_demand : P_ex, of demands.
    fit_failure : Both together.
    fit_pro : The same from a table of responses, for all measures at once.

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
    FragilityCurve: 14 events of 40 cases, probit, ml
           estimate      se     low   high
    theta     1.066  0.1274  0.8583  1.503
     beta    0.4667  0.1441  0.2765   1.02
    llf -18.1989, aic 40.3978, bic 43.7756, auc 0.830, brier 0.154
    doubt: few events: standard errors of theta and beta are too small; take profile_interval, and confidence_band for probabilities
    """
    measures, happened = _cases(im, outcome)
    curve = FragilityCurve(measures, happened, link=link, estimator=estimator, cluster=cluster, im_name=im_name)
    return _warned(curve)


def fit_demand(im: npt.ArrayLike, edp: npt.ArrayLike, *, limit_state: float, im_name: str = "im") -> DemandCurve:
    """Fits the demand in safe rocking, and so the probability that it exceeds a limit (Eqs. 14 to 17).

    The same fit as a univariate one of :func:`fit_pex`, of any arrays. pyFragility and others call this a cloud analysis.

    Parameters
    ----------
    im : array_like of shape (n,) or (n, 2)
        Intensity of each case, above 0, in any unit.
    edp : array_like of shape (n,)
        Demand of each case. Cases where it is NaN (it overturned) or 0 (it did not rock) are left out.
    limit_state : float
        Demand whose exceedance the probability is about.
    im_name : str, default 'im'
        What the measure is called in names, summary and plot.

    Returns
    -------
    DemandCurve

    Raises
    ------
    OptionError
        If shapes do not match, or an intensity or the limit is not above 0.
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
    measures, demand = _demands(im, edp)
    if not limit_state > 0.0:
        raise OptionError(f"limit_state is {limit_state}; expected a demand above 0")
    seen = np.isfinite(demand) & (demand > 0.0)
    return _warned(DemandCurve(measures[seen], demand[seen], limit_state=float(limit_state), im_name=im_name))


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
        Demand of each case; not looked at where it overturned.
    overturned : array_like of shape (n,)
        Whether it overturned: bool, or 0 and 1.
    limit_state : float
        Demand from which it counts as failed.
    estimator, cluster, im_name
        As of :func:`fit_fragility`.

    Returns
    -------
    FailureCurve
        With the curves of both branches, ``overturning`` and ``demand``.

    Raises
    ------
    OptionError, FitError
        As :func:`fit_fragility` and :func:`fit_demand`.

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
    measures, happened = _cases(im, overturned)
    overturning = FragilityCurve(measures, happened, link="probit", estimator=estimator, cluster=cluster, im_name=im_name)
    _, demand = _demands(im, edp)
    safe = np.where(happened, np.nan, demand)
    seen = np.isfinite(safe) & (safe > 0.0)
    law = DemandCurve(measures[seen], safe[seen], limit_state=float(limit_state), im_name=im_name)
    return _warned(FailureCurve(overturning, law, happened | (np.nan_to_num(safe) > limit_state)))


def _warned(curve: C) -> C:
    for doubt in curve.doubts:
        warnings.warn(doubt, RockfragWarning, stacklevel=3)
    return curve


def _columns_of(im: npt.ArrayLike) -> Floats:
    """Intensities of cases: of a single column the column."""
    values = np.asarray(im, dtype=np.float64)
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _cases(im: npt.ArrayLike, outcome: npt.ArrayLike) -> tuple[Floats, npt.NDArray[np.bool_]]:
    values = _columns_of(im)
    measures, shape = measures_of(values, values.ndim)
    happened = np.asarray(outcome)
    if happened.shape != shape or len(shape) != 1:
        raise OptionError(f"im has shape {values.shape}, outcome {happened.shape}; expected (n,) or (n, 2), and (n,)")
    wrong = np.flatnonzero((happened != 0) & (happened != 1))
    if wrong.size:
        raise OptionError(f"outcome: case {wrong[0]} is {happened[wrong[0]]!r}; expected bool, or 0 and 1")
    return measures, happened.astype(np.bool_)


def _demands(im: npt.ArrayLike, edp: npt.ArrayLike) -> tuple[Floats, Floats]:
    values, demand = _columns_of(im), np.asarray(edp, dtype=np.float64)
    measures, shape = measures_of(values, values.ndim)
    if demand.shape != shape or len(shape) != 1:
        raise OptionError(f"im has shape {values.shape}, edp {demand.shape}; expected (n,) or (n, 2), and (n,)")
    return measures, demand
