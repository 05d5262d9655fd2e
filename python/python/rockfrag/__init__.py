"""Dimensionless fragility curves for rocking structures in near-fault earthquakes.

The system of Dimitrakopoulos & Paraskeva (2015) as functions, a stage each::

    scenarios = rockfrag.sample_scenarios()
    motions = rockfrag.synthesize_motions(scenarios)
    responses = rockfrag.simulate(motions, p=2.5, alpha=0.20, eta=0.92)
    pex, pro = rockfrag.fit_pex(responses), rockfrag.fit_pro(responses)
    answers = rockfrag.evaluate(pex, pro, intensities, suite="csgm", p=2.5, alpha=0.20)

A table is anything that speaks Arrow (polars, pyarrow, pandas, DuckDB, :class:`Table`), or the path of a Parquet file or of a
folder of them, which is then read as it is needed. A result is a :class:`Table`, or with ``out`` a file, which is left as it is
where it is up to date. The rows are those of the command line, on any number of threads.

Each stage of the command line is a function with its options, in the words of ``rockfrag STAGE --help``. Common to all are ``out``
(path to write; the path is returned), ``threads`` (all cores unless given), ``progress`` (called with the number of steps done and
of all, a few times a second) and ``force`` (make even a file that is up to date). Ctrl-C ends a call at the next batch, and what was
being written is removed. Names of columns end in their units.
"""

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
from .errors import FileError, MissingFileError, OptionError, RockfragError, RockfragWarning, TableError

__all__ = [
    "FileError",
    "MissingFileError",
    "OptionError",
    "Probability",
    "Response",
    "RockfragError",
    "RockfragWarning",
    "Table",
    "TableError",
    "__version__",
    "compare_paper",
    "evaluate",
    "export",
    "fit_pex",
    "fit_pro",
    "ida",
    "import_motions",
    "probability",
    "rank_ims",
    "report",
    "response",
    "sample_scenarios",
    "simulate",
    "synthesize_motions",
    "universality",
    "validate",
]
