"""The data that is shipped is that of the repository, and can be made again."""

import pathlib
import subprocess
import sys

import numpy as np
import pytest
import rockfrag

ROOT = pathlib.Path(__file__).parents[2]
SHIPPED = pathlib.Path(rockfrag.datasets.__file__).parent


@pytest.mark.parametrize("name", ["hazard.csv", "paper.csv", "structures.csv"])
def test_files_are_those_of_the_repository(name):
    assert (SHIPPED / name).read_bytes() == (ROOT / "data" / name).read_bytes()


def test_outcomes_can_be_made_again(tmp_path):
    subprocess.run([sys.executable, ROOT / "scripts/example_records.py", tmp_path], check=True, capture_output=True)
    motions = rockfrag.import_motions(tmp_path)
    responses = rockfrag.simulate(motions, structures=rockfrag.Structure.block(0.5, 2.0))
    outcomes = rockfrag.datasets.load_outcomes()
    assert responses["motion_id"].tolist() == outcomes["motion"].tolist()
    assert np.array_equal(responses["outcome"] == "overturning", outcomes["overturned"])
    made = {"pga_g": responses["pga_m_s2"] / 9.81, **{name: responses[name] for name in ["pgv_m_s", "tp_s", "edp"]}}
    for name, values in made.items():
        assert np.allclose(values, outcomes[name], rtol=1e-4, equal_nan=True), name


def test_structures_are_those_of_the_paper():
    frame, equipment = rockfrag.datasets.load_structures()
    assert (frame.name, equipment.name) == ("frame", "electrical-equipment")
    assert (equipment.p, equipment.alpha, equipment.eta) == (2.5, 0.2, 0.92)
