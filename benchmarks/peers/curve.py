"""Error against time: how long a renderer needs for an error."""

import math
from dataclasses import dataclass

# Beyond its last run a curve is followed until the error has fallen by this factor, no further.
REACH = 2.0
# No faster than independent samples: the error falls with the root of time.
STEEPEST = 0.5


@dataclass(frozen=True)
class Reached:
    """The time for an error: `<` where the cheapest run was already better, `~` where the curve was
    followed beyond its last run, else nothing."""

    time_s: float
    mark: str


def front(runs):
    """Of (time, error) pairs those that none beats in both, by time."""
    kept = []
    for time_s, error in sorted(runs):
        if not kept or error < kept[-1][1]:
            kept.append((time_s, error))
    return kept


def reached(runs, level):
    """The time at which the error is `level`, on straight lines of the logarithms; None if never."""
    best = front(runs)
    if not best:
        return None
    if best[0][1] <= level:
        return Reached(best[0][0], "<" if best[0][1] < level else "")
    for (t0, e0), (t1, e1) in zip(best, best[1:]):
        if e1 <= level:
            way = math.log(e0 / level) / math.log(e0 / e1)
            return Reached(t0 * (t1 / t0) ** way, "")
    return beyond(best, level)


def beyond(best, level):
    """Past the last run."""
    time_s, error = best[-1]
    if len(best) < 2 or error > REACH * level:
        return None
    (t0, e0) = best[-2]
    slope = min(STEEPEST, math.log(e0 / error) / math.log(time_s / t0))
    return Reached(time_s * (error / level) ** (1.0 / slope), "~")
