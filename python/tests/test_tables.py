"""Tables go to and come from the libraries that speak Arrow."""

import pathlib

import duckdb
import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import rockfrag
from conftest import STRUCTURES


@pytest.fixture(scope="module")
def expected(out):
    return pl.read_parquet(out / "responses.parquet")


def test_motions_come_from_each_library(out, expected):
    file = out / "motions.parquet"
    tables = {
        "polars": pl.read_parquet(file),
        "pyarrow": pq.read_table(file),
        "a stream": pq.ParquetFile(file).read().to_reader(max_chunksize=7),
        "a batch": pq.read_table(file).combine_chunks().to_batches()[0],
        "duckdb": duckdb.sql(f"select * from '{file}'").to_arrow_table(),
        "pandas": pd.read_parquet(file, dtype_backend="pyarrow"),
    }
    for name, motions in tables.items():
        responses = pl.DataFrame(rockfrag.simulate(motions, structures=STRUCTURES))
        assert responses.equals(expected), name


def test_a_result_goes_to_each_library(out, expected):
    responses = rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES)
    assert responses.shape == expected.shape and len(responses) == expected.height
    assert responses.columns == list(responses) == expected.columns
    assert responses.to_polars().equals(expected)
    assert pl.from_arrow(responses.to_pyarrow()).equals(expected)
    assert list(responses.to_pandas()["edp"].dropna()) == expected["edp"].drop_nulls().to_list()
    arrow = responses.to_pyarrow()
    assert duckdb.sql("select sum(impacts) from arrow").fetchall()[0][0] == expected["impacts"].sum()


def test_nothing_is_copied_on_the_way_out(out):
    motions = rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01)
    samples = lambda: pa.table(motions)["acceleration_m_s2"].chunk(0).values.buffers()[1].address
    assert samples() == samples()


def test_columns_say_what_they_are(out):
    schema = pa.schema(rockfrag.simulate(out / "motions.parquet", structures="paper"))
    assert schema.field("pga_m_s2").metadata[b"unit"] == b"m/s2"


def test_motions_of_others_need_three_columns(out):
    motions = pl.DataFrame(
        {"motion_id": ["mine"], "dt_s": [0.01], "acceleration_m_s2": [[0.0, 3.0, -4.0, 0.0]]}
    )
    row = rockfrag.simulate(motions, p=2.0, alpha=0.3, eta=0.9).to_polars().row(0, named=True)
    assert (row["motion_id"], row["pga_m_s2"], row["outcome"]) == ("mine", 4.0, "safe_rocking")


def test_columns_are_arrays(out, expected):
    responses = rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES)
    for name in ["edp", "impacts", "motion_id", "outcome", "tp_s"]:
        column = responses[name]
        assert isinstance(column, np.ndarray) and column.shape == (len(responses),)
        assert pl.Series(name, column, nan_to_null=True, dtype=expected.schema[name]).equals(expected[name]), name
    assert (responses["outcome"] == "overturning").sum() == np.isnan(responses["edp"]).sum() > 0
    motions = rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01)
    assert [samples.dtype for samples in motions["acceleration_m_s2"][:2]] == [np.float32] * 2
    assert "edp" in responses and "pga" not in responses
    with pytest.raises(KeyError, match="no column 'pga'; there are motion_id"):
        responses["pga"]


def test_tables_are_equal_by_their_values(out):
    of = lambda seed, suite="pulse": rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01, suite=suite, seed=seed)
    assert of(1, "csgm") == of(1, "csgm") and of(1, "csgm") != of(2, "csgm")
    assert of(1) != of(1, "csgm") and of(1) != 3
    assert of(1) == rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01, suite="pulse", seed=1, row_group=7)
    assert of(1).head(3) == of(1).head(3) and of(1).head(3) != of(1)
    assert of(1).head(3).shape == (3, len(of(1).columns))


def test_tables_show_what_they_are(out):
    responses = rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES)
    text = repr(responses)
    assert text.startswith("rockfrag.Table of simulate: 160 rows, 22 columns") and "im6" in text
    assert len(text.splitlines()) < 15 and max(map(len, text.splitlines())) < 300
    html = responses._repr_html_()
    assert html.count("<th>") == 22 and "electrical-equipment" in html
    assert "values]" in rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01)._repr_html_()


def test_tables_say_how_they_were_made_and_what_was_warned_of(out):
    scenarios = rockfrag.sample_scenarios(samples=2)
    assert (scenarios.metadata["stage"], scenarios.metadata["parameters"]["seed"]) == ("sample-scenarios", 42)
    with pytest.warns(rockfrag.RockfragWarning) as told:
        pro = rockfrag.fit_pro(out / "responses.parquet")
    # Python names options without dashes.
    assert [words.replace("--", "") for words in pro.metadata["warnings"]] == [str(warning.message) for warning in told]


def test_seeds_are_as_numpys(tmp_path):
    sample = lambda **seed: rockfrag.sample_scenarios(mw=6.5, re=5, samples=3, **seed)
    assert sample() == sample() == sample(seed=42)
    fresh = [sample(seed=None) for _ in range(3)]
    assert fresh[0] != fresh[1] != fresh[2]
    seed = fresh[0].metadata["parameters"]["seed"]
    assert sample(seed=seed) == fresh[0]
    draw = lambda: sample(seed=np.random.default_rng(1))
    assert draw() == draw() and sample(seed=np.int64(7)) == sample(seed=7)
    file = sample(seed=None, out=tmp_path / "s.parquet")
    assert sample(seed=rockfrag.inspect(file).parameters["seed"]).to_polars().equals(pl.read_parquet(file))


def test_a_hazard_is_a_file_or_its_columns():
    ask = lambda hazard: rockfrag.evaluate(width=0.5, height=2.0, hazard=hazard, ratio=0.4)
    hazard = rockfrag.datasets.load_hazard()
    file = pathlib.Path(rockfrag.datasets.__file__).with_name("hazard.csv")
    assert ask(file) == ask(hazard) == ask(pl.DataFrame(hazard)) == ask(pd.DataFrame(hazard))
