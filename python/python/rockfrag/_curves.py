"""Fragility curves of plain arrays, by the fits of the library.

Words of regressions are those of statsmodels (``params``, ``bse``, ``cov_params``, ``conf_int``, ``llf``, ``aic``, ``bic``, ``nobs``,
``summary``), words of fragility those of pyFragility (``probability``, ``confidence_band``, ``profile_interval``, ``theta``, ``beta``).
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Literal, TypeVar

import numpy as np
import numpy.typing as npt

from . import _rockfrag, _show
from .errors import FitError, OptionError, RockfragWarning

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Floats = npt.NDArray[np.float64]
Link = Literal["probit", "logit", "cloglog"]
Estimator = Literal["ml", "firth"]
Parameter = Literal["theta", "beta", "lambda"]

_WHY = {
    "too_few_events": "fewer than 5 events, or fewer than 5 others; take more cases, or estimator='firth', which needs one of each",
    "too_few_cases": "too few cases; expected more than coefficients plus one",
    "separated": "the measure tells the outcomes apart without overlap, so that no curve is the most likely; take more cases, or "
    "estimator='firth'",
    "constant": "the measure (or the demand) does not vary",
    "collinear": "the measures do not vary independently of each other",
    "not_converged": "the iterations did not come to an end",
}
_DOUBTS = {
    "misfit": "its own tests reject the curve, and it is off by more than 0.05 somewhere",
    "far_median": "the median lies far outside of the data",
    "falling": "the probability falls as the measure grows",
}
_FEW = "few events: standard errors and conf_int are too narrow; profile_interval and confidence_band are not"


class _Curve:
    """A probability over a measure of intensity: what all curves can do."""

    im: Floats
    im_name: str
    #: The points to draw: where each case lies, and whether the event happened.
    outcome: npt.NDArray[np.bool_]

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        raise NotImplementedError

    def _link(self) -> Link:
        return "probit"

    def probability(self, im: npt.ArrayLike) -> Floats:
        """The probability at intensities.

        Parameters
        ----------
        im : array_like of shape (m,) or (m, 2)
            Intensities, in the unit of the fit; a column each of two measures.

        Returns
        -------
        ndarray of shape (m,)
        """
        measures, shape = _measures(im, self._count())
        return _probabilities(self._link(), self._index(measures)[0]).reshape(shape)[()]

    def confidence_band(self, im: npt.ArrayLike, level: float = 0.95) -> tuple[Floats, Floats]:
        """Limits of confidence of the probability, each intensity on its own.

        They are those of the index by the delta method, and so lie between 0 and 1.

        Parameters
        ----------
        im : array_like of shape (m,) or (m, 2)
            Intensities.
        level : float, default 0.95
            Probability with which the limits hold the truth.

        Returns
        -------
        low, high : ndarray of shape (m,)
        """
        measures, shape = _measures(im, self._count())
        index, error = self._index(measures)
        half = _quantile(level) * error
        low, high = (_probabilities(self._link(), bound).reshape(shape)[()] for bound in (index - half, index + half))
        return low, high

    #: The same as :meth:`confidence_band`.
    limits = confidence_band

    def plot(self, ax: Axes | None = None, *, im: npt.ArrayLike | None = None, level: float = 0.95) -> Axes:
        """Draws the curve, its limits of confidence, and the cases at 0 and 1.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; those of a new figure if not given. matplotlib is needed.
        im : array_like of shape (m,), optional
            Intensities at which to draw; those of the cases, and a tenth beyond, if not given.
        level : float, default 0.95
            Of the limits.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        OptionError
            If the curve is one of two measures, which has no single axis.
        """
        if self._count() == 2:
            raise OptionError("a curve of two measures has no single axis; draw probability(im) over the one that you want")
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.subplots(layout="constrained")[1]
        where = np.geomspace(self.im.min() / 1.1, self.im.max() * 1.1, 200) if im is None else np.asarray(im, dtype=float)
        (line,) = ax.plot(where, self.probability(where), label=self._label())
        low, high = self.confidence_band(where, level)
        ax.fill_between(where, low, high, color=line.get_color(), alpha=0.2, lw=0, label=f"{100 * level:g} % limits")
        ax.plot(self.im[:, 0], self.outcome.astype(float), "o", mfc="none", color=line.get_color(), alpha=0.5, label="cases")
        ax.set(xlabel=self.im_name, ylabel="probability", ylim=(-0.03, 1.03))
        return ax

    def _count(self) -> int:
        return int(self.im.shape[1])

    def _label(self) -> str:
        return "fitted"

    def summary(self) -> _show.Summary:
        """What was fitted, with errors and limits, to print or to show in a notebook.

        Returns
        -------
        Summary
        """
        raise NotImplementedError

    def _repr_html_(self) -> str:
        return self.summary()._repr_html_()

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return _same(vars(self), vars(other))

    __hash__ = None  # type: ignore[assignment]


class _Regression(_Curve):
    """A curve whose index is linear in the logarithms of the measures."""

    #: Coefficients: intercept, then the slope on each ln IM; shape (k,).
    params: Floats
    #: Their names.
    param_names: tuple[str, ...]
    _cov_params: Floats

    def cov_params(self) -> Floats:
        """Covariance of the coefficients.

        Returns
        -------
        ndarray of shape (k, k)
        """
        return self._cov_params.copy()

    @property
    def bse(self) -> Floats:
        """Standard errors of the coefficients, shape (k,)."""
        errors: Floats = np.sqrt(np.diag(self._cov_params))
        return errors

    @property
    def nobs(self) -> int:
        """Cases used."""
        return int(self.im.shape[0])

    def conf_int(self, alpha: float = 0.05) -> Floats:
        """Limits of confidence of the coefficients, by their standard errors.

        Parameters
        ----------
        alpha : float, default 0.05
            Probability with which the limits miss the truth.

        Returns
        -------
        ndarray of shape (k, 2)
        """
        half = self._error_quantile(1.0 - alpha) * self.bse
        limits: Floats = np.column_stack([self.params - half, self.params + half])
        return limits

    def _error_quantile(self, level: float) -> float:
        return _quantile(level)

    def _linear(self, im: Floats) -> tuple[Floats, Floats]:
        rows = np.column_stack([np.ones(len(im)), np.log(im)])
        return rows @ self.params, np.einsum("ij,jk,ik->i", rows, self._cov_params, rows)


class FragilityCurve(_Regression):
    """The probability of an event over a measure of intensity, or over two: what :func:`fit_fragility` gives.

    P = F(b0 + b1 ln im + ...), F as ``link`` says; with the probit Phi((ln im - ln theta) / beta).
    """

    def __init__(
        self,
        im: Floats,
        outcome: npt.NDArray[np.bool_],
        *,
        link: Link,
        estimator: Estimator,
        cluster: npt.ArrayLike | None,
        im_name: str,
    ) -> None:
        groups = None
        if cluster is not None:
            labels = np.asarray(cluster)
            if labels.shape != outcome.shape:
                raise OptionError(f"cluster has shape {labels.shape}; expected a label for each of {outcome.size} cases")
            groups = np.unique(labels, return_inverse=True)[1].tolist()
        self.im, self.outcome, self.im_name = im, outcome, im_name
        #: How the index becomes a probability: probit, logit or cloglog.
        self.link: Link = link
        #: What was maximised: ml (the likelihood) or firth (Firth's penalised one).
        self.estimator: Estimator = estimator
        fit = _rockfrag.fit_curve(self._columns(), outcome, link, estimator, groups)
        #: ok, or what to doubt: misfit, far_median, falling.
        self.status: str = fit["status"]
        if "params" not in fit:
            raise FitError(f"{fit['events']} events of {outcome.size} cases: {_WHY[self.status]}", self.status)
        self.params = fit["params"]
        names = [im_name] if im.shape[1] == 1 else [f"{im_name}{k + 1}" for k in range(im.shape[1])]
        self.param_names = ("intercept", *(f"ln({name})" for name in names))
        self._cov_params = fit["cov_params"]
        self._parameters = fit["parameters"]
        #: Log-likelihood, without a penalty.
        self.llf: float = fit["llf"]
        #: Akaike's criterion.
        self.aic: float = fit["aic"]
        #: Bayesian criterion.
        self.bic: float = fit["bic"]
        #: Area under the receiver operating characteristic.
        self.auc: float = fit["auc"]
        #: Brier score.
        self.brier: float = fit["brier"]
        #: p of Hosmer and Lemeshow's test, and of the likelihood-ratio test against a bent curve; none with few cases.
        self.tests: dict[str, float | None] = {"hosmer_lemeshow": fit["hosmer_lemeshow_p"], "spline": fit["spline_p"]}
        doubts = [_DOUBTS[self.status]] if self.status in _DOUBTS else []
        #: What to doubt about the curve, in words.
        self.doubts: list[str] = doubts + ([_FEW] if fit["few_events"] else [])

    def _columns(self) -> list[Floats]:
        return [np.ascontiguousarray(column) for column in np.log(self.im).T]

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        index, variance = self._linear(im)
        return index, np.sqrt(variance)

    def _link(self) -> Link:
        return self.link

    def _label(self) -> str:
        return f"median {_show.number(self.median)}, β {_show.number(self.beta)}"

    @property
    def theta(self) -> float:
        """The median: the intensity at which the event is as likely as not. Of two measures, of the hybrid one."""
        return float(np.exp(self._parameters["mu"][0]))

    #: The same as :attr:`theta`.
    median = theta

    @property
    def beta(self) -> float:
        """The dispersion: one over the slope on ln im. With the probit the standard deviation of ln of the capacity."""
        return self._parameters["beta"][0]

    @property
    def exponent(self) -> float | None:
        """Of two measures, lambda: the hybrid measure is im1^(lambda/(1 + lambda)) im2^(1/(1 + lambda)) (Eq. 23)."""
        known = self._parameters.get("lambda")
        return None if known is None else known[0]

    def profile_interval(self, param: Parameter, level: float = 0.95) -> tuple[float, float]:
        """Limits of confidence by the profile likelihood, which assumes no symmetry.

        Parameters
        ----------
        param : {'theta', 'beta', 'lambda'}
            Of what; lambda of two measures only.
        level : float, default 0.95
            Probability with which the limits hold the truth.

        Returns
        -------
        low, high : float
            Infinite where the likelihood sets no limit.
        """
        name = "mu" if param == "theta" else param
        if name not in self._parameters:
            raise OptionError(f"param is {param!r}; expected one of theta, beta, and of two measures lambda")
        _quantile(level)
        limits = _rockfrag.profile_limits(self._columns(), self.outcome, self.link, self.estimator, name, level)
        assert limits is not None
        low, high = np.exp(limits) if param == "theta" else limits
        return float(low), float(high)

    def summary(self) -> _show.Summary:
        """What was fitted: parameters with standard errors and 95 % limits by the profile likelihood.

        Returns
        -------
        Summary
        """
        theta = self.theta
        found = {**self._parameters, "theta": (theta, theta * self._parameters["mu"][1])}
        names: tuple[Parameter, ...] = ("theta", "beta", "lambda")
        shown: list[Parameter] = [name for name in names if name in found]
        rows = [[name, *map(_show.number, (*found[name], *self.profile_interval(name)))] for name in shown]
        title = f"FragilityCurve: {self.outcome.sum()} events of {self.nobs} cases, {self.link}, {self.estimator}"
        scores = f"llf {self.llf:.4f}, aic {self.aic:.4f}, bic {self.bic:.4f}, auc {self.auc:.3f}, brier {self.brier:.3f}"
        return _show.Summary(title, [scores, *(f"doubt: {doubt}" for doubt in self.doubts)], ["", "estimate", "se", "low", "high"], rows)

    def __repr__(self) -> str:
        return (
            f"FragilityCurve(median={self.median:.4g}, beta={self.beta:.4g}, link={self.link!r}, "
            f"events={int(self.outcome.sum())}, nobs={self.nobs}, status={self.status!r})"
        )


class DemandCurve(_Regression):
    """The probability of a demand above a limit over a measure of intensity: what :func:`fit_demand` gives (Eqs. 14 to 16).

    ln edp = ln a + b1 ln im + ..., normal about that with the standard deviation ``dispersion``.
    """

    def __init__(self, im: Floats, edp: Floats, *, limit_state: float, im_name: str) -> None:
        self.im, self.edp, self.im_name = im, edp, im_name
        #: The demand whose exceedance the probability is about.
        self.limit_state: float = limit_state
        self.outcome = edp > limit_state
        columns = [np.ascontiguousarray(column) for column in np.log(im).T]
        fit = _rockfrag.fit_line(columns, np.log(edp))
        #: ok, or falling.
        self.status: str = fit["status"]
        if "params" not in fit:
            raise FitError(f"{edp.size} cases: {_WHY[self.status]}", self.status)
        self.params = fit["params"]
        self.param_names = ("ln a", *(f"b{k + 1}" for k in range(im.shape[1])))
        self._cov_params = fit["cov_params"]
        #: Coefficient of determination.
        self.rsquared: float = fit["r2"]
        #: Standard deviation of ln edp about the line, with n - k degrees of freedom.
        self.dispersion: float = fit["residual_sd"]
        #: Degrees of freedom of that.
        self.df_resid: int = fit["df_resid"]
        #: p of Ramsey's test of the form.
        self.tests: dict[str, float | None] = {"reset": fit["reset_p"]}
        #: What to doubt about the curve, in words.
        self.doubts: list[str] = ["the demand falls as the measure grows"] if self.status == "falling" else []

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        ln_median, variance = self._linear(im)
        return _rockfrag.exceeding(ln_median, variance, self.limit_state, self.dispersion, float(self.df_resid))

    def _label(self) -> str:
        return f"P(edp > {_show.number(self.limit_state)})"

    def demand(self, im: npt.ArrayLike) -> Floats:
        """The median demand at intensities.

        Parameters
        ----------
        im : array_like of shape (m,) or (m, 2)
            Intensities.

        Returns
        -------
        ndarray of shape (m,)
        """
        measures, shape = _measures(im, self._count())
        median: Floats = np.exp(self._linear(measures)[0]).reshape(shape)[()]
        return median

    @property
    def theta(self) -> float:
        """The intensity of one measure at which the limit is as likely exceeded as not."""
        return float(np.exp((np.log(self.limit_state) - self.params[0]) / self.params[1:].sum()))

    #: The same as :attr:`theta`.
    median = theta

    @property
    def beta(self) -> float:
        """The dispersion of the curve over ln im: that of the demand over the slope (zeta of the stages)."""
        return float(self.dispersion / self.params[1:].sum())

    def summary(self) -> _show.Summary:
        """What was fitted: coefficients with standard errors and 95 % limits by Student's t.

        Returns
        -------
        Summary
        """
        limits = self.conf_int()
        columns = zip(self.param_names, self.params, self.bse, limits[:, 0], limits[:, 1])
        rows = [[name, *map(_show.number, map(float, cells))] for name, *cells in columns]
        title = f"DemandCurve: edp above {_show.number(self.limit_state)}, {self.nobs} cases"
        lines = [f"dispersion {self.dispersion:.4f}, R2 {self.rsquared:.4f}", *(f"doubt: {doubt}" for doubt in self.doubts)]
        return _show.Summary(title, lines, ["", "estimate", "se", "low", "high"], rows)

    def _error_quantile(self, level: float) -> float:
        _quantile(level)
        return _rockfrag.t_quantile(0.5 * (1.0 + level), float(self.df_resid))

    def __repr__(self) -> str:
        return (
            f"DemandCurve(limit_state={self.limit_state:g}, median={self.median:.4g}, beta={self.beta:.4g}, "
            f"rsquared={self.rsquared:.3f}, nobs={self.nobs}, status={self.status!r})"
        )


class FailureCurve(_Curve):
    """The probability of failure given rocking, by overturning or by a demand above the limit: what :func:`fit_failure` gives.

    P_f = P_ro + (1 - P_ro) P_ex (Eq. 12).
    """

    def __init__(self, overturning: FragilityCurve, demand: DemandCurve, failed: npt.NDArray[np.bool_]) -> None:
        #: P_ro, over all cases.
        self.overturning: FragilityCurve = overturning
        #: P_ex, over those that do not overturn.
        self.demand: DemandCurve = demand
        self.im, self.im_name, self.outcome = overturning.im, overturning.im_name, failed
        #: What to doubt about either curve, in words.
        self.doubts: list[str] = [*overturning.doubts, *demand.doubts]

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        return _rockfrag.failure(self.overturning._index(im), self.demand._index(im))

    def _label(self) -> str:
        return "failure"

    def summary(self) -> _show.Summary:
        """Median and dispersion of both curves, with what to doubt.

        Returns
        -------
        Summary
        """
        curves: dict[str, FragilityCurve | DemandCurve] = {"overturning": self.overturning, f"edp above {_show.number(self.demand.limit_state)}": self.demand}
        rows = [[name, *map(_show.number, (curve.median, curve.beta)), str(curve.nobs)] for name, curve in curves.items()]
        title = f"FailureCurve: {int(self.outcome.sum())} failures of {len(self.im)} cases"
        return _show.Summary(title, [f"doubt: {doubt}" for doubt in self.doubts], ["", "median", "beta", "cases"], rows)

    def __repr__(self) -> str:
        return f"FailureCurve(overturning={self.overturning!r}, demand={self.demand!r})"


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
        How the index becomes a probability; the probit makes the lognormal curve.
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
        If the curve is to be doubted; ``curve.doubts`` has the words.

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
    doubt: few events: standard errors and conf_int are too narrow; profile_interval and confidence_band are not
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


def _measures(im: npt.ArrayLike, count: int) -> tuple[Floats, tuple[int, ...]]:
    """Intensities as rows, and the shape of what is asked at them."""
    values = np.asarray(im, dtype=np.float64)
    if count == 2:
        if values.shape[-1:] != (2,):
            raise OptionError(f"im has shape {values.shape}; expected two measures, shape (m, 2)")
        rows, shape = values.reshape(-1, 2), values.shape[:-1]
    else:
        rows, shape = values.reshape(-1, 1), values.shape
    wrong = np.flatnonzero(~(rows > 0.0).all(axis=1))
    if wrong.size:
        raise OptionError(f"im: case {wrong[0]} is {rows[wrong[0]].tolist()}; expected numbers above 0")
    return rows, shape


def _columns_of(im: npt.ArrayLike) -> Floats:
    """Intensities of cases: of a single column the column."""
    values = np.asarray(im, dtype=np.float64)
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _cases(im: npt.ArrayLike, outcome: npt.ArrayLike) -> tuple[Floats, npt.NDArray[np.bool_]]:
    values = _columns_of(im)
    measures, shape = _measures(values, values.ndim)
    happened = np.asarray(outcome)
    if happened.shape != shape or len(shape) != 1:
        raise OptionError(f"im has shape {values.shape}, outcome {happened.shape}; expected (n,) or (n, 2), and (n,)")
    wrong = np.flatnonzero((happened != 0) & (happened != 1))
    if wrong.size:
        raise OptionError(f"outcome: case {wrong[0]} is {happened[wrong[0]]!r}; expected bool, or 0 and 1")
    return measures, happened.astype(np.bool_)


def _demands(im: npt.ArrayLike, edp: npt.ArrayLike) -> tuple[Floats, Floats]:
    values, demand = _columns_of(im), np.asarray(edp, dtype=np.float64)
    measures, shape = _measures(values, values.ndim)
    if demand.shape != shape or len(shape) != 1:
        raise OptionError(f"im has shape {values.shape}, edp {demand.shape}; expected (n,) or (n, 2), and (n,)")
    return measures, demand


def _probabilities(link: Link, index: Floats) -> Floats:
    return _rockfrag.probabilities(link, np.ascontiguousarray(index))


def _quantile(level: float) -> float:
    if not 0.0 < level < 1.0:
        raise OptionError(f"level is {level}; expected a probability between 0 and 1, such as 0.95")
    return _rockfrag.normal_quantile(0.5 * (1.0 + level))


def _same(a: object, b: object) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return bool(np.array_equal(a, b))
    return bool(a == b)
