"""A function for each stage, made of what the library says of it: names, defaults and words are those of the command line.

What type checkers and editors see of them is ``_stages.pyi``, which ``python -m rockfrag._stub`` prints.
"""

from __future__ import annotations

import inspect
import json
import keyword
import os
import textwrap
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from . import _options, _rockfrag

_TYPES = {
    "float": "float",
    "int": "int",
    "bool": "bool",
    "str": "str",
    "paths": "PathLike | Iterable[PathLike]",
    "any": "Any",
}
_COMMON = {
    "out": ("PathLike | None", None, "Path to write; it is returned. A file that is up to date is left as it is."),
    "threads": ("int | None", None, "All cores if not given."),
    "progress": ("Progress | None", None, "Called with the number of steps done and of all."),
    "force": ("bool", False, "Make even a file that is up to date."),
    "overwrite": ("bool", False, "Write over a file that another stage or program has made."),
}


def _default(option: Mapping[str, Any]) -> Any:
    """The default as Python's value; it is shown and never sent, so that the library's own one holds."""
    text, kind = option["default"], option["type"]
    if kind == "bool":
        return False
    return {"float": float, "int": int}.get(kind, str)(text) if text is not None else None


def _parameter(name: str, annotation: str, default: Any = inspect.Parameter.empty, only_by_name: bool = False) -> inspect.Parameter:
    kind = inspect.Parameter.KEYWORD_ONLY if only_by_name else inspect.Parameter.POSITIONAL_OR_KEYWORD
    return inspect.Parameter(name, kind, default=default, annotation=annotation)


def _signature(stage: Mapping[str, Any]) -> inspect.Signature:
    tables = [_parameter(table["role"], "TableLike") for table in stage["inputs"] if table["required"]]
    first = [_parameter(_python(option), _TYPES[option["type"]]) for option in stage["options"] if option["positional"]]
    optional = [_parameter(table["role"], "TableLike | None", None) for table in stage["inputs"] if not table["required"]]
    keywords = []
    for option in stage["options"]:
        if not option["positional"]:
            default = _default(option)
            annotation = _TYPES[option["type"]]
            annotation += " | None" if default is None and annotation != "Any" else ""
            keywords.append(_parameter(_python(option), annotation, default, only_by_name=True))
    common = {name: _parameter(name, kind, default, only_by_name=True) for name, (kind, default, _) in _COMMON.items()}
    if not _makes_table(stage):
        common["out"] = _parameter("out", "PathLike", only_by_name=True)
    return inspect.Signature([*tables, *first, *optional, *keywords, *common.values()], return_annotation="Any")


def _makes_table(stage: Mapping[str, Any]) -> bool:
    """Whether a stage makes a table, which memory can hold, or pages and texts, which need a path."""
    return str(stage["output"]["file"]).endswith(".parquet")


def _python(option: Mapping[str, Any]) -> str:
    """The name of an option as Python takes it: ``from`` is a word of the language, so it is ``from_``."""
    name = str(option["name"]).replace("-", "_")
    return f"{name}_" if keyword.iskeyword(name) else name


def _docstring(stage: Mapping[str, Any]) -> str:
    words = [(table["role"], table["help"]) for table in stage["inputs"]]
    words += [(_python(option), option["help"]) for option in stage["options"]]
    words += [(name, help) for name, (_, _, help) in _COMMON.items()]
    lines = [textwrap.fill(f"{name}: {help}", 110, initial_indent="    ", subsequent_indent="        ") for name, help in words]
    parts = ", ".join(f'``parts["{part}"]``' for part in stage["output"]["parts"])
    returns = "A table, or the path of ``out``" if _makes_table(stage) else "The path of ``out``"
    returns += f"; with {parts} where there are such." if parts else "."
    return "\n".join([stage["about"] + ".", "", "Args:", *lines, "", "Returns:", f"    {returns}"])


def _function(stage: Mapping[str, Any]) -> Callable[..., Any]:
    signature = _signature(stage)
    roles = {table["role"] for table in stage["inputs"]}
    kinds = {_python(option): option["type"] for option in stage["options"]}

    def call(*arguments: Any, **keywords: Any) -> Any:
        given = {name: value for name, value in signature.bind(*arguments, **keywords).arguments.items() if value is not None}
        settings = _options.settings(*(given.pop(name, None) for name in ("threads", "progress", "force", "overwrite")))
        out = _options.path(given.pop("out", None))
        inputs = {role: given.pop(role) for role in roles & given.keys()}
        for name, value in given.items():
            if kinds[name] == "paths" and isinstance(value, (str, os.PathLike)):
                given[name] = [value]
        return _rockfrag.call(stage["name"], inputs, _options.to_json(given), out, settings)

    call.__name__ = call.__qualname__ = stage["name"].replace("-", "_")
    call.__module__ = __name__
    call.__doc__ = _docstring(stage)
    call.__signature__ = signature  # type: ignore[attr-defined]
    return call


_FUNCTIONS = {function.__name__: function for function in map(_function, json.loads(_rockfrag.stages()))}
globals().update(_FUNCTIONS)
__all__ = sorted(_FUNCTIONS)
