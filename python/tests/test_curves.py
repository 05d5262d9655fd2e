"""Curves of plain arrays are those of the stages, of statsmodels and of pyFragility."""

import pathlib

import matplotlib
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import rockfrag
from rockfrag import FitError, OptionError, RockfragWarning, fit_demand, fit_failure, fit_fragility

sm = pytest.importorskip("statsmodels.api")
FORTY = rockfrag.datasets.load_outcomes()
IM, OVERTURNED, EDP = FORTY["pgv_m_s"], FORTY["overturned"], FORTY["edp"]
GRID = np.array([0.3, 0.7, 1.0, 1.5])

pytestmark = pytest.mark.filterwarnings("ignore:few events:rockfrag.RockfragWarning")


def design(im):
    return np.column_stack([np.ones(len(im)), np.log(im)])


@pytest.mark.parametrize("link", ["probit", "logit"])
def test_statsmodels_discrete_models(link):
    curve = fit_fragility(IM, OVERTURNED, link=link)
    model = {"probit": sm.Probit, "logit": sm.Logit}[link]
    theirs = model(OVERTURNED.astype(float), design(IM)).fit(disp=False, tol=1e-12)
    for name in ["params", "bse", "llf", "aic", "bic", "nobs"]:
        assert np.allclose(getattr(curve, name), getattr(theirs, name), rtol=1e-6), name
    assert np.allclose(curve.cov_params(), theirs.cov_params(), rtol=1e-6)
    assert np.allclose(curve.conf_int(), theirs.conf_int(), rtol=1e-6)
    assert np.allclose(curve.conf_int(alpha=0.2), theirs.conf_int(alpha=0.2), rtol=1e-6)
    assert np.allclose(curve.probability(GRID), theirs.predict(design(GRID)), rtol=1e-6)
    index = theirs.get_prediction(design(GRID), which="linear")
    assert np.allclose(curve.confidence_band(GRID), theirs.model.cdf(index.conf_int().T), rtol=1e-6)


def test_statsmodels_cloglog():
    curve = fit_fragility(IM, OVERTURNED, link="cloglog")
    family = sm.families.Binomial(sm.families.links.CLogLog())
    theirs = sm.GLM(OVERTURNED.astype(float), design(IM), family=family).fit(tol=1e-12)
    assert np.allclose(curve.params, theirs.params, rtol=1e-5)
    assert np.isclose(curve.llf, theirs.llf)
    assert np.isclose(curve.probability(curve.median), 0.5)


def test_statsmodels_clusters():
    cluster = np.arange(40) // 4
    curve = fit_fragility(IM, OVERTURNED, cluster=[f"station {label}" for label in cluster])
    model = sm.Probit(OVERTURNED.astype(float), design(IM))
    theirs = model.fit(disp=False, tol=1e-12, cov_type="cluster", cov_kwds={"groups": cluster})
    assert np.allclose(curve.bse, theirs.bse, rtol=1e-6)


def test_statsmodels_demand():
    curve = fit_demand(IM, EDP, limit_state=0.1)
    seen = ~OVERTURNED
    theirs = sm.OLS(np.log(EDP[seen]), design(IM[seen])).fit(cov_type="HC1", use_t=True)
    assert curve.cov_type == theirs.cov_type
    for name in ["params", "bse", "rsquared", "nobs", "df_resid"]:
        assert np.allclose(getattr(curve, name), getattr(theirs, name)), name
    assert np.allclose(curve.conf_int(), theirs.conf_int())
    assert np.isclose(curve.dispersion, theirs.scale**0.5)
    assert np.isclose(curve.probability(curve.median), 0.5)
    cluster = np.arange(40) % 21
    curve = fit_demand(IM, EDP, limit_state=0.1, cluster=cluster)
    theirs = sm.OLS(np.log(EDP[seen]), design(IM[seen])).fit(cov_type="cluster", cov_kwds={"groups": cluster[seen]}, use_t=True)
    assert np.allclose(curve.bse, theirs.bse) and curve.cov_type == theirs.cov_type


