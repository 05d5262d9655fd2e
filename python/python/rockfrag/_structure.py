"""Structures that stand free and can rock."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Literal

from . import _checks, _rockfrag
from ._types import StructureLike
from .errors import OptionError


class Structure:
    """A rocking structure, by its frequency parameter, slenderness and coefficient of restitution.

    :meth:`block` and :meth:`frame` make one from dimensions.

    Parameters
    ----------
    p : float
        Frequency parameter, rad/s; sqrt(3 g / (4 R)) for a rectangular block of half diagonal R.
    alpha : float
        Slenderness, rad: the angle between the side and the diagonal.
    eta : float or 'housner'
        Coefficient of restitution: angular velocity after an impact over that before it. ``'housner'`` is
        1 - 1.5 sin(alpha)^2.
    name : str, optional
        Name in tables; made of the parameters if not given.

    Raises
    ------
    OptionError
        If a parameter cannot be right, or is likely in another unit.

    Examples
    --------
    >>> from rockfrag import Structure
    >>> Structure(p=2.5, alpha=0.20, eta=0.92, name="electrical-equipment")
    Structure(p=2.5, alpha=0.2, eta=0.92, name='electrical-equipment')
    >>> block = Structure.block(0.5, 2.0)
    >>> round(block.p, 3), round(block.alpha, 3), round(block.eta, 3)
    (2.672, 0.245, 0.912)
    >>> block == Structure.block(width=0.5, height=2.0)
    True
    """

    __slots__ = ("_given", "_made", "_resolved")

    _given: dict[str, float | str]
    _made: str
    _resolved: tuple[str, float, float, float]

    def __init__(self, p: float, alpha: float, eta: float | Literal["housner"], *, name: str | None = None) -> None:
        self._set("Structure", {"p": p, "alpha": alpha, "eta": eta}, name)

    @classmethod
    def block(
        cls, width: float, height: float, *, eta: float | Literal["housner"] | None = None, name: str | None = None
    ) -> Structure:
        """Makes a solid rectangular block from its dimensions.

        Parameters
        ----------
        width, height : float
            Dimensions, m.
        eta : float or 'housner', optional
            Coefficient of restitution; 1 - 1.5 sin(alpha)^2 if not given (Housner 1963).
        name : str, optional
            Name in tables; made of the parameters if not given.

        Returns
        -------
        Structure

        Raises
        ------
        OptionError
            If a dimension cannot be right, or is likely in another unit.

        Examples
        --------
        >>> from rockfrag import Structure
        >>> Structure.block(0.4, 1.6, eta=0.9, name="museum-piece")
        Structure.block(width=0.4, height=1.6, eta=0.9, name='museum-piece')
        """
        return cls._made_of("Structure.block", {"width": width, "height": height}, eta, name)

    @classmethod
    def frame(
        cls,
        width: float,
        height: float,
        beam_mass_ratio: float,
        *,
        eta: float | Literal["housner"] | None = None,
        name: str | None = None,
    ) -> Structure:
        """Makes a frame: a rigid beam on free-standing columns.

        Parameters
        ----------
        width, height : float
            Dimensions of a column, m.
        beam_mass_ratio : float
            Mass of the beam over the mass of all columns.
        eta : float or 'housner', optional
            Coefficient of restitution; that of the geometry if not given.
        name : str, optional
            Name in tables; made of the parameters if not given.

        Returns
        -------
        Structure

        Raises
        ------
        OptionError
            If a dimension cannot be right, or is likely in another unit.

        Examples
        --------
        >>> from rockfrag import Structure
        >>> bent = Structure.frame(1.5, 9.0, beam_mass_ratio=4.0, name="bridge-bent")
        >>> round(bent.p, 3), round(bent.alpha, 3)
        (1.057, 0.165)
        """
        dimensions = {"width": width, "height": height, "beam_mass_ratio": beam_mass_ratio}
        return cls._made_of("Structure.frame", dimensions, eta, name)

    @classmethod
    def _made_of(cls, made: str, dimensions: dict[str, float], eta: float | str | None, name: str | None) -> Structure:
        structure = cls.__new__(cls)
        structure._set(made, {**dimensions, **({} if eta is None else {"eta": eta})}, name)
        return structure

    def _set(self, made: str, given: Mapping[str, float | str], name: str | None) -> None:
        plain = {key: _parameter(key, value) for key, value in given.items()}
        self._given = plain if name is None else {**plain, "name": _checks.text("name", name)}
        self._made = made
        self._resolved = _rockfrag.structure(json.dumps(spec_of(self)))

    @property
    def name(self) -> str:
        """Name in tables."""
        return self._resolved[0]

    @property
    def p(self) -> float:
        """Frequency parameter, rad/s."""
        return self._resolved[1]

    @property
    def alpha(self) -> float:
        """Slenderness, rad."""
        return self._resolved[2]

    @property
    def eta(self) -> float:
        """Coefficient of restitution."""
        return self._resolved[3]

    def __repr__(self) -> str:
        return f"{self._made}({', '.join(f'{key}={value!r}' for key, value in self._given.items())})"

    def __eq__(self, other: object) -> bool:
        return self._resolved == other._resolved if isinstance(other, Structure) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._resolved)


def spec_of(structure: StructureLike) -> dict[str, object]:
    """The parameters as given, by the names of the command line; of a mapping, without those that are None."""
    if isinstance(structure, Structure):
        given: Mapping[str, object] = structure._given
    elif isinstance(structure, Mapping):
        given = structure
    else:
        raise _checks.wrong("structure", structure, "a Structure, or a mapping of its parameters")
    return {key.replace("_", "-"): _parameter(key, value) for key, value in given.items() if value is not None}


def _parameter(name: str, value: object) -> float | str:
    """A parameter of a structure."""
    if name == "name":
        return _checks.text(name, value)
    known = ["p", "alpha", "eta", "width", "height", "beam_mass_ratio"]
    if name.replace("-", "_") not in known:
        raise OptionError(f"{name!r} is no parameter of a structure; expected name, {', '.join(known)}")
    if name != "eta":
        return _checks.number(name, value)
    if value == "housner":
        return "housner"
    return _checks.number(name, value, "a finite number, or 'housner'")
