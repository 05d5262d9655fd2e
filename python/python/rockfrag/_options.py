"""Options on their way to the library, which checks them: the names and words of the command line."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ._types import PathLike, Progress, Steps


def to_json(**options: Any) -> str:
    """Options that are given, under the names that they have on the command line."""
    given = {name.replace("_", "-"): value for name, value in options.items() if value is not None}
    return json.dumps(given, default=_plain)


def steps(values: Steps | None) -> str | None:
    """Numbers as the command line has them."""
    if values is None or isinstance(values, str):
        return values
    each = values if isinstance(values, Iterable) else [values]
    return ",".join(repr(float(value)) for value in each)


def several(values: str | Iterable[Any]) -> list[str]:
    """Words, or text of words parted by commas."""
    return values.split(",") if isinstance(values, str) else [str(value) for value in values]


def structures(given: PathLike | Mapping[str, Any] | Iterable[Mapping[str, Any]] | None) -> Any:
    """Structures as a file, or as a list of their parameters."""
    if given is None:
        return None
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given)
    return [structure(one) for one in ([given] if isinstance(given, Mapping) else given)]


def structure(given: Mapping[str, Any]) -> dict[str, Any]:
    """One structure by the names of the command line."""
    return {name.replace("_", "-"): value for name, value in given.items() if value is not None}


def manner(threads: int | None, progress: Progress | None, force: bool) -> dict[str, Any]:
    """How a call is run."""
    if threads is not None and threads < 1:
        from .errors import OptionError

        raise OptionError(f"threads is {threads}; expected 1 or more")
    return {"threads": threads, "progress": progress, "force": force}


def path(out: PathLike | None) -> str | None:
    """A path as text, with the slash at its end that makes it a folder."""
    return None if out is None else os.fspath(out)


def _plain(value: Any) -> Any:
    if isinstance(value, Path):
        return str(value)
    if hasattr(value, "item"):
        return value.item()
    raise TypeError(f"{value!r} is no option; expected text, numbers or lists of them")
