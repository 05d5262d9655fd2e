"""The commands that are no stage: a whole run, a look into a file, the spread over seeds."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, overload

import numpy as np

from . import _checks, _options, _rockfrag, _show
from ._types import PathLike, Progress


@dataclass(frozen=True)
class Column:
    """A column of a file."""

    name: str
    type: str
    unit: str | None
    description: str | None
    nulls: int
    least: float | None
    largest: float | None


@dataclass(frozen=True, repr=False)
class FileInfo:
    """What a Parquet file holds and how it was made. It prints as ``rockfrag inspect`` does."""

    path: Path
    rows: int
    bytes: int
    columns: list[Column]
    #: The stage that made it; None if another program did.
    stage: str | None
    version: str | None
    #: All parameters that the rows depend on, with the seed.
    parameters: dict[str, object]
    #: A fingerprint of each input, by its role.
    inputs: dict[str, str]
    #: Warnings of the stage that made it.
    warnings: list[str]
    #: A fingerprint of the rows.
    content: str | None
    _text: str = field(compare=False)

    def __repr__(self) -> str:
        return self._text.rstrip("\n")

    def _repr_html_(self) -> str:
        cells = [[column.name, column.type, column.unit or "", column.description or ""] for column in self.columns]
        title = f"{self.path.name}: {self.rows} rows, made by {self.stage or 'another program'}"
        lines = [f"{name}: {json.dumps(value)}" for name, value in self.parameters.items()]
        lines += [f"warning: {warning}" for warning in self.warnings]
        return _show.Summary(title, lines, ["column", "type", "unit", "description"], cells)._repr_html_()


def inspect(file: PathLike) -> FileInfo:
    """Tells what a Parquet file holds and how it was made.

    Parameters
    ----------
    file : path
        A Parquet file of rockfrag or of any other program.

    Returns
    -------
    FileInfo

    Raises
    ------
    MissingFileError
        If the file does not exist.
    FileError
        If it is no Parquet file.

    Examples
    --------
    >>> import rockfrag, tempfile, pathlib
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = rockfrag.sample_scenarios(samples=3, seed=7, out=pathlib.Path(folder.name, "scenarios.parquet"))
    >>> info = rockfrag.inspect(file)
    >>> info.stage, info.rows, info.parameters["seed"]
    ('sample-scenarios', 105, 7)
    >>> folder.cleanup()
    """
    told, text = _rockfrag.inspect_file(_checks.path("file", file))
    found = json.loads(told)
    made = found["made"] or {"stage": None, "version": None, "parameters": {}, "inputs": {}, "warnings": [], "content": None}
    columns = [Column(**column) for column in found["columns"]]
    return FileInfo(path=Path(file), rows=found["rows"], bytes=found["bytes"], columns=columns, _text=text, **made)


@overload
def run(
    pipeline: PathLike = "pipeline.yaml",
    *,
    out: PathLike | None = None,
    seed: int | np.random.Generator | None = None,
    dry_run: Literal[False] = False,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> dict[str, list[Path]]: ...
@overload
def run(
    pipeline: PathLike = "pipeline.yaml",
    *,
    out: PathLike | None = None,
    seed: int | np.random.Generator | None = None,
    dry_run: Literal[True],
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> str: ...
def run(
    pipeline: PathLike = "pipeline.yaml",
    *,
    out: PathLike | None = None,
    seed: int | np.random.Generator | None = None,
    dry_run: bool = False,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> dict[str, list[Path]] | str:
    """Runs all stages of a pipeline file and skips those that are up to date.

    Parameters
    ----------
    pipeline : path, default 'pipeline.yaml'
        The pipeline file.
    out : path, optional
        Folder of all files; by default the one that the pipeline file names, or ``out`` beside it.
    seed : int or numpy.random.Generator, optional
        Seed of all stages; by default that of the pipeline file, or 42.
    dry_run : bool, default False
        Run nothing; return the plan, and why each stage would or would not run.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all.
    force : bool, default False
        Also make files that are up to date.
    overwrite : bool, default False
        Replace files that another program has made.

    Returns
    -------
    dict or str
        The files of each stage, by its name; for a dry run, the plan.

    Raises
    ------
    MissingFileError
        If there is no such pipeline file.
    OptionError
        If the pipeline file cannot be read, or an option in it is wrong.

    Examples
    --------
    >>> import rockfrag, tempfile, pathlib
    >>> folder = tempfile.TemporaryDirectory()
    >>> pipeline = pathlib.Path(folder.name, "pipeline.yaml")
    >>> _ = pipeline.write_text("sample-scenarios: { samples: 3 }")
    >>> files = rockfrag.run(pipeline)
    >>> [file.name for file in files["sample-scenarios"]]
    ['scenarios.parquet']
    >>> print(rockfrag.run(pipeline, dry_run=True).splitlines()[0])
    sample-scenarios     up to date
    >>> folder.cleanup()
    """
    settings = _options.settings(threads, progress, force, overwrite)
    own = None if seed is None else _options.seed(seed)
    folder = None if out is None else _checks.path("out", out)
    files, plan = _rockfrag.run_pipeline(_checks.path("pipeline", pipeline), folder, own, _checks.flag("dry_run", dry_run), settings)
    return plan if dry_run else {stage: list(map(Path, paths)) for stage, paths in files}


def seed_spread(
    pipeline: PathLike = "pipeline.yaml",
    *,
    seeds: int = 20,
    out: PathLike = "seed_spread.csv",
    threads: int | None = None,
    progress: Progress | None = None,
    overwrite: bool = False,
) -> Path:
    """Repeats a pipeline over seeds, to show how far its numbers move by chance.

    Parameters
    ----------
    pipeline : path, default 'pipeline.yaml'
        The pipeline file.
    seeds : int, default 20
        Number of seeds: 1 to this.
    out : path, default 'seed_spread.csv'
        CSV file to write: every number with every seed.
    threads, progress, overwrite
        As of :func:`run`.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    MissingFileError
        If there is no such pipeline file.
    OptionError
        If the pipeline file cannot be read, or lacks compare-paper and what it needs.

    Examples
    --------
    >>> import rockfrag
    >>> rockfrag.seed_spread("nowhere.yaml")
    Traceback (most recent call last):
    rockfrag.errors.MissingFileError: nowhere.yaml: ...
    """
    settings = _options.settings(threads, progress, False, overwrite)
    paths = _checks.path("pipeline", pipeline), _checks.path("out", out)
    return Path(_rockfrag.seed_spread(paths[0], _checks.integer("seeds", seeds, 1), paths[1], settings))
