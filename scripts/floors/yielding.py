"""Floors of ten storeys that yield: equal masses and stiffnesses, 5 % damping of the first and third mode by
Rayleigh, storeys of 3 % hardening whose strengths are those of the first mode for a base shear of
.25 min(1, .6 s/T1) of the weight. Needs numba."""

import numpy as np
from numba import njit

N, HARDENING, BASE_SHEAR, KNEE_S = 10, 0.03, 0.25, 0.6


def building(period, damping):
    chain = 2 * np.eye(N) - np.eye(N, k=1) - np.eye(N, k=-1)
    chain[-1, -1] = 1
    values, vectors = np.linalg.eigh(chain)
    k = (2 * np.pi / period) ** 2 / values[0]
    w = np.sqrt(k * values)
    beta = 2 * damping / (w[0] + w[2])
    shape = abs(vectors[:, 0])
    shear = np.cumsum(shape[::-1])[::-1] / shape.sum()
    strength = BASE_SHEAR * min(1.0, KNEE_S / period) * 9.81 * N * shear
    return k, beta * w[0] * w[2], beta, strength


@njit(cache=True)
def respond(a, dt, k, mass_damping, stiffness_damping, strength):
    steps = max(1, int(np.ceil(dt * np.sqrt(4 * k) * (1 + 2 * stiffness_damping * np.sqrt(k)) / 0.5)))
    h = dt / steps
    u, v, slip, force = np.zeros(N), np.zeros(N), np.zeros(N), np.zeros(N)
    out = np.zeros((N, len(a)))
    for n in range(len(a) - 1):
        for s in range(steps):
            ground = a[n] + (a[n + 1] - a[n]) * s / steps
            for i in range(N):
                drift = u[i] - (u[i - 1] if i else 0.0)
                rate = v[i] - (v[i - 1] if i else 0.0)
                plastic = (1 - HARDENING) * k * (drift - slip[i])
                limit = (1 - HARDENING) * strength[i]
                if abs(plastic) > limit:
                    plastic = limit if plastic > 0 else -limit
                    slip[i] = drift - plastic / ((1 - HARDENING) * k)
                force[i] = plastic + HARDENING * k * drift + stiffness_damping * k * rate
            for i in range(N):
                v[i] += h * (-force[i] + (force[i + 1] if i + 1 < N else 0.0) - mass_damping * v[i] - ground)
            for i in range(N):
                u[i] += h * v[i]
        for i in range(N):
            # Of the mass, without the ground that its damping is relative to.
            out[i, n + 1] = -force[i] + (force[i + 1] if i + 1 < N else 0.0) - mass_damping * v[i]
    return out


def floors(acceleration, dt, period, levels, damping=0.05):
    floors = respond(acceleration, dt, *building(period, damping))
    at = [max(0, round(level * N) - 1) for level in levels]
    return floors[at]
