"""Fragility curves of plain arrays, by the fits of the library.

Words of regressions are those of statsmodels (``params``, ``bse``, ``cov_params``, ``conf_int``, ``llf``, ``aic``, ``bic``, ``nobs``,
``summary``), words of fragility those of pyFragility (``probability``, ``confidence_band``, ``profile_interval``, ``theta``, ``beta``).
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from . import _checks, _rockfrag, _show
from ._curve import Curve, Floats, Link, Regression, measures_of, quantile
from ._rockfrag import LEAST_EVENTS, MANY_CLUSTERS
from .errors import FitError, OptionError

Estimator = Literal["ml", "firth"]
Parameter = Literal["theta", "mu", "beta", "lambda"]

_WHY = {
    "too_few_events": f"fewer than {LEAST_EVENTS} events, or fewer than {LEAST_EVENTS} others; take more cases, or estimator='firth', which needs one of each",
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
_SEPARATED = "the measure separates the outcomes: how steep the curve is comes from Firth's penalty; see profile_interval, and take more cases"
_FEW = "few events: standard errors of theta and beta are too small; take profile_interval"
_FOR_PROBABILITIES = ", and confidence_band for probabilities"
_LIMIT_ONLY = "; a probability is little more than a bound, and its own limits may miss the truth"
#: Why Firth's estimator has no curve.
_ALL_OR_NONE = "all cases are events, or none are; take more cases"


def _clusters(
    cluster: npt.ArrayLike | None, seen: npt.NDArray[np.bool_], coefficients: int
) -> tuple[list[int] | None, list[str]]:
    """The clusters of the cases that are seen, and what to doubt where they are few."""
    if cluster is None:
        return None, []
    numbers = np.array(_checks.labels("cluster", cluster, seen.size))[seen]
    count = len(np.unique(numbers))
    if count <= coefficients:
        raise OptionError(
            f"cluster has {count} labels among {numbers.size} cases; expected {MANY_CLUSTERS} or more, at least {coefficients + 1}: errors of "
            f"{coefficients} coefficients by fewer mean nothing; leave cluster out"
        )
    few = f"{count} clusters: standard errors by fewer than {MANY_CLUSTERS} are too small"
    return numbers.tolist(), [few] if count < MANY_CLUSTERS else []


class FragilityCurve(Regression):
    """The probability of an event over one measure of intensity, or over two. :func:`fit_fragility` makes it.

    P = F(b0 + b1 ln im + ...), where ``link`` chooses F. With the probit, P = Phi((ln im - ln theta) / beta).
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
        _checks.word("link", link, get_args(Link))
        _checks.word("estimator", estimator, get_args(Estimator))
        groups, few_clusters = _clusters(cluster, np.ones(outcome.size, dtype=np.bool_), im.shape[1] + 1)
        self.cov_type = "nonrobust" if groups is None else "cluster"
        self._clusters = 0 if groups is None else len(set(groups))
        self.im, self.outcome, self.im_name = im, outcome, im_name
        #: How the index becomes a probability: probit, logit or cloglog.
        self.link: Link = link
        #: What was maximised: ml (the likelihood) or firth (Firth's penalised likelihood).
        self.estimator: Estimator = estimator
        fit = _rockfrag.fit_curve(self._columns(), outcome, link, estimator, groups)
        #: ok, or what to doubt: misfit, far_median, falling.
        self.status: str = fit["status"]
        if "params" not in fit:
            why = _ALL_OR_NONE if estimator == "firth" and self.status == "too_few_events" else _WHY[self.status]
            raise FitError(f"{fit['events']} events of {outcome.size} cases: {why}", self.status)
        self.params = fit["params"]
        self.params.flags.writeable = False
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
        #: Whether the measure separates the outcomes, so that there is a curve by Firth's penalty only.
        self.separated: bool = fit["separated"]
        doubts = [_DOUBTS[self.status]] if self.status in _DOUBTS else []
        says_little = min(fit["events"], outcome.size - fit["events"]) < LEAST_EVENTS
        #: What to doubt about the curve, in words.
        self.doubts: list[str] = [
            *doubts,
            *([_SEPARATED] if self.separated else []),
            *([_FEW + (_LIMIT_ONLY if says_little else _FOR_PROBABILITIES)] if fit["few_events"] else []),
            *few_clusters,
        ]

    def _columns(self) -> list[Floats]:
        return [np.ascontiguousarray(column) for column in self.im.T]

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        index, variance = self._linear(im)
        return index, np.sqrt(variance)

    def _link(self) -> Link:
        return self.link

    def _label(self) -> str:
        return f"{self.link}, median {_show.number(self.median)}, β {_show.number(self.beta)}"

    @property
    def theta(self) -> float:
        """The median: the intensity at which the event has probability one half. Of two measures, that of their hybrid."""
        return float(np.exp(self._parameters["mu"][0]))

    #: The same as :attr:`theta`.
    median = theta

    @property
    def beta(self) -> float:
        """The dispersion: one over the slope on ln im. With the probit, the standard deviation of ln capacity."""
        return self._parameters["beta"][0]

    @property
    def se_theta(self) -> float:
        """Standard error of :attr:`theta`, by the delta method."""
        return self.theta * self._parameters["mu"][1]

    @property
    def se_beta(self) -> float:
        """Standard error of :attr:`beta`, by the delta method."""
        return self._parameters["beta"][1]

    @property
    def lambda_(self) -> float | None:
        """Lambda of two measures, None of one: the hybrid measure is im1^(lambda/(1 + lambda)) im2^(1/(1 + lambda)) (Eq. 23)."""
        known = self._parameters.get("lambda")
        return None if known is None else known[0]

    def profile_interval(self, param: Parameter, level: float = 0.95) -> tuple[float, float]:
        """Computes limits of confidence by the profile likelihood, which need not be symmetric.

        They are the columns ``mu_profile_low``, ``mu_profile_high`` and so on of :func:`fit_pro`. They take the cases as independent:
        with ``cluster`` they are too narrow, and :meth:`summary` shows limits by the errors of the clusters.

        Parameters
        ----------
        param : {'theta', 'mu', 'beta', 'lambda'}
            The median, its logarithm, the dispersion, or lambda of two measures.
        level : float, default 0.95
            Probability with which the limits hold the truth.

        Returns
        -------
        low, high : float
            Infinite where the likelihood sets no limit.

        Raises
        ------
        OptionError
            If the curve has no such parameter, or ``level`` is not between 0 and 1.
        """
        _checks.word("param", param, ["mu", *self._shown()])
        name = "mu" if param == "theta" else param
        quantile(level)
        limits = _rockfrag.profile_limits(self._columns(), self.outcome, self.link, self.estimator, name, level)
        assert limits is not None
        low, high = np.exp(limits) if param == "theta" else limits
        return float(low), float(high)

    def _shown(self) -> list[Parameter]:
        """The parameters that have limits."""
        return ["theta", "beta", "lambda"] if "lambda" in self._parameters else ["theta", "beta"]

    def summary(self) -> _show.Summary:
        """Shows the parameters with standard errors and 95 % limits by the profile likelihood, or by the errors of clusters.

        Returns
        -------
        Summary
        """
        found = {**self._parameters, "theta": (self.theta, self.se_theta)}
        by_cluster = self.cov_type == "cluster"
        limits = self._clustered_interval if by_cluster else self.profile_interval
        rows = [[name, *map(_show.number, (*found[name], *limits(name)))] for name in self._shown()]
        low, high = ("low", "high") if by_cluster else ("profile low", "profile high")
        title = f"FragilityCurve over {self.im_name}: {self.outcome.sum()} events of {self.nobs} cases, {self.link}, {self.estimator}"
        title += f", errors and limits by {self._clusters} clusters" if by_cluster else ""
        scores = f"llf {self.llf:.4f}, aic {self.aic:.4f}, bic {self.bic:.4f}, auc {self.auc:.3f}, brier {self.brier:.3f}"
        return _show.Summary(title, [scores, *(f"doubt: {doubt}" for doubt in self.doubts)], ["", "estimate", "se", low, high], rows)

    def _clustered_interval(self, param: Parameter) -> tuple[float, float]:
        name = "mu" if param == "theta" else param
        value, error = self._parameters[name]
        low, high = (value + sign * quantile(0.95) * error for sign in (-1.0, 1.0))
        return (float(np.exp(low)), float(np.exp(high))) if param == "theta" else (low, high)

    def __repr__(self) -> str:
        return (
            f"FragilityCurve(median={self.median:.4g}, beta={self.beta:.4g}, link={self.link!r}, "
            f"events={int(self.outcome.sum())}, nobs={self.nobs}, status={self.status!r}{', separated=True' if self.separated else ''})"
        )


