"""Options on their way to the library, which checks them: the names and words of the command line."""

from __future__ import annotations

import contextlib
import csv
import json
import os
import secrets
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

import numpy as np

from ._structure import Structure, spec_of
from ._types import PathLike, Progress
from .errors import OptionError

Settings = dict[str, "int | bool | Progress | None"]


def to_json(options: Mapping[str, object]) -> str:
    """Options that are given, under the names that they have on the command line."""
    return json.dumps({_kebab(name): _plain(value) for name, value in options.items()})


def settings(threads: int | None, progress: Progress | None, force: bool | None, overwrite: bool | None) -> Settings:
    """The settings of a call."""
    if threads is not None and threads < 1:
        raise OptionError(f"threads is {threads}; expected 1 or more")
    return {"threads": threads, "progress": progress, "force": bool(force), "overwrite": bool(overwrite)}


def seed(given: int | np.random.Generator | None) -> int:
    """A seed of the library; a fresh one of None, as NumPy takes it."""
    if given is None:
        return secrets.randbits(32)
    if isinstance(given, np.random.Generator):
        return int(given.integers(2**32))
    return int(given)


def partition(given: tuple[int, int] | str) -> str:
    """Partition i of n, as the command line writes it."""
    if isinstance(given, str):
        return given
    index, of = given
    return f"{index}/{of}"


@contextlib.contextmanager
def hazard_file(given: object) -> Iterator[object]:
    """The path of a hazard, which may be a table too."""
    if given is None or isinstance(given, (str, os.PathLike)):
        yield given
        return
    columns = given
    if not isinstance(given, Mapping):
        import pyarrow

        columns = pyarrow.table(given).to_pydict()
    assert isinstance(columns, Mapping)
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as folder:
        file = Path(folder, "hazard.csv")
        with file.open("w", newline="") as opened:
            writer = csv.writer(opened)
            writer.writerow(columns)
            writer.writerows(zip(*columns.values(), strict=True))
        yield str(file)


def path(out: PathLike | None, *, may_be_folder: bool) -> str | None:
    """A path as text. Where partitions can be written, one without a suffix is a folder; a slash at its end changes nothing."""
    if out is None:
        return None
    plain = Path(out)
    return f"{plain}/" if may_be_folder and not plain.suffix else str(plain)


def _kebab(name: str) -> str:
    return name.rstrip("_").replace("_", "-")


def _plain(value: object) -> object:
    """What JSON knows: text, numbers, lists of text, and structures, of which one is a list too."""
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (Structure, Mapping)):
        return [spec_of(value)]
    if isinstance(value, np.ndarray) and value.ndim == 0 or isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Iterable):
        return [spec_of(one) if isinstance(one, (Structure, Mapping)) else str(_plain(one)) for one in value]
    raise TypeError(f"{value!r} is no option; expected text, numbers or lists of them")
