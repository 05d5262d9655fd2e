"""The ground-motion model by vectorised numpy: pulse, stochastic high frequencies, both combined (absolute).

    python synthesize_numpy.py SCENARIOS.parquet --out motions.parquet

Scenarios whose motions have the same number of samples are made together, some rows at a time so that they
stay in the processor's cache. What depends on magnitude and distance alone is computed once for each pair of
them, and equal windows once. Random numbers are numpy's own, so single motions differ from rockfrag's; their
distribution does not.
"""

import argparse
import functools
import math
import time

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import scipy.fft

from common import G, Stopwatch, print_report

MARGIN = 2.0  # s, quiet time before and after all that moves
PEAK_SHARE = 0.2  # of the window's duration, at which it peaks
END_VALUE = 0.05  # of the window
WINDOW_B = -PEAK_SHARE * np.log(END_VALUE) / (1.0 + PEAK_SHARE * (np.log(PEAK_SHARE) - 1.0))
DENSITY, SHEAR_VELOCITY = 2.8, 3.5  # g/cm3, km/s
CONSTANT = 0.55 * np.sqrt(0.5) * 2.0 * 1e-20 / (4.0 * np.pi * DENSITY * SHEAR_VELOCITY**3)
KAPPA = 0.030  # s
ROCK_HZ = (0.01, 0.09, 0.16, 0.51, 0.84, 1.25, 2.26, 3.17, 6.05, 16.6, 61.2)
ROCK = (1.00, 1.10, 1.18, 1.42, 1.58, 1.74, 2.06, 2.25, 2.58, 3.13, 4.00)
TM_BAND = (0.25, 20.0)  # Hz
TM_STEP = 0.05  # Hz, the widest
# Even lengths without prime factors above 5.
SMOOTH = np.unique([2 * 2**i * 3**j * 5**k for i in range(20) for j in range(13) for k in range(9)])

MEASURES = ("pga_m_s2", "pgv_m_s", "pgd_m", "tm_s", "arias_m_s", "cav_m_s", "d5_75_s", "d5_95_s")


def even_smooth_at_least(n):
    """The least even length of at least n without prime factors above 5."""
    return SMOOTH[np.searchsorted(SMOOTH, n)]


def corner_frequencies(mw):
    """fa and fb (Hz) and the weight of the second corner (Atkinson & Silva 2000)."""
    return 10 ** (2.181 - 0.496 * mw), 10 ** (2.410 - 0.408 * mw), 10 ** (0.605 - 0.255 * mw)


def effective_distance(mw, re):
    """R, km."""
    return np.hypot(re, 10 ** (-0.05 + 0.15 * mw))


def window_duration(mw, re):
    """te, s: twice the duration of source and path."""
    return 2.0 * (0.5 / corner_frequencies(mw)[0] + 0.05 * effective_distance(mw, re))


@functools.lru_cache
def window(onset, duration, dt):
    """The window of Saragoni & Hart, 1 at its peak: the first sample inside it, and its values from there."""
    first, last = int(onset / dt) + 1, int((onset + duration) / dt)
    x = (np.arange(first, last + 1) * dt - onset) / duration
    return first, (np.e / PEAK_SHARE) ** WINDOW_B * np.exp(WINDOW_B * (np.log(x) - x / PEAK_SHARE))


def fourier_amplitude(f, mw, re):
    """A(f) in m/s for each pair of magnitude and distance (rows)."""
    common = (2.0 * np.pi * f) ** 2 * np.exp(np.interp(f, ROCK_HZ, np.log(ROCK)) - np.pi * KAPPA * f)
    mw, re = mw[:, None], re[:, None]
    fa, fb, e = corner_frequencies(mw)
    distance = effective_distance(mw, re)
    spreading = np.where(distance <= 40.0, 1.0 / distance, np.sqrt(40.0 / distance) / 40.0)
    shape = (1.0 - e) / (1.0 + (f / fa) ** 2) + e / (1.0 + (f / fb) ** 2)
    path = np.exp(-np.pi * distance / (180.0 * SHEAR_VELOCITY) * f**0.55)
    return 0.01 * CONSTANT * 10 ** (1.5 * mw + 16.05) * spreading * shape * path * common


