from collections.abc import Sequence
from os import PathLike
from typing import Any

from numpy.typing import NDArray

__version__: str

Curve = Sequence[Sequence[float] | NDArray[Any]] | NDArray[Any]

class Error(RuntimeError): ...

class Site:
    def __init__(
        self,
        *,
        pga: Curve | None = None,
        pgv: Curve | None = None,
        sa_1s: Curve | None = None,
        magnitude: float | None = None,
        vs30: float | None = None,
        ratio: float | None = None,
    ) -> None: ...
    @staticmethod
    def read(
        *files: str | PathLike[str],
        columns: dict[str, str] = ...,
        ignore: Sequence[str] = ...,
        effective_years: float | None = None,
        magnitude: float | None = None,
        vs30: float | None = None,
        ratio: float | None = None,
    ) -> Site: ...

# What only the package calls.
def __getattr__(name: str) -> Any: ...
