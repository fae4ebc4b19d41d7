"""Light in Blender: lit copies of the surfaces, colours on the objects themselves, or a lightmap."""

import math
import re

import bpy
import mathutils
import numpy

from .light_file import UNKNOWN

COLLECTION = "isolux"
# Marks of what the add-on made, and of what it has to put back.
MADE, HIDDEN, MATERIALS = "isolux_made", "isolux_hidden", "isolux_materials"
LUX, ERROR, DIRECT, LIGHT = "isolux_lux", "isolux_error", "isolux_direct", "isolux_light"
EXPOSURE = "isolux exposure"
# Objects that the exporter makes meshes of.
SURFACES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
# Corners of objects are found in a map that went through 32-bit floats and was moved off backs, relative to the size of the scene.
NEAR = 3e-5
# Cosine of the angle between normals of one side.
SAME_SIDE = 0.9


def clear(context):
    """Takes everything away again that was made."""
    for thing in list(bpy.data.objects):
        if thing.get(HIDDEN):
            thing.hide_render = False
            if thing.name in context.view_layer.objects:
                thing.hide_set(False)
            del thing[HIDDEN]
        if thing.get(MATERIALS) is not None:
            for slot, name in zip(thing.material_slots, thing[MATERIALS]):
                slot.material = bpy.data.materials.get(name) if name else None
            del thing[MATERIALS]
            for name in (LUX, ERROR, LIGHT):
                attribute = thing.data.attributes.get(name)
                if attribute is not None:
                    thing.data.attributes.remove(attribute)
        elif thing.get(MADE):
            data = thing.data
            bpy.data.objects.remove(thing)
            if data is not None and data.users == 0 and isinstance(data, bpy.types.Mesh):
                bpy.data.meshes.remove(data)
    for family in (bpy.data.collections, bpy.data.materials, bpy.data.images, bpy.data.node_groups):
        for made in [made for made in family if made.get(MADE)]:
            family.remove(made)


def collection(context):
    made = bpy.data.collections.new(COLLECTION)
    made[MADE] = True
    context.scene.collection.children.link(made)
    return made


def object_of(shape):
    """An object of several materials is as many shapes."""
    return re.sub(r" \[\d+\]$", "", shape)


def hide_lit(context, copies, names=None):
    """Hides the objects whose place copies take, by name; else all with surfaces."""

    def is_lit(thing):
        return thing.type in SURFACES and (names is None or thing.name in names)

    for thing in context.visible_objects:
        inside = thing.instance_collection.all_objects if thing.instance_collection else ()
        if not thing.hide_render and thing.name not in copies.all_objects and any(map(is_lit, (thing, *inside))):
            thing[HIDDEN] = True
            thing.hide_render = True
            thing.hide_set(True)


def exposure_group(stops):
    """One number for all materials."""
    group = bpy.data.node_groups.get(EXPOSURE)
    if group is None:
        group = bpy.data.node_groups.new(EXPOSURE, "ShaderNodeTree")
        group[MADE] = True
        group.interface.new_socket("Factor", in_out="OUTPUT", socket_type="NodeSocketFloat")
        value, output = group.nodes.new("ShaderNodeValue"), group.nodes.new("NodeGroupOutput")
        group.links.new(value.outputs[0], output.inputs[0])
    set_exposure(stops)
    return group


def set_exposure(stops):
    group = bpy.data.node_groups.get(EXPOSURE)
    if group is not None:
        next(node for node in group.nodes if node.type == "VALUE").outputs[0].default_value = 2.0**stops


def show_elements(context, sides, efficacy, stops):
    """Copies of all surfaces that carry light, as fine as the map."""
    target = collection(context)
    materials = {}
    for side in sides:
        mesh = bpy.data.meshes.new(side.shape)
        fill(mesh, side)
        luminance = side.reflectance * side.rgb_lx / math.pi + side.luminance_cd_m2
        for name, values in ((LUX, side.lux), (ERROR, side.errors_lx), (DIRECT, side.direct_lx)):
            mesh.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", numpy.ascontiguousarray(values, numpy.float32))
        colours(mesh, "POINT", luminance / efficacy)
        key = (side.material, side.texture)
        if key not in materials:
            materials[key] = lit_material(f"{side.material} (isolux)", stops, side.texture)
        mesh.materials.append(materials[key])
        thing = bpy.data.objects.new(f"{side.shape} (isolux)", mesh)
        thing[MADE] = True
        # Light is in it already; it gives none to others.
        thing.visible_diffuse = thing.visible_shadow = False
        target.objects.link(thing)
    hide_lit(context, target, {object_of(side.shape) for side in sides})


