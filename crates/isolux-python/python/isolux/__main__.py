"""The command: ``python -m isolux``."""

import signal
import sys

from isolux import _native


def main() -> int:
    """Run the command with the arguments of this process, to its exit code."""
    # The command catches Ctrl-C where it has something to keep; elsewhere it ends at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(["isolux", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
