"""Options on their way to the library, which checks them: the names and words of the command line."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from typing import Any

from ._types import PathLike, Progress


def to_json(options: Mapping[str, Any]) -> str:
    """Options that are given, under the names that they have on the command line."""
    return json.dumps({_kebab(name): _plain(value) for name, value in options.items()})


def structure(given: Mapping[str, Any]) -> dict[str, Any]:
    """One structure by the names of the command line."""
    return {_kebab(name): _plain(value) for name, value in given.items() if value is not None}


def settings(threads: int | None, progress: Progress | None, force: bool | None, overwrite: bool | None) -> dict[str, Any]:
    """The settings of a call."""
    if threads is not None and threads < 1:
        from .errors import OptionError

        raise OptionError(f"threads is {threads}; expected 1 or more")
    return {"threads": threads, "progress": progress, "force": bool(force), "overwrite": bool(overwrite)}


def path(out: PathLike | None) -> str | None:
    """A path as text, with the slash at its end that makes it a folder."""
    return None if out is None else os.fspath(out)


def _kebab(name: str) -> str:
    return name.rstrip("_").replace("_", "-")


def _plain(value: Any) -> Any:
    """What JSON knows: text, numbers, lists of text, and structures, of which one is a list too."""
    if value is None or isinstance(value, (str, bool, int, float)):
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, Mapping):
        return [structure(value)]
    if hasattr(value, "item") and getattr(value, "ndim", 0) == 0:
        return value.item()
    if isinstance(value, Iterable):
        return [structure(one) if isinstance(one, Mapping) else str(_plain(one)) for one in value]
    raise TypeError(f"{value!r} is no option; expected text, numbers or lists of them")
