"""What can go wrong. Every message names the file or table, the row and the column, and says what was expected."""

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
    """Anything that rockfrag refuses to do or fails at."""


class OptionError(RockfragError, ValueError):
    """An option is unknown, out of range, or does not go with another."""


class TableError(RockfragError, ValueError):
    """A table lacks a column or rows, or holds a value that cannot be used."""


class FitError(RockfragError, ValueError):
    """There is no curve to be had of the data. ``status`` is the word that the tables of fits have for the reason."""

    def __init__(self, message: str, status: str = "") -> None:
        super().__init__(message)
        self.status = status


class FileError(RockfragError, OSError):
    """A file cannot be read or written."""


class MissingFileError(FileError, FileNotFoundError):
    """A file is not there."""


class RockfragWarning(UserWarning):
    """A result to be looked at twice: a fit that failed, an intensity outside of the data."""
