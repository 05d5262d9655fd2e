"""The notebook prints what is saved in it, and draws."""

from pathlib import Path

import nbclient
import nbformat

NOTEBOOK = Path(__file__).parents[1] / "examples" / "paper.ipynb"


def outputs(notebook):
    shown = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    texts = [output["text"] for output in shown if output.get("name") == "stdout"]
    return texts, sum("image/png" in output.get("data", {}) for output in shown)


def test_the_notebook_prints_what_is_saved_in_it(tmp_path):
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    saved = outputs(notebook)
    nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": tmp_path}}).execute()
    assert outputs(notebook) == saved and saved[1] == 4