def test_coefficients_are_a_frame_as_in_statsmodels():
    theirs = sm.Probit(OVERTURNED.astype(float), design(IM)).fit(disp=False, tol=1e-12)
    demand = sm.OLS(np.log(EDP[~OVERTURNED]), design(IM[~OVERTURNED])).fit(cov_type="HC1", use_t=True)
    for curve, fit in [(fit_fragility(IM, OVERTURNED), theirs), (fit_demand(IM, EDP, limit_state=0.1), demand)]:
        frame, expected = curve.summary_frame(alpha=0.1), fit.t_test(np.eye(2)).summary_frame(alpha=0.1)
        assert list(frame.columns) == list(expected.columns) and list(frame.index) == list(curve.param_names)
        assert np.allclose(frame.to_numpy(), expected.to_numpy(), rtol=1e-5)


def by_clusters(count):
    return np.arange(40) * count // 40


def test_few_clusters_say_nothing_in_statsmodels():
    model = sm.Probit(OVERTURNED.astype(float), design(IM))
    plain = model.fit(disp=False).bse
    # The scores of all clusters sum to 0: of two clusters, one follows from the other, and a covariance of two coefficients from
    # one vector is singular.
    two = model.fit(disp=False, cov_type="cluster", cov_kwds={"groups": by_clusters(2)})
    assert np.linalg.matrix_rank(two.cov_params()) == 1 and two.bse[0] < 0.1 * plain[0]
    # Limits by ten clusters that differ hold the truth less often than they say, by fifty about as often.
    rng, held = np.random.default_rng(1), {}
    for count in (5, 50):
        groups = np.arange(200) % count
        within = 0
        for _ in range(100):
            shared, x = rng.normal(size=(2, count)), rng.normal(size=200)
            x = 0.5 * shared[0][groups] + 0.5 * x
            happened = 1.5 * x + 0.6 * shared[1][groups] + 0.8 * rng.normal(size=200) > 0
            fit = sm.Probit(happened.astype(float), sm.add_constant(x)).fit(disp=False, cov_type="cluster", cov_kwds={"groups": groups})
            within += abs(fit.params[1] - 1.5) < 1.96 * fit.bse[1]
        held[count] = within / 100
    assert held[5] < 0.87 < 0.89 < held[50], held


def test_limits_shown_are_those_of_the_errors_by_cluster():
    curve = fit_fragility(IM, OVERTURNED, cluster=by_clusters(20))
    text = str(curve.summary())
    assert "20 clusters" in text and "profile low" not in text
    spread = np.exp(1.959964 * curve.se_theta / curve.theta)
    for limit in (curve.theta / spread, curve.theta * spread):
        assert f"{limit:.4g}" in text
    assert "profile low" in str(fit_fragility(IM, OVERTURNED).summary())


@pytest.mark.parametrize("count", [1, 2])
def test_one_cluster_or_two_are_refused(count):
    for call in [
        lambda: fit_fragility(IM, OVERTURNED, cluster=by_clusters(count)),
        lambda: fit_demand(IM, EDP, limit_state=0.1, cluster=by_clusters(count)),
        lambda: fit_failure(IM, EDP, OVERTURNED, limit_state=0.1, cluster=by_clusters(count)),
    ]:
        with pytest.raises(OptionError, match=f"cluster has {count} labels.*expected 20 or more, at least 3"):
            call()


def test_few_clusters_are_doubted():
    for count, doubted in [(5, True), (19, True), (20, False), (40, False)]:
        curve = fit_fragility(IM, OVERTURNED, cluster=by_clusters(count))
        assert any(f"{count} clusters" in doubt for doubt in curve.doubts) == doubted
    with pytest.warns(RockfragWarning, match="5 clusters: standard errors by fewer than 20 are too small"):
        fit_demand(IM, EDP, limit_state=0.1, cluster=by_clusters(5))


