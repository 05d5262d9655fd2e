"""No stage of the command is missing, and each is typed."""

import inspect
import pathlib
import re
import subprocess
import sys

import pytest
import rockfrag
from rockfrag import _stages

PACKAGE = pathlib.Path(rockfrag.__file__).parent
#: The commands that are no stage and make or tell something.
TOOLS = ["run", "inspect", "seed_spread"]


def names():
    return [stage.name.replace("-", "_") for stage in _stages.STAGES]


def test_no_stage_of_the_command_is_missing():
    assert names() and set(names()) | set(TOOLS) <= set(rockfrag.__all__)
    assert set(_stages.__all__) == set(names())


@pytest.mark.parametrize("stage", _stages.STAGES, ids=lambda stage: stage.name)
def test_each_option_is_a_parameter_with_a_type(stage):
    signature = inspect.signature(getattr(rockfrag, stage.name.replace("-", "_")))
    options = {option["name"].replace("-", "_") for option in stage.options} | {table["role"] for table in stage.inputs}
    common = {"out", "threads", "progress", "force", "overwrite"}
    assert options | common == {name.rstrip("_") for name in signature.parameters}
    for parameter in signature.parameters.values():
        # Of an option that takes several kinds, rockfrag/_stages.py tells the type.
        assert "Any" not in parameter.annotation and "object" not in parameter.annotation, parameter
    assert signature.return_annotation in ("Table | Path", "Path")


@pytest.mark.parametrize("file", sorted(PACKAGE.glob("*.py*")), ids=lambda file: file.name)
def test_nothing_is_typed_as_any(file):
    if file.suffix in (".py", ".pyi"):
        assert not re.search(r"\bAny\b", file.read_text())


@pytest.mark.parametrize("name", ["format", "unit", "rotate"])
def test_words_that_types_name_are_those_of_the_command(name, tmp_path):
    file = tmp_path / "record.csv"
    file.write_text("0.0\n0.1\n0.0\n")
    words = re.findall(r"'([^']*)'", _stages._OWN[name])
    assert words
    for word in words:
        try:
            rockfrag.import_motions(file, dt=0.01, **{"unit": "g", name: word})
        except rockfrag.RockfragError as error:
            assert not isinstance(error, rockfrag.OptionError), error
    with pytest.raises(rockfrag.OptionError, match="furlong"):
        rockfrag.import_motions(file, dt=0.01, **{"unit": "g", name: "furlong"})


@pytest.mark.parametrize(
    "code, expected",
    [
        ("print('ray' in sys.modules, 'ray' in dir(rockfrag))", "False True"),
        ("sys.modules['ray'] = None\nprint(getattr(rockfrag, 'ray', 'none'))", "none"),
        ("sys.modules['ray'] = None\ntry:\n    rockfrag.ray\nexcept AttributeError as error:\n    print(error)", "pip install 'rockfrag[ray]'"),
        ("sys.modules['ray'] = None\ntry:\n    import rockfrag.ray\nexcept ImportError as error:\n    print(error)", "rockfrag.ray needs Ray, and"),
        ("print({'matplotlib', 'polars', 'pandas', 'pyarrow', 'scipy'} & set(sys.modules))", "set()"),
    ],
)
def test_what_is_not_needed_is_not_imported(code, expected):
    done = subprocess.run([sys.executable, "-c", f"import sys, rockfrag\n{code}"], capture_output=True, text=True, check=True)
    assert expected in done.stdout
