"""From a call of Python to the parser of the command, and from its options to functions with help."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import sys
import tempfile
import textwrap
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from inspect import Parameter, Signature
from pathlib import Path
from typing import Any, NamedTuple

from . import _rockfrag
from ._result import Result

#: Columns of a line of help.
WIDTH = 100
#: Words of Python, which cannot be names of options.
RESERVED = ("from", "in")


class Option(NamedTuple):
    """An option of a stage, as the command describes it."""

    name: str
    #: flag, number, text, or of paths: input, folder, fits, output.
    kind: str
    #: How the names of its files may end, the best first.
    formats: list[str]
    default: str
    help: str
    heading: str
    positional: bool
    #: Whether all stages have it.
    common: bool


class Stage(NamedTuple):
    """A stage, as the command describes it."""

    command: str
    help: str
    options: list[Option]

    @property
    def name(self) -> str:
        return self.command.replace("-", "_")

    @property
    def input(self) -> Option | None:
        """What comes first without a name."""
        return next((option for option in self.options if option.positional or option.name == "in"), None)

    @property
    def makes_table(self) -> bool:
        return any(option.kind == "output" and "parquet" in option.formats for option in self.options)

    @property
    def named(self) -> list[Option]:
        own = [option for option in self.options if not option.common and option is not self.input]
        return [o._replace(name=f"{o.name}_") if o.name in RESERVED else o for o in own]


def described() -> list[Stage]:
    """All stages, in the order of a run."""
    stages = json.loads(_rockfrag.describe())
    return [
        Stage(each["name"], each["help"], [described_option(option) for option in each["options"]])
        for each in stages
    ]


def described_option(option: dict[str, Any]) -> Option:
    """An option under its name in Python."""
    return Option(**{**option, "name": option["name"].replace("-", "_")})


def call(
    stage: Stage,
    given: object = None,
    /,
    *,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    **options: object,
) -> Result:
    """Runs a stage on tables and files."""
    if stage.input is not None and given is not None:
        options[stage.input.name] = given
    words = {flag(name): value for name, value in options.items() if value is not None}
    folder = None
    if out is not None:
        words["out"] = out
    elif stage.makes_table:
        folder = Path(tempfile.mkdtemp(prefix="rockfrag."))
        words["out"] = folder / f"{stage.command}.parquet"
    if threads is not None:
        words["threads"] = threads
    files = {flag(option.name): option for option in stage.options if option.kind in ("input", "folder", "fits")}
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as scratch, contextlib.ExitStack() as failed:
        if folder is not None:
            failed.callback(shutil.rmtree, folder)
        for name, option in files.items():
            table: Any = words.get(name)
            if type(table).__name__ == "LazyFrame":
                words[name] = table.collect()
            if hasattr(words.get(name), "__arrow_c_stream__"):
                words[name] = written(words[name], Path(scratch, name), option)
            elif name in words:
                expect_path(name, words[name])
        with errors_without(scratch):
            made = _rockfrag.call(
                stage.command,
                json.dumps({name: plain(value) for name, value in words.items()}, allow_nan=False),
                threads,
                progress,
            )
        # Where warnings are errors, the folder goes.
        done = result(made, folder)
        failed.pop_all()
    return done


@contextlib.contextmanager
def errors_without(folder: str) -> Iterator[None]:
    """Errors do not name the temporary folder of a table that was given without a path."""
    try:
        yield
    except (_rockfrag.Error, ValueError, FileNotFoundError) as error:
        raise type(error)(str(error).replace(f"{folder}{os.sep}", "")) from None


def flag(name: str) -> str:
    """``limit-state`` of ``limit_state``, and ``from`` of ``from_``."""
    return name.removesuffix("_").replace("_", "-")


def result(made: tuple[str, list[Path], str, list[str]], folder: Path | None = None) -> Result:
    """What came of a stage that is done."""
    stage, paths, summary, texts = made
    warn(texts)
    return Result(stage, paths[-1] if paths else None, summary, texts, folder)


def warn(texts: Iterable[str]) -> None:
    """Makes each a warning of Python, at the line that called the package."""
    level = 1
    while sys._getframe(level).f_globals.get("__package__") == __package__:
        level += 1
    for text in texts:
        warnings.warn(text, stacklevel=level + 1)


def written(table: Any, path: Path, option: Option) -> Path:
    """The file of a table: a result has one, others are written to one."""
    if isinstance(table, Result):
        return table._table()
    path = path.with_suffix(f".{option.formats[0] if option.formats else 'parquet'}")
    _rockfrag.write_table(table.__arrow_c_stream__(), path)
    return path


def expect_path(name: str, value: Any) -> None:
    """A table that is not one would be taken for a path, and printed whole."""
    paths = value if isinstance(value, (list, tuple)) else [value]
    if not all(isinstance(path, (str, os.PathLike)) for path in paths):
        expected = "expected a table of polars, pandas, pyarrow or DuckDB, or the path of a file"
        raise TypeError(f"{'input' if name == 'in' else name} is a {type(value).__name__}; {expected}")


def plain(value: Any) -> Any:
    """A value as JSON has it."""
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, Mapping):
        return {name: plain(item) for name, item in value.items()}
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Iterable):
        return [plain(item) for item in value]
    raise TypeError(
        f"{value!r} is not a valid option value; expected a number, a string, a path, a list or a mapping"
    )


def line(option: Option) -> str:
    """An option with its default and meaning, on one line."""
    default = " = False" if option.kind == "flag" else f" = {option.default}" if option.default else ""
    return textwrap.shorten(f"{option.name}{default}: {option.help}", WIDTH, placeholder=" ...")


def docstring(stage: Stage) -> str:
    """The help of a stage: a line an option."""
    first = [line(stage.input._replace(name="input"))] if stage.input else []
    temporary = "out" if stage.makes_table else ""
    named = [o._replace(default="temporary") if o.name == temporary else o for o in stage.named]
    common = "threads, force, config, progress: as of all stages; progress(done, total) is called as it runs"
    return "\n".join([textwrap.fill(f"{stage.help}.", WIDTH), "", *first, *map(line, named), common])


def function(stage: Stage) -> Callable[..., Result]:
    """The function of a stage."""

    def run(*given: object, **options: Any) -> Result:
        if len(given) > (stage.input is not None):
            raise TypeError(
                f"{stage.name}() takes {int(stage.input is not None)} table, {len(given)} were given"
            )
        return call(stage, *given, **options)

    given = [Parameter("input", Parameter.POSITIONAL_ONLY, default=None)] if stage.input else []
    signature = Signature([*given, Parameter("options", Parameter.VAR_KEYWORD)], return_annotation=Result)
    run.__name__ = run.__qualname__ = stage.name
    run.__module__ = "rockfrag"
    run.__doc__ = docstring(stage)
    run.__signature__ = signature  # type: ignore[attr-defined]
    return run


def stub() -> str:
    """The functions with all their options, for editors and type checkers; the wheel has it as ``_stages.pyi``."""
    text = ["from os import PathLike", "from typing import Any, Callable", "from ._result import Result", ""]
    for stage in described():
        options = [f"{option.name}: {'bool' if option.kind == 'flag' else 'Any'} = ..." for option in stage.named]
        options += [
            "threads: int | None = ...",
            "force: bool = ...",
            "config: str | PathLike[str] | None = ...",
        ]
        options += ["progress: Callable[[int, int], object] | None = ..."]
        given = ["input: Any = ...", "/"] if stage.input else []
        text += (
            [f"def {stage.name}("] + [f"    {word}," for word in [*given, "*", *options]] + [") -> Result:"]
        )
        text += [textwrap.indent(f'"""{docstring(stage)}"""', "    "), ""]
    return "\n".join(text)


functions = {stage.name: function(stage) for stage in described()}
