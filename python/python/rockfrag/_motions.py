"""From scenarios and records to ground motions."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any

from . import _options, _rockfrag
from ._types import PathLike, Progress, Steps, TableLike


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
