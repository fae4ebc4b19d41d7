"""The scene as files that isolux reads: a glTF file, and a scene.toml with the lamps that glTF cannot hold."""

import json
import math
import os
import shutil
import struct

import bpy
import mathutils

from .command import Trouble

# Photometric weights of linear Rec. 709.
LUMINANCE = (0.2126, 0.7152, 0.0722)
# The shape of an object is named `GEOMETRY/object`.
GEOMETRY = "scene"
MAGIC, JSON_CHUNK = 0x46546C67, 0x4E4F534A


def write(context, folder, efficacy):
    """Writes the visible scene. Gives the path of the scene.toml, and what is left out."""
    warnings = []
    lamps = Lamps(folder, efficacy, warnings)
    for instance in context.evaluated_depsgraph_get().object_instances:
        thing = instance.object
        if thing.type == "LIGHT" and not thing.original.hide_render and instance.show_self:
            lamps.add(thing, instance.matrix_world)
    document = write_gltf(os.path.join(folder, "scene.glb"), efficacy, lamps.names_of_ies)
    if not lamps.lines and not gives_light(document):
        raise Trouble("the scene has no light; add a lamp, or a material with emission, and show it in viewport and renders")
    if shines(context.scene.world):
        warnings.append("the light of the world is left out; add a sun or area lights for it")
    lines = [
        f"name = {quoted(context.scene.name)}",
        'up = "z"',
        "[[geometry]]",
        f"name = {quoted(GEOMETRY)}",
        'file = "scene.glb"',
        *lamps.lines,
    ]
    path = os.path.join(folder, "scene.toml")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    return path, warnings


def shines(world):
    nodes = world.node_tree.nodes if world and world.use_nodes and world.node_tree else []
    backgrounds = [node.inputs for node in nodes if node.type == "BACKGROUND" and node.outputs[0].is_linked]
    is_dark = lambda of: not (of["Color"].is_linked or any(of["Color"].default_value[:3]))
    return any((of["Strength"].is_linked or of["Strength"].default_value > 0) and not is_dark(of) for of in backgrounds)


def quoted(text):
    # Strings of JSON without surrogates are strings of TOML.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


class Lamps:
    """Area lights, and lights with an IES file; glTF holds the others."""

    def __init__(self, folder, efficacy, warnings):
        self.folder, self.efficacy, self.warnings = folder, efficacy, warnings
        self.names_of_ies = set()
        self.lines = []

    def add(self, thing, matrix):
        light = thing.data
        ies = ies_node(light)
        if ies is not None:
            self.names_of_ies.add(light.name)
            self._add_ies(thing.name, ies, matrix, light)
        elif light.type == "AREA":
            self._add_area(thing.name, light, matrix)

    def _add(self, name, matrix, light, more):
        position, rotation, _ = matrix.decompose()
        axis, across = rotation @ mathutils.Vector((0, 0, -1)), rotation @ mathutils.Vector((1, 0, 0))
        self.lines += [
            "[[luminaire]]",
            f"name = {quoted(name)}",
            f"position = {list(position)}",
            f"direction = {list(axis)}",
            f"rotate_deg = {turn_about_axis(axis, across)!r}",
            f"colour = {colour_of(light)}",
            *more,
        ]

    def _add_area(self, name, light, matrix):
        if light.use_nodes and light.node_tree:
            self.warnings.append(f"{name}: the nodes of area lights are left out")
        if light.spread < math.pi * (1 - 1e-6):
            self.warnings.append(f"{name}: the spread of area lights is left out")
        scale = matrix.to_scale()
        is_round = light.shape in {"DISK", "ELLIPSE"}
        length = light.size * abs(scale.x)
        width = (light.size_y if light.shape in {"RECTANGLE", "ELLIPSE"} else light.size) * abs(scale.y)
        flux_w = light.energy * 2 ** getattr(light, "exposure", 0)
        if not getattr(light, "normalize", True):
            flux_w *= length * width * (math.pi / 4 if is_round else 1)
        flux_lm = self.efficacy * flux_w * sum(weight * c for weight, c in zip(LUMINANCE, colour_of(light)))
        if flux_lm <= 0:
            return
        shape = "cylinder_z" if is_round else "box"
        size = f'luminous_area = {{ shape = "{shape}", size_m = [{length!r}, {width!r}, 0.0] }}'
        self._add(name, matrix, light, [f"cosine = {{ flux_lm = {flux_lm!r} }}", size])

    def _add_ies(self, name, node, matrix, light):
        file = f"lamp-{len(self.names_of_ies)}-{len(self.lines)}.ies"
        target = os.path.join(self.folder, file)
        if node.mode == "INTERNAL" and node.ies:
            with open(target, "w", encoding="utf-8") as text:
                text.write(node.ies.as_string())
        else:
            source = bpy.path.abspath(node.filepath, library=light.library)
            if not os.path.isfile(source):
                raise Trouble(f"{name}: its IES file {source or 'has no name and'} does not exist; choose another in its IES Texture node")
            shutil.copyfile(source, target)
        self._add(name, matrix, light, [f"ies = {quoted(file)}"])


