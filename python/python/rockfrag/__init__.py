"""Dimensionless fragility curves for rocking structures in near-fault earthquakes.

The system of Dimitrakopoulos & Paraskeva (2015) as functions, a stage each::

    scenarios = rockfrag.sample_scenarios()
    motions = rockfrag.synthesize_motions(scenarios)
    responses = rockfrag.simulate(motions, p=2.5, alpha=0.20, eta=0.92)
    pex, pro = rockfrag.fit_pex(responses), rockfrag.fit_pro(responses)
    answers = rockfrag.evaluate(intensities, pex, pro, suite="csgm", p=2.5, alpha=0.20)

A table is anything that speaks Arrow (polars, pyarrow, pandas, DuckDB, :class:`Table`), or the path of a Parquet file or of a
folder of them, which is then read as it is needed. A result is a :class:`Table`, or with ``out`` a file, which is left as it is
where it is up to date. The rows are those of the command line, on any number of threads.

Common to all functions: ``out`` (path to write; the path is returned), ``threads`` (all cores), ``progress`` (called with the
number of steps done and of all, a few times a second), ``force`` (make even a file that is up to date). Ctrl-C ends a call at the next
batch, and what was being written is removed. Names of columns end in their units.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Union

from . import _options, _rockfrag
from ._options import Steps
from ._response import Response, response
from ._rockfrag import Table, __version__
from .errors import FileError, MissingFileError, OptionError, RockfragError, RockfragWarning, TableError

__all__ = [
    "FileError",
    "MissingFileError",
    "OptionError",
    "Response",
    "RockfragError",
    "RockfragWarning",
    "Table",
    "TableError",
    "__version__",
    "evaluate",
    "fit_pex",
    "fit_pro",
    "import_motions",
    "response",
    "sample_scenarios",
    "simulate",
    "synthesize_motions",
]

#: A path, or a table that speaks Arrow.
TableLike = Any
PathLike = Union[str, "os.PathLike[str]"]
Progress = Callable[[int, int], Any]


def sample_scenarios(
    *,
    samples: int = 100,
    mw: Steps = "5.5:7.5:0.5",
    re: Steps = "5:20:2.5",
    design: str = "lhs",
    seed: int | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Samples earthquake scenarios on a grid of magnitudes and distances (section 2.1.1).

    Args:
        samples: Scenarios in each cell of the grid.
        mw: Moment magnitudes: numbers, or ``"first:last:step"``.
        re: Distances, km, likewise.
        design: ``lhs``, ``random`` or ``sobol``.
        seed: Of the random parameters; 42 if not given.

    Returns:
        One row a scenario: magnitude, distance and the parameters of its pulse.
    """
    options = _options.to_json(
        samples=samples, mw=_options.steps(mw), re=_options.steps(re), design=design, seed=seed
    )
    return _rockfrag.sample_scenarios(options, _options.path(out), _options.manner(threads, progress, force))


