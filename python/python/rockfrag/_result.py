"""What a stage makes."""

from __future__ import annotations

import html
import importlib
import json
import shutil
import tempfile
import weakref
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _rockfrag

if TYPE_CHECKING:
    from numpy.typing import NDArray

    import pandas
    import polars
    import pyarrow


class Folder:
    """A temporary folder, which goes with the last result that has it."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="rockfrag."))
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("a temporary table cannot be copied; expected a result with out=, or its to_polars()")


class Result:
    """A table that a stage has written: any library that speaks Arrow takes it, row group by row group.

    ``path`` is its file; without ``out`` it is a temporary one, which goes when the result does. ``summary``
    is what the command prints, and ``warnings`` are about it.
    """

    def __init__(
        self, stage: str, path: Path | None, summary: str, warnings: list[str], folder: Folder | None = None
    ) -> None:
        self.stage, self.summary, self.warnings = stage, summary, warnings
        self.path = path and path.absolute()
        self._folder = folder
        self._written = path and path.stat().st_mtime_ns

    def part(self, name: str) -> Result:
        """Another table of the stage: ``fit_pro(...).part("parameters")`` is ``pro.parameters.parquet``."""
        path = self._table().with_suffix(f".{name}.parquet")
        if not path.exists():
            raise ValueError(f"{self.stage} has no part '{name}'; expected one of {', '.join(self.parts)}")
        return Result(self.stage, path, "", self.warnings, self._folder)

    @property
    def parts(self) -> list[str]:
        """The names of its other tables."""
        path = self._table()
        found = sorted(path.parent.glob(f"{path.stem}.*.parquet"))
        return [part.stem.removeprefix(f"{path.stem}.") for part in found]

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return _rockfrag.read_table(self._table())

    @property
    def columns(self) -> list[str]:
        """The names of its columns."""
        return list(_rockfrag.read_columns(self._table(), None, 0))

    def __len__(self) -> int:
        return int(json.loads(_rockfrag.inspect(self._table()))["rows"])

    def to_numpy(
        self, columns: Sequence[str] | None = None, rows: int | None = None
    ) -> dict[str, NDArray[Any]]:
        """Its columns, or those named, as arrays: numbers with NaN for none, else objects."""
        found = _rockfrag.read_columns(self._table(), None if columns is None else list(columns), rows)
        unknown = next((name for name in columns or () if name not in found), None)
        if unknown is not None:
            raise KeyError(f"no column '{unknown}'; expected one of {', '.join(self.columns)}")
        return {name: array(column) for name, column in found.items()}

    def head(self, rows: int = 5) -> dict[str, NDArray[Any]]:
        """Its first rows, as :meth:`to_numpy`."""
        return self.to_numpy(rows=rows)

    def to_polars(self) -> polars.DataFrame:
        frame: polars.DataFrame = library("polars").DataFrame(self)
        return frame

    def to_pyarrow(self) -> pyarrow.Table:
        return library("pyarrow").table(self)

    def to_pandas(self) -> pandas.DataFrame:
        library("pandas")
        return self.to_pyarrow().to_pandas()

    def _table(self) -> Path:
        if self.path is None or self.path.suffix != ".parquet":
            raise ValueError(f"{self.stage} wrote no table; .summary has what it prints")
        if self.path.stat().st_mtime_ns != self._written:
            raise _rockfrag.Error(f"{self.path}: changed since {self.stage} wrote it; call it again")
        return self.path

    def __repr__(self) -> str:
        warnings = [f"warning: {warning}" for warning in self.warnings]
        return "\n".join([self.summary.rstrip() or f"{self.stage}: {self.path}", *warnings])

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(repr(self))}</pre>"


Result.__module__ = "rockfrag"


def library(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as missing:
        raise ImportError(f"{name} is not installed: pip install {name}; to_numpy() needs none") from missing


def array(column: bytes | list[Any]) -> NDArray[Any]:
    """A column of numbers, or of texts and lists."""
    if isinstance(column, bytes):
        return np.frombuffer(column)
    found = np.empty(len(column), dtype=object)
    found[:] = [np.frombuffer(each) if isinstance(each, bytes) else each for each in column]
    return found
