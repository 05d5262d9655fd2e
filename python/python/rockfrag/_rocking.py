"""The rocking response of one structure to one motion over time."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _options, _rockfrag


@dataclass(frozen=True)
class Response:
    """Rotation over time, at every sample and every event, and what came of it."""

    #: Time from the first sample, s.
    time_s: npt.NDArray[np.float64]
    #: Rotation, rad.
    theta_rad: npt.NDArray[np.float64]
    #: Angular velocity, rad/s; at an impact, that after it.
    theta_dot_rad_s: npt.NDArray[np.float64]
    #: Times (s) of uplift, impact, rest and overturn, with these words.
    events: list[tuple[float, str]]
    #: no_rocking, safe_rocking or overturning.
    outcome: str
    #: Largest rotation over slenderness (Eq. 7); none if it overturns.
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
        """Rotation over slenderness."""
        return self.theta_rad / self.alpha_rad


def response(
    acceleration_m_s2: npt.ArrayLike, dt_s: float, structure: Mapping[str, Any], *, tail_s: float = 10.0
) -> Response:
    """Solves the rocking motion of one structure in one ground motion (section 2.2).

    Args:
        acceleration_m_s2: Ground acceleration, m/s2, linear between samples.
        dt_s: Time between samples, s.
        structure: ``{"p": 2.5, "alpha": 0.20, "eta": 0.92}`` (rad/s, rad, 1 or ``"housner"``); or ``width`` and ``height`` of a
            block (m), with ``beam_mass_ratio`` for a frame.
        tail_s: Quiet time after the record, in which free rocking shows, s.

    Returns:
        Rotation and velocity over time.
    """
    samples = np.ascontiguousarray(acceleration_m_s2, dtype=np.float64)
    return Response(**_rockfrag.response(samples, dt_s, json.dumps(_options.structure(structure)), tail_s))
