"""Runs."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from contextlib import ExitStack
from typing import Any

from isolux._arguments import checked, kinds_of, look
from isolux._call import Call, Increment, Path, with_unit, words
from isolux._errors import wrong
from isolux._map import Map
from isolux._progress import Progress, Shown
from isolux._scene import Scene, as_scene


@checked
def solve(
    scene: Scene | Path,
    *,
    accuracy: float | str | None = None,
    quality: str | None = None,
    mesh_accuracy: float | str | None = None,
    method: str = "hybrid",
    time_limit: float | str | None = None,
    seed: int = 1,
    threads: int | None = None,
    filter: bool = True,
    audit: bool = True,
    max_memory: int | str | None = None,
    progress: bool = True,
    callback: Callable[[Progress], object] | None = None,
    output: Path | None = None,
    resume: bool = False,
    cache: Path | None = None,
    group: bool = False,
    layout: str | None = None,
    texels_per_meter: float | None = None,
    form_factor_tolerance: float | None = None,
    unshot: float | None = None,
    max_receivers: int | None = None,
    min_element: float | str | None = None,
    ambient: bool = True,
    diffuse_only: bool = False,
    _increment: Increment | None = None,
) -> Map:
    """Compute the illumination map of a scene, as ``isolux solve`` does: same names, same meanings, same bytes.

    ``scene``: a :class:`Scene`, or what :func:`load` reads. ``accuracy``: stop when the whole error of the scene is this small: 0.01
    (unless given) or ``"1%"``; or ``quality``, a name for one: ``"draft"``, ``"medium"``, ``"high"``, ``"production"``. ``mesh_accuracy``: the error of
    the interpolated map that elements are subdivided for, 0.05 unless given. ``method``: ``"hybrid"``, ``"forward"``, ``"cache"``,
    ``"radiosity"``. ``time_limit``: seconds, or ``"5min"``, after which the run stops with a valid map. ``seed``: the same seed gives the
    same bits, whatever ``threads`` is. ``filter``: reduce noise where there is nothing else. ``audit``: test the map by paths.
    ``max_memory``: bytes, or ``"8GiB"``.

    ``progress``: show a bar on standard error. ``callback``: gets a :class:`Progress` at every increment, which waits for it; ``False``
    ends the run, an exception ends it and is raised. Ctrl-C ends it, too. However it ends, the result is the best map there is, and
    ``Map.complete`` tells whether the accuracy is reached. A second Ctrl-C raises ``KeyboardInterrupt`` at once. Other threads of
    Python go on meanwhile.

    ``output``: write the map to this .glb, and the state of an unfinished run beside it, from which ``resume=True`` goes on. Without it
    no file is left. ``cache``: the file of samples of ``method="cache"``. ``group``: solve every group of luminaires by itself, see
    ``Map.groups`` and ``Map.mix``. ``layout="texels"``: bake a lightmap into the output. The others are for ``method="radiosity"``;
    ``min_element`` is in metres.
    """
    scene = as_scene(scene)
    flags = flags_of(
        accuracy=accuracy,
        quality=quality,
        mesh_accuracy=mesh_accuracy,
        method=method,
        time_limit=time_limit,
        seed=seed,
        threads=threads,
        filter=filter,
        audit=audit,
        max_memory=max_memory,
        resume=resume,
        cache=cache,
        group=group,
        layout=layout,
        texels_per_meter=texels_per_meter,
        form_factor_tolerance=form_factor_tolerance,
        unshot=unshot,
        max_receivers=max_receivers,
        min_element=min_element,
        ambient=ambient,
        diffuse_only=diffuse_only,
    )
    shown = Shown(progress, callback)
    with ExitStack() as stack:
        stack.callback(shown.close)
        if output is None:
            if resume:
                raise wrong("resume: there is no output to go on from; give its name")
            folder = stack.enter_context(tempfile.TemporaryDirectory(prefix="isolux-"))
            path = os.path.join(folder, "map.glb")
        else:
            path = os.fspath(output)
        given = [(scene._source, scene._native)]
        call = Call(shown, _increment).run(
            ["solve", *flags, "-o", path, "--", scene._source],
            given,
            waits=callback is not None,
        )
    return _made(call, path if output is not None else scene.name)


def flags_of(**options: Any) -> list[str]:
    """Options of :func:`solve` in the words of the command."""
    look(_KINDS, options)
    for name, unit in (("time_limit", "s"), ("min_element", "m")):
        options[name] = with_unit(options.get(name), unit)
    for name in ("filter", "audit", "ambient"):
        options[f"no_{name}"] = not options.pop(name, True)
    if options.get("max_memory") is not None and not isinstance(options["max_memory"], str):
        options["max_memory"] = f"{options['max_memory']}B"
    return words(**options)


_KINDS = kinds_of(solve)


def _made(call: Call, name: str) -> Map:
    """The map of a run, with those of its groups."""
    if not call.maps:
        raise KeyboardInterrupt
    groups = call.report.get("groups", []) if call.report else []
    made = Map(call.maps[-1][1], name, call)
    for report, (path, native) in zip(groups, call.maps):
        made.groups[report["group"]] = Map(native, path)
    return made
