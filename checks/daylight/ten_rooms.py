"""Ten rooms: six lit from the side, four from the top. y points north, x east.

Odd ones are for tuning, even ones for judging only: nothing of isolux is to be chosen by how the even ones come out."""

import math

from scene import X, Y, Z, Plane, Room, opening

# Open ground has 10,000 lx below this sky: W/m2 at 179 lm/W.
TEN_KLUX = 55.8659


def plain_window():
    """A window without glass, below the overcast sky."""
    room = Room("1 plain window, overcast", f"gensky -ang 45 0 -c -B {TEN_KLUX}", Plane((0.5, 0.5, 0.8), (3, 5), 1.0))
    room.paint(floor=0.2, wall=0.5, ceiling=0.7)
    window = opening(x=(0.8, 3.2), z=(0.9, 2.4))
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 0), (4, 6, 3), paints, {"y_min": [window]})
    room.sleeve("wall", Y, -0.3, 0, window)
    return room


def office():
    """A band of glass to the south; the sun comes far in."""
    room = Room("2 office, glass, clear with sun", "gensky -ang 35 20 +s", Plane((0.5, 0.5, 0.75), (6, 4), 1.0))
    room.paint(floor=0.3, wall=0.6, ceiling=0.8)
    room.pane("glazing", 0.872)
    windows = [opening(x=(0.4 + 2.3 * k, 2.2 + 2.3 * k), z=(0.8, 2.5)) for k in range(3)]
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 0), (7, 5, 2.8), paints, {"y_min": windows})
    for window in windows:
        room.sleeve("wall", Y, -0.2, 0, window)
        room.glaze("glazing", Y, -0.1, window)
    return room


def corner_room():
    """Windows in two walls, to the south and the west, without glass."""
    room = Room("3 corner room, intermediate", "gensky -ang 40 -30 -i", Plane((0.5, 0.5, 0.8), (4, 4), 1.0))
    room.paint(floor=0.2, wall=0.7, ceiling=0.7, column=0.4)
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    openings = {"y_min": [opening(x=(1, 4), z=(1, 2.2))], "x_min": [opening(y=(1.5, 3.5), z=(0.2, 2.4))]}
    room.box((0, 0, 0), (5, 5, 2.7), paints, openings)
    room.box((3.1, 3.1, 0), (3.4, 3.4, 2.7), {"walls": "column"}, inward=False)
    return room


def light_shelf():
    """A deep room with a clerestory above a bright shelf that the sun shines on."""
    room = Room("4 clerestory and light shelf, clear with sun", "gensky -ang 50 10 +s", Plane((0.5, 0.5, 0.8), (5, 9), 1.0))
    room.paint(floor=0.2, wall=0.5, ceiling=0.85, shelf=0.8)
    room.pane("glazing", 0.9)
    windows = [opening(x=(0.5, 5.5), z=(0.9, 2.2)), opening(x=(0.5, 5.5), z=(2.5, 3.4))]
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 0), (6, 10, 3.6), paints, {"y_min": windows})
    for window in windows:
        room.glaze("glazing", Y, 0, window)
    faces = dict.fromkeys(["z_min", "z_max", "walls"], "shelf")
    room.box((0.5, -0.7, 2.32), (5.5, -0.02, 2.38), faces, inward=False)
    room.box((0.5, 0.02, 2.32), (5.5, 0.9, 2.38), faces, inward=False)
    return room


def street():
    """A room on the first floor, across a street from a facade that takes most of the sky."""
    room = Room("5 street, Perez", "gendaylit -ang 40 -25 -W 500 150", Plane((0.5, 0.5, 3.8), (4, 5), 1.0))
    room.paint(floor=0.2, wall=0.5, ceiling=0.7, asphalt=0.1, facade=0.4)
    room.pane("glazing", 0.9)
    window = opening(x=(0.7, 4.3), z=(3.9, 5.5))
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 3), (5, 6, 5.8), paints, {"y_min": [window]})
    room.sleeve("wall", Y, -0.3, 0, window)
    room.glaze("glazing", Y, -0.15, window)
    room.level("asphalt", Z, 0, (-30, -12, 0), (36, -0.3, 0))
    room.level("facade", Y, -12, (-30, -12, 0), (36, -12, 11))
    room.level("facade", Y, -0.3, (-30, -0.3, 0), (36, -0.3, 11), -1, [window])
    return room