def fill(mesh, side):
    corners = side.triangles.ravel()
    mesh.vertices.add(len(side.positions))
    mesh.vertices.foreach_set("co", side.positions.ravel())
    mesh.loops.add(len(corners))
    mesh.loops.foreach_set("vertex_index", corners.astype(numpy.int32))
    mesh.polygons.add(len(side.triangles))
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, len(corners), 3, dtype=numpy.int32))
    if side.uvs is not None:
        # Rows of glTF count downwards.
        places = side.uvs[corners] * (1, -1) + (0, 1)
        mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", places.astype(numpy.float32).ravel())
    mesh.update(calc_edges=True)
    mesh.normals_split_custom_set_from_vertices(side.normals.tolist())


def colours(mesh, domain, values):
    rows = numpy.ones((len(values), 4), numpy.float32)
    rows[:, :3] = values
    attribute = mesh.color_attributes.new(LIGHT, "FLOAT_COLOR", domain)
    attribute.data.foreach_set("color", rows.ravel())
    mesh.color_attributes.active_color = attribute


def lit_material(name, stops, texture=None):
    """Shows the colours of vertices as they are, times the texture, from the side that they belong to."""
    material = bpy.data.materials.new(name)
    material[MADE] = True
    material.use_nodes = True
    material.use_backface_culling = True
    tree = material.node_tree
    tree.nodes.clear()
    light = attribute_node(tree)
    if texture is not None:
        image = tree.nodes.new("ShaderNodeTexImage")
        image.image = packed(name, texture)
        light = product(tree, light, image.outputs["Color"])
    emission = emission_node(tree, light, stops)
    one_sided = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], one_sided.inputs[0])
    tree.links.new(emission.outputs[0], one_sided.inputs[1])
    tree.links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], one_sided.inputs[2])
    tree.links.new(one_sided.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    material.cycles.emission_sampling = "NONE"
    return material


def attribute_node(tree):
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_name = LIGHT
    return node.outputs["Color"]


def product(tree, a, b):
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = "MULTIPLY"
    tree.links.new(a, node.inputs[0])
    if isinstance(b, bpy.types.NodeSocket):
        tree.links.new(b, node.inputs[1])
    else:
        node.inputs[1].default_value = b
    return node.outputs[0]


def emission_node(tree, colour, stops):
    emission = tree.nodes.new("ShaderNodeEmission")
    exposure = tree.nodes.new("ShaderNodeGroup")
    exposure.node_tree = exposure_group(stops)
    tree.links.new(colour, emission.inputs["Color"])
    tree.links.new(exposure.outputs[0], emission.inputs["Strength"])
    return emission


def packed(name, content):
    image = bpy.data.images.new(name, 1, 1)
    image[MADE] = True
    image.pack(data=content, data_len=len(content))
    image.source = "FILE"
    return image


def show_on_objects(context, sides, efficacy, stops):
    """Colours on the corners of the objects themselves, wired into copies of their materials. Gives the share of corners found, and objects that
    cannot have light of their own."""
    by_shape = {}
    for side in sides:
        by_shape.setdefault(object_of(side.shape), []).append(side)
    extent = max(float(numpy.ptp(numpy.concatenate([side.positions for side in sides]), axis=0).max()), 1e-6)
    found = corners = 0
    materials, shared = {}, []
    for thing in list(context.visible_objects):
        if thing.type != "MESH" or thing.hide_render or not thing.data.polygons:
            continue
        if thing.data.users > 1:
            shared.append(thing.name)
            continue
        tree = Corners(by_shape.get(thing.name, sides), NEAR * extent)
        lux, errors, light = at_corners(thing, tree)
        found, corners = found + int((errors != UNKNOWN).sum()), corners + len(lux)
        mesh = thing.data
        if thing.get(MATERIALS) is None:
            thing[MATERIALS] = [slot.material.name if slot.material else "" for slot in thing.material_slots]
        for name, values in ((LUX, lux), (ERROR, errors)):
            mesh.attributes.new(name, "FLOAT", "CORNER").data.foreach_set("value", values)
        colours(mesh, "CORNER", light / (math.pi * efficacy))
        for slot in thing.material_slots:
            if slot.material is not None:
                if slot.material.name not in materials:
                    materials[slot.material.name] = wired(slot.material, stops)
                slot.material = materials[slot.material.name]
    return found / max(1, corners), shared


class Corners:
    """Vertices of sides by their place."""

    def __init__(self, sides, near):
        self.near = near
        self.normals = numpy.concatenate([side.normals for side in sides])
        self.lux = numpy.concatenate([side.lux for side in sides])
        self.errors = numpy.concatenate([side.errors_lx for side in sides])
        self.rgb = numpy.concatenate([side.rgb_lx for side in sides])
        positions = numpy.concatenate([side.positions for side in sides])
        self.tree = mathutils.kdtree.KDTree(len(positions))
        for index, place in enumerate(positions.tolist()):
            self.tree.insert(place, index)
        self.tree.balance()

    def at(self, place, normal):
        """The known vertices at a place whose side faces the same way as the best of them."""
        near = [index for _, index, _ in self.tree.find_range(place, self.near)]
        cosines = self.normals[near] @ numpy.array(normal) if near else numpy.array([])
        if not len(cosines) or cosines.max() < SAME_SIDE:
            return []
        return [index for index, cosine in zip(near, cosines) if cosine > cosines.max() - 1e-3 and self.errors[index] != UNKNOWN]


def at_corners(thing, tree):
    """Lux, standard error and light in three channels at each corner of a mesh; -1 is the error of what is not known."""
    mesh = thing.data
    turned = thing.matrix_world.to_3x3().inverted_safe().transposed()
    count = len(mesh.loops)
    lux, errors, light = numpy.zeros(count, numpy.float32), numpy.full(count, UNKNOWN, numpy.float32), numpy.zeros((count, 3), numpy.float32)
    known = {}
    for loop in mesh.loops:
        normal = (turned @ mesh.corner_normals[loop.index].vector).normalized()
        key = (loop.vertex_index, tuple(round(c, 3) for c in normal))
        if key not in known:
            known[key] = tree.at(thing.matrix_world @ mesh.vertices[loop.vertex_index].co, normal)
        if known[key]:
            lux[loop.index] = tree.lux[known[key]].mean()
            errors[loop.index] = tree.errors[known[key]].mean()
            light[loop.index] = tree.rgb[known[key]].mean(axis=0)
    return lux, errors, light


def wired(material, stops):
    """A copy of a material that shows its base colour in the light of the map, and what it emits."""
    copy = material.copy()
    copy.name = f"{material.name} (isolux)"
    copy[MADE] = True
    copy.use_nodes = True
    tree = copy.node_tree
    principled = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    light = attribute_node(tree)
    if principled is None:
        light = product(tree, light, material.diffuse_color[:3])
    else:
        base = principled.inputs["Base Color"]
        light = product(tree, light, base.links[0].from_socket if base.is_linked else base.default_value[:3])
    shader = emission_node(tree, light, stops).outputs[0]
    if principled is not None:
        own = tree.nodes.new("ShaderNodeEmission")
        for source, target in (("Emission Color", "Color"), ("Emission Strength", "Strength")):
            if principled.inputs[source].is_linked:
                tree.links.new(principled.inputs[source].links[0].from_socket, own.inputs[target])
            else:
                own.inputs[target].default_value = principled.inputs[source].default_value
        both = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(shader, both.inputs[0])
        tree.links.new(own.outputs[0], both.inputs[1])
        shader = both.outputs[0]
    output = tree.get_output_node("ALL") or tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader, output.inputs["Surface"])
    copy.cycles.emission_sampling = "NONE"
    return copy


