from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from numpy.typing import NDArray

__version__: str

Curve = Sequence[Sequence[float] | NDArray[Any]] | NDArray[Any]
Progress = Callable[[int, int], object] | None

class Error(RuntimeError): ...

def describe() -> str: ...
def call(
    stage: str, options: str, threads: int | None, progress: Progress
) -> tuple[str, list[Path], str, list[str]]: ...
def run_pipeline(
    pipeline: str | PathLike[str],
    out: str | PathLike[str] | None,
    seed: int | None,
    force: bool,
    threads: int | None,
    progress: Progress,
) -> list[tuple[str, list[Path], str, list[str]]]: ...
def inspect(path: str | PathLike[str]) -> str: ...
def command(arguments: list[str]) -> int: ...
def read_table(path: Path) -> object: ...
def write_table(capsule: object, path: Path) -> None: ...
def read_columns(path: Path, wanted: list[str] | None, rows: int | None) -> dict[str, bytes | list[Any]]: ...
def fields() -> list[tuple[str, str]]: ...
def simulate_motion(object: Object, acceleration: bytes, dt_s: float, tail_s: float) -> dict[str, Any]: ...
def simulate_motions(
    records: list[bytes], dt_s: list[float], objects: list[Object], threads: int | None, progress: Progress
) -> tuple[bytes, bytes]: ...
def fit_curve(im: bytes, outcomes: bytes, confidence: float) -> dict[str, Any]: ...
def normal_cdf(z: bytes) -> bytes: ...

class Object:
    parameters: tuple[float, float, float]
    def __init__(
        self, fields: list[tuple[str, str]], limit_state: float, suite: str | None, fits: str | PathLike[str] | None
    ) -> None: ...
    def probability(
        self,
        number: int,
        pga: float | bytes | None,
        pgv: float | bytes | None,
        magnitude: float | bytes | None,
        vs30: float | None,
    ) -> tuple[bytes, list[str]]: ...
    def rate(self, site: Site, years: float) -> tuple[dict[str, Any], list[str]]: ...
    def fragility(
        self, over: str, magnitude: float | None, vs30: float | None, ratio: float | None
    ) -> tuple[dict[str, Any], list[str]]: ...

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
