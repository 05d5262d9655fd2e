"""From a call of Python to the parser of the command, and from its options to functions with help."""

from __future__ import annotations

import contextlib
import json
import os
import re
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
#: Options of lists and curves as people keep them, which are text.
LISTS = ("about", "hazard", "site", "structures")


class Option(NamedTuple):
    """An option of a stage, as the command describes it."""

    name: str
    #: flag, value, or of paths: input, output.
    kind: str
    #: float, int, path, text, or a list of the words that it may be; whether it takes several.
    type: str | list[str]
    many: bool
    default: str
    help: str
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
        return self.command not in ("export", "report")

    @property
    def named(self) -> list[Option]:
        own = [option for option in self.options if not option.common and option is not self.input]
        return [o._replace(name=f"{o.name}_") if o.name in RESERVED else o for o in own]


def described() -> list[Stage]:
    """All stages, in the order of a run."""
    stages = json.loads(_rockfrag.describe())
    return [Stage(each["name"], each["help"], [Option(**option) for option in each["options"]]) for each in stages]


def call(
    stage: Stage,
    /,
    *given: object,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: bool | Callable[[int, int], object] | None = None,
    **options: object,
) -> Result:
    """Runs a stage on tables and files."""
    if len(given) > (stage.input is not None):
        raise TypeError(f"{stage.name}() takes {int(stage.input is not None)} table, {len(given)} were given")
    if stage.input is not None and given:
        options[stage.input.name] = given[0]
    folder = Path(tempfile.mkdtemp(prefix="rockfrag.")) if stage.makes_table and out is None else None
    options["out"] = folder / f"{stage.command}.parquet" if folder else out
    words = {flag(name): value for name, value in options.items() if value is not None}
    with tempfile.TemporaryDirectory(prefix="rockfrag.") as scratch, contextlib.ExitStack() as failed:
        if folder is not None:
            failed.callback(shutil.rmtree, folder)
        for option in stage.options:
            name = flag(option.name)
            if option.kind == "input" and name in words:
                words[name] = file_of(words[name], Path(scratch, name), option)
        with errors_without(scratch):
            try:
                text = json.dumps(words, allow_nan=False, default=plain)
            except ValueError:
                raise ValueError(f"{stage.name}: an option is NaN or infinite; expected finite numbers") from None
            made = _rockfrag.call(stage.command, text, threads, teller(stage.name, progress))
        # Where warnings are errors, the folder goes.
        done = result(made, folder)
        failed.pop_all()
    return done


#: What is called as a stage runs, with the steps done and all.
Told = Callable[[int, int], object]


def teller(name: str, progress: bool | Told | None) -> Told | None:
    """What is called as a stage runs; of ``True`` a line on stderr that counts."""

    def count(done: int, total: int) -> None:
        end = "\n" if done == total > 0 else ""
        print(f"\r{name}: {done:,} of {total:,}", end=end, file=sys.stderr, flush=True)

    return count if progress is True else progress or None


@contextlib.contextmanager
def errors_without(folder: str) -> Iterator[None]:
    """Errors name the argument of a table that was given without a path, not its temporary file."""
    try:
        yield
    except (_rockfrag.Error, ValueError, FileNotFoundError) as error:
        text = re.sub(re.escape(f"{folder}{os.sep}") + r"([\w-]+)\.(parquet|csv)", r"\1", str(error))
        raise type(error)(re.sub(r"\bin: ", "input: ", text) if text != str(error) else text) from None


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


def file_of(table: Any, path: Path, option: Option) -> object:
    """The file of a table: a result has one, others are written to one; a path stays."""
    if isinstance(table, Result):
        return table._table()
    if type(table).__name__ == "LazyFrame":
        table = table.collect()
    if hasattr(table, "__arrow_c_stream__"):
        path = path.with_suffix(".csv" if option.name in LISTS else ".parquet")
        _rockfrag.write_table(table.__arrow_c_stream__(), path)
        return path
    paths = table if isinstance(table, (list, tuple)) else [table]
    if not all(isinstance(path, (str, os.PathLike)) for path in paths):
        # It would be taken for a path, and printed whole.
        expected = "expected a table of polars, pandas, pyarrow or DuckDB, or the path of a file"
        name = "input" if option.name == "in" else option.name
        raise TypeError(f"{name} is a {type(table).__name__}; {expected}")
    return table


def plain(value: Any) -> object:
    """A value that JSON does not know, as one that it knows."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return dict(value)
    if isinstance(value, Iterable):
        return list(value)
    raise TypeError(
        f"{value!r} is not a valid option value; expected a number, a string, a path, a list or a mapping"
    )


def line(option: Option) -> str:
    """An option with its default and meaning."""
    default = " = False" if option.kind == "flag" else f" = {option.default}" if option.default else ""
    return listed([(f"{option.name}{default}", option.help)])


def listed(helps: Iterable[tuple[str, str]]) -> str:
    """Names with their whole help, wrapped."""
    texts = (" ".join(f"{name}: {help}".split()) for name, help in helps)
    wrap = textwrap.TextWrapper(WIDTH, subsequent_indent="    ", break_on_hyphens=False)
    return "\n".join(map(wrap.fill, texts))


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
        return call(stage, *given, **options)

    given = [Parameter("input", Parameter.POSITIONAL_ONLY, default=None)] if stage.input else []
    signature = Signature([*given, Parameter("options", Parameter.VAR_KEYWORD)], return_annotation=Result)
    run.__name__ = run.__qualname__ = stage.name
    run.__module__ = "rockfrag"
    run.__doc__ = docstring(stage)
    run.__signature__ = signature  # type: ignore[attr-defined]
    return run


def type_of(option: Option) -> str:
    """What an option takes, for type checkers. Angles may have a unit, a target has its percent sign."""
    plain = {"float": "float", "int": "int", "path": "Path", "text": "Any"}
    one = plain[option.type] if isinstance(option.type, str) else f"Literal{option.type}"
    one = {"eta": "float | Literal['housner']", "wall": "bool | float | Literal['yes']"}.get(option.name, one)
    one = "bool" if option.kind == "flag" or option.name.startswith("fixed_to") else one
    one = f"{one} | str" if option.name in ("alpha", "alpha_sd", "target") else one
    one = "Any" if option.kind == "input" else one
    return f"{one} | Sequence[{one}]" if option.many and one != "Any" else one


def stub() -> str:
    """The functions with all their options, for editors and type checkers; the wheel has it as ``_stages.pyi``."""
    common = ["threads: int | None = ...", "force: bool = ...", "config: Path | None = ..."]
    common.append("progress: bool | Callable[[int, int], object] | None = ...")
    text = "from collections.abc import Sequence\nfrom os import PathLike\n"
    text += "from typing import Any, Callable, Literal, TypedDict\nfrom ._result import Result\n\n"
    text += "Path = str | PathLike[str]\n"
    stages = described()
    types = {option.name: type_of(option) for stage in stages for option in stage.named}
    text += "\nclass Fields(TypedDict, total=False):\n    name: str\n    count: int\n"
    text += "".join(f"    {name}: {types.get(name, 'float')} | None\n" for name, _ in _rockfrag.fields())
    for stage in stages:
        own = [f"{option.name}: {type_of(option)} | None = ..." for option in stage.named]
        given = ["input: Any = ...", "/"] if stage.input else []
        words = ", ".join([*given, "*", *own, *common])
        help = textwrap.indent(f'''"""{docstring(stage)}"""''', "    ")
        text += f"\ndef {stage.name}({words}) -> Result:\n{help}\n"
    return text


functions = {stage.name: function(stage) for stage in described()}
