"""Arrays: one motion, the curve of given outcomes, probabilities."""

import numpy as np
import polars
import pytest
import statsmodels.api
from conftest import BLOCK, FRAME

import rockfrag


def test_one_motion_is_the_row_and_trace_of_the_stage(motions):
    trace = rockfrag.simulate(motions, structure=FRAME, trace=["1"])
    motion = motions.to_polars().row(by_predicate=polars.col("motion_id") == "1", named=True)
    parameters = {name: value for name, value in FRAME.items() if name != "name"}
    solved = rockfrag.simulate_motion(motion["acceleration_m_s2"], motion["dt_s"], **parameters)
    row = trace.to_polars().row(by_predicate=polars.col("motion_id") == "1", named=True)
    assert (solved.outcome, solved.demand, solved.impacts) == (row["outcome"], row["edp"], row["impacts"])
    traced = trace.part("trace").to_polars()
    for name, array in [
        ("time_s", solved.time),
        ("theta_rad", solved.theta),
        ("theta_dot_rad_s", solved.theta_dot),
    ]:
        assert np.array_equal(array, traced[name])
    assert np.allclose(solved.theta_over_alpha, traced["theta_over_alpha"])
    assert [event for _, event in solved.events] == traced["solver_event"].drop_nulls().to_list()


def test_a_block_is_known_by_its_dimensions():
    still = rockfrag.simulate_motion(np.full(100, 0.1), 0.01, **BLOCK)
    assert (still.outcome, still.demand, still.impacts) == ("no_rocking", 0.0, 0)
    assert still.p == pytest.approx(np.sqrt(0.75 * 9.81 / np.hypot(0.25, 1.0)))
    assert rockfrag.simulate_motion(np.full(100, 9.0), 0.01, **BLOCK).demand is None


@pytest.mark.parametrize(
    ("call", "given", "structure", "message"),
    [
        (rockfrag.simulate_motion, ([0.1, np.nan], 0.01), BLOCK, "sample 1 of the acceleration is NaN"),
        (rockfrag.simulate_motion, ([[0.1, 0.2]], 0.01), BLOCK, "2 dimensions"),
        (rockfrag.simulate_motion, ([0.1, 0.2], 0.01), {"width": 50, "height": 2}, "width is 50; .* the height"),
        (rockfrag.simulate_motion, ([0.1, 0.2], 0.01), {"widht": 0.5}, "'widht' .*did you mean 'width'"),
        (rockfrag.simulate_motion, ([0.1, 0.2], 0.01), {**BLOCK, "level": 0.5, "period": 0.6}, "level, period"),
        (rockfrag.simulate_motion, ([0.1, 0.2], 0.01), {}, "expected p, alpha and eta, or width and height"),
        (rockfrag.fit_fragility, ([1.0, 0.0], [0, 1]), {}, r"im\[1\] is 0; expected a finite number above 0"),
        (rockfrag.fit_fragility, ([1.0, 2.0], [0, 2]), {}, "outcome has other values"),
        (rockfrag.fit_fragility, (np.ones((20, 10)), np.ones((10, 20))), {}, r"\(20, 10\) and outcome \(10, 20\)"),
    ],
)
def test_wrong_arrays_and_structures_are_told(call, given, structure, message):
    with pytest.raises(ValueError, match=message):
        call(*given, **structure)


