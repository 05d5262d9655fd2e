"""Measures and pulses of motions by other programs: python records.py core/tests/reference

Reads rocking/motions.parquet and writes records/measures.csv (eqsig, numpy) and records/pulses.csv (the
indicator of Baker 2007 with PyWavelets' db4 at full resolution; the fit of Eq. 1 by differential evolution).
Needs numpy, scipy, pandas, pyarrow, eqsig and PyWavelets.
"""

import pathlib
import sys

import eqsig
import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pywt
from scipy.optimize import differential_evolution

folder = pathlib.Path(sys.argv[1])
rows = pq.read_table(folder / "rocking/motions.parquet").to_pylist()
motions = [(row["motion_id"], row["dt_s"], np.array(row["acceleration_m_s2"], dtype=float)) for row in rows[:24]]
PERIODS = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0]


def mean_period(acceleration, dt):
    n = max(len(acceleration), int(np.ceil(1 / (0.05 * dt))))
    f = np.fft.rfftfreq(n, dt)
    power = abs(np.fft.rfft(acceleration, n)) ** 2
    band = (f >= 0.25) & (f <= 20)
    return (power[band] / f[band]).sum() / power[band].sum()


def measures(acceleration, dt):
    signal = eqsig.AccSignal(acceleration, dt)
    yield "pga_m_s2", abs(acceleration).max()
    yield "pgv_m_s", abs(signal.velocity).max()
    yield "pgd_m", abs(signal.displacement).max()
    yield "tm_s", mean_period(acceleration, dt)
    # eqsig has the trapezoids of a^2; between samples the motion is a line, whose square has this integral.
    left, right = acceleration[:-1], acceleration[1:]
    yield "arias_m_s", np.pi / (2 * 9.81) * dt / 3 * (left**2 + left * right + right**2).sum()
    yield "cav_m_s", eqsig.im.calc_cav(signal)[-1]
    # Its durations too, at 64 parts of a step.
    fine = np.interp(np.arange(64 * (len(acceleration) - 1) + 1) / 64, np.arange(len(acceleration)), acceleration)
    energy = np.append(0, np.cumsum(fine[:-1] ** 2 + fine[:-1] * fine[1:] + fine[1:] ** 2))
    moments = np.interp(np.array([0.05, 0.75, 0.95]) * energy[-1], energy, np.arange(len(fine)) * dt / 64)
    yield "d5_75_s", moments[1] - moments[0]
    yield "d5_95_s", moments[2] - moments[0]
    housner, spectra = np.linspace(0.1, 2.5, 49), eqsig.sdof.pseudo_response_spectra
    yield "housner_m", np.trapezoid(spectra(acceleration, dt, housner, 0.05)[1], housner)
    spectrum = spectra(acceleration, dt, PERIODS, 0.05)[2]
    yield from ((f"sa_{period}", sa) for period, sa in zip(PERIODS, spectrum))


_, psi, x = pywt.Wavelet("db4").wavefun(level=10)


def wavelet(period, dt):
    """Samples of the wavelet of this period about its middle, of unit energy."""
    scale = period * 5 / 7
    reach = int(np.floor(3.5 * scale / dt))
    return np.interp(np.arange(-reach, reach + 1) * dt / scale + 3.5, x, psi) / np.sqrt(scale)


def coefficients(series, dt, kernel):
    return dt * np.correlate(np.pad(series, len(kernel) // 2), kernel, "valid")


def indicator(velocity, dt):
    periods = np.geomspace(0.25, 15, 400)
    transforms = [abs(coefficients(velocity, dt, wavelet(period, dt))) for period in periods]
    best = max(range(len(periods)), key=lambda k: transforms[k].max())
    period, centre = periods[best], int(transforms[best].argmax())
    residual, kernel, near = velocity.copy(), wavelet(period, dt), int(np.ceil(0.4 * period * 5 / 7 / dt))
    first, reach = max(0, centre - near), len(kernel) // 2
    for _ in range(10):
        strength = coefficients(residual, dt, kernel)
        at = first + int(abs(strength[first : centre + near + 1]).argmax())
        padded = np.pad(residual, reach)
        padded[at : at + len(kernel)] -= strength[at] * kernel
        residual = padded[reach : len(padded) - reach]
    ratio = abs(residual).max() / abs(velocity).max()
    energy = (residual**2).sum() / (velocity**2).sum()
    return 1 / (1 + np.exp(-23.3 + 14.6 * ratio + 20.5 * energy)), period, centre * dt


def unexplained(parameters, velocity, t):
    """Share of the squared velocity that the best pulse of this period, gamma and time leaves."""
    period, gamma, middle = parameters
    phase = 2 * np.pi / period * (t - middle)
    envelope = 0.5 * (1 + np.cos(phase / gamma)) * (abs(phase) <= np.pi * gamma)
    basis = np.column_stack([envelope * np.cos(phase), -envelope * np.sin(phase)])
    fit, *_ = np.linalg.lstsq(basis, velocity, rcond=None)
    return ((velocity - basis @ fit) ** 2).sum() / (velocity**2).sum()


def pulse(acceleration, dt):
    velocity = eqsig.AccSignal(acceleration, dt).velocity
    value, period, centre = indicator(velocity, dt)
    bounds = [(0.25, 15), (1, 5), (centre - period, centre + period)]
    of_velocity = (velocity, np.arange(len(velocity)) * dt)
    fit = differential_evolution(unexplained, bounds, args=of_velocity, seed=1, tol=1e-8, maxiter=400)
    return f"{value:.6f}", f"{period:.5f}", f"{1 - fit.fun:.6f}", *(f"{p:.6f}" for p in fit.x)


found = [(name, measure, f"{value:.9g}") for name, dt, a in motions for measure, value in measures(a, dt)]
columns = ["motion_id", "measure", "value"]
pd.DataFrame(found, columns=columns).to_csv(folder / "records/measures.csv", index=False)
pulses = [(name, *pulse(a, dt)) for name, dt, a in motions]
columns = "motion_id indicator period_s r2 tp_s gamma t0_s".split()
pd.DataFrame(pulses, columns=columns).to_csv(folder / "records/pulses.csv", index=False)
