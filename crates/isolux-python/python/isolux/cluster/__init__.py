"""Runs and studies on many machines, by Ray: ``pip install isolux[cluster]``.

    m = isolux.cluster.solve("room.toml", accuracy=0.001)                     # on all processors of this machine
    m = isolux.cluster.solve("room.toml", accuracy=0.001, address="auto")     # on the cluster that this machine is part of
    table = isolux.cluster.study(measure, [{"x": x} for x in range(100)])

The map is, byte by byte, that of :func:`isolux.solve`, whatever workers there are, and whichever of them are lost on the way.
"""

from isolux.cluster._solve import solve
from isolux.cluster._study import Table, study

__all__ = ["Table", "solve", "study"]