class DemandCurve(Regression):
    """The probability that the demand exceeds a limit, over a measure of intensity (Eqs. 14 to 16). :func:`fit_demand` makes it.

    ln edp is normal about ln a + b1 ln im + ..., with the standard deviation ``dispersion``.
    """

    def __init__(
        self,
        im: Floats,
        edp: Floats,
        seen: npt.NDArray[np.bool_],
        *,
        limit_state: float,
        cluster: npt.ArrayLike | None,
        im_name: str,
    ) -> None:
        groups, few_clusters = _clusters(cluster, seen, im.shape[1] + 1)
        self.cov_type = "HC1" if groups is None else "cluster"
        im, edp = im[seen], edp[seen]
        im.flags.writeable = edp.flags.writeable = False
        self.im, self.edp, self.im_name = im, edp, im_name
        #: The limit: the demand that is exceeded.
        self.limit_state: float = limit_state
        self.outcome = edp > limit_state
        columns = [np.ascontiguousarray(column) for column in im.T]
        fit = _rockfrag.fit_line(columns, np.ascontiguousarray(edp), groups)
        #: ok, or falling.
        self.status: str = fit["status"]
        if "params" not in fit:
            raise FitError(f"{edp.size} cases: {_WHY[self.status]}", self.status)
        self.params = fit["params"]
        self.params.flags.writeable = False
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
        self.doubts: list[str] = [*(["the demand falls as the measure grows"] if self.status == "falling" else []), *few_clusters]

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        ln_median, variance = self._linear(im)
        return _rockfrag.exceeding(ln_median, variance, self.limit_state, self.dispersion, float(self.df_resid))

    def _label(self) -> str:
        return f"P(edp > {_show.number(self.limit_state)})"

    def demand(self, im: npt.ArrayLike) -> Floats:
        """Computes the median demand at intensities.

        Parameters
        ----------
        im : array_like of shape (m,) or (m, 2)
            Intensities in the unit of the fit; of two measures a column each.

        Returns
        -------
        ndarray of shape (m,)
        """
        measures, shape = measures_of(im, self._count())
        median: Floats = np.exp(self._linear(measures)[0]).reshape(shape)[()]
        return median

    @property
    def theta(self) -> float:
        """The intensity at which the median demand is the limit. Of two measures, where both have this value."""
        return float(np.exp((np.log(self.limit_state) - self.params[0]) / self.params[1:].sum()))

    #: The same as :attr:`theta`.
    median = theta

    @property
    def beta(self) -> float:
        """The dispersion of the curve over ln im: that of the demand divided by the slope (``zeta`` of :func:`fit_pex`)."""
        return float(self.dispersion / self.params[1:].sum())

    @property
    def se_theta(self) -> float:
        """Standard error of :attr:`theta`, by the delta method."""
        slope = self.params[1:].sum()
        of_slopes = np.full(self.params.size - 1, -np.log(self.theta) / slope)
        return self.theta * self._error(np.array([-1.0 / slope, *of_slopes]))

    @property
    def se_beta(self) -> float:
        """Standard error of :attr:`beta`, by the delta method, of a normal demand about the line."""
        slope = self.params[1:].sum()
        of_slopes = np.full(self.params.size - 1, -self.beta / slope)
        return float(np.hypot(self._error(np.array([0.0, *of_slopes])), self.beta / np.sqrt(2.0 * self.df_resid)))

    def _error(self, gradient: Floats) -> float:
        return float(np.sqrt(gradient @ self._cov_params @ gradient))

    def summary(self) -> _show.Summary:
        """Shows the coefficients with robust standard errors and 95 % limits by Student's t.

        Returns
        -------
        Summary
        """
        limits = self.conf_int()
        columns = zip(self.param_names, self.params, self.bse, limits[:, 0], limits[:, 1])
        rows = [[name, *map(_show.number, map(float, cells))] for name, *cells in columns]
        title = f"DemandCurve over {self.im_name}: edp above {_show.number(self.limit_state)}, {self.nobs} cases"
        lines = [f"dispersion {self.dispersion:.4f}, R2 {self.rsquared:.4f}, errors {self.cov_type}", *(f"doubt: {doubt}" for doubt in self.doubts)]
        return _show.Summary(title, lines, ["", "estimate", "se", "low", "high"], rows)

    _ratio = "t"

    def _p_values(self, ratio: Floats) -> Floats:
        return np.array([_rockfrag.f_upper_tail(value, 1.0, float(self.df_resid)) for value in ratio**2])

    def _error_quantile(self, level: float) -> float:
        return _rockfrag.t_quantile(0.5 * (1.0 + level), float(self.df_resid))

    def __repr__(self) -> str:
        return (
            f"DemandCurve(limit_state={self.limit_state:g}, median={self.median:.4g}, beta={self.beta:.4g}, "
            f"rsquared={self.rsquared:.3f}, nobs={self.nobs}, status={self.status!r})"
        )


