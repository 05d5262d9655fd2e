"""Tables go to and come from the libraries that speak Arrow."""

import copy
import pathlib
import pickle

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


def test_rows_and_columns_are_tables(out, expected):
    responses = rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES)
    for rows in [slice(2, 5), slice(-3, None), slice(None), slice(6, 40), slice(200, 300)]:
        assert responses[rows].to_polars().equals(expected[rows]), rows
    some = responses[["edp", "outcome"]][2:5]
    assert some.to_polars().equals(expected[["edp", "outcome"]][2:5]) and some.metadata == responses.metadata
    for key in [3, 2.5, slice(None, None, 2), np.array([True, False]), ("edp", "outcome")]:
        with pytest.raises(TypeError, match=r"expected the name of a column, a list of names, or rows from:to; .*to_polars\(\)"):
            responses[key]
    with pytest.raises(KeyError, match="no column 'pga'; there are motion_id"):
        responses[["edp", "pga"]]
    with pytest.raises(ValueError, match="n is -1; expected a number of rows, 0 or more"):
        responses.head(-1)
    assert responses._ipython_key_completions_() == responses.columns


def test_tables_can_be_pickled(out):
    with pytest.warns(rockfrag.RockfragWarning):
        fits = rockfrag.fit_pex(out / "responses.parquet")
    for table in [fits, fits[2:5], fits[:0], rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01)]:
        for again in [pickle.loads(pickle.dumps(table)), copy.deepcopy(table)]:
            assert again == table and again.metadata == table.metadata
            assert pa.schema(again).equals(pa.schema(table), check_metadata=True)
            assert {name: len(part) for name, part in again.parts.items()} == {name: len(part) for name, part in table.parts.items()}


def test_pandas_is_told_how_to_take_a_table():
    scenarios = rockfrag.sample_scenarios(mw=6.5, re=5, samples=3)
    for take in [pd.DataFrame, np.asarray, pd.Series]:
        with pytest.raises(TypeError, match=r"take table.to_pandas\(\) for pandas"):
            take(scenarios)
    assert pl.DataFrame(scenarios).equals(scenarios.to_polars())


def test_whole_numbers_are_numbers_and_nulls_are_named():
    peaks = pd.DataFrame({"pga_m_s2": pd.array([3, 5, 8], dtype="Int64"), "pgv_m_s": pd.array([0.3, 0.6, 1.0], dtype="Float64")})
    ask = lambda table: rockfrag.evaluate(intensities=table, width=0.5, height=2.0)
    assert ask(peaks) == ask(peaks.astype(float)) == ask(pl.DataFrame(peaks))
    with pytest.raises(rockfrag.TableError, match="intensities: row 1, column 'pgv_m_s': null; expected a number"):
        ask(peaks.assign(pgv_m_s=pd.array([0.3, pd.NA, 1.0], dtype="Float64")))


def test_a_file_is_in_the_format_of_its_name(out, tmp_path):
    point = {"width": 0.5, "height": 2.0, "pga": 0.5, "pgv": 0.6}
    answer = rockfrag.evaluate(**point)
    file = rockfrag.evaluate(**point, out=tmp_path / "a.csv")
    assert pl.read_csv(file)["value"].to_list() == pytest.approx(pl.Series(answer["value"], nan_to_null=True).to_list())
    rockfrag.evaluate(**point, out=tmp_path / "a.parquet")
    intensities = pl.DataFrame({"pga_m_s2": [3.0, 5.0], "pgv_m_s": [0.3, 0.6]})
    table = rockfrag.evaluate(intensities=intensities, width=0.5, height=2.0)
    file = rockfrag.evaluate(intensities=intensities, width=0.5, height=2.0, out=tmp_path / "t.csv")
    assert pl.read_csv(file)["p_ro"].to_list() == table["p_ro"].tolist()
    (tmp_path / "t.csv").unlink()
    for write in [
        lambda out: rockfrag.sample_scenarios(samples=2, out=out),
        lambda out: rockfrag.fit_pro(pathlib.Path("responses.parquet"), out=out),
        lambda out: rockfrag.simulate("motions.parquet", structures="paper", out=out),
    ]:
        for ending in ["csv", "xlsx", "JSON"]:
            with pytest.raises(rockfrag.OptionError, match=f"t.{ending}; this table is written as Parquet: expected a name that ends in .parquet"):
                write(tmp_path / f"t.{ending}")
            assert not (tmp_path / f"t.{ending}").exists()


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


