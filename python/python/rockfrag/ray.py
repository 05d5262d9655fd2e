"""Motions and responses in partitions on a Ray cluster: ``pip install rockfrag[ray]``.

Each partition is a task, which writes its file under its own name once it is whole; a task whose file is up to date does nothing, so
a job is resumed by running it again. The rows are those of one machine::

    rockfrag.ray.synthesize_motions("scenarios.parquet", "motions", partitions=100)
    rockfrag.ray.simulate("motions", "responses", partitions=100, structures="structures.csv")
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

from . import _bridge

__all__ = ["simulate", "synthesize_motions"]

PathLike = str | os.PathLike[str]


def synthesize_motions(
    scenarios: PathLike, out: PathLike, *, partitions: int, num_cpus: int = 1, **options: object
) -> list[Path]:
    """Synthesizes motions in partitions, a task each.

    Parameters
    ----------
    scenarios : path
        File of scenarios.
    out : path
        Folder of the partitions.
    num_cpus : int
        Threads of a task.
    **options
        Of :func:`rockfrag.synthesize_motions`.

    Returns
    -------
    list of Path
        The files, in order.
    """
    return _each("synthesize_motions", scenarios, out, partitions, num_cpus, options)


def simulate(
    motions: PathLike, out: PathLike, *, partitions: int, num_cpus: int = 1, **options: object
) -> list[Path]:
    """Simulates the response to motions in partitions, a task each.

    Parameters
    ----------
    motions : path
        A file of motions, or the folder of as many partitions.
    out : path
        Folder of the partitions of responses.
    num_cpus : int
        Threads of a task.
    **options
        Of :func:`rockfrag.simulate`.

    Returns
    -------
    list of Path
        The files, in order.
    """
    return _each("simulate", motions, out, partitions, num_cpus, options)


def _each(
    stage: str, source: PathLike, out: PathLike, partitions: int, num_cpus: int, options: dict[str, object]
) -> list[Path]:
    source, out = Path(source).absolute(), Path(out).absolute()
    task = ray.remote(num_cpus=num_cpus)(_one)
    call = {**options, "out": out, "threads": num_cpus}
    return list(
        ray.get(
            [
                task.remote(stage, source, {**call, "partition": f"{index}/{partitions}"})
                for index in range(partitions)
            ]
        )
    )


def _one(stage: str, source: Path, call: dict[str, object]) -> Path | None:
    return _bridge.functions[stage](source, **call).path
