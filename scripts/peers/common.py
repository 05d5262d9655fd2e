"""What the peers share: reading motions, and the closed forms of the rocking problem.

A peer is a Python program that does the work of a stage as a careful Python programmer would write it for speed. Each
prints one JSON object with its figures. The structure is the paper's electrical equipment.
"""

import collections
import json
import math
import sys
import time

import numpy as np
import pyarrow.parquet as pq

G = 9.81  # m/s2
P, ALPHA, ETA = 2.5, 0.20, 0.92  # rad/s, rad
REST_VELOCITY = 1e-6  # after an impact, a velocity below this share of p counts as none
HALF_PI = 0.5 * math.pi


def read_motions(path, count=None):
    """Time step and acceleration over g of all motions, or of `count` evenly spaced ones."""
    table = pq.read_table(path, columns=["dt_s", "acceleration_m_s2"])
    if count:
        table = table.take(np.linspace(0, table.num_rows - 1, count).round().astype(int))
    samples = (list_.values.to_numpy(zero_copy_only=False).astype(float) / G for list_ in table["acceleration_m_s2"])
    return list(zip(table["dt_s"].to_pylist(), samples))


def free_rocking(rotation, velocity, alpha, eta):
    """Whether a structure that leaves the record in this state overturns, and its largest rotation to come.

    The velocity is per unit of p t. Between impacts v^2/2 + cos(alpha - r) is constant; an impact leaves
    eta^2 of the kinetic energy.
    """
    energy = 0.5 * velocity**2 + 2.0 * math.sin(alpha - 0.5 * rotation) * math.sin(0.5 * rotation)
    barrier = 2.0 * math.sin(0.5 * alpha) ** 2
    if rotation > alpha and (velocity >= 0.0 or energy <= barrier):
        return True, HALF_PI
    if velocity < 0.0:
        energy *= eta**2
    if energy > barrier:
        return True, HALF_PI
    # cos(alpha - r) = cos(alpha) + energy, without cancellation for small r.
    a = math.sin(0.5 * alpha)
    b = math.sqrt(max(a * a - 0.5 * energy, 0.0))
    sine = 0.5 * energy / (a * math.sqrt(1.0 - b * b) + b * math.sqrt(1.0 - a * a))
    return False, 2.0 * math.asin(min(sine, 1.0))


def peak_between(r0, v0, r1, v1, h):
    """The largest rotation over a step of length h, of the states at its ends (cubic Hermite)."""
    largest = max(r0, r1)
    if v0 > 0.0 > v1:
        # The root of the derivative v0 h + 2 c s + 3 d s^2 in s, 0 to 1, without cancellation.
        c = 3.0 * (r1 - r0) - (2.0 * v0 + v1) * h
        d = 2.0 * (r0 - r1) + (v0 + v1) * h
        s = v0 * h / (math.sqrt(max(c * c - 3.0 * d * v0 * h, 0.0)) - c)
        largest = max(largest, r0 + s * (v0 * h + s * (c + s * d)))
    return largest


def report(respond, motions):
    """Times `respond(dt, ground)`, an outcome and the demand |theta|max / alpha, over all motions."""
    start = time.process_time()
    outcomes = collections.Counter(respond(dt, ground)[0] for dt, ground in motions)
    seconds = time.process_time() - start
    json.dump({"ms_a_motion": 1e3 * seconds / len(motions), **outcomes}, sys.stdout)