def show_lightmap(context, path, efficacy, stops):
    """What isolux writes for Blender as a lightmap: imported, and exposed like the rest."""
    before = {family: set(getattr(bpy.data, family)) for family in ("objects", "materials", "images")}
    bpy.ops.import_scene.gltf(filepath=path)
    target = collection(context)
    for family, old in before.items():
        for made in set(getattr(bpy.data, family)) - old:
            made[MADE] = True
            if family == "objects":
                for other in made.users_collection:
                    other.objects.unlink(made)
                target.objects.link(made)
                made.visible_diffuse = made.visible_shadow = False
            elif family == "images":
                made.pack()
            else:
                expose(made, efficacy, stops)
    hide_lit(context, target)


def expose(material, efficacy, stops):
    tree = material.node_tree
    principled = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None) if tree else None
    if principled is None:
        return
    strength = principled.inputs["Emission Strength"]
    exposure, factor = tree.nodes.new("ShaderNodeGroup"), tree.nodes.new("ShaderNodeMath")
    exposure.node_tree = exposure_group(stops)
    factor.operation = "MULTIPLY"
    factor.inputs[1].default_value = strength.default_value / efficacy
    tree.links.new(exposure.outputs[0], factor.inputs[0])
    tree.links.new(factor.outputs[0], strength)
    material.cycles.emission_sampling = "NONE"
