"""One structure in one motion."""

import numpy as np
import polars as pl
import pytest
import rockfrag

STRUCTURE = {"p": 2.5, "alpha": 0.2, "eta": 0.92}
G = 9.80665


def sine(amplitude, frequency=5.0, dt=0.005):
    time = np.arange(0.0, 2 * np.pi / frequency, dt)
    return np.append(amplitude * np.sin(frequency * time), 0.0), dt


def test_no_rocking_below_the_acceleration_that_lifts():
    lifts = G * np.tan(STRUCTURE["alpha"])
    below = rockfrag.response(*sine(0.999 * lifts), STRUCTURE)
    assert (below.outcome, below.edp, np.abs(below.theta_rad).max()) == ("no_rocking", 0.0, 0.0)
    above = rockfrag.response(*sine(1.01 * lifts), STRUCTURE)
    assert above.outcome == "safe_rocking" and above.events[0][1] == "uplift"


def test_velocity_is_the_slope_of_the_rotation_and_falls_by_eta_at_an_impact():
    response = rockfrag.response(*sine(3.0, frequency=10.0), STRUCTURE)
    assert response.impacts >= 1
    time, theta, rate = response.time_s, response.theta_rad, response.theta_dot_rad_s
    steps = np.diff(time) > 1e-6
    slope = np.diff(theta)[steps] / np.diff(time)[steps]
    # Between two samples without an impact the slope lies between the velocities at both.
    between = (slope - rate[:-1][steps]) * (slope - rate[1:][steps]) <= 1e-6
    assert between.mean() > 0.95
    impact = next(at for at, event in response.events if event == "impact")
    at = int(np.flatnonzero(time == impact)[0])
    gravity = (rate[at - 1] - rate[at - 2]) / (time[at - 1] - time[at - 2])
    before = rate[at - 1] + gravity * (time[at] - time[at - 1])
    assert np.isclose(rate[at] / before, STRUCTURE["eta"], rtol=0.01)


def test_the_peak_is_that_of_simulate(out):
    acceleration, dt = sine(3.5, frequency=10.0)
    motions = pl.DataFrame({"motion_id": [1], "dt_s": [dt], "acceleration_m_s2": [acceleration.tolist()]})
    responses = rockfrag.simulate(motions, **STRUCTURE, trace=[1])
    response = rockfrag.response(acceleration, dt, STRUCTURE)
    row = responses.to_polars().row(0, named=True)
    assert (row["edp"], row["outcome"], row["impacts"]) == (response.edp, response.outcome, response.impacts)
    trace = responses.parts["trace"].to_polars()
    assert trace["theta_rad"].to_list() == response.theta_rad.tolist()
    assert np.isclose(np.abs(response.theta_over_alpha).max(), response.edp, rtol=1e-3)


def test_responses_are_equal_by_their_values_and_show_what_they_are():
    one, same, other = (rockfrag.response(*sine(amplitude), STRUCTURE) for amplitude in (2.2, 2.2, 2.3))
    assert one == same and one != other and one != 3
    assert repr(one).startswith("<rockfrag.Response: safe_rocking, edp") and len(repr(one)) < 120
    assert "safe_rocking" in one._repr_html_()


def test_structures_are_objects(out):
    block = rockfrag.Structure.block(0.5, 2.0, name="block")
    assert eval(repr(block), {"Structure": rockfrag.Structure}) == block and len({block, block}) == 1
    for structure in [block, rockfrag.Structure.frame(1.5, 9.0, 4.0), rockfrag.Structure(2.5, 0.2, "housner", name="h")]:
        row = rockfrag.simulate(out / "motions.parquet", structures=structure)
        assert set(row["structure"]) == {structure.name}
        assert (row["p_rad_s"][0], row["alpha_rad"][0], row["eta"][0]) == (structure.p, structure.alpha, structure.eta)
    assert rockfrag.simulate(out / "motions.parquet", structures=[block, STRUCTURE | {"name": "other"}])["structure"].size == 160
    assert rockfrag.simulate(out / "motions.parquet", width=0.5, height=2.0)["edp"].tolist() == pytest.approx(
        rockfrag.simulate(out / "motions.parquet", structures=block)["edp"].tolist(), rel=0, abs=0, nan_ok=True
    )
    assert rockfrag.response(*sine(5.0), block) == rockfrag.response(*sine(5.0), {"width": 0.5, "height": 2.0})
    with pytest.raises(TypeError):
        rockfrag.Structure()
    with pytest.raises(rockfrag.OptionError, match="alpha"):
        rockfrag.Structure(2.5, 20.0, 0.92)


def test_a_block_by_its_dimensions():
    block = rockfrag.response(*sine(5.0), {"width": 0.5, "height": 2.0})
    assert np.isclose(block.alpha_rad, np.arctan(0.25))
    assert np.isclose(block.p_rad_s, np.sqrt(3 * G / (4 * np.hypot(0.25, 1.0))), rtol=1e-3)
