"""Illumination maps."""

from __future__ import annotations

import numbers
import os
import tempfile
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux import _native
from isolux._arguments import Point, at_least, checked, misfit
from isolux._call import Call, Path, repeated, with_unit, word, words
from isolux._errors import public, wrong
from isolux._grid import Grid, grids
from isolux._readings import Array, Readings, fixed, places, readings
from isolux._report import Reported
from isolux._scene import Scene
from isolux._view import FINER_S, HEIGHT, View

Given = list[tuple[str, _native.Scene | _native.Map]]


@public
class Map(Reported):
    """An illumination map: the illuminance on every surface of a scene, with its standard error. It does not change.

    Made by :func:`isolux.solve`, :func:`isolux.open_map` or :func:`isolux.mix`. Arrays are copied from the map on first use, as the
    map keeps them otherwise; then all share the copy, which is read-only.
    """

    def __init__(self, native: _native.Map, name: str, call: Call | None = None) -> None:
        self._native = native
        self._name = name
        #: What ``isolux solve --json`` prints of the run, if this is its result.
        self.report: Any = call.report if call else None
        #: What the run or the reader had to warn of.
        self.warnings: list[str] = list(call.warnings) if call else []
        #: What else the run told.
        self.notes: list[str] = list(call.notes) if call else []
        #: The maps of groups of luminaires that this is the sum of, by name, after ``solve(group=True)``.
        self.groups: dict[str, Map] = {}

    @property
    def complete(self) -> bool:
        """Whether the accuracy that was asked for is reached."""
        return self._native.complete

    @property
    def accuracy(self) -> float | None:
        """The reported error of the scene, a share: 0.01 is 1 %. ``None`` where it is not known."""
        return self._native.accuracy_reached

    @property
    def increments(self) -> int:
        """Increments of the run: independent replicates, but for radiosity."""
        return self._native.increments

    @property
    def receivers(self) -> int:
        """How many vertices there are."""
        return self._native.receivers

    @cached_property
    def scene(self) -> Scene:
        """The scene in the map."""
        return Scene(self._native.scene(), self._name)

    @cached_property
    def vertices(self) -> Array:
        """Positions of vertices: (n, 3), in metres, in the axes of the scene."""
        return fixed(self._native.vertices())

    @cached_property
    def normals(self) -> Array:
        """Normals of vertices: (n, 3), on the side that receives the light."""
        return fixed(self._native.normals())

    @cached_property
    def areas_m2(self) -> Array:
        """The area that every vertex stands for: (n,), in m2."""
        return fixed(self._native.areas())

    @cached_property
    def _elements(self) -> tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any]]:
        vertices, triangles, backs = self._native.elements()
        return fixed(vertices), fixed(triangles), fixed(backs)

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """Vertices of the elements: (k, 3), counter-clockwise seen from the front of the scene's triangle, on backs, too."""
        return self._elements[0]

    @property
    def scene_triangles(self) -> npt.NDArray[np.uint32]:
        """The triangle of the scene that each element is part of: (k,)."""
        return self._elements[1]

    @property
    def backs(self) -> npt.NDArray[np.bool_]:
        """Whether each element is on the back of that triangle: (k,)."""
        return self._elements[2]

    @cached_property
    def values(self) -> Readings:
        """The light at the vertices: (n,) :data:`isolux.READING`, interpolated as viewers show it; ``nan`` where nothing is known."""
        found = readings(self._native.values())
        found.setflags(write=False)
        return found

    @checked
    def probe(
        self,
        points: npt.ArrayLike,
        normals: npt.ArrayLike = (0.0, 0.0, 1.0),
        *,
        exact: bool = False,
        interpolated: bool = False,
    ) -> Readings:
        """Read illuminances at points, as ``isolux probe`` does.

        ``points``: (n, 3) in metres, in the axes of the scene. ``normals``: (n, 3), or one for all, the way a luxmeter faces, of any
        length. Returns (n,) :data:`isolux.READING`; ``.frame`` is a table of pandas. ``nan`` is not known, 0 is known and dark.

        ``exact``: estimate every point afresh, in free space, too: slower. ``interpolated``: the map as a viewer shows it.
        """
        if exact and interpolated:
            raise wrong("exact and interpolated exclude each other; leave one out")
        way = "exact" if exact else "interpolated" if interpolated else "probe"
        call = Call()
        rows = self._native.readings(self._name, places(points, normals), way, call)
        call.pass_on()
        return readings(rows)

    @checked
    def grid(
        self,
        name: str | None = None,
        *,
        height: float | None = None,
        corner: Point | None = None,
        u: Point | None = None,
        v: Point | None = None,
        spacing: float | None = None,
        border: float | None = None,
        maintenance_factor: float | None = None,
        quantity: str | None = None,
        facing: float | None = None,
        require: str | Sequence[str] = (),
        picture: Path | None = None,
        csv: Path | None = None,
    ) -> Grid:
        """The illuminance on one calculation grid, with the figures of a lighting report.

        The grid is one of the scene by its ``name`` (which may be left out if there is one), a working plane over all of the floor
        plan at a ``height``, or given by a ``corner`` and its sides ``u`` and ``v``, facing u x v. Lengths are metres. ``spacing`` is
        that of EN 12464-1 unless given; ``border`` is the band along the sides that is left out. ``maintenance_factor`` is the share
        of the initial light that is left. ``quantity`` is ``illuminance`` unless given, else ``cylindrical``, ``semi-cylindrical``
        (which looks the way of ``facing``, degrees from x by the left in plan), ``hemispherical`` or ``modelling``. ``require`` is what has to hold: ``"Em >= 500, U0 >= 0.6"``, ``"EN 12464-1 34.2"``; what came
        of it is in ``requirements`` of the grid. ``picture`` (.png, .svg) gets a plan with the values, ``csv`` all points.
        """
        own = height is not None or corner is not None
        if name is None and not own and len(self.scene.grids) > 1:
            known = ", ".join(repr(known) for known in self.scene.grids)
            raise wrong(f"the scene has several grids; choose one of {known}, or use grids()")
        flags = words(
            name=name,
            height=height,
            corner=corner,
            u=u,
            v=v,
            spacing=spacing,
            border=border,
            maintenance_factor=maintenance_factor,
            quantity=quantity,
            facing=facing,
            picture=picture,
            csv=csv,
        )
        return grids(self._run("grid", flags + repeated("require", require)).report)[0]

    @checked
    def grids(
        self, *, maintenance_factor: float | None = None, require: str | Sequence[str] = ()
    ) -> list[Grid]:
        """The illuminance on all calculation grids of the scene; see :meth:`grid`. ``require``: of one, ``"desks: Em >= 500"``, or of all."""
        flags = words(maintenance_factor=maintenance_factor)
        return grids(self._run("grid", flags + repeated("require", require)).report)

    @checked
    def glare(
        self,
        *,
        cameras: Sequence[str] = (),
        eye: Point | None = None,
        target: Point | None = None,
        metric: str = "ugr",
        threshold: float | str | None = None,
        grids: str | Sequence[str] = (),
        directions: Sequence[Point] = (),
        eye_height: float | None = None,
        limit: float | None = None,
        csv: Path | None = None,
    ) -> Any:
        """The glare of observers: the object that ``isolux glare --json`` prints, with ``["observers"]`` or ``["grids"]``.

        Observers are the ``cameras`` of these names (all unless given), an ``eye`` that looks at a ``target``, or eyes at all points of
        ``grids``. ``metric``: ``"ugr"``, the unified glare rating of luminaires (CIE 117), or ``"dgp"``, the daylight glare probability,
        for which what is brighter than ``threshold`` glares: cd/m2, 2000 unless given, or ``"5x"`` the mean. On grids eyes are at
        ``eye_height``, 1.2 m above the floor unless given, look along their sides, or ``directions``, and keep a ``limit``, 19 unless
        given; ``csv`` gets all views.
        """
        flags = words(
            eye=eye,
            target=target,
            metric=metric,
            threshold=threshold,
            eye_height=eye_height,
            limit=limit,
            csv=csv,
        )
        flags += repeated("camera", cameras) + repeated("grid", grids)
        return self._run("glare", flags + repeated("direction", directions)).report

    @checked
    def render(
        self,
        camera: str | None = None,
        *,
        eye: Point | None = None,
        target: Point | None = None,
        up: Point | None = None,
        fov: float | None = None,
        panorama: bool = False,
        width: int = 1280,
        height: int = 720,
        luminance: bool = False,
        false_colour: bool = False,
        limits: tuple[float, float] | None = None,
        logarithmic: bool = False,
        contours: bool = False,
        exposure: str | None = None,
        tone: str | None = None,
        white: str | None = None,
        profile: str | None = None,
        interpolated: bool = False,
        picture_accuracy: float | None = None,
    ) -> npt.NDArray[Any]:
        """Draw a view, as ``isolux render`` does.

        From a ``camera`` of the scene, or from an ``eye`` that looks at a ``target`` (x, y, z, in metres), with ``fov`` degrees from
        the lower to the upper edge; without both from a place inside where most is seen.

        Returns (height, width, 3) uint8, rows from the top: a picture in sRGB (or ``profile``), with ``false_colour`` colours that
        stand for lux with a legend beside them, which makes it wider. With ``luminance``, (height, width, 3) float32 in cd/m2: linear
        Rec. 709, of which 0.2126, 0.7152 and 0.0722 add up to the luminance.

        ``limits``: lux of the first and the last false colour; ``logarithmic``, ``contours``: how they are spread, and lines.
        ``exposure``, ``tone``, ``white``: how luminance becomes a picture, in the words of the command: ``exposure="ev8"``,
        ``white="2700K"``. ``interpolated``: the map as a viewer shows it, fast. ``picture_accuracy``: the noise that the picture may
        have, CIE94; 0.5 unless given.
        """
        if luminance and false_colour:
            raise wrong("luminance and false_colour exclude each other; leave one out")
        at_least(1, width=width, height=height)
        flags = words(
            camera=camera,
            eye=eye,
            target=target,
            up=up,
            fov=fov,
            panorama=panorama,
            size=f"{width}x{height}",
            false_colour=false_colour,
            limits=None if limits is None else ":".join(map(word, limits)),
            logarithmic=logarithmic,
            contours=contours,
            exposure=exposure,
            tone=tone,
            white=white,
            profile=profile,
            interpolated=interpolated,
            picture_accuracy=picture_accuracy,
        )
        with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
            file = os.path.join(folder, "view.exr" if luminance else "view.png")
            image: npt.NDArray[Any] = self._run("render", [*flags, "-o", file]).image
        return image

    @checked
    def audit(
        self, *, places: int | None = None, paths: int | None = None, seed: int | None = None
    ) -> Any:
        """Test what the map claims, independently, by complete paths: the object that ``isolux audit --json`` prints.

        ``["contradicts"]`` is the verdict, ``["error"]`` the audited error with its interval. ``places``: to compare, 1024 unless
        given; ``paths``: to trace at each, 64 unless given; ``seed``: that of the map unless given.
        """
        return self._run("audit", words(places=places, paths=paths, seed=seed)).report

    def info(self) -> Any:
        """What the map holds: the object that ``isolux info --json`` prints, with its ``provenance``."""
        return self._run("info").report

    @checked
    def mix(self, dim: Mapping[str, float]) -> Map:
        """The same with groups of luminaires dimmed, without a new run: ``m.mix({"spots": 0.3, "daylight": 0})``.

        For maps of ``solve(group=True)``. One that was opened from a file finds the maps of its groups beside that.
        """
        return mix(list(self.groups.values()) or self, dim=dim)

    @checked
    def export(
        self,
        path: Path,
        *,
        target: str | None = None,
        layout: str | None = None,
        texels_per_meter: float | None = None,
        without_dark: bool = False,
        onto: Path | None = None,
        without_lights: bool = False,
        digits: int | None = None,
        beside: Path | None = None,
        finer: float | str | None = None,
        white: str | None = None,
        threads: int | None = None,
    ) -> Any:
        """Write the map for other software, as ``isolux export`` does, and return the object that it prints with ``--json``.

        The extension of ``path`` tells the kind: .html to walk through in a browser, .wrl, .x3d, .vtu, .ply, .csv; .glb with colours of
        vertices or a lightmap, .exr, .ktx2 lightmaps. ``target``: for whom, ``"three"``, ``"godot"``, ``"unity"``, ``"blender"``,
        ``"bevy"`` or ``"viewer"``. ``layout``: ``"vertices"`` or ``"texels"``. ``finer``: with .html, seconds to look for finer shadows.
        """
        flags = words(
            target=target,
            layout=layout,
            texels_per_meter=texels_per_meter,
            without_dark=without_dark,
            onto=onto,
            without_lights=without_lights,
            digits=digits,
            beside=beside,
            finer=with_unit(finer, "s"),
            white=white,
            threads=threads,
        )
        return self._run("export", [*flags, "-o", os.fspath(path)]).report

    @checked
    def view(self, *, height: int = HEIGHT, live: bool = True, finer: float = FINER_S) -> View:
        """Walk through the map in a notebook; a map that ends a cell does so by itself.

        ``height``: in pixels. ``live``: by a widget of anywidget, if that is installed; its page is not kept in the notebook, the picture
        is. ``live=False`` keeps the page in the notebook and in what nbconvert makes of it, a megabyte or more. ``finer``: seconds to
        look for finer shadows.
        """
        at_least(1, height=height)
        return View(self, height, live, finer)

    def _repr_mimebundle_(self, **_: object) -> tuple[dict[str, Any], dict[str, Any]]:
        return self.view()._repr_mimebundle_()

    @checked
    def save(self, path: Path) -> None:
        """Write the map file (.glb): the same bytes as ``isolux solve`` writes. It is a picture for every viewer of glTF, too.

        The maps of its ``groups`` are written beside it, as ``map.GROUP.glb``.
        """
        target = FilePath(path)
        if target.suffix.lower() != ".glb":
            raise wrong(f"{target}: a map is a .glb; end its name so, or use export")
        if not target.parent.is_dir():
            raise wrong(f"{target}: there is no directory `{target.parent}`; create it or choose another place")
        target.write_bytes(self.to_bytes())
        for of in self.groups.values():
            # The name that the run has given it: the group's, made safe for files.
            suffix = "".join(FilePath(of._name).suffixes[-2:])
            target.with_suffix(suffix).write_bytes(of.to_bytes())

    def to_bytes(self) -> bytes:
        """The bytes of the map file."""
        return self._native.file(self._name, Call())

    def _run(self, subcommand: str, words: Sequence[str] = (), call: Call | None = None) -> Call:
        call = call or Call()
        return call.run([subcommand, *words, "--", self._name], [(self._name, self._native)])

    def __reduce__(self) -> tuple[Any, ...]:
        return _from_bytes, (self.to_bytes(), self._name)

    def __repr__(self) -> str:
        error = "unknown" if self.accuracy is None else f"{100 * self.accuracy:.2g} %"
        return f"<isolux.Map of {self.receivers} receivers, error {error}>"


