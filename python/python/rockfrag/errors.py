"""What can go wrong. Every message names the file or table, the row and the column, and says what was expected."""

__all__ = [
    "FileError",
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


class FileError(RockfragError, OSError):
    """A file cannot be read or written."""


class MissingFileError(FileError, FileNotFoundError):
    """A file is not there."""


class RockfragWarning(UserWarning):
    """A result to be looked at twice: a fit that failed, an intensity outside of the data."""
