"""A function for each stage, made of what the library says of it: names, defaults and words are those of the command line.

What type checkers and editors see of them is ``_stages.pyi``, which ``python -m rockfrag._stub`` prints.
"""

from __future__ import annotations

import difflib
import inspect
import json
import keyword
import re
import textwrap
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

from . import _options, _rockfrag
from ._examples import EXAMPLES
from ._rockfrag import Table

#: Types of options by the kind that the library gives them,
_KINDS = {
    "float": "float",
    "int": "int",
    "bool": "bool",
    "str": "str",
    "path": "PathLike",
    "paths": "PathLike | Iterable[PathLike]",
    "steps": "Steps",
}
_SUITES = "Literal['pulse', 'csgm', 'hfc']"
#: and of those that take several kinds, or not all words, by their names.
_OWN = {
    "candidate": "str | Iterable[str]",
    "column": "int | str",
    "columns": "str",
    "eta": "float | Literal['housner']",
    "format": "Literal['auto', 'at2', 'cosmos', 'csmip', 'esm', 'knet', 'smc', 'columns']",
    "pairs": "str | Iterable[str]",
    "partition": "tuple[int, int]",
    "rotate": "float | Literal['strongest-pulse']",
    "fit-pro event": "Literal['overturning', 'rocking']",
    "hazard": "Hazard",
    "seed": "int | Generator | None",
    "structures": "Structures",
    "universality model": "Literal['univariate', 'bivariate']",
    "synthesize-motions suite": f"{_SUITES} | Iterable[{_SUITES}]",
    "trace": "int | str | Iterable[int | str]",
    "transition": "float | Literal['found']",
    "unit": "Literal['g', 'mg', 'm/s2', 'cm/s2', 'gal', 'mm/s2', '%g', 'ft/s2', 'in/s2']",
}
_SEED = 42
#: What Python has other words for than the command line.
_HELP = {
    "hazard": "CSV file, or its columns as a table or mapping: pga_g or pgv_m_s with annual_rate_of_exceedance, or both with "
    "annual_rate_of_occurrence.",
    "partition": "(i, n): do only partition i of n, with i from 0 to n - 1. ``out`` is then a folder; the file in it is part-0000i.parquet.",
    "seed": "Seed of the random numbers. The same seed makes the same rows, on any machine. None takes a fresh seed, as in NumPy; a "
    "numpy.random.Generator draws one. ``Table.metadata`` and ``inspect`` tell the seed.",
    "synthesize-motions suite": "One suite or several: pulse, csgm (pulse with high frequencies), hfc (high frequencies alone).",
    "structures": "One Structure or several; the path of a YAML, CSV or Parquet file of them; or 'paper', for both structures of the paper.",
}
_KEPT = "its path is returned. A file that is up to date is left as it is."
_HELP |= {
    "evaluate columns": "Which headings of ``hazard`` or of ``intensities`` stand for which columns, as "
    "'pga_g=PGA,annual_rate_of_exceedance=rate'.",
    "evaluate out": f"File to write: .parquet, or for one intensity or a site also .csv, .json or .txt; {_KEPT}",
    "validate hazard": "CSV file, or its columns as a table or mapping: pga_g or pgv_m_s with annual_rate_of_exceedance. Counts annual "
    "rates in the motions themselves, weighted to have its rates, beside those of the fits.",
    "validate columns": "Which headings of ``hazard`` stand for which columns, as 'pga_g=PGA,annual_rate_of_exceedance=rate'.",
    "export out": f"File to write; {_KEPT}",
    "report out": f"Page to write, NAME.html; {_KEPT} Figures go into the folder NAME beside it.",
    "simulate out": f"Parquet file to write, or without a suffix a folder of partitions; {_KEPT}",
    "synthesize-motions out": f"Parquet file to write, or without a suffix a folder of partitions; {_KEPT}",
}
#: Types as a docstring has them.
_SPOKEN = {
    "Hazard": "path, Arrow table or mapping",
    "PathLike": "path",
    "Progress": "callable",
    "Steps": "float, iterable of float, or 'first:last:step'",
    "Structures": "Structure, iterable of Structure, or path",
    "TableLike": "Arrow table or path",
    "Generator": "numpy.random.Generator",
}
_COMMON = {
    "out": ("PathLike | None", None, f"Parquet file to write; {_KEPT}"),
    "threads": ("int | None", None, "Number of threads; all cores if not given."),
    "progress": ("Progress | None", None, "Called with the number of steps done and of all, a few times a second."),
    "force": ("bool", False, "Also make a file that is up to date."),
    "overwrite": ("bool", False, "Replace a file that another stage or program has made."),
}
_RAISES = {
    "OptionError": "If an option has a wrong type, is out of range, or does not go with another.",
    "TableError": "If a table lacks a column, has no rows, or holds a value that cannot be used.",
    "MissingFileError": "If a file does not exist.",
    "FileError": "If a file cannot be read or written.",
}