@checked
def open_map(path: Path) -> Map:
    """Read a map file (.glb) that ``solve``, ``mix`` or the command has written."""
    call = Call()
    native = _native.Map.read(path, call)
    call.pass_on()
    return Map(native, os.fspath(path), call)


def _from_bytes(data: bytes, name: str) -> Map:
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        path = os.path.join(folder, "map.glb")
        with open(path, "wb") as file:
            file.write(data)
        return Map(_native.Map.read(path, Call()), name)


@checked
def mix(
    maps: Map | Path | Sequence[Map | Path] | Mapping[Path, float],
    *,
    dim: Mapping[str, float] | None = None,
) -> Map:
    """Add maps of the same surfaces in different light, without a new run; errors add up as ``isolux mix`` has it.

    ``maps``: maps or map files; a dict of files has what all light of each is multiplied by: ``{"map.spots.glb": 0.3}``. ``dim``: the
    factor on the luminaires of a group, ``{"spots": 0.3}``, 0 for off.
    """
    if isinstance(maps, Mapping):
        parts: list[tuple[Map | Path, str]] = list(_shares("maps", maps).items())
    elif isinstance(maps, (Map, str, os.PathLike)):
        parts = [(maps, "1")]
    else:
        parts = [(part, "1") for part in _several(maps)]
    given: Given = []
    dimmed = {} if dim is None else _shares("dim", dim)
    flags = [part for group, by in dimmed.items() for part in ("--dim", f"{group}={by}")]
    names = []
    for number, (part, dimming) in enumerate(parts):
        name = os.fspath(part) if not isinstance(part, Map) else part._name
        if isinstance(part, Map):
            name = name if os.path.exists(name) else f"map {number + 1}"
            given.append((name, part._native))
        names.append(f"{name}={dimming}")
    with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
        output = os.path.join(folder, "mixed.glb")
        call = Call().run(["mix", *flags, "-o", output, "--", *names], given)
    return Map(call.maps[-1][1], "mixed.glb", call)


def _several(maps: Any) -> Sequence[Map | Path]:
    if isinstance(maps, Sequence) and all(isinstance(m, (Map, str, os.PathLike)) for m in maps):
        return maps
    raise misfit("maps", maps, "maps or paths of maps, in a list or as keys of a dict")


def _shares(argument: str, shares: Any) -> dict[Any, str]:
    """What light is multiplied by, in the words of the command."""
    if not isinstance(shares, Mapping):
        raise misfit(argument, shares, 'a dict, as {"spots": 0.3}')
    for name, by in shares.items():
        if isinstance(by, bool) or not isinstance(by, (str, numbers.Real)):
            raise misfit(f"{argument}[{name!r}]", by, 'a number or text, as 0.3 or "30%"')
    return {name: word(by) for name, by in shares.items()}
