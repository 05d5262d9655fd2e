"""The notebooks run from their first cell to their last, and are saved with what comes out."""

import pathlib
import re

import nbformat
import pytest
from nbclient import NotebookClient

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"


def text_of(notebook):
    """What the cells print and show, without numbers of processes."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    texts = (output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs)
    return re.sub(r"ipykernel_\d+/\d+\.py", "ipykernel", "\n".join(texts))


def images(notebook):
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return sum("image/png" in output.get("data", {}) for output in outputs)


@pytest.fixture(params=["paper", "records"])
def notebook(request):
    """As it is saved, and as it is after it ran."""
    saved = nbformat.read(EXAMPLES / f"{request.param}.ipynb", as_version=4)
    run = nbformat.from_dict(saved)
    NotebookClient(run, timeout=600, resources={"metadata": {"path": str(EXAMPLES)}}).execute()
    return request.param, saved, run


def test_notebooks(notebook):
    name, saved, run = notebook
    # To save them again: jupyter execute --inplace python/examples/*.ipynb
    assert text_of(saved) == text_of(run)
    assert images(saved) == images(run) == 2
    if name == "paper":
        shows_table_ii(text_of(run))


def shows_table_ii(text):
    rows = [line.split("┆") for line in text.splitlines() if line.startswith("│ ")]
    rows = [row for row in rows if row[0].startswith(("│ low_", "│ high_"))]
    table = {tuple(cell.strip(" │") for cell in row[:3]): [float(cell.strip(" │")) for cell in row[3:]] for row in rows}
    # Published, and ours, of the command with its default seed.
    published, ours = table["high_b1", "csgm", "electrical-equipment"]
    assert (published, round(ours, 3)) == (2.954, 3.088)
    assert len(table) == 32
