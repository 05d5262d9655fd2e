"""The rocking response: of structures to motions, and of one to one over time."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _options, _rockfrag
from ._types import PathLike, Progress, TableLike


def simulate(
    motions: TableLike,
    *,
    p: float = 2.5,
    alpha: float = 0.20,
    eta: float = 0.92,
    structures: PathLike | Mapping[str, Any] | Iterable[Mapping[str, Any]] | None = None,
    path: str | None = None,
    trace: Iterable[Any] | str | None = None,
    partition: str | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Simulates the rocking response of structures to motions (section 2.2).

    Args:
        motions: What :func:`synthesize_motions` or :func:`import_motions` made, or any table of ``motion_id`` (integer or text), ``dt_s``
            (s) and ``acceleration_m_s2`` (a list of samples, m/s2).
        p: Frequency parameter of the structure, rad/s.
        alpha: Its slenderness, rad.
        eta: Its coefficient of restitution.
        structures: In place of these: a YAML or CSV file, or one or more mappings such as
            ``{"name": "frame", "p": 1.0, "alpha": 0.15, "eta": 0.92}`` or ``{"width": 0.5, "height": 2.0}`` (m).
        path: How the solver works: ``scalar``, ``avx2`` or ``avx512``; the fastest if not given.
        trace: Names of motions whose rotation over time becomes ``parts["trace"]`` of the result.
        partition: ``"i/n"``: of a folder of motions its file i, of a table an equal share; ``out`` is then a folder.

    Returns:
        One row a motion and structure: outcome, demand and dimensionless measures (Eqs. 7 and 13).
    """
    options = _options.to_json(
        p=p,
        alpha=alpha,
        eta=eta,
        structures=_options.structures(structures),
        path=path,
        trace=None if trace is None else _options.several(trace),
        partition=partition,
    )
    return _rockfrag.simulate(
        motions, options, _options.path(out), _options.manner(threads, progress, force)
    )


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
    #: Largest rotation over slenderness (Eq. 7).
    edp: float
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
        structure: ``{"p": 2.5, "alpha": 0.20, "eta": 0.92}`` (rad/s, rad, 1); or ``width`` and ``height`` of a block (m), with
            ``beam_mass_ratio`` for a frame.
        tail_s: Quiet time after the record, in which free rocking shows, s.

    Returns:
        Rotation and velocity over time.
    """
    samples = np.ascontiguousarray(acceleration_m_s2, dtype=np.float64)
    return Response(**_rockfrag.response(samples, dt_s, json.dumps(_options.structure(structure)), tail_s))
