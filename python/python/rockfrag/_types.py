"""What arguments may be."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Protocol, Union

if TYPE_CHECKING:
    from ._structure import Structure

PathLike = Union[str, "os.PathLike[str]"]
#: Takes the number of steps done and of all.
Progress = Callable[[int, int], object]
#: Numbers: one, several, or text as ``"5:20:2.5"`` (first:last:step).
Steps = Union[float, str, Iterable[float]]


class ArrowStream(Protocol):
    """A table that speaks Arrow: of polars, pyarrow, pandas, DuckDB or rockfrag."""

    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...


class ArrowArray(Protocol):
    """A single batch that speaks Arrow."""

    def __arrow_c_array__(self, requested_schema: object | None = None) -> tuple[object, object]: ...


#: A table that speaks Arrow, or the path of a Parquet file or of a folder of them.
TableLike = Union[PathLike, ArrowStream, ArrowArray]
#: A structure, or its parameters by the names of the command line.
StructureLike = Union["Structure", Mapping[str, object]]
#: Some structures, a YAML, CSV or Parquet file of them, or the word paper.
Structures = Union[StructureLike, Iterable[StructureLike], PathLike]
#: A CSV file of annual rates, or its columns.
Hazard = Union[PathLike, ArrowStream, Mapping[str, object]]
