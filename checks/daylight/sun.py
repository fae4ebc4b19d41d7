"""Where the sun is, by the formulas of the Astronomical Almanac (Michalsky 1988): to 0.01 degrees, with refraction.

gendaymtx has a formula of one sine for the declination, which is up to a degree off in spring and autumn."""

import datetime
import math

import numpy as np

NOON_OF_2000 = datetime.datetime(2000, 1, 1, 12)
YEAR = 2026


def towards(latitude_deg, longitude_deg, ahead_of_utc_h, hour):
    """The direction (east, north, up) in the middle of an hour of the year, counted from zero; longitude to the east."""
    local = datetime.datetime(YEAR, 1, 1) + datetime.timedelta(hours=hour + 0.5)
    utc = local - datetime.timedelta(hours=ahead_of_utc_h)
    days = (utc - NOON_OF_2000).total_seconds() / 86400.0
    anomaly = math.radians(357.528 + 0.9856003 * days)
    longitude = math.radians(280.460 + 0.9856474 * days + 1.915 * math.sin(anomaly) + 0.020 * math.sin(2.0 * anomaly))
    tilt = math.radians(23.439 - 4e-7 * days)
    ascension = math.atan2(math.cos(tilt) * math.sin(longitude), math.cos(longitude))
    declination = math.asin(math.sin(tilt) * math.sin(longitude))
    sidereal_h = 6.697375 + 0.0657098242 * days + utc.hour + utc.minute / 60.0
    angle = math.radians(15.0 * sidereal_h + longitude_deg) - ascension
    latitude = math.radians(latitude_deg)
    east = -math.cos(declination) * math.sin(angle)
    north = math.sin(declination) * math.cos(latitude) - math.cos(declination) * math.sin(latitude) * math.cos(angle)
    up = math.sin(declination) * math.sin(latitude) + math.cos(declination) * math.cos(latitude) * math.cos(angle)
    return lifted(east, north, up)


def lifted(east, north, up):
    """By refraction (Bennett 1982)."""
    height_deg = math.degrees(math.asin(up))
    if height_deg < -1.0:
        return np.array([east, north, up])
    minutes = 1.02 / math.tan(math.radians(height_deg + 10.3 / (height_deg + 5.11)))
    height = math.radians(height_deg + minutes / 60.0)
    level = math.cos(height) / math.hypot(east, north)
    return np.array([east * level, north * level, math.sin(height)])
