"""Arrays: a response over time, and the curve of given outcomes.

Masked entries of a masked array are unknown: left out of fits, and refused elsewhere.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _plots, _rockfrag

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]


def known(array: ArrayLike) -> Floats:
    """Numbers, NaN where a mask hides them."""
    if isinstance(array, np.ma.MaskedArray):
        return np.ma.filled(array.astype(np.float64), np.nan)
    return np.asarray(array, dtype=np.float64)


@dataclass(frozen=True, eq=False, repr=False)
class Response(_plots.Shown):
    """The rocking response of a structure to a motion (section 2.2 of the paper)."""

    #: Moments, s: every sample, and every event between them.
    time: Floats
    #: Rotation, rad, and angular velocity, rad/s, at these moments.
    theta: Floats
    theta_dot: Floats
    #: Acceleration, m/s2, and velocity, m/s, of the ground.
    ground_acceleration: Floats
    ground_velocity: Floats
    #: Times (s) of uplift, impact, rest and overturn.
    events: list[tuple[float, str]]
    #: no_rocking, safe_rocking or overturning.
    outcome: str
    #: |theta|max / alpha (Eq. 7); none where it overturns.
    edp: float | None
    impacts: int
    #: Parameters of the structure: rad/s, rad, and the ratio of velocities at impact.
    p: float
    alpha: float
    eta: float

    @property
    def theta_over_alpha(self) -> Floats:
        return self.theta / self.alpha

    def plot(self, axes: Any = None) -> Any:
        """Draws rotation and ground acceleration over time, on two axes of matplotlib; gives these."""
        return _plots.response(self, axes)

    def __repr__(self) -> str:
        peak = "" if self.edp is None else f", largest rotation {self.edp:.3g} of the slenderness"
        impacts = f"{self.impacts} impact{'' if self.impacts == 1 else 's'}"
        structure = f"p {self.p:.3g} rad/s, alpha {self.alpha:.3g}, eta {self.eta:.3g}"
        return f"{self.outcome.replace('_', ' ')}{peak}, {impacts}; {structure}"


@dataclass(frozen=True, eq=False)
class FragilityCurve(_plots.Shown):
    """A lognormal fragility curve P = Phi(ln(im / theta) / beta) (Eq. 20); without a fit numbers are NaN."""

    #: ok, poor_fit (off by more than 0.15), few_events, wrong_sign, separated, too_few_events, degenerate or not_converged.
    status: str
    #: Cases, and those with the event.
    n: int
    n_events: int
    #: Median and dispersion, each with its limits of confidence.
    theta: float = np.nan
    theta_low: float = np.nan
    theta_high: float = np.nan
    beta: float = np.nan
    beta_low: float = np.nan
    beta_high: float = np.nan
    #: Of the curve from the share of events, in bins of intensity, beyond chance; NaN of too few cases.
    largest_difference: float = np.nan
    #: z = b0 + b1 ln im, and its covariance, row by row.
    coefficients: Sequence[float] = (np.nan, np.nan)
    covariance: Sequence[float] = (np.nan,) * 4
    #: Standard errors from a number to its limits.
    errors_to_limits: float = np.nan

    def probability(self, im: ArrayLike) -> Floats:
        """The probability at intensities, of their shape."""
        return self._at(im, 0.0)

    def limits(self, im: ArrayLike) -> tuple[Floats, Floats]:
        """The limits of the probability at intensities, by the delta method on z."""
        return self._at(im, -self.errors_to_limits), self._at(im, self.errors_to_limits)

    def _at(self, im: ArrayLike, errors: float) -> Floats:
        ln_im = np.log(np.asarray(im, dtype=np.float64))
        variance = self.covariance[0] + ln_im * (2 * self.covariance[1] + ln_im * self.covariance[3])
        z = self.coefficients[0] + self.coefficients[1] * ln_im
        z = z + errors * np.sqrt(variance) if errors else z
        return np.frombuffer(_rockfrag.normal_cdf(z.tobytes())).reshape(z.shape)

    def plot(self, im: ArrayLike | None = None, axes: Any = None) -> Any:
        """Draws the curve with its limits over intensities, by matplotlib; gives the axes."""
        if np.isnan(self.coefficients[0]):
            raise ValueError(f"no curve: {self.status}")
        x = known(im) if im is not None else self.theta * np.exp(self.beta * np.linspace(-2.5, 2.5, 101))
        named = [("fitted", self.probability(x), *self.limits(x))]
        return _plots.curves(x, "intensity", named, axes)


def fit_fragility(im: ArrayLike, outcome: ArrayLike, *, confidence: float = 0.95) -> FragilityCurve:
    """Fits the lognormal curve of Eq. 20 by maximum likelihood (Eqs. 21 and 22), with limits of a confidence.

    ``im`` has intensities above 0, and ``outcome`` of the same shape whether the event happened: true or
    false, 1 or 0.
    """
    intensities: Any = np.ma.asarray(im, dtype=np.float64)
    happened: Any = np.ma.asarray(outcome)
    if intensities.shape != happened.shape:
        shapes = f"im has the shape {intensities.shape} and outcome {happened.shape}"
        raise ValueError(f"{shapes}; expected the same")
    kept = ~(np.ma.getmaskarray(intensities) | np.ma.getmaskarray(happened))
    events = happened.data[kept]
    if not np.isin(events, (0, 1)).all():
        raise ValueError("outcome has other values than true and false, 1 and 0")
    fit = _rockfrag.fit_curve(intensities.data[kept].tobytes(), events.astype(bool).tobytes(), confidence)
    for name in ("theta", "beta"):
        if name in fit:
            fit[name], fit[f"{name}_low"], fit[f"{name}_high"] = fit[name]
    return FragilityCurve(**fit)
