"""Scenes."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from pathlib import Path as FilePath
from typing import Any

import numpy as np
import numpy.typing as npt

from isolux import _builder, _native
from isolux._arguments import Point, at_least, checked
from isolux._builder import Luminaire, Material
from isolux._call import Call, Path, words
from isolux._daylight import DaylightGrid, daylight_grid
from isolux._errors import InputError, public, wrong
from isolux._readings import Array, Readings, fixed, places, readings
from isolux._report import Reported
from isolux._written import written

#: The keys of ``[sky]``, or the words of ``--sky``.
Sky = str | Mapping[str, Any]


@public
class Scene(Reported):
    """A scene: surfaces, materials, luminaires. It does not change.

    Made by :func:`isolux.load` or :meth:`from_arrays`. Lengths are metres, in the axes of the scene as written.
    """

    def __init__(self, native: _native.Scene, source: str, warnings: Sequence[str] = ()) -> None:
        self._native = native
        self._source = source
        #: What its reader left out or guessed.
        self.warnings: list[str] = list(warnings)

    @classmethod
    @checked
    def from_arrays(
        cls,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        *,
        materials: Material | Mapping[str, Material] = 0.5,
        triangle_materials: npt.ArrayLike | None = None,
        luminaires: Luminaire | Sequence[Luminaire | Mapping[str, Any]] = (),
        cameras: Sequence[Mapping[str, Any]] = (),
        grids: Sequence[Mapping[str, Any]] = (),
        requirements: Sequence[Mapping[str, Any]] = (),
        sky: Mapping[str, Any] | None = None,
        name: str = "scene",
        up: str = "z",
    ) -> Scene:
        """Make a scene of arrays.

        ``vertices``: (n, 3) coordinates in metres. ``triangles``: (m, 3) integers, vertices counter-clockwise seen from the front.
        ``materials``: a diffuse reflectance for all, or a dict of names. What a name stands for is a reflectance, one number or
        (red, green, blue) in linear Rec. 709, or a dict with the keys of ``[materials.NAME]`` in a ``scene.toml``, such as
        ``{"luminance_cd_m2": 2000}``. ``triangle_materials``: (m,) names, or integers that count ``materials``; may be left out where
        there is one. ``luminaires``: :class:`Luminaire`, or dicts with the keys of ``[[luminaire]]``. ``cameras``, ``grids`` and
        ``requirements``: dicts with the keys of ``[[camera]]``, ``[[grid]]`` and ``[[requirement]]``; ``sky``: a dict with those of ``[sky]``.
        ``up``: ``"y"`` or ``"z"``.
        """
        with tempfile.TemporaryDirectory(prefix="isolux-") as folder:
            files = _builder.write(
                FilePath(folder),
                vertices,
                triangles,
                materials,
                triangle_materials,
                luminaires,
                {"camera": cameras, "grid": grids, "requirement": requirements},
                sky,
                name,
                up,
            )
            # Photometric files lie anywhere.
            try:
                scene = _read([str(files.file)], ["--allow-outside"], files.told)
            except InputError as error:
                raise files.error(error) from None
            return scene._named(name)

    def _named(self, source: str) -> Scene:
        self._source = source
        return self

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def up(self) -> str:
        """The axis that points up: ``"y"`` or ``"z"``."""
        return self._native.up

    @property
    def hash(self) -> str:
        """A hash of all that results depend on, hexadecimal; maps hold it."""
        return self._native.hash

    @property
    def triangle_count(self) -> int:
        """How many triangles it has."""
        return self._native.triangle_count

    @cached_property
    def area_m2(self) -> float:
        """The area of all triangles, one side of each, in m2."""
        return self._native.area_m2

    @property
    def luminous_flux_lm(self) -> float:
        """The flux of all luminaires and emitting surfaces, in lm; parallel light has none."""
        return self._native.luminous_flux_lm

    @property
    def bounds_m(self) -> Array:
        """The lowest and the highest coordinates: (2, 3), in metres; ``nan`` without surfaces."""
        bounds = self._native.bounds_m
        return np.full((2, 3), np.nan) if bounds is None else np.array(bounds)

    @property
    def shapes(self) -> list[str]:
        """Names of shapes."""
        return self._native.shapes

    @property
    def materials(self) -> list[str]:
        """Names of materials."""
        return self._native.materials

    @property
    def luminaires(self) -> list[str]:
        """Names of luminaires; emitting surfaces are none."""
        return self._native.luminaires

    @property
    def groups(self) -> list[str]:
        """Names of groups of luminaires."""
        return self._native.groups

    @property
    def cameras(self) -> list[str]:
        """Names of cameras."""
        return self._native.cameras

    @property
    def grids(self) -> list[str]:
        """Names of calculation grids."""
        return self._native.grids

    @cached_property
    def triangles(self) -> Array:
        """The corners of all triangles: (n, 3, 3), in metres, read-only. They are single precision from an origin near the scene.

        Copied on first use, as the scene keeps them otherwise.
        """
        return fixed(self._native.corners().reshape(-1, 3, 3))

    @cached_property
    def triangle_shapes(self) -> npt.NDArray[np.uint32]:
        """The shape of every triangle: (n,), counted as in ``shapes``, read-only."""
        return fixed(self._native.shape_of())

    @cached_property
    def triangle_materials(self) -> npt.NDArray[np.uint32]:
        """The material of every triangle: (n,), counted as in ``materials``, read-only."""
        return fixed(self._native.material_of())

    @checked
    def probe(
        self,
        points: npt.ArrayLike,
        normals: npt.ArrayLike = (0.0, 0.0, 1.0),
        *,
        paths: int | None = None,
        seed: int | None = None,
    ) -> Readings:
        """Read illuminances without a map, by paths: slow, but without the bias of one. As ``isolux probe SCENE``.

        ``points``: (n, 3) in metres. ``normals``: (n, 3), or one for all, the way a luxmeter faces, of any length. ``paths``: to trace
        at every point, at least 32; 16,384 unless given. Returns (n,) :data:`isolux.READING`. Light that glass, gloss and curved
        mirrors throw is left out.
        """
        at_least(32, paths=paths)
        at_least(0, seed=seed)
        call, drawn = Call(), (paths, seed)
        rows = self._native.readings(self._source, places(points, normals), drawn, call)
        call.pass_on()
        return readings(rows)

    @checked
    def daylight(
        self,
        weather: Path,
        name: str | None = None,
        *,
        height: float | None = None,
        corner: Point | None = None,
        u: Point | None = None,
        v: Point | None = None,
        spacing: float | None = None,
        border: float | None = None,
        hours: tuple[int, int] = (8, 18),
        ground_reflectance: float = 0.2,
        paths: int = 16_384,
        seed: int = 1,
        csv: Path | None = None,
    ) -> list[DaylightGrid]:
        """A year of daylight on calculation grids, as ``isolux daylight`` has it; luminaires are off.

        ``weather``: a year of weather (.epw). Grids are those of the scene, the one of this ``name``, or as in :meth:`Map.grid`.
        ``hours``: of use, from and to, by standard time. ``ground_reflectance``: of the ground beyond the scene. ``paths``:
        from every point, 256 at least; more make intervals narrower. ``csv`` gets all points.
        """
        at_least(256, paths=paths)
        at_least(0, seed=seed)
        flags = words(
            weather=weather,
            name=name,
            height=height,
            corner=corner,
            u=u,
            v=v,
            spacing=spacing,
            border=border,
            hours="..".join(map(str, hours)),
            ground_reflectance=ground_reflectance,
            paths=paths,
            seed=seed,
            csv=csv,
        )
        return [daylight_grid(grid) for grid in self._run("daylight", flags).report["grids"]]

    def check(self) -> Any:
        """Audit the scene before a run: the object that ``isolux check --json`` prints."""
        return self._run("check").report

    def info(self) -> Any:
        """What the scene holds: the object that ``isolux info --json`` prints."""
        return self._run("info").report

    def _run(self, subcommand: str, words: Sequence[str] = (), call: Call | None = None) -> Call:
        call = call or Call()
        return call.run([subcommand, *words, "--", self._source], [(self._source, self._native)])

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpacked, (self._native.packed(), self._source, self.warnings)

    def __repr__(self) -> str:
        return f"<isolux.Scene {self.name!r}: {self.triangle_count} triangles>"


def _unpacked(data: bytes, source: str, warnings: Sequence[str]) -> Scene:
    return Scene(_native.Scene.unpacked(data), source, warnings)


@checked
def load(
    source: Path,
    *further: Path,
    sky: Sky | None = None,
    materials_as_written: bool = False,
    allow_outside: bool = False,
) -> Scene:
    """Read a scene: ``scene.toml``, glTF, OBJ, PLY, STL, Radiance (with ``further`` files), Mitsuba, or ``builtin:NAME``.

    ``sky``: the sky, the sun and the ground beyond the scene, in place of all light that it has infinitely far away: a dict with the keys
    of ``[sky]`` in a ``scene.toml``, as ``{"weather": "berlin.epw", "time": datetime(2026, 6, 21, 12)}``, or the words of ``--sky``, as
    ``"overcast, horizontal_lx=10000"``.
    ``materials_as_written``: read materials of other formats by their letter, where that makes surfaces invisible, too.
    ``allow_outside``: let the scene name files outside of its folder; only for scenes that you trust.

    What the reader left out or guessed is an :class:`isolux.IsoluxWarning`, and in ``Scene.warnings``.
    """
    files = [os.fspath(file) for file in (source, *further)]
    flags = ["--materials", "as-written"] if materials_as_written else []
    flags += ["--allow-outside"] if allow_outside else []
    if sky is not None:
        flags += ["--sky", sky if isinstance(sky, str) else written(sky, "sky")]
    return _read(files, flags)


def _read(
    files: Sequence[str], flags: Sequence[str], told: Callable[[str], str] | None = None
) -> Scene:
    """Read a scene by the words of the command. What is ``told`` of its files may be said otherwise."""
    call = Call(told=told)
    try:
        native = _native.Scene.read(["check", *flags, "--", *files], call)
    finally:
        call.pass_on()
    return Scene(native, files[0], call.warnings)


def as_scene(scene: Scene | Path) -> Scene:
    """A scene, or the one of a file."""
    if isinstance(scene, Scene):
        return scene
    if not isinstance(scene, (str, os.PathLike)):
        kind = type(scene).__name__
        hint = "; a map has its scene as m.scene" if kind == "Map" else ""
        raise wrong(f"a {kind} is no scene; give an isolux.Scene or the path of one{hint}")
    return load(scene)
