from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Literal, NoReturn, TypedDict, final, overload

import numpy as np
import numpy.typing as npt
import pandas
import polars
import pyarrow

from ._options import Settings
from ._types import TableLike

__all__ = [
    "LEAST_EVENTS",
    "MANY_CLUSTERS",
    "Table",
    "__version__",
    "call",
    "command",
    "exceeding",
    "f_upper_tail",
    "failure_limits",
    "fit_curve",
    "fit_line",
    "inspect_file",
    "normal_quantile",
    "partition_file",
    "probabilities",
    "probability",
    "profile_limits",
    "response",
    "restored",
    "run_pipeline",
    "seed_spread",
    "stages",
    "structure",
    "t_quantile",
]
__version__: str
LEAST_EVENTS: int
MANY_CLUSTERS: int

_Floats = npt.NDArray[np.float64]

@final
class Table:


    @property
    def columns(self) -> list[str]: ...
    @property
    def shape(self) -> tuple[int, int]: ...
    @property
    def parts(self) -> dict[str, Table]: ...
    @property
    def metadata(self) -> dict[str, object]: ...
    def head(self, n: int = 5) -> Table: ...
    def to_polars(self) -> polars.DataFrame: ...
    def to_pyarrow(self) -> pyarrow.Table: ...
    def to_pandas(self) -> pandas.DataFrame: ...
    @overload
    def __getitem__(self, key: str, /) -> npt.NDArray[np.generic]: ...
    @overload
    def __getitem__(self, key: slice | list[str], /) -> Table: ...
    def _ipython_key_completions_(self) -> list[str]: ...
    def __array__(self, dtype: object | None = None, copy: bool | None = None) -> NoReturn: ...
    def __reduce__(self) -> tuple[object, ...]: ...
    def __contains__(self, column: str, /) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def _repr_html_(self) -> str: ...
    def __arrow_c_schema__(self) -> object: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> object: ...

class _Response(TypedDict):
    time_s: _Floats
    theta_rad: _Floats
    theta_dot_rad_s: _Floats
    events: list[tuple[float, str]]
    outcome: Literal["no_rocking", "safe_rocking", "overturning"]
    edp: float | None
    impacts: int
    p_rad_s: float
    alpha_rad: float
    eta: float

class _Curve(TypedDict):
    status: str
    events: int
    params: _Floats
    cov_params: _Floats
    parameters: dict[str, tuple[float, float]]
    llf: float
    aic: float
    bic: float
    auc: float
    brier: float
    hosmer_lemeshow_p: float | None
    spline_p: float | None
    separated: bool
    few_events: bool

class _Line(TypedDict):
    status: str
    params: _Floats
    cov_params: _Floats
    residual_sd: float
    df_resid: int
    r2: float
    reset_p: float | None

def partition_file(partition: str) -> str: ...
def stages() -> str: ...
def call(stage: str, inputs: Mapping[str, TableLike], options: str, out: str | None, settings: Settings) -> Table | Path: ...
def command(arguments: Sequence[str]) -> int: ...
def run_pipeline(
    pipeline: str, out: str | None, seed: int | None, dry_run: bool, settings: Settings
) -> tuple[list[tuple[str, list[str]]], str]: ...
def inspect_file(file: str) -> tuple[str, str]: ...
def seed_spread(pipeline: str, seeds: int, out: str, settings: Settings) -> str: ...
def structure(structure: str) -> tuple[str, float, float, float]: ...
def response(acceleration_m_s2: _Floats, dt_s: float, structure: str, tail_s: float) -> _Response: ...
def fit_curve(
    im: Sequence[_Floats], happened: npt.NDArray[np.bool_], link: str, estimator: str, clusters: Sequence[int] | None
) -> _Curve: ...
def profile_limits(
    im: Sequence[_Floats], happened: npt.NDArray[np.bool_], link: str, estimator: str, parameter: str, level: float
) -> tuple[float, float] | None: ...
def fit_line(im: Sequence[_Floats], edp: _Floats, clusters: Sequence[int] | None) -> _Line: ...
def probabilities(link: str, indices: _Floats) -> _Floats: ...
def normal_quantile(share: float) -> float: ...
def t_quantile(share: float, degrees: float) -> float: ...
def f_upper_tail(f: float, degrees: float, further: float) -> float: ...
def restored(table: TableLike, made: str, parts: Sequence[tuple[str, Table]]) -> Table: ...
def exceeding(ln_median: _Floats, variance: _Floats, limit: float, beta: float, degrees: float) -> tuple[_Floats, _Floats]: ...
def failure_limits(
    overturning: tuple[_Floats, _Floats, _Floats], exceeding: tuple[_Floats, _Floats, _Floats]
) -> tuple[_Floats, _Floats]: ...
def probability(
    structure: dict[str, _Floats],
    pga_g: _Floats,
    pgv_m_s: _Floats,
    shape: tuple[int, ...],
    suite: str | None,
    limit_state: float | None,
) -> tuple[dict[str, _Floats], list[str]]: ...