@pytest.mark.parametrize("wrong, words", [(-0.1, "-0.1"), (np.inf, "inf")])
def test_demands_that_cannot_be_are_refused(wrong, words):
    safe = np.flatnonzero(~OVERTURNED)[[2, 5]]
    edp = EDP.copy()
    edp[safe] = wrong
    expected = f"edp: 2 of 40 cases .*the first, case {safe[0]}, is {words}; expected 0 or more"
    with pytest.raises(OptionError, match=expected):
        fit_demand(IM, edp, limit_state=0.1)
    with pytest.raises(OptionError, match=expected):
        fit_failure(IM, edp, OVERTURNED, limit_state=0.1)
    # What overturned has no demand, whatever stands there.
    edp = np.where(OVERTURNED, wrong, EDP)
    assert fit_failure(IM, edp, OVERTURNED, limit_state=0.1) == fit_failure(IM, EDP, OVERTURNED, limit_state=0.1)
    with pytest.raises(OptionError, match=f"1 of 40 cases did not overturn and are missing.*case {safe[0]}, is nan"):
        fit_failure(IM, np.where(np.arange(40) == safe[0], np.nan, EDP), OVERTURNED, limit_state=0.1)


def test_nullable_columns_of_pandas():
    frame = pd.DataFrame({"im": IM, "happened": OVERTURNED, "edp": EDP}).convert_dtypes()
    assert str(frame.dtypes["happened"]) == "boolean" and str(frame.dtypes["edp"]) == "Float64"
    assert fit_fragility(frame.im, frame.happened) == fit_fragility(IM, OVERTURNED)
    # NA stands where it overturned.
    assert frame.edp.isna().any() and fit_demand(frame.im, frame.edp, limit_state=0.1) == fit_demand(IM, EDP, limit_state=0.1)
    whole = pd.array(np.arange(1, 41), dtype="Int64")
    assert fit_fragility(whole, frame.happened) == fit_fragility(np.arange(1.0, 41.0), OVERTURNED)
    for values in [whole, frame.im.array]:
        missing = values.copy()
        missing[3] = pd.NA
        with pytest.raises(OptionError, match="im: case 3 is missing; expected finite numbers above 0"):
            fit_fragility(missing, frame.happened)
    with pytest.raises(OptionError, match="outcome: case 3 is missing; expected bool"):
        fit_fragility(IM, frame.happened.where(np.arange(40) != 3, pd.NA))
    with pytest.raises(OptionError, match="cluster: case 3 is missing"):
        fit_fragility(IM, OVERTURNED, cluster=missing)


def test_pyfragility():
    pf = pytest.importorskip("pyFragility")
    curve = fit_fragility(IM, OVERTURNED)
    theirs = pf.fit_field_data(IM, OVERTURNED)
    assert curve.param_names == ("intercept", "ln(im)") == theirs.param_names
    assert np.allclose(curve.probability(GRID), theirs.probability(GRID), rtol=1e-5)
    band = theirs.confidence_band(GRID, 0.9, "mle")
    assert np.allclose(curve.confidence_band(GRID, 0.9), band, rtol=1e-5)
    lognormal = theirs.lognormal_parameters("mle")
    assert np.allclose([curve.theta, curve.beta], [lognormal.theta, lognormal.beta], rtol=1e-5)
    profiled = pf.fit_binomial(IM, OVERTURNED.astype(float), np.ones(40), parametrization="lognormal")
    for name in ["theta", "beta"]:
        assert np.allclose(curve.profile_interval(name), profiled.profile_interval(name), rtol=1e-3), name


def test_the_same_task_in_each_package_on_the_page():
    """docs/python.md: forty outcomes, a curve, its limits and a plot."""
    matplotlib.use("Agg")
    pytest.importorskip("pyFragility")
    page = (pathlib.Path(__file__).parents[2] / "docs/python.md").read_text()
    names, limits = {}, []
    for block in page.split("```python\n")[1:4]:
        exec(block.split("```")[0], names)
        limits.append([names["low"], names["high"]])
        assert names["axes"].lines and names["axes"].has_data()
    assert np.allclose(limits[1:], limits[0], rtol=1e-5)
    matplotlib.pyplot.close("all")


@pytest.fixture(scope="module")
def responses(out):
    table = pq.read_table(out / "responses.parquet").to_pandas()
    return table[(table.suite == "csgm") & (table.structure == "electrical-equipment") & (table.outcome != "no_rocking")]


