"""The stub of the stages: ``python -m rockfrag._stub > _stages.pyi``."""

from __future__ import annotations

import inspect
import json

from . import _stages


def stub() -> str:
    """The functions of all stages, for type checkers and editors."""
    lines = [
        "# Made by `python -m rockfrag._stub`.",
        "from collections.abc import Iterable",
        "from typing import Any",
        "",
        "from ._types import PathLike, Progress, TableLike",
        "",
        f"__all__ = {json.dumps(_stages.__all__)}",
    ]
    for name in _stages.__all__:
        parameters = []
        for parameter in inspect.signature(getattr(_stages, name)).parameters.values():
            if parameter.kind is parameter.KEYWORD_ONLY and "*" not in parameters:
                parameters.append("*")
            default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
            parameters.append(f"{parameter.name}: {parameter.annotation}{default}")
        lines += ["", f"def {name}(", *(f"    {parameter}," for parameter in parameters), ") -> Any: ..."]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(stub(), end="")
