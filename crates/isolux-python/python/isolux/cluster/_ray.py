"""Ray: who starts it, and how much of it there is."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


def ray() -> Any:
    """The module."""
    # Nothing is sent to anybody unless the user has asked for it.
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    try:
        import ray
    except ImportError as missing:
        text = "isolux.cluster needs Ray: pip install isolux[cluster]"
        raise ImportError(text) from missing
    return ray


@contextmanager
def connected(address: str | None, cpus: int | None) -> Iterator[Any]:
    """A cluster: the one that the program is connected to already, the one at the address, or one of this machine with so many
    processors, which ends with the work."""
    module = ray()
    if module.is_initialized():
        yield module
        return
    options: dict[str, Any] = {"log_to_driver": False, "logging_level": "warning"}
    if address is not None or "RAY_ADDRESS" in os.environ:
        options["address"] = address
    else:
        options |= {"num_cpus": cpus, "include_dashboard": False}
    module.init(**options)
    try:
        yield module
    finally:
        module.shutdown()


def slots(module: Any, cpus: float) -> int:
    """How many tasks of so many processors the cluster can do at once, now."""
    return max(1, int(module.cluster_resources().get("CPU", 0.0) // cpus))
