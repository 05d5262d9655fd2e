"""Arrays: one motion through one structure, the curve of given outcomes, probabilities at intensities.

Masked entries of a masked array are unknown: left out of fits, and refused elsewhere.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _bridge, _plots, _result, _rockfrag

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]


def known(array: ArrayLike) -> Floats:
    """Numbers, NaN where a mask hides them."""
    return np.ma.filled(np.ma.asarray(array, dtype=np.float64), np.nan)


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
    demand: float | None
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
        peak = "" if self.demand is None else f", largest rotation {self.demand:.3g} of the slenderness"
        impacts = f"{self.impacts} impact{'' if self.impacts == 1 else 's'}"
        structure = f"p {self.p:.3g} rad/s, alpha {self.alpha:.3g}, eta {self.eta:.3g}"
        return f"{self.outcome.replace('_', ' ')}{peak}, {impacts}; {structure}"


def simulate_motion(
    acceleration: ArrayLike, dt: float, *, tail: float = 10.0, **structure: float | str
) -> Response:
    """Simulates one structure under one motion: ground acceleration, m/s2, every ``dt`` s, then ``tail`` s of quiet.

    ``structure`` is ``p`` (rad/s), ``alpha`` (rad) and ``eta``; or ``width`` and ``height`` (m), with ``eta``
    and ``beam_mass_ratio`` if known. It stands on the ground: give the motion of a floor itself.
    """
    samples = known(acceleration)
    if samples.ndim != 1:
        raise ValueError(f"acceleration has {samples.ndim} dimensions; expected 1")
    words = ",".join(["name=structure", *(f"{name}={value}" for name, value in structure.items())])
    solved = _rockfrag.simulate_motion(samples.tobytes(), dt, words, tail)
    _bridge.warn(solved.pop("warnings"))
    array = {name: np.frombuffer(value) for name, value in solved.items() if isinstance(value, bytes)}
    return Response(**{**solved, **array})


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
    quantile: float = np.nan

    def probability(self, im: ArrayLike) -> Floats:
        """The probability at intensities, of their shape."""
        return self._at(im, 0.0)

    def limits(self, im: ArrayLike) -> tuple[Floats, Floats]:
        """The limits of the probability at intensities, by the delta method on z."""
        return self._at(im, -self.quantile), self._at(im, self.quantile)

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


#: What a print of probabilities shows.
LINES = {
    "p_nr": "does not rock",
    "p_ex": "exceeds, rocking safely",
    "p_ro": "overturns, given rocking",
    "p_f_r": "fails, given rocking",
    "p_f": "fails",
}


@dataclass(frozen=True, eq=False, repr=False)
class Probabilities(_plots.Shown):
    """The probabilities of the tree (Eq. 12) with 95 % limits, of the shape of the intensities.

    Of no rocking; given rocking, of exceeding the limit state (without overturning), of overturning, and of
    failure (either); and of failure whether it rocks or not.
    """

    p_nr: Floats
    p_ex: Floats
    p_ex_low: Floats
    p_ex_high: Floats
    p_ro: Floats
    p_ro_low: Floats
    p_ro_high: Floats
    p_f_r: Floats
    p_f_r_low: Floats
    p_f_r_high: Floats
    p_f: Floats
    #: The intensities: g and m/s.
    pga: Floats
    pgv: Floats
    #: Warnings about them.
    warnings: list[str]

    def plot(self, axes: Any = None) -> Any:
        """Draws the probabilities over PGA, or over PGV where PGA is one, by matplotlib; gives the axes."""
        pga, pgv = np.ravel(self.pga), np.ravel(self.pgv)
        if pga.size < 2 or len(np.unique(pga)) > 1 < len(np.unique(pgv)) and self.pga.ndim > 1:
            raise ValueError(f"probabilities of the shape {self.pga.shape} are no curve; expected (n,), n > 1")
        rocks = 1.0 - self.p_nr
        # Where nothing rocks there is no probability given rocking.
        overturns = [np.nan_to_num(rocks * p).ravel() for p in (self.p_ro, self.p_ro_low, self.p_ro_high)]
        named: Any = [("overturns", *overturns), ("overturns, or rocks too far", np.ravel(self.p_f), None, None)]
        over_pga = len(np.unique(pga)) > 1
        return _plots.curves(pga if over_pga else pgv, "PGA, g" if over_pga else "PGV, m/s", named, axes)

    def __repr__(self) -> str:
        def line(name: str) -> str:
            p, low, high = [self._known(name + end) for end in ("", "_low", "_high")]
            ends = " to ".join(sorted({f"{p.min():.3g}", f"{p.max():.3g}"}, key=float)) if p.size else "none"
            limits = f"  (95 % limits {low.min():.3g} to {high.max():.3g})" if low.size else ""
            return f"{name:6} {LINES[name]:<25} {ends}{limits}"

        number = np.size(self.p_nr)
        return "\n".join([f"Probabilities at {number} intensit{'y' if number == 1 else 'ies'}", *map(line, LINES)])

    def _known(self, name: str) -> Floats:
        values: Floats = np.ravel(getattr(self, name, ()))
        return values[~np.isnan(values)]


def probability(pga: ArrayLike, pgv: ArrayLike, **options: Any) -> Probabilities:
    """Predicts probabilities for one structure at PGA, g, and PGV, m/s: arrays that broadcast to one shape.

    The options are those of :func:`rockfrag.evaluate`: the structure, ``fits``, ``suite``, ``limit_state`` ...
    """
    given = np.broadcast_arrays(known(pga), known(pgv))
    for name, peaks in zip(("pga", "pgv"), given, strict=True):
        if np.isnan(peaks).any():
            raise ValueError(f"{name} has no value at {np.argwhere(np.isnan(peaks))[0].tolist()}")
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as folder:
        path = Path(folder, "intensities.parquet")
        _rockfrag.write_numbers({"pga_g": given[0].tobytes(), "pgv_m_s": given[1].tobytes()}, path)
        with _bridge.errors_without(folder):
            evaluated = _bridge.functions["evaluate"](path, **options)
        columns = columns_of(evaluated, Probabilities)
    arrays: dict[str, Any] = {name: column.reshape(given[0].shape) for name, column in columns.items()}
    return Probabilities(**arrays, pga=given[0], pgv=given[1], warnings=evaluated.warnings)


def columns_of(evaluated: _result.Result, kind: type, *more: str) -> dict[str, Floats]:
    """The columns of a table that are fields of a class, and more."""
    names = [field.name for field in fields(kind) if field.name.startswith("p_")]
    columns = _rockfrag.read_numbers(evaluated._table(), [*names, *more])
    return {name: np.frombuffer(column) for name, column in columns.items()}


@dataclass(frozen=True, eq=False, repr=False)
class Fragility(_plots.Shown):
    """Shares of the motions of one peak that rock an object, too far or until it overturns, with 95 % limits."""

    #: The peak: pga, in g, or pgv, in m/s; and its values.
    over: str
    intensity: Floats
    p_rocking: Floats
    p_failure: Floats
    p_failure_low: Floats
    p_failure_high: Floats
    p_overturning: Floats
    p_overturning_low: Floats
    p_overturning_high: Floats
    #: Of the object, among them ``overturning_theta``, ``overturning_beta`` and their limits.
    row: dict[str, Any]
    warnings: list[str]

    @property
    def label(self) -> str:
        return "PGA, g" if self.over == "pga" else "PGV, m/s"

    def plot(self, axes: Any = None) -> Any:
        """Draws the probabilities with their limits by matplotlib; gives the axes."""
        overturns = (self.p_overturning, self.p_overturning_low, self.p_overturning_high)
        fails = (self.p_failure, self.p_failure_low, self.p_failure_high)
        named: Any = [("overturns", *overturns), ("overturns, or rocks too far", *fails)]
        return _plots.curves(self.intensity, self.label, named, axes)

    def __repr__(self) -> str:
        name, unit = self.label.split(", ")
        ends = ["overturning_theta", "overturning_theta_low", "overturning_theta_high"]
        beyond = f"> {self.intensity[-1]:.3g} {unit}"
        half, low, high = [beyond if self.row[end] is None else f"{self.row[end]:.3g} {unit}" for end in ends]
        return f"half of the motions overturn it at {name} {half} (95 % limits {low} to {high})"


def fragility(*, over: str = "pgv", **options: Any) -> Fragility:
    """The fragility of one object over ``pgv`` or ``pga``; of a list :func:`rockfrag.evaluate` has all curves.

    The options are those of :func:`rockfrag.evaluate`: the object, ``magnitude``, ``vs30``, ``ratio``, ``hazard`` ...
    """
    evaluated = _bridge.functions["evaluate"](over=over, format="json", **options)
    rows = json.loads(evaluated.summary)
    if len(rows) != 1:
        raise ValueError(f"{len(rows)} objects; expected one, or evaluate(over='{over}') for the curves of all")
    peak = "pga_g" if over == "pga" else "pgv_m_s"
    arrays: dict[str, Any] = columns_of(evaluated, Fragility, peak)
    return Fragility(over, arrays.pop(peak), **arrays, row=rows[0], warnings=evaluated.warnings)