SHORT = {"motion_id": ["a", "b"], "dt_s": [0.01, 0.01], "acceleration_m_s2": [[0, 3, -4, 0], [0, 5, 0]]}
ONE = {"p": 2.0, "alpha": 0.3, "eta": 0.9}


def as_categories(table, *columns):
    """A table with categorical columns, by each library."""
    frame, arrow = table.to_pandas().astype(dict.fromkeys(columns, "category")), table.to_pyarrow()
    for name in columns:
        arrow = arrow.set_column(arrow.column_names.index(name), name, arrow[name].dictionary_encode())
    polar = table.to_polars().with_columns(pl.col(*columns).cast(pl.Categorical))
    yield from {"polars": polar, "pandas": frame, "pyarrow": arrow}.items()


def test_categories_are_text(out, tmp_path):
    responses = rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES)
    motions = rockfrag.synthesize_motions(out / "scenarios.parquet", dt=0.01, suite="csgm")
    expected = rockfrag.simulate(motions, structures=STRUCTURES)
    for name, table in as_categories(motions, "suite"):
        assert rockfrag.simulate(table, structures=STRUCTURES) == expected, name
    fit = lambda table: rockfrag.fit_pro(table)["theta"].tolist()
    with pytest.warns(rockfrag.RockfragWarning):
        plain = fit(responses)
        for name, table in as_categories(responses, "suite", "structure", "outcome"):
            assert np.array_equal(fit(table), plain, equal_nan=True), name
            file = tmp_path / f"{name}.parquet"
            pq.write_table(table.to_arrow() if name == "polars" else pa.table(table) if name == "pyarrow" else pa.Table.from_pandas(table), file)
            assert np.array_equal(fit(file), plain, equal_nan=True), file


@pytest.mark.filterwarnings("ignore:.*samples; a motion that rises:rockfrag.RockfragWarning")
@pytest.mark.parametrize("kind", [pl.Int8, pl.Int16, pl.Int32, pl.Int64, pl.UInt8, pl.UInt16, pl.UInt32, pl.Float32])
def test_whole_numbers_of_any_width_are_numbers(kind):
    motions = pl.DataFrame({**SHORT, "acceleration_m_s2": [[0, 3, 4, 0], [0, 5, 0]], "motion_id": [1, 2]})
    expected = rockfrag.simulate(motions.cast({"acceleration_m_s2": pl.List(pl.Float64)}), **ONE)
    samples = motions.cast({"acceleration_m_s2": pl.List(kind)})
    ids = samples.cast({"motion_id": kind}) if kind.is_integer() else samples
    for given in [samples, samples.to_arrow(), samples.to_pandas(), ids]:
        assert rockfrag.simulate(given, **ONE) == expected, type(given)
    answers = rockfrag.evaluate(intensities=pl.DataFrame({"pga_m_s2": [3, 5], "pgv_m_s": [1, 1], "site": [7, 8]}).cast(kind), width=0.5, height=2.0)
    assert answers["pga_m_s2"].tolist() == [3.0, 5.0] and answers["site"].tolist() == [7, 8]


@pytest.mark.filterwarnings("ignore:.*samples; a motion that rises:rockfrag.RockfragWarning")
def test_numbers_and_categories_of_duckdb():
    motions = duckdb.sql("select 'a' as motion_id, 0.01 as dt_s, [0.0, 3.5, -4.0] as acceleration_m_s2, 'csgm'::enum('csgm', 'pulse') as suite")
    expected = pl.DataFrame({"motion_id": ["a"], "dt_s": [0.01], "acceleration_m_s2": [[0.0, 3.5, -4.0]], "suite": ["csgm"]})
    assert rockfrag.simulate(motions, **ONE) == rockfrag.simulate(expected, **ONE)