def test_the_stages(out, responses):
    overturned = responses.outcome == "overturning"
    curve = fit_fragility(responses.im5, overturned)
    demand = fit_demand(responses.im5, responses.edp, limit_state=0.1)
    of = lambda fits: fits[(fits.suite == "csgm") & (fits.structure == "electrical-equipment") & (fits.im_x == "im5")].iloc[0]
    pro, pex = of(pq.read_table(out / "pro.parquet").to_pandas()), of(pq.read_table(out / "pex.parquet").to_pandas())
    assert (curve.beta, curve.llf, curve.status) == (pro.beta, pro.log_likelihood, pro.status)
    # The exponential is NumPy's here.
    assert curve.theta == pytest.approx(pro.theta, rel=1e-15)
    assert (demand.params[0], demand.params[1], demand.dispersion) == (pex.ln_a, pex.b1, pex.beta)
    for name in ["mu", "beta"]:
        assert curve.profile_interval(name) == (pro[f"{name}_profile_low"], pro[f"{name}_profile_high"])
    assert curve.profile_interval("theta") == pytest.approx(np.exp(curve.profile_interval("mu")))
    assert np.isclose(demand.beta, pex.zeta)
    hybrid = fit_fragility(np.column_stack([responses.im4, 1 / responses.im3]), overturned)
    row = pq.read_table(out / "pro.parquet").to_pandas().query(
        "suite == 'csgm' and structure == 'electrical-equipment' and im_y == 'im3_inv'"
    )
    assert np.isclose(hybrid.lambda_, row["lambda"].item()) and np.isclose(hybrid.theta, row.theta.item())
    with pytest.raises(OptionError, match="no single axis"):
        hybrid.plot()


def test_failure_is_that_of_evaluate(out, responses, recwarn):
    each = np.arange(len(responses))
    curve = fit_failure(responses.im5, responses.edp, responses.outcome == "overturning", limit_state=0.1, cluster=each)
    fits = {"suite": "csgm", "structure": "electrical-equipment", "model": "univariate", "measure": "im5"}
    intensities = {"pga_m_s2": np.array([4.0, 6.0, 9.0]), "pgv_m_s": np.array([0.3, 0.6, 0.9])}
    # Of motions that share no magnitude and distance, as arrays share none: the limits then hold no differences between these.
    alone = pq.read_table(out / "responses.parquet").drop_columns(["mw", "re_km"])
    pex, pro = rockfrag.fit_pex(alone), rockfrag.fit_pro(alone)
    answers = rockfrag.evaluate(pex, pro, pa.table(intensities), **fits, p=2.5, alpha=0.2)
    im5 = 2.5 * intensities["pgv_m_s"] / (9.81 * np.tan(0.2))
    assert np.allclose(curve.probability(im5), answers["p_f"])
    overturning = fit_fragility(responses.im5, responses.outcome == "overturning", cluster=each)
    assert np.allclose(overturning.confidence_band(im5), [answers["p_ro_low"], answers["p_ro_high"]])
    # Each case has a variance of its own in both, and shares nothing with others.
    for demand in [curve.demand, fit_demand(responses.im5, responses.edp, limit_state=0.1)]:
        assert np.allclose(demand.confidence_band(im5), [answers["p_ex_low"], answers["p_ex_high"]])
    assert np.allclose(curve.confidence_band(im5), [answers["p_f_r_low"], answers["p_f_r_high"]])


def test_separated_outcomes_have_a_curve_with_firth_only():
    im, happened = np.geomspace(0.1, 10.0, 40), np.arange(40) >= 20
    with pytest.raises(FitError, match="estimator='firth'") as caught:
        fit_fragility(im, happened)
    assert caught.value.status == "separated" and isinstance(caught.value, ValueError)
    curve = fit_fragility(im, happened, estimator="firth")
    assert 0.9 < curve.median < 1.1
    low, high = curve.confidence_band(curve.median)
    assert low < 0.5 < high


