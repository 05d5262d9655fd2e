"""Tables go to and come from the libraries that speak Arrow."""

import duckdb
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
    assert len(responses) == responses.num_rows == expected.height
    assert responses.column_names == expected.columns
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
