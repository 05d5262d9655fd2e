"""Small data to try rockfrag on, shipped with it.

Each function gives a dict of columns, as ``polars.DataFrame`` and ``pandas.DataFrame`` take them, or structures.
"""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TypedDict

import numpy as np
import numpy.typing as npt

from .._structure import Structure

__all__ = ["Hazard", "Outcomes", "Published", "load_hazard", "load_outcomes", "load_paper", "load_structures"]

Floats = npt.NDArray[np.float64]
Words = npt.NDArray[np.str_]


class Outcomes(TypedDict):
    """The columns of :func:`load_outcomes`, each of shape (40,)."""

    motion: Words
    #: Peak ground acceleration, g.
    pga_g: Floats
    #: Peak ground velocity, m/s.
    pgv_m_s: Floats
    #: Period of the velocity pulse, s.
    tp_s: Floats
    #: Largest rotation over slenderness; NaN where it overturned.
    edp: Floats
    overturned: npt.NDArray[np.bool_]


class Hazard(TypedDict):
    """The columns of :func:`load_hazard`."""

    #: Peak ground acceleration, g.
    pga_g: Floats
    #: 1/year.
    annual_rate_of_exceedance: Floats


class Published(TypedDict):
    """The columns of :func:`load_paper`."""

    quantity: Words
    place: Words
    suite: Words
    structure: Words
    published: Floats
    #: Limits of what is printed so, NaN where no number is.
    print_low: Floats
    print_high: Floats


def load_outcomes() -> Outcomes:
    """Loads forty outcomes of one block, to fit fragility curves to.

    The block of 0.5 m by 2.0 m meets forty motions with a velocity pulse. The motions are made up, not recorded.

    Returns
    -------
    dict of ndarray
        ``motion``, ``pga_g``, ``pgv_m_s``, ``tp_s``, ``edp``, ``overturned``, each of shape (40,).

    Examples
    --------
    >>> from rockfrag.datasets import load_outcomes
    >>> forty = load_outcomes()
    >>> int(forty["overturned"].sum()), forty["pgv_m_s"].shape
    (14, (40,))
    """
    columns = _columns("outcomes.csv")
    return {
        "motion": np.array(columns["motion"]),
        "pga_g": _numbers(columns["pga_g"]),
        "pgv_m_s": _numbers(columns["pgv_m_s"]),
        "tp_s": _numbers(columns["tp_s"]),
        "edp": _numbers(columns["edp"]),
        "overturned": _numbers(columns["overturned"]).astype(np.bool_),
    }


def load_hazard() -> Hazard:
    """Loads an example of a hazard curve near an active fault, of no real site.

    Returns
    -------
    dict of ndarray
        ``pga_g`` and ``annual_rate_of_exceedance``, as ``evaluate(hazard=...)`` takes them.

    Examples
    --------
    >>> from rockfrag.datasets import load_hazard
    >>> hazard = load_hazard()
    >>> float(hazard["pga_g"][0]), float(hazard["annual_rate_of_exceedance"][0])
    (0.01, 0.2)
    """
    columns = _columns("hazard.csv")
    rates = _numbers(columns["annual_rate_of_exceedance"])
    return {"pga_g": _numbers(columns["pga_g"]), "annual_rate_of_exceedance": rates}


def load_paper() -> Published:
    """Loads the numbers that Dimitrakopoulos & Paraskeva (2015) publish.

    Returns
    -------
    dict of ndarray
        ``quantity``, ``place``, ``suite``, ``structure``, ``published`` (NaN where none is), ``print_low``, ``print_high``.

    Examples
    --------
    >>> from rockfrag.datasets import load_paper
    >>> paper = load_paper()
    >>> str(paper["quantity"][1]), str(paper["place"][1]), float(paper["published"][1])
    ('low_b1', 'Table II', 29.4)
    """
    columns = _columns("paper.csv")
    return {
        "quantity": np.array(columns["quantity"]),
        "place": np.array(columns["place"]),
        "suite": np.array(columns["suite"]),
        "structure": np.array(columns["structure"]),
        "published": _numbers(columns["published"]),
        "print_low": _numbers(columns["print_low"]),
        "print_high": _numbers(columns["print_high"]),
    }


def load_structures() -> list[Structure]:
    """Loads the two structures of the paper: a frame, and electrical equipment.

    Returns
    -------
    list of Structure

    Examples
    --------
    >>> from rockfrag.datasets import load_structures
    >>> load_structures()[0]
    Structure(p=1.0, alpha=0.15, eta=0.92, name='frame')
    """
    rows = zip(*_columns("structures.csv").values())
    return [Structure(float(p), float(alpha), float(eta), name=name) for name, p, alpha, eta in rows]


def _columns(name: str) -> dict[str, list[str]]:
    lines = (Path(__file__).parent / name).read_text(encoding="utf-8").splitlines()
    head, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return dict(zip(head, map(list, zip(*rows))))


def _numbers(cells: list[str]) -> Floats:
    return np.array([float(cell or "nan") for cell in cells])