def test_what_says_nothing_of_a_curve_has_the_status_of_the_stage(responses, recwarn):
    """All cases are events, or none; or the measure separates them, or does not vary."""
    n = len(responses)
    varied = responses.assign(im5=np.geomspace(0.1, 10.0, n))
    samples = {
        "all": (varied, np.full(n, True)),
        "none": (varied, np.full(n, False)),
        "separated": (varied, np.arange(n) >= n // 2),
        "constant": (responses.assign(im5=1.0), np.arange(n) % 2 == 0),
        "one": (varied, np.arange(n) == n // 3),
    }
    tables = [
        frame.assign(structure=name, outcome=np.where(happened, "overturning", "safe_rocking"), edp=np.where(happened, np.nan, 0.1))
        for name, (frame, happened) in samples.items()
    ]
    for estimator in ["ml", "firth"]:
        fits = rockfrag.fit_pro(pd.concat([responses, *tables]), estimator=estimator).to_pandas().query("im_x == 'im5'").set_index("structure")
        for name, (frame, happened) in samples.items():
            status = fits.status[name]
            try:
                curve = fit_fragility(frame.im5, happened, estimator=estimator)
                assert (curve.status, curve.separated) == (status, name == "separated")
                assert curve.separated == ("separated=True" in repr(curve))
            except FitError as refused:
                assert refused.status == status != "ok" and np.isnan(fits.theta[name])


def test_a_curve_of_one_event_says_little_more_than_a_limit():
    happened = np.arange(40) == 30
    with pytest.warns(RockfragWarning, match="a probability is little more than a bound, and its own limits may miss the truth"):
        curve = fit_fragility(np.geomspace(0.1, 10.0, 40), happened, estimator="firth")
    assert not any("confidence_band" in doubt for doubt in curve.doubts)
    with pytest.raises(FitError, match="0 events of 40 cases: all cases are events, or none are") as caught:
        fit_fragility(IM, np.zeros(40), estimator="firth")
    assert caught.value.status == "too_few_events"


def test_doubts_are_warnings():
    with pytest.warns(RockfragWarning, match="falls as the measure grows"):
        curve = fit_fragility(1.0 / IM, OVERTURNED)
    assert curve.status == "falling" and any("falls" in doubt for doubt in curve.doubts)


def test_lists_scalars_and_shapes():
    curve = fit_fragility(IM.tolist(), OVERTURNED.astype(int).tolist())
    assert curve == fit_fragility(IM, OVERTURNED) and curve != fit_fragility(IM, OVERTURNED, link="logit")
    assert curve == fit_fragility(IM[:, None], OVERTURNED)
    assert isinstance(curve.probability(1.0), float)
    assert curve.probability(GRID.reshape(2, 2)).shape == (2, 2)
    low, high = curve.limits(GRID, level=0.5)
    assert (low < curve.probability(GRID)).all() and (curve.probability(GRID) < high).all()


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: fit_fragility(IM, OVERTURNED[:39]), r"\(40,\), outcome \(39,\)"),
        (lambda: fit_fragility(np.ones((40, 3)), OVERTURNED), r"expected two measures"),
        (lambda: fit_fragility(3.0, True), r"expected \(n,\)"),
        (lambda: fit_fragility(IM, OVERTURNED * 2), "case 1 is"),
        (lambda: fit_fragility(IM - 1.0, OVERTURNED), "case 0 is .* above 0"),
        (lambda: fit_fragility(IM, OVERTURNED, link="cauchit"), "cauchit"),
        (lambda: fit_fragility(IM, OVERTURNED, cluster=[1, 2]), "label for each of 40"),
        (lambda: fit_fragility(IM, OVERTURNED).confidence_band(1.0, level=95), "level is 95"),
        (lambda: fit_fragility(IM, OVERTURNED).profile_interval("gamma"), "gamma"),
        (lambda: fit_fragility(IM, OVERTURNED).conf_int(95), "alpha is 95; .* such as 0.05 for 95 % limits"),
        (lambda: fit_demand(IM, EDP, limit_state=-1.0), "limit_state is -1"),
    ],
)
def test_what_cannot_be_says_so(call, message):
    with pytest.raises(OptionError, match=message):
        call()


