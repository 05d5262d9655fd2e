"""Dimensionless fragility curves for rocking structures in near-fault earthquakes.

An object and a site are asked directly, in arrays::

    cabinet = rockfrag.Object(width=0.5, height=2.0)
    cabinet.probability(pga=0.5, pgv=[0.4, 0.6]).p_overturning
    cabinet.rate(rockfrag.Site.read("pga.csv"), years=50)

Each stage of the command is a function with the command's options::

    motions = rockfrag.synthesize_motions(rockfrag.sample_scenarios(samples=10))
    responses = rockfrag.simulate(motions, structure=[dict(name="frame", p=1, alpha=0.15, eta=0.92)])
    rockfrag.fit_pro(responses).part("parameters").to_polars()

A table is anything that speaks Arrow (polars, pandas, pyarrow, DuckDB, a :class:`Result`), or the path of a
file. With ``out`` a result is that file; a table that is up to date is left as it is. ``rockfrag.ray``
runs partitions on a cluster.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from typing import Any

from . import _call, _rockfrag, _stages
from ._objects import Fragility, Object, Probabilities, Rate, Response, Responses, simulate_motions
from ._result import Result
from ._rockfrag import Error, Site, __version__
from ._stages import *

__all__ = ["Error", "Fragility", "Object", "Probabilities", "Rate", "Response", "Responses", "Result", "Site"]
__all__ += ["__version__", "inspect", "run", "simulate_motions"]
__all__ += _stages.__all__


def __dir__() -> list[str]:
    return [*__all__, "ray"]


def run(
    config: str | os.PathLike[str] = "pipeline.yaml",
    *,
    out: str | os.PathLike[str] | None = None,
    seed: int | None = None,
    force: bool = False,
    threads: int | None = None,
    progress: bool | Callable[[int, int], object] | None = None,
) -> dict[str, Result]:
    """Runs all stages of a pipeline file, skipping what is up to date; gives their results by name."""
    made = _rockfrag.run_pipeline(config, out, seed, force, threads, _call.teller("run", progress))
    return {stage[0].replace("-", "_"): _call.result(stage) for stage in made}


def inspect(path: str | os.PathLike[str]) -> dict[str, Any]:
    """What a file holds and where it came from: ``file``, ``rows``, ``made`` and ``columns``."""
    return dict(json.loads(_rockfrag.inspect(path)))