def blinds():
    """White slats before a window: light comes in by reflection between them."""
    room = Room("6 blinds, clear with sun", "gensky -ang 40 -15 +s", Plane((0.5, 0.5, 0.8), (3, 4), 1.0))
    room.paint(floor=0.25, wall=0.6, ceiling=0.75, slat=0.7)
    window = opening(x=(0.5, 3.5), z=(0.9, 2.5))
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 0), (4, 5, 2.8), paints, {"y_min": [window]})
    room.sleeve("wall", Y, -0.2, 0, window)
    width, tilt = 0.08, math.radians(35)
    reach, rise = 0.5 * width * math.cos(tilt), 0.5 * width * math.sin(tilt)
    for k in range(22):
        z = 0.95 + 0.07 * k
        outer, inner = (-0.1 - reach, z - rise), (-0.1 + reach, z + rise)
        room.polygon("slat", (0.5, *outer), (3.5, *outer), (3.5, *inner), (0.5, *inner))
    return room


def skylight():
    """A glazed opening in the middle of the roof, on an upstand."""
    room = Room("7 skylight, overcast", f"gensky -ang 45 0 -c -B {TEN_KLUX}", Plane((0.5, 0.5, 0.8), (7, 7), 1.0))
    room.paint(floor=0.2, wall=0.5, ceiling=0.7, upstand=0.8)
    room.pane("glazing", 0.9)
    hole = opening(x=(3, 5), y=(3, 5))
    paints = {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}
    room.box((0, 0, 0), (8, 8, 3.5), paints, {"z_max": [hole]})
    room.sleeve("upstand", Z, 3.5, 4.1, hole)
    room.glaze("glazing", Z, 4.1, hole)
    return room


def sawtooth():
    """Three teeth that look north; the sun lights their backs, and these the next tooth."""
    room = Room("8 sawtooth, clear with sun", "gensky -ang 45 -20 +s", Plane((1, 0.5, 0.8), (5, 4), 2.0))
    room.paint(floor=0.3, wall=0.5, roof=0.7)
    room.pane("glazing", 0.9)
    room.box((0, 0, 0), (12, 9, 3.2), {"z_min": "floor", "walls": "wall"})
    for k in range(3):
        south, north, low, high = 3.0 * k, 3.0 * k + 3, 3.2, 5.0
        room.polygon("roof", (0, south, low), (0, north, high), (12, north, high), (12, south, low))
        room.polygon("wall", (0, south, low), (0, north, low), (0, north, high))
        room.polygon("wall", (12, south, low), (12, north, high), (12, north, low))
        panes = [opening(x=(0.3 + 3 * m, 2.7 + 3 * m), z=(3.4, 4.8)) for m in range(4)]
        room.level("wall", Y, north, (0, north, low), (12, north, high), -1, panes)
        for pane in panes:
            room.glaze("glazing", Y, north, pane)
    return room


def monitor():
    """A raised part of the roof with glass to the east and the west."""
    room = Room("9 roof monitor, intermediate with sun", "gensky -ang 50 -70 +i", Plane((0.5, 0.5, 0.8), (8, 8), 1.0))
    room.paint(floor=0.2, wall=0.5, ceiling=0.7, outside=0.3)
    room.pane("glazing", 0.88)
    hole = opening(x=(3, 6), y=(1, 8))
    room.box((0, 0, 0), (9, 9, 3.5), {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}, {"z_max": [hole]})
    window = opening(y=(1.3, 7.7), z=(3.9, 4.9))
    openings = {"x_min": [window], "x_max": [window]}
    room.box((3, 1, 3.5), (6, 8, 5.1), {"z_max": "ceiling", "walls": "wall"}, openings)
    for x in (3, 6):
        room.glaze("glazing", X, x, window)
    room.level("outside", Z, 3.7, (0, 0, 3.7), (9, 9, 3.7), 1, [hole])
    return room


def light_well():
    """A white well of four storeys, and a room at its foot that has no other light."""
    plane = Plane((3.4, 0.3, 0.8), (4, 4), 0.8)
    room = Room("10 light well, uniform sky", f"gensky -ang 45 0 -u -B {TEN_KLUX}", plane, bounces=40)
    room.paint(floor=0.3, wall=0.6, ceiling=0.75, well=0.8)
    door = opening(y=(0.4, 3.4), z=(0.0, 2.6))
    room.box((0, 0, 0), (3, 3.8, 12), {"z_min": "floor", "walls": "well"}, {"x_max": [door]})
    room.box((3.1, 0, 0), (7, 3.8, 2.9), {"z_min": "floor", "z_max": "ceiling", "walls": "wall"}, {"x_min": [door]})
    room.sleeve("wall", X, 3, 3.1, door)
    return room


ROOMS = [
    plain_window, office, corner_room, light_shelf, street, blinds, skylight, sawtooth, monitor, light_well
]


def is_for_tuning(number):
    """By the number of a room, from one."""
    return number % 2 == 1