def test_plots_and_summaries():
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    for curve in [
        fit_fragility(IM, OVERTURNED, im_name="PGV, m/s"),
        fit_demand(IM, EDP, limit_state=0.1),
        fit_failure(IM, EDP, OVERTURNED, limit_state=0.1),
    ]:
        figure, axis = plt.subplots()
        assert curve.plot(axis) is axis
        assert len(axis.lines) == 2 and len(axis.collections) == 1
        plt.close(figure)
        assert type(curve).__name__ in repr(curve)
        assert "<table>" in curve._repr_html_()
        assert str(curve.summary()).count("\n") >= 2
        assert f" over {curve.im_name}: " in str(curve.summary())


def test_the_legend_names_the_link():
    matplotlib.use("Agg")
    for link in ["probit", "cloglog"]:
        axes = fit_fragility(IM, OVERTURNED, link=link).plot()
        assert axes.get_legend_handles_labels()[1][0].startswith(f"{link}, median 1")
    matplotlib.pyplot.close("all")


def test_a_curve_keeps_what_it_was_fitted_to():
    forty = rockfrag.datasets.load_outcomes()
    im = forty["pgv_m_s"].copy()
    curve = rockfrag.fit_fragility(im, forty["overturned"])
    before = curve.profile_interval("theta")
    im[:] = 1.0
    assert curve.profile_interval("theta") == before
    for kept in [curve.im, curve.params]:
        with pytest.raises(ValueError, match="read-only"):
            kept[0] = 99.0
    with pytest.raises(rockfrag.OptionError, match="finite"):
        rockfrag.fit_fragility(np.where(np.arange(40) == 3, np.inf, forty["pgv_m_s"]), forty["overturned"])


@pytest.mark.parametrize("link", ["probit", "logit", "cloglog"])
@pytest.mark.parametrize("unit", [1e-3, 1.0, 300.0])
def test_separated_outcomes_have_limits_by_firth_and_a_doubt(link, unit):
    im = unit * np.geomspace(0.3, 3.0, 12)
    with pytest.warns(RockfragWarning, match="separates the outcomes"):
        curve = fit_fragility(im, im > unit, estimator="firth", link=link)
    for name, value in [("beta", curve.beta), ("theta", curve.theta)]:
        low, high = curve.profile_interval(name)
        assert 0.0 <= low < value < high, name
    assert not [doubt for doubt in fit_fragility(IM, OVERTURNED, estimator="firth").doubts if "separates" in doubt]


def test_errors_of_median_and_dispersion():
    model = sm.Probit(OVERTURNED.astype(float), design(IM)).fit(disp=False, tol=1e-12)
    curve, (b0, b1) = fit_fragility(IM, OVERTURNED), model.params
    gradient = curve.theta * np.array([-1.0 / b1, b0 / b1**2])
    assert np.isclose(curve.se_theta, np.sqrt(gradient @ model.cov_params() @ gradient), rtol=1e-6)
    assert np.isclose(curve.se_beta, model.bse[1] / b1**2, rtol=1e-6)
    demand = fit_demand(IM, EDP, limit_state=0.1)
    step = 1e-6

    def moved(name):
        """How theta or beta moves with each coefficient."""
        derivatives = []
        for k in range(2):
            values = []
            for side in (1.0, -1.0):
                a, b = demand.params + side * step * np.eye(2)[k]
                values.append(np.exp((np.log(0.1) - a) / b) if name == "theta" else demand.dispersion / b)
            derivatives.append((values[0] - values[1]) / (2.0 * step))
        return np.array(derivatives)

    theta, beta = moved("theta"), moved("beta")
    assert np.isclose(demand.se_theta, np.sqrt(theta @ demand.cov_params() @ theta), rtol=1e-6)
    assert np.isclose(demand.se_beta**2, beta @ demand.cov_params() @ beta + demand.beta**2 / (2 * demand.df_resid), rtol=1e-6)
    summary = str(fit_failure(IM, EDP, OVERTURNED, limit_state=0.1).summary())
    assert f"{demand.se_theta:.4g}" in summary and f"{curve.se_beta:.4g}" in summary
