"""Every stage of the command as a function. Made by backend.py."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

from ._call import call
from ._result import Result

Path = str | PathLike[str]


class Fields(TypedDict, total=False):
    """width: Width of the base of a block, body or column, m; the smaller side unless depth is given
    depth: Depth of the base, m: the object may also fall that way; simulate and ida take the weaker
        direction
    height: Height of the block, body or column, m
    centre_height: Height of the centre of mass above the base, m [default: half the height]
    centre_offset: Distance of the centre of mass from the middle of the width, m [default: 0]
    inertia: Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid
        block]
    beam_mass_ratio: Frame: mass of the beam over that of all columns
    p: Frequency parameter, rad/s
    alpha: Slenderness, rad, or in degrees as 8.5deg
    eta: Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    period: First period of the building, s [default: the object stands on the ground]
    level: Height of the floor over that of the roof, 0 to 1
    period_sd: Standard deviation of ln(period) [default: 0.25]
    friction: Coefficient of friction; if tan(alpha) exceeds it, the object slides
    base: Base or feet: concrete, stone, timber, steel, felt or rubber; sets eta by tests
    wall: Wall behind it, with its rebound if known: the velocity after an impact over that before
    eta_sd: Standard deviation of eta [default: 0 if eta is given; that of tests if it is computed]
    alpha_sd: Standard deviation of alpha, as by tilt tests, rad, or in degrees as 2deg [default: 0]
    centre_height_sd: Standard deviation of the height of the centre of mass, m
    centre_offset_sd: Standard deviation of the offset of the centre of mass, m
    mass: Mass of the object, beside that of its pedestal, kg
    fixed_to_pedestal: Whether it is fixed to its pedestal, as one body, or loose on it
    pedestal_width: Width of the pedestal, m
    pedestal_depth: Depth of the pedestal, m
    pedestal_height: Height of the pedestal, m
    pedestal_mass: Mass of the pedestal, kg
    """

    name: str
    count: int
    width: float | None
    depth: float | None
    height: float | None
    centre_height: float | None
    centre_offset: float | None
    inertia: float | None
    beam_mass_ratio: float | None
    p: float | None
    alpha: float | str | None
    eta: float | Literal['housner'] | None
    period: float | None
    level: float | None
    period_sd: float | None
    friction: float | None
    base: Literal['concrete', 'stone', 'timber', 'steel', 'felt', 'rubber'] | None
    wall: bool | float | Literal['yes'] | None
    eta_sd: float | None
    alpha_sd: float | str | None
    centre_height_sd: float | None
    centre_offset_sd: float | None
    mass: float | None
    fixed_to_pedestal: bool | None
    pedestal_width: float | None
    pedestal_depth: float | None
    pedestal_height: float | None
    pedestal_mass: float | None


def sample_scenarios(*, seed: int | None = None, samples: int | None = None, mw: Any | None = None, re: Any | None = None, design: Any | None = None, out: Path | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Sample earthquake scenarios on a magnitude-distance grid.

    seed = 42: Seed of the random parameters
    samples = 100: Scenarios in each cell of the grid
    mw = 5.5:7.5:0.5: Moment magnitudes: first:last:step, or numbers separated by commas
    re = 5:20:2.5: Distances, km: first:last:step, or numbers separated by commas
    design = lhs: How to sample each cell: lhs (Latin hypercube) or random
    out = temporary: Scenarios to write
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("sample-scenarios", locals(), [], "")


def synthesize_motions(input: Any = None, /, *, out: Path | None = None, seed: int | None = None, suite: Literal['pulse', 'csgm', 'hfc', 'record'] | Sequence[Literal['pulse', 'csgm', 'hfc', 'record']] | None = None, dt: float | None = None, difference: Any | None = None, epoch: Any | None = None, site: Any | None = None, window: float | None = None, shear_velocity: float | None = None, kappa: float | None = None, fmax: float | None = None, low_cut: float | None = None, housner: bool | None = None, sa: Any | None = None, partition: Any | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Synthesize near-fault ground motions: coherent pulse and stochastic high frequencies.

    input: Scenarios to read
    out = temporary: Motions to write
    seed = 42: Seed of the noise
    suite = pulse,csgm: Suites: pulse (alone), hfc (high frequencies alone), csgm (both)
    dt = 0.005: Time between samples, s
    difference = clamp: High frequencies where the pulse is stronger: left out (clamp), or as they are
        (none, the plain sum)
    epoch = envelope-peak: Where the pulse peaks: envelope-peak, pga or pgv of the high frequencies
    site = rock: Site: rock, soil, none, or a CSV file of frequencies (Hz) and factors
    window = 1: Window of the high frequencies, in durations of the earthquake
    shear_velocity = 3.7: Shear-wave velocity of the crust, km/s
    kappa = 0.035: Near-surface attenuation kappa, s
    fmax = 15: Corner of the filter 1/sqrt(1 + (f/fmax)^8), Hz; 1e6 for none
    low_cut: Corner of the high-pass filter 1/(1 + (fc/f)^8), Hz [default: none]
    housner = False: Also compute the Housner intensity (15 times as slow)
    sa: Add spectral accelerations (5 % damping) at these periods, s, as sa_0p20_m_s2
    partition: Only part i of n (0 to n - 1), into the folder out
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("synthesize-motions", locals(), ['in', 'site'], "in")


def import_motions(input: Any = None, /, *, out: Path | None = None, format: Any | None = None, dt: float | None = None, unit: Any | None = None, column: Any | None = None, baseline: Any | None = None, high_pass: float | None = None, resample: float | None = None, rotate: Any | None = None, scale: Any | None = None, pulses: Any | None = None, sa: Any | None = None, housner: bool | None = None, about: Any | None = None, accept_implausible: bool | None = None, keep_going: bool | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Import recorded ground motions from the files of strong-motion networks, or CSV.

    input: Files and folders of records
    out = temporary: Motions to write
    format: Format: at2, cosmos, esm, knet or csv [default: by content]
    dt: Time step, s, where files do not state it
    unit: Unit of acceleration, where files do not state it: g, m/s2, cm/s2 (gal), mm/s2, mg, %g, ft/s2
        or in/s2
    column: Column of acceleration in CSV: number, heading, or all where one series wraps over lines
    baseline = none: Remove from acceleration: none, mean or linear
    high_pass: Corner of a zero-phase high-pass filter of order 4, Hz
    resample: Resample to this time step, s
    rotate: Rotate pairs of horizontal components to an azimuth (degrees) or the strongest-pulse; add
        RotD50 and RotD100
    scale: Scale by these factors; each gives a separate motion
    pulses = find: Velocity pulses: find (Baker 2007, then a fit of Eq. 1, the velocity) or skip
    sa: Add spectral accelerations (5 % damping) at these periods, s, as sa_0p20_m_s2
    housner = False: Also compute the Housner intensity (15 times as slow)
    about: Table with the magnitude, distance (km) or earthquake of each file (columns file, magnitude,
        distance, earthquake), or PEER's search results or flatfile
    accept_implausible = False: Import physically implausible motions
    keep_going = False: Skip files that cannot be read
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("import-motions", locals(), ['files', 'about'], "files")


def floor_motions(input: Any = None, /, *, out: Path | None = None, period: float | None = None, level: float | None = None, damping: float | None = None, partition: Any | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Filter motions through a linear building to one of its floors.

    input: Motions of the ground to read: motion_id, dt_s and acceleration_m_s2
    out = temporary: Motions of the floor to write, with all other columns
    period: First period of the building, s
    level: Height of the floor over that of the roof, 0 to 1
    damping = 0.05: Damping ratio of the modes
    partition: Only part i of n (0 to n - 1), into the folder out
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("floor-motions", locals(), ['in'], "in")


def simulate(input: Any = None, /, *, out: Path | None = None, structure: Any | None = None, structures: Any | None = None, columns: Any | None = None, ignore: Any | None = None, ground_floor: int | None = None, storeys: int | None = None, building: Any | None = None, trace: Any | None = None, partition: Any | None = None, width: float | None = None, height: float | None = None, depth: float | None = None, centre_height: float | None = None, centre_offset: float | None = None, inertia: float | None = None, beam_mass_ratio: float | None = None, p: float | None = None, alpha: float | str | None = None, eta: float | Literal['housner'] | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Simulate the rocking response of structures to motions: the paper's two structures, or your own.

    input: Motions to read: motion_id, dt_s and acceleration_m_s2
    out = temporary: Responses to write
    structure: A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
        name=cabinet,width=0.8,height=2.2
    structures: List with a name and these options as columns (m, cm or mm by the heading): CSV or a
        workbook (list.xlsx#SHEET), or the word paper for the paper's two
    columns: Column names for headings of lists, hazards and tables of motions
    ignore: Headings of columns of these files to leave out
    ground_floor: Number that the floors of a list give the ground floor: 0 or 1
    storeys: Storeys of the building, for rows of a list that do not say theirs
    building: Its kind: walls, masonry, concrete frame or steel frame
    trace: Also write the response to these motions over time, or to all, to NAME.trace.parquet: by a
        plain solver, which may disagree with the outcome when a structure nearly overturns
    partition: Only part i of n (0 to n - 1), into the folder out
    width: Width of the base of a block, body or column, m; the smaller side unless depth is given
    height: Height of the block, body or column, m
    depth: Depth of the base, m: the object may also fall that way; simulate and ida take the weaker
        direction
    centre_height: Height of the centre of mass above the base, m [default: half the height]
    centre_offset: Distance of the centre of mass from the middle of the width, m [default: 0]
    inertia: Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid
        block]
    beam_mass_ratio: Frame: mass of the beam over that of all columns
    p: Frequency parameter, rad/s
    alpha: Slenderness, rad, or in degrees as 8.5deg
    eta: Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("simulate", locals(), ['in', 'structures'], "in")


def ida(input: Any = None, /, *, out: Path | None = None, measure: Any | None = None, from_: float | None = None, to: float | None = None, steps: int | None = None, structure: Any | None = None, structures: Any | None = None, columns: Any | None = None, ignore: Any | None = None, ground_floor: int | None = None, storeys: int | None = None, building: Any | None = None, width: float | None = None, height: float | None = None, depth: float | None = None, centre_height: float | None = None, centre_offset: float | None = None, inertia: float | None = None, beam_mass_ratio: float | None = None, p: float | None = None, alpha: float | str | None = None, eta: float | Literal['housner'] | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Scale motions until they overturn each structure (incremental dynamic analysis).

    input: Motions to read, as in simulate
    out = temporary: Overturning intensities to write, with NAME.stripes.parquet and
        NAME.fragility.parquet beside
    measure = scale: Intensity to scale by: scale (a factor), pga (g), pgv (m/s), im4, im5 or im6
    from_ = 0.1: Smallest intensity, in the unit of measure
    to = 10: Largest intensity, in the unit of measure
    steps = 60: Number of steps, in equal ratios
    structure: A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
        name=cabinet,width=0.8,height=2.2
    structures: List with a name and these options as columns (m, cm or mm by the heading): CSV or a
        workbook (list.xlsx#SHEET), or the word paper for the paper's two
    columns: Column names for headings of lists, hazards and tables of motions
    ignore: Headings of columns of these files to leave out
    ground_floor: Number that the floors of a list give the ground floor: 0 or 1
    storeys: Storeys of the building, for rows of a list that do not say theirs
    building: Its kind: walls, masonry, concrete frame or steel frame
    width: Width of the base of a block, body or column, m; the smaller side unless depth is given
    height: Height of the block, body or column, m
    depth: Depth of the base, m: the object may also fall that way; simulate and ida take the weaker
        direction
    centre_height: Height of the centre of mass above the base, m [default: half the height]
    centre_offset: Distance of the centre of mass from the middle of the width, m [default: 0]
    inertia: Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid
        block]
    beam_mass_ratio: Frame: mass of the beam over that of all columns
    p: Frequency parameter, rad/s
    alpha: Slenderness, rad, or in degrees as 8.5deg
    eta: Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("ida", locals(), ['in', 'structures'], "in")


def fit_pex(input: Any = None, /, *, out: Path | None = None, limit_state: float | Sequence[float] | None = None, transition: float | None = None, rotation_floor: float | None = None, confidence: float | None = None, all: bool | None = None, pairs: Any | None = None, motions: Any | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Fit the probability of exceeding a demand in safe rocking: P_ex.

    input: Responses to read
    out = temporary: Fits to write, with NAME.parameters.parquet and NAME.calibration.parquet beside
    limit_state = 0.1: Limit states: demands |theta|max / alpha
    transition = 1.3: IM4 at which the planes meet; the column transition_found has that of the least
        residual
    rotation_floor = 1e-6: Lower bound on rotations in safe rocking, rad, as a solver of finite
        tolerance imposes
    confidence = 0.95: Confidence level of the limits
    all = False: Also fit each of the six measures alone, and one plane over all cases
    pairs: Further measures to fit over all cases, and pairs of them for planes; or columns of motions
    motions: Motions of these responses; p and g tan alpha make columns in m/s2, m/s, m and s
        dimensionless
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("fit-pex", locals(), ['in', 'motions'], "in")


def fit_pro(input: Any = None, /, *, out: Path | None = None, pairs: Any | None = None, motions: Any | None = None, confidence: float | None = None, all: bool | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Fit the probability of overturning: P_ro.

    input: Responses to read; or a list of what stood and what fell, CSV or Parquet: sizes, PGA, PGV,
        fell
    out = temporary: Fits to write, with NAME.parameters.parquet and NAME.calibration.parquet beside
    pairs = im4:im3_inv,im5:im3_inv: Measures, and pairs of them for hybrid curves, besides IM4 and IM5;
        or columns of motions
    motions: Motions of these responses; p and g tan alpha make columns in m/s2, m/s, m and s
        dimensionless
    confidence = 0.95: Confidence level of the limits
    all = False: Fit all six measures and both hybrids of the paper, not only IM4 and IM5
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("fit-pro", locals(), ['in', 'motions'], "in")


def compare_paper(*, pex: Any | None = None, pro: Any | None = None, out: Path | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Compare what the paper publishes with twenty seeds of its set-up, and with the fits of this run.

    pex = pex.parquet: Fits of fit-pex
    pro = pro.parquet: Fits of fit-pro
    out = temporary: Comparison to write
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("compare-paper", locals(), ['pex', 'pro'], "")


def evaluate(input: Any = None, /, *, pga: float | None = None, pgv: float | None = None, hazard: Any | None = None, magnitude: float | None = None, vs30: float | None = None, effective_years: float | None = None, years: float | None = None, ratio: float | None = None, target: float | str | None = None, over: Literal['pga', 'pgv'] | None = None, variants: bool | None = None, format: Literal['text', 'csv', 'json'] | None = None, out: Path | None = None, title: Any | None = None, project: Any | None = None, author: Any | None = None, date: Any | None = None, fits: Any | None = None, name: Any | None = None, suite: Literal['recorded', 'csgm', 'pulse', 'hfc'] | None = None, model: Literal['calibrated', 'paper'] | None = None, limit_state: float | None = None, structure: Any | None = None, structures: Any | None = None, columns: Any | None = None, ignore: Any | None = None, ground_floor: int | None = None, storeys: int | None = None, building: Any | None = None, width: float | None = None, height: float | None = None, depth: float | None = None, centre_height: float | None = None, centre_offset: float | None = None, inertia: float | None = None, beam_mass_ratio: float | None = None, p: float | None = None, alpha: float | str | None = None, eta: float | Literal['housner'] | None = None, period: float | None = None, level: float | None = None, period_sd: float | None = None, friction: float | None = None, base: Literal['concrete', 'stone', 'timber', 'steel', 'felt', 'rubber'] | None = None, wall: bool | float | Literal['yes'] | None = None, eta_sd: float | None = None, alpha_sd: float | str | None = None, centre_height_sd: float | None = None, centre_offset_sd: float | None = None, mass: float | None = None, fixed_to_pedestal: bool | None = None, pedestal_width: float | None = None, pedestal_depth: float | None = None, pedestal_height: float | None = None, pedestal_mass: float | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Predict the probability of rocking and overturning: under one motion, under each motion of a table,
    or per year at a site.

    input: Table of PGA and PGV (pga_m_s2 or pga_g, pgv_m_s), Parquet or CSV, with p_rad_s, alpha_rad
        and eta where they vary
    pga: Peak ground acceleration, g
    pgv: Peak ground velocity, m/s
    hazard: Hazard curves, CSV: PGA, best with PGV or SA(1.0 s), by annual rates, probabilities or
        return periods; or PGA and PGV together, by rates of occurrence or as OpenQuake's ground-motion
        fields
    magnitude: Moment magnitude of motions without one [default: inferred from PGV/PGA, else that of
        motions that overturn]; at a site the mean of the disaggregation at 2475 years, of SA(1.0 s)
        with that curve, else of PGA (not used with PGV alone)
    vs30: Vs30 of the site, m/s: narrows the estimate of the peak that is not given
    effective_years: Years represented by ground-motion fields
    years = 50: Exposure time, years
    ratio: PGV/PGA of all motions, s [default: from the curves, or that of typical sites]
    target: Probability of overturning in years, such as 1%: find the width of the base that meets it
    over: Fragility over pga or pgv alone: without a motion or hazard [default: over both]; beside a
        hazard curve, at its site
    variants = False: What would change the object, or the worst ten: printed, and beside a Parquet file
        NAME.variants.parquet
    format = text: text, csv or json
    out = temporary: File to write: .parquet, .csv, .json, .xlsx, a page (.html) or its main figure
        (.svg, .png) [default: none; with in, evaluated.parquet beside it]
    title: Title of the page [default: from what it shows]
    project: Project, below the title
    author: Author, below the title
    date: Date, below the title
    fits: Folder of fits, from fit-pex and fit-pro [default: the universal surface as shipped]
    name: Which structure of the fits to use [default: the one with the same p, alpha and eta]
    suite: Kind of motion: recorded, csgm, pulse or hfc [default: the kind of the fits, else recorded]
    model = calibrated: calibrated (the surface, by the fits) or paper (its planes and hybrid curve)
    limit_state = 0.1: Limit state, as demand |theta|max / alpha
    structure: A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
        name=cabinet,width=0.8,height=2.2
    structures: List with a name and these options as columns (m, cm or mm by the heading): CSV or a
        workbook (list.xlsx#SHEET), or the word paper for the paper's two
    columns: Column names for headings of lists, hazards and tables of motions
    ignore: Headings of columns of these files to leave out
    ground_floor: Number that the floors of a list give the ground floor: 0 or 1
    storeys: Storeys of the building, for rows of a list that do not say theirs
    building: Its kind: walls, masonry, concrete frame or steel frame
    width: Width of the base of a block, body or column, m; the smaller side unless depth is given
    height: Height of the block, body or column, m
    depth: Depth of the base, m: the object may also fall that way; simulate and ida take the weaker
        direction
    centre_height: Height of the centre of mass above the base, m [default: half the height]
    centre_offset: Distance of the centre of mass from the middle of the width, m [default: 0]
    inertia: Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid
        block]
    beam_mass_ratio: Frame: mass of the beam over that of all columns
    p: Frequency parameter, rad/s
    alpha: Slenderness, rad, or in degrees as 8.5deg
    eta: Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    period: First period of the building, s [default: the object stands on the ground]
    level: Height of the floor over that of the roof, 0 to 1
    period_sd: Standard deviation of ln(period) [default: 0.25]
    friction: Coefficient of friction; if tan(alpha) exceeds it, the object slides
    base: Base or feet: concrete, stone, timber, steel, felt or rubber; sets eta by tests
    wall: Wall behind it, with its rebound if known: the velocity after an impact over that before
    eta_sd: Standard deviation of eta [default: 0 if eta is given; that of tests if it is computed]
    alpha_sd: Standard deviation of alpha, as by tilt tests, rad, or in degrees as 2deg [default: 0]
    centre_height_sd: Standard deviation of the height of the centre of mass, m
    centre_offset_sd: Standard deviation of the offset of the centre of mass, m
    mass: Mass of the object, beside that of its pedestal, kg
    fixed_to_pedestal: Whether it is fixed to its pedestal, as one body, or loose on it
    pedestal_width: Width of the pedestal, m
    pedestal_depth: Depth of the pedestal, m
    pedestal_height: Height of the pedestal, m
    pedestal_mass: Mass of the pedestal, kg
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("evaluate", locals(), ['in', 'hazard', 'fits', 'structures'], "in")


def export(*, to: Any | None = None, over: Literal['pga', 'pgv'] | None = None, magnitude: float | None = None, out: Path | None = None, fits: Any | None = None, name: Any | None = None, suite: Literal['recorded', 'csgm', 'pulse', 'hfc'] | None = None, model: Literal['calibrated', 'paper'] | None = None, limit_state: float | None = None, structure: Any | None = None, structures: Any | None = None, columns: Any | None = None, ignore: Any | None = None, ground_floor: int | None = None, storeys: int | None = None, building: Any | None = None, width: float | None = None, height: float | None = None, depth: float | None = None, centre_height: float | None = None, centre_offset: float | None = None, inertia: float | None = None, beam_mass_ratio: float | None = None, p: float | None = None, alpha: float | str | None = None, eta: float | Literal['housner'] | None = None, period: float | None = None, level: float | None = None, friction: float | None = None, base: Literal['concrete', 'stone', 'timber', 'steel', 'felt', 'rubber'] | None = None, wall: bool | float | Literal['yes'] | None = None, mass: float | None = None, fixed_to_pedestal: bool | None = None, pedestal_width: float | None = None, pedestal_depth: float | None = None, pedestal_height: float | None = None, pedestal_mass: float | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Write fragility over PGA or PGV, averaged over PGV/PGA, for OpenQuake or pelicun.

    to: openquake (NRML) or pelicun (CSV, and JSON beside it)
    over: Fragility over pga or pgv alone [default: over both]
    magnitude: Moment magnitude of the motions [default: that of motions that overturn]
    out = fragility: File to write, without an ending with .xml or, for pelicun, .csv
    fits: Folder of fits, from fit-pex and fit-pro [default: the universal surface as shipped]
    name: Which structure of the fits to use [default: the one with the same p, alpha and eta]
    suite: Kind of motion: recorded, csgm, pulse or hfc [default: the kind of the fits, else recorded]
    model = calibrated: calibrated (the surface, by the fits) or paper (its planes and hybrid curve)
    limit_state = 0.1: Limit state, as demand |theta|max / alpha
    structure: A structure; may be repeated: name=frame,p=1.0,alpha=0.15,eta=0.92 or
        name=cabinet,width=0.8,height=2.2
    structures: List with a name and these options as columns (m, cm or mm by the heading): CSV or a
        workbook (list.xlsx#SHEET), or the word paper for the paper's two
    columns: Column names for headings of lists, hazards and tables of motions
    ignore: Headings of columns of these files to leave out
    ground_floor: Number that the floors of a list give the ground floor: 0 or 1
    storeys: Storeys of the building, for rows of a list that do not say theirs
    building: Its kind: walls, masonry, concrete frame or steel frame
    width: Width of the base of a block, body or column, m; the smaller side unless depth is given
    height: Height of the block, body or column, m
    depth: Depth of the base, m: the object may also fall that way; simulate and ida take the weaker
        direction
    centre_height: Height of the centre of mass above the base, m [default: half the height]
    centre_offset: Distance of the centre of mass from the middle of the width, m [default: 0]
    inertia: Moment of inertia about the centre of mass, per unit mass, m2 [default: that of a solid
        block]
    beam_mass_ratio: Frame: mass of the beam over that of all columns
    p: Frequency parameter, rad/s
    alpha: Slenderness, rad, or in degrees as 8.5deg
    eta: Coefficient of restitution, or housner for 1 - 1.5 sin^2(alpha) [default: from the dimensions]
    period: First period of the building, s [default: the object stands on the ground]
    level: Height of the floor over that of the roof, 0 to 1
    friction: Coefficient of friction; if tan(alpha) exceeds it, the object slides
    base: Base or feet: concrete, stone, timber, steel, felt or rubber; sets eta by tests
    wall: Wall behind it, with its rebound if known: the velocity after an impact over that before
    mass: Mass of the object, beside that of its pedestal, kg
    fixed_to_pedestal: Whether it is fixed to its pedestal, as one body, or loose on it
    pedestal_width: Width of the pedestal, m
    pedestal_depth: Depth of the pedestal, m
    pedestal_height: Height of the pedestal, m
    pedestal_mass: Mass of the pedestal, kg
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("export", locals(), ['fits', 'structures'], "")


def validate(input: Any = None, /, *, out: Path | None = None, fits: Any | None = None, name: Any | None = None, suite: Literal['recorded', 'csgm', 'pulse', 'hfc'] | None = None, model: Literal['calibrated', 'paper'] | None = None, limit_state: float | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Test predictions on responses not used in the fit: counts, scores and reliability.

    input: Responses to test on
    out = temporary: Scores to write, with NAME.reliability.parquet beside
    fits: Folder of fits, from fit-pex and fit-pro [default: the universal surface as shipped]
    name: Which structure of the fits to use [default: the one with the same p, alpha and eta]
    suite: Kind of motion: recorded, csgm, pulse or hfc [default: the kind of the fits, else recorded]
    model = calibrated: calibrated (the surface, by the fits) or paper (its planes and hybrid curve)
    limit_state = 0.1: Limit state, as demand |theta|max / alpha
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("validate", locals(), ['in', 'fits'], "in")


def report(input: Any = None, /, *, out: Path | None = None, title: Any | None = None, project: Any | None = None, author: Any | None = None, date: Any | None = None, threads: int | None = None, force: bool = False, config: Path | None = None, progress: bool | Callable[[int, int], object] | None = None) -> Result:
    """Write a page with tables and figures of everything in a folder, or of files.

    input: Folder or files of other commands; evaluations of the same objects are before and after, or
        under different hazards alternatives
    out: Page to write; its figures go into a folder of its name [default: report.html in DIR or beside
        FILE]
    title: Title of the page [default: from what it shows]
    project: Project, below the title
    author: Author, below the title
    date: Date, below the title
    threads, force, config, progress: as of all stages; progress(done, total) is called as it runs
    """
    return call("report", locals(), ['in'], "in")


__all__ = ['sample_scenarios', 'synthesize_motions', 'import_motions', 'floor_motions', 'simulate', 'ida', 'fit_pex', 'fit_pro', 'compare_paper', 'evaluate', 'export', 'validate', 'report']
