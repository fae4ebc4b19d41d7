"""A year of daylight in a side-lit office by Radiance's two-phase and five-phase methods and by isolux.

Run by hand:  python annual.py --isolux PATH --weather FILE.epw [--save results]

README.md tells what is compared and how."""

import argparse
import json
import pathlib
import sys
import tempfile
import time

import numpy as np

import by_isolux
import radiance
import sun
from scene import Y, Plane, Room, opening

# gendaymtx reckons efficacies with this dew point, whatever the weather file says.
DEW_POINT_C = 11.0
DEW_POINT_COLUMN = 7
# Of an .epw file.
HEADER_LINES = 8
HOURS = 8760
USED = (8, 18)
MULTIPLIER = 4
PATCHES = 144 * MULTIPLIER**2 + 2
ENOUGH_LX, LEAST_LX, MOST_LX, SUNNY_LX, SUNNY_H = 300.0, 100.0, 3000.0, 1000.0, 250.0
GROUND = 0.2
BOUNCES = 12
RECEIVERS = f"""#@rfluxmtx h=u u=+Y
void glow ground_glow
0
0
4 1 1 1 0

ground_glow source ground
0
0
4 0 0 -1 180

#@rfluxmtx h=r{MULTIPLIER} u=+Y
void glow sky_glow
0
0
4 1 1 1 0

sky_glow source sky
0
0
4 0 0 1 180
"""
SHARES = ["DA 300", "sDA 300/50%", "ASE 1000,250h", "UDI below 100", "UDI to 300", "UDI to 3000", "UDI above"]


def main():
    flags = arguments()
    room = office(flags.transmissivity)
    with tempfile.TemporaryDirectory() as scratch:
        folder = flags.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        weather = folder / "weather.epw"
        weather.write_text(with_one_dew_point(flags.weather.read_text(encoding="latin-1")), encoding="latin-1")
        scene = folder / "office.rad"
        scene.write_text(room.text(with_sky=False))
        started = time.perf_counter()
        theirs = by_radiance(room, scene, weather, flags)
        seconds = {"Radiance": time.perf_counter() - started}
        ours, seconds["isolux"] = by_daylight(flags, room, scene, weather)
    facts = {
        "radiance": radiance.version(),
        "weather": flags.weather.name,
        "transmissivity": flags.transmissivity,
        "divisions": flags.divisions,
        "repetitions": flags.repetitions,
        "paths": flags.paths,
        "points": len(room.plane.points()),
        "seconds": seconds,
        "figures": {**theirs, "isolux": ours},
    }
    text = table(facts)
    print(text)
    if flags.save:
        flags.save.mkdir(parents=True, exist_ok=True)
        (flags.save / "annual.json").write_text(json.dumps(facts, indent=1, default=np.ndarray.tolist) + "\n")
        (flags.save / "annual.md").write_text(text)
    # Nothing compared is no acceptance.
    sys.exit(0 if ours["points"]["DA 300"].any() else 1)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--isolux", required=True, help="the program")
    parser.add_argument("--weather", required=True, type=pathlib.Path, help="an .epw file")
    parser.add_argument("--transmissivity", type=float, default=0.87, help="of the glass, as Radiance means it")
    parser.add_argument("--divisions", type=int, default=8192, help="of Radiance: paths from a point in one repetition")
    parser.add_argument("--repetitions", type=int, default=8, help="of Radiance, whose spread is its standard error")
    parser.add_argument("--paths", type=int, default=16384, help="of isolux")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for what Radiance needs and finds")
    parser.add_argument("--save", type=pathlib.Path, help="a folder for annual.json and annual.md")
    return parser.parse_args()


def office(transmissivity):
    """Ten metres wide, eight deep, a band of windows to the south."""
    room = Room("office", None, Plane((0.5, 0.5, 0.8), (9, 7), 1.0), BOUNCES)
    room.paint(floor=0.2, wall=0.5, ceiling=0.7)
    room.pane("glazing", transmissivity)
    windows = [opening(x=(0.6 + 2.4 * k, 2.0 + 2.4 * k), z=(0.9, 2.2)) for k in range(4)]
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 0), (10, 8, 3), paints, {"y_min": windows})
    for window in windows:
        room.sleeve("wall", Y, -0.2, 0, window)
        room.glaze("glazing", Y, -0.1, window)
    return room


def with_one_dew_point(text):
    """The same weather with the dew point that gendaymtx takes."""
    lines = text.splitlines()
    for k in range(HEADER_LINES, len(lines)):
        fields = lines[k].split(",")
        if len(fields) > DEW_POINT_COLUMN:
            fields[DEW_POINT_COLUMN] = str(DEW_POINT_C)
            lines[k] = ",".join(fields)
    return "\n".join(lines) + "\n"