Option = Mapping[str, "str | bool | list[str] | None"]


class Stage(NamedTuple):
    """A stage as the library describes it."""

    name: str
    about: str
    inputs: list[Mapping[str, str | bool]]
    options: list[Option]
    output: Mapping[str, str | list[str]]

    @property
    def makes_table(self) -> bool:
        """Whether it makes a table, which memory can hold, or pages and texts, which need a path."""
        return str(self.output["file"]).endswith(".parquet")

    @property
    def has_partitions(self) -> bool:
        """Whether it can write a folder of partitions."""
        return any(option["name"] == "partition" for option in self.options)


STAGES = [Stage(**stage) for stage in json.loads(_rockfrag.stages())]


def _python(name: object) -> str:
    """The name of an option as Python takes it: ``from`` is a word of the language, so it is ``from_``."""
    plain = str(name).replace("-", "_")
    return f"{plain}_" if keyword.iskeyword(plain) else plain


class _Type(str):
    """A type as it is written, without quotes where a signature is shown."""

    __repr__ = str.__str__


def _annotation(stage: Stage, option: Option) -> str:
    name, words = str(option["name"]), option["words"]
    own = _OWN.get(f"{stage.name} {name}")
    if own or option["type"] == "any" or name in ("hazard", "seed"):
        return own or _OWN.get(name, "object")
    if option["type"] == "word":
        assert isinstance(words, list)
        return f"Literal[{', '.join(map(repr, words))}]"
    return _KINDS[str(option["type"])]


def _default(option: Option) -> str | float | bool | tuple[str, ...] | None:
    """The default as Python's value; it is shown and never sent, so that the library's own one holds."""
    text, kind = option["default"], option["type"]
    if option["name"] == "seed":
        return _SEED
    if kind == "bool":
        return False
    if kind == "word" and "," in str(text or ""):
        return tuple(str(text).split(","))
    return {"float": float, "int": int}.get(str(kind), str)(str(text)) if text is not None else None


def _parameter(name: str, annotation: str, default: object = inspect.Parameter.empty, only_by_name: bool = False) -> inspect.Parameter:
    kind = inspect.Parameter.KEYWORD_ONLY if only_by_name else inspect.Parameter.POSITIONAL_OR_KEYWORD
    return inspect.Parameter(name, kind, default=default, annotation=_Type(annotation))


def _signature(stage: Stage) -> inspect.Signature:
    kind = "TableLike" if stage.makes_table or stage.name == "export" else "PathLike"
    tables = [_parameter(str(table["role"]), kind) for table in stage.inputs if table["required"]]
    first = [_parameter(_python(option["name"]), _annotation(stage, option)) for option in stage.options if option["positional"]]
    optional = [_parameter(str(table["role"]), f"{kind} | None", None) for table in stage.inputs if not table["required"]]
    keywords = []
    for option in stage.options:
        if not option["positional"]:
            default, annotation = _default(option), _annotation(stage, option)
            annotation += " | None" if default is None else ""
            keywords.append(_parameter(_python(option["name"]), annotation, default, only_by_name=True))
    common = {name: _parameter(name, kind, default, only_by_name=True) for name, (kind, default, _) in _COMMON.items()}
    if not stage.makes_table:
        common["out"] = _parameter("out", "PathLike", only_by_name=True)
    returns = "Table | Path" if stage.makes_table else "Path"
    return inspect.Signature([*tables, *first, *optional, *keywords, *common.values()], return_annotation=_Type(returns))


