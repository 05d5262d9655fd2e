"""Records, IDA and a measure of your own: which measure tells best when a block overturns? Run it where `records` is."""

import numpy as np

import rockfrag

motions = rockfrag.import_motions("records")
capacity = rockfrag.ida(motions, width=0.4, height=1.6).to_numpy()  # scales each record until it overturns the block
records = motions.to_numpy()
assert (records["motion_id"] == capacity["motion_id"]).all()


def velocity_in(seconds: float) -> np.ndarray:
    """The largest change of velocity in so many seconds, m/s: the new measure."""
    found = []
    for acceleration, dt in zip(records["acceleration_m_s2"], records["dt_s"]):
        velocity, window = np.cumsum(acceleration) * dt, round(seconds / dt)
        found.append(np.abs(velocity[window:] - velocity[:-window]).max())
    return np.array(found)


measures = {"PGA, m/s2": records["pga_m_s2"], "PGV, m/s": records["pgv_m_s"], "PGD, m": records["pgd_m"]}
measures |= {f"velocity in {seconds} s, m/s": velocity_in(seconds) for seconds in (0.25, 0.5, 1.0)}
print("measure                    median  dispersion of ln at which the block overturns")
for name, measure in measures.items():
    ln = np.log(measure * capacity["overturning_intensity"])
    print(f"{name:26} {np.exp(np.nanmedian(ln)):6.3g} {np.nanstd(ln, ddof=1):11.2f}")
