"""Holds answers of rocking.py against scipy's DOP853 (rtol 1e-12) on some of the motions. Needs numpy, scipy, pyarrow.

    python scripts/reference/check_rocking.py MOTIONS.parquet ANSWERS.csv [MOTION_ID ...]

Without ids: about six motions, spread over the safe-rocking and overturning ones. Integrates theta itself in seconds,
knot interval by knot interval, and the free motion after the record too; prints both and the relative difference.
"""

import csv
import sys

import numpy as np
import pyarrow.parquet as pq
from scipy.integrate import solve_ivp

G = 9.81


def respond(dt, ground, p, alpha, eta):
    """Outcome, |theta|max/alpha and the number of impacts."""
    threshold = G * np.tan(alpha)
    theta, omega, peak, impacts = 0.0, 0.0, 0.0, 0
    side = 0  # of the rotation; 0 at rest
    rocked = False
    duration = (len(ground) - 1) * dt
    knots = [(i * dt, (i + 1) * dt, ground[i], ground[i + 1]) for i in range(len(ground) - 1)]
    knots += [(duration + i * 0.1, duration + (i + 1) * 0.1, 0.0, 0.0) for i in range(600)]
    for start, end, first, last in knots:
        slope = (last - first) / (end - start)
        now = start

        def acceleration(t):
            return first + slope * (t - start)

        def derivative(t, state, sign):
            angle = alpha * sign - state[0]
            return state[1], -p * p * (np.sin(angle) + acceleration(t) / G * np.cos(angle))

        def base(t, state, sign):
            return sign * state[0]

        def top(t, state, sign):
            return abs(state[0]) - np.pi / 2

        def turn(t, state, sign):
            return state[1]

        base.terminal = top.terminal = True
        base.direction = -1
        while now < end:
            if side == 0:
                pushed = acceleration(now)
                if abs(pushed) < threshold:
                    if abs(last) <= threshold:
                        break
                    pushed = np.copysign(threshold, last)
                    now = start + (pushed - first) / slope
                    if now >= end:
                        break
                side, rocked = -np.sign(pushed), True
                theta = omega = 0.0
            # From the base the first half of the shortest possible flight goes without a look for the next impact.
            stop = end
            watched = [base, top, turn]
            if theta == 0.0:
                back = -side * derivative(now, (0.0, 0.0), side)[1]
                flight = abs(2 * omega / back) if back > 0 else np.inf
                jerk = abs(p * p * slope / G)
                if omega == 0.0:
                    flight = min(1e-3 * (end - now), 1e-5)
                elif jerk > 0:
                    flight = min(flight, np.sqrt(abs(omega) / jerk))
                stop = min(end, now + max(flight / 2, 1e-14))
                watched = [turn]
            done = solve_ivp(derivative, (now, stop), (theta, omega), "DOP853", args=(side,), events=watched,
                             rtol=1e-12, atol=1e-17, first_step=(stop - now) / 4)
            now = done.t[-1] if len(watched) > 1 else stop
            theta, omega = done.y[:, -1]
            peak = max(peak, abs(done.y[0]).max(), *(abs(state[0]) for state in done.y_events[-1]))
            if len(watched) == 1 and side * theta <= 0:  # an uplift that fell back at once
                theta, omega, side = 0.0, 0.0, 0
            elif done.status == 1 and len(done.t_events[1]):
                return "overturning", np.pi / 2 / alpha, impacts
            elif done.status == 1:
                impacts += now <= duration
                side, theta, omega = -side, 0.0, eta * omega
                if abs(omega) < 1e-6 * p:
                    side, omega = 0, 0.0
        if start >= duration and side == 0:
            break
    return "safe_rocking" if rocked else "no_rocking", peak / alpha, impacts


motions_file, answers_file, *chosen = sys.argv[1:]
with open(answers_file) as file:
    answers = [row for row in csv.DictReader(file)]
if not chosen:
    safe = sorted((row for row in answers if row["outcome"] == "safe_rocking"), key=lambda row: float(row["edp"]))
    over = [row for row in answers if row["outcome"] == "overturning"]
    spread = [safe[round(part * (len(safe) - 1))] for part in (0.1, 0.3, 0.5, 0.7, 0.9)] + over[:1]
    chosen = list(dict.fromkeys(row["motion_id"] for row in spread))
motions = {str(row["motion_id"]): row for row in pq.read_table(motions_file).to_pylist()}
print("motion_id p alpha | outcome edp impacts: reference | DOP853 | relative difference | condition")
for row in answers:
    if row["motion_id"] not in chosen:
        continue
    motion = motions[row["motion_id"]]
    p, alpha, eta = (float(row[name]) for name in ("p_rad_s", "alpha_rad", "eta"))
    outcome, edp, impacts = respond(motion["dt_s"], motion["acceleration_m_s2"], p, alpha, eta)
    exact = float(row["edp"])
    difference = abs(edp / exact - 1) if exact else edp
    print(row["motion_id"], p, alpha, "|", row["outcome"], row["edp"], row["impacts"], "|", outcome, f"{edp:.16e}", impacts,
          f"| {difference:.1e} |", row["condition"], flush=True)
