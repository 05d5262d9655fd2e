# Made by `python -m rockfrag._stub`.
from collections.abc import Iterable
from pathlib import Path
from typing import Literal, overload

from numpy.random import Generator

from ._rockfrag import Table
from ._types import Hazard, PathLike, Progress, Steps, Structures, TableLike

__all__ = ["compare_paper", "evaluate", "export", "fit_pex", "fit_pro", "ida", "import_motions", "rank_ims", "report", "sample_scenarios", "simulate", "synthesize_motions", "universality", "validate"]

@overload
def compare_paper(
    pex: TableLike,
    pro: TableLike,
    responses: TableLike,
    *,
    spread: PathLike | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Compare our numbers with those that the paper publishes.

    Parameters
    ----------
    pex : Arrow table or path
        Demand fits, from fit_pex.
    pro : Arrow table or path
        Overturning curves, from fit_pro.
    responses : Arrow table or path
        Responses that both were fitted to, from simulate; a file, or a folder of partitions.
    spread : path, optional
        CSV file of our numbers over seeds, from seed_spread [default: the built-in one, for the paper's
        set-up].
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> motions = rockfrag.synthesize_motions(rockfrag.sample_scenarios(), threads=2)
    >>> responses = rockfrag.simulate(motions, structures="paper")
    >>> pex, pro = rockfrag.fit_pex(responses, transition=1.3), rockfrag.fit_pro(responses)
    >>> compared = rockfrag.compare_paper(pex, pro, responses)
    >>> row = compared.to_polars().filter(quantity="high_b1", suite="csgm", structure="electrical-equipment")
    >>> row["published"].item(), round(row["ours"].item(), 3)
    (2.954, 3.088)
    """
@overload
def compare_paper(
    pex: TableLike,
    pro: TableLike,
    responses: TableLike,
    *,
    spread: PathLike | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def evaluate(
    pex: TableLike | None = None,
    pro: TableLike | None = None,
    intensities: TableLike | None = None,
    *,
    structure: str | None = None,
    model: Literal['univariate', 'bivariate', 'paper', 'universal'] | None = None,
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    limits: Literal['delta', 'percentile', 'bc'] = 'delta',
    limit_state: float | None = None,
    p: float | None = None,
    alpha: float | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    name: str | None = None,
    pga: float | None = None,
    pgv: float | None = None,
    tp: float | None = None,
    tm: float | None = None,
    hazard: Hazard | None = None,
    ratio: float | None = None,
    years: float = 50.0,
    columns: str | None = None,
    format: Literal['table', 'csv', 'json', 'parquet'] | None = None,
    suite: str | None = None,
    eta: float | Literal['housner'] | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Compute probabilities of rocking, failure and overturning: at one intensity, at each row of a table,
    or per year at a site.

    Parameters
    ----------
    pex : Arrow table or path, optional
        Demand fits, from fit_pex.
    pro : Arrow table or path, optional
        Overturning curves, from fit_pro.
    intensities : Arrow table or path, optional
        Parquet or CSV table with pga_m_s2 (in CSV also pga_g) and pgv_m_s and, where they vary,
        p_rad_s, alpha_rad, eta, tp_s and tm_s; other columns of text and numbers are copied to the
        output.
    structure : str, optional
        Structure of the fits [default: the only one].
    model : {'univariate', 'bivariate', 'paper', 'universal'}, optional
        bivariate (two planes over im4 and im3, curve of im4 and im3_inv) or univariate, whose curve
        bends where tests reject the straight line; paper (the straight line always; univariate with
        ``measure``); or universal (the surface for all structures, without fits) [default: bivariate;
        universal where there are no fits, or those found here are of other structures].
    measure : {'im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'}, optional
        Measure of the univariate model, im1 to im6 [default: im5, or the two of paper].
    limits : {'delta', 'percentile', 'bc'}, default 'delta'
        How to compute limits: delta (from standard errors), or from the resamples of fit_pex and
        fit_pro ``bootstrap``: percentile or bc (bias-corrected).
    limit_state : float, optional
        Limit state of P_ex by the universal surface: a demand |theta|max / alpha from 0.02 to 0.5
        [default: 0.1].
    p : float, optional
        Frequency parameter of the structure, rad/s.
    alpha : float, optional
        Slenderness of the structure, rad.
    width : float, optional
        Width of the block or column, m; replaces p and alpha.
    height : float, optional
        Height of the block or column, m.
    beam_mass_ratio : float, optional
        For a frame: mass of the beam over the mass of all columns.
    structures : Structure, iterable of Structure, or path, optional
        One Structure or several; the path of a YAML, CSV or Parquet file of them; or 'paper', for both
        structures of the paper.
    name : str, optional
        Name of the structure in the file of ``structures`` [default: the only one].
    pga : float, optional
        Peak ground acceleration, g.
    pgv : float, optional
        Peak ground velocity, m/s.
    tp : float, optional
        Period of the velocity pulse, s, if the measure needs it.
    tm : float, optional
        Mean period, s, if the measure needs it.
    hazard : path, Arrow table or mapping, optional
        CSV file, or its columns as a table or mapping: pga_g or pgv_m_s with annual_rate_of_exceedance,
        or both with annual_rate_of_occurrence.
    ratio : float, optional
        p PGV / PGA of all motions, for a hazard of one peak only: p in rad/s, PGV in m/s, PGA in m/s2
        (not g), usually 0.1 to 0.6 [default: distributed as in the motions of the fits].
    years : float, default 50.0
        Time of exposure, years.
    columns : str, optional
        Which headings of ``hazard`` or of ``intensities`` stand for which columns, as
        'pga_g=PGA,annual_rate_of_exceedance=rate'.
    format : {'table', 'csv', 'json', 'parquet'}, optional
        Format of the answer: table (to read), csv, json, or parquet (with ``out``) [default: by the
        ending of ``out``, or table].
    suite : str, optional
        Suite of the fits or of the universal surface [default: the only one; of the surface, csgm].
    eta : float or {'housner'}, optional
        Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the
        dimensions, or as in the fits].
    out : path, optional
        File to write: .parquet, or for one intensity or a site also .csv, .json or .txt; its path is
        returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    Of any structure, without fits of one's own: a block at one intensity (``pga`` in g, ``pgv`` in m/s), at each of a table, or at a site.

    >>> import rockfrag
    >>> answer = rockfrag.evaluate(width=0.5, height=2.0, pga=0.5, pgv=0.6)
    >>> dict(zip(answer["quantity"].tolist(), answer["value"].round(3).tolist()))["p_ro"]
    0.258
    >>> import polars as pl
    >>> intensities = pl.DataFrame({"pga_m_s2": [3.0, 5.0, 8.0], "pgv_m_s": [0.3, 0.6, 1.0]})
    >>> rockfrag.evaluate(intensities=intensities, width=0.5, height=2.0)["p_ro"].round(3)
    array([0.   , 0.264, 0.836])
    >>> site = rockfrag.evaluate(width=0.5, height=2.0, hazard=rockfrag.datasets.load_hazard(), ratio=0.4)
    >>> site["state"].tolist()
    ['LS1', 'LS2', 'LS3']
    """
@overload
def evaluate(
    pex: TableLike | None = None,
    pro: TableLike | None = None,
    intensities: TableLike | None = None,
    *,
    structure: str | None = None,
    model: Literal['univariate', 'bivariate', 'paper', 'universal'] | None = None,
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    limits: Literal['delta', 'percentile', 'bc'] = 'delta',
    limit_state: float | None = None,
    p: float | None = None,
    alpha: float | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    name: str | None = None,
    pga: float | None = None,
    pgv: float | None = None,
    tp: float | None = None,
    tm: float | None = None,
    hazard: Hazard | None = None,
    ratio: float | None = None,
    years: float = 50.0,
    columns: str | None = None,
    format: Literal['table', 'csv', 'json', 'parquet'] | None = None,
    suite: str | None = None,
    eta: float | Literal['housner'] | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

def export(
    pex: TableLike | None = None,
    pro: TableLike | None = None,
    *,
    suite: str | None = None,
    structure: str | None = None,
    model: Literal['univariate', 'bivariate', 'paper', 'universal'] | None = None,
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    limit_state: float | None = None,
    p: float | None = None,
    alpha: float | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    name: str | None = None,
    to: Literal['openquake', 'openquake-continuous', 'pelicun'] | None = None,
    im: Literal['pga', 'pgv'] = 'pga',
    ratio: Steps | None = None,
    levels: Steps | None = None,
    upto: float | None = None,
    tolerance: float | None = None,
    eta: float | Literal['housner'] | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    """Write the fragility of a structure for OpenQuake or pelicun.

    Parameters
    ----------
    pex : Arrow table or path, optional
        Demand fits, from fit_pex.
    pro : Arrow table or path, optional
        Overturning curves, from fit_pro.
    suite : str, optional
        Suite of the fits [default: the only one].
    structure : str, optional
        Structure of the fits [default: the only one].
    model : {'univariate', 'bivariate', 'paper', 'universal'}, optional
        bivariate (two planes over im4 and im3, curve of im4 and im3_inv) or univariate, whose curve
        bends where tests reject the straight line; paper (the straight line always; univariate with
        ``measure``); or universal (the surface for all structures, without fits) [default: bivariate;
        universal where there are no fits, or those found here are of other structures].
    measure : {'im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'}, optional
        Measure of the univariate model, im1 to im6 [default: im5, or the two of paper].
    limit_state : float, optional
        Limit state of P_ex by the universal surface: a demand |theta|max / alpha from 0.02 to 0.5
        [default: 0.1].
    p : float, optional
        Frequency parameter of the structure, rad/s.
    alpha : float, optional
        Slenderness of the structure, rad.
    width : float, optional
        Width of the block or column, m; replaces p and alpha.
    height : float, optional
        Height of the block or column, m.
    beam_mass_ratio : float, optional
        For a frame: mass of the beam over the mass of all columns.
    structures : Structure, iterable of Structure, or path, optional
        One Structure or several; the path of a YAML, CSV or Parquet file of them; or 'paper', for both
        structures of the paper.
    name : str, optional
        Name of the structure in the file of ``structures`` [default: the only one].
    to : {'openquake', 'openquake-continuous', 'pelicun'}, optional
        Program to write for: openquake (NRML 0.5), openquake-continuous (the same, with overturning
        alone as a lognormal curve) or pelicun (CSV, and JSON beside it).
    im : {'pga', 'pgv'}, default 'pga'
        Intensity of the functions: pga (g) or pgv (m/s).
    ratio : float, iterable of float, or 'first:last:step', optional
        p PGV / PGA of the motions (p in rad/s, PGV in m/s, PGA in m/s2, not g; usually 0.1 to 0.6): one
        function for each of these numbers [default: one function, averaged over PGV / PGA given PGA, as
        evaluate ``hazard`` does].
    levels : float, iterable of float, or 'first:last:step', optional
        Intensities of the table, g or m/s: first:last:step, or numbers separated by commas [default: as
        many as ``tolerance`` needs].
    upto : float, optional
        Largest intensity, g or m/s [default: as in the data, but no more than 4.5 g, the strongest PGA
        ever recorded; for pelicun, where all probabilities are 1, but no more than that either].
    tolerance : float, optional
        Largest error of linear interpolation between levels [default: 1e-6; for pelicun 1e-5].
    eta : float or {'housner'}, optional
        Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the
        dimensions, or as in the fits].
    out : path
        File to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    pathlib.Path
        The path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
    >>> responses = rockfrag.simulate(motions, structures=equipment)
    >>> pex, pro = rockfrag.fit_pex(responses, transition=1.3), rockfrag.fit_pro(responses)
    >>> import pathlib, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = pathlib.Path(folder.name, "fragility.xml")
    >>> made = rockfrag.export(pex, pro, model="univariate", measure="im5", structures=equipment, to="openquake", ratio=0.4, out=file)
    >>> folder.cleanup()
    """

@overload
def fit_pex(
    responses: TableLike,
    *,
    limit_state: float = 0.1,
    transition: float | Literal['found'] = 'found',
    demand_floor: float | None = None,
    bootstrap: int = 0,
    confidence: float = 0.95,
    seed: int | Generator | None = 42,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Fit the demand in safe rocking: P_ex.

    Parameters
    ----------
    responses : Arrow table or path
        Responses to read; a file, or a folder of partitions.
    limit_state : float, default 0.1
        Limit state of P_ex: a demand |theta|max / alpha.
    transition : float or {'found'}, default 'found'
        IM4 at which the two planes meet: a number, or found (where the pooled residual is least).
    demand_floor : float, optional
        Raise smaller demands in safe rocking to this one, as a solver of finite tolerance does
        [default: none].
    bootstrap : int, default 0
        Number of bootstrap resamples, drawn within each cell of magnitude and distance.
    confidence : float, default 0.95
        Confidence level of all limits.
    seed : int or numpy.random.Generator or None, default 42
        Seed of the random numbers. The same seed makes the same rows, on any machine. None takes a
        fresh seed, as in NumPy; a numpy.random.Generator draws one. ``Table.metadata`` and ``inspect``
        tell the seed.
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file. Further tables, where there are any:
        ``parts["scan"]``, ``parts["bootstrap"]``.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
    >>> responses = rockfrag.simulate(motions, structures=equipment)
    >>> pex = rockfrag.fit_pex(responses, transition=1.3)
    >>> plane = pex.to_polars().filter(model="plane")
    >>> round(plane["b1"].item(), 1), round(plane["r2"].item(), 2)
    (2.1, 0.37)
    """
@overload
def fit_pex(
    responses: TableLike,
    *,
    limit_state: float = 0.1,
    transition: float | Literal['found'] = 'found',
    demand_floor: float | None = None,
    bootstrap: int = 0,
    confidence: float = 0.95,
    seed: int | Generator | None = 42,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def fit_pro(
    responses: TableLike,
    *,
    event: Literal['overturning', 'rocking'] = 'overturning',
    pairs: str | Iterable[str] = 'im4:im3_inv',
    link: Literal['probit', 'logit', 'cloglog'] = 'probit',
    estimator: Literal['ml', 'firth'] = 'ml',
    bootstrap: int = 0,
    confidence: float = 0.95,
    seed: int | Generator | None = 42,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Fit the probability of overturning: P_ro.

    Parameters
    ----------
    responses : Arrow table or path
        Responses to read; a file, or a folder of partitions.
    event : {'overturning', 'rocking'}, default 'overturning'
        Event of the probability: overturning (given rocking) or rocking (of all motions).
    pairs : str or iterable of str, default 'im4:im3_inv'
        Pairs of measures for hybrid curves, besides the curves of the six single measures.
    link : {'probit', 'logit', 'cloglog'}, default 'probit'
        Shape of the curve: probit (lognormal), logit or cloglog.
    estimator : {'ml', 'firth'}, default 'ml'
        What to maximise: ml (the likelihood) or firth (the penalised likelihood, for few events or
        separation).
    bootstrap : int, default 0
        Number of bootstrap resamples, drawn within each cell of magnitude and distance.
    confidence : float, default 0.95
        Confidence level of all limits.
    seed : int or numpy.random.Generator or None, default 42
        Seed of the random numbers. The same seed makes the same rows, on any machine. None takes a
        fresh seed, as in NumPy; a numpy.random.Generator draws one. ``Table.metadata`` and ``inspect``
        tell the seed.
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file. Further tables, where there are any:
        ``parts["bootstrap"]``.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
    >>> responses = rockfrag.simulate(motions, structures=equipment)
    >>> pro = rockfrag.fit_pro(responses, link="logit")
    >>> dict(zip(pro["im_x"].tolist(), pro["status"].tolist()))["im5"]
    'ok'
    """
@overload
def fit_pro(
    responses: TableLike,
    *,
    event: Literal['overturning', 'rocking'] = 'overturning',
    pairs: str | Iterable[str] = 'im4:im3_inv',
    link: Literal['probit', 'logit', 'cloglog'] = 'probit',
    estimator: Literal['ml', 'firth'] = 'ml',
    bootstrap: int = 0,
    confidence: float = 0.95,
    seed: int | Generator | None = 42,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def ida(
    motions: TableLike,
    *,
    measure: Literal['scale', 'pga', 'pgv', 'im4', 'im5', 'im6'] = 'scale',
    from_: float = 0.1,
    to: float = 10.0,
    steps: int = 60,
    halvings: int = 4,
    tolerance: float = 0.001,
    p: float | None = None,
    alpha: float | None = None,
    eta: float | Literal['housner'] | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    simd: Literal['scalar', 'neon', 'avx2', 'avx512'] | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Run incremental dynamic analysis: find the lowest intensity at which each motion overturns each
    structure, and the share of larger ones at which it does.

    Parameters
    ----------
    motions : Arrow table or path
        Motions to read, as in simulate; a file, or a folder of partitions.
    measure : {'scale', 'pga', 'pgv', 'im4', 'im5', 'im6'}, default 'scale'
        Intensity to scan: scale (the factor on the motion), pga (g), pgv (m/s), im4, im5 or im6 (Eq.
        13, for each structure).
    from_ : float, default 0.1
        Smallest intensity, in the unit of ``measure``.
    to : float, default 10.0
        Largest intensity, in the unit of ``measure``.
    steps : int, default 60
        Steps between them, in equal ratios; their ends are the stripes.
    halvings : int, default 4
        How often to halve a step where the structure rocks, which sets the resolution; near the tipping
        point, four times more.
    tolerance : float, default 0.001
        Relative error of the intensities at which the outcome changes.
    p : float, optional
        Frequency parameter of the structure, rad/s.
    alpha : float, optional
        Slenderness of the structure, rad.
    eta : float or {'housner'}, optional
        Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the
        dimensions].
    width : float, optional
        Width of the block or column, m; replaces p and alpha.
    height : float, optional
        Height of the block or column, m.
    beam_mass_ratio : float, optional
        For a frame: mass of the beam over the mass of all columns.
    structures : Structure, iterable of Structure, or path, optional
        One Structure or several; the path of a YAML, CSV or Parquet file of them; or 'paper', for both
        structures of the paper.
    simd : {'scalar', 'neon', 'avx2', 'avx512'}, optional
        Vector instructions of the solver, as in simulate [default: the fastest of this processor].
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file. Further tables, where there are any:
        ``parts["stripes"]``, ``parts["windows"]``, ``parts["shares"]``, ``parts["fragility"]``.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw=7.0, re=5, samples=3)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="pulse", dt=0.01)
    >>> ida = rockfrag.ida(motions, structures=rockfrag.Structure.block(0.5, 2.0))
    >>> len(ida)
    3
    """
@overload
def ida(
    motions: TableLike,
    *,
    measure: Literal['scale', 'pga', 'pgv', 'im4', 'im5', 'im6'] = 'scale',
    from_: float = 0.1,
    to: float = 10.0,
    steps: int = 60,
    halvings: int = 4,
    tolerance: float = 0.001,
    p: float | None = None,
    alpha: float | None = None,
    eta: float | Literal['housner'] | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    simd: Literal['scalar', 'neon', 'avx2', 'avx512'] | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def import_motions(
    files: PathLike | Iterable[PathLike],
    *,
    format: Literal['auto', 'at2', 'cosmos', 'csmip', 'esm', 'knet', 'smc', 'columns'] = 'auto',
    dt: float | None = None,
    unit: Literal['g', 'mg', 'm/s2', 'cm/s2', 'gal', 'mm/s2', '%g', 'ft/s2', 'in/s2'] | None = None,
    column: int | str | None = None,
    pga_tolerance: float = 0.05,
    baseline: Literal['none', 'mean', 'linear'] = 'none',
    high_pass: float | None = None,
    resample: float | None = None,
    rotate: float | Literal['strongest-pulse'] | None = None,
    scale: Steps | None = None,
    scale_pga: float | None = None,
    scale_pgv: float | None = None,
    pulses: Literal['find', 'skip'] = 'find',
    residual: bool = False,
    sa: Steps | None = None,
    housner: bool = False,
    accept_implausible: bool = False,
    keep_going: bool = False,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Import recorded ground motions from the files of strong-motion networks, CSV or Parquet.

    Parameters
    ----------
    files : path or iterable of path
        Files and folders of records, with all that is in the folders.
    format : {'auto', 'at2', 'cosmos', 'csmip', 'esm', 'knet', 'smc', 'columns'}, default 'auto'
        Format of text files: auto (by content), at2, cosmos, csmip, esm, knet, smc, or columns (plain
        numbers).
    dt : float, optional
        Time between samples, s, for files that do not state it, or only to few decimals; one that
        states another is refused.
    unit : {'g', 'mg', 'm/s2', 'cm/s2', 'gal', 'mm/s2', '%g', 'ft/s2', 'in/s2'}, optional
        Unit of the acceleration, for files that do not state it: g, mg, m/s2, cm/s2 (gal), mm/s2, %g,
        ft/s2 or in/s2. A file that states another is refused.
    column : int or str, optional
        Column of the acceleration in plain files: its number, its name, or all where one series wraps
        over lines [default: the one with that heading, or the only one besides times].
    pga_tolerance : float, default 0.05
        How far the peak of the samples may be from the peak in the header, as a share of it, besides
        rounding.
    baseline : {'none', 'mean', 'linear'}, default 'none'
        What to remove from the acceleration: none, mean, or linear (the line of least squares).
    high_pass : float, optional
        Corner of a zero-phase Butterworth high-pass of order 4, Hz [default: none].
    resample : float, optional
        Resample to this time step, s, band-limited [default: as in the file].
    rotate : float or {'strongest-pulse'}, optional
        Rotate each pair of horizontal components of one earthquake and station into one motion, towards
        an azimuth (degrees) or the strongest-pulse, and add RotD50 and RotD100 of PGA and PGV. Motions
        without a partner are left out.
    scale : float, iterable of float, or 'first:last:step', optional
        Scale by these factors, separated by commas or first:last:step; each makes a motion of each
        record.
    scale_pga : float, optional
        Scale each motion to this PGA, g.
    scale_pgv : float, optional
        Scale each motion to this PGV, m/s.
    pulses : {'find', 'skip'}, default 'find'
        Whether to look for velocity pulses: find (indicator of Baker 2007, then a fit of Eq. 1 for
        tp_s), or skip.
    residual : bool, default False
        Also write each motion with a pulse without that pulse, as suite residual.
    sa : float, iterable of float, or 'first:last:step', optional
        Add spectral accelerations (5 % damping) at these periods, s: first:last:step, or numbers
        separated by commas; the column sa_0p20_m_s2 is for 0.2 s.
    housner : bool, default False
        Also compute the Housner intensity, which takes 15 times as long or more.
    accept_implausible : bool, default False
        Import motions that no earthquake is likely to have made (by length, PGA, PGV, time step, spikes
        or drift), and warn of them.
    keep_going : bool, default False
        Import the rest where files cannot be read, and warn of those.
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import numpy as np, pathlib, rockfrag, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = pathlib.Path(folder.name, "mine.txt")
    >>> np.savetxt(file, 0.4 * np.sin(np.linspace(0.0, 60.0, 2001)) * np.hanning(2001))
    >>> motions = rockfrag.import_motions(file, dt=0.01, unit="g")
    >>> motions["pga_m_s2"].round(2)
    array([3.92])
    >>> folder.cleanup()
    """
@overload
def import_motions(
    files: PathLike | Iterable[PathLike],
    *,
    format: Literal['auto', 'at2', 'cosmos', 'csmip', 'esm', 'knet', 'smc', 'columns'] = 'auto',
    dt: float | None = None,
    unit: Literal['g', 'mg', 'm/s2', 'cm/s2', 'gal', 'mm/s2', '%g', 'ft/s2', 'in/s2'] | None = None,
    column: int | str | None = None,
    pga_tolerance: float = 0.05,
    baseline: Literal['none', 'mean', 'linear'] = 'none',
    high_pass: float | None = None,
    resample: float | None = None,
    rotate: float | Literal['strongest-pulse'] | None = None,
    scale: Steps | None = None,
    scale_pga: float | None = None,
    scale_pgv: float | None = None,
    pulses: Literal['find', 'skip'] = 'find',
    residual: bool = False,
    sa: Steps | None = None,
    housner: bool = False,
    accept_implausible: bool = False,
    keep_going: bool = False,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def rank_ims(
    responses: TableLike,
    motions: TableLike | None = None,
    *,
    limit_state: float = 0.1,
    transition: float | Literal['found'] = 'found',
    terms: int = 3,
    folds: int = 10,
    candidate: str | Iterable[str] | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Rank intensity measures, alone, in pairs and triples, by how well they predict held-out cells or
    earthquakes.

    Besides im1 to im6 of the paper, the measures of ``motions``, made dimensionless with p and g tan
    alpha: p D of the significant durations (d5_75, d5_95); p^2 PGD / (g tan alpha) (pgd), the same of
    the Housner intensity (housner); p CAV / (g tan alpha) (cav); p times the integral of a^2 / (g tan
    alpha)^2 (arias); Sa / (g tan alpha) (sa_0p50 is that at 0.5 s). Measures enter as a product, each
    to a power that the fit finds. PGA, PGV, Tm and Tp are those of im1 to im6.

    Parameters
    ----------
    responses : Arrow table or path
        Responses to read; a file, or a folder of partitions.
    motions : Arrow table or path, optional
        Motions of these responses, for further measures.
    limit_state : float, default 0.1
        Limit state of P_ex: a demand |theta|max / alpha.
    transition : float or {'found'}, default 'found'
        IM4 at which the demand breaks: a number, or found (where the pooled residual of the paper's two
        planes is least).
    terms : int, default 3
        Largest number of measures in a model, 1 to 3.
    folds : int, default 10
        Largest number of cross-validation folds; each holds out whole cells of magnitude and distance,
        or whole earthquakes.
    candidate : str or iterable of str, optional
        Further columns of ``motions`` to rank as measures. The unit at the end of the name says how to
        make them dimensionless: fiv3_m_s by p v / (g tan alpha).
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file. Further tables, where there are any:
        ``parts["reliability"]``.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
    >>> responses = rockfrag.simulate(motions, structures=equipment)
    >>> ranking = rockfrag.rank_ims(responses)
    >>> ranking.columns[:4]
    ['suite', 'structure', 'target', 'measures']
    """
@overload
def rank_ims(
    responses: TableLike,
    motions: TableLike | None = None,
    *,
    limit_state: float = 0.1,
    transition: float | Literal['found'] = 'found',
    terms: int = 3,
    folds: int = 10,
    candidate: str | Iterable[str] | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

def report(
    files: PathLike,
    rates: PathLike | None = None,
    *,
    title: str | None = None,
    author: str | None = None,
    date: str | None = None,
    suite: str | None = None,
    structure: str | None = None,
    groups: int = 4,
    motions: int = 40,
    dpi: float = 300.0,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    """Draw what a folder of files holds: one page to open in a browser, and each figure as SVG, PNG and
    CSV.

    Parameters
    ----------
    files : path
        Folder of the files: responses.parquet or its partitions, and any files of other stages; or
        annual rates alone.
    rates : path, optional
        Annual rates of evaluate ``hazard``, in a Parquet file or a folder of them [default:
        evaluated.parquet in the folder].
    title : str, optional
        Title of the page [default: Rocking fragility].
    author : str, optional
        Author, below the title.
    date : str, optional
        Date, in your own words; without it the page has none.
    suite : str, optional
        Suite to show [default: all].
    structure : str, optional
        Structure to show [default: all].
    groups : int, default 4
        Largest number of pairs of suite and structure to draw, in the order of the file; findings and
        tables hold all.
    motions : int, default 40
        Number of motions to browse in the page.
    dpi : float, default 300.0
        Dots per inch of the PNG files.
    out : path
        Page to write, NAME.html; its path is returned. A file that is up to date is left as it is.
        Figures go into the folder NAME beside it.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    pathlib.Path
        The path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
    >>> responses = rockfrag.simulate(motions, structures=equipment)
    >>> import pathlib, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> responses.to_polars().write_parquet(pathlib.Path(folder.name, "responses.parquet"))
    >>> rockfrag.report(folder.name, out=pathlib.Path(folder.name, "report.html")).name
    'report.html'
    >>> folder.cleanup()
    """

@overload
def sample_scenarios(
    *,
    seed: int | Generator | None = 42,
    samples: int = 100,
    mw: Steps = '5.5:7.5:0.5',
    re: Steps = '5:20:2.5',
    design: Literal['lhs', 'random', 'sobol'] = 'lhs',
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Sample earthquake scenarios on a magnitude-distance grid.

    Parameters
    ----------
    seed : int or numpy.random.Generator or None, default 42
        Seed of the random numbers. The same seed makes the same rows, on any machine. None takes a
        fresh seed, as in NumPy; a numpy.random.Generator draws one. ``Table.metadata`` and ``inspect``
        tell the seed.
    samples : int, default 100
        Scenarios in each cell of the grid.
    mw : float, iterable of float, or 'first:last:step', default '5.5:7.5:0.5'
        Moment magnitudes: first:last:step, or numbers separated by commas.
    re : float, iterable of float, or 'first:last:step', default '5:20:2.5'
        Distances, km: first:last:step, or numbers separated by commas.
    design : {'lhs', 'random', 'sobol'}, default 'lhs'
        How to sample each cell: lhs (Latin hypercube), random or sobol.
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw=[6.5, 7.0], re=10, samples=5, seed=1)
    >>> scenarios.shape
    (10, 9)
    >>> scenarios["mw"]
    array([6.5, 6.5, 6.5, 6.5, 6.5, 7. , 7. , 7. , 7. , 7. ])
    """
@overload
def sample_scenarios(
    *,
    seed: int | Generator | None = 42,
    samples: int = 100,
    mw: Steps = '5.5:7.5:0.5',
    re: Steps = '5:20:2.5',
    design: Literal['lhs', 'random', 'sobol'] = 'lhs',
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def simulate(
    motions: TableLike,
    *,
    p: float | None = None,
    alpha: float | None = None,
    eta: float | Literal['housner'] | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    simd: Literal['scalar', 'neon', 'avx2', 'avx512'] | None = None,
    trace: int | str | Iterable[int | str] | None = None,
    partition: tuple[int, int] | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Simulate the rocking response of structures to motions.

    Parameters
    ----------
    motions : Arrow table or path
        Motions to read; those of other programs need motion_id, dt_s and acceleration_m_s2; a file, or
        a folder of partitions.
    p : float, optional
        Frequency parameter of the structure, rad/s.
    alpha : float, optional
        Slenderness of the structure, rad.
    eta : float or {'housner'}, optional
        Coefficient of restitution: a number, or housner for 1 - 1.5 sin^2(alpha) [default: from the
        dimensions].
    width : float, optional
        Width of the block or column, m; replaces p and alpha.
    height : float, optional
        Height of the block or column, m.
    beam_mass_ratio : float, optional
        For a frame: mass of the beam over the mass of all columns.
    structures : Structure, iterable of Structure, or path, optional
        One Structure or several; the path of a YAML, CSV or Parquet file of them; or 'paper', for both
        structures of the paper.
    simd : {'scalar', 'neon', 'avx2', 'avx512'}, optional
        Vector instructions of the solver: scalar, neon, avx2 or avx512; all give the same bits
        [default: the fastest of this processor].
    trace : int or str or iterable of int or str, optional
        Also write the rotation over time for these motions, to NAME.trace.parquet beside the output.
    partition : tuple[int, int], optional
        (i, n): do only partition i of n, with i from 0 to n - 1. ``out`` is then a folder; the file in
        it is part-0000i.parquet.
    out : path, optional
        Parquet file to write, or without a suffix a folder of partitions; its path is returned. A file
        that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file. Further tables, where there are any:
        ``parts["trace"]``.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> block = rockfrag.Structure.block(0.5, 2.0, name="block")
    >>> responses = rockfrag.simulate(motions, structures=block)
    >>> len(responses), sum(responses["outcome"] == "overturning").item()
    (120, 23)
    >>> rockfrag.simulate(motions)
    Traceback (most recent call last):
    rockfrag.errors.OptionError: no structure; ...
    """
@overload
def simulate(
    motions: TableLike,
    *,
    p: float | None = None,
    alpha: float | None = None,
    eta: float | Literal['housner'] | None = None,
    width: float | None = None,
    height: float | None = None,
    beam_mass_ratio: float | None = None,
    structures: Structures | None = None,
    simd: Literal['scalar', 'neon', 'avx2', 'avx512'] | None = None,
    trace: int | str | Iterable[int | str] | None = None,
    partition: tuple[int, int] | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def synthesize_motions(
    scenarios: TableLike,
    *,
    seed: int | Generator | None = 42,
    suite: Literal['pulse', 'csgm', 'hfc'] | Iterable[Literal['pulse', 'csgm', 'hfc']] = ('pulse', 'csgm'),
    dt: float = 0.005,
    difference: Literal['absolute', 'signed', 'clamp', 'none'] = 'absolute',
    epoch: Literal['envelope-peak', 'pga', 'pgv'] = 'envelope-peak',
    site: str = 'rock',
    kappa: float = 0.03,
    fmax: float | None = None,
    low_cut: float | None = None,
    low_cut_order: int = 4,
    housner: bool = False,
    sa: Steps | None = None,
    row_group: int = 128,
    partition: tuple[int, int] | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Synthesize near-fault ground motions: coherent pulse and stochastic high frequencies.

    Parameters
    ----------
    scenarios : Arrow table or path
        Scenarios to read.
    seed : int or numpy.random.Generator or None, default 42
        Seed of the random numbers. The same seed makes the same rows, on any machine. None takes a
        fresh seed, as in NumPy; a numpy.random.Generator draws one. ``Table.metadata`` and ``inspect``
        tell the seed.
    suite : {'pulse', 'csgm', 'hfc'} or iterable of {'pulse', 'csgm', 'hfc'}, default ('pulse', 'csgm')
        One suite or several: pulse, csgm (pulse with high frequencies), hfc (high frequencies alone).
    dt : float, default 0.005
        Time between samples, s.
    difference : {'absolute', 'signed', 'clamp', 'none'}, default 'absolute'
        How to subtract the pulse from the spectrum of the high frequencies where the pulse is stronger:
        absolute, signed, clamp or none (plain sum).
    epoch : {'envelope-peak', 'pga', 'pgv'}, default 'envelope-peak'
        When the pulse peaks: envelope-peak (at the peak of the envelope), pga or pgv (at the peak
        acceleration or velocity of the high frequencies).
    site : str, default 'rock'
        Site amplification: rock, soil, none, or a CSV file with a column of frequencies (Hz) and one of
        factors.
    kappa : float, default 0.03
        Near-surface attenuation kappa, s.
    fmax : float, optional
        Corner of the filter 1/sqrt(1 + (f/fmax)^8), Hz [default: none].
    low_cut : float, optional
        Corner of the high-pass filter 1/(1 + (fc/f)^(2n)), Hz [default: none].
    low_cut_order : int, default 4
        Order n of the high-pass filter.
    housner : bool, default False
        Also compute the Housner intensity, which takes 15 times as long or more.
    sa : float, iterable of float, or 'first:last:step', optional
        Add spectral accelerations (5 % damping) at these periods, s: first:last:step, or numbers
        separated by commas; the column sa_0p20_m_s2 is for 0.2 s.
    row_group : int, default 128
        Scenarios in a row group, which are held in memory together; the rows do not depend on it.
    partition : tuple[int, int], optional
        (i, n): do only partition i of n, with i from 0 to n - 1. ``out`` is then a folder; the file in
        it is part-0000i.parquet.
    out : path, optional
        Parquet file to write, or without a suffix a folder of partitions; its path is returned. A file
        that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw=6.5, re=10, samples=5)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite=["pulse", "csgm"])
    >>> len(motions), motions["suite"][:2].tolist()
    (10, ['pulse', 'csgm'])
    >>> motions["acceleration_m_s2"][0].shape == motions["acceleration_m_s2"][1].shape
    True
    """
@overload
def synthesize_motions(
    scenarios: TableLike,
    *,
    seed: int | Generator | None = 42,
    suite: Literal['pulse', 'csgm', 'hfc'] | Iterable[Literal['pulse', 'csgm', 'hfc']] = ('pulse', 'csgm'),
    dt: float = 0.005,
    difference: Literal['absolute', 'signed', 'clamp', 'none'] = 'absolute',
    epoch: Literal['envelope-peak', 'pga', 'pgv'] = 'envelope-peak',
    site: str = 'rock',
    kappa: float = 0.03,
    fmax: float | None = None,
    low_cut: float | None = None,
    low_cut_order: int = 4,
    housner: bool = False,
    sa: Steps | None = None,
    row_group: int = 128,
    partition: tuple[int, int] | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def universality(
    responses: TableLike,
    *,
    reference: str = 'electrical-equipment',
    model: Literal['univariate', 'bivariate'] = 'bivariate',
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    transition: float = 1.3,
    limit_state: float = 0.1,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Test the curves of one structure on the responses of all others to the same motions.

    Parameters
    ----------
    responses : Arrow table or path
        Responses of all structures to read; a file, or a folder of partitions.
    reference : str, default 'electrical-equipment'
        Structure whose curves to transfer to all others.
    model : {'univariate', 'bivariate'}, default 'bivariate'
        bivariate (two planes over im4 and im3, hybrid curve of im4 and im3_inv) or univariate.
    measure : {'im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'}, optional
        Measure of the univariate model, im1 to im6 [default: im5].
    transition : float, default 1.3
        IM4 at which the two planes of all structures meet.
    limit_state : float, default 0.1
        Limit state of P_ex: a demand |theta|max / alpha.
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file. Further tables, where there are any:
        ``parts["pooled"]``.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> structures = [rockfrag.Structure(p=p, alpha=0.2, eta=0.92, name=f"p{p}") for p in (2.0, 2.5)]
    >>> responses = rockfrag.simulate(motions, structures=structures)
    >>> verdicts = rockfrag.universality(responses, reference="p2.5")
    >>> verdicts["verdict"].tolist()
    ['bends', 'holds', 'fails', 'holds']
    """
@overload
def universality(
    responses: TableLike,
    *,
    reference: str = 'electrical-equipment',
    model: Literal['univariate', 'bivariate'] = 'bivariate',
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    transition: float = 1.3,
    limit_state: float = 0.1,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...

@overload
def validate(
    responses: TableLike,
    pex: TableLike | None = None,
    pro: TableLike | None = None,
    *,
    model: Literal['univariate', 'bivariate', 'paper', 'universal'] | None = None,
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    hazard: Hazard | None = None,
    columns: str | None = None,
    suite: str | None = None,
    structure: str | None = None,
    out: None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Table:
    """Test fits on responses they were not fitted to, such as those to records: observed and expected
    counts, scores.

    Parameters
    ----------
    responses : Arrow table or path
        Responses to test the fits on, such as those to records; a file, or a folder of partitions.
    pex : Arrow table or path, optional
        Demand fits, from fit_pex.
    pro : Arrow table or path, optional
        Overturning curves, from fit_pro.
    model : {'univariate', 'bivariate', 'paper', 'universal'}, optional
        bivariate (two planes over im4 and im3, curve of im4 and im3_inv) or univariate, whose curve
        bends where tests reject the straight line; paper (the straight line always; univariate with
        ``measure``); or universal (the surface for all structures, without fits) [default: bivariate;
        universal where there are no fits, or those found here are of other structures].
    measure : {'im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'}, optional
        Measure of the univariate model, im1 to im6 [default: im5, or the two of paper].
    hazard : path, Arrow table or mapping, optional
        CSV file, or its columns as a table or mapping: pga_g or pgv_m_s with annual_rate_of_exceedance.
        Counts annual rates in the motions themselves, weighted to have its rates, beside those of the
        fits.
    columns : str, optional
        Which headings of ``hazard`` stand for which columns, as
        'pga_g=PGA,annual_rate_of_exceedance=rate'.
    suite : str, optional
        Suite of the fits [default: all].
    structure : str, optional
        Structure of the fits [default: all].
    out : path, optional
        Parquet file to write; its path is returned. A file that is up to date is left as it is.
    threads : int, optional
        Number of threads; all cores if not given.
    progress : callable, optional
        Called with the number of steps done and of all, a few times a second.
    force : bool, default False
        Also make a file that is up to date.
    overwrite : bool, default False
        Replace a file that another stage or program has made.

    Returns
    -------
    Table or pathlib.Path
        A table in memory; with ``out``, the path of the file.

    Raises
    ------
    OptionError
        If an option has a wrong type, is out of range, or does not go with another.
    TableError
        If a table lacks a column, has no rows, or holds a value that cannot be used.
    MissingFileError
        If a file does not exist.
    FileError
        If a file cannot be read or written.

    Warns
    -----
    RockfragWarning
        If a result is doubtful: a fit that failed, an intensity outside of the data.

    Examples
    --------
    >>> import rockfrag
    >>> scenarios = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=20)
    >>> motions = rockfrag.synthesize_motions(scenarios, suite="csgm", dt=0.01)
    >>> equipment = rockfrag.Structure(p=2.5, alpha=0.20, eta=0.92, name="equipment")
    >>> responses = rockfrag.simulate(motions, structures=equipment)
    >>> pex, pro = rockfrag.fit_pex(responses, transition=1.3), rockfrag.fit_pro(responses)
    >>> others = rockfrag.sample_scenarios(mw="6.5:7.5:0.5", re="5,10", samples=5, seed=1)
    >>> unseen = rockfrag.simulate(rockfrag.synthesize_motions(others, suite="csgm", dt=0.01, seed=1), structures=equipment)
    >>> validation = rockfrag.validate(unseen, pex, pro, model="univariate", measure="im5")
    >>> validation.columns[:4]
    ['suite', 'structure', 'fits_suite', 'event']
    """
@overload
def validate(
    responses: TableLike,
    pex: TableLike | None = None,
    pro: TableLike | None = None,
    *,
    model: Literal['univariate', 'bivariate', 'paper', 'universal'] | None = None,
    measure: Literal['im1', 'im2', 'im3', 'im4', 'im5', 'im6', 'im3_inv'] | None = None,
    hazard: Hazard | None = None,
    columns: str | None = None,
    suite: str | None = None,
    structure: str | None = None,
    out: PathLike,
    threads: int | None = None,
    progress: Progress | None = None,
    force: bool = False,
    overwrite: bool = False,
) -> Path:
    ...
