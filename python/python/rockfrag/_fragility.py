"""From responses to fragility, and what it says of an intensity."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from . import _options, _rockfrag
from ._types import PathLike, Progress, TableLike


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
