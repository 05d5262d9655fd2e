"""What arguments may be."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, Union

#: A path, or a table that speaks Arrow.
TableLike = Any
PathLike = Union[str, "os.PathLike[str]"]
#: Takes the number of steps done and of all.
Progress = Callable[[int, int], Any]