def by_radiance(room, scene, weather, flags):
    """Figures of the two-phase and of the five-phase method, with gendaymtx's sun and the true one, each with the spread of repetitions."""
    folder = scene.parent
    radiance.run(["epw2wea", weather.name, "weather.wea"], folder=folder)
    (folder / "receivers.rad").write_text(RECEIVERS)
    total = coefficients(room, scene, flags.divisions, BOUNCES, flags.repetitions)
    black = folder / "black.rad"
    black.write_text(blackened(room).text(with_sky=False))
    direct = coefficients(room, black, flags.divisions, 1, flags.repetitions)
    skies, suns = matrix(folder), matrix(folder, "-d")
    hours = used_hours()
    sky_lx = total @ skies[:, hours]
    reflected_lx = sky_lx - direct @ suns[:, hours]
    found = {"two-phase": repeated(sky_lx, (direct @ suns[:, hours]).mean(axis=0), flags.repetitions)}
    write_suns(folder, weather)
    for name, file in [("five-phase", "suns.rad"), ("five-phase, true sun", "true-suns.rad")]:
        sun_lx = direct_sun(room, black, folder, file)[:, hours]
        found[name] = repeated(np.maximum(reflected_lx + sun_lx, 0.0), sun_lx, flags.repetitions)
    return found


def write_suns(folder, weather):
    """The suns of all hours where gendaymtx has them, and where they are."""
    radiance.run(["gendaymtx", "-n", "-D", "suns.rad", "-M", "suns.mod", "-m", MULTIPLIER, "-c", 1, 1, 1, "weather.wea"], folder=folder)
    head = weather.read_text(encoding="latin-1").splitlines()[0].split(",")
    latitude, longitude, ahead = (float(field) for field in head[6:9])
    lines = (folder / "suns.rad").read_text().splitlines()
    for k, line in enumerate(lines):
        words = line.split()
        if len(words) == 3 and words[1] == "source":
            # Its four numbers are three lines below.
            x, y, z = sun.towards(latitude, longitude, ahead, hour_of(words[0]))
            lines[k + 3] = f"4 {x:.7f} {y:.7f} {z:.7f} {lines[k + 3].split()[-1]}"
    (folder / "true-suns.rad").write_text("\n".join(lines) + "\n")


def hour_of(name):
    """Suns are named after the minute of the year, in the middle of the hour."""
    return int(name.removeprefix("solar")) // 60


def blackened(room):
    """The room with nothing that reflects but its panes."""
    dark = Room(room.name, room.sky, room.plane)
    dark.surfaces = room.surfaces
    dark.paint(**dict.fromkeys(room.materials, 0.0))
    dark.materials.update({name: text for name, text in room.materials.items() if text.startswith("void glass")})
    return dark


def coefficients(room, scene, divisions, bounces, repetitions):
    """Illuminance for every W/(m2 sr) of ground and patches, lx: repetitions x points x patches."""
    kept = scene.with_suffix(".npz")
    asked = f"{scene.read_text()}{divisions} {bounces} {repetitions}"
    if kept.exists() and str(np.load(kept)["asked"]) == asked:
        return np.load(kept)["found"]
    compiled = radiance.octree(scene)
    places = room.plane.points()
    rays = "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in places * repetitions).encode()
    least = radiance.LEAST_SHARE / divisions
    words = ["rfluxmtx", "-h-", "-I+", "-y", str(len(places) * repetitions), "-n", "1", "-ab", bounces, "-ad", divisions]
    words += ["-lr", -4 * bounces, "-lw", f"{least:.3g}", "-st", "0", "-", "receivers.rad", "-i", compiled.name]
    text = radiance.run(words, rays, folder=scene.parent)
    found = np.array(text.split(), dtype=float).reshape(repetitions, len(places), PATCHES, 3)
    found = radiance.EFFICACY * found @ radiance.WEIGHTS
    np.savez(kept, asked=asked, found=found)
    return found


def matrix(folder, *only):
    """Radiances of the ground and all patches in all hours of the year."""
    # What leaves out the sky makes it black, and so comes after its colour.
    words = ["gendaymtx", "-m", MULTIPLIER, "-g", *3 * [GROUND], "-c", 1, 1, 1, *only, "-of", "-h", "weather.wea"]
    rgb = np.frombuffer(radiance.run(words, folder=folder), dtype=np.float32).reshape(PATCHES, HOURS, 3)
    return rgb.astype(float) @ radiance.WEIGHTS


