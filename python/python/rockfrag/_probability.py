"""Probabilities by the universal fragility surface, of many structures and motions at once."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, fields
from itertools import islice
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from . import _checks, _rockfrag, _show
from ._structure import Structure
from .errors import OptionError, RockfragWarning

if TYPE_CHECKING:
    import pandas

Numbers = npt.NDArray[np.float64]

#: The probabilities that are shown, in words,
_WORDS = {
    "p_nr": "no rocking",
    "p_ex": "above the limit state, in safe rocking",
    "p_ro": "overturning, given rocking",
    "p_o": "overturning",
    "p_f": "failure: the one or the other",
}
#: and of how many answers.
_SHOWN = 4


@dataclass(frozen=True, eq=False, repr=False)
class Probability:
    """Probabilities with 95 % limits, each of the shape of the arguments; NaN where there is none, such as P_ro without rocking."""

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
    #: Overturning, with or without rocking: p_ro where it rocks, 0 where it does not.
    p_o: Numbers
    p_o_low: Numbers
    p_o_high: Numbers
    #: Failure, the one or the other, with or without rocking.
    p_f: Numbers
    p_f_low: Numbers
    p_f_high: Numbers
    #: From the middle of the surface's domain (0) to its rim (1) and beyond.
    distance: Numbers
    #: Coefficient of restitution of the structure.
    eta: Numbers

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Probability):
            return NotImplemented
        return all(np.array_equal(getattr(self, at.name), getattr(other, at.name), equal_nan=True) for at in fields(self))

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return repr(self._summary())

    def _repr_html_(self) -> str:
        return self._summary()._repr_html_()

    def _summary(self) -> _show.Summary:
        """The first answers in words, with their limits."""
        shape = np.shape(self.p_nr)
        places = list(islice(np.ndindex(shape), _SHOWN))
        title = "Probability, with 95 % limits" + (f", of shape {shape}" if shape else "")
        rest = np.size(self.p_nr) - len(places)
        head = ["", "of", *(str(list(place)) if place else "" for place in places)]
        rows = [[name, words, *(self._cell(name, place) for place in places)] for name, words in _WORDS.items()]
        return _show.Summary(title, [f"and {rest} more"] if rest else [], head, rows)

    def _cell(self, name: str, place: tuple[int, ...]) -> str:
        # What has no limits is exact.
        limits = (getattr(self, f"{name}_{at}", self.p_nr) for at in ("low", "high"))
        value, low, high = (np.asarray(of)[place] for of in (getattr(self, name), *limits))
        told = f" ({_show.number(low)} to {_show.number(high)})" if low < high else ""
        return "-" if np.isnan(value) else _show.number(value) + told

    def to_pandas(self) -> pandas.DataFrame:
        """Makes a table, a row for each answer, of several dimensions in the order of C. Needs pandas.

        Returns
        -------
        pandas.DataFrame
        """
        import pandas

        return pandas.DataFrame({at.name: np.ravel(getattr(self, at.name)) for at in fields(self)})


def probability(
    structure: Structure | None = None,
    *,
    pga: npt.ArrayLike,
    pgv: npt.ArrayLike,
    width: npt.ArrayLike | None = None,
    height: npt.ArrayLike | None = None,
    p: npt.ArrayLike | None = None,
    alpha: npt.ArrayLike | None = None,
    eta: npt.ArrayLike | None = None,
    suite: Literal["csgm", "pulse", "hfc"] | None = None,
    limit_state: float | None = None,
) -> Probability:
    """Computes probabilities of rocking too far and of overturning from the universal surface, without fits.

    All arrays broadcast against each other.

    Parameters
    ----------
    structure : Structure, optional
        One structure, instead of parameters or dimensions.
    pga, pgv : array_like
        Peak ground acceleration, g, and velocity, m/s.
    width, height : array_like, optional
        Dimensions of solid blocks, m.
    p, alpha, eta : array_like, optional
        Frequency parameter, rad/s, slenderness, rad, and coefficient of restitution, instead of dimensions. ``eta`` also goes with
        dimensions; the default is then that of a rectangular block (Housner 1963).
    suite : {'csgm', 'pulse', 'hfc'}, optional
        Kind of motion: pulse with high frequencies (csgm, the default), or one of the two alone.
    limit_state : float, optional
        Demand |theta|max / alpha whose exceedance P_ex is about, 0.02 to 0.5; 0.1 if not given.

    Returns
    -------
    Probability
        Probabilities and limits, each of the shape to which the arguments broadcast.

    Warns
    -----
    RockfragWarning
        If an answer is extrapolated, a value is likely in another unit, or what rocks has a PGV of 0, of which there is no answer.

    Raises
    ------
    OptionError
        If a number cannot be right, shapes do not broadcast, or there are neither dimensions nor p, alpha and eta.

    Examples
    --------
    >>> import rockfrag
    >>> rockfrag.probability(width=0.5, height=2.0, pga=[0.3, 0.5, 0.8], pgv=0.6).p_ro.round(2)
    array([0.  , 0.26, 0.21])
    >>> rockfrag.probability(rockfrag.Structure.block(0.5, 2.0), pga=0.5, pgv=0.6).p_ro.round(2)
    np.float64(0.26)
    """
    given = {"width": width, "height": height, "p": p, "alpha": alpha, "eta": eta}
    if structure is not None:
        if not isinstance(structure, Structure):
            raise _checks.wrong("structure", structure, "a Structure")
        if any(values is not None for values in given.values()):
            raise OptionError("a structure and parameters of one; expected one of the two")
        given = {"p": structure.p, "alpha": structure.alpha, "eta": structure.eta}
    names = [name for name, values in given.items() if values is not None]
    if {"width", "height"} - set(names) and {"p", "alpha", "eta"} - set(names):
        missing = [sorted(group - set(names)) for group in ({"width", "height"}, {"p", "alpha", "eta"}) if group & set(names) - {"eta"}]
        told = f"{' and '.join(names)} without {' and '.join(missing[0])}" if missing else "no structure"
        raise OptionError(f"{told}; expected a Structure, width and height (m), or p, alpha and eta")
    if suite is not None:
        _checks.word("suite", suite, ("csgm", "pulse", "hfc"))
    limit = None if limit_state is None else _checks.number("limit_state", limit_state)
    asked = {"pga": pga, "pgv": pgv, **given}
    arrays = [_checks.floats(name, asked[name]) for name in ("pga", "pgv", *names)]
    try:
        shaped = np.broadcast_arrays(*arrays)
    except ValueError as error:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in zip(("pga", "pgv", *names), arrays))
        raise OptionError(f"shapes do not go together: {shapes}; expected shapes that broadcast") from error
    flat = [np.ascontiguousarray(array).reshape(-1) for array in shaped]
    said, doubts = _rockfrag.probability(dict(zip(names, flat[2:], strict=True)), flat[0], flat[1], shaped[0].shape, suite, limit)
    for words in doubts:
        warnings.warn(words, RockfragWarning, stacklevel=2)
    return Probability(**{name: values.reshape(shaped[0].shape)[()] for name, values in said.items()})
