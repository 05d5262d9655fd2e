"""Hazards at sites of ten worlds, as sites.py makes them: python worlds.py FOLDER

Most are unlike those that the routes were judged on. Writes FOLDER/sites.npz for site_rates.py.
"""

import pathlib
import sys

import numpy as np
from scipy.interpolate import RegularGridInterpolator

import sites as S

STEP, LENGTH = 0.01, 2**14
FREQUENCIES = np.fft.rfftfreq(LENGTH, STEP)
random = np.random.default_rng(67)


def stochastic(mw, km):
    """Fourier spectra of motions of a point source of 10 MPa, of any amplitude."""
    corner = 4.9e6 * 3.5 * (100 / 10 ** (1.5 * mw + 16.05)) ** (1 / 3)
    f = FREQUENCIES[1:]
    path = np.exp(-np.pi * f * km / (180 * f**0.45 * 3.5) - np.pi * 0.03 * f)
    t = STEP * np.arange(LENGTH)
    duration = 1 / corner + 0.05 * km
    window = (t / duration) * np.exp(1 - t / (0.3 * duration)) * (t < 3 * duration)
    for _ in range(8):
        spectrum = np.fft.rfft(window * random.normal(size=LENGTH))
        spectrum[0] = 0
        spectrum[1:] *= f**2 / (1 + (f / corner) ** 2) * path
        yield spectrum


def peaks(spectrum):
    """ln of PGA, PGV and SA(1.0 s)."""
    w = 2 * np.pi * FREQUENCIES
    velocity = np.divide(spectrum, 1j * w, where=w > 0, out=np.zeros_like(spectrum))
    of_1_s = (2 * np.pi) ** 2 + 2j * 0.05 * 2 * np.pi * w
    spectra = spectrum, velocity, spectrum * of_1_s / (of_1_s - w**2)
    return np.log([np.abs(np.fft.irfft(x)).max() for x in spectra])


def clay(period):
    """Means of ln IM, by that of PGV, on a layer of this period, 3 % damped, with an impedance of .06."""
    x = 0.5 * np.pi * FREQUENCIES * period * (1 - 0.03j)
    amplification = 1 / (np.cos(x) + 0.06j * np.sin(x))
    magnitudes, distances = np.arange(5.0, 8.6, 0.5), [8.0, 20.0, 50.0, 120.0, 320.0]
    gain = lambda spectrum: peaks(spectrum * amplification) - peaks(spectrum)[1]
    gains = [[np.mean([*map(gain, stochastic(mw, km))], axis=0) for km in distances] for mw in magnitudes]
    table = RegularGridInterpolator((magnitudes, np.log(distances)), np.array(gains))
    return lambda mean, mw, km: mean[1] + table((np.clip(mw, 5, 8.5), np.log(np.clip(km, 8, 320)))).T


def pulses(mean, mw, km):
    """With what forward directivity adds near a rupture."""
    return mean + np.outer([0, 0.35, 0.2], (mw >= 6.5) & (km < 12))


CRUST = ["ChiouYoungs2014", "CauzziEtAl2014", "CampbellBozorgnia2014"]
STABLE = ["AtkinsonBoore2006", "ShahjoueiPezeshk2016", "SomervilleEtAl2009YilgarnCraton", "RietbrockEdwards2019Mean"]
INTERFACE, SLAB = (["KuehnEtAl2020" + kind, "ParkerEtAl2020" + kind] for kind in ("SInter", "SSlab"))
area, fault = S.area, S.fault
FAR = [fault(1 / 40, 7.4, 110, sd=0.3), fault(1 / 100, 8.0, 130)]
NEAR = [area(0.1, 5.0, 6.9, 1.0, 90), fault(1 / 400, 6.9, 12, small=15)]
GREAT = [fault(1 / 300, 8.8, 25, small=0.3), fault(1 / 60, 7.8, 40, small=5)]
# Sources, models, Vs30 of each, depth of the upper edge, km, and what changes ln IM.
WORLDS = {
    "crust": (NEAR, CRUST, (300, 450, 760), None, None),
    "stable continent, hard rock": ([area(0.02, 5.0, 7.2, 0.9, 200)], STABLE, (2000,) * 4, None, None),
    "subduction interface": (GREAT, INTERFACE * 2, (300, 300, 600, 600), 25, None),
    "slab": ([area(0.15, 5.0, 7.8, 0.9, 120)], SLAB * 2, (300, 300, 600, 600), 70, None),
    "pulses": ([fault(1 / 300, 7.0, 4, small=15)], CRUST, (300, 450, 760), None, pulses),
    "soft soil": ([NEAR[0], fault(1 / 200, 7.3, 30, small=10)], CRUST, (180,) * 3, None, None),
    "lake bed, 1.2 s": (FAR, INTERFACE, (600, 600), 20, clay(1.2)),
    "lake bed, 2 s": (FAR, INTERFACE, (600, 600), 20, clay(2.0)),
    "lake bed, 2 s, near sources": (NEAR, CRUST[:2], (600, 600), None, clay(2.0)),
    "lake bed, 3 s": (FAR, INTERFACE, (600, 600), 20, clay(3.0)),
}


def of_worlds():
    for world, (sources, models, vs30s, top, changed) in WORLDS.items():
        ruptures = np.concatenate(sources)
        mw, rjb, _ = ruptures.T
        for model, vs30 in zip(models, vs30s):
            mean, sd = S.motions(model, float(vs30), ruptures, top)
            mean = changed(mean, mw, np.hypot(rjb, top or 8)) if changed else mean
            yield ("world", world, model, str(float(vs30))), ruptures, mean, sd, 0.73


S.save(pathlib.Path(sys.argv[1]), of_worlds())
