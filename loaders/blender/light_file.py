"""What `isolux export --lux` writes, as arrays."""

import json
import struct

import numpy

from .command import Trouble
from .written import GEOMETRY

UNKNOWN = -1.0
TYPES = {5123: "<u2", 5125: "<u4", 5126: "<f4"}
COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])


class Side:
    """Elements of one side of a shape, with the light at their vertices. Positions are those of Blender."""

    def __init__(self, document, binary, shape, primitive):
        def read(index):
            accessor = document["accessors"][index]
            view = document["bufferViews"][accessor["bufferView"]]
            columns = COLUMNS[accessor["type"]]
            numbers = numpy.frombuffer(binary, TYPES[accessor["componentType"]], columns * accessor["count"], view["byteOffset"])
            return numbers.reshape(-1, columns) if columns > 1 else numbers

        attributes = primitive["attributes"]
        self.shape = shape
        self.positions = read(attributes["POSITION"])
        self.normals = read(attributes["NORMAL"])
        self.uvs = read(attributes["TEXCOORD_0"]) if "TEXCOORD_0" in attributes else None
        self.triangles = read(primitive["indices"]).reshape(-1, 3)
        self.rgb_lx = read(attributes["_ILLUMINANCE_LX"])
        self.direct_lx = read(attributes["_DIRECT_LX"]) @ LUMINANCE
        self.errors_lx = read(attributes["_STDERR_LX"])
        self.lux = self.rgb_lx @ LUMINANCE
        self.reflectance = numpy.array(primitive["extras"]["reflectance"])
        self.luminance_cd_m2 = numpy.array(primitive["extras"]["luminance_cd_m2"])
        material = document["materials"][primitive["material"]]
        self.material = material["name"]
        texture = material["pbrMetallicRoughness"].get("baseColorTexture")
        self.texture = None
        if texture is not None:
            image = document["images"][document["textures"][texture["index"]]["source"]]
            view = document["bufferViews"][image["bufferView"]]
            self.texture = bytes(binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]])


def read(path):
    with open(path, "rb") as file:
        content = file.read()
    length = struct.unpack_from("<I", content, 12)[0]
    document = json.loads(content[20 : 20 + length])
    binary = memoryview(content)[28 + length :]
    sides = [
        Side(document, binary, mesh["name"].removeprefix(f"{GEOMETRY}/"), primitive)
        for mesh in document["meshes"]
        for primitive in mesh["primitives"]
        if "_ILLUMINANCE_LX" in primitive["attributes"]
    ]
    if not sides:
        raise Trouble("no surface of the scene carries light; are all of them glass, mirrors or lamps?")
    return sides