def unit_velocity(x, gamma, nu):
    """v / A of Eq. 1."""
    return 0.5 * (1.0 + np.cos(x / gamma)) * np.cos(x + nu)


def unit_acceleration(x, gamma, nu):
    """dv/dx / A."""
    return (
        -0.5
        / gamma
        * (np.sin(x / gamma) * np.cos(x + nu) + gamma * (1.0 + np.cos(x / gamma)) * np.sin(x + nu))
    )


def pulse_amplitude(vp, gamma, nu):
    """A = Vp / F(gamma, nu), F the largest |v| / A: the best of a grid, then bisection beside it."""
    half = np.pi * gamma
    grid = np.linspace(-1.0, 1.0, 129) * half[:, None]
    best = np.abs(unit_velocity(grid, gamma[:, None], nu[:, None])).argmax(axis=1)
    rows = np.arange(len(gamma))
    low, high = grid[rows, np.maximum(best - 1, 0)], grid[rows, np.minimum(best + 1, 128)]
    rising = unit_acceleration(low, gamma, nu) > 0.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        before = (unit_acceleration(middle, gamma, nu) > 0.0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return vp / np.abs(unit_velocity(low, gamma, nu))


def pulse_acceleration(x, amplitude, tp, gamma, nu):
    """m/s2 at x = wp (t - t0) within the pulse: derivative of Eq. 1, products of sines as sums."""
    faster, slower = 1.0 + 1.0 / gamma, 1.0 - 1.0 / gamma
    sidebands = faster * np.sin(faster * x + nu) + slower * np.sin(slower * x + nu)
    return -amplitude * np.pi / tp * (np.sin(x + nu) + 0.5 * sidebands)


class Synthesis:
    """Motions of one model, with numpy's random numbers, someone's Fourier transforms, and a stopwatch."""

    def __init__(self, dt, seed, fft, stopwatch):
        self.dt, self.fft, self.stopwatch = dt, fft, stopwatch
        self.random = np.random.default_rng(seed)

    def motions(self, batch, samples, f, amplitude, cells):
        """Accelerations (m/s2) of the scenarios of a batch (columns), and their Fourier coefficients.

        `amplitude` has a row for each cell, the Fourier amplitude; `cells` is the cell of each scenario.
        """
        with self.stopwatch("noise and window"):
            noise = np.zeros((len(cells), samples))
            for row, onset, duration in zip(noise, batch["onset"], batch["te"]):
                first, weights = window(onset, duration, self.dt)
                row[first : first + weights.size] = self.random.standard_normal(weights.size) * weights
        with self.stopwatch("pulse"):
            pulse = np.zeros_like(noise)
            for row, peak, a, tp, gamma, nu in zip(
                pulse, batch["epoch"], batch["amplitude"], batch["tp_s"], batch["gamma"], batch["nu_rad"]
            ):
                half = 0.5 * gamma * tp
                first, last = math.ceil((peak - half) / self.dt), int((peak + half) / self.dt)
                x = 2.0 * np.pi / tp * (np.arange(first, last + 1) * self.dt - peak)
                row[first : last + 1] = pulse_acceleration(x, a, tp, gamma, nu)
        with self.stopwatch("fft"):
            h, p = self.fft.rfft(noise), self.fft.rfft(pulse)
        with self.stopwatch("combination"):
            h_amplitude = np.abs(h)
            level = np.sqrt(np.mean(h_amplitude[:, 1:-1] ** 2, axis=1)) * self.dt
            target = amplitude[cells]
            target *= h_amplitude / level[:, None]
            # D' exp(i arg H) + P with D' = | |H| - |P| |: the noise gives H its phase.
            h_amplitude[:, 0] = np.inf
            h *= np.abs(target - np.abs(p)) / h_amplitude
            h += p
            h[:, 0] = 0.0
        with self.stopwatch("fft"):
            return self.fft.irfft(h, n=samples), h

    def measures(self, acceleration, spectrum):
        """The measures, a row each in the order of MEASURES."""
        dt, samples = self.dt, acceleration.shape[1]
        with self.stopwatch("measures"):
            size = np.abs(acceleration)
            velocity = running_integral(acceleration, dt)
            displacement = running_integral(velocity, dt)
            energy = running_integral(acceleration**2, dt)
            cav = dt * (size.sum(axis=1) - 0.5 * (size[:, 0] + size[:, -1]))
            peaks = [size.max(axis=1), np.abs(velocity).max(axis=1), np.abs(displacement).max(axis=1)]
            durations = significant_durations(energy, dt)
        padded = even_smooth_at_least(max(samples, np.ceil(1.0 / (TM_STEP * dt))))
        if padded > samples:
            with self.stopwatch("fft"):
                spectrum = self.fft.rfft(acceleration, n=padded)
        with self.stopwatch("measures"):
            f = np.arange(padded // 2 + 1) / (padded * dt)
            band = slice(f.searchsorted(TM_BAND[0], "left"), f.searchsorted(TM_BAND[1], "right"))
            power = np.abs(spectrum[:, band]) ** 2
            tm = power @ (1.0 / f[band]) / power.sum(axis=1)
            return [*peaks, tm, 0.5 * np.pi / G * energy[:, -1], cav, *durations]


def running_integral(series, dt):
    """The trapezoidal integral along the rows, 0 at the first sample."""
    integral = np.cumsum(series, axis=1)
    integral -= 0.5 * (series + series[:, :1])
    integral *= dt
    return integral


def significant_durations(energy, dt):
    """D5-75 and D5-95 of running integrals of a^2; within a time step the energy grows linearly."""
    moments = np.empty((len(energy), 3))
    for row, moment in zip(energy, moments):
        shares = row[-1] * np.array((0.05, 0.75, 0.95))
        after = row.searchsorted(shares)
        before = row[after - 1]
        moment[:] = dt * (after - 1 + (shares - before) / (row[after] - before))
    return moments[:, 1] - moments[:, 0], moments[:, 2] - moments[:, 0]


def timelines(scenarios, dt):
    """Adds to the scenarios when window and pulse come, and gives the number of samples of each motion."""
    scenarios["te"] = window_duration(scenarios["mw"], scenarios["re_km"])
    half_pulse = 0.5 * scenarios["gamma"] * scenarios["tp_s"]
    to_peak = PEAK_SHARE * scenarios["te"]
    scenarios["onset"] = MARGIN + np.maximum(half_pulse - to_peak, 0.0)
    scenarios["epoch"] = scenarios["onset"] + to_peak
    scenarios["amplitude"] = pulse_amplitude(scenarios["vp_m_s"], scenarios["gamma"], scenarios["nu_rad"])
    end = scenarios["onset"] + np.maximum(scenarios["te"], to_peak + half_pulse) + MARGIN
    return even_smooth_at_least(np.ceil(end / dt) + 1)


def synthesize(table, synthesis, batch_rows):
    """The motions (float32) and measures of all scenarios, in their order."""
    scenarios = {name: table[name].to_numpy() for name in table.column_names}
    with synthesis.stopwatch("scenarios"):
        lengths = timelines(scenarios, synthesis.dt)
    accelerations = [None] * len(lengths)
    measures = np.empty((len(MEASURES), len(lengths)))
    for samples in np.unique(lengths):
        rows = np.flatnonzero(lengths == samples)
        with synthesis.stopwatch("spectrum"):
            pairs = np.column_stack([scenarios["mw"][rows], scenarios["re_km"][rows]])
            pairs, cells = np.unique(pairs, axis=0, return_inverse=True)
            f = np.arange(samples // 2 + 1) / (samples * synthesis.dt)
            amplitude = fourier_amplitude(f, *pairs.T)
        for start in range(0, rows.size, batch_rows):
            chosen = rows[start : start + batch_rows]
            batch = {name: column[chosen] for name, column in scenarios.items()}
            made, spectrum = synthesis.motions(
                batch, samples, f, amplitude, cells[start : start + batch_rows]
            )
            measures[:, chosen] = synthesis.measures(made, spectrum)
            with synthesis.stopwatch("float32"):
                for row, acceleration in zip(chosen, made.astype(np.float32)):
                    accelerations[row] = acceleration
    return accelerations, measures, lengths


def write_motions(path, table, dt, accelerations, measures):
    """As rockfrag writes them: samples as float32, bytes split, zstd of level 1, 32 rows in a group."""
    offsets = np.concatenate([[0], np.cumsum([a.size for a in accelerations])]).astype(np.int32)
    samples = pa.ListArray.from_arrays(pa.array(offsets), pa.array(np.concatenate(accelerations)))
    columns = {name: table[name] for name in table.column_names}
    columns |= {"motion_id": pa.array(np.arange(len(samples))), "dt_s": pa.array(np.full(len(samples), dt))}
    columns |= dict(zip(MEASURES, measures))
    plain = list(columns)
    columns["acceleration_m_s2"] = samples
    pq.write_table(
        pa.table(columns),
        path,
        row_group_size=32,
        compression="zstd",
        compression_level=1,
        use_dictionary=plain,
        column_encoding={"acceleration_m_s2.list.element": "BYTE_STREAM_SPLIT"},
        write_statistics=plain,
    )


def time_transforms(lengths, dt, batch_rows, stopwatch):
    """The Fourier transforms alone, on random numbers: each kind that a motion needs, once a motion."""
    random = np.random.default_rng(0)
    for samples, count in zip(*np.unique(lengths, return_counts=True)):
        padded = even_smooth_at_least(max(samples, np.ceil(1.0 / (TM_STEP * dt))))
        for start in range(0, count, batch_rows):
            series = random.standard_normal((min(batch_rows, count - start), samples))
            for name, fft in (("numpy", np.fft), ("scipy", scipy.fft)):
                with stopwatch(f"{name} forward"):
                    spectrum = fft.rfft(series)
                with stopwatch(f"{name} inverse"):
                    fft.irfft(spectrum, n=samples)
                with stopwatch(f"{name} mean period, all motions"):
                    fft.rfft(series, n=padded)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenarios", help="Parquet file of scenarios")
    parser.add_argument("--out", help="motions to write")
    parser.add_argument("--dt", type=float, default=0.005)
    parser.add_argument("--seed", type=int, default=42)
    parser.add_argument("--fft", choices=("numpy", "scipy"), default="scipy", help="whose Fourier transform")
    parser.add_argument("--batch", type=int, default=16, help="motions made at once")
    parser.add_argument("--repeat", type=int, default=5, help="runs, of which the median counts")
    options = parser.parse_args()
    table = pq.read_table(options.scenarios)

    fft = {"numpy": np.fft, "scipy": scipy.fft}[options.fft]
    runs = []
    for _ in range(options.repeat):
        wall, cpu, parts, transforms = Stopwatch(time.perf_counter), Stopwatch(), Stopwatch(), Stopwatch()
        with wall("computation"), cpu("computation"):
            synthesis = Synthesis(options.dt, options.seed, fft, parts)
            accelerations, measures, lengths = synthesize(table, synthesis, options.batch)
        if options.out:
            with wall("writing"), cpu("writing"):
                write_motions(options.out, table, options.dt, accelerations, measures)
        time_transforms(lengths, options.dt, options.batch, transforms)
        runs.append([watch.seconds for watch in (wall, cpu, parts, transforms)])
    medians = [{part: np.median([run[part] for run in kind]) for part in kind[0]} for kind in zip(*runs)]
    print_report(
        motions=len(lengths),
        samples_a_motion=lengths.mean(),
        fft=options.fft,
        **dict(
            zip(("seconds", "cpu_seconds", "cpu_seconds_by_part", "cpu_seconds_of_transforms_alone"), medians)
        ),
        padded_for_mean_period=int((lengths * options.dt < 1.0 / TM_STEP).sum()),
    )


if __name__ == "__main__":
    main()