def test_categories_go_along_with_answers():
    intensities = pl.DataFrame({"pga_m_s2": [3.0, 5.0], "pgv_m_s": [0.3, 0.6], "site": ["a", "b"]})
    ask = lambda table: rockfrag.evaluate(intensities=table, width=0.5, height=2.0)
    plain = ask(intensities)
    for table in [intensities.cast({"site": pl.Categorical}), intensities.to_pandas().astype({"site": "category"})]:
        assert ask(table) == plain and plain["site"].tolist() == ["a", "b"]


@pytest.mark.parametrize(
    "column, found, expected",
    [
        ({"dt_s": ["0.01", "0.01"]}, "text", "64-bit floating-point numbers in s"),
        ({"dt_s": pd.Categorical(["0.01", "0.01"])}, "text", "64-bit floating-point numbers in s"),
        ({"suite": [1, 2]}, "Int64", "text"),
        ({"motion_id": np.array([1, 2], dtype=np.uint64)}, "UInt64", "64-bit integers"),
        ({"acceleration_m_s2": [["0"], ["1"]]}, "lists of text", "lists of floating-point numbers in m/s2"),
    ],
)
def test_what_cannot_be_converted_says_what_it_is_and_what_to_do(column, found, expected):
    (name,) = column
    pandas = pd.DataFrame({**SHORT, **column})
    message = f"motions: column '{name}' is {found}; expected {expected} .*: convert it$"
    for table in [pandas, pl.DataFrame(pandas), pa.Table.from_pandas(pandas)]:
        with pytest.raises(rockfrag.TableError, match=message):
            rockfrag.simulate(table, **ONE)


@pytest.mark.parametrize("column", [{"dt_s": [0.01, "x"]}, {"acceleration_m_s2": [[0.0, "x"], [1.0]]}])
def test_a_column_of_pandas_of_several_types_is_named(column):
    (name,) = column
    with pytest.raises(rockfrag.TableError, match=f"motions: .*'x'.*column {name}.*; expected values of one type in each column"):
        rockfrag.simulate(pd.DataFrame({**SHORT, **column}), **ONE)


BLOCKS = pl.DataFrame({"name": ["slab", "vase"], "width": [0.9, 0.25], "height": [4.5, 0.75], "eta": [0.8, 0.9], "owner": ["a", "b"]})


@pytest.mark.parametrize(
    "table",
    [
        BLOCKS.cast({"name": pl.Categorical}).with_columns(pl.col("eta").cast(pl.String).cast(pl.Categorical)),
        BLOCKS.cast({"eta": pl.Decimal(10, 2), "width": pl.Decimal(10, 2), "name": pl.Enum(["slab", "vase"])}),
        BLOCKS.to_pandas().astype({"name": "category", "eta": "float32"}),
    ],
)
def test_structures_of_parquet_may_be_categories_and_decimals(out, tmp_path, table):
    rows = BLOCKS.drop("owner").to_dicts()
    file = tmp_path / "blocks.parquet"
    (pl.DataFrame(table) if isinstance(table, pl.DataFrame) else pl.from_pandas(table)).write_parquet(file)
    ask = lambda structures: pl.DataFrame(rockfrag.simulate(out / "motions.parquet", structures=structures))
    read, given = ask(file), ask(rows)
    assert read["structure"].equals(given["structure"]) and read["outcome"].equals(given["outcome"])
    assert read["eta"].to_numpy() == pytest.approx(given["eta"].to_numpy(), rel=1e-7)


def test_structures_of_parquet_of_another_type_are_named(out, tmp_path):
    BLOCKS.with_columns(eta=pl.lit(True)).write_parquet(tmp_path / "blocks.parquet")
    with pytest.raises(rockfrag.OptionError, match="column 'eta' is Boolean; expected text or numbers: convert it"):
        rockfrag.simulate(out / "motions.parquet", structures=tmp_path / "blocks.parquet")


def test_a_table_of_structures_says_what_to_do(out):
    with pytest.raises(rockfrag.OptionError, match="structures is a table; .* Parquet file of them: write it to a file"):
        rockfrag.simulate(out / "motions.parquet", structures=BLOCKS)
