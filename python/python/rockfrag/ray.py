"""Motions and responses in partitions on a Ray cluster: ``pip install rockfrag[ray]``.

Each partition is a task, which writes its file under its own name once it is whole; a task whose file is up
to date does nothing, so a job is resumed by running it again. The rows are those of one machine::

    rockfrag.ray.synthesize("scenarios.parquet", "motions", partitions=100)
    rockfrag.ray.simulate("motions", "responses", structures="structures.csv")
    rockfrag.fit_pro("responses")

Paths are in a folder that all nodes see.
"""

from __future__ import annotations

import os
from pathlib import Path

try:
    import ray
except ModuleNotFoundError as missing:
    raise ImportError("rockfrag.ray needs Ray: pip install 'rockfrag[ray]'") from missing

from . import _stages
from ._result import Result

__all__ = ["simulate", "synthesize"]

PathLike = str | os.PathLike[str]


def synthesize(
    scenarios: PathLike, out: PathLike, *, partitions: int, num_cpus: int = 1, **options: object
) -> list[Path]:
    """Synthesizes the motions of a file of scenarios in partitions, a task each; gives the files in order.

    ``out`` is the folder of the partitions, ``num_cpus`` the threads of a task; the options are those of
    :func:`rockfrag.synthesize_motions`.
    """
    return _each("synthesize_motions", scenarios, out, partitions, num_cpus, options)


def simulate(
    motions: PathLike, out: PathLike, *, partitions: int | None = None, num_cpus: int = 1, **options: object
) -> list[Path]:
    """Simulates the response to motions in partitions, a task each; gives the files in order.

    ``motions`` is the folder of their partitions, or a file, of which ``partitions`` are made; the options
    are those of :func:`rockfrag.simulate`.
    """
    partitions = partitions or max(1, len(list(Path(motions).glob("*.parquet"))))
    return _each("simulate", motions, out, partitions, num_cpus, options)


def _each(
    stage: str, source: PathLike, out: PathLike, partitions: int, num_cpus: int, options: dict[str, object]
) -> list[Path]:
    source, call = Path(source).absolute(), {**options, "out": Path(out).absolute(), "threads": num_cpus}
    task = ray.remote(num_cpus=num_cpus)(_one)
    calls = [{**call, "partition": f"{index}/{partitions}"} for index in range(partitions)]
    return list(ray.get([task.remote(stage, source, call) for call in calls]))


def _one(stage: str, source: Path, call: dict[str, object]) -> Path | None:
    made: Result = getattr(_stages, stage)(source, **call)
    return made.path
