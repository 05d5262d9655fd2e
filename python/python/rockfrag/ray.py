"""Motions and responses in partitions on a Ray cluster, by Ray Data: ``pip install rockfrag[ray]``.

Each partition is a task. Ray decides where and when it runs, and runs it again elsewhere if a node is lost. A task writes its file
under its own name once the file is whole, so a task may run twice. A task whose file is up to date does nothing: to resume a job, run
it again. The rows are those of one machine::

    rockfrag.ray.synthesize("scenarios.parquet", "motions", partitions=100)
    rockfrag.ray.simulate("motions", "responses", structures="structures.yaml")
    rockfrag.fit_pro("responses")

Paths must be the same on all nodes: use a shared folder, or a store that ``filesystem`` (of pyarrow or fsspec) reaches from each node.
"""

from __future__ import annotations

import os
import tempfile
import time
import uuid
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, TypedDict, cast

try:
    import pyarrow.fs
    import pyarrow.parquet
    import ray.data
except ModuleNotFoundError as missing:
    raise ImportError(f"rockfrag.ray needs Ray, and {missing.name} is not there: pip install 'rockfrag[ray]'") from missing

import rockfrag
from rockfrag._options import partition as words_of
from rockfrag._rockfrag import partition_file
from rockfrag._types import PathLike

if TYPE_CHECKING:
    from fsspec import AbstractFileSystem

__all__ = ["Partition", "simulate", "synthesize"]


class Partition(TypedDict):
    """A partition that is done."""

    #: Which, from 0 on,
    index: int
    #: and of how many.
    of: int
    file: str
    rows: int
    seconds: float
    #: The node of Ray that made it.
    node: str


def synthesize(
    scenarios: PathLike,
    out: PathLike,
    *,
    partitions: int,
    filesystem: pyarrow.fs.FileSystem | AbstractFileSystem | None = None,
    num_cpus: int = 1,
    **options: object,
) -> list[Partition]:
    """Synthesizes motions in partitions.

    Parameters
    ----------
    scenarios : path
        File of scenarios.
    out : path
        Folder of the partitions.
    partitions : int
        Number of partitions.
    filesystem : pyarrow.fs.FileSystem or fsspec.AbstractFileSystem, optional
        Where both are stored; by default in a folder that all nodes see.
    num_cpus : int, default 1
        Number of threads of a task.
    **options
        Options of :func:`rockfrag.synthesize_motions`.

    Returns
    -------
    list of Partition
        The partitions, in order.
    """
    return _each_partition(rockfrag.synthesize_motions, scenarios, out, partitions, filesystem, num_cpus, options)


def simulate(
    motions: PathLike,
    out: PathLike,
    *,
    filesystem: pyarrow.fs.FileSystem | AbstractFileSystem | None = None,
    num_cpus: int = 1,
    **options: object,
) -> list[Partition]:
    """Simulates the response to the motions of each partition.

    Parameters
    ----------
    motions : path
        Folder of the partitions that :func:`synthesize` made.
    out : path
        Folder of the partitions of responses.
    filesystem : pyarrow.fs.FileSystem or fsspec.AbstractFileSystem, optional
        Where both are stored; by default in a folder that all nodes see.
    num_cpus : int, default 1
        Number of threads of a task.
    **options
        Options of :func:`rockfrag.simulate`.

    Returns
    -------
    list of Partition
        The partitions, in order.

    Raises
    ------
    TableError
        If the folder has no partitions.
    """
    files = _filesystem(filesystem).get_file_info(pyarrow.fs.FileSelector(os.fspath(motions)))
    partitions = sum(file.extension == "parquet" and file.base_name[0] not in "._" for file in files)
    if partitions == 0:
        raise rockfrag.TableError(f"{motions}: a folder without Parquet files; expected partitions of motions")
    return _each_partition(rockfrag.simulate, motions, out, partitions, filesystem, num_cpus, options)


def _each_partition(
    stage: Callable[..., rockfrag.Table | Path],
    source: PathLike,
    out: PathLike,
    partitions: int,
    filesystem: pyarrow.fs.FileSystem | AbstractFileSystem | None,
    num_cpus: int,
    options: dict[str, object],
) -> list[Partition]:
    source, out = os.fspath(source), os.fspath(out)

    def run(row: dict[str, object]) -> dict[str, object]:
        start = time.perf_counter()
        index = row["index"]
        call = {**options, "partition": (index, partitions), "threads": num_cpus}
        file = _run(stage, source, out, filesystem, call)
        with _filesystem(filesystem).open_input_file(file) as opened:
            rows = pyarrow.parquet.read_metadata(opened).num_rows
        node = ray.get_runtime_context().get_node_id()
        seconds = time.perf_counter() - start
        return {"index": index, "of": partitions, "file": file, "rows": rows, "seconds": seconds, "node": node}

    dataset = ray.data.from_items([{"index": index} for index in range(partitions)], override_num_blocks=partitions)
    results = cast("list[Partition]", dataset.map(run, num_cpus=num_cpus).take_all())
    return sorted(results, key=lambda result: result["index"])


def _run(stage: Callable[..., rockfrag.Table | Path], source: str, out: str, filesystem: pyarrow.fs.FileSystem | AbstractFileSystem | None, call: dict[str, object]) -> str:
    """Runs a stage on a partition, and gives the file that it wrote."""
    index = call["partition"]
    assert isinstance(index, tuple)
    name = partition_file(words_of(index))
    if filesystem is None:
        return str(stage(source, out=Path(out, name), **call))
    remote = _filesystem(filesystem)
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as folder:
        # A file that is there already is fetched, so that the stage can tell whether it is up to date.
        here = Path(folder, "out", name)
        there = str(PurePosixPath(out, name))
        before = _fetch(remote, there, here)
        local = Path(folder, "in", name)
        if _fetch(remote, source, local) is None:
            # What the folder has under this name is the whole partition, and says itself which.
            call = {**call, "partition": None}
            if _fetch(remote, str(PurePosixPath(source, name)), local) is None:
                raise rockfrag.MissingFileError(f"{source}: no such file, nor a folder with {name}")
        stage(local, out=here, **call)
        if before is None or here.stat().st_mtime_ns != before:
            _send(remote, here, there)
    return there


def _fetch(remote: pyarrow.fs.FileSystem, path: str, to: Path) -> int | None:
    """Copies a file to this machine and gives its time of change; none where there is no such file."""
    if remote.get_file_info(path).type != pyarrow.fs.FileType.File:
        return None
    to.parent.mkdir(exist_ok=True)
    pyarrow.fs.copy_files(path, str(to), source_filesystem=remote)
    return to.stat().st_mtime_ns


def _send(remote: pyarrow.fs.FileSystem, file: Path, path: str) -> None:
    """Copies a file beside its name, which it takes when it is whole."""
    folder = PurePosixPath(path).parent
    remote.create_dir(str(folder), recursive=True)
    partial = str(folder / f".{file.name}.{uuid.uuid4().hex}.partial")
    pyarrow.fs.copy_files(str(file), partial, destination_filesystem=remote)
    remote.move(partial, path)


def _filesystem(given: pyarrow.fs.FileSystem | AbstractFileSystem | None) -> pyarrow.fs.FileSystem:
    if given is None:
        return pyarrow.fs.LocalFileSystem()
    if isinstance(given, pyarrow.fs.FileSystem):
        return given
    return pyarrow.fs.PyFileSystem(pyarrow.fs.FSSpecHandler(given))
