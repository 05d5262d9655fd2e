"""Structures that stand free and can rock."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Literal

import numpy as np

from . import _rockfrag
from ._types import StructureLike


class Structure:
    """A rocking structure, by its frequency parameter, slenderness and coefficient of restitution.

    Of a block or a frame that is known by its dimensions, use :meth:`block` or :meth:`frame`.

    Parameters
    ----------
    p : float
        Frequency parameter, rad/s. Of a rectangular block sqrt(3 g / (4 R)), R its half diagonal.
    alpha : float
        Slenderness, rad: the angle between the side and the diagonal.
    eta : float or 'housner'
        Coefficient of restitution: angular velocity after an impact over that before it; ``'housner'`` is
        1 - 1.5 sin(alpha)^2.
    name : str, optional
        What it is called in tables; of its parameters if not given.

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
        """A solid rectangular block.

        Parameters
        ----------
        width, height : float
            m.
        eta : float or 'housner', optional
            Coefficient of restitution; by default that of the geometry, 1 - 1.5 sin(alpha)^2 (Housner 1963).
        name : str, optional
            What it is called in tables.

        Returns
        -------
        Structure

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
        """A rigid beam on free-standing columns.

        Parameters
        ----------
        width, height : float
            Of a column, m.
        beam_mass_ratio : float
            Mass of the beam over that of all columns.
        eta : float or 'housner', optional
            Coefficient of restitution; by default that of the geometry.
        name : str, optional
            What it is called in tables.

        Returns
        -------
        Structure

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
        plain = {key: value if isinstance(value, str) else float(value) for key, value in given.items()}
        self._given = plain if name is None else {**plain, "name": name}
        self._made = made
        self._resolved = _rockfrag.structure(json.dumps(spec_of(self)))

    @property
    def name(self) -> str:
        """What it is called in tables."""
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
    given: Mapping[str, object] = structure._given if isinstance(structure, Structure) else structure
    numbers = {key: value.item() if isinstance(value, np.generic) else value for key, value in given.items() if value is not None}
    return {key.replace("_", "-"): value for key, value in numbers.items()}
