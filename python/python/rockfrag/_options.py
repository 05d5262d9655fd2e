"""Options on their way to the library, which checks them: the names and words of the command line."""

from __future__ import annotations

import contextlib
import csv
import json
import os
import secrets
import tempfile
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path

import numpy as np

from . import _checks
from ._structure import Structure, spec_of
from ._types import PathLike, Progress
from .errors import OptionError, RockfragError, RockfragWarning

Settings = dict[str, "int | bool | Progress | None"]


def to_json(options: Mapping[str, object]) -> str:
    """Options that are given and checked, under the names that they have on the command line."""
    return json.dumps({_kebab(name): value for name, value in options.items()})


def settings(threads: int | None, progress: Progress | None, force: bool | None, overwrite: bool | None) -> Settings:
    """The settings of a call."""
    if progress is not None and not callable(progress):
        raise _checks.wrong("progress", progress, "a function of the number of steps done and of all")
    flags = {name: _checks.flag(name, value or False) for name, value in (("force", force), ("overwrite", overwrite))}
    return {"threads": None if threads is None else _checks.integer("threads", threads, 1), "progress": progress, **flags}


def seed(given: int | np.random.Generator | None) -> int:
    """A seed of the library; a fresh one of None, as NumPy takes it."""
    if given is None:
        return secrets.randbits(32)
    if isinstance(given, np.random.Generator):
        return int(given.integers(2**32))
    return _checks.integer("seed", given)


def partition(given: tuple[int, int] | str) -> str:
    """Partition i of n, as the command line writes it."""
    if isinstance(given, str):
        return given
    if not isinstance(given, tuple) or len(given) != 2:
        raise _checks.wrong("partition", given, "(i, n) with i from 0 to n - 1")
    index, of = (_checks.integer("partition", number) for number in given)
    return f"{index}/{of}"


@contextlib.contextmanager
def hazard_file(given: object) -> Iterator[object]:
    """The path of a hazard, which may be a table too."""
    if given is None or isinstance(given, (str, os.PathLike)):
        yield given
        return
    columns = _columns(given)
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as folder:
        file = Path(folder, "hazard.csv")
        with file.open("w", newline="") as opened:
            writer = csv.writer(opened)
            writer.writerow(columns)
            writer.writerows(zip(*columns.values(), strict=True))
        try:
            yield str(file)
        except RockfragError as error:
            # The file is none of the caller's.
            error.args = (str(error).replace(str(file), "hazard"),)
            raise


def warn_of_sizes(intensities: object) -> None:
    """Says so where the dimensions of blocks stand in a table of intensities, whose structures go by other columns."""
    names: Iterable[object] = getattr(intensities, "column_names", getattr(intensities, "columns", ()))
    known = set(map(str, names))
    if {"width", "height"} <= known and "p_rad_s" not in known:
        words = "intensities: columns width and height are not read; expected p_rad_s and alpha_rad (p and alpha of Structure.block), or"
        warnings.warn(f"{words} rockfrag.probability(width=..., height=...)", RockfragWarning, stacklevel=3)


def _columns(hazard: object) -> dict[str, list[object]]:
    """The columns of a hazard, all of one length."""
    if hasattr(hazard, "__arrow_c_stream__"):
        import pyarrow

        hazard = pyarrow.table(hazard).to_pydict()
    if not isinstance(hazard, Mapping):
        raise _checks.wrong("hazard", hazard, "a path, a table that speaks Arrow, or a mapping of columns")
    columns: dict[str, list[object]] = {}
    for name, values in hazard.items():
        array = np.asarray(values)
        if array.ndim != 1:
            raise _checks.wrong(f"hazard: column {name!r}", values, "an array of numbers")
        columns[name] = array.tolist()
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        words = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise OptionError(f"hazard: columns of different lengths ({words}); expected a value of each in every row")
    return columns


def structures(given: object) -> object:
    """Structures, or the path of a file of them."""
    if isinstance(given, (str, os.PathLike)):
        return os.fsdecode(given)
    several = [given] if isinstance(given, (Structure, Mapping)) else given
    expected = "a Structure, several, or the path of a YAML, CSV or Parquet file of them"
    if hasattr(given, "__arrow_c_stream__"):
        raise OptionError(f"structures is a table; expected {expected}: write it to a file, or give its rows as dicts")
    if not isinstance(several, Iterable):
        raise _checks.wrong("structures", given, expected)
    specs = []
    for structure in several:
        if not isinstance(structure, (Structure, Mapping)):
            raise _checks.wrong("structures", given, expected)
        specs.append(spec_of(structure))
    return specs


def checked(name: str, kind: str, value: object) -> object:
    """The value of an option, if it is of its kind."""
    if name == "structures":
        return structures(value)
    if name == "structure" and isinstance(value, Structure):
        raise OptionError("structure names a fit, as text; give a Structure as structures=")
    if kind == "paths":
        several = value if isinstance(value, Iterable) and not isinstance(value, (str, os.PathLike)) else [value]
        return [_checks.path(name, one) for one in several]
    check = _KINDS.get(kind)
    return _plain(name, value) if check is None else check(name, value)


_KINDS: dict[str, Callable[[str, object], object]] = {
    "float": _checks.number,
    "int": _checks.integer,
    "bool": _checks.flag,
    "path": _checks.path,
}


def path(out: PathLike | None, *, may_be_folder: bool) -> str | None:
    """A path as text. Where partitions can be written, one without a suffix is a folder; a slash at its end changes nothing."""
    if out is None:
        return None
    plain = Path(_checks.path("out", out))
    return f"{plain}/" if may_be_folder and not plain.suffix else str(plain)


def _kebab(name: str) -> str:
    return name.rstrip("_").replace("_", "-")


def _plain(name: str, value: object) -> object:
    """What JSON knows: text, numbers, and lists of text."""
    value = _checks.plain(value)
    if isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, float):
        return _checks.number(name, value)
    if isinstance(value, os.PathLike):
        return os.fsdecode(value)
    if isinstance(value, Iterable) and not isinstance(value, Mapping):
        return [str(_plain(name, one)) for one in value]
    raise _checks.wrong(name, value, "text, a number, or several")