def synthesize_motions(
    scenarios: TableLike,
    *,
    suite: str | Iterable[str] = ("pulse", "csgm"),
    dt: float = 0.005,
    difference: str = "absolute",
    epoch: str = "envelope-peak",
    site: str = "rock",
    kappa: float = 0.03,
    fmax: float | None = None,
    low_cut: float | None = None,
    low_cut_order: int = 4,
    housner: bool = False,
    sa: Steps | None = None,
    seed: int | None = None,
    partition: str | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Synthesizes near-fault motions: coherent pulse and stochastic high frequencies (Eq. 1, sections 2.1.2 and 2.1.3).

    Args:
        scenarios: What :func:`sample_scenarios` made.
        suite: Some of ``pulse``, ``csgm`` (pulse and high frequencies), ``hfc`` (high frequencies alone).
        dt: Time between samples, s.
        difference: What the high frequencies keep where the pulse is the stronger: ``absolute``, ``signed``, ``clamp``, ``none``.
        epoch: When the pulse peaks: ``envelope-peak``, ``pga`` or ``pgv``.
        site: Amplification: ``rock``, ``soil``, ``none``, or a CSV file of frequency (Hz) and factor.
        kappa: Near-surface attenuation, s.
        fmax: Corner of the low-pass filter, Hz.
        low_cut: Corner of the high-pass filter, Hz.
        low_cut_order: Its order.
        housner: Whether the Housner intensity is computed, which doubles the time.
        sa: Periods of spectral accelerations that become columns, s.
        seed: Of the noise; 42 if not given.
        partition: ``"i/n"``: only an equal share of the scenarios, i from 0 to n - 1; ``out`` is then a folder.

    Returns:
        One row a motion: its samples (m/s2), intensity measures and scenario.
    """
    options = _options.to_json(
        suite=_options.several(suite),
        dt=dt,
        difference=difference,
        epoch=epoch,
        site=site,
        kappa=kappa,
        fmax=fmax,
        low_cut=low_cut,
        low_cut_order=low_cut_order,
        housner=housner,
        sa=_options.steps(sa),
        seed=seed,
        partition=partition,
    )
    return _rockfrag.synthesize_motions(
        scenarios, options, _options.path(out), _options.manner(threads, progress, force)
    )


def import_motions(
    files: PathLike | Iterable[PathLike],
    *,
    format: str = "auto",
    dt: float | None = None,
    unit: str | None = None,
    column: str | int | None = None,
    pga_tolerance: float = 0.05,
    baseline: str = "none",
    high_pass: float | None = None,
    resample: float | None = None,
    rotate: str | float | None = None,
    scale: Steps | None = None,
    scale_pga: float | None = None,
    scale_pgv: float | None = None,
    pulses: str = "find",
    residual: bool = False,
    sa: Steps | None = None,
    housner: bool = False,
    keep_going: bool = False,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Imports recorded motions from the files of strong-motion networks, CSV or Parquet.

    Args:
        files: Files and folders of records; folders are walked.
        format: ``auto`` (by content), ``at2``, ``cosmos``, ``csmip``, ``esm``, ``knet``, ``smc`` or ``columns``.
        dt: Time between samples of files that do not say it, s.
        unit: Unit of files that do not say it: ``g``, ``mg``, ``m/s2``, ``cm/s2`` or ``mm/s2``.
        column: Column of plain files that holds the acceleration: its number or name, or ``all``.
        pga_tolerance: By which share samples may miss the peak of their header.
        baseline: What is removed: ``none``, ``mean`` or ``linear``.
        high_pass: Corner of a zero-phase Butterworth high-pass of order 4, Hz.
        resample: Another time step, s.
        rotate: Azimuth in degrees, or ``strongest-pulse``, to which pairs of components are turned.
        scale: Factors; several make as many motions of each record.
        scale_pga: Scale each motion to this PGA, g.
        scale_pgv: Scale each motion to this PGV, m/s.
        pulses: ``find`` (Baker 2007, and the fit of Eq. 1 for tp_s) or ``skip``.
        residual: Whether motions without their pulse are added, as suite ``residual``.
        sa: Periods of spectral accelerations that become columns, s.
        housner: Whether the Housner intensity is computed.
        keep_going: Whether files that cannot be read are a warning and no error.

    Returns:
        One row a motion: its samples (m/s2), intensity measures and where it came from.
    """
    options = _options.to_json(
        files=[os.fspath(file) for file in ([files] if isinstance(files, (str, os.PathLike)) else files)],
        format=format,
        dt=dt,
        unit=unit,
        column=None if column is None else str(column),
        pga_tolerance=pga_tolerance,
        baseline=baseline,
        high_pass=high_pass,
        resample=resample,
        rotate=None if rotate is None else str(rotate),
        scale=_options.steps(scale),
        scale_pga=scale_pga,
        scale_pgv=scale_pgv,
        pulses=pulses,
        residual=residual,
        sa=_options.steps(sa),
        housner=housner,
        keep_going=keep_going,
    )
    return _rockfrag.import_motions(options, _options.path(out), _options.manner(threads, progress, force))


def simulate(
    motions: TableLike,
    *,
    p: float = 2.5,
    alpha: float = 0.20,
    eta: float = 0.92,
    structures: PathLike | Mapping[str, Any] | Iterable[Mapping[str, Any]] | None = None,
    path: str | None = None,
    trace: Iterable[Any] | str | None = None,
    partition: str | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Simulates the rocking response of structures to motions (section 2.2).

    Args:
        motions: What :func:`synthesize_motions` or :func:`import_motions` made, or any table of ``motion_id`` (integer or text), ``dt_s``
            (s) and ``acceleration_m_s2`` (a list of samples, m/s2).
        p: Frequency parameter of the structure, rad/s.
        alpha: Its slenderness, rad.
        eta: Its coefficient of restitution.
        structures: In place of these: a YAML or CSV file, or one or more mappings such as
            ``{"name": "frame", "p": 1.0, "alpha": 0.15, "eta": 0.92}`` or ``{"width": 0.5, "height": 2.0}`` (m).
        path: How the solver works: ``scalar``, ``avx2`` or ``avx512``; the fastest if not given.
        trace: Names of motions whose rotation over time becomes ``parts["trace"]`` of the result.
        partition: ``"i/n"``: of a folder of motions its file i, of a table an equal share; ``out`` is then a folder.

    Returns:
        One row a motion and structure: outcome, demand and dimensionless measures (Eqs. 7 and 13).
    """
    options = _options.to_json(
        p=p,
        alpha=alpha,
        eta=eta,
        structures=_options.structures(structures),
        path=path,
        trace=None if trace is None else _options.several(trace),
        partition=partition,
    )
    return _rockfrag.simulate(
        motions, options, _options.path(out), _options.manner(threads, progress, force)
    )


def fit_pex(
    responses: TableLike,
    *,
    limit_state: float = 0.10,
    transition: str | float = "found",
    bootstrap: int = 0,
    confidence: float = 0.95,
    seed: int | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Fits the demand in safe rocking, and with it P_ex (sections 2.3 and 3, Table II).

    Args:
        responses: What :func:`simulate` made.
        limit_state: Demand ``|theta|max / alpha`` whose exceedance P_ex is about.
        transition: im4 at which the two planes meet: ``found``, or a number.
        bootstrap: Resamples for bootstrap limits, drawn within each cell of magnitude and distance.
        confidence: Probability with which limits hold the truth.
        seed: Of the resamples; 42 if not given.

    Returns:
        One row a regression; ``parts["scan"]`` is the search for the transition, ``parts["bootstrap"]`` the resampled fits.
    """
    options = _options.to_json(
        limit_state=limit_state,
        transition=str(transition),
        bootstrap=bootstrap,
        confidence=confidence,
        seed=seed,
    )
    return _rockfrag.fit_pex(
        responses, options, _options.path(out), _options.manner(threads, progress, force)
    )


def fit_pro(
    responses: TableLike,
    *,
    event: str = "overturning",
    pairs: str | Iterable[str] = ("im4:im3_inv",),
    link: str = "probit",
    estimator: str = "ml",
    bootstrap: int = 0,
    confidence: float = 0.95,
    seed: int | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Fits fragility curves of overturning by maximum likelihood: P_ro (section 3, Eqs. 18 to 24, Figure 12).

    Args:
        responses: What :func:`simulate` made.
        event: ``overturning`` (given rocking), or ``rocking`` (of all motions).
        pairs: Pairs of measures that make hybrid ones, besides the six scalar measures.
        link: ``probit``, ``logit`` or ``cloglog``.
        estimator: ``ml``, or ``firth`` where events are few.
        bootstrap: Resamples for bootstrap limits, drawn within each cell of magnitude and distance.
        confidence: Probability with which limits hold the truth.
        seed: Of the resamples; 42 if not given.

    Returns:
        One row a curve; ``parts["bootstrap"]`` are the resampled ones.
    """
    options = _options.to_json(
        event=event,
        pairs=_options.several(pairs),
        link=link,
        estimator=estimator,
        bootstrap=bootstrap,
        confidence=confidence,
        seed=seed,
    )
    return _rockfrag.fit_pro(
        responses, options, _options.path(out), _options.manner(threads, progress, force)
    )


def evaluate(
    intensities: TableLike,
    pex: TableLike,
    pro: TableLike,
    *,
    suite: str | None = None,
    structure: str | None = None,
    model: str = "bivariate",
    measure: str | None = None,
    limits: str = "delta",
    p: float | None = None,
    alpha: float | None = None,
    eta: float | None = None,
    out: PathLike | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
) -> Any:
    """Evaluates the probabilities of rocking, failure and overturning at each intensity of a table (Eqs. 12, 14 and 19).

    Args:
        intensities: A table of ``pga_m_s2`` and ``pgv_m_s``, and where they differ from row to row ``p_rad_s``, ``alpha_rad``, ``eta``,
            ``tp_s``, ``tm_s``.
        pex: What :func:`fit_pex` made.
        pro: What :func:`fit_pro` made.
        suite: Suite of the fits; may be left out if there is only one.
        structure: Structure of the fits, likewise.
        model: ``bivariate``, or ``univariate``.
        measure: Measure of the univariate model, ``im1`` to ``im6``.
        limits: How limits come about: ``delta``, or from the resamples of fits in files made with ``bootstrap``: ``percentile``,
            ``bc`` (corrected for bias).
        p: Frequency parameter of the structure, rad/s, of all rows.
        alpha: Its slenderness, rad.
        eta: Its coefficient of restitution; that of the fits if not given.

    Returns:
        One row an intensity: p_nr, p_ex, p_ro, p_f_r and p_f with 95 % limits of confidence.
    """
    options = _options.to_json(
        suite=suite, structure=structure, model=model, measure=measure, limits=limits, p=p, alpha=alpha, eta=eta
    )
    return _rockfrag.evaluate(
        intensities, pex, pro, options, _options.path(out), _options.manner(threads, progress, force)
    )