def _docstring(stage: Stage, signature: inspect.Signature) -> str:
    """In NumPy's style."""
    helps = {str(table["role"]): f"{table['help']}." for table in stage.inputs}
    helps |= {_python(option["name"]): f"{option['help']}." for option in stage.options}
    helps |= {name: help for name, (_, _, help) in _COMMON.items()}
    lines = ["Parameters", "----------"]
    for parameter in signature.parameters.values():
        kind = re.sub(r"Literal\[([^\]]*)\]", r"{\1}", parameter.annotation)
        kind = (kind.removesuffix(" | None") if parameter.default is None else kind).replace(" | ", " or ")
        if parameter.default is None:
            kind = f"{kind}, optional"
        elif parameter.default is not parameter.empty:
            kind = f"{kind}, default {parameter.default!r}"
        kind = re.sub(r"Iterable\[([^\]]*)\]", r"iterable of \1", kind)
        for name, words in _SPOKEN.items():
            kind = re.sub(rf"\b{name}\b", words, kind)
        help = _HELP.get(f"{stage.name} {parameter.name}") or _HELP.get(parameter.name) or helps[parameter.name]
        lines += [f"{parameter.name} : {kind}", *_wrapped(help)]
    parts = ", ".join(f'``parts["{part}"]``' for part in stage.output["parts"])
    made = "A table in memory; with ``out``, the path of the file." if stage.makes_table else "The path of the file."
    made += f" Further tables, where there are any: {parts}." if parts else ""
    lines += ["", "Returns", "-------", "Table or pathlib.Path" if stage.makes_table else "pathlib.Path", *_wrapped(made)]
    lines += ["", "Raises", "------"]
    for error, reason in _RAISES.items():
        lines += [error, *_wrapped(reason)]
    lines += ["", "Warns", "-----", "RockfragWarning", *_wrapped("If a result is doubtful: a fit that failed, an intensity outside of the data.")]
    example = EXAMPLES.get(stage.name, "").strip()
    about = [line for paragraph in stage.about.split("\n\n") for line in [*_wrapped(f"{paragraph.rstrip('.')}.", indent=""), ""]]
    return "\n".join([*about, *lines, "", "Examples", "--------", *example.splitlines()]) + "\n"


def _wrapped(text: str, indent: str = "    ") -> list[str]:
    """A help of the command line in the words of Python: options without dashes, defaults where the type stands."""
    text = re.sub(r" \[default: [^\]]*\](?=\.|$)", "", text) if "[default: 42]" in text else text
    for name in [*(stage.name for stage in STAGES), "seed-spread"]:
        text = text.replace(name, _python(name)) if "-" in name else text
    text = re.sub(r"--([a-z][a-z-]*)", lambda option: f"``{_python(option[1])}``", text)
    return textwrap.wrap(text, 100, initial_indent=indent, subsequent_indent=indent)


def _expect_known(stage: Stage, signature: inspect.Signature, keywords: Mapping[str, object]) -> None:
    """That a stage has arguments of these names."""
    for name in keywords:
        if name not in signature.parameters:
            near = difflib.get_close_matches(name, signature.parameters, 1)
            hint = f"did you mean {near[0]!r}?" if near else f"help(rockfrag.{_python(stage.name)}) lists them"
            raise TypeError(f"{_python(stage.name)} has no argument {name!r}; {hint}")


def _function(stage: Stage) -> Callable[..., Table | Path]:
    signature = _signature(stage)
    roles = {str(table["role"]) for table in stage.inputs}
    kinds = {_python(option["name"]): str(option["type"]) for option in stage.options}
    has_seed = any(option["name"] == "seed" for option in stage.options)

    def call(*arguments: object, **keywords: object) -> Table | Path:
        _expect_known(stage, signature, keywords)
        bound = signature.bind(*arguments, **keywords).arguments
        given = {name: value for name, value in bound.items() if value is not None}
        if has_seed and "seed" in bound:
            given["seed"] = _options.seed(bound["seed"])
        if "partition" in given:
            given["partition"] = _options.partition(given["partition"])
        settings = _options.settings(*(given.pop(name, None) for name in ("threads", "progress", "force", "overwrite")))
        out = _options.path(given.pop("out", None), may_be_folder=stage.has_partitions)
        inputs = {role: given.pop(role) for role in roles & given.keys()}
        _options.warn_of_sizes(inputs.get("intensities"))
        with _options.hazard_file(given.get("hazard")) as hazard:
            if hazard is not None:
                given["hazard"] = hazard
            options = {name: _options.checked(name, kinds[name], value) for name, value in given.items()}
            return _rockfrag.call(stage.name, inputs, _options.to_json(options), out, settings)

    call.__name__ = call.__qualname__ = _python(stage.name)
    call.__module__ = __name__
    call.__doc__ = _docstring(stage, signature)
    call.__signature__ = signature  # type: ignore[attr-defined]
    return call


_FUNCTIONS = {function.__name__: function for function in map(_function, STAGES)}
globals().update(_FUNCTIONS)
__all__ = sorted(_FUNCTIONS)
