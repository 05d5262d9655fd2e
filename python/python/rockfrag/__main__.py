"""The ``rockfrag`` command, in this process: the same words, files, messages and exit codes as the program."""

from __future__ import annotations

import signal
import sys

from ._rockfrag import command


def main() -> int:
    """Does what the command line says.

    Returns
    -------
    int
        The code to exit with: 0 done, 1 a failure, 2 a mistake in the call.
    """
    # Ctrl-C ends the program as it ends any other, not when Python is back.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return command(["rockfrag", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