def direct_sun(room, black, folder, suns):
    """Illuminances by the sun alone in every hour: points x hours."""
    names = (folder / "suns.mod").read_text().split()
    compiled = folder / "suns.oct"
    with compiled.open("wb") as file:
        radiance.run(["oconv", black.name, suns], stdout=file, folder=folder)
    places = room.plane.points()
    rays = "".join(f"{x} {y} {z} 0 0 1\n" for x, y, z in places).encode()
    words = ["rcontrib", "-h-", "-I+", "-V+", "-ab", "0", "-dj", "0", "-dt", "0", "-dc", "1", "-lw", "0", "-M", "suns.mod", compiled.name]
    text = radiance.run(words, rays, folder=folder)
    found = radiance.EFFICACY * np.array(text.split(), dtype=float).reshape(len(places), len(names), 3) @ radiance.WEIGHTS
    lx = np.zeros((len(places), HOURS))
    lx[:, [hour_of(name) for name in names]] = found
    return lx


def used_hours():
    """Numbers of the hours of use, from zero."""
    first, last = USED
    return np.array([hour for hour in range(HOURS) if first <= hour % 24 < last])


def figures(lx, sunny_lx):
    """Figures of hours of use, points x hours: shares of the grid and of its points."""
    share = lambda low, high: ((lx >= low) & (lx < high)).mean(axis=1)
    autonomy, sunny_h = share(ENOUGH_LX, np.inf), (sunny_lx > SUNNY_LX).sum(axis=1)
    useful = [share(0.0, LEAST_LX), share(LEAST_LX, ENOUGH_LX), share(ENOUGH_LX, MOST_LX), share(MOST_LX, np.inf)]
    grid = [autonomy.mean(), (autonomy >= 0.5).mean(), (sunny_h > SUNNY_H).mean(), *(part.mean() for part in useful)]
    return np.array(grid), {"DA 300": autonomy, "sunny_h": sunny_h, "mean_lx": lx.mean(axis=1)}


def repeated(lx, sunny_lx, repetitions):
    """Figures of the mean of repetitions, with the jackknife's standard errors."""
    grid, points = figures(lx.mean(axis=0), sunny_lx)
    without = [figures(np.delete(lx, k, axis=0).mean(axis=0), sunny_lx)[0] for k in range(repetitions)]
    errors = np.sqrt((repetitions - 1) * np.var(without, axis=0))
    return {"grid": dict(zip(SHARES, grid)), "errors": dict(zip(SHARES, errors)), "points": points}


def by_daylight(flags, room, scene, weather):
    """The figures of `isolux daylight`, and the seconds they took."""
    columns, rows = room.plane.counts
    words = ["daylight", scene, "--weather", weather, "--corner", ",".join(map(str, room.plane.corner)), "--paths", flags.paths]
    words += ["--u", f"{columns * room.plane.spacing},0,0", "--v", f"0,{rows * room.plane.spacing},0", "--spacing", room.plane.spacing]
    words += ["--ground-reflectance", GROUND, "--hours", f"{USED[0]}..{USED[1]}"]
    found, seconds, _ = by_isolux.command(flags.isolux, words)
    [grid] = found["grids"]
    with_intervals = [grid["daylight_autonomy"], grid["spatial_daylight_autonomy"], None, *grid["useful_daylight"]]
    values = [grid["annual_sunlight_exposure"] if of is None else of["value"] for of in with_intervals]
    # Intervals are of sixteen replicates.
    errors = [0.0 if of is None else (of["high"] - of["low"]) / (2 * 2.131) for of in with_intervals]
    points = {
        "DA 300": np.array([p["daylight_autonomy"]["value"] for p in grid["points"]]),
        "sunny_h": np.array([p["sunny_h"] for p in grid["points"]]),
    }
    return {"grid": dict(zip(SHARES, values)), "errors": dict(zip(SHARES, errors)), "points": points}, seconds


def table(facts):
    found = facts["figures"]
    cell = lambda method, name: f"{100 * found[method]['grid'][name]:.2f} ± {100 * found[method]['errors'][name]:.2f} %"
    lines = [f"| figure | {' | '.join(found)} |\n|{(len(found) + 1) * '---|'}"]
    for name in SHARES:
        lines.append(f"| {name} | {' | '.join(cell(method, name) for method in found)} |")
    for method in [name for name in found if name.startswith("five")]:
        for name, scale, unit in [("DA 300", 100.0, "points of per cent"), ("sunny_h", 1.0, "h")]:
            apart = scale * (found["isolux"]["points"][name] - found[method]["points"][name])
            lines.append(
                f"\n{name} of single points, isolux less {method}: mean {apart.mean():+.2f}, RMS {np.sqrt((apart**2).mean()):.2f}, "
                f"largest {np.abs(apart).max():.2f} {unit}"
            )
    lines.append("\nSeconds: " + ", ".join(f"{name} {of:.0f}" for name, of in facts["seconds"].items()))
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