class FailureCurve(Curve):
    """The probability of failure given rocking: overturning, or a demand above the limit. :func:`fit_failure` makes it.

    P_f = P_ro + (1 - P_ro) P_ex (Eq. 12).
    """

    def __init__(self, overturning: FragilityCurve, demand: DemandCurve, failed: npt.NDArray[np.bool_]) -> None:
        #: P_ro, over all cases.
        self.overturning: FragilityCurve = overturning
        #: P_ex, over those that do not overturn.
        self.demand: DemandCurve = demand
        self.im, self.im_name, self.outcome = overturning.im, overturning.im_name, failed
        #: What to doubt about either curve, in words.
        self.doubts: list[str] = list(dict.fromkeys([*overturning.doubts, *demand.doubts]))

    def _probability(self, im: Floats) -> Floats:
        p_ro, p_ex = self.overturning._probability(im), self.demand._probability(im)
        return p_ro + (1.0 - p_ro) * p_ex

    def _limits(self, im: Floats, level: float) -> tuple[Floats, Floats]:
        both = [(curve._probability(im), *curve._limits(im, level)) for curve in (self.overturning, self.demand)]
        return _rockfrag.failure_limits(*both)

    def _label(self) -> str:
        return "failure"

    def summary(self) -> _show.Summary:
        """Shows median and dispersion of both curves with standard errors, and what to doubt.

        Returns
        -------
        Summary
        """
        curves: dict[str, FragilityCurve | DemandCurve] = {"overturning": self.overturning, f"edp above {_show.number(self.demand.limit_state)}": self.demand}
        rows = [[name, *map(_show.number, (curve.theta, curve.se_theta, curve.beta, curve.se_beta)), str(curve.nobs)] for name, curve in curves.items()]
        title = f"FailureCurve over {self.im_name}: {int(self.outcome.sum())} failures of {len(self.im)} cases"
        return _show.Summary(title, [f"doubt: {doubt}" for doubt in self.doubts], ["", "theta", "se", "beta", "se", "cases"], rows)

    def __repr__(self) -> str:
        return f"FailureCurve(overturning={self.overturning!r}, demand={self.demand!r})"
