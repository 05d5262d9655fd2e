"""Probabilities by the universal fragility surface, of many structures and motions at once."""

from __future__ import annotations

import warnings
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _rockfrag
from .errors import OptionError, RockfragWarning

Numbers = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Probability:
    """Probabilities with 95 % limits, each of the shape of the question; NaN where there is none, such as P_ro without rocking."""

    #: No rocking: 1 below uplift, 0 from there on.
    p_nr: Numbers
    #: A demand above the limit state, in safe rocking.
    p_ex: Numbers
    p_ex_low: Numbers
    p_ex_high: Numbers
    #: Overturning, given rocking.
    p_ro: Numbers
    p_ro_low: Numbers
    p_ro_high: Numbers
    #: Failure over the whole tree, the one or the other.
    p_f: Numbers
    p_f_low: Numbers
    p_f_high: Numbers
    #: From the middle of the surface's domain (0) to its rim (1) and beyond.
    distance: Numbers
    #: Coefficient of restitution of the structure.
    eta: Numbers


def probability(
    *,
    pga: npt.ArrayLike,
    pgv: npt.ArrayLike,
    width: npt.ArrayLike | None = None,
    height: npt.ArrayLike | None = None,
    p: npt.ArrayLike | None = None,
    alpha: npt.ArrayLike | None = None,
    eta: npt.ArrayLike | None = None,
    suite: str | None = None,
    limit_state: float | None = None,
) -> Probability:
    """How likely structures are to rock too far and to overturn, by the surface that ``rockfrag evaluate`` has without fits.

    All arrays broadcast against each other::

        rockfrag.probability(width=0.5, height=2.0, pga=np.linspace(0.1, 1.0, 10), pgv=0.6).p_ro

    Args:
        pga: Peak ground acceleration, g.
        pgv: Peak ground velocity, m/s.
        width: Width of a solid block, m; with ``height``.
        height: Its height, m.
        p: Frequency parameter, rad/s, in place of dimensions; with ``alpha`` and ``eta``.
        alpha: Slenderness, rad.
        eta: Coefficient of restitution; that of a rectangular block (Housner) if dimensions are given and it is not.
        suite: Kind of motion: ``csgm`` (a pulse with high frequencies, the default), ``pulse`` or ``hfc``.
        limit_state: Demand |theta|max / alpha that P_ex is about, 0.02 to 0.5; 0.1 if not given.

    Returns:
        The probabilities. A :class:`RockfragWarning` says what is extrapolated or can hardly be meant.

    Raises:
        OptionError: A number that cannot be right, or neither dimensions nor p, alpha and eta.
    """
    given = {"width": width, "height": height, "p": p, "alpha": alpha, "eta": eta}
    names = [name for name, values in given.items() if values is not None]
    if {"width", "height"} - set(names) and {"p", "alpha", "eta"} - set(names):
        raise OptionError("no structure; expected width and height (m), or p, alpha and eta")
    arrays = [np.asarray(values, dtype=np.float64) for values in (pga, pgv, *(given[name] for name in names))]
    try:
        shaped = np.broadcast_arrays(*arrays)
    except ValueError as error:
        raise OptionError(f"arrays of different lengths: {error}") from error
    flat = [np.ascontiguousarray(array).reshape(-1) for array in shaped]
    said = _rockfrag.probability(dict(zip(names, flat[2:], strict=True)), flat[0], flat[1], suite, limit_state)
    for words in said.pop("warnings"):
        warnings.warn(words, RockfragWarning, stacklevel=2)
    return Probability(**{name: values.reshape(shaped[0].shape) for name, values in said.items()})
