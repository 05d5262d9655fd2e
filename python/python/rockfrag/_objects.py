"""Objects and what comes of them: arrays in and out, without a file."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import partial
from inspect import Parameter, Signature, cleandoc
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _call, _plots, _rockfrag
from ._stages import Fields

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from os import PathLike
    from typing import Literal, Unpack

    from numpy.typing import ArrayLike, NDArray

    from ._rockfrag import Site

    Floats = NDArray[np.float64]


def known(array: ArrayLike) -> Floats:
    """Numbers, NaN where a mask hides them."""
    if isinstance(array, np.ma.MaskedArray):
        return np.ma.filled(array.astype(np.float64), np.nan)
    return np.asarray(array, dtype=np.float64)


#: What need not be made an array.
PLAIN = (float, int, type(None))


@dataclass(frozen=True, eq=False, repr=False)
class Response:
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
    #: During the motion; events has those of the quiet after it too.
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
        peak = "" if self.edp is None else f", largest rotation {self.edp:.3g} of the slenderness angle"
        return f"{self.outcome.replace('_', ' ')}{peak}"


@dataclass(eq=False, repr=False)
class States:
    """Probabilities of rocking; of failure (rocking beyond the limit state, or overturning); of overturning.

    In the paper 1 - P_nr, P_f and (1 - P_nr) P_ro. With 95 % limits, NaN where the model has none.
    """

    p_rocking: Floats
    p_failure: Floats
    p_failure_low: Floats
    p_failure_high: Floats
    p_overturning: Floats
    p_overturning_low: Floats
    p_overturning_high: Floats

    def __repr__(self) -> str:
        """A line a probability: the least and the largest of several, with the outermost limits."""

        def line(name: str) -> str:
            p, low, high = (np.ravel(getattr(self, name + end, np.nan)) for end in ("", "_low", "_high"))
            ends = " to ".join(sorted({f"{np.min(p):.3g}", f"{np.max(p):.3g}"}, key=float))
            has_limits = not np.isnan(low).all()
            return f"{name:13} {ends}" + (f" (95 % limits {np.nanmin(low):.3g} to {np.nanmax(high):.3g})" if has_limits else "")

        return "\n".join(map(line, ("p_rocking", "p_failure", "p_overturning")))


@dataclass(eq=False, repr=False)
class Probabilities(States):
    """The probabilities under motions: arrays of the shape of these, numbers under one."""

    warnings: list[str]


@dataclass(eq=False, repr=False)
class Rate(States):
    """How often an object rocks, fails and overturns at a site, with 95 % limits; NaN where not known."""

    #: Mean annual rates.
    rocking_per_year: float
    failure_per_year: float
    failure_per_year_low: float
    failure_per_year_high: float
    overturning_per_year: float
    overturning_per_year_low: float
    overturning_per_year_high: float
    return_period_years: float
    #: Share of the rate of overturning beyond the last point of the hazard curve.
    share_extrapolated: float
    #: Those of the probabilities.
    years: float
    warnings: list[str]


@dataclass(eq=False, repr=False)
class Fragility(States):
    """The shares of the motions of one peak that rock an object, too far or until it overturns."""

    #: The peak: pga, in g, or pgv, in m/s; and its values.
    over: str
    intensity: Floats
    #: ``overturning_theta``, ``failure_beta`` ...: medians and dispersions, with limits, as of evaluate.
    row: dict[str, float]
    warnings: list[str]

    @property
    def label(self) -> str:
        return "PGA, g" if self.over == "pga" else "PGV, m/s"

    def plot(self, axes: Any = None) -> Any:
        """Draws the probabilities with their limits by matplotlib; gives the axes."""
        return _plots.fragility(self, axes)

    def __repr__(self) -> str:
        name, unit = self.label.split(", ")
        ends = (self.row[f"overturning_theta{end}"] for end in ("", "_low", "_high"))
        last = self.intensity[-1]
        half, low, high = [f"{'> ' * (end != end)}{np.fmin(end, last):.3g} {unit}" for end in ends]
        return f"overturns at a median {name} of {half} (95 % limits {low} to {high})"


class Object:
    """An object, by its fields; lengths in m.

    ``limit_state`` is the rotation over the slenderness beyond which it fails. The universal surface
    predicts, for motions of the kind ``suite`` (recorded, csgm, pulse or hfc); or the fits in the folder ``fits``.
    """

    def __init__(
        self,
        *,
        limit_state: float = 0.1,
        suite: Literal["recorded", "csgm", "pulse", "hfc"] | None = None,
        fits: str | PathLike[str] | None = None,
        **fields: Unpack[Fields],
    ) -> None:
        words = {True: "yes", False: "no"}
        given = [(name, value) for name, value in fields.items() if value is not None]
        texts = [(name, words[value] if isinstance(value, bool) else str(value)) for name, value in given]
        self._object = _rockfrag.Object(texts, limit_state, suite, fits)
        self._given: dict[str, Any] = {**fields, "suite": suite, "fits": fits, "limit_state": limit_state}

    @property
    def parameters(self) -> tuple[float, float, float]:
        """p (rad/s), alpha (rad) and eta, of the weaker direction."""
        p, alpha, eta = self._object.parameters
        return p, alpha, eta

    def probability(
        self,
        pga: ArrayLike | None = None,
        pgv: ArrayLike | None = None,
        magnitude: ArrayLike | None = None,
        *,
        vs30: float | None = None,
    ) -> Probabilities:
        """Probabilities under motions of PGA (g) and PGV (m/s), arrays that broadcast to one shape.

        Of a motion with one peak the other is averaged over, as it is at typical sites, or with this ``vs30``
        (m/s). Without ``magnitude`` it is inferred from PGV / PGA.
        """
        given: list[Any] = [pga, pgv, magnitude]
        if pga is None and pgv is None:
            raise TypeError("probability() needs pga, pgv or both")
        shape: tuple[int, ...] = ()
        if not (isinstance(pga, PLAIN) and isinstance(pgv, PLAIN) and isinstance(magnitude, PLAIN)):
            arrays = [None if each is None else known(each) for each in given]
            shape = np.broadcast(*[each for each in arrays if each is not None]).shape
            given = [None if each is None else np.broadcast_to(each, shape) for each in arrays]
        sent = [each if isinstance(each, PLAIN) else each.tobytes() for each in given]
        found, warnings = self._object.probability(math.prod(shape), sent[0], sent[1], sent[2], vs30)
        if warnings:
            _call.warn(warnings)
        states = np.frombuffer(found).reshape(7, *shape)
        return Probabilities(*states, warnings)  # type: ignore[call-arg]

    def rate(self, site: Site, years: float = 50.0) -> Rate:
        """Annual rates, and the probabilities in so many years, at a site."""
        columns, warnings = self._object.rate(site, years)
        _call.warn(warnings)
        names = [field.name for field in fields(Rate) if field.name in columns]
        return Rate(**{name: np.frombuffer(columns[name])[0] for name in names}, warnings=warnings)

    def fragility(
        self,
        over: Literal["pga", "pgv"] = "pgv",
        *,
        magnitude: float | None = None,
        vs30: float | None = None,
        ratio: float | None = None,
    ) -> Fragility:
        """The fragility over PGV (m/s) or PGA (g) under the motions of typical sites.

        Magnitude, Vs30 (m/s) and PGV / PGA (s) narrow these; ``evaluate(over=..., hazard=...)`` is for a site.
        """
        columns, warnings = self._object.fragility(over, magnitude, vs30, ratio)
        _call.warn(warnings)
        arrays = {name: np.frombuffer(of) for name, of in columns.items() if isinstance(of, bytes)}
        row = {name: float(column[0]) for name, column in arrays.items() if len(column) == 1}
        points = {field.name: arrays[field.name] for field in fields(States)}
        intensity = arrays["pga_g" if over == "pga" else "pgv_m_s"]
        return Fragility(**points, over=over, intensity=intensity, row=row, warnings=warnings)

    def response(self, acceleration: ArrayLike, dt: float, *, tail: float = 10.0) -> Response:
        """The response over time to an acceleration (m/s2) every ``dt`` s, then ``tail`` s of quiet.

        It stands on what moves so: give the motion of a floor itself.
        """
        samples = known(acceleration)
        if samples.ndim != 1:
            raise ValueError(f"acceleration has {samples.ndim} dimensions; expected 1")
        solved = _rockfrag.simulate_motion(self._object, samples.tobytes(), dt, tail)
        _call.warn(solved.pop("warnings"))
        array = {name: np.frombuffer(value) for name, value in solved.items() if isinstance(value, bytes)}
        return Response(**{**solved, **array})

    def __repr__(self) -> str:
        p, alpha, eta = self.parameters
        given = ", ".join(f"{name}={value!r}" for name, value in self._given.items() if value is not None)
        return f"Object({given}): p {p:.3g} rad/s, alpha {alpha:.3g}, eta {eta:.3g}"

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(Object, **self._given), ()


Object.__doc__ = f"{cleandoc(Object.__doc__ or '')}\n\n{cleandoc(Fields.__doc__ or '')}"
Object.__signature__ = Signature(  # type: ignore[attr-defined]
    [Parameter(name, Parameter.KEYWORD_ONLY, default=None) for name in (*Fields.__annotations__, "suite", "fits")]
    + [Parameter("limit_state", Parameter.KEYWORD_ONLY, default=0.1)]
)


@dataclass(frozen=True, eq=False)
class Responses:
    """Responses to records: of the shape (records,) of one object, (records, objects) of several."""

    #: |theta|max / alpha (Eq. 7): 0 where it does not rock, NaN where it overturns.
    edp: Floats
    overturned: NDArray[np.bool_]


def simulate_motions(
    accelerations: Any,
    dt: ArrayLike,
    objects: Object | Sequence[Object],
    *,
    threads: int | None = None,
    progress: bool | Callable[[int, int], object] | None = None,
) -> Responses:
    """Simulates objects under records, with the solver of :func:`rockfrag.simulate`.

    ``accelerations`` (m/s2) is an array of the shape (records, samples), or one array a record; ``dt`` is
    their time step (s), or one a record. An object rocks in its weaker direction.
    """
    records, steps = [known(record) for record in accelerations], known(dt).ravel().tolist()
    if any(record.ndim != 1 for record in records) or len(steps) not in (1, len(records)):
        raise ValueError("expected accelerations of the shape (records, samples), and dt of all or each")
    solved = [each._object for each in ([objects] if isinstance(objects, Object) else objects)]
    told = _call.teller("simulate_motions", progress)
    sent = [record.tobytes() for record in records]
    edp, overturned, warning = _rockfrag.simulate_motions(sent, steps, solved, threads, told)
    _call.warn([warning] if warning else [])
    shape = (len(records),) if isinstance(objects, Object) else (len(records), len(solved))
    return Responses(np.frombuffer(edp).reshape(shape), np.frombuffer(overturned, dtype=bool).reshape(shape))
