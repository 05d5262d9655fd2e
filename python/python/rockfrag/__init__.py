"""Dimensionless fragility curves for rocking structures in near-fault earthquakes.

The system of Dimitrakopoulos & Paraskeva (2015) as functions, a stage each::

    scenarios = rockfrag.sample_scenarios()
    motions = rockfrag.synthesize_motions(scenarios)
    responses = rockfrag.simulate(motions, structures=rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92))
    pex, pro = rockfrag.fit_pex(responses), rockfrag.fit_pro(responses)
    answers = rockfrag.evaluate(pex, pro, intensities, suite="csgm", p=2.5, alpha=0.20)

and curves of any outcomes, as arrays::

    curve = rockfrag.fit_fragility(im, overturned)
    curve.probability([0.5, 1.0]), curve.confidence_band([0.5, 1.0]), curve.plot()

A table is anything that speaks Arrow (polars, pyarrow, pandas, DuckDB, :class:`Table`), or the path of a Parquet file or of a
folder of them, which is read as needed. A result is a :class:`Table`; with ``out`` it is a file, and a file that is up to date is
left as it is. The rows are those of the command line, on any number of threads.

Each stage of the command line is a function with its options, in the words of ``rockfrag STAGE --help``. All stages take ``out`` (file
to write; its path is returned), ``threads`` (all cores unless given), ``progress`` (called with the number of steps done and of all, a
few times a second) and ``force`` (also make a file that is up to date). Ctrl-C ends a call at the next batch and removes what was
being written. Names of columns end in their units.

Random numbers come from ``seed``: 42 unless given, so that a call gives the same rows every time. ``seed=None`` takes a fresh seed;
``Table.metadata`` and :func:`inspect` tell it.

``rockfrag.datasets`` has small data to try, ``rockfrag.ray`` runs partitions on a cluster.
"""

import importlib
from typing import TYPE_CHECKING

from . import datasets
from ._curves import DemandCurve, FailureCurve, FragilityCurve
from ._fits import fit_demand, fit_failure, fit_fragility
from ._probability import Probability, probability
from ._rocking import Response, response
from ._rockfrag import Table, __version__
from ._stages import (
    compare_paper,
    evaluate,
    export,
    fit_pex,
    fit_pro,
    ida,
    import_motions,
    rank_ims,
    report,
    sample_scenarios,
    simulate,
    synthesize_motions,
    universality,
    validate,
)
from ._structure import Structure
from ._tools import FileInfo, inspect, run, seed_spread
from .errors import FileError, FitError, MissingFileError, OptionError, RockfragError, RockfragWarning, TableError

__all__ = [
    "DemandCurve",
    "FailureCurve",
    "FileError",
    "FileInfo",
    "FitError",
    "FragilityCurve",
    "MissingFileError",
    "OptionError",
    "Probability",
    "Response",
    "RockfragError",
    "RockfragWarning",
    "Structure",
    "Table",
    "TableError",
    "__version__",
    "compare_paper",
    "datasets",
    "evaluate",
    "export",
    "fit_demand",
    "fit_failure",
    "fit_fragility",
    "fit_pex",
    "fit_pro",
    "ida",
    "import_motions",
    "inspect",
    "probability",
    "rank_ims",
    "report",
    "response",
    "run",
    "sample_scenarios",
    "seed_spread",
    "simulate",
    "synthesize_motions",
    "universality",
    "validate",
]


if TYPE_CHECKING:
    from . import ray as ray
else:

    def __getattr__(name):
        """``rockfrag.ray``, which needs Ray, when it is first asked for."""
        if name == "ray":
            try:
                return importlib.import_module("rockfrag.ray")
            except ImportError as missing:
                raise AttributeError(str(missing)) from missing
        raise AttributeError(f"module 'rockfrag' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*__all__, "errors", "ray"])
