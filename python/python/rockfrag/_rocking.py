"""The rocking response of one structure to one motion over time."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from . import _checks, _rockfrag, _show
from ._structure import spec_of
from ._types import StructureLike
from .errors import OptionError

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """Rotation over time, at every sample and every event, and the outcome. Two are equal if all values are."""

    #: Time from the first sample, s; shape (n,).
    time_s: npt.NDArray[np.float64]
    #: Rotation, rad; shape (n,).
    theta_rad: npt.NDArray[np.float64]
    #: Angular velocity, rad/s; at an impact, that after it; shape (n,).
    theta_dot_rad_s: npt.NDArray[np.float64]
    #: Times (s) of uplift, impact, rest and overturn, with these words.
    events: list[tuple[float, str]]
    #: no_rocking, safe_rocking or overturning.
    outcome: Literal["no_rocking", "safe_rocking", "overturning"]
    #: Largest rotation over slenderness (Eq. 7); None if it overturns.
    edp: float | None
    #: Impacts within the duration of the record.
    impacts: int
    #: Frequency parameter of the structure, rad/s.
    p_rad_s: float
    #: Its slenderness, rad.
    alpha_rad: float
    #: Its coefficient of restitution.
    eta: float

    @property
    def theta_over_alpha(self) -> npt.NDArray[np.float64]:
        """Rotation over slenderness, shape (n,)."""
        return self.theta_rad / self.alpha_rad

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws rotation over slenderness against time, with a tick at each impact. Needs matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; a new figure if not given.

        Returns
        -------
        matplotlib.axes.Axes
        """
        if ax is None:
            import matplotlib.pyplot as plt

            ax = plt.subplots(layout="constrained")[1]
        ax.plot(self.time_s, self.theta_over_alpha, lw=1)
        impacts = [time for time, event in self.events if event == "impact"]
        ax.plot(impacts, np.zeros(len(impacts)), "|", color="0.4")
        ax.set(xlabel="time, s", ylabel="θ / α", title=self._words())
        return ax

    def _words(self) -> str:
        demand = "" if self.edp is None else f", edp {_show.number(self.edp)}"
        return f"{self.outcome}{demand}, {self.impacts} impacts"

    def __repr__(self) -> str:
        last = self.time_s[-1] if self.time_s.size else 0.0
        return f"<rockfrag.Response: {self._words()}, {self.time_s.size} points in {_show.number(float(last))} s>"

    def _repr_html_(self) -> str:
        rows = [[name, _show.number(getattr(self, name))] for name in ("p_rad_s", "alpha_rad", "eta")]
        return _show.Summary(f"rockfrag.Response: {self._words()}", [], ["", ""], rows)._repr_html_()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Response):
            return NotImplemented
        pairs = ((getattr(self, field.name), getattr(other, field.name)) for field in fields(self))
        return all(np.array_equal(a, b) if isinstance(a, np.ndarray) else a == b for a, b in pairs)

    __hash__ = None  # type: ignore[assignment]


def response(acceleration_m_s2: npt.ArrayLike, dt_s: float, structure: StructureLike, *, tail_s: float = 10.0) -> Response:
    """Computes the rocking motion of one structure in one ground motion (section 2.2).

    Parameters
    ----------
    acceleration_m_s2 : array_like of shape (n,)
        Ground acceleration, m/s2, linear between samples.
    dt_s : float
        Time between samples, s.
    structure : Structure or mapping
        The structure, or its parameters: ``{"p": 2.5, "alpha": 0.20, "eta": 0.92}``.
    tail_s : float, default 10.0
        Time without ground motion after the record, in which free rocking shows, s; 0 to 1000.

    Returns
    -------
    Response
        Rotation and velocity over time, and the outcome.

    Raises
    ------
    OptionError
        If a parameter of the structure is missing or cannot be right, or the acceleration has fewer than 2 samples or one that is not finite.

    Examples
    --------
    >>> import numpy as np, rockfrag
    >>> time = np.arange(0.0, 4.0, 0.01)
    >>> pulse = np.where(time < 1.2, 4.0 * np.sin(2 * np.pi * time / 1.2), 0.0)
    >>> block = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92)
    >>> rockfrag.response(pulse, 0.01, block)
    <rockfrag.Response: overturning, 1 impacts, 247 points in 2.432 s>
    """
    samples = _checks.floats("acceleration_m_s2", acceleration_m_s2, "accelerations in m/s2")
    if samples.ndim != 1:
        raise OptionError(f"acceleration_m_s2 has shape {samples.shape}; expected one motion, shape (n,)")
    step, tail = _checks.number("dt_s", dt_s), _checks.number("tail_s", tail_s)
    return Response(**_rockfrag.response(samples, step, json.dumps(spec_of(structure)), tail))
