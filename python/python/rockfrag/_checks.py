"""What arguments must be. A check names the argument, says what was found and what was expected."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from numbers import Integral, Real

import numpy as np
import numpy.typing as npt

from .errors import OptionError

Floats = npt.NDArray[np.float64]

#: The longest value that a message shows, characters.
_LONGEST = 60


def wrong(name: str, found: object, expected: str) -> OptionError:
    """The error of an argument."""
    return OptionError(f"{name} is {shown(found)}; expected {expected}")


def shown(found: object) -> str:
    """A value as a message shows it."""
    words = repr(found.item() if isinstance(found, np.generic) else found)
    return words if len(words) <= _LONGEST else f"{words[:_LONGEST]}..."


def plain(given: object) -> object:
    """A number of NumPy as one of Python."""
    return given.item() if isinstance(given, (np.generic, np.ndarray)) and given.ndim == 0 else given


def number(name: str, given: object, expected: str = "a finite number") -> float:
    """A finite number."""
    value = plain(given)
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise wrong(name, given, expected)
    return float(value)


def share(name: str, given: object, example: str) -> float:
    """A probability between 0 and 1."""
    expected = f"a probability between 0 and 1, such as {example}"
    value = number(name, given, expected)
    if not 0.0 < value < 1.0:
        raise wrong(name, given, expected)
    return value


def integer(name: str, given: object, least: int = 0) -> int:
    """A whole number that is not too small."""
    value = plain(given)
    if isinstance(value, bool) or not isinstance(value, Integral) or value < least:
        raise wrong(name, given, f"a whole number, {least} or more")
    return int(value)


def flag(name: str, given: object) -> bool:
    """Yes or no."""
    value = plain(given)
    if not isinstance(value, bool):
        raise wrong(name, given, "True or False")
    return value


def text(name: str, given: object, expected: str = "text") -> str:
    """Text."""
    if not isinstance(given, str):
        raise wrong(name, given, expected)
    return given


def word(name: str, given: object, words: Iterable[str]) -> str:
    """One of some words."""
    known = list(words)
    if not isinstance(given, str) or given not in known:
        raise wrong(name, given, f"one of {', '.join(known)}")
    return given


def path(name: str, given: object) -> str:
    """A path, as text."""
    if not isinstance(given, (str, os.PathLike)):
        raise wrong(name, given, "a path")
    return os.fsdecode(given)


def floats(name: str, given: npt.ArrayLike | None, expected: str = "numbers", *, may_be_bool: bool = False) -> Floats:
    """Numbers as an array of their own; NaN where one is missing (None, or NA of pandas)."""
    if isinstance(given, np.ma.MaskedArray) and np.ma.is_masked(given):
        raise OptionError(f"{name} has {int(np.ma.getmaskarray(given).sum())} masked values; expected {expected}: leave them out (compressed), or fill them")
    try:
        array = np.asarray(given)
    except ValueError as error:
        raise OptionError(f"{name}: rows of different lengths; expected {expected}") from error
    if array.dtype.kind in ("biuf" if may_be_bool else "iuf"):
        return np.array(array, dtype=np.float64, order="C")
    if array.dtype.kind not in "bOUSc":
        raise wrong(name, given, expected)
    width = array.shape[1] if array.ndim == 2 else 1
    values = [math.nan if is_missing(value) else plain(value) for value in array.reshape(-1).tolist()]
    for place, value in enumerate(values):
        if not isinstance(value, Real) or isinstance(value, bool) and not may_be_bool:
            where = name if array.ndim == 0 else f"{name}: case {place // width}"
            raise wrong(where, value, expected)
    return np.array(values, dtype=np.float64).reshape(array.shape)


def labels(name: str, given: npt.ArrayLike, count: int) -> list[int]:
    """A number for each label."""
    array = np.asarray(given)
    if array.shape != (count,):
        raise OptionError(f"{name} has shape {array.shape}; expected a label for each of {count} cases")
    numbers: dict[object, int] = {}
    for case, label in enumerate(array.tolist()):
        if is_missing(label):
            raise OptionError(f"{name}: case {case} is missing; expected a label for each of {count} cases")
        numbers.setdefault(label, len(numbers))
    return [numbers[label] for label in array.tolist()]


def is_missing(value: object) -> bool:
    """Whether a value is None, NaN, or NA of pandas."""
    return value is None or type(value).__name__ in ("NAType", "NaTType") or isinstance(value, float) and math.isnan(value)
