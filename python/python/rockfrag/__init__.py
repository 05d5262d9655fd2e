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
from typing import TYPE_CHECKING, Any

from . import _bridge, _rockfrag
from ._arrays import FragilityCurve, Response, fit_fragility
from ._objects import Fragility, Object, Probabilities, Rate, Responses, fragility, simulate_motions
from ._result import Result
from ._rockfrag import Error, Site, __version__
from ._stages import *

if TYPE_CHECKING:
    # Where the stub of the stages is not built.
    def __getattr__(name: str) -> Callable[..., Result]: ...


__all__ = ["Error", "Fragility", "FragilityCurve", "Object", "Probabilities", "Rate", "Response", "Responses", "Result"]
__all__ += ["Site", "__version__", "fit_fragility", "fragility", "inspect", "run", "simulate_motions"]
__all__ += list(_bridge.functions)


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
    made = _rockfrag.run_pipeline(config, out, seed, force, threads, _bridge.teller("run", progress))
    return {stage[0].replace("-", "_"): _bridge.result(stage) for stage in made}


def inspect(path: str | os.PathLike[str]) -> dict[str, Any]:
    """What a file holds and where it came from: ``file``, ``rows``, ``made`` and ``columns``."""
    return dict(json.loads(_rockfrag.inspect(path)))
