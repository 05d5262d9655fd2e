"""Exceptions and warnings. Every message names the argument, file, row or column, what was found, and what was expected."""

__all__ = [
    "FileError",
    "FitError",
    "MissingFileError",
    "OptionError",
    "RockfragError",
    "RockfragWarning",
    "TableError",
]


class RockfragError(Exception):
    """The base of all errors of rockfrag."""


class OptionError(RockfragError, ValueError):
    """An argument has a wrong type, is out of range, or does not go with another."""


class TableError(RockfragError, ValueError):
    """A table lacks a column, has no rows, or holds a value that cannot be used."""


class FitError(RockfragError, ValueError):
    """The data give no curve. ``status`` is the reason, in the word of the tables of fits: ``too_few_events``, ``separated`` and so on."""

    def __init__(self, message: str, status: str = "") -> None:
        super().__init__(message)
        self.status = status


class FileError(RockfragError, OSError):
    """A file cannot be read or written."""


class MissingFileError(FileError, FileNotFoundError):
    """A file does not exist."""


class RockfragWarning(UserWarning):
    """A result is doubtful: a fit that failed, an intensity outside of the data."""
