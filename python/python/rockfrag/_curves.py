"""Fragility curves of plain arrays, by the fits of the library.

Words of regressions are those of statsmodels (``params``, ``bse``, ``cov_params``, ``conf_int``, ``llf``, ``aic``, ``bic``, ``nobs``,
``summary``), words of fragility those of pyFragility (``probability``, ``confidence_band``, ``profile_interval``, ``theta``, ``beta``).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _rockfrag, _show
from ._curve import Curve, Floats, Link, Regression, measures_of, quantile
from .errors import FitError, OptionError

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
_FEW = "few events: standard errors of theta and beta are too small; take profile_interval, and confidence_band for probabilities"


class FragilityCurve(Regression):
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
        quantile(level)
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


class DemandCurve(Regression):
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
        measures, shape = measures_of(im, self._count())
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
        quantile(level)
        return _rockfrag.t_quantile(0.5 * (1.0 + level), float(self.df_resid))

    def __repr__(self) -> str:
        return (
            f"DemandCurve(limit_state={self.limit_state:g}, median={self.median:.4g}, beta={self.beta:.4g}, "
            f"rsquared={self.rsquared:.3f}, nobs={self.nobs}, status={self.status!r})"
        )


class FailureCurve(Curve):
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
