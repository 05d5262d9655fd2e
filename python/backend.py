"""Builds the wheel by maturin, with ``_stages.py``: the stages as functions, as the built module describes them."""

import json
import subprocess
import sys
import tempfile
import textwrap
import zipfile
from pathlib import Path

import maturin
from maturin import *  # noqa: F403

STAGES = Path(__file__).parent / "python/rockfrag/_stages.py"
HEAD = '''"""Every stage of the command as a function. Made by backend.py."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

from ._call import call
from ._result import Result

Path = str | PathLike[str]


class Fields(TypedDict, total=False):
    """'''
COMMON = [
    "threads: int | None = None",
    "force: bool = False",
    "config: Path | None = None",
    "progress: bool | Callable[[int, int], object] | None = None",
]
COMMON_HELP = "threads, force, config, progress: as of all stages; progress(done, total) is called as it runs"
#: Words of Python, which cannot be names of options.
RESERVED = ("from", "in")


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = maturin.build_wheel(wheel_directory, config_settings, metadata_directory)
    with tempfile.TemporaryDirectory() as folder, zipfile.ZipFile(Path(wheel_directory, name)) as wheel:
        wheel.extractall(folder)
        script = [sys.executable, "-c", "import _rockfrag; print(_rockfrag.describe())"]
        described = subprocess.run(script, cwd=Path(folder, "rockfrag"), check=True, stdout=subprocess.PIPE)
    made = functions(**json.loads(described.stdout)).encode()
    if STAGES.exists() and STAGES.read_bytes() == made:
        return name
    STAGES.write_bytes(made)
    return maturin.build_wheel(wheel_directory, config_settings, metadata_directory)


def functions(stages, fields):
    """The module of all stages, and of the fields of an object."""
    types = {option["name"]: type_of(option) for stage in stages for option in stage["options"]}
    typed = [f"{name}: {types.get(name, 'float')} | None" for name, _ in fields]
    body = [listed(fields) + '\n"""\n', "name: str", "count: int", *typed]
    text = HEAD + textwrap.indent("\n".join(body), "    ").lstrip() + "\n"
    names = [stage["name"].replace("-", "_") for stage in stages]
    return "".join([text, *map(function, stages), f"\n\n__all__ = {names}\n"])


def function(stage):
    """A stage: its options are keywords, and what it reads comes first."""
    options = [o for o in stage["options"] if not o["common"]]
    first = next((o for o in options if o["positional"] or o["name"] == "in"), None)
    own = [{**o, "name": o["name"] + "_" * (o["name"] in RESERVED)} for o in options if o is not first]
    helps = [("input", first["help"])] if first else []
    for option in own:
        default = "False" if option["kind"] == "flag" else option["default"]
        default = "temporary" if option["name"] == "out" and stage["name"] not in ("export", "report") else default
        helps.append((f"{option['name']} = {default}" if default else option["name"], option["help"]))
    doc = "\n".join([textwrap.fill(f"{stage['help']}.", 100), "", listed(helps), COMMON_HELP])
    typed = [f"{o['name']}: {type_of(o)} | None = None" for o in own]
    words = ["input: Any = None", "/"] * bool(first) + ["*", *typed, *COMMON]
    tables = [o["name"] for o in options if o["kind"] == "input"]
    body = f'"""{doc}\n"""\nreturn call("{stage["name"]}", locals(), {tables}, "{first["name"] if first else ""}")'
    return f"\n\ndef {stage['name'].replace('-', '_')}({', '.join(words)}) -> Result:\n{textwrap.indent(body, '    ')}\n"


def listed(helps):
    """Names with their whole help, wrapped."""
    wrap = textwrap.TextWrapper(100, subsequent_indent="    ", break_on_hyphens=False)
    return "\n".join(wrap.fill(" ".join(f"{name}: {help}".split())) for name, help in helps)


def type_of(option):
    """What an option takes. Angles may have a unit, columns are also a mapping, a target has its percent sign."""
    plain = {"float": "float", "int": "int", "path": "Path", "text": "Any"}
    one = plain[option["type"]] if isinstance(option["type"], str) else f"Literal{option['type']}"
    one = {"eta": "float | Literal['housner']", "wall": "bool | float | Literal['yes']"}.get(option["name"], one)
    one = "bool" if option["kind"] == "flag" or option["name"].startswith("fixed_to") else one
    one = f"{one} | str" if option["name"] in ("alpha", "alpha_sd") else one
    one = {"target": "str", "columns": "str | Mapping[str, str]"}.get(option["name"], one)
    one = "Any" if option["kind"] == "input" else one
    return f"{one} | Sequence[{one}]" if option["many"] and one != "Any" else one
