"""Skies, years of daylight, glare, requirements, reports."""

from __future__ import annotations

import calendar
from datetime import datetime, timedelta, timezone
from pathlib import Path

import isolux
import numpy as np
import pytest
from conftest import room

DESKS = {"name": "desks", "corner": (0.5, 0.5, 0.8), "u": (3, 0, 0), "v": (0, 3, 0), "spacing": 1}


def window(**more: object) -> isolux.Scene:
    """A room of 4 x 4 x 3 m that is open to the south above one metre."""
    corners = [(x, y, z) for z in (0, 1, 3) for y in (0, 4) for x in (0, 4)]
    # Floor, ceiling, the parapet, the other walls.
    faces = [(0, 1, 3, 2), (8, 10, 11, 9), (0, 4, 5, 1), (2, 3, 11, 10), (0, 2, 10, 8), (1, 9, 11, 3)]
    triangles = [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]
    return isolux.Scene.from_arrays(corners, triangles, grids=[DESKS], **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def year(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A year in Berlin: days by turns overcast and clear, with light from 8 to 16."""
    lines = [
        "LOCATION,Berlin,BE,DEU,Test,103840,52.47,13.40,1.0,49.0",
        "DATA PERIODS,1,1,Data,Sunday,1/1,12/31",
    ]
    for month in range(1, 13):
        for day in range(1, calendar.monthrange(2001, month)[1] + 1):
            for hour in range(1, 25):
                lit = (800, 100) if day % 2 == 0 else (0, 200)
                direct, diffuse = lit if 9 <= hour <= 16 else (0, 0)
                sums = f"{direct + diffuse},{direct},{diffuse}"
                lines.append(
                    f"2001,{month},{day},{hour},60,?9?9,20,11,50,101325,0,0,300,{sums},0,0,0,0"
                )
    path = tmp_path_factory.mktemp("weather") / "year.epw"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_skies_of_dicts_and_of_words(tmp_path: Path, year: Path) -> None:
    noon = datetime(2026, 6, 21, 12, tzinfo=timezone(timedelta(hours=2)))
    place = {"latitude_deg": 52.5, "longitude_deg": 13.4}
    clear = {"type": "clear", "horizontal_lx": 12000, "place": place, "time": noon, "sun_normal_lx": 8e4}
    assert sorted(window(sky=clear).luminaires) == ["sky", "sun"]
    mesh = tmp_path / "plane.obj"
    mesh.write_text("mtllib plane.mtl\nusemtl grey\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "plane.mtl").write_text("newmtl grey\nKd 0.5 0.5 0.5\n")
    for sky in (clear, "overcast, horizontal_lx=10000", {"weather": year, "time": datetime(2001, 6, 2, 12)}):
        assert "sky" in isolux.load(mesh, sky=sky).luminaires
    with pytest.raises(isolux.InputError, match="sky is 3; give text or a dict"):
        isolux.load(mesh, sky=3)  # type: ignore[arg-type]
    with pytest.raises(isolux.InputError, match=r"from_arrays: sky\.typ\b"):
        window(sky={"typ": "clear"})


def test_a_year_of_daylight(tmp_path: Path, year: Path) -> None:
    scene = window()
    (grid,) = scene.daylight(year, paths=512, csv=tmp_path / "points.csv")
    assert grid.name == "desks" and grid.positions.shape == (9, 3)
    assert grid.DF_95.value < grid.DF_median.value < 2 * grid.DF.value
    assert 0.02 < grid.DF.value < 0.5 and grid.DF.low < grid.DF.value < grid.DF.high
    assert sum(share.value for share in grid.UDI) == pytest.approx(1)
    assert set(grid.verdicts.values()) <= {"met", "not_met", "undecided"}
    frame = grid.frame
    assert len(frame) == 9 and frame["daylight_factor"].mean() == pytest.approx(grid.DF.value)
    assert frame["sunny_h"].max() > 100
    # Near the window there is most.
    assert frame.groupby("y")["daylight_factor"].mean().idxmax() == frame["y"].min()
    assert len((tmp_path / "points.csv").read_text().splitlines()) == 10
    (plane,) = scene.daylight(year, height=0.8, hours=(9, 17), paths=256)
    assert plane.report["name"] == plane.name
    with pytest.raises(isolux.InputError, match="paths is 10; give at least 256"):
        scene.daylight(year, paths=10)
    with pytest.raises(isolux.InputError, match="hours is"):
        scene.daylight(year, hours=(8, 12, 18))  # type: ignore[arg-type]


def test_requirements_glare_and_budgets() -> None:
    view = {"name": "desk", "position": (0.5, 2, 1.2), "target": (3, 2, 1.2)}
    lamp = isolux.Luminaire(
        cosine={"flux_lm": 4000},
        position=(3, 2, 2.9),
        luminous_area={"shape": "box", "size_m": (0.6, 0.6, 0)},
    )
    scene = room(
        grids=[DESKS],
        cameras=[view],
        luminaires=[lamp],
        requirements=[{"grid": "desks", "conditions": "Em >= 10"}],
    )
    m = isolux.solve(scene, accuracy=0.03, progress=False)
    (grid,) = m.grids(require=["Em >= 5000", "desks: U0 >= 0.01"])
    found = {of["condition"]: of["verdict"] for of in grid.requirements}
    assert found == {"Em >= 10 lx": "met", "Em >= 5000 lx": "not_met", "U0 >= 0.01": "met"}
    (observer,) = m.glare()["observers"]
    assert observer["observer"] == "desk" and 10 < observer["ugr"]["value"] < 40
    (rated,) = m.glare(grids="desks", limit=5, directions=[(1, 0, 0)])["grids"]
    assert rated["points"] == 9 and rated["worst"]["ugr"]["value"] > 5
    (budget,) = m.budget(flux=0.05, reflectance="10%")["grids"]
    of_flux = next(line for line in budget["lines"] if line["source"]["kind"] == "flux")
    assert of_flux["half_lx"] == pytest.approx(0.05 * budget["mean_lx"]["value"], rel=0.05)


def test_reports(tmp_path: Path, year: Path) -> None:
    scene = window(sky={"type": "overcast", "horizontal_lx": 10000})
    told = scene.write_report(
        tmp_path / "report.html",
        title="Room 4",
        language="de",
        weather=year,
        paths=256,
        accuracy=0.05,
        require="desks: Em >= 1e6",
    )
    assert (told["requirements"], told["met"]) == (1, 0)
    text = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "Room 4" in text and "Tageslicht" in text
    m = isolux.solve(scene, accuracy=0.05, progress=False)
    assert m.write_report(tmp_path / "map.html")["requirements"] == 0
    with pytest.raises(isolux.InputError, match="html"):
        m.write_report(tmp_path / "report.doc")


def test_frames_need_no_window(year: Path) -> None:
    with pytest.warns(isolux.IsoluxWarning, match="no daylight"):
        (grid,) = room(grids=[DESKS]).daylight(year, paths=256)
    assert grid.DF.value == 0 and np.isfinite(grid.positions).all()
