"""Lets Blender import what is written with `--target blender`, render it with Cycles, and say what luminance it shows.

Usage: python judge.py --card CARD.glb [--vertices CARD.glb] --reflectance RHO --illuminance LX
                       [--room ROOM.glb --picture ROOM.png --white CD_M2]

The card is a square of known reflectance under a known illuminance: scene-linear 1 is 1 cd/m2, so that it must render as
rho E / pi; with its light at vertices 1 is the white of the file. The room is compared with a linear picture of isolux from the same camera, whose full code stands for CD_M2."""

import argparse
import json
import math
import os
import struct
import sys
import tempfile

import bpy
import mathutils
import numpy

# Blender decodes sRGB of 16 bits in single precision; measured 2.4e-5 at white.
CARD_TOLERANCE = 1e-4
# Colours of vertices are kept in 8 bits of sRGB; measured 0.34 codes.
VERTEX_CODES = 0.51
# Isolux's picture is rounded to codes. At borders of shadows it reads direct light at the point where a texel of 1/71 m holds
# its mean, and at contacts and edges it interpolates indirect light where the lightmap gathers it. Measured on a draft of the
# Cornell box: 77.2 % of the pixels within 1, 92.9 % within 4; half of all differ by less than 0.45.
NEAR_CODES = 4
NEAR_SHARE = 0.9
WIDTH, HEIGHT = 640, 360


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--card", required=True)
    parser.add_argument("--vertices")
    parser.add_argument("--reflectance", type=float, required=True)
    parser.add_argument("--illuminance", type=float, required=True)
    parser.add_argument("--room")
    parser.add_argument("--picture")
    parser.add_argument("--white", type=float)
    flags = parser.parse_args()
    judge_card(flags)
    if flags.vertices:
        judge_vertices(flags)
    if flags.room:
        judge_room(flags)


def white_of(file):
    """What the file says of its colours, cd/m2."""
    with open(file, "rb") as glb:
        length = struct.unpack("<3I2I", glb.read(20))[3]
        return json.loads(glb.read(length))["extras"]["isolux_vertices"]["white_cd_m2"]


def middle_of_card(file):
    load(file)
    look_down_on("card")
    return rendered(9, 9)[4, 4]


def judge_vertices(flags):
    white = white_of(flags.vertices)
    due = 255.0 * srgb(flags.reflectance * flags.illuminance / math.pi / white)
    codes = 255.0 * srgb(middle_of_card(flags.vertices))
    print(f"with its light at vertices it has codes {codes}, due are {due:.2f} where {white} cd/m2 are white")
    if not max(abs(codes - due)) <= VERTEX_CODES:
        sys.exit(f"{flags.vertices}: codes {codes} in place of {due}")


def judge_card(flags):
    found = middle_of_card(flags.card)
    due = flags.reflectance * flags.illuminance / math.pi
    off = max(abs(found / due - 1.0))
    print(f"Blender {bpy.app.version_string}: the card has {found[0]:.4f} cd/m2, rho E / pi is {due:.4f}: off by {off:.1e}")
    if not off <= CARD_TOLERANCE:
        sys.exit(f"{flags.card}: {found} cd/m2 in place of {due}")


def judge_room(flags):
    shown = picture(flags.picture)
    load(flags.room)
    [camera] = [thing for thing in bpy.data.objects if thing.type == "CAMERA"]
    bpy.context.scene.camera = camera
    codes = 255.0 * srgb(rendered(WIDTH, HEIGHT) / flags.white)
    # Where isolux sees the scene and its picture is not cut off.
    seen = (shown.max(axis=2) > 0) & (shown.max(axis=2) < 255)
    if seen.mean() < 0.1:
        sys.exit(f"{flags.picture} shows {seen.sum()} pixels of a scene")
    apart = numpy.abs(codes - shown).max(axis=2)[seen]
    share = (apart <= NEAR_CODES).mean()
    print(f"Blender's picture of the room: {100 * share:.2f} % of {seen.sum()} pixels within {NEAR_CODES} codes of isolux, "
          f"{100 * (apart <= 1).mean():.2f} % within 1, middle {numpy.median(apart):.2f}, worst {apart.max():.0f}")
    if not share >= NEAR_SHARE:
        sys.exit(f"{flags.room}: less than {100 * NEAR_SHARE} %")


def load(file):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=os.path.abspath(file))


def look_down_on(name):
    """A camera above the middle of an object, which fills more than its picture."""
    card = bpy.data.objects[name]
    corners = [card.matrix_world @ mathutils.Vector(corner) for corner in card.bound_box]
    middle = sum(corners, mathutils.Vector()) / len(corners)
    camera = bpy.data.cameras.new("above")
    camera.type = "ORTHO"
    camera.ortho_scale = 0.4 * max((a - b).length for a in corners for b in corners)
    thing = bpy.data.objects.new("above", camera)
    thing.location = middle + mathutils.Vector((0.0, 0.0, 1.0))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def rendered(width, height):
    """Scene-linear pixels, from the top: what Cycles finds before any view transform."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    # Emission alone has no noise; samples smooth edges, as a box as wide as the pixel.
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 0
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "picture.exr")
        bpy.ops.render.render(write_still=True)
        return picture(scene.render.filepath, 1.0)


def picture(file, full=255.0):
    """The channels of a picture as they are in the file, from the top."""
    image = bpy.data.images.load(os.path.abspath(file), check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = numpy.empty(4 * width * height, dtype=numpy.float32)
    image.pixels.foreach_get(pixels)
    return full * pixels.reshape(height, width, 4)[::-1, :, :3].astype(float)


def srgb(light):
    light = numpy.clip(light, 0.0, 1.0)
    return numpy.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


main()
