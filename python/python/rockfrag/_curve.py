"""What all curves can do: probabilities with limits, drawing, comparing; and regressions on logarithms of measures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from . import _checks, _rockfrag, _show
from .errors import OptionError

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

Floats = npt.NDArray[np.float64]
Link = Literal["probit", "logit", "cloglog"]


class Curve:
    """A probability over a measure of intensity: the methods that all curves share."""

    im: Floats
    im_name: str
    #: The points to draw: where each case lies, and whether the event happened.
    outcome: npt.NDArray[np.bool_]

    def _index(self, im: Floats) -> tuple[Floats, Floats]:
        raise NotImplementedError

    def _probability(self, im: Floats) -> Floats:
        return probabilities(self._link(), self._index(im)[0])

    def _limits(self, im: Floats, level: float) -> tuple[Floats, Floats]:
        index, error = self._index(im)
        half = quantile(level) * error
        return probabilities(self._link(), index - half), probabilities(self._link(), index + half)

    def _link(self) -> Link:
        return "probit"

    def probability(self, im: npt.ArrayLike) -> Floats:
        """Computes the probability at intensities.

        Parameters
        ----------
        im : array_like of shape (m,) or (m, 2)
            Intensities in the unit of the fit; of two measures a column each.

        Returns
        -------
        ndarray of shape (m,)
        """
        measures, shape = measures_of(im, self._count())
        return self._probability(measures).reshape(shape)[()]

    def confidence_band(self, im: npt.ArrayLike, level: float = 0.95) -> tuple[Floats, Floats]:
        """Computes limits of confidence of the probability, at each intensity on its own.

        The delta method gives limits of the index; their probabilities lie between 0 and 1. Those of failure follow from those of both
        curves (Zou & Donner 2008) and are never below either.

        Parameters
        ----------
        im : array_like of shape (m,) or (m, 2)
            Intensities in the unit of the fit; of two measures a column each.
        level : float, default 0.95
            Probability with which the limits hold the truth.

        Returns
        -------
        low, high : ndarray of shape (m,)
        """
        measures, shape = measures_of(im, self._count())
        low, high = (limit.reshape(shape)[()] for limit in self._limits(measures, level))
        return low, high

    #: The same as :meth:`confidence_band`.
    limits = confidence_band

    def plot(self, ax: Axes | None = None, *, im: npt.ArrayLike | None = None, level: float = 0.95) -> Axes:
        """Draws the curve, its limits of confidence, and the cases at 0 and 1. Needs matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; a new figure if not given.
        im : array_like of shape (m,), optional
            Intensities to draw at; by default from the least case to the largest, and 10 % beyond.
        level : float, default 0.95
            Probability with which the limits hold the truth.

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
        where = np.geomspace(self.im.min() / 1.1, self.im.max() * 1.1, 200) if im is None else _checks.floats("im", im)
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
        """Shows what was fitted, with errors and limits, in a terminal or a notebook.

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


class Regression(Curve):
    """A curve whose index is linear in the logarithms of the measures."""

    #: Coefficients: intercept, then the slope on each ln IM; shape (k,).
    params: Floats
    #: Their names.
    param_names: tuple[str, ...]
    #: Where the standard errors come from, as in statsmodels: nonrobust (the likelihood), HC1 (robust to unequal variance) or cluster.
    cov_type: Literal["nonrobust", "HC1", "cluster"]
    _cov_params: Floats

    def cov_params(self) -> Floats:
        """Gives the covariance of the coefficients.

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
        """Computes limits of confidence of the coefficients from their standard errors.

        Parameters
        ----------
        alpha : float, default 0.05
            Probability with which the limits miss the truth: 0.05 for 95 % limits.

        Returns
        -------
        ndarray of shape (k, 2)

        Raises
        ------
        OptionError
            If ``alpha`` is not between 0 and 1.
        """
        half = self._error_quantile(1.0 - _checks.share("alpha", alpha, "0.05 for 95 % limits")) * self.bse
        limits: Floats = np.column_stack([self.params - half, self.params + half])
        return limits

    def summary_frame(self, alpha: float = 0.05) -> pandas.DataFrame:
        """Makes a table of the coefficients, with the columns of ``summary_frame`` in statsmodels. Needs pandas.

        Parameters
        ----------
        alpha : float, default 0.05
            Probability with which the limits miss the truth: 0.05 for 95 % limits.

        Returns
        -------
        pandas.DataFrame
            A row for each coefficient: estimate, standard error, their ratio z (or t), its p-value, lower and upper limit.
        """
        import pandas

        limits, ratio = self.conf_int(alpha), self.params / self.bse
        name = self._ratio
        columns = {"coef": self.params, "std err": self.bse, name: ratio, f"P>|{name}|": self._p_values(ratio)}
        columns |= {"Conf. Int. Low": limits[:, 0], "Conf. Int. Upp.": limits[:, 1]}
        return pandas.DataFrame(columns, index=list(self.param_names))

    #: What the ratio of a coefficient to its standard error is called.
    _ratio: Literal["z", "t"] = "z"

    def _p_values(self, ratio: Floats) -> Floats:
        values: Floats = 2.0 * probabilities("probit", -np.abs(ratio))
        return values

    def _error_quantile(self, level: float) -> float:
        return quantile(level)

    def _linear(self, im: Floats) -> tuple[Floats, Floats]:
        rows = np.column_stack([np.ones(len(im)), np.log(im)])
        return rows @ self.params, np.einsum("ij,jk,ik->i", rows, self._cov_params, rows)


def measures_of(im: npt.ArrayLike, count: int) -> tuple[Floats, tuple[int, ...]]:
    """Intensities as rows, and the shape of what is asked at them."""
    # A copy that nobody can change: a curve keeps what it was fitted to.
    values = _checks.floats("im", im, "finite numbers above 0")
    values.flags.writeable = False
    if count == 2:
        if values.shape[-1:] != (2,):
            raise OptionError(f"im has shape {values.shape}; expected two measures, shape (m, 2)")
        rows, shape = values.reshape(-1, 2), values.shape[:-1]
    else:
        rows, shape = values.reshape(-1, 1), values.shape
    wrong = np.flatnonzero(~((rows > 0.0) & np.isfinite(rows)).all(axis=1))
    if wrong.size:
        found = rows[wrong[0]]
        words = "missing" if np.isnan(found).any() else _checks.shown(found.item() if count == 1 else found.tolist())
        raise OptionError(f"im: case {wrong[0]} is {words}; expected finite numbers above 0")
    return rows, shape


def probabilities(link: Link, index: Floats) -> Floats:
    return _rockfrag.probabilities(link, np.ascontiguousarray(index))


def quantile(level: float) -> float:
    return _rockfrag.normal_quantile(0.5 * (1.0 + _checks.share("level", level, "0.95")))


def _same(a: object, b: object) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    if isinstance(a, np.ndarray) and isinstance(b, np.ndarray):
        return bool(np.array_equal(a, b))
    return bool(a == b)
