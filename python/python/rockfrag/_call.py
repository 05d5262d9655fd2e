"""From the arguments of a stage's function to the parser of the command."""

from __future__ import annotations

import json
import os
import re
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from . import _rockfrag
from ._result import Folder, Result

#: Options of lists and curves as people keep them, which are text.
LISTS = ("about", "hazard", "site", "structures")


def call(stage: str, given: dict[str, Any], tables: list[str], first: str) -> Result:
    """Runs a stage on what its function was given; ``first`` is the option of what comes without a name."""
    threads, progress = given.pop("threads"), given.pop("progress")
    words = {flag(name, first): value for name, value in given.items() if value is not None}
    folder = None if "out" in words or stage in ("export", "report") else Folder()
    if folder is not None:
        words["out"] = folder.path / f"{stage}.parquet"
    if isinstance(words.get("columns"), Mapping):
        words["columns"] = [f"{column}={heading}" for column, heading in words["columns"].items()]
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as scratch:
        for name in map(flag, tables):
            if name in words:
                words[name] = file_of(words[name], Path(scratch, name), name)
        try:
            text = json.dumps(words, allow_nan=False, default=plain)
        except ValueError:
            raise ValueError(f"{stage}: an option is NaN or infinite; expected finite numbers") from None
        try:
            made = _rockfrag.call(stage, text, threads, teller(stage, progress))
        except (_rockfrag.Error, ValueError, FileNotFoundError) as error:
            # A table that was given without a path has a temporary file: its argument is told.
            told = re.sub(re.escape(f"{scratch}{os.sep}") + r"([\w-]+)\.(parquet|csv)", r"\1", str(error))
            raise type(error)(re.sub(r"\bin: ", "input: ", told) if told != str(error) else told) from None
    return result(made, folder)


def flag(name: str, first: str = "") -> str:
    """``limit-state`` of ``limit_state``, and ``from`` of ``from_``."""
    return first if name == "input" else name.removesuffix("_").replace("_", "-")


def file_of(table: Any, path: Path, name: str) -> object:
    """The file of a table: a result has one, others are written to one; a path stays."""
    if isinstance(table, Result):
        return table._table()
    if type(table).__name__ == "LazyFrame":
        table = table.collect()
    if hasattr(table, "__arrow_c_stream__"):
        path = path.with_suffix(".csv" if name in LISTS else ".parquet")
        _rockfrag.write_table(table.__arrow_c_stream__(), path)
        return path
    paths = table if isinstance(table, (list, tuple)) else [table]
    if not all(isinstance(path, (str, os.PathLike)) for path in paths):
        # It would be taken for a path, and printed whole.
        expected = "expected a table of polars, pandas, pyarrow or DuckDB, or the path of a file"
        raise TypeError(f"{'input' if name == 'in' else name} is a {type(table).__name__}; {expected}")
    return table


def plain(value: Any) -> object:
    """A value that JSON does not know, as one that it knows."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, Iterable):
        return list(value)
    raise TypeError(f"{value!r} is no option; expected a number, a string, a path, a list or a mapping")


#: What is called as a stage runs, with the steps done and all.
Told = Callable[[int, int], object]


def teller(name: str, progress: bool | Told | None) -> Told | None:
    """What is called as a stage runs; of ``True`` a line on stderr that counts."""

    def count(done: int, total: int) -> None:
        end = "\n" if done == total > 0 else ""
        print(f"\r{name}: {done:,} of {total:,}", end=end, file=sys.stderr, flush=True)

    return count if progress is True else progress or None


def result(made: tuple[str, list[Path], str, list[str]], folder: Folder | None = None) -> Result:
    """What came of a stage that is done."""
    stage, paths, summary, texts = made
    warn(texts)
    return Result(stage, paths[-1] if paths else None, summary, texts, folder)


def warn(texts: Iterable[str]) -> None:
    """Makes each a warning of Python, at the line that called the package."""
    level = 1
    while sys._getframe(level).f_globals.get("__package__") == __package__:
        level += 1
    for text in texts:
        warnings.warn(text, stacklevel=level + 1)
