"""What is told of a scene or of a map to others: reports, budgets."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

from isolux._arguments import checked
from isolux._call import Call, Path, repeated, words
from isolux._errors import public


@public
class Reported:
    """What a :class:`Scene` and a :class:`Map` have in common."""

    def _run(self, subcommand: str, words: Sequence[str] = (), call: Call | None = None) -> Call:
        raise NotImplementedError

    @checked
    def write_report(
        self,
        path: Path,
        *,
        language: str = "en",
        title: str | None = None,
        client: str | None = None,
        author: str | None = None,
        date: str | None = None,
        remarks: str | None = None,
        cameras: Sequence[str] = (),
        height: float | None = None,
        maintenance_factor: float | None = None,
        accuracy: float | str | None = None,
        require: str | Sequence[str] = (),
        flux: float | str | None = None,
        reflectance: float | str | None = None,
        maintenance: float | str | None = None,
        weather: Path | None = None,
        paths: int | None = None,
    ) -> Any:
        """Write a lighting report (.html), as ``isolux report`` does; a scene is solved first.

        ``language``: ``"en"`` or ``"de"``. ``title``, ``client``, ``author``, ``date`` and ``remarks`` are for the cover. ``cameras``: whose
        pictures it shows, all unless given. Grids are those of the scene, or a working plane at a ``height``, in metres. ``require``:
        what has to hold beside what the scene requires: ``"desks: Em >= 500, U0 >= 0.6"``, ``"EN 12464-1 34.2"``. ``flux``,
        ``reflectance``, ``maintenance``: what inputs may be off by, as in :meth:`budget`. ``weather``: a year of weather (.epw), which adds
        daylight, traced by so many ``paths``.

        Returns the object that ``isolux report --json`` prints: ``["requirements"]``, and how many of them are surely ``["met"]``.
        """
        flags = words(
            language=language,
            title=title,
            client=client,
            author=author,
            date=date,
            remarks=remarks,
            height=height,
            maintenance_factor=maintenance_factor,
            accuracy=accuracy,
            flux=flux,
            reflectance=reflectance,
            maintenance=maintenance,
            weather=weather,
            paths=paths,
        )
        flags += repeated("camera", cameras) + repeated("require", require)
        return self._run("report", [*flags, "-o", os.fspath(path)]).report

    @checked
    def budget(
        self,
        name: str | None = None,
        *,
        flux: float | str | None = None,
        reflectance: float | str | None = None,
        maintenance: float | str | None = None,
        height: float | None = None,
    ) -> Any:
        """What mean illuminances may be off by, in the manner of the GUM: the object that ``isolux budget --json`` prints.

        ``flux``, ``reflectance`` and ``maintenance`` are half of an interval of 95 %, as a share of the value: 0.1 or ``"10%"``. Grids are
        those of the scene, the one of this ``name``, or a working plane at a ``height``, in metres.
        """
        flags = words(
            name=name, flux=flux, reflectance=reflectance, maintenance=maintenance, height=height
        )
        return self._run("budget", flags).report
