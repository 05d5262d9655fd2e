"""What a stage makes."""

from __future__ import annotations

import html
import shutil
import weakref
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _rockfrag

if TYPE_CHECKING:
    import pandas
    import polars
    import pyarrow


class Result:
    """A table that a stage has written: any library that speaks Arrow takes it, row group by row group.

    ``path`` is its file; without ``out`` it is a temporary one, which goes when the result does. ``summary``
    is what the command prints, and ``warnings`` are about it.
    """

    def __init__(
        self, stage: str, path: Path | None, summary: str, warnings: list[str], folder: Path | None = None
    ) -> None:
        self.stage, self.summary, self.warnings = stage, summary, warnings
        self.path = path and path.absolute()
        self._written = self._state()
        self._owner: Result | None = None
        self._folder = folder
        if folder is not None:
            weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)

    def part(self, name: str) -> Result:
        """Another table of the stage: ``fit_pro(...).part("parameters")`` is ``pro.parameters.parquet``."""
        part = Result(self.stage, self._table().with_suffix(f".{name}.parquet"), self.summary, self.warnings)
        if not part._table().exists():
            raise ValueError(f"{self.stage} has no part '{name}'; expected one of {', '.join(self.parts)}")
        part._owner = self
        return part

    @property
    def parts(self) -> list[str]:
        """The names of its other tables."""
        path = self._table()
        found = sorted(path.parent.glob(f"{path.stem}.*.parquet"))
        return [part.stem.removeprefix(f"{path.stem}.") for part in found]

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return _rockfrag.read_table(self._table())

    def to_polars(self) -> polars.DataFrame:
        import polars

        return polars.DataFrame(self)

    def to_pyarrow(self) -> pyarrow.Table:
        try:
            import pyarrow
        except ImportError as missing:
            raise ImportError("pyarrow is not installed: pip install pyarrow") from missing
        return pyarrow.table(self)

    def to_pandas(self) -> pandas.DataFrame:
        return self.to_pyarrow().to_pandas()

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Its rows, by which ``pandas.DataFrame(result)`` is made."""
        return iter(self.to_pyarrow().to_pylist())

    def __copy__(self) -> Result:
        return self

    def __deepcopy__(self, memo: object) -> Result:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        owner = self._owner or self
        if owner._folder is not None:
            raise TypeError(
                f"the table of {self.stage} is temporary and cannot be pickled; expected a result with out=, or its to_polars()"
            )
        return Result, (self.stage, self.path, self.summary, self.warnings)

    def _table(self) -> Path:
        if self.path is None or self.path.suffix != ".parquet":
            raise ValueError(f"{self.stage} wrote no table; .summary has what it prints")
        if self._state() not in (None, self._written):
            raise _rockfrag.Error(f"{self.path}: changed since {self.stage} wrote it; call it again")
        return self.path

    def _state(self) -> tuple[int, int] | None:
        if self.path is None or not self.path.exists():
            return None
        found = self.path.stat()
        return found.st_ino, found.st_mtime_ns

    def __repr__(self) -> str:
        warnings = [f"warning: {warning}" for warning in self.warnings]
        return "\n".join([self.summary.rstrip() or f"{self.stage}: {self.path}", *warnings])

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(repr(self))}</pre>"


Result.__module__ = "rockfrag"