def test_a_curve_is_the_probit_of_statsmodels():
    draw = np.random.default_rng(5)
    im = draw.lognormal(0.0, 0.8, 300)
    truth = rockfrag.FragilityCurve("ok", 0, 0, coefficients=(-0.4, 1.7))
    happened = draw.random(300) < truth.probability(im)
    curve = rockfrag.fit_fragility(im, happened)
    probit = statsmodels.api.Probit(happened, statsmodels.api.add_constant(np.log(im)))
    other = probit.fit(disp=False, tol=1e-12)
    b, covariance = other.params, other.cov_params()
    assert curve.status == "ok"
    assert (curve.n, curve.n_events) == (300, happened.sum())
    assert np.allclose(curve.coefficients, b, rtol=1e-6)
    of_mu, of_beta = np.array([-1 / b[1], b[0] / b[1] ** 2]), np.array([0, -1 / b[1] ** 2])
    error_of_mu, error_of_beta = (np.sqrt(gradient @ covariance @ gradient) for gradient in (of_mu, of_beta))
    errors = 1.959964 * np.array([-1, 0, 1])
    theta, beta = np.exp(-b[0] / b[1] + errors * error_of_mu), np.exp(errors * error_of_beta * b[1]) / b[1]
    assert np.allclose([curve.theta_low, curve.theta, curve.theta_high], theta, rtol=1e-5)
    assert np.allclose([curve.beta_low, curve.beta, curve.beta_high], beta, rtol=1e-5)
    at = np.array([[0.3, 1.0], [2.0, 5.0]])
    design = np.column_stack([np.ones(4), np.log(at).ravel()])
    assert np.allclose(curve.probability(at).ravel(), other.predict(design), atol=1e-8)
    assert (np.diff([curve.limits(at)[0], curve.probability(at), curve.limits(at)[1]], axis=0) > 0).all()


@pytest.mark.parametrize(
    ("im", "outcome", "status"),
    [
        (np.linspace(1, 2, 20), np.arange(20) > 16, "too_few_events"),
        (np.linspace(1, 2, 20), np.arange(20) > 9, "separated"),
        (np.ones(20), np.arange(20) % 2, "degenerate"),
        (np.linspace(1, 2, 40), np.arange(40) % 7 * (40 - np.arange(40)) > 60, "wrong_sign"),
    ],
)
def test_a_curve_that_cannot_be_fitted_has_a_status(im, outcome, status):
    curve = rockfrag.fit_fragility(im, outcome)
    assert curve.status == status
    assert np.isnan(curve.probability(1.0)) == (status != "wrong_sign")


def test_probabilities_are_those_of_the_command(command):
    pga, pgv = np.array([0.1, 0.5, 0.9])[:, None], np.array([0.3, 0.6])
    found = rockfrag.probability(pga, pgv, suite="csgm", **BLOCK)
    assert found.p_ro.shape == (3, 2)
    words = "evaluate --width=0.5 --height=2 --pga=0.5 --pgv=0.6 --suite=csgm --format=json"
    row = polars.read_json(command(*words.split()).stdout.encode()).row(0, named=True)
    for name in ("p_nr", "p_ex", "p_ro_low", "p_f_r_high", "p_f"):
        assert getattr(found, name)[1, 1] == pytest.approx(row[name], rel=1e-9)
    assert np.isnan(found.p_ro[0]).all()
    point = rockfrag.evaluate(pga=0.5, pgv=0.6, suite="csgm", **BLOCK)
    assert point.to_polars()["p_f"][0] == found.p_f[1, 1]


def test_probabilities_come_from_fits_too(tmp_path, responses):
    rockfrag.fit_pex(responses, out=tmp_path / "pex.parquet")
    rockfrag.fit_pro(responses, out=tmp_path / "pro.parquet")
    structure = {name: value for name, value in FRAME.items() if name != "name"}
    fitted = rockfrag.probability(0.5, 0.6, fits=tmp_path, suite="csgm", **structure)
    assert 0 < fitted.p_ro < 1
    assert fitted.p_ro != rockfrag.probability(0.5, 0.6, suite="csgm", **structure).p_ro


def test_an_implausible_motion_is_a_warning_of_python():
    time = np.arange(0, 5, 0.01)
    with pytest.warns(UserWarning, match="PGA 3") as told:
        rockfrag.simulate_motion(3 * 9.81 * np.cos(4 * np.pi * time), 0.01, **BLOCK)
    with pytest.raises(ValueError):
        rockfrag.simulate_motion(40 * 9.81 * np.cos(4 * np.pi * time), 0.01, **BLOCK)
    assert [warning.filename for warning in told] == [__file__]


def test_a_print_of_probabilities_is_six_lines():
    assert len(repr(rockfrag.probability([0.5, 0.9], 0.6, **BLOCK)).splitlines()) == 6
    with pytest.raises(rockfrag.Error, match="cm/s"):
        rockfrag.probability(0.8, 90.0, **BLOCK)
