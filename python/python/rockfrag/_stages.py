"""Every stage of the command as a function; the stub of them is made when the wheel is built."""

from ._bridge import functions

globals().update(functions)
__all__ = list(functions)
