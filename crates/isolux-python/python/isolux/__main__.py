"""The command: ``python -m isolux``."""

import signal
import sys

from isolux import _native


def main() -> int:
    """Run the command with the arguments of this process, to its exit code."""
    if sys.argv[1:2] == ["cluster"]:
        from isolux.cluster._command import main as cluster

        return cluster(sys.argv[2:])
    # The command catches Ctrl-C where it has something to keep; elsewhere it ends at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(["isolux", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