def ies_node(light):
    nodes = light.node_tree.nodes if light.use_nodes and light.node_tree else []
    return next((node for node in nodes if node.type == "TEX_IES" and node.outputs[0].is_linked and not node.mute), None)


def colour_of(light):
    colour = list(light.color)
    if getattr(light, "use_temperature", False):
        colour = [a * b for a, b in zip(colour, light.temperature_color)]
    return colour


def turn_about_axis(axis, across):
    """Degrees from C0 of a luminaire that hangs straight and is tilted to its axis, to where it points in truth."""
    down = mathutils.Vector((0, 0, -1))
    if axis.z > 1 - 1e-9:
        tilt = mathutils.Quaternion((1, 0, 0), math.pi)
    else:
        tilt = down.rotation_difference(axis)
    straight = tilt.inverted() @ across
    return math.degrees(math.atan2(straight.y, straight.x))


def write_gltf(path, efficacy, without):
    """What Blender exports, in photometric units: a watt is so many lumens, in lamps and in emission alike."""
    done = bpy.ops.export_scene.gltf(
        filepath=path,
        export_format="GLB",
        use_visible=True,
        use_renderable=True,
        use_active_scene=True,
        export_apply=True,
        export_animations=False,
        export_lights=True,
        export_cameras=False,
        export_yup=True,
        export_import_convert_lighting_mode="COMPAT",
    )
    if done != {"FINISHED"} or not os.path.isfile(path):
        raise Trouble("Blender exported no glTF file; try File, Export, glTF 2.0 to see why")
    with open(path, "rb") as file:
        content = file.read()
    length = struct.unpack_from("<I", content, 12)[0]
    document = json.loads(content[20 : 20 + length])
    if not document.get("meshes"):
        raise Trouble("the scene has no visible mesh; add one, or show it in viewport and renders")
    make_photometric(document, efficacy, without)
    text = json.dumps(document, ensure_ascii=False).encode("utf-8")
    text += b" " * (-len(text) % 4)
    rest = content[20 + length :]
    head = struct.pack("<5I", MAGIC, 2, 20 + len(text) + len(rest), len(text), JSON_CHUNK)
    with open(path, "wb") as file:
        file.write(head + text + rest)
    return document


def gives_light(document):
    has_lamp = any("KHR_lights_punctual" in node.get("extensions", {}) for node in document.get("nodes", []))
    return has_lamp or any(any(material.get("emissiveFactor", [])) for material in document.get("materials", []))


def make_photometric(document, efficacy, without):
    lights = document.get("extensions", {}).get("KHR_lights_punctual", {}).get("lights", [])
    for light in lights:
        light["intensity"] = efficacy * light.get("intensity", 1.0)
    left_out = {index for index, light in enumerate(lights) if light.get("name") in without}
    for node in document.get("nodes", []):
        reference = node.get("extensions", {}).get("KHR_lights_punctual")
        if reference and reference["light"] in left_out:
            del node["extensions"]["KHR_lights_punctual"]
    for material in document.get("materials", []):
        if any(material.get("emissiveFactor", [])):
            strength = material.setdefault("extensions", {}).setdefault("KHR_materials_emissive_strength", {})
            strength["emissiveStrength"] = efficacy * strength.get("emissiveStrength", 1.0)
            used = document.setdefault("extensionsUsed", [])
            if "KHR_materials_emissive_strength" not in used:
                used.append("KHR_materials_emissive_strength")
