"""The stub of the stages: ``python -m rockfrag._stub > _stages.pyi``."""

from __future__ import annotations

import inspect
import json
import textwrap

from . import _stages

HEAD = """\
# Made by `python -m rockfrag._stub`.
from collections.abc import Iterable
from pathlib import Path
from typing import Literal, overload

from numpy.random import Generator

from ._rockfrag import Table
from ._types import Hazard, PathLike, Progress, Steps, Structures, TableLike
"""


def stub() -> str:
    """The functions of all stages with their docstrings, for type checkers and editors."""
    lines = [HEAD, f"__all__ = {json.dumps(_stages.__all__)}"]
    for name in _stages.__all__:
        function = getattr(_stages, name)
        signature = inspect.signature(function)
        quoted = textwrap.indent(f'"""{function.__doc__}"""', "    ", lambda line: bool(line.strip()))
        if signature.return_annotation == "Path":
            lines += ["", *_definition(name, signature, {}, "Path"), quoted]
            continue
        lines += ["", "@overload", *_definition(name, signature, {"out": "out: None = None"}, "Table"), quoted]
        lines += ["@overload", *_definition(name, signature, {"out": "out: PathLike"}, "Path"), "    ..."]
    return "\n".join(lines) + "\n"


def _definition(name: str, signature: inspect.Signature, own: dict[str, str], returns: str) -> list[str]:
    parameters: list[str] = []
    for parameter in signature.parameters.values():
        if parameter.kind is parameter.KEYWORD_ONLY and "*" not in parameters:
            parameters.append("*")
        default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
        parameters.append(own.get(parameter.name, f"{parameter.name}: {parameter.annotation}{default}"))
    return [f"def {name}(", *(f"    {parameter}," for parameter in parameters), f") -> {returns}:"]


if __name__ == "__main__":
    print(stub(), end="")
