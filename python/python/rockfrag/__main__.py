"""The ``rockfrag`` command: the same words, files, messages and exit codes as the program."""

import os
import signal
import sys

from ._rockfrag import command


def main() -> int:
    # Ctrl-C ends the program as it ends any other.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    # As in main.rs.
    os.environ["POLARS_MAX_THREADS"] = "1"
    return int(command(["rockfrag", *sys.argv[1:]]))


if __name__ == "__main__":
    sys.exit(main())
